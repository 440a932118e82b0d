// Ligaments and contacts are picked: in the list, by keyboard and in the view; their curves follow the slider.

import { expect } from './browser_page.mjs';

const shown = (page) => page.evaluate(() => {
  const panel = document.querySelector('#viewer .picked');
  return {
    open: !panel.hidden,
    title: panel.querySelector('h3')?.textContent ?? '',
    captions: [...panel.querySelectorAll('figcaption strong')].map((caption) => caption.textContent),
    marks: [...panel.querySelectorAll('circle.now')].map((mark) => mark.getAttribute('cx')),
    points: [...panel.querySelectorAll('path.line')].map((line) => line.getAttribute('d').split(/[ML]/).length - 1),
    letters: [...panel.querySelectorAll('text')].map((text) => text.textContent),
    numbers: [...panel.querySelectorAll('.number')].map((number) => number.textContent),
    pressed: [...document.querySelectorAll('#viewer .pick [aria-pressed=true]')].map((button) => button.textContent),
  };
});

const slide = (page, to) => page.evaluate((at) => window.condyleViewer.show(at), to);

async function pickInTheList(page) {
  const data = await page.evaluate(() => JSON.parse(document.getElementById('viewer-data').textContent));
  const ligament = data.ligaments[0], poses = data.times.length;
  const button = page.locator('#viewer .pick button', { hasText: ligament.name }).first();
  await button.focus();
  await page.keyboard.press('Enter');
  await slide(page, 0);
  const first = await shown(page);
  expect(first.open && first.title === `ligament ${ligament.name}`, `a key picks "${first.title}"`);
  expect(first.pressed.length === 1 && first.pressed[0] === ligament.name, 'its button is pressed');
  expect(first.captions.join() === 'force,strain,length', `curves of ${first.captions}`);
  expect(first.points.every((count) => count === poses), `each curve has ${poses} points (${first.points})`);
  expect(first.letters.some((text) => text === `${data.swept.name} [${data.swept.units}]`), 'the axis has its unit');
  const force = Number(first.numbers[0].split(' ')[0]);
  expect(Math.abs(force - ligament.force[0]) <= 0.01 * Math.abs(ligament.force[0]), `the force is told: ${first.numbers[0]}`);
  await slide(page, poses - 1);
  const last = await shown(page);
  expect(last.marks.every((mark, i) => Number(mark) > Number(first.marks[i])), 'the marks move with the pose');
  const hostile = data.ligaments.at(-1).name;
  await page.evaluate((name) => window.condyleViewer.pick({ kind: 'ligament', name }), hostile);
  expect(hostile.includes('<img') && (await shown(page)).title === `ligament ${hostile}`, `a name is a text: ${hostile}`);
  await page.keyboard.press('Escape');
  const none = await shown(page);
  expect(!none.open && none.pressed.length === 0, 'Escape picks none');
}

async function clickAt(page, choice) {
  const place = await page.evaluate((what) => window.condyleViewer.placeOf(what), choice);
  await page.mouse.click(...place);
  const picked = await page.evaluate(() => window.condyleViewer.picked);
  return picked !== null && picked.kind === choice.kind && picked.name === choice.name;
}

async function pickInTheView(page) {
  const { ligaments, contacts } = await page.evaluate(() => {
    const data = JSON.parse(document.getElementById('viewer-data').textContent);
    return { ligaments: data.ligaments.map((l) => l.name), contacts: data.contacts.map((c) => c.name) };
  });
  await slide(page, 0);
  await page.locator('#viewer canvas').scrollIntoViewIfNeeded();
  const met = new Set();
  for (const view of ['medial', 'lateral', 'posterior']) {
    await page.locator('#viewer .views button', { hasText: view }).click();
    await page.locator('#viewer canvas').scrollIntoViewIfNeeded();
    for (const name of ligaments) if (await clickAt(page, { kind: 'ligament', name })) met.add(name);
  }
  expect(met.size >= ligaments.length / 2, `clicks pick ${met.size} of ${ligaments.length} ligaments (others are behind them)`);
  await page.locator('#viewer .views button', { hasText: 'plateau' }).click();
  for (const name of contacts) expect(await clickAt(page, { kind: 'contact', name }), `a click picks contact ${name}`);
  expect((await shown(page)).captions[0] === 'force', 'its force is shown');
  const corner = await page.evaluate(() => {
    const frame = document.querySelector('#viewer canvas').getBoundingClientRect();
    return [frame.left + 3, frame.top + 3];
  });
  await page.mouse.click(...corner);
  expect(!(await shown(page)).open, 'a click beside the knee picks none');
  await page.locator('#viewer .views button', { hasText: 'anterior' }).click();
}

/// Leaves one picked, for the picture.
export async function pickElements(page, by_mouse) {
  await pickInTheList(page);
  if (by_mouse) await pickInTheView(page);
  await slide(page, 8);
  await page.locator('#viewer .pick button').first().click();
}
