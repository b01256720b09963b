import assert from "node:assert/strict";
import { test } from "node:test";
import { creases } from "../src/viewer/creases.ts";

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
