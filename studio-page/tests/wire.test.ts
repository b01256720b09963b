import assert from "node:assert/strict";
import { test } from "node:test";
import { duration, fixed, significant } from "../src/ui/numbers.ts";
import { decode } from "../src/wire/binary.ts";

function message(head: object, ...arrays: (Float32Array | Uint32Array | Int32Array)[]): ArrayBuffer {
  let text = JSON.stringify(head);
  text += " ".repeat((4 - (text.length % 4)) % 4);
  const bytes = new Uint8Array(4 + text.length + arrays.reduce((sum, array) => sum + array.byteLength, 0));
  new DataView(bytes.buffer).setUint32(0, text.length, true);
  bytes.set(new TextEncoder().encode(text), 4);
  let at = 4 + text.length;
  for (const array of arrays) {
    bytes.set(new Uint8Array(array.buffer), at);
    at += array.byteLength;
  }
  return bytes.buffer;
}

test("a mesh is read as it was sent", () => {
  const buffers = [
    ["positions", "f32", 3],
    ["indices", "u32", 3],
    ["labels", "i32", 1],
  ];
  const sent = [new Float32Array([0.5, -1, 2]), new Uint32Array([0, 1, 4e9]), new Int32Array([-1])] as const;
  const read = decode(message({ type: "mesh", id: 7, slug: "a", buffers }, ...sent));
  assert.equal(read.type, "mesh");
  assert.deepEqual([...read.positions], [0.5, -1, 2]);
  assert.deepEqual([...read.indices], [0, 1, 4e9]);
  assert.deepEqual("labels" in read && [...read.labels!], [-1]);
});

test("a mesh without labels has none", () => {
  const read = decode(message({ type: "mesh", id: 7, buffers: [["positions", "f32", 1]] }, new Float32Array(1)));
  assert.equal("labels" in read && read.labels, null);
});

test("numbers are told shortly", () => {
  assert.deepEqual(
    [0.25, 1.5, -0.125, null].map((value) => fixed(value)),
    [".250", "1.500", "-.125", "–"],
  );
  assert.deepEqual(
    [0, 0.1 + 0.2, 12345.6, 0.00694].map((value) => significant(value)),
    ["0", "0.3", "12346", "0.00694"],
  );
  assert.equal(significant(0.0069431, 2), "0.0069");
  assert.deepEqual([3.14, 42.2, 125].map(duration), ["3.1 s", "42 s", "2 min 5 s"]);
});
