/** Pictures of the stage to take away: as it is, or in a full turn. */

import { signal } from "@preact/signals";
import { complain } from "../state/notices";
import type { Stage } from "../viewer/stage";
import { download, png } from "./download";
import { gif } from "./gif";
import type { Gif } from "./gif";

/** How much of a turntable is made, from 0 to 1; null while none is. */
export const turning = signal<number | null>(null);

const STEPS = 36;
/** Seconds of one picture: a turn takes about three. */
const DELAY = 0.08;
/** Pixels of the longer side of a turntable. */
const LONGEST = 720;

export function savePicture(stage: Stage | null, name: string | null): void {
  if (!stage || !name) return;
  png(copied(stage, Infinity)).then((file) => download(file, `${name}.png`), complain);
}

/** One turn of both shapes as an animated GIF; the page can be used meanwhile. */
export async function saveTurntable(stage: Stage | null, name: string | null): Promise<void> {
  if (!stage || !name || turning.value !== null) return;
  turning.value = 0;
  try {
    let file: Gif | null = null;
    for (let step = 0; step < STEPS; step++) {
      if (!stage.canvas.isConnected) return;
      const picture = copied(stage, LONGEST);
      const { width, height } = picture;
      const pixels = picture.getContext("2d")!.getImageData(0, 0, width, height).data;
      file ??= gif(width, height, pixels, DELAY);
      file.add(pixels);
      stage.eye.turn(360 / STEPS, 0);
      turning.value = (step + 1) / STEPS;
      await new Promise((next) => setTimeout(next));
    }
    if (file) download(file.end(), `${name}.gif`);
  } catch (error) {
    complain(error);
  } finally {
    turning.value = null;
  }
}

/** The stage on its ground, drawn now. longest: pixels of the longer side at most. */
function copied(stage: Stage, longest: number): HTMLCanvasElement {
  stage.draw();
  const { canvas } = stage;
  const scale = Math.min(1, longest / Math.max(canvas.width, canvas.height));
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [Math.round(canvas.width * scale), Math.round(canvas.height * scale)];
  const pen = copy.getContext("2d", { willReadFrequently: true })!;
  pen.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--panel");
  pen.fillRect(0, 0, copy.width, copy.height);
  pen.imageSmoothingQuality = "high";
  pen.drawImage(canvas, 0, 0, copy.width, copy.height);
  return copy;
}
