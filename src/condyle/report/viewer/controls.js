// Slider, play button, views, what is shown, and the words beside the knee.

import { colorAt, cssGradient, pressureColorAt } from './colors.js';
import { createPicking } from './picking.js';

const SECONDS = 6;  // of playing from end to end

function button(text, action) {
  const element = document.createElement('button');
  element.type = 'button';
  element.textContent = text;
  element.addEventListener('click', action);
  return element;
}

function addViews(bar, scene, data, toggles) {
  const medial = data.side === 'left' ? -1 : 1;  // x points to the person's left
  const named = data.side !== null;
  const moving = (name, visible) => {
    const toggle = toggles.get(name);
    if (toggle && toggle.checked !== visible) toggle.click();
  };
  const views = [
    [named ? 'anterior' : 'front', [0, 0, 1], true],
    [named ? 'medial' : 'right side', [medial, 0, 0], true],
    [named ? 'lateral' : 'left side', [-medial, 0, 0], true],
    [named ? 'posterior' : 'back', [0, 0, -1], true],
    [named ? 'plateau' : 'from above', [0, 1, 0.001], false],
  ];
  for (const [name, direction, femur] of views) {
    bar.append(button(name, () => {
      if (data.femur !== null) moving(data.femur, femur);
      scene.look(direction);
    }));
  }
}

function addToggles(bar, scene, data) {
  const toggles = new Map();
  for (const body of data.bodies) {
    const label = document.createElement('label');
    const box = document.createElement('input');
    box.type = 'checkbox';
    box.checked = true;
    box.addEventListener('change', () => scene.setVisible(body, box.checked));
    label.append(box, ' ' + body);
    bar.append(label);
    toggles.set(body, box);
  }
  const label = document.createElement('label');
  const slider = Object.assign(document.createElement('input'),
    { type: 'range', min: 0, max: 1, step: 0.05, value: 0.45 });
  slider.addEventListener('input', () => scene.setBoneOpacity(Number(slider.value)));
  label.append('opacity of bone ', slider);
  bar.append(label);
  return toggles;
}

function addMarks(marks, most, unit) {
  for (const part of [0, 0.5, 1]) {
    const mark = document.createElement('span');
    mark.textContent = `${Number((most * part).toPrecision(3))} ${unit}`;
    marks.append(mark);
  }
}

function addPressureLegend(place, data) {
  if (!data.pressure) return;
  place.hidden = false;
  place.querySelector('.scale').style.background = cssGradient(pressureColorAt);
  addMarks(place.querySelector('.marks'), data.pressure.top, 'MPa');
}

function addLegend(place, data) {
  if (data.ligaments.length === 0) {
    place.hidden = true;
    return;
  }
  place.querySelector('.scale').style.background = cssGradient(colorAt);
  const most = 100 * data.strain_top;
  const above = data.greatest_strain > data.strain_top * (1 + 1e-6);
  place.classList.toggle('above', above);  // an arrow at the end of the scale
  const marks = place.querySelector('.marks');
  addMarks(marks, most, '%');
  if (data.ligaments.some((ligament) => !ligament.has_strain)) place.querySelector('span').textContent += ', green where the law knows no strain';
  if (above) place.querySelector('span').textContent += `, some up to ${(100 * data.greatest_strain).toFixed(0)} %`;
}

function words(scene, data, at) {
  const number = (row, digits) => {
    const value = scene.number(row.values, at);
    return value === null ? '-' : value.toFixed(digits).replace(/^-(0\.?0*)$/, '$1');  // no minus before nothing
  };
  const rows = data.coordinates.map((row) => `${row.name} ${number(row, 1)} ${row.units}`);
  for (const contact of data.contacts)
    rows.push(`${contact.name} ${scene.number(contact.force, at)?.toFixed(0) ?? '-'} N`);
  return rows;
}

/// What must be known of a place between poses: a pose that is no result, or that poses are missing.
function alarm(data, at) {
  const before = Math.floor(at), nearest = Math.round(at);
  if (data.alarms[nearest]) return `\u26a0 ${data.alarms[nearest]}`;
  const missing = at > before ? data.missing[before] : 0;
  if (!missing) return '';
  return `\u26a0 ${missing} ${missing === 1 ? 'pose is' : 'poses are'} missing here: the knee is moved straight from the one before to the next`;
}

export function createControls(place, scene, data) {
  const slider = place.querySelector('input.poses');
  const label = place.querySelector('output');
  const list = place.querySelector('ul.coordinates');
  const warning = place.querySelector('.alarm');
  slider.max = data.times.length - 1;
  scene.listeners.push((at) => {
    slider.value = at;
    const swept = scene.number(data.swept.values, at);
    warning.textContent = alarm(data, at);
    warning.hidden = warning.textContent === '';
    label.textContent = `${data.swept.name} ${swept.toFixed(data.swept.digits)} ${data.swept.units}`;
    list.replaceChildren(...words(scene, data, at).map((text) => {
      const item = document.createElement('li');
      item.textContent = text;
      return item;
    }));
  });
  let playing = null;
  const stop = () => {
    cancelAnimationFrame(playing);
    playing = null;
    play.textContent = 'play';
  };
  const play = place.querySelector('button.play');
  play.addEventListener('click', () => {
    if (playing !== null) {
      stop();
      return;
    }
    const from = scene.at >= slider.max ? 0 : scene.at, start = performance.now();
    play.textContent = 'pause';
    const step = (now) => {
      const at = from + (slider.max * Math.max(0, now - start)) / (1000 * SECONDS);
      scene.show(Math.min(at, slider.max));
      if (at >= slider.max) stop();
      else playing = requestAnimationFrame(step);
    };
    playing = requestAnimationFrame(step);
  });
  slider.addEventListener('input', () => {
    if (playing !== null) stop();
    scene.show(Number(slider.value));
  });
  const toggles = addToggles(place.querySelector('.toggles'), scene, data);
  addViews(place.querySelector('.views'), scene, data, toggles);
  addLegend(place.querySelector('.legend'), data);
  addPressureLegend(place.querySelector('.pressures'), data);
  createPicking(place, scene, data);
  place.hidden = false;
  scene.resize();
  scene.look(data.side === null ? [0.3, 0.2, 1] : [data.side === 'left' ? -0.45 : 0.45, 0.15, 1]);
}
