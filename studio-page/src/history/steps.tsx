/** One reference through all iterations, as a strip of pictures. */

import { useSignal, useSignalEffect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { tintOf } from "../state/scale";
import { complain } from "../state/notices";
import { collection, runs, tileOf } from "../state/studio";
import { fixed, moment } from "../ui/numbers";
import { GradeMark, Picture } from "../ui/picture";
import type { Slug, Step } from "../wire/messages";
import { requests } from "../wire/requests";

/** at: the run that is open. */
export function Steps({ slug, at = null }: { slug: Slug; at?: string | null }) {
  const steps = useSignal<Step[]>([]);
  const asked = useSignal(slug);
  const strip = useRef<HTMLOListElement>(null);
  asked.value = slug;
  useSignalEffect(() => {
    const now = asked.value;
    void runs.value;
    if (!tileOf(now)) return;
    requests.steps(now).then((found) => asked.peek() === now && (steps.value = found), complain);
  });
  const shown = at ?? collection.value.run;
  useEffect(() => {
    const here = strip.current?.querySelector("[aria-current]")?.parentElement;
    if (here && strip.current) strip.current.scrollLeft = here.offsetLeft - strip.current.clientWidth / 2;
  }, [steps.value, shown]);
  if (!steps.value.length) return null;
  const versions = new Map<string, number>();
  for (const { procedure } of steps.value) if (!versions.has(procedure)) versions.set(procedure, versions.size + 1);
  return (
    <section class="steps" aria-label="Through all iterations">
      <h3>
        Through all iterations <small>{steps.value.length}</small>
      </h3>
      <ol ref={strip}>
        {steps.value.map((step) => {
          const value = step.fidelity ?? step.distance;
          const what = step.error ?? `${step.grade}, ${fixed(value, 2)}`;
          return (
            <li key={step.run}>
              <a
                href={`#history/${encodeURIComponent(step.run)}/${encodeURIComponent(slug)}`}
                aria-current={step.run === shown ? "true" : undefined}
                data-step={step.run}
                title={`Run ${step.run}, ${moment(step.created)}, version ${versions.get(step.procedure)}: ${what}`}
                aria-label={`Run ${step.run}: ${what}`}
              >
                <Picture url={step.replica} tint={tintOf(step)} alt="" />
                <span class="value">
                  {step.run}
                  <GradeMark grade={value === null ? null : step.grade} />
                  {fixed(value, 2)}
                </span>
              </a>
            </li>
          );
        })}
      </ol>
    </section>
  );
}
