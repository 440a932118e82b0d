// From dark blue over red to orange, evenly growing in lightness: readable without colour vision.

const STOPS = [
  [0x0d, 0x08, 0x87], [0x46, 0x03, 0x9f], [0x72, 0x01, 0xa8], [0x9c, 0x17, 0x9e], [0xbd, 0x37, 0x86],
  [0xd8, 0x57, 0x6b], [0xed, 0x79, 0x53], [0xfb, 0x9f, 0x3a], [0xfd, 0xca, 0x26], [0xf0, 0xf9, 0x21],
];

const END = 0.8;  // of the stops: what is paler drowns on bone

export const SLACK = [0.62, 0.64, 0.66];

/// Red, green and blue (0 to 1, sRGB) at a place between 0 and 1.
export function colorAt(place) {
  const x = Math.min(1, Math.max(0, place)) * END * (STOPS.length - 1);
  const i = Math.min(Math.floor(x), STOPS.length - 2);
  return [0, 1, 2].map((k) => (STOPS[i][k] + (x - i) * (STOPS[i + 1][k] - STOPS[i][k])) / 255);
}

export function cssGradient() {
  const stops = [0, 1, 2, 3, 4, 5, 6, 7, 8].map((i) => {
    const rgb = colorAt(i / 8).map((part) => Math.round(255 * part));
    return `rgb(${rgb.join(' ')}) ${(100 * i) / 8}%`;
  });
  return `linear-gradient(to right, ${stops.join(', ')})`;
}
