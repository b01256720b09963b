/**
 * An index of what lies where: triangles or segments in the order of a curve that fills space, and the boxes around runs
 * of them. What a pointer may touch is then found without a look at all of them.
 */

export interface Spatial {
  /** (N,) the number of each, along the curve. */
  order: Uint32Array;
  /** (B, 6) low and high corner of each box: those of runs of eight, then those of eight of these, and so on. */
  boxes: Float32Array;
  /** Where each level begins in `boxes`, in boxes; and the end. */
  levels: number[];
}

const RUN = 8;
const CELLS = 1024; // along each axis: ten bits of a place on the curve

/**
 * positions: (V, 3). corners: (N, size) indices of the vertices of each; null where they follow one another.
 */
export function indexed(positions: Float32Array, corners: Uint32Array | null, size: 2 | 3): Spatial {
  const count = corners ? corners.length / size : positions.length / (3 * size);
  const order = alongCurve(placesOnCurve(positions, corners, size, count));
  const levels = [0];
  let [width, total] = [count, 0];
  do {
    width = Math.ceil(width / RUN);
    total += width;
    levels.push(total);
  } while (width > 1);
  const boxes = new Float32Array(6 * total);
  for (let i = 0; i < boxes.length; i++) boxes[i] = i % 6 < 3 ? Infinity : -Infinity;
  for (let place = 0; place < count; place++) {
    const box = 6 * ((place / RUN) | 0);
    for (let j = 0; j < size; j++) {
      const at = size * order[place]! + j;
      const vertex = 3 * (corners ? corners[at]! : at);
      for (let k = 0; k < 3; k++) {
        const value = positions[vertex + k]!;
        if (value < boxes[box + k]!) boxes[box + k] = value;
        if (value > boxes[box + k + 3]!) boxes[box + k + 3] = value;
      }
    }
  }
  for (let level = 1; level < levels.length - 1; level++) {
    for (let below = levels[level - 1]!; below < levels[level]!; below++) {
      const above = 6 * (levels[level]! + (((below - levels[level - 1]!) / RUN) | 0));
      for (let k = 0; k < 3; k++) {
        boxes[above + k] = Math.min(boxes[above + k]!, boxes[6 * below + k]!);
        boxes[above + k + 3] = Math.max(boxes[above + k + 3]!, boxes[6 * below + k + 3]!);
      }
    }
  }
  return { order, boxes, levels };
}

/** Call `each` with what lies in boxes that are `wanted`, which gets the boxes and where one begins. */
export function visit(
  { order, boxes, levels }: Spatial,
  wanted: (boxes: Float32Array, at: number) => boolean,
  each: (number: number) => void,
): void {
  const down = (level: number, first: number, last: number): void => {
    for (let box = first; box < last; box++) {
      if (!wanted(boxes, 6 * (levels[level]! + box))) continue;
      const end = level === 0 ? order.length : levels[level]! - levels[level - 1]!;
      const [from, to] = [box * RUN, Math.min(end, (box + 1) * RUN)];
      if (level === 0) for (let place = from; place < to; place++) each(order[place]!);
      else down(level - 1, from, to);
    }
  };
  const top = levels.length - 2;
  if (order.length) down(top, 0, levels[top + 1]! - levels[top]!);
}

/** (N,) where the middle of each comes along the curve (Morton's). */
function placesOnCurve(p: Float32Array, corners: Uint32Array | null, size: number, count: number): Uint32Array {
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]]; // prettier-ignore
  for (let i = 0; i < p.length; i += 3) {
    for (let k = 0; k < 3; k++) {
      low[k] = Math.min(low[k]!, p[i + k]!);
      high[k] = Math.max(high[k]!, p[i + k]!);
    }
  }
  const scale = low.map((from, k) => (CELLS - 1) / (size * (high[k]! - from || 1)));
  const places = new Uint32Array(count);
  for (let i = 0; i < count; i++) {
    let place = 0;
    for (let k = 0; k < 3; k++) {
      let sum = 0;
      for (let j = 0; j < size; j++) {
        const at = size * i + j;
        sum += p[3 * (corners ? corners[at]! : at) + k]! - low[k]!;
      }
      place |= spread(sum * scale[k]!) << k;
    }
    places[i] = place;
  }
  return places;
}

/** The ten bits of a number, with room for two others between each two of them. */
function spread(value: number): number {
  let bits = Math.min(CELLS - 1, Math.max(0, value | 0));
  bits = (bits | (bits << 16)) & 0x030000ff;
  bits = (bits | (bits << 8)) & 0x0300f00f;
  bits = (bits | (bits << 4)) & 0x030c30c3;
  return (bits | (bits << 2)) & 0x09249249;
}

/** The numbers 0 to N in the order of their places: sorted by ten bits after ten. */
function alongCurve(places: Uint32Array): Uint32Array {
  let from = Uint32Array.from(places, (_, i) => i);
  let to = new Uint32Array(places.length);
  for (let shift = 0; shift < 30; shift += 10) {
    const starts = new Uint32Array(CELLS + 1);
    for (const place of places) starts[((place >>> shift) & (CELLS - 1)) + 1]!++;
    for (let i = 0; i < CELLS; i++) starts[i + 1]! += starts[i]!;
    for (const number of from) to[starts[(places[number]! >>> shift) & (CELLS - 1)]!++] = number;
    [from, to] = [to, from];
  }
  return from;
}
