// What all that look at pages in Chromium share: opening one without a network, taking its picture, and what came out.

import { pathToFileURL } from 'node:url';
import { resolve } from 'node:path';
import { chromium } from 'playwright-core';

const wrong = [];
export function expect(holds, what) {
  console.log(`${holds ? 'ok' : 'NOT'}: ${what}`);
  if (!holds) wrong.push(what);
}

export function endWithVerdict() {
  if (wrong.length === 0) return;
  console.error(`${wrong.length} wrong:\n${wrong.join('\n')}`);
  process.exit(1);
}

// Each width and each colour scheme once: they know nothing of each other.
export const looks = [
  ['desktop-light', { viewport: { width: 1280, height: 900 }, colorScheme: 'light' }],
  ['narrow-dark', { viewport: { width: 400, height: 800 }, colorScheme: 'dark' }],
];

// WebGL is drawn in software. The page itself is not rasterised by way of that too: 8000 rows of it took up to 33 s there
// on a machine that others use, 2.4 s without.
export const launch = (program) => chromium.launch({
  executablePath: program,
  timeout: 0,
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-gpu-rasterization',
    '--disable-dev-shm-usage'],
});

/// `ready` runs in the page and says when it is there. Whatever the page says or asks for is kept.
export async function open(browser, look, file, ready) {
  const context = await browser.newContext({ offline: true, ...look });
  context.setDefaultTimeout(0);
  const page = await context.newPage();
  const said = [], asked = [];
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) said.push(message.text());
  });
  page.on('dialog', (dialog) => {
    said.push(`dialog: ${dialog.message()}`);
    dialog.dismiss();
  });
  page.on('pageerror', (error) => said.push(String(error)));
  page.on('request', (request) => {
    if (/^(https?|wss?|ftp):/.test(request.url())) asked.push(request.url());
  });
  await page.goto(pathToFileURL(resolve(file)).href);
  await page.waitForFunction(ready);
  return { page, said, asked };
}

/// What holds of every page.
export async function expectQuiet(page, said, asked) {
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
  expect(wide <= 0, `the page is no wider than the window (${wide})`);
  expect(said.length === 0, `the console is silent ${said.join(' | ')}`);
  expect(asked.length === 0, `nothing is asked of a network ${asked.join(' ')}`);
}

/// On paper every page is dark on white and without things to press.
export async function expectPrintable(page) {
  await page.emulateMedia({ media: 'print' });
  const seen = await page.evaluate(() => ({
    paper: [document.body, ...document.querySelectorAll('section')].map((part) => getComputedStyle(part).backgroundColor),
    ink: getComputedStyle(document.querySelector('h1')).color,
    pressed: [...document.querySelectorAll('button, input')].filter((part) => part.checkVisibility()).length,
  }));
  expect(seen.paper.every((color) => color === 'rgb(255, 255, 255)'), `paper is white (${[...new Set(seen.paper)]})`);
  expect(seen.ink === 'rgb(0, 0, 0)', `ink is black (${seen.ink})`);
  expect(seen.pressed === 0, `no button is printed (${seen.pressed})`);
  await page.emulateMedia({ media: null });
}

/// Not more than software graphics can hold in one piece.
export async function photograph(page, path) {
  const size = await page.evaluate(() => [window.innerWidth, document.documentElement.scrollHeight]);
  await page.screenshot({ path, fullPage: true, clip: { x: 0, y: 0, width: size[0], height: Math.min(8000, size[1]) } });
}
