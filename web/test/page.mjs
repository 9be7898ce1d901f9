// SPDX-License-Identifier: Apache-2.0
// node page.mjs FOLDER: what the page is to people, and what it does where something is missing. Fails by an exception.
import assert from 'node:assert/strict';

import { openBrowser, openPage, serveFolder, settled } from './browser.mjs';

const folder = process.argv[2];
/** In the middle of the picture. */
async function lux(page) {
  await page.locator('#view').focus();
  await page.keyboard.press('r');
  return Number(/([\d.,]+) lx/.exec(await page.locator('#spoken').textContent())[1].replace(',', ''));
}

const site = await serveFolder(folder);
const browser = await openBrowser();

async function controlsHaveNames() {
  const { page, errors } = await openPage(browser, site.url);
  assert.equal(await settled(page), 'ready');
  const nameless = await page.evaluate(() =>
    [...document.querySelectorAll('button, input, select, canvas, [role]')]
      .filter((e) => !(e.getAttribute('aria-label') || e.textContent?.trim() || e.labels?.length))
      .map((e) => e.outerHTML),
  );
  assert.deepEqual(nameless.filter((html) => !html.includes('id="spoken"') && !html.includes('id="notice"')), []);
  assert.deepEqual(errors, []);
  await page.close();
}

/** Every control of the panel by Tab alone, the view first. */
async function keyboardReachesAll() {
  const { page } = await openPage(browser, site.url);
  await settled(page);
  const wanted = await page.evaluate(
    () => [...document.querySelectorAll('#panel button, #panel input, #panel select')].filter((e) => !e.hidden).length,
  );
  let reached = 0;
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement.id), 'view');
  for (let i = 0; i < wanted; ++i) {
    await page.keyboard.press('Tab');
    reached += await page.evaluate(() => (document.activeElement.closest('#panel') ? 1 : 0));
  }
  assert.equal(reached, wanted);
  await page.close();
}

async function keysMoveAndRead() {
  const { page } = await openPage(browser, site.url);
  await settled(page);
  await page.locator('#view').focus();
  await page.keyboard.press('r');
  const before = await page.locator('#spoken').textContent();
  assert.match(before, /In the middle: [\d.,]+ lx · [\d.,]+ cd\/m²/);
  await page.keyboard.down('ArrowLeft');
  await page.waitForTimeout(400);
  await page.keyboard.up('ArrowLeft');
  await page.keyboard.press('r');
  assert.notEqual(await page.locator('#spoken').textContent(), before);
  await page.close();
}

async function soloAndPreset() {
  const { page } = await openPage(browser, site.url);
  await settled(page);
  const first = page.locator('input[type=range]').first();
  assert.equal(await first.inputValue(), '-2', 'the first mood is there at once');
  const dim = page.getByRole('button', { name: 'dim' });
  assert.equal(await dim.getAttribute('aria-pressed'), 'true');
  await first.fill('-1');
  assert.equal(await dim.getAttribute('aria-pressed'), 'false', 'it is not that mood any more');
  await page.getByRole('button', { name: 'Reset' }).click();
  assert.equal(await first.inputValue(), '0');
  const solos = page.locator('.solo');
  assert.ok((await solos.count()) > 1);
  await solos.first().click();
  assert.equal(await solos.first().getAttribute('aria-pressed'), 'true');
  await dim.click();
  assert.equal(await dim.getAttribute('aria-pressed'), 'true');
  assert.equal(await solos.first().getAttribute('aria-pressed'), 'false');
  assert.equal(await page.locator('input[type=range]').first().inputValue(), '-2');
  await page.close();
}

/** Nothing of the picture lies behind the open panel. */
async function onAPhone() {
  const { page, errors } = await openPage(browser, site.url, { width: 390, height: 844 });
  await settled(page);
  const height = (id) => page.evaluate((of) => document.getElementById(of).getBoundingClientRect().height, id);
  assert.equal(await height('view'), 844);
  const fold = page.getByRole('button', { name: 'Lights' });
  await fold.click();
  assert.ok((await height('panel')) > 200);
  assert.ok(Math.abs((await height('view')) + (await height('panel')) - 844) <= 1);
  await fold.click();
  assert.equal(await height('view'), 844);
  assert.deepEqual(errors, []);
  await page.close();
}

async function notices() {
  const without = await openBrowser('--disable-3d-apis');
  const { page, errors } = await openPage(without, site.url);
  assert.equal(await settled(page), 'failed');
  assert.match(await page.locator('#notice').textContent(), /WebGL 2/);
  assert.deepEqual(errors, []);
  await without.close();
}

/** A layer breaks off at every try: a message, the rest is shown, and trying again ends well. */
async function halfLoaded() {
  let broken = true;
  const bad = await serveFolder(folder, (path, bytes) => (broken && path.includes('layer-0-') ? undefined : bytes));
  const { page } = await openPage(browser, bad.url);
  assert.equal(await settled(page), 'failed');
  assert.match(await page.locator('#notice').textContent(), /did not arrive.*layer-0-/s);
  const dark = await lux(page);
  broken = false;
  await page.getByRole('button', { name: 'Try again' }).click();
  assert.equal(await settled(page), 'ready');
  assert.equal(await page.locator('#notice').isHidden(), true);
  assert.ok((await lux(page)) > 1.02 * dark, 'the missing light is there now');
  bad.close();
  await page.close();
}

async function damaged() {
  for (const [file, text] of [['sconce.json', '{"format": "other"}'], ['sconce.json', '<html>'], ['positions.bin', 'x']]) {
    const bad = await serveFolder(folder, (path, bytes) => (path.endsWith(file) ? Buffer.from(text.padEnd(bytes.length)) : bytes));
    const { page } = await openPage(browser, bad.url);
    assert.equal(await settled(page), 'failed');
    assert.match(await page.locator('#notice').textContent(), new RegExp(file.replace('.', '\\.')));
    bad.close();
    await page.close();
  }
}

for (const check of [controlsHaveNames, keyboardReachesAll, keysMoveAndRead, soloAndPreset, onAPhone, notices, halfLoaded, damaged]) {
  await check();
  console.log(`${check.name}: ok`);
}
await browser.close();
site.close();
