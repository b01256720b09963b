/** Every write of the procedure, the newest first: what it changed, and the way back to the text before it. */

import { useSignal, useSignalEffect } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { file, files, read, startEditing } from "../loop/editing";
import { written } from "../state/actions";
import { complain } from "../state/notices";
import { procedure, project } from "../state/studio";
import { Button, Select } from "../ui/controls";
import type { DiffLine, Revision, Writer } from "../wire/messages";
import { requests } from "../wire/requests";
import { Diff } from "./diff";

const FIRST = 12;

export function Revisions() {
  const all = useSignal<Revision[]>([]);
  const whole = useSignal(false);
  const of = useSignal("");
  const asked = useSignal(0);
  useSignalEffect(() => {
    const [{ digest }, file] = [procedure.value, of.value];
    void asked.value;
    requests
      .revisions(file)
      .then((found) => {
        if (procedure.peek().digest === digest && of.peek() === file) all.value = found;
      })
      .catch(complain);
  });
  useEffect(startEditing, []);
  const others = files.value.length > 1;
  if (!all.value.length && !others) return null;
  const shown = whole.value ? all.value : all.value.slice(0, FIRST);
  return (
    <section class="revisions">
      <h2>
        Changes of{" "}
        {others ? (
          <Select
            label="Changes of"
            hidden
            options={files.value.map((value) => ({ value, label: value }))}
            value={of.value || project.value.procedure}
            onChange={(name) => (of.value = name === project.value.procedure ? "" : name)}
          />
        ) : (
          project.value.procedure
        )}{" "}
        <small>{all.value.length}</small>
      </h2>
      <ol>
        {shown.map((one) => (
          <Line
            key={`${of.value} ${one.number}`}
            one={one}
            file={of.value}
            now={of.value ? (all.value[0]?.after ?? null) : procedure.value.digest}
            undone={() => {
              asked.value += 1;
              if (file.peek() === of.peek()) void read();
            }}
          />
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

/** file: empty for the procedure. now: digest of the text that it has. undone: called when another text was put back. */
function Line(props: { one: Revision; file: string; now: string | null; undone: () => void }) {
  const { one, file, now, undone } = props;
  const diff = useSignal<DiffLine[] | null>(null);
  const { number, added, removed, before } = one;
  const open = () => {
    if (diff.value) diff.value = null;
    else
      requests
        .revision(number, file)
        .then((found) => (diff.value = found.diff))
        .catch(complain);
  };
  const undo = () =>
    requests
      .undo(number, now, file)
      .then((done) => {
        undone();
        written(`${file || project.value.procedure} is as it was before: ${said(one)}.`, done, file, undone);
      })
      .catch(complain);
  const here = before === now;
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
        title={here ? "The file has this text" : "Put the text of before this change back; you can undo that, too"}
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
