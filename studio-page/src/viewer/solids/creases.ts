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
  const normals = faceNormals(positions, indices);
  // A table with open addressing: a million triangles have a million and a half edges.
  const table = new Int32Array(powerOfTwo(indices.length * 2)).fill(-1);
  const mask = table.length - 1;
  const [low, high] = [new Uint32Array(indices.length), new Uint32Array(indices.length)];
  const [from, to] = [new Uint32Array(indices.length), new Uint32Array(indices.length)];
  const first = new Uint32Array(indices.length); // the face that an edge was met at first
  const drawn = new Uint8Array(indices.length); // 2: one face only so far; 1: it is drawn
  let [count, kept] = [0, 0];
  for (let corner = 0; corner < indices.length; corner++) {
    const face = (corner / 3) | 0;
    if (Number.isNaN(normals[3 * face])) continue;
    const a = indices[corner]!;
    const b = indices[corner % 3 === 2 ? corner - 2 : corner + 1]!;
    const [u, v] = [Math.min(welded[a]!, welded[b]!), Math.max(welded[a]!, welded[b]!)];
    if (u === v) continue;
    let slot = mixed(u, v) & mask;
    while (table[slot]! >= 0 && (low[table[slot]!] !== u || high[table[slot]!] !== v)) slot = (slot + 1) & mask;
    const edge = table[slot]!;
    if (edge < 0) {
      table[slot] = count;
      [low[count], high[count], from[count], to[count], first[count], drawn[count]] = [u, v, a, b, face, 2];
      count++;
      kept++;
      continue;
    }
    const bends = Math.abs(dot(normals, first[edge]!, face)) < cosine;
    const was = drawn[edge]! > 0;
    drawn[edge] = (drawn[edge] === 2 ? bends : was || bends) ? 1 : 0;
    kept += (drawn[edge]! > 0 ? 1 : 0) - (was ? 1 : 0);
  }
  const segments = new Float32Array(kept * 6);
  let at = 0;
  for (let edge = 0; edge < count; edge++) {
    if (!drawn[edge]) continue;
    for (const end of [from[edge]!, to[edge]!]) {
      for (let k = 0; k < 3; k++) segments[at++] = positions[3 * end + k]!;
    }
  }
  return segments;
}

/** For each vertex, the first vertex at the same place. */
function weld(positions: Float32Array): Uint32Array {
  const welded = new Uint32Array(positions.length / 3);
  const table = new Int32Array(powerOfTwo(welded.length * 2)).fill(-1);
  const mask = table.length - 1;
  const cells = new Int32Array(positions.length);
  const unit = QUANTUM * Math.max(1, extent(positions));
  for (let i = 0; i < cells.length; i++) cells[i] = Math.round(positions[i]! / unit) + REACH;
  for (let i = 0; i < welded.length; i++) {
    const [x, y, z] = [cells[3 * i]!, cells[3 * i + 1]!, cells[3 * i + 2]!];
    let slot = mixed(mixed(x, y), z) & mask;
    for (let other = table[slot]!; other >= 0; other = table[slot]!) {
      if (cells[3 * other] === x && cells[3 * other + 1] === y && cells[3 * other + 2] === z) break;
      slot = (slot + 1) & mask;
    }
    if (table[slot]! < 0) table[slot] = i;
    welded[i] = table[slot]!;
  }
  return welded;
}

/** A number that says little of the two that it is made of: a place in a table. */
function mixed(a: number, b: number): number {
  let hash = Math.imul(a ^ 0x9e3779b9, 0x85ebca6b) ^ Math.imul(b + 0x165667b1, 0xc2b2ae35);
  hash = Math.imul(hash ^ (hash >>> 15), 0x27d4eb2f);
  return (hash ^ (hash >>> 13)) >>> 0;
}

function powerOfTwo(least: number): number {
  let size = 16;
  while (size < least) size *= 2;
  return size;
}

function extent(positions: Float32Array): number {
  let largest = 0;
  for (const value of positions) largest = Math.max(largest, Math.abs(value));
  return 2 * largest;
}

/** (F, 3), NaN for a face without an area. */
function faceNormals(p: Float32Array, indices: Uint32Array): Float32Array {
  const normals = new Float32Array(indices.length);
  for (let at = 0; at < indices.length; at += 3) {
    const [a, b, c] = [3 * indices[at]!, 3 * indices[at + 1]!, 3 * indices[at + 2]!];
    const [ux, uy, uz] = [p[b]! - p[a]!, p[b + 1]! - p[a + 1]!, p[b + 2]! - p[a + 2]!];
    const [vx, vy, vz] = [p[c]! - p[a]!, p[c + 1]! - p[a + 1]!, p[c + 2]! - p[a + 2]!];
    const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const length = Math.sqrt(x * x + y * y + z * z);
    const scale = length > 1e-14 ? 1 / length : NaN;
    normals[at] = x * scale;
    normals[at + 1] = y * scale;
    normals[at + 2] = z * scale;
  }
  return normals;
}

function dot(normals: Float32Array, a: number, b: number): number {
  return (
    normals[3 * a]! * normals[3 * b]! +
    normals[3 * a + 1]! * normals[3 * b + 1]! +
    normals[3 * a + 2]! * normals[3 * b + 2]!
  );
}
