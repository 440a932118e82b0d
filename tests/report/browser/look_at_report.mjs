// node look_at_report.mjs CHROMIUM PAGE.html PICTURES
// Opens a report in Chromium without a head and without a network: nothing may be asked for and nothing go wrong, the
// slider has to turn the knee, the canvas has to show it, and what is picked has to show its curves. Writes what it saw
// into the folder PICTURES. Each step waits for its event as long as the whole test may last: how long one takes is that of
// the machine.

import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { endWithVerdict, expect, expectPrintable, expectQuiet, launch, looks, open, photograph } from './browser_page.mjs';
import { pickElements } from './picking.mjs';

const [program, page_file, folder] = process.argv.slice(2);
const isReady = () => window.condyleViewer || document.querySelector('#viewer')?.hidden === false;

// Runs in the page: how many pixels of the canvas are drawn on, and how many colours they have.
function canvasFacts() {
  const canvas = document.querySelector('#viewer canvas');
  const flat = document.createElement('canvas');
  flat.width = canvas.width;
  flat.height = canvas.height;
  const context = flat.getContext('2d');
  context.drawImage(canvas, 0, 0);
  const pixels = context.getImageData(0, 0, flat.width, flat.height).data;
  let drawn = 0, sum = 0;
  const colors = new Set();
  for (let i = 0; i < pixels.length; i += 4) {
    if (pixels[i + 3] === 0) continue;
    ++drawn;
    colors.add((pixels[i] >> 4) * 256 + (pixels[i + 1] >> 4) * 16 + (pixels[i + 2] >> 4));
    sum = (sum * 31 + pixels[i] + 7 * pixels[i + 1] + 13 * pixels[i + 2]) % 1000000007;
  }
  return { share: drawn / (pixels.length / 4), colors: colors.size, sum };
}

const kneeMatrix = () => {
  const data = JSON.parse(document.getElementById('viewer-data').textContent);
  return window.condyleViewer.bodyMatrix(data.moving);
};
async function slideTo(page, share) {
  await page.evaluate((part) => {
    const slider = document.querySelector('#viewer input.poses');
    slider.value = part * Number(slider.max);
    slider.dispatchEvent(new Event('input', { bubbles: true }));
  }, share);
}
const angleBetween = (a, b) => {  // of two rotations, as 4 x 4 matrices by columns [deg]
  let trace = 0;
  for (const i of [0, 1, 2, 4, 5, 6, 8, 9, 10]) trace += a[i] * b[i];
  return (Math.acos(Math.min(1, Math.max(-1, (trace - 1) / 2))) * 180) / Math.PI;
};

/// The view opens on the joint: all of it in the window, and filling most of it one way.
async function opensOnTheJoint(page) {
  const seen = await page.evaluate(() => window.condyleViewer.jointInWindow());
  const wide = (seen.right - seen.left) / 2, high = (seen.top - seen.bottom) / 2;
  expect(Math.min(seen.left, seen.bottom) > -1.05 && Math.max(seen.right, seen.top) < 1.05, 'the joint is in the window');
  expect(Math.max(wide, high) > 0.65, `it fills ${(100 * wide).toFixed(0)} % of the width, ${(100 * high).toFixed(0)} % of the height`);
}

async function turnTheKnee(page) {
  const last = await page.evaluate(() => {
    const data = JSON.parse(document.getElementById('viewer-data').textContent);
    return { swept: data.swept, values: data.swept.values };
  });
  const before = await page.evaluate(kneeMatrix), shown = await page.evaluate(canvasFacts);
  expect(before.length === 16, 'the moving body is in the scene');
  expect(shown.share > 0.03 && shown.colors > 20, `the canvas shows something (${(100 * shown.share).toFixed(0)} %)`);
  await slideTo(page, 1);
  const after = await page.evaluate(kneeMatrix), moved = await page.evaluate(canvasFacts);
  const turned = angleBetween(before, after), swept = Math.abs(last.values.at(-1) - last.values[0]);
  if (last.swept.units === 'deg')
    expect(Math.abs(turned - swept) < 25, `the slider turns the knee by ${turned.toFixed(1)} of ${swept} deg`);
  else
    expect(before.some((x, i) => Math.abs(x - after[i]) > 1e-6), 'the slider moves the knee');
  expect(shown.sum !== moved.sum, 'the picture changes with the slider');
  const label = await page.textContent('#viewer output');
  expect(label.includes(last.values.at(-1).toFixed(last.swept.digits)), `the label says "${label}"`);
}

async function useButtons(page) {
  const sums = new Set();
  for (const button of await page.$$('#viewer .views button')) {
    await button.click();
    sums.add((await page.evaluate(canvasFacts)).sum);
  }
  expect(sums.size === 5, 'five views differ');
  await page.click('#viewer .views button >> nth=0');
  const all = await page.evaluate(canvasFacts);
  const toggle = page.locator('#viewer .toggles input[type=checkbox]').first();
  await toggle.click();
  const less = await page.evaluate(canvasFacts);
  expect(less.share < all.share, 'a body can be hidden');
  await toggle.click();
  await slideTo(page, 0);
  await page.click('#viewer button.play');
  await page.waitForFunction(() => window.condyleViewer.at > 0);
  await page.click('#viewer button.play');
  expect(true, 'the play button plays');
}

mkdirSync(folder, { recursive: true });
const browser = await launch(program);
try {
  for (const [name, look] of looks) {
    console.log(name);
    const { page, said, asked } = await open(browser, look, page_file, isReady);
    await opensOnTheJoint(page);
    if (name === 'desktop-light') {
      await turnTheKnee(page);
      await useButtons(page);
    }
    await slideTo(page, 0.4);
    await pickElements(page, name.startsWith('desktop'));
    await photograph(page, join(folder, `${name}.png`));
    const seen = await page.evaluate(canvasFacts);
    expect(seen.share > 0.03, 'the canvas is not blank');
    await expectQuiet(page, said, asked);
    await expectPrintable(page);
    await page.evaluate(() => {
      for (const id of ['view', 'pictures', 'plots']) document.getElementById(id)?.remove();
      for (const fold of document.querySelectorAll('details')) fold.open = true;
    });
    await photograph(page, join(folder, `${name}-tables.png`));
    await page.context().close();
  }
} finally {
  await browser.close();
}
endWithVerdict();
