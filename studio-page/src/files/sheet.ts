/** The collection on one picture: each reference beside its replica, as they are ordered and filtered now. */

import { signal } from "@preact/signals";
import { leafed } from "../collection/order";
import { tintOf } from "../state/scale";
import { complain } from "../state/notices";
import { valueOf } from "../state/grades";
import { collection, project, tileOf } from "../state/studio";
import { fixed } from "../ui/numbers";
import { SIGNS } from "../ui/signs";
import type { Tile } from "../wire/messages";
import { download, png } from "./download";

/** Pixels: of a thumbnail, of the line under a pair, between two pairs, and of the head. */
const [THUMB, LINE, GAP, HEAD] = [144, 22, 14, 44];
/** Pixels of either side that every browser draws. */
const MOST = 16_000;

/** Whether one is being made. */
export const laying = signal(false);

export async function saveSheet(): Promise<void> {
  if (laying.value) return;
  laying.value = true;
  try {
    const tiles = leafed.value.flatMap((slug) => tileOf(slug) ?? []);
    download(await png(await sheet(tiles)), `${project.value.name || "collection"}.png`);
  } catch (error) {
    complain(error);
  } finally {
    laying.value = false;
  }
}

async function sheet(tiles: readonly Tile[]): Promise<HTMLCanvasElement> {
  const [wide, high] = [2 * THUMB + GAP, THUMB + LINE + GAP];
  // About as wide as high.
  const columns = Math.max(1, Math.min(tiles.length, Math.round(Math.sqrt((tiles.length * high) / wide) * 1.2)));
  const rows = Math.ceil(tiles.length / columns);
  const [width, height] = [columns * wide + GAP, HEAD + rows * high + GAP];
  const scale = Math.min(2, MOST / width, MOST / height);
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [Math.round(width * scale), Math.round(height * scale)];
  const pen = canvas.getContext("2d")!;
  pen.scale(scale, scale);
  const style = getComputedStyle(document.documentElement);
  const colour = (name: string) => style.getPropertyValue(name);
  pen.fillStyle = colour("--panel");
  pen.fillRect(0, 0, width, height);
  pen.fillStyle = colour("--ink");
  pen.font = "600 17px system-ui, sans-serif";
  const { counts, count } = collection.value;
  pen.fillText(`${project.value.name}: ${counts.replicated} of ${count} replicated`, GAP, 28, width - 2 * GAP);
  for (const [i, tile] of tiles.entries()) {
    const [x, y] = [GAP + (i % columns) * wide, HEAD + Math.floor(i / columns) * high];
    await draw(pen, tile.reference, null, x, y);
    await draw(pen, tile.replica, tintOf(tile), x + THUMB, y);
    pen.font = "12px system-ui, sans-serif";
    pen.fillStyle = colour("--ink");
    const value = valueOf(collection.value.judge, tile);
    const said = value === null ? "" : `${SIGNS[tile.grade]} ${fixed(value, 2)}`;
    pen.fillText(tile.name, x + 2, y + THUMB + 14, 2 * THUMB - 60);
    pen.textAlign = "right";
    pen.fillText(said, x + 2 * THUMB - 2, y + THUMB + 14);
    pen.textAlign = "left";
  }
  return canvas;
}

/** A grey picture, tinted as on the tiles. */
async function draw(pen: CanvasRenderingContext2D, url: string | null, tint: string | null, x: number, y: number) {
  if (!url) return;
  const picture = new Image();
  picture.src = url;
  await picture.decode();
  if (!tint) return pen.drawImage(picture, x, y, THUMB, THUMB);
  const scratch = document.createElement("canvas");
  [scratch.width, scratch.height] = [picture.naturalWidth, picture.naturalHeight];
  const brush = scratch.getContext("2d")!;
  brush.drawImage(picture, 0, 0);
  brush.globalCompositeOperation = "multiply";
  brush.fillStyle = tint;
  brush.fillRect(0, 0, scratch.width, scratch.height);
  brush.globalCompositeOperation = "destination-in";
  brush.drawImage(picture, 0, 0);
  return pen.drawImage(scratch, x, y, THUMB, THUMB);
}
