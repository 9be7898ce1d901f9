// SPDX-License-Identifier: Apache-2.0
// node three_faults.mjs PROGRAM PICTURE: the three.js example as people see it. What goes wrong is said in one line, the
// page goes on without bounces, and has them again when it is over. Fails by an exception.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';

import { openBrowser, openPage } from './browser.mjs';

const [program, picture] = process.argv.slice(2);
const child = spawn(program, { stdio: ['ignore', 'pipe', 'inherit'] });
process.on('exit', () => child.kill());
process.on('SIGTERM', () => process.exit(1)); // of a time limit: with the child
const url = await new Promise((found) => child.stdout.once('data', (text) => found(String(text).trim())));
const browser = await openBrowser();
const { page, errors } = await openPage(browser, url, { width: 640, height: 480 });

const says = (text) =>
  page.waitForFunction((t) => document.getElementById('status').textContent.includes(t), text);
/** Mean of the ambient map's red. */
const light = () =>
  page.evaluate(() => {
    const { data } = window.radiosity.ambient.image;
    return data.reduce((sum, v, i) => sum + (i % 4 === 0 ? v : 0), 0) / (data.length / 4);
  });

/** @param goesOn  whether there is anything to draw with meanwhile */
async function fault(line, begin, end, goesOn = true) {
  await page.evaluate(begin);
  await says(`without bounces: ${line}`);
  assert.equal(await light(), 0);
  const shown = await page.evaluate(() => window.renderer.info.render.frame);
  if (goesOn) await page.waitForFunction((n) => window.renderer.info.render.frame > n + 2, shown);
  await page.evaluate(end);
  await says('ms solved');
  assert.ok((await light()) > 0.05);
  console.log(`${line}: ok`);
}

await page.waitForFunction(() => document.documentElement.dataset.state === 'ready');
await says('ms solved');
assert.ok((await light()) > 0.05);
await page.screenshot({ path: picture });
console.log(await page.locator('#status').textContent());

// What the program set is as it was after every frame.
const kept = await page.evaluate(async () => {
  const { renderer, scene, lamp, radiosity } = window;
  renderer.setClearColor(0x123456, 0.5);
  const state = () =>
    JSON.stringify([
      renderer.getRenderTarget(), renderer.getClearColor(lamp.color.clone()), renderer.getClearAlpha(), renderer.autoClear,
      scene.background, scene.environment, scene.fog, scene.overrideMaterial, lamp.intensity,
      scene.children.map((c) => [c.visible, c.frustumCulled, c.material?.lightMapIntensity]),
    ]);
  const before = state(), version = radiosity.ambient.version;
  while (radiosity.ambient.version < version + 3) await new Promise(requestAnimationFrame);
  return [before, state()];
});
assert.equal(kept[1], kept[0]);

// Other paint, and the materials are looked at again: between two frames, and nothing is made anew.
const [colourful, repainted] = await page.evaluate(async () => {
  const { radiosity, materials } = window;
  const reflectances = () => radiosity.found.materials[1].reflectance;
  const before = reflectances();
  materials[1].color.setRGB(0.25, 0.5, 0.125);
  await radiosity.detect();
  return [before, reflectances()];
});
assert.ok(colourful.every((v, i) => Math.abs(v - [0.75, 0.74, 0.7][i]) < 1e-3), String(colourful));
assert.ok(repainted.every((v, i) => Math.abs(v - [0.25, 0.5, 0.125][i]) < 1e-3), String(repainted));
await page.evaluate(() => window.materials[1].color.setRGB(0.75, 0.74, 0.7));

await fault(
  "the renderer's drawing of direct light: the WebGL context is lost",
  () => (window.lose = window.renderer.getContext().getExtension('WEBGL_lose_context')).loseContext(),
  () => window.lose.restoreContext(),
  false,
);
await fault(
  "the renderer's drawing of direct light: plaster:2: a comment that ends with a backslash",
  () => {
    const plaster = window.materials[1];
    plaster.onBeforeCompile = (shader) => (shader.vertexShader = `// the program's own\n// \\\n\n${shader.vertexShader}`);
    plaster.needsUpdate = true;
  },
  () => {
    window.materials[1].onBeforeCompile = () => {};
    window.materials[1].needsUpdate = true;
  },
);
await fault(
  "the renderer's drawing of direct light: has the value nan",
  () => (window.materials[0].emissive.r = NaN),
  () => (window.materials[0].emissive.r = 0),
);
assert.deepEqual(errors.filter((e) => !/context lost|status of 422/i.test(e)), []);

child.kill();
await says('without bounces: ');
assert.equal(await light(), 0);
await browser.close();
