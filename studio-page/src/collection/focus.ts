/** Moving among the tiles with the keyboard. */

import { signal } from "@preact/signals";
import type { Slug } from "../wire/messages";

/** The tile that has the focus, or had it last. */
export const at = signal<Slug | null>(null);

export type Direction = "next" | "previous" | "up" | "down";

const all = (): HTMLElement[] => [...document.querySelectorAll<HTMLElement>("[data-tile]")];

export function move(direction: Direction): void {
  const tiles = all();
  const here = tiles.find((tile) => tile.dataset.tile === at.value);
  if (!here) return focus(tiles[0]);
  const i = tiles.indexOf(here);
  if (direction === "next") return focus(tiles[i + 1]);
  if (direction === "previous") return focus(tiles[i - 1]);
  focus(beyond(here, direction === "down" ? tiles.slice(i + 1) : tiles.slice(0, i).reverse()));
}

/** Put the focus on a tile, where it is shown. */
export function focusOn(slug: Slug | null): void {
  focus(all().find((tile) => tile.dataset.tile === slug));
}

function focus(tile: HTMLElement | undefined): void {
  tile?.focus({ preventScroll: true });
  tile?.scrollIntoView({ block: "nearest" });
}

/** The tile in the nearest other row that stands most nearly in the same column. */
function beyond(here: HTMLElement, others: HTMLElement[]): HTMLElement | undefined {
  const from = here.getBoundingClientRect();
  let row: number | null = null;
  let best: HTMLElement | undefined;
  let nearest = Infinity;
  for (const other of others) {
    const box = other.getBoundingClientRect();
    if (Math.abs(box.top - from.top) < 4) continue;
    row ??= box.top;
    if (Math.abs(box.top - row) >= 4) break;
    const off = Math.abs(box.left - from.left);
    if (off < nearest) [nearest, best] = [off, other];
  }
  return best;
}
