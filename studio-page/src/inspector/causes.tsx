/** Why the replica differs: causes in words, and the regions where it does, marked on the stage. */

import { signal } from "@preact/signals";
import { Toggle } from "../ui/controls";
import { percent } from "../ui/numbers";
import type { Region } from "../wire/messages";
import { reference } from "./pair/session";

export const regionsShown = signal(false);
/** The region that the pointer is on in the list. */
export const pointed = signal<Region | null>(null);

const WHOSE = { unexplained: "missing", surplus: "too much" } as const;

export function Causes() {
  const explanation = reference.value?.explanation;
  if (!explanation || (!explanation.causes.length && !explanation.regions.length)) return null;
  const { causes, regions } = explanation;
  return (
    <section class="causes">
      <header>
        <h3>Why it differs</h3>
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
        <p key={i}>
          <span class="badge cause">{kind.replaceAll("_", " ")}</span> {text}
        </p>
      ))}
      <ul>
        {regions.map((region, i) => (
          <li key={i} onPointerEnter={() => (pointed.value = region)} onPointerLeave={() => (pointed.value = null)}>
            <span class={`badge ${region.side}`}>{WHOSE[region.side]}</span> {percent(region.share ?? 0)} of the{" "}
            {region.side === "surplus" ? "replica" : "reference"}
            {region.label && `, near ${region.label}`}
          </li>
        ))}
      </ul>
    </section>
  );
}
