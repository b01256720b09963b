/** Every write of the procedure, the newest first: what it changed, and the way back to the text before it. */

import { useSignal, useSignalEffect } from "@preact/signals";
import { written } from "../state/actions";
import { complain } from "../state/notices";
import { procedure, project } from "../state/studio";
import { Button } from "../ui/controls";
import type { DiffLine, Revision, Writer } from "../wire/messages";
import { requests } from "../wire/requests";
import { Diff } from "./diff";

const FIRST = 12;

export function Revisions() {
  const all = useSignal<Revision[]>([]);
  const whole = useSignal(false);
  useSignalEffect(() => {
    const { digest } = procedure.value;
    requests
      .revisions()
      .then((found) => {
        if (procedure.peek().digest === digest) all.value = found;
      })
      .catch(complain);
  });
  if (!all.value.length) return null;
  const shown = whole.value ? all.value : all.value.slice(0, FIRST);
  return (
    <section class="revisions">
      <h2>
        Changes of {project.value.procedure} <small>{all.value.length}</small>
      </h2>
      <ol>
        {shown.map((one) => (
          <Line key={one.number} one={one} />
        ))}
      </ol>
      {shown.length < all.value.length && (
        <Button kind="quiet" onClick={() => (whole.value = true)}>
          {`Show all ${all.value.length}`}
        </Button>
      )}
    </section>
  );
}

function Line({ one }: { one: Revision }) {
  const diff = useSignal<DiffLine[] | null>(null);
  const { number, added, removed, before } = one;
  const open = () => {
    if (diff.value) diff.value = null;
    else
      requests
        .revision(number)
        .then((found) => (diff.value = found.diff))
        .catch(complain);
  };
  const undo = () =>
    requests
      .undo(number, procedure.value.digest)
      .then((done) => written(`${project.value.procedure} is as it was before: ${said(one)}.`, done))
      .catch(complain);
  const here = before === procedure.value.digest;
  return (
    <li>
      <button type="button" class="what" aria-expanded={diff.value !== null} onClick={open}>
        <time dateTime={one.written}>{new Date(one.written).toLocaleString([], WHEN)}</time>
        <span class="grow">{said(one)}</span>
        <small class="good">+{added}</small> <small class="bad">−{removed}</small>
      </button>
      <Button
        icon="reset"
        disabled={here}
        title={here ? "The procedure has this text" : "Put the text of before this change back; you can undo that, too"}
        onClick={() => void undo()}
      >
        Undo to here
      </Button>
      {diff.value && <Diff lines={diff.value} />}
    </li>
  );
}

const WHEN = { dateStyle: "medium", timeStyle: "short" } as const;
const WRITERS: Record<Writer, (of: string) => string> = {
  editor: () => "saved in the page's editor",
  suggestion: (title) => `suggestion applied: ${title}`,
  run: (run) => `went back to the procedure of run ${run}`,
  undo: (number) => `undid change ${number} and those after it`,
  "another program": () => "saved by another program",
};

const said = ({ writer, of }: Revision) => WRITERS[writer](of);
