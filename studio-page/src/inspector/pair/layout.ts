/** How the open pair is laid out, and the stage that it stands on. */

import { signal } from "@preact/signals";
import type { Section, Stage } from "../../viewer/stage";

/** Difference: of drawings only. */
export type Layout = "beside" | "over" | "difference";
export const layout = signal<Layout>("beside");
/** Opacity of the replica when it lies over the reference. */
export const blend = signal(0.55);
/** Opacity of the reference when the replica lies over it. */
export const under = signal(1);
/** What is drawn besides the two, and how they are seen. */
export const wireframe = signal(false);
export const furnished = signal(false);
export const parallel = signal(false);
export const section = signal<Section | null>(null);
/** The stage that is open, null without one. */
export const stage = signal<Stage | null>(null);
/** Raised by every drawing, so that what lies over the stage follows. */
export const drawn = signal(0);

export const COLOURS = {
  light: { reference: "#aeb5bd", replica: "#c9c3b4", over: "#e08a2e", ink: "#20242a", net: "#6b747e" },
  dark: { reference: "#a3abb4", replica: "#bcb5a4", over: "#e8963c", ink: "#0c0e10", net: "#8b949e" },
} as const;
