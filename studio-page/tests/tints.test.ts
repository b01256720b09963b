import assert from "node:assert/strict";
import { test } from "node:test";
import { clear, ofDistance, ofGrade } from "../src/state/tints.ts";

type Rgb = [number, number, number];

const linear = (colour: string): Rgb =>
  [1, 3, 5].map((at) => {
    const value = parseInt(colour.slice(at, at + 2), 16) / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  }) as Rgb;
const lightness = (colour: string) => {
  const [r, g, b] = linear(colour);
  return 116 * Math.cbrt(0.2126 * r + 0.7152 * g + 0.0722 * b) - 16;
};
/** As people without one kind of cones see linear light (Viénot, Brettel and Mollon 1999; Machado et al. 2009). */
const SEEN: Record<string, number[]> = {
  protanopia: [0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998],
  deuteranopia: [0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.01182, 0.04294, 0.968881],
  tritanopia: [1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.3039],
};
const lightnessSeen = (colour: string, by: number[]) => {
  const rgb = linear(colour);
  const seen = [0, 3, 6].map((row) => rgb.reduce((sum, value, k) => sum + value * by[row + k]!, 0)) as Rgb;
  return 116 * Math.cbrt(0.2126 * seen[0] + 0.7152 * seen[1] + 0.0722 * seen[2]) - 16;
};

test("colours become lighter from what is different to what is replicated, to every eye", () => {
  const steps = Array.from({ length: 41 }, (_, i) => clear(i / 40));
  const eyes = [lightness, ...Object.values(SEEN).map((by) => (colour: string) => lightnessSeen(colour, by))];
  for (const eye of eyes) {
    const seen = steps.map(eye);
    seen.slice(1).forEach((value, i) => assert.ok(value > seen[i]!, `${steps[i]} is as light as ${steps[i + 1]}`));
    assert.ok(seen[20]! - seen[0]! > 10 && seen[40]! - seen[20]! > 10, "grades differ by ten steps of lightness");
  }
});

test("a distance has the colour of its grade at the cuts", () => {
  assert.equal(ofDistance(0, 0.18, 2.5), ofGrade("replicated"));
  assert.equal(ofDistance(0.18, 0.18, 2.5), ofGrade("close"));
  assert.equal(ofDistance(9, 0.18, 2.5), ofGrade("different"));
});
