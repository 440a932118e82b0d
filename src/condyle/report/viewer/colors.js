// From dark blue over red to orange, evenly growing in lightness: readable without colour vision.

const STOPS = [
  [0x0d, 0x08, 0x87], [0x46, 0x03, 0x9f], [0x72, 0x01, 0xa8], [0x9c, 0x17, 0x9e], [0xbd, 0x37, 0x86],
  [0xd8, 0x57, 0x6b], [0xed, 0x79, 0x53], [0xfb, 0x9f, 0x3a], [0xfd, 0xca, 0x26], [0xf0, 0xf9, 0x21],
];

// Pale to dark red, evenly falling in lightness.
const PRESSURE_STOPS = [
  [0xd9, 0xc0, 0xdd], [0xc9, 0x94, 0xc7], [0xdf, 0x65, 0xb0], [0xe7, 0x29, 0x8a], [0xce, 0x12, 0x56],
  [0x98, 0x00, 0x43], [0x67, 0x00, 0x1f],
];

const END = 0.8;  // of the stops: what is paler drowns on bone

export const SLACK = [0.62, 0.64, 0.66];
export const UNSTRAINED = [0.08, 0.48, 0.45];  // taut, of a law without slack length

function between(stops, place) {
  const x = Math.min(1, Math.max(0, place)) * (stops.length - 1);
  const i = Math.min(Math.floor(x), stops.length - 2);
  return [0, 1, 2].map((k) => (stops[i][k] + (x - i) * (stops[i + 1][k] - stops[i][k])) / 255);
}

/// Red, green and blue (0 to 1, sRGB) at a place between 0 and 1.
export const colorAt = (place) => between(STOPS, END * Math.min(1, Math.max(0, place)));
export const pressureColorAt = (place) => between(PRESSURE_STOPS, place);

export function cssGradient(colorOf) {
  const stops = [0, 1, 2, 3, 4, 5, 6, 7, 8].map((i) => {
    const rgb = colorOf(i / 8).map((part) => Math.round(255 * part));
    return `rgb(${rgb.join(' ')}) ${(100 * i) / 8}%`;
  });
  return `linear-gradient(to right, ${stops.join(', ')})`;
}
