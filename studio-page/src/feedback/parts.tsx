/** A suggestion in the author's file as it is now, part by part: each can be accepted alone. */

import { useSignal, useSignalEffect } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import { written } from "../state/actions";
import { complain, tell } from "../state/notices";
import { go } from "../state/route";
import { procedure, project } from "../state/studio";
import { Button } from "../ui/controls";
import { Lines } from "../ui/lines";
import { plural } from "../ui/numbers";
import type { Hunk, Merging } from "../wire/messages";
import { RequestError, requests } from "../wire/requests";

export function Parts({ index, title }: { index: number; title: string }) {
  const merging = useSignal<Merging | null>(null);
  const left = useSignal<ReadonlySet<number>>(new Set());
  const refused = useSignal("");
  useSignalEffect(() => {
    // Whatever is written changes where the parts lie, and which are there.
    const { digest, state } = procedure.value;
    if (state === "loading") return;
    requests
      .merging(index)
      .then((found) => {
        if (procedure.peek().digest !== digest) return;
        merging.value = found;
        left.value = new Set();
        refused.value = "";
      })
      .catch((error: unknown) => {
        // The run that it is of may be gone by now.
        if (!(error instanceof RequestError && error.status === 404)) complain(error);
      });
  });
  const found = merging.value;
  if (!found) return <p class="soft">Reading the file…</p>;
  const open = found.hunks.filter(({ there, refused }) => !there && refused === null);
  const chosen = open.map(({ number }) => number).filter((number) => !left.value.has(number));
  const choose = (number: number, on: boolean) => {
    const next = new Set(left.value);
    if (on) next.delete(number);
    else next.add(number);
    left.value = next;
  };
  const apply = async () => {
    try {
      const done = await requests.applyToProcedure(index, found.digest, chosen);
      written(
        `The procedure has ${chosen.length === found.hunks.length ? "it" : plural(chosen.length, "part")}: ${title}.`,
        done,
      );
      if (chosen.length === open.length) go("loop");
    } catch (error) {
      refused.value = error instanceof Error ? error.message : String(error);
    }
  };
  const toCopy = async () => {
    try {
      tell(`Written to ${(await requests.applyToCopy(index, found.digest, chosen)).path}.`);
    } catch (error) {
      refused.value = error instanceof Error ? error.message : String(error);
    }
  };
  if (!open.length && !found.refused) return <p class="good">{project.value.procedure} has all of it.</p>;
  return (
    <div class="parts">
      {found.refused && (
        <p class="warn" data-refused>
          As a whole it does not fit what you have written since: {found.refused}. The parts below fit one by one, where
          nothing else is said.
        </p>
      )}
      <Boxes hunks={found.hunks} left={left.value} choose={choose} />
      {refused.value && (
        <p class="bad" role="alert">
          {refused.value}
        </p>
      )}
      <div class="row">
        <Button kind="primary" disabled={!chosen.length} onClick={() => void apply()}>
          {chosen.length === found.hunks.length ? "Apply to the procedure" : `Apply ${plural(chosen.length, "part")}`}
        </Button>
        <Button disabled={!chosen.length} onClick={() => void toCopy()}>
          Apply to a copy
        </Button>
      </div>
    </div>
  );
}

function Boxes(props: { hunks: Hunk[]; left: ReadonlySet<number>; choose: (number: number, on: boolean) => void }) {
  const box = useRef<HTMLDivElement>(null);
  const shown = props.hunks.map(({ number, there }) => `${number}${there}`).join();
  useLayoutEffect(() => {
    // What comes new is what one wants to read first: the longest run of new lines, not the imports above it.
    const self = box.current;
    const longest = [...(self?.querySelectorAll<HTMLElement>("[data-added]") ?? [])].sort(
      (a, b) => Number(b.dataset.added) - Number(a.dataset.added),
    )[0];
    if (self && longest) self.scrollTop += longest.getBoundingClientRect().top - self.getBoundingClientRect().top - 1;
  }, [shown]);
  return (
    <div class="changes" tabIndex={0} role="region" aria-label="What it changes" ref={box}>
      {props.hunks.map(({ number, lines, there, refused }) => (
        <section
          key={number}
          class={there || refused ? "part closed" : "part"}
          data-part={number}
          data-added={lines.filter(({ kind }) => kind === "added").length}
        >
          <label>
            <input
              type="checkbox"
              checked={there || (!refused && !props.left.has(number))}
              disabled={there || refused !== null}
              onChange={(event) => props.choose(number, event.currentTarget.checked)}
            />
            <span>
              Part {number + 1} of {props.hunks.length}
              {there && <span class="good"> · the file has it</span>}
              {refused && <span class="warn"> · does not fit: {refused}</span>}
            </span>
          </label>
          <Lines lines={lines} />
        </section>
      ))}
    </div>
  );
}
