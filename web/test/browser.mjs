// SPDX-License-Identifier: Apache-2.0
// A headless browser of the distribution, a static web server as dumb as they come, and a page that keeps what goes
// wrong in it.
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';

import { chromium } from 'playwright-core';

const kTypes = {
  '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.json': 'application/json',
  '.png': 'image/png', '.jpg': 'image/jpeg', '.webp': 'image/webp', '.glsl': 'text/plain',
};

/** @param spoil  (path, bytes) => what is sent instead; undefined = the connection breaks off half-way */
export async function serveFolder(folder, spoil = (_path, bytes) => bytes) {
  const server = createServer(async (request, response) => {
    const path = decodeURIComponent(new URL(request.url, 'http://x').pathname);
    const file = path.endsWith('/') ? `${path}index.html` : path;
    try {
      const bytes = await readFile(join(folder, normalize(file)));
      const sent = spoil(file, bytes);
      response.writeHead(200, { 'content-type': kTypes[extname(file)] ?? 'application/octet-stream', 'content-length': bytes.length });
      if (sent) return response.end(sent);
      response.write(bytes.subarray(0, bytes.length / 2));
      setTimeout(() => response.destroy(), 50);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((listening) => server.listen(0, '127.0.0.1', listening));
  return { url: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

export async function openBrowser(...more) {
  return chromium.launch({
    timeout: 120000,
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist', ...more],
  });
}

/** A page, its console's errors and the bytes of what it loaded. */
export async function openPage(browser, url, size = { width: 800, height: 450 }) {
  const page = await browser.newPage({ viewport: size, reducedMotion: 'reduce' });
  page.setDefaultTimeout(120000); // of busy machines
  const sizes = [];
  const seen = {
    page,
    errors: [],
    bytes: async () => (await Promise.all(sizes)).reduce((sum, size) => sum + size.responseBodySize, 0),
  };
  page.on('console', (message) => {
    if (message.type() === 'error') seen.errors.push(message.text());
  });
  page.on('pageerror', (error) => seen.errors.push(String(error)));
  page.on('requestfinished', (request) => {
    if (request.url().startsWith('http')) sizes.push(request.sizes());
  });
  await page.goto(url);
  return seen;
}

/** Until the page says so. @returns the state: ready or failed */
export async function settled(page) {
  await page.waitForFunction(() => ['ready', 'failed'].includes(document.documentElement.dataset.state), undefined, { timeout: 60000 });
  await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
  return page.evaluate(() => document.documentElement.dataset.state);
}

/** The canvas alone. */
export async function picture(page, file) {
  await page.evaluate(() => document.body.classList.add('bare'));
  await page.mouse.move(0, 0);
  await page.evaluate(() => {
    document.getElementById('reading').hidden = true;
    return new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
  });
  await page.screenshot({ path: file });
  await page.evaluate(() => document.body.classList.remove('bare'));
}
