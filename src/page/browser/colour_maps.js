// Colour maps: evenly spaced stops with linear interpolation. viridis equals the colour map of `--picture`.

const kStops = {
  viridis: '440154472d7b3b528b2c728e21918c28ae805ec962addc30fde725',
  cividis: '00224e002e6a1a386f32436d434e6c535a6d61656f6f70737d7c788c88789b9476aba072bcae6ccdbb63dec958f0d846fee838',
  turbo: '30123b4040a2466be34294ff28bceb18ddc232f2986dfe62a4fc3ccdec34eecf3afdac34fb7e21eb500ed02f05a916017a0403',
  grey: '141414fafafa',
  // Blue to red, for differences of two meshes only.
  difference: '2166ac67a9cfd1e5f0f7f7f7fddbc7ef8a62b2182b',
};
export const kColourMapNames = ['viridis', 'cividis', 'turbo', 'grey'];

const kLabelStops = '4e79a7f28e2b59a14fe1575976b7b2edc948b07aa19c755fff9da78cd17da0cbe879706e';
const kFlagStops = 'c9ced62b5fb0';

const stopsOf = (hex) => hex.match(/.{6}/g).map(packedColour);

/** Packs "rrggbb" into a number whose bytes in memory are R, G, B, 255. */
export function packedColour(hex) {
  const value = parseInt(hex, 16);
  return (0xff000000 | (value & 255) << 16 | (value & 0xff00) | value >> 16) >>> 0;
}

export const cssColour = (packed) => `rgb(${packed & 255},${packed >> 8 & 255},${packed >> 16 & 255})`;

export const kAlarmColour = packedColour('d3231b'), kRestColour = packedColour('c4c6ca');
/** Colours of thin faces behind a grey face, and of thin faces that do not count. */
export const kBehindColour = packedColour('cb8986'), kUncountedColour = (packedColour('e0912b') & 0x80ffffff) >>> 0;  // Half as bright a glow.
/** Colours of parts by number, as in files and pictures: twelve colours, then darker copies. */
const kPartColours = [1, 0.75, 0.75 ** 2, 0.75 ** 3].flatMap((light) => stopsOf(kLabelStops).map((colour) => {
  const darker = (shift) => Math.round(light * (colour >> shift & 255)) << shift;
  return (0xff000000 | darker(0) | darker(8) | darker(16)) >>> 0;
}));
export const colourOfPart = (part) => kPartColours[part % kPartColours.length];
export const kFlagColours = stopsOf(kFlagStops);

/** A colour map as 256 packed colours. */
export function colourTable(name) {
  const stops = stopsOf(kStops[name]);
  return Uint32Array.from({ length: 256 }, (_, i) => {
    const position = i / 255 * (stops.length - 1), below = Math.min(Math.floor(position), stops.length - 2);
    const mixed = (shift) => {
      const from = stops[below] >> shift & 255, to = stops[below + 1] >> shift & 255;
      return Math.round(from + (to - from) * (position - below)) << shift;
    };
    return 0xff000000 | mixed(0) | mixed(8) | mixed(16);
  });
}

/** Index of a value in a table of 256 colours; 128 if the range is empty. */
export function tableIndex(value, low, high) {
  if (!(high > low)) return 128;
  return Math.round(Math.min(Math.max((value - low) / (high - low), 0), 1) * 255);
}
