/** Animated pictures in the Graphics Interchange Format (GIF89a), of one table of colours for all of them. */

const BITS = 8;
const COLOURS = 1 << BITS;
/** Bits of each channel by which colours are told apart when the table is chosen. */
const FINE = 5;

export interface Gif {
  /** Add a picture. rgba: (height, width, 4) */
  add(rgba: Uint8ClampedArray): void;
  end(): Blob;
}

/** first: a picture whose colours are those of all. delay: seconds between two pictures; they repeat for ever. */
export function gif(width: number, height: number, first: Uint8ClampedArray, delay: number): Gif {
  const table = chosenColours(first);
  const nearest = new Int16Array(1 << (3 * FINE)).fill(-1);
  const parts: Uint8Array<ArrayBuffer>[] = [header(width, height, table)];
  return {
    add(rgba) {
      const pixels = new Uint8Array(width * height);
      for (let i = 0; i < pixels.length; i++) {
        const key = keyOf(rgba, 4 * i);
        if (nearest[key]! < 0) nearest[key] = nearestColour(table, rgba, 4 * i);
        pixels[i] = nearest[key]!;
      }
      parts.push(control(delay), descriptor(width, height), blocks(compressed(pixels)));
    },
    end: () => new Blob([...parts, Uint8Array.of(0x3b)], { type: "image/gif" }),
  };
}

const keyOf = (rgba: Uint8ClampedArray, at: number): number =>
  ((rgba[at]! >> 3) << 10) | ((rgba[at + 1]! >> 3) << 5) | (rgba[at + 2]! >> 3);

/** (256, 3): boxes of colours are cut in two, always the one with the most pixels that has more than one. */
function chosenColours(rgba: Uint8ClampedArray): Uint8Array {
  const pixels = new Map<number, number>();
  for (let at = 0; at < rgba.length; at += 4) {
    const key = keyOf(rgba, at);
    pixels.set(key, (pixels.get(key) ?? 0) + 1);
  }
  const channel = (key: number, k: number) => (key >> (10 - 5 * k)) & 31;
  const weight = (box: number[]) => box.reduce((sum, key) => sum + pixels.get(key)!, 0);
  const boxes = [{ keys: [...pixels.keys()], weight: rgba.length / 4 }];
  while (boxes.length < COLOURS) {
    const wide = boxes.filter(({ keys }) => keys.length > 1).sort((a, b) => b.weight - a.weight)[0];
    if (!wide) break;
    const spans = [0, 1, 2].map((k) => {
      const values = wide.keys.map((key) => channel(key, k));
      return Math.max(...values) - Math.min(...values);
    });
    const along = spans.indexOf(Math.max(...spans));
    wide.keys.sort((a, b) => channel(a, along) - channel(b, along));
    const half = wide.keys.splice(wide.keys.length >> 1);
    wide.weight = weight(wide.keys);
    boxes.push({ keys: half, weight: weight(half) });
  }
  const table = new Uint8Array(3 * COLOURS);
  boxes.forEach(({ keys, weight: all }, i) => {
    for (let k = 0; k < 3; k++) {
      const sum = keys.reduce((total, key) => total + channel(key, k) * pixels.get(key)!, 0);
      table[3 * i + k] = Math.round((sum / all) * (255 / 31));
    }
  });
  return table;
}

function nearestColour(table: Uint8Array, rgba: Uint8ClampedArray, at: number): number {
  let [best, found] = [Infinity, 0];
  for (let i = 0; i < COLOURS; i++) {
    let off = 0;
    for (let k = 0; k < 3; k++) off += (table[3 * i + k]! - rgba[at + k]!) ** 2;
    if (off < best) [best, found] = [off, i];
  }
  return found;
}

const word = (value: number) => [value & 255, value >> 8];

function header(width: number, height: number, table: Uint8Array): Uint8Array<ArrayBuffer> {
  const text = (of: string) => [...of].map((letter) => letter.charCodeAt(0));
  const screen = [...word(width), ...word(height), 0x80 | 0x70 | (BITS - 1), 0, 0];
  const forever = [0x21, 0xff, 11, ...text("NETSCAPE2.0"), 3, 1, 0, 0, 0];
  return Uint8Array.from([...text("GIF89a"), ...screen, ...table, ...forever]);
}

const control = (delay: number) => Uint8Array.from([0x21, 0xf9, 4, 4, ...word(Math.round(100 * delay)), 0, 0]);
const descriptor = (width: number, height: number) =>
  Uint8Array.from([0x2c, 0, 0, 0, 0, ...word(width), ...word(height), 0]);

/** Lempel, Ziv and Welch's code, of 9 to 12 bits a word. */
function compressed(pixels: Uint8Array): Uint8Array {
  const [clear, end] = [COLOURS, COLOURS + 1];
  const out = new Uint8Array(pixels.length * 2 + 16);
  let [length, bits, held] = [0, 0, 0];
  let words = new Map<number, number>();
  let [size, next] = [BITS + 1, end + 1];
  const put = (code: number) => {
    held |= code << bits;
    for (bits += size; bits >= 8; bits -= 8, held >>>= 8) out[length++] = held & 255;
  };
  put(clear);
  let prefix = pixels[0]!;
  for (let i = 1; i < pixels.length; i++) {
    const key = (prefix << BITS) | pixels[i]!;
    const known = words.get(key);
    if (known !== undefined) {
      prefix = known;
      continue;
    }
    put(prefix);
    if (next === 4096) {
      put(clear);
      words = new Map();
      [size, next] = [BITS + 1, end + 1];
    } else {
      if (next === 1 << size) size++;
      words.set(key, next++);
    }
    prefix = pixels[i]!;
  }
  put(prefix);
  put(end);
  if (bits) out[length++] = held & 255;
  return out.subarray(0, length);
}

/** With the length of each block of 255 before it. */
function blocks(code: Uint8Array): Uint8Array<ArrayBuffer> {
  const count = Math.ceil(code.length / 255);
  const out = new Uint8Array(2 + code.length + count);
  out[0] = BITS;
  let at = 1;
  for (let from = 0; from < code.length; from += 255) {
    const part = code.subarray(from, from + 255);
    out[at] = part.length;
    out.set(part, at + 1);
    at += 1 + part.length;
  }
  return out;
}
