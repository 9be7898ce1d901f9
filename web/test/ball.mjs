// SPDX-License-Identifier: Apache-2.0
// node ball.mjs FOLDER QUERY LABEL KEY TIMES: prints the lux in the middle of the picture before and after a fader was moved by
// so many presses of a key, as JSON, and the console's errors.
import { openBrowser, openPage, serveFolder, settled } from './browser.mjs';

const [folder, query, label, key, times] = process.argv.slice(2);
const site = await serveFolder(folder);
const browser = await openBrowser();
const { page, errors } = await openPage(browser, `${site.url}?${query}`);
const state = await settled(page);
async function lux() {
  await page.locator('#view').focus();
  await page.keyboard.press('r');
  return Number(/([\d.,]+) lx/.exec(await page.locator('#spoken').textContent())[1].replace(',', ''));
}
const before = await lux();
for (let i = 0; i < Number(times); ++i) await page.getByLabel(label, { exact: true }).press(key);
console.log(JSON.stringify({ state, errors, before, after: await lux() }));
await browser.close();
site.close();
