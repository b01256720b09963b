/** A mesh made ready for the stage: what of it is drawn, and the indexes by which it is measured. */

import { creases } from "./creases";
import { thinned } from "./decimation";
import { indexed } from "./spatial";
import type { Spatial } from "./spatial";

export interface Triangles {
  /** (V, 3), normalised */
  positions: Float32Array;
  /** (F, 3) */
  indices: Uint32Array;
  /** whether they stand for points and have no creases */
  discs?: boolean | undefined;
}

/** What is drawn. */
export interface Sight extends Triangles {
  /** (F,) the part of each face, -1 without one; null where nothing is labelled */
  labels: Int32Array | null;
  /** Creases: [x y z x y z] x N */
  segments: Float32Array;
}

/** What is measured: the whole mesh, its creases, and where they are. */
export interface Body extends Triangles {
  segments: Float32Array;
  faces: Spatial;
  lines: Spatial;
}

export interface Solid {
  sight: Sight;
  /** null until a large mesh is indexed */
  body: Body | null;
}

/** Triangles that are drawn at most: what the processor alone, without a graphics card, turns smoothly. */
export const MOST_DRAWN = 100_000;
/** Meshes up to here are made ready at once: it takes some milliseconds, less than a word with a worker. */
export const AT_ONCE = 20_000;

export function sightOf(mesh: Triangles, labels: Int32Array | null): Sight {
  // Discs of points lie apart from one another: they would vanish.
  if (mesh.discs || mesh.indices.length <= 3 * MOST_DRAWN) return { ...mesh, labels, segments: lines(mesh) };
  const few = thinned(mesh.positions, mesh.indices, MOST_DRAWN);
  const drawn = { positions: rows(mesh.positions, few.vertices), indices: few.indices };
  return { ...drawn, labels: labels && picked(labels, few.faces), segments: lines(drawn) };
}

/** sight: what is drawn of the same mesh, if it is there; its creases are not looked for again. */
export function bodyOf(mesh: Triangles, sight?: Sight): Body {
  const segments = sight?.indices === mesh.indices ? sight.segments : lines(mesh);
  const faces = indexed(mesh.positions, mesh.indices, 3);
  return { positions: mesh.positions, indices: mesh.indices, segments, faces, lines: indexed(segments, null, 2) };
}

/** Fewer triangles with the colours of their vertices. colours: (V, 3) */
export function thinColours(mesh: Triangles, colours: Float32Array): Triangles & { colours: Float32Array } {
  const few = thinned(mesh.positions, mesh.indices, MOST_DRAWN);
  const { vertices, indices } = few;
  return { positions: rows(mesh.positions, vertices), indices, colours: rows(colours, vertices) };
}

const lines = (mesh: Triangles) => (mesh.discs ? new Float32Array() : creases(mesh.positions, mesh.indices));

function rows(of: Float32Array, chosen: Uint32Array): Float32Array {
  const found = new Float32Array(3 * chosen.length);
  chosen.forEach((row, i) => {
    for (let k = 0; k < 3; k++) found[3 * i + k] = of[3 * row + k]!;
  });
  return found;
}

const picked = (of: Int32Array, chosen: Uint32Array) => Int32Array.from(chosen, (i) => of[i]!);
