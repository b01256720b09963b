/** What was told of references, the newest first, each with the way back. */

import { useSignal, useSignalEffect } from "@preact/signals";
import { complain } from "../state/notices";
import { noted } from "../state/studio";
import { Button } from "../ui/controls";
import { moment, plural } from "../ui/numbers";
import type { ToldChange } from "../wire/messages";
import { requests } from "../wire/requests";
import { changes, undo } from "./actions";

const FIRST = 12;

export function ToldChanges() {
  const all = useSignal<ToldChange[]>([]);
  const whole = useSignal(false);
  useSignalEffect(() => {
    void [changes.value, noted.value];
    requests.told().then((found) => (all.value = found), complain);
  });
  if (!all.value.length) return null;
  const shown = whole.value ? all.value : all.value.slice(0, FIRST);
  return (
    <section class="revisions told-changes">
      <h2>
        What you said of references <small>{all.value.length}</small>
      </h2>
      <ol>
        {shown.map((one) => (
          <li key={one.number} data-told-change={one.number}>
            <p class="what">
              <time dateTime={one.written}>{moment(one.written)}</time>
              <span class="grow" title={one.references.join(", ")}>
                {said(one)}
              </span>
            </p>
            <Button
              icon="reset"
              disabled={one.undone}
              title={one.undone ? "This was taken back" : "Take this back; what you said since stays"}
              onClick={() => undo(one.number)}
            >
              {one.undone ? "Undone" : "Undo"}
            </Button>
          </li>
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

const FEW = 3;

function said({ kind, references, added, removed, undoes }: ToldChange): string {
  const who =
    references.length <= FEW ? references.join(", ") : `${references.slice(0, FEW - 1).join(", ")} and ${plural(references.length - FEW + 1, "other")}`; // prettier-ignore
  const what = {
    tags: [...added.map((tag) => `+ ${tag}`), ...removed.map((tag) => `− ${tag}`)].join(", ") || "tags",
    note: "a note",
    "not mine": "not mine, or mine again",
    file: "how the file stands",
  }[kind];
  return `${what}: ${who}${undoes === null ? "" : ` (takes change ${undoes} back)`}`;
}
