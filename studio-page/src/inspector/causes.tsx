/** Why the replica differs: causes in words, and the regions where it does, marked on the stage. */

import { signal } from "@preact/signals";
import { Toggle } from "../ui/controls";
import { percent } from "../ui/numbers";
import type { Piece, Region, Vector } from "../wire/messages";
import { reference } from "./pair/session";

export const regionsShown = signal(false);
/** The region that the pointer is on in the list. */
export const pointed = signal<Region | null>(null);

/** What the judge found, as a region of the stage: its boxes lie in the frame of both shapes. */
export function boxOf({ low, high, share }: Piece, side: Region["side"]): Region {
  const middle = low.map((x, i) => (x + high[i]!) / 2) as Vector;
  const size = low.map((x, i) => high[i]! - x) as Vector;
  return { side, centre: middle, size, axes: AXES, share, distance: null, label: null, rule: null };
}
/** The axes of every box of the judge; a region with them stands where it is, whatever the explanation's placement. */
export const AXES: Region["axes"] = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];

const WHOSE = { unexplained: "missing", surplus: "too much" } as const;

export function Causes() {
  const explanation = reference.value?.explanation;
  if (!explanation || (!explanation.causes.length && !explanation.regions.length)) return null;
  const { causes, regions, remark } = explanation;
  const quiet = reference.value?.grade !== "different";
  return (
    <section class="causes">
      <header>
        <h3>{quiet ? "What still differs" : "Why it differs"}</h3>
        {regions.length > 0 && (
          <Toggle
            label="mark"
            title="Mark the regions on the stage (e)"
            on={regionsShown.value}
            onChange={(on) => (regionsShown.value = on)}
          />
        )}
      </header>
      {causes.map(({ kind, text }, i) => (
        <p key={i} class={quiet ? "soft" : ""}>
          {!quiet && <span class="badge cause">{kind}</span>} {text}
        </p>
      ))}
      {remark && <p class="soft">{remark.text}</p>}
      <ul>
        {regions.map((region, i) => (
          <li
            key={i}
            class={quiet ? "soft" : ""}
            onPointerEnter={() => (pointed.value = region)}
            onPointerLeave={() => (pointed.value = null)}
          >
            <span class={quiet ? "" : `badge ${region.side}`}>{WHOSE[region.side]}</span> {percent(region.share ?? 0)}{" "}
            of the {region.side === "surplus" ? "replica" : "reference"}
            {region.label && `, near ${region.label}`}
          </li>
        ))}
      </ul>
    </section>
  );
}
