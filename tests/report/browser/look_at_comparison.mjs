// node look_at_comparison.mjs CHROMIUM PAGE.html TITLE PICTURES
// Opens a comparison of two runs in Chromium: nothing of their names may run, curves of the runs have colours and dashes of
// their own, and the page fits every window.

import { join } from 'node:path';
import { endWithVerdict, expect, expectPrintable, expectQuiet, launch, looks, open, photograph } from './browser_page.mjs';

const [program, page_file, title, folder] = process.argv.slice(2);

/// Runs in the page: how the lines of each run look.
function lineFacts() {
  const lines = (run) => [...document.querySelectorAll(`svg.curves .run${run}.line`)].map((line) => {
    const style = getComputedStyle(line);
    return `${style.stroke} ${style.strokeDasharray}`;
  });
  const letters = [...document.querySelectorAll('svg.curves text')].map((text) => text.getBoundingClientRect().height);
  return { first: lines(1), second: lines(2), smallest: Math.min(...letters), h1: document.querySelector('h1').textContent };
}

const browser = await launch(program);
try {
  for (const [name, look] of looks) {
    console.log(`comparison ${name}`);
    const { page, said, asked } = await open(browser, look, page_file, () => document.readyState === 'complete');
    const seen = await page.evaluate(lineFacts);
    expect(seen.h1.startsWith(title), `the title is a text: ${seen.h1}`);
    expect(seen.first.length > 10 && seen.second.length === seen.first.length, `${seen.first.length} curves of each run`);
    const [a, b] = [new Set(seen.first), new Set(seen.second)];
    expect(a.size === 1 && b.size === 1 && [...a][0] !== [...b][0], `lines ${[...a]} and ${[...b]}`);
    expect(seen.smallest > 8, `letters are ${seen.smallest.toFixed(1)} pixels high`);
    await expectQuiet(page, said, asked);
    await expectPrintable(page);
    await photograph(page, join(folder, `comparison-${name}.png`));
    await page.context().close();
  }
} finally {
  await browser.close();
}
endWithVerdict();
