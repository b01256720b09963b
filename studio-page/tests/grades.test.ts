import assert from "node:assert/strict";
import { test } from "node:test";
import { counted, differences, gain, stands, valueOf } from "../src/state/grades.ts";
import type { Grade, Piece } from "../src/wire/messages";

const piece = (size: number): Piece => ({ size, low: [0, 0, 0], high: [size, 0, 0], share: 0.1 });

test("every reference is counted once by its grade, and beside by the paper's measure", () => {
  const all = (["replicated", "close", "close", "different"] as Grade[]).map((grade, i) => ({
    grade,
    compatible: i !== 1,
  }));
  assert.deepEqual(counted(all), { replicated: 1, close: 2, different: 1, compatible: 3 });
});

test("more fidelity is better, and so is less distance", () => {
  const one = { fidelity: 0.8, distance: 0.1 };
  assert.deepEqual([valueOf("fidelity", one), valueOf("paper", one)], [0.8, 0.1]);
  assert.equal(gain("fidelity", 0.25, 0.75), 0.5);
  assert.equal(gain("paper", 0.25, 0.75), -0.5);
  assert.equal(gain("fidelity", null, 0.75), null);
});

test("the largest region of each kind is told in words", () => {
  const told = differences([piece(0.306), piece(0.1), piece(0.05)], [piece(0.5)]);
  assert.deepEqual(
    told.map(({ words }) => words),
    ["Missing: a piece 31 % as long as the shape, and 2 more", "Too much: a piece 50 % as long as the shape"],
  );
  assert.deepEqual(differences([], []), []);
});

test("how a reference stands is told in a word or two", () => {
  const pose = { turned: 90, on_its_head: false, mirrored: false, text: "" };
  assert.equal(stands(pose), "turned 90°");
  assert.equal(stands({ ...pose, on_its_head: true }), "on its head");
  assert.equal(stands({ ...pose, mirrored: true }), "mirrored");
});
