// Which ligament or contact is picked: by a click in the view, or in the list below it by keyboard; its curves stand
// below the list. Escape picks none.

import { drawCurve } from './curves.js';

// What an element may have a number of at each pose, in the order of its curves.
const QUANTITIES = [
  { key: 'force', name: 'force', units: 'N', factor: 1, zero: true },
  { key: 'strain', name: 'strain', units: '%', factor: 100, zero: false },
  { key: 'length', name: 'length', units: 'mm', factor: 1, zero: false },
  { key: 'area', name: 'area', units: 'mm²', factor: 1, zero: true },
  { key: 'pressure', name: 'greatest pressure', units: 'MPa', factor: 1, zero: true },
];
const CLICK = 6;  // pixels that a pointer may move between down and up

const made = (name, properties, ...children) => {
  const element = Object.assign(document.createElement(name), properties);
  element.append(...children);
  return element;
};

/// Of each pose: is it a result, and are poses missing before it?
function breaks(data) {
  return data.times.map((_, i) => (data.alarms[i] ? 'no result' : i > 0 && data.missing[i - 1] > 0 ? 'after a gap' : ''));
}

function curvesOf(item, data) {
  const units = data.swept.units ? ` [${data.swept.units}]` : '';
  const known = QUANTITIES.filter(({ key }) => item[key] && !(key === 'strain' && !item.has_strain));
  return known.flatMap((quantity) => {
    const ys = item[quantity.key].map((value) => (value === null ? null : quantity.factor * value));
    const what = `${item.name}: ${quantity.name} [${quantity.units}] over ${data.swept.name}${units}`;
    const curve = drawCurve({ xs: data.swept.values, ys, broken: breaks(data), xLabel: data.swept.name + units, what, zero: quantity.zero });
    return curve === null ? [] : [{ ...quantity, ys, ...curve }];
  });
}

/// The pose shown, in words and as a mark in each curve.
function follow(curves, scene, data, at) {
  const place = scene.number(data.swept.values, at);
  for (const curve of curves) {
    const value = scene.number(curve.ys, at);
    curve.mark(place, value);
    curve.now.textContent = value === null ? '-' : `${Number(value.toPrecision(3))} ${curve.units}`;
  }
}

function panelOf(choice, curves, clear) {
  const title = made('h3', { textContent: `${choice.kind} ${choice.name}` });
  const close = made('button', { type: 'button', textContent: 'clear (Esc)' });
  close.addEventListener('click', clear);
  const figures = curves.map((curve) => {
    curve.now = made('span', { className: 'number' });
    const caption = made('figcaption', {}, made('strong', { textContent: curve.name }), ` [${curve.units}] `, curve.now);
    return made('figure', { className: 'small' }, caption, curve.svg);
  });
  return [made('div', { className: 'line' }, title, close), made('div', { className: 'smalls' }, ...figures)];
}

/// A click, and not the end of turning the knee.
function onClick(canvas, action) {
  let down = null;
  canvas.addEventListener('pointerdown', (event) => { down = event.isPrimary ? [event.clientX, event.clientY] : null; });
  canvas.addEventListener('pointerup', (event) => {
    if (down !== null && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < CLICK) action(event.clientX, event.clientY);
    down = null;
  });
}

/// The name of what lies below the pointer.
function onHover(canvas, scene) {
  let waiting = false;
  canvas.addEventListener('pointermove', (event) => {
    if (waiting || event.buttons !== 0 || event.pointerType !== 'mouse') return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      const choice = scene.elementAt(event.clientX, event.clientY);
      canvas.style.cursor = choice ? 'pointer' : '';
      canvas.title = choice ? `${choice.kind} ${choice.name}` : '';
    });
  });
}

export function createPicking(place, scene, data) {
  const list = place.querySelector('.pick'), panel = place.querySelector('.picked'), canvas = place.querySelector('canvas');
  const items = [['ligament', data.ligaments], ['contact', data.contacts]].flatMap(([kind, all]) =>
    all.map((item) => ({ kind, name: item.name, item })));
  if (items.length === 0) return;
  let curves = [];
  const same = (a, b) => a !== null && b !== null && a.kind === b.kind && a.name === b.name;
  scene.pick = (choice) => {
    const picked = choice === null ? null : items.find((entry) => same(entry, choice)) ?? null;
    scene.picked = picked && { kind: picked.kind, name: picked.name };
    for (const entry of items) entry.button.setAttribute('aria-pressed', String(entry === picked));
    curves = picked ? curvesOf(picked.item, data) : [];
    panel.replaceChildren(...(picked ? panelOf(picked, curves, () => scene.pick(null)) : []));
    panel.hidden = picked === null;
    scene.highlight(scene.picked);
    follow(curves, scene, data, scene.at);
  };
  for (const kind of ['ligament', 'contact']) {
    const of_kind = items.filter((entry) => entry.kind === kind);
    if (of_kind.length === 0) continue;
    list.append(made('span', { textContent: `${kind}s` }));
    for (const entry of of_kind) {
      entry.button = made('button', { type: 'button', textContent: entry.name });
      entry.button.addEventListener('click', () => scene.pick(same(scene.picked, entry) ? null : entry));
      list.append(entry.button);
    }
  }
  list.hidden = false;
  onClick(canvas, (x, y) => scene.pick(scene.elementAt(x, y)));
  onHover(canvas, scene);
  document.addEventListener('keydown', (event) => {
    if (event.key === 'Escape' && scene.picked) scene.pick(null);
  });
  scene.listeners.push((at) => follow(curves, scene, data, at));
  scene.pick(null);
}
