/** After a fit: one sentence on what is left, and one button. */

import { useSignal, useSignalEffect } from "@preact/signals";
import { explain } from "../state/actions";
import { go, inspect } from "../state/route";
import { collection, explained, fitting, jobs, procedure, tileOf } from "../state/studio";
import { Button } from "../ui/controls";
import { percent, plural } from "../ui/numbers";
import type { NextStep } from "../wire/messages";
import { requests } from "../wire/requests";

export function Next() {
  const step = useSignal<NextStep | null>(null);
  useSignalEffect(() => {
    const { run, counts, groups } = collection.value;
    void [counts, groups, explained.value];
    if (run === null) step.value = null;
    else
      requests
        .next()
        .then((found) => collection.peek().run === run && (step.value = found))
        .catch(() => (step.value = null));
  });
  const { run, counts, count } = collection.value;
  const found = step.value;
  if (run === null || fitting.value || !found) return null;
  const { words, button } = said(found, counts.replicated, count);
  return (
    <section class="next" aria-label="What to do next" data-next={button.kind}>
      <p>{words}</p>
      <Button kind="primary" disabled={button.disabled ?? false} onClick={button.run}>
        {button.label}
      </Button>
    </section>
  );
}

interface Said {
  words: preact.ComponentChildren;
  button: { kind: string; label: string; run: () => void; disabled?: boolean };
}

function said(step: NextStep, replicated: number, count: number): Said {
  if (replicated === count) {
    return {
      words: <>All {plural(count, "reference")} are replicated. More references would show what is still missing.</>,
      button: { kind: "report", label: "Open the report", run: openReport },
    };
  }
  const group = step.group && (
    <>
      The largest group, {plural(step.members, "reference")} like {named(step.group)},{" "}
      {step.lacks === null ? "differs in its proportions" : `lacks a piece ${percent(step.lacks)} as long as the shape`}
    </>
  );
  const longest = step.longest && step.longest !== step.group && step.length !== null && (
    <>
      {group ? "; the" : "The"} longest region that nothing explains is in {named(step.longest)} ({percent(step.length)}
      )
    </>
  );
  const { best } = step;
  const change = best && (
    <>
      {group || longest ? "; the" : "The"} best change tried is <q>{best.title}</q>
      {best.gain > 0
        ? `: ${plural(best.gain, "reference")} more replicated`
        : `: ${plural(best.nearer, "reference")} nearer, none replicated`}
    </>
  );
  const words = (
    <>
      {replicated} of {count} replicated. {group}
      {longest}
      {change}
      {(group || longest || change) && "."}
    </>
  );
  if (best && best.suggestion !== null && !procedure.value.stale)
    return { words, button: { kind: "suggestion", label: "See the change", run: () => go("feedback") } };
  if (!explained.value) {
    const busy = ["running", "cancelling"].includes(jobs.explain.value.state);
    const button = { kind: "explain", label: busy ? "Explaining…" : "Explain why, and try changes", disabled: busy };
    return { words, button: { ...button, run: explain } };
  }
  if (procedure.value.stale)
    return { words, button: { kind: "loop", label: "Go on in the editor", run: () => go("loop") } };
  const slug = step.group ?? step.longest;
  if (slug) return { words, button: { kind: "inspect", label: "Look at what differs", run: () => inspect(slug) } };
  return { words, button: { kind: "feedback", label: "See why they differ", run: () => go("feedback") } };
}

const openReport = () =>
  window.open(`/api/runs/${encodeURIComponent(collection.peek().run ?? "")}/report.html`, "_blank", "noopener");

function named(slug: string) {
  return (
    <button type="button" class="link" onClick={() => inspect(slug)}>
      {tileOf(slug)?.name ?? slug}
    </button>
  );
}
