// SPDX-License-Identifier: Apache-2.0
// node pictures.mjs FOLDER PICTURES: moves the page's faders as people do and keeps what the canvas shows.
// PICTURES is JSON: [{"query": "tier=half", "file": "x.png", "steps": [["press", LABEL, KEY, TIMES] | ["click", LABEL] |
// ["select", LABEL, VALUE]]}]. Prints per picture the console's errors, the bytes that were loaded and the state.
import { openBrowser, openPage, picture, serveFolder, settled } from './browser.mjs';

const [folder, pictures] = process.argv.slice(2);
const site = await serveFolder(folder);
const browser = await openBrowser();
const report = [];
for (const { query, file, steps } of JSON.parse(pictures)) {
  const seen = await openPage(browser, `${site.url}?${query}`);
  const state = await settled(seen.page);
  for (const [what, label, value, times] of steps) {
    const control = seen.page.getByLabel(label, { exact: true });
    if (what === 'click') await control.click();
    if (what === 'select') await control.selectOption(value);
    if (what === 'press') for (let i = 0; i < times; ++i) await control.press(value);
  }
  await picture(seen.page, file);
  report.push({ state, errors: seen.errors, bytes: await seen.bytes() });
  await seen.page.close();
}
await browser.close();
site.close();
console.log(JSON.stringify(report));
