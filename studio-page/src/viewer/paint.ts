/** Ways to colour a surface. */

import { Color } from "three";
import type { Paint } from "./surface";

/** Colours that tell parts apart, on light and dark ground. */
export const PART_COLOURS = ["#7fa8d6", "#e0a35c", "#86bd86", "#d98880", "#b495cf", "#d8c66a", "#74c0bd", "#c9967a"];
export const UNLABELLED = "#b9bec4";

export function partColour(index: number): string {
  return index < 0 ? UNLABELLED : PART_COLOURS[index % PART_COLOURS.length]!;
}

export function plain(css: string): Paint {
  const colour = new Color().setStyle(css);
  return (colours, indices) => {
    for (let i = 0; i < indices.length; i++) colour.toArray(colours, 3 * i);
  };
}

/** labels: (F,) index of each face's part, -1 without one. */
export function parts(labels: Int32Array): Paint {
  const palette = new Map<number, Color>();
  return (colours, indices) => {
    for (let i = 0; i < indices.length; i++) {
      const label = labels[Math.floor(i / 3)]!;
      let colour = palette.get(label);
      if (!colour) palette.set(label, (colour = new Color().setStyle(partColour(label))));
      colour.toArray(colours, 3 * i);
    }
  };
}

/** vertexColours: (V, 3), linear light. */
export function blended(vertexColours: Float32Array): Paint {
  return (colours, indices) => {
    for (let i = 0; i < indices.length; i++) {
      const v = 3 * indices[i]!;
      for (let k = 0; k < 3; k++) colours[3 * i + k] = vertexColours[v + k]!;
    }
  };
}
