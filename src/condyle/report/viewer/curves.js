// A number over the poses as a small drawing (SVG), with a mark at the pose that is shown.

const WIDTH = 340, HEIGHT = 180, LEFT = 52, RIGHT = 12, TOP = 8, BOTTOM = 38;
const SPACE = 'http://www.w3.org/2000/svg';

function element(name, attributes, text) {
  const made = document.createElementNS(SPACE, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
}

/// Round values from low to high, about `most` of them.
function roundTicks(low, high, most) {
  const least = (high - low) / most, power = 10 ** Math.floor(Math.log10(least));
  const step = [1, 2, 5, 10].map((part) => part * power).find((size) => size >= least * (1 - 1e-9)) ?? least;
  const ticks = [];
  for (let n = Math.ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; ++n) ticks.push(n * step);
  return ticks;
}

const short = (value) => String(Number(value.toPrecision(6)));

/// The ends of an axis; never of no size.
function extent(values, zero) {
  const known = values.filter((value) => value !== null);
  if (known.length === 0) return null;
  let low = Math.min(...known), high = Math.max(...known);
  if (zero) [low, high] = [Math.min(low, 0), Math.max(high, 0)];
  if (high - low < 1e-9 * Math.max(1e-3, Math.abs(low), Math.abs(high))) {
    const room = low === 0 ? 1 : 0.1 * Math.abs(low);
    return [low - room, high + room];
  }
  return [low, high];
}

/// Poses that follow each other, as lists of their numbers; one that is no result, or that is missing, parts them.
function piecesOf(xs, ys, broken) {
  const pieces = [];
  let open = false;
  ys.forEach((value, i) => {
    if (value === null || xs[i] === null || broken[i] === 'no result') {
      open = false;
      return;
    }
    if (!open || broken[i] === 'after a gap') pieces.push([]);
    pieces.at(-1).push(i);
    open = true;
  });
  return pieces;
}

/// `xs` and `ys` by pose, null where there is no number; `broken` says of a pose 'no result' or 'after a gap'. Returns
/// the drawing and what moves its mark; nothing where there is no number.
export function drawCurve({ xs, ys, broken, xLabel, what, zero }) {
  const across = extent(xs, false), up = extent(ys, zero);
  if (across === null || up === null) return null;
  const end = WIDTH - RIGHT, floor = HEIGHT - BOTTOM;
  const x = (value) => LEFT + ((value - across[0]) / (across[1] - across[0])) * (end - LEFT);
  const y = (value) => floor + ((value - up[0]) / (up[1] - up[0])) * (TOP - floor);
  const pieces = piecesOf(xs, ys, broken), point = (i) => `${x(xs[i]).toFixed(1)} ${y(ys[i]).toFixed(1)}`;
  const svg = element('svg', { class: 'curves', viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: 'img', 'aria-label': what });
  for (const tick of roundTicks(...up, 4)) {
    svg.append(element('path', { class: 'grid', d: `M${LEFT} ${y(tick)}H${end}` }),
      element('text', { class: 'y', x: LEFT - 6, y: y(tick) + 4 }, short(tick)));
  }
  for (const tick of roundTicks(...across, 6)) {
    svg.append(element('path', { class: 'grid', d: `M${x(tick)} ${floor}V${TOP}` }),
      element('text', { class: 'x', x: x(tick), y: floor + 15 }, short(tick)));
  }
  svg.append(element('path', { class: 'axis', d: `M${LEFT} ${TOP}V${floor}H${end}` }),
    element('text', { class: 'x', x: (LEFT + end) / 2, y: HEIGHT - 6 }, xLabel),
    element('path', { class: 'line run1', d: pieces.map((piece) => 'M' + piece.map(point).join('L')).join('') }));
  const circle = (i, kind) => svg.append(element('circle', { class: `point run1${kind}`, cx: x(xs[i]), cy: y(ys[i]), r: 3 }));
  for (const piece of pieces) if (piece.length === 1) circle(piece[0], '');  // a point without neighbours is no line
  ys.forEach((value, i) => {
    if (value !== null && xs[i] !== null && broken[i] === 'no result') circle(i, ' hollow');
  });
  const line = element('path', { class: 'now' }), dot = element('circle', { class: 'now', r: 4.5 });
  svg.append(line, dot);
  const mark = (place, value) => {
    const shown = place !== null && value !== null;
    for (const part of [line, dot]) part.setAttribute('visibility', shown ? 'visible' : 'hidden');
    if (!shown) return;
    line.setAttribute('d', `M${x(place).toFixed(1)} ${TOP}V${floor}`);
    dot.setAttribute('cx', x(place).toFixed(1));
    dot.setAttribute('cy', y(value).toFixed(1));
  };
  return { svg, mark };
}
