import assert from "node:assert/strict";
import { test } from "node:test";
import { creases } from "../src/viewer/solids/creases.ts";
import { thinned } from "../src/viewer/solids/decimation.ts";
import { indexed, visit } from "../src/viewer/solids/spatial.ts";

const CORNERS = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((i) => [i & 1, (i >> 1) & 1, (i >> 2) & 1]);
const SIDES = [
  0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5,
];

/** Every triangle with vertices of its own, as in files that nobody welded. */
function soup(positions: number[], indices: number[]): [Float32Array, Uint32Array] {
  const own = indices.flatMap((i) => positions.slice(3 * i, 3 * i + 3));
  return [new Float32Array(own), new Uint32Array(indices.map((_, i) => i))];
}

const edges = (positions: Float32Array, indices: Uint32Array) => creases(positions, indices).length / 6;

test("a box has twelve creases and no diagonals", () => {
  assert.equal(edges(new Float32Array(CORNERS), new Uint32Array(SIDES)), 12);
});

test("an unwelded box has the same, and faces may be turned either way", () => {
  assert.equal(edges(...soup(CORNERS, SIDES)), 12);
  const turned = SIDES.map((_, i) => SIDES[Math.floor(i / 3) % 2 ? 3 * Math.floor(i / 3) + 2 - (i % 3) : i]!);
  assert.equal(edges(...soup(CORNERS, turned)), 12);
});

test("where a surface ends there is a crease", () => {
  assert.equal(edges(new Float32Array(CORNERS), new Uint32Array(SIDES.slice(0, 6))), 4);
});

test("a round wall has none between its sides", () => {
  const around = Array.from({ length: 24 }, (_, i) => (2 * Math.PI * i) / 24);
  const positions = around.flatMap((a) => [Math.cos(a), 0, Math.sin(a), Math.cos(a), 1, Math.sin(a)]);
  const indices = around.flatMap((_, i) => {
    const [a, b, c, d] = [2 * i, 2 * i + 1, (2 * i + 2) % 48, (2 * i + 3) % 48];
    return [a, b, c, b, d, c];
  });
  assert.equal(edges(new Float32Array(positions), new Uint32Array(indices)), 48);
});

/** A wall of squares on the ground, two triangles each, bent upwards along the middle. */
function wall(side: number): [Float32Array, Uint32Array] {
  const [positions, indices] = [[] as number[], [] as number[]];
  for (let i = 0; i <= side; i++) {
    for (let j = 0; j <= side; j++) positions.push(i / side, Math.max(0, i / side - 0.5), j / side);
  }
  for (let i = 0; i < side; i++) {
    for (let j = 0; j < side; j++) {
      const a = i * (side + 1) + j;
      indices.push(a, a + 1, a + side + 1, a + 1, a + side + 2, a + side + 1);
    }
  }
  return [new Float32Array(positions), new Uint32Array(indices)];
}

test("an index finds what lies in a place, each once, and looks at few boxes", () => {
  const [positions, indices] = wall(100);
  const index = indexed(positions, indices, 3);
  const touches = (boxes: Float32Array, at: number) =>
    boxes[at]! < 0.305 && boxes[at + 3]! > 0.302 && boxes[at + 2]! < 0.608 && boxes[at + 5]! > 0.602;
  const found: number[] = [];
  let looked = 0;
  visit(
    index,
    (boxes, at) => (looked++, touches(boxes, at)),
    (face) => found.push(face),
  );
  assert.equal(new Set(found).size, found.length);
  assert.ok(found.includes(2 * (30 * 100 + 60)) && found.includes(2 * (30 * 100 + 60) + 1));
  assert.ok(found.length < 100 && looked < 500, `${found.length} of 20000, ${looked} boxes`);
  assert.deepEqual([...index.order].sort((a, b) => a - b), [...indices.keys()].slice(0, 20000)); // prettier-ignore
  assert.deepEqual([...index.boxes.slice(-6)].map((value) => Math.round(100 * value)), [0, 0, 0, 100, 50, 100]); // prettier-ignore
});

test("segments that follow one another are indexed as well", () => {
  const segments = new Float32Array(Array.from({ length: 50 }, (_, i) => [i, 0, 0, i + 1, 0, 0]).flat());
  const found: number[] = [];
  visit(
    indexed(segments, null, 2),
    (boxes, at) => boxes[at]! < 20.5 && boxes[at + 3]! > 20.5,
    (line) => found.push(line),
  );
  assert.ok(found.includes(20) && found.length <= 8);
});

test("what is thinned has fewer triangles of vertices that are there, and the same ends", () => {
  const [positions, indices] = wall(200);
  const few = thinned(positions, indices, 8000);
  assert.ok(few.faces.length > 3000 && few.faces.length < 9500, `${few.faces.length} triangles`);
  assert.ok(few.vertices.every((vertex) => vertex < positions.length / 3));
  assert.ok(few.indices.every((index) => index < few.vertices.length));
  const ends = (k: number) => {
    const along = [...few.vertices].map((vertex) => positions[3 * vertex + k]!);
    return [Math.min(...along), Math.max(...along)];
  };
  for (const k of [0, 2]) assert.ok(ends(k)[0]! < 0.02 && ends(k)[1]! > 0.98);
  few.faces.forEach((face, i) => {
    // Each stands for a face nearby.
    const [x, was] = [few.vertices[few.indices[3 * i]!]!, indices[3 * face]!];
    assert.ok(Math.abs(positions[3 * x]! - positions[3 * was]!) < 0.05);
  });
});
