// SPDX-License-Identifier: Apache-2.0
// node three.mjs PROGRAM OUT [--shiny]: the three.js example in a headless browser; says what the program says.
import { spawn } from 'node:child_process';

import { openBrowser, openPage } from './browser.mjs';

const [program, ...args] = process.argv.slice(2);
const child = spawn(program, args, { stdio: ['ignore', 'pipe', 'inherit'] });
process.on('exit', () => child.kill());
process.on('SIGTERM', () => process.exit(1)); // of a time limit: with the child
const ended = new Promise((exit) => child.on('exit', exit));
let said = '';
const url = await new Promise((found, missing) => {
  child.stdout.on('data', (text) => {
    said += text;
    if (said.includes('\n')) found(said.split('\n')[0]);
  });
  ended.then(() => missing(new Error('the program ended')));
});
const browser = await openBrowser();
const { page, errors } = await openPage(browser, url);
await page.waitForFunction(() => ['done', 'failed'].includes(document.documentElement.dataset.state), undefined, { timeout: 240000 });
const failed = (await page.evaluate(() => document.documentElement.dataset.state)) === 'failed';
if (failed) errors.push(await page.locator('#status').textContent());
await browser.close();
if (failed) child.kill();
process.exitCode = (await ended) || errors.length;
console.log(said.slice(url.length + 1));
console.error(errors.join('\n'));
