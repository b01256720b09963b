import assert from "node:assert/strict";
import { test } from "node:test";
import { matching } from "../src/palette/matching.ts";

const found = (words: string, ...names: string[]) => matching(names, words, (name) => name);

test("all words have to be in a name, and its beginning counts most", () => {
  assert.deepEqual(found("fit", "Cancel the fit", "outfit", "Fit", "Loop"), ["Fit", "Cancel the fit", "outfit"]);
  assert.deepEqual(found("the fit", "Cancel the fit", "Fit"), ["Cancel the fit"]);
});

test("signs are taken as they are", () => {
  assert.deepEqual(found("a.(", "a.(b", "axb"), ["a.(b"]);
  assert.deepEqual(found("  ", "b", "a"), ["b", "a"]);
});
