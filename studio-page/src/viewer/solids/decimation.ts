/** Fewer triangles that look alike, for drawing: vertices in one cell of a grid become one of them. */

export interface Thinned {
  /** (V,) which vertices stay. */
  vertices: Uint32Array;
  /** (F, 3) into those that stay. */
  indices: Uint32Array;
  /** (F,) which face each one was. */
  faces: Uint32Array;
}

/** A closed surface has about two triangles for each cell that it crosses; it crosses more where it lies aslant. */
const TRIANGLES_A_CELL = 2.6;
const MOST_TRIES = 4;

/** About `most` triangles at most. */
export function thinned(positions: Float32Array, indices: Uint32Array, most: number): Thinned {
  let cell = Math.sqrt((TRIANGLES_A_CELL * area(positions, indices)) / most) || 1e-6;
  let found = clustered(positions, indices, cell);
  for (let i = 1; i < MOST_TRIES && found.faces.length > 1.15 * most; i++) {
    cell *= Math.sqrt(found.faces.length / most);
    found = clustered(positions, indices, cell);
  }
  return found;
}

function clustered(positions: Float32Array, indices: Uint32Array, cell: number): Thinned {
  const { cluster, count } = clusters(positions, cell);
  const vertices = nearestToMiddle(positions, cluster, count);
  const kept = new Uint32Array(indices.length);
  const faces = new Uint32Array(indices.length / 3);
  let face = 0;
  for (let at = 0; at < indices.length; at += 3) {
    const [a, b, c] = [cluster[indices[at]!]!, cluster[indices[at + 1]!]!, cluster[indices[at + 2]!]!];
    if (a === b || b === c || a === c) continue;
    kept[3 * face] = a;
    kept[3 * face + 1] = b;
    kept[3 * face + 2] = c;
    faces[face++] = at / 3;
  }
  return { vertices, indices: kept.slice(0, 3 * face), faces: faces.slice(0, face) };
}

/** (V,) the number of the cell that each vertex lies in, and how many there are. */
function clusters(positions: Float32Array, cell: number): { cluster: Uint32Array; count: number } {
  const cluster = new Uint32Array(positions.length / 3);
  let size = 1024;
  while (size < 2 * cluster.length) size *= 2;
  const table = new Int32Array(size).fill(-1);
  const owners = new Uint32Array(cluster.length); // a vertex of each cell
  const place = (i: number, k: number) => Math.floor(positions[3 * i + k]! / cell);
  let count = 0;
  for (let i = 0; i < cluster.length; i++) {
    const [x, y, z] = [place(i, 0), place(i, 1), place(i, 2)];
    let hash = Math.imul(x, 73856093) ^ Math.imul(y, 19349663) ^ Math.imul(z, 83492791);
    hash = Math.imul(hash ^ (hash >>> 15), 0x27d4eb2f);
    let slot = (hash ^ (hash >>> 13)) & (size - 1);
    for (let known = table[slot]!; known >= 0; known = table[slot]!) {
      const owner = owners[known]!;
      if (place(owner, 0) === x && place(owner, 1) === y && place(owner, 2) === z) break;
      slot = (slot + 1) & (size - 1);
    }
    if (table[slot]! < 0) {
      owners[count] = i;
      table[slot] = count++;
    }
    cluster[i] = table[slot]!;
  }
  return { cluster, count };
}

/** (count,) of the vertices of each cell the one that lies nearest to their mean. */
function nearestToMiddle(positions: Float32Array, cluster: Uint32Array, count: number): Uint32Array {
  const middle = new Float64Array(3 * count);
  const members = new Uint32Array(count);
  for (let i = 0; i < cluster.length; i++) {
    const of = cluster[i]!;
    members[of]!++;
    for (let k = 0; k < 3; k++) middle[3 * of + k]! += positions[3 * i + k]!;
  }
  const best = new Float64Array(count).fill(Infinity);
  const nearest = new Uint32Array(count);
  for (let i = 0; i < cluster.length; i++) {
    const of = cluster[i]!;
    let off = 0;
    for (let k = 0; k < 3; k++) off += (positions[3 * i + k]! - middle[3 * of + k]! / members[of]!) ** 2;
    if (off < best[of]!) {
      best[of] = off;
      nearest[of] = i;
    }
  }
  return nearest;
}

function area(p: Float32Array, indices: Uint32Array): number {
  let sum = 0;
  for (let at = 0; at < indices.length; at += 3) {
    const [a, b, c] = [3 * indices[at]!, 3 * indices[at + 1]!, 3 * indices[at + 2]!];
    const [ux, uy, uz] = [p[b]! - p[a]!, p[b + 1]! - p[a + 1]!, p[b + 2]! - p[a + 2]!];
    const [vx, vy, vz] = [p[c]! - p[a]!, p[c + 1]! - p[a + 1]!, p[c + 2]! - p[a + 2]!];
    sum += Math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2;
  }
  return sum;
}
