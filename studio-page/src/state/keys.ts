/** Keys of the views that are shown, for acting on them and for the help that lists them. */

import { signal } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";

export interface Key {
  /** As KeyboardEvent.key gives them; the first is the one that the help names. */
  keys: string[];
  /** Whether Ctrl (on a Mac ⌘) goes with them: for what costs time. Such a key acts in fields of text as well. */
  modified?: boolean;
  does: string;
  run: (event: KeyboardEvent) => void;
}

export interface KeyMap {
  place: string;
  keys: Key[];
}

/** The maps in force, the innermost last. */
export const keyMaps = signal<KeyMap[]>([]);

const KEPT = "shapewright.keys";
/** Whether keys of a single letter, digit or sign act. */
export const singleKeys = signal(localStorage.getItem(KEPT) !== "off");

export function switchSingleKeys(on: boolean): void {
  singleKeys.value = on;
  localStorage.setItem(KEPT, on ? "on" : "off");
}

/** Keep a map of keys in force while the component is shown. */
export function useKeys(place: string, keys: Key[]): void {
  const newest = useRef(keys);
  newest.current = keys;
  // Before anything is painted: who sees a view can use its keys.
  useLayoutEffect(() => {
    // The map is registered once; what its keys do is always the newest.
    const map: KeyMap = {
      place,
      keys: keys.map((key, i) => ({ ...key, run: (event) => newest.current[i]?.run(event) })),
    };
    keyMaps.value = [...keyMaps.value, map];
    return () => {
      keyMaps.value = keyMaps.value.filter((other) => other !== map);
    };
  }, [place, keys.length]);
}

const MAC = navigator.platform.startsWith("Mac");
/** How the modifier is written before a key. */
export const MODIFIER = MAC ? "⌘" : "Ctrl ";

const ARROWS = ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End", "PageUp", "PageDown"];

/** Whether a key belongs to the element that has the focus. */
function taken({ key, target }: KeyboardEvent): boolean {
  if (!(target instanceof Element)) return false;
  // The editor keeps its keys when Escape has led out of its text: somebody who types on means the text.
  if (target.closest("[contenteditable=true], textarea, dialog[open], [data-keeps-keys]")) return true;
  if (target.closest("select")) return key !== "Escape";
  const input = target.closest("input");
  if (input?.type === "range" || target.closest("[role=radiogroup]")) return ARROWS.includes(key);
  if (input && input.type !== "checkbox") return true;
  return (key === " " || key === "Enter") && target.closest("button:not([data-tile]), a, summary, input") !== null;
}

/** Whether a field of text undoes for itself what is typed in it. */
function undoesItself({ key, target }: KeyboardEvent): boolean {
  if (!["z", "Z", "y"].includes(key) || !(target instanceof Element)) return false;
  const text = target.closest("input:not([type=range], [type=checkbox]), textarea, [contenteditable=true]");
  return text !== null && target.closest("[data-own-undo]") === null;
}

window.addEventListener("keydown", (event) => {
  const modified = event.ctrlKey || event.metaKey;
  if (modified && undoesItself(event)) return;
  if (event.defaultPrevented || event.altKey || (!modified && taken(event))) return;
  if (!modified && event.key.length === 1 && !singleKeys.value) return;
  for (const map of [...keyMaps.value].reverse()) {
    const key = map.keys.find((one) => Boolean(one.modified) === modified && one.keys.includes(event.key));
    if (!key) continue;
    event.preventDefault();
    key.run(event);
    return;
  }
});
