/** Colours of the map: by grade, fidelity, a tag, or a parameter; and what they mean. */

import { notedOf } from "../curating/actions";
import { share } from "../parameters/brushes";
import { colourOfGrade } from "../state/scale";
import { procedure } from "../state/studio";
import { shown, words } from "../ui/numbers";
import { partColour } from "../viewer/paint";
import type { Parameter, Tile, Values } from "../wire/messages";

export type Colouring = "grade" | "fidelity" | `tag ${string}` | `parameter ${string}`;
type Found = { parameters: Values; active: string[] } | undefined;

const UNKNOWN = "var(--line-strong)";
const GRADES = ["replicated", "close", "different"] as const;

/** From pale to strong: its lightness goes one way only, in either theme. */
const ramp = (at: number): string =>
  `color-mix(in oklab, var(--accent) ${Math.round(100 * Math.min(1, Math.max(0, at)))}%, var(--line-strong))`;

export function colourOf(colouring: Colouring, tile: Tile, found: Found): string {
  if (colouring === "grade") return tile.distance === null ? UNKNOWN : colourOfGrade(tile.grade);
  if (colouring === "fidelity") return tile.fidelity === null ? UNKNOWN : ramp(tile.fidelity);
  if (colouring.startsWith("tag "))
    return notedOf(tile.slug).tags.includes(colouring.slice(4)) ? "var(--accent)" : UNKNOWN;
  const parameter = named(colouring);
  const value = parameter && found?.parameters[parameter.name];
  if (!parameter || value === undefined || !found?.active.includes(parameter.name)) return UNKNOWN;
  return parameter.kind === "choice"
    ? partColour((parameter.options ?? []).indexOf(value))
    : ramp(share(parameter, value));
}

export function legendOf(colouring: Colouring): { fill: string; label: string }[] {
  if (colouring === "grade") return GRADES.map((label) => ({ fill: colourOfGrade(label), label }));
  if (colouring === "fidelity") return [0, 0.5, 1].map((at) => ({ fill: ramp(at), label: `fidelity ${at}` }));
  if (colouring.startsWith("tag ")) {
    return [
      { fill: "var(--accent)", label: colouring.slice(4) },
      { fill: UNKNOWN, label: "others" },
    ];
  }
  const parameter = named(colouring);
  if (!parameter) return [];
  const { kind, options, low, high } = parameter;
  if (kind === "choice") return (options ?? []).map((one, i) => ({ fill: partColour(i), label: String(one) }));
  const ends = kind === "binary" ? ["no", "yes"] : [shown(low), shown(high)];
  return ends.map((end, i) => ({ fill: ramp(i), label: `${words(parameter.name)} ${end}` }));
}

const named = (colouring: Colouring): Parameter | undefined =>
  procedure.value.parameters.find(({ name }) => `parameter ${name}` === colouring);
