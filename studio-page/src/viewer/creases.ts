/** The edges of a triangle mesh that a draughtsman would draw: where the surface bends or ends. */

const QUANTUM = 1e-5;
const REACH = 1 << 16;

/**
 * Segments [x y z x y z] x N of the edges where two faces meet at more than `angle` (radians), or where a face ends.
 * Vertices nearer than a hundred-thousandth of the shape's size are one; faces may be turned either way.
 */
export function creases(positions: Float32Array, indices: Uint32Array, angle = (30 * Math.PI) / 180): Float32Array {
  const welded = weld(positions);
  const cosine = Math.cos(angle);
  const count = positions.length / 3;
  const edges = new Map<number, { a: number; b: number; normal: Normal; drawn: boolean; faces: number }>();
  for (let face = 0; face < indices.length; face += 3) {
    const corners = [indices[face]!, indices[face + 1]!, indices[face + 2]!] as const;
    const normal = faceNormal(positions, corners);
    if (!normal) continue;
    for (let k = 0; k < 3; k++) {
      const a = corners[k]!;
      const b = corners[(k + 1) % 3]!;
      const [low, high] = welded[a]! < welded[b]! ? [welded[a]!, welded[b]!] : [welded[b]!, welded[a]!];
      if (low === high) continue;
      const key = low * count + high;
      const edge = edges.get(key);
      if (!edge) edges.set(key, { a, b, normal, drawn: true, faces: 1 });
      else {
        const bend = Math.abs(dot(edge.normal, normal));
        edge.drawn = edge.faces === 1 ? bend < cosine : edge.drawn || bend < cosine;
        edge.faces++;
      }
    }
  }
  const drawn = [...edges.values()].filter((edge) => edge.drawn);
  const segments = new Float32Array(drawn.length * 6);
  drawn.forEach(({ a, b }, i) => {
    segments.set(positions.subarray(3 * a, 3 * a + 3), 6 * i);
    segments.set(positions.subarray(3 * b, 3 * b + 3), 6 * i + 3);
  });
  return segments;
}

type Normal = readonly [number, number, number];

/** For each vertex, the first vertex at the same place. */
function weld(positions: Float32Array): Uint32Array {
  const first = new Map<number, number>();
  const welded = new Uint32Array(positions.length / 3);
  const unit = QUANTUM * Math.max(1, extent(positions));
  for (let i = 0; i < welded.length; i++) {
    let key = 0;
    for (let k = 0; k < 3; k++) key = key * 2 * REACH + Math.round(positions[3 * i + k]! / unit) + REACH;
    const known = first.get(key);
    if (known === undefined) first.set(key, i);
    welded[i] = known ?? i;
  }
  return welded;
}

function extent(positions: Float32Array): number {
  let largest = 0;
  for (const value of positions) largest = Math.max(largest, Math.abs(value));
  return 2 * largest;
}

function faceNormal(p: Float32Array, [a, b, c]: readonly [number, number, number]): Normal | null {
  const u = [0, 1, 2].map((k) => p[3 * b + k]! - p[3 * a + k]!) as [number, number, number];
  const v = [0, 1, 2].map((k) => p[3 * c + k]! - p[3 * a + k]!) as [number, number, number];
  const n: Normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  const length = Math.hypot(...n);
  return length > 1e-14 ? [n[0] / length, n[1] / length, n[2] / length] : null;
}

function dot(a: Normal, b: Normal): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
