/** A project that was never fitted: what to do, step by step, and one button at the end. */

import { useSignal, useSignalEffect } from "@preact/signals";
import { startEditing, text } from "../loop/editing";
import { fit } from "../state/actions";
import { MODIFIER } from "../state/keys";
import { go } from "../state/route";
import { collection, dimension, procedure, project } from "../state/studio";
import { Button } from "../ui/controls";
import { Icon } from "../ui/icons";
import { plural, shown } from "../ui/numbers";
import type { Parameter } from "../wire/messages";
import { DropZone } from "./drop";
import { Standing } from "./standing";

export function Welcome() {
  const { count } = collection.value;
  const good = procedure.value.state === "good";
  const ready = good && count > 0;
  const why = !count ? "first some references are needed" : good ? "" : "first the procedure has to be mended";
  return (
    <section class="welcome" aria-label="First steps">
      <header>
        <h2>
          {count ? `${project.value.name}: before the first fit` : `${project.value.name}: from shapes to parameters`}
        </h2>
        <p class="soft" hidden={count > 0}>
          You write a procedure: a function that makes a shape from parameters. The studio finds, for every reference,
          the parameters whose shape comes nearest to it, and shows what the procedure cannot make yet.
        </p>
      </header>
      <ol>
        <Step
          number={1}
          done={count > 0}
          title={count ? `${plural(count, "reference")} are there` : "Give it references"}
        >
          <DropZone />
        </Step>
        {count > 0 && dimension.value === 3 && (
          <Step number={2} done title="See whether they stand right">
            <Standing />
          </Step>
        )}
        <Step number={count > 0 && dimension.value === 3 ? 3 : 2} done={good} title="The first procedure">
          <FirstProcedure />
        </Step>
      </ol>
      <footer>
        <Button
          kind="primary"
          icon="play"
          class="begin"
          disabled={!ready}
          title={`${MODIFIER}Enter`}
          onClick={() => fit()}
        >
          {count ? `Fit ${plural(count, "reference")}` : "Fit"}
        </Button>
        <p class="soft">{why || "Afterwards a sentence above the tiles says what to do next."}</p>
      </footer>
    </section>
  );
}

function Step(props: { number: number; done: boolean; title: string; children: preact.ComponentChildren }) {
  return (
    <li class={props.done ? "done" : ""}>
      <h3>
        <span class="number">{props.done ? <Icon name="check" /> : props.number}</span>
        {props.title}
      </h3>
      <div class="inside">{props.children}</div>
    </li>
  );
}

/** The head of the procedure: its signature, as far as the body. */
function FirstProcedure() {
  const head = useSignal("");
  useSignalEffect(() => {
    startEditing();
    head.value = signature(text.value);
  });
  const { parameters, state } = procedure.value;
  return (
    <div class="first-procedure">
      <pre tabIndex={0} aria-label="The procedure's first lines">
        <code>{head.value || "…"}</code>
      </pre>
      <div>
        <p>
          {state === "broken" ? (
            <span class="bad">It cannot be used as it is: see above.</span>
          ) : (
            <>
              <code>{procedure.value.name}</code> has {plural(parameters.length, "parameter")}:
            </>
          )}
        </p>
        <ul>
          {parameters.slice(0, 8).map((one) => (
            <li key={one.name}>
              <code>{one.name}</code> <span class="soft">{limits(one)}</span>
            </li>
          ))}
          {parameters.length > 8 && <li class="soft">and {parameters.length - 8} more</li>}
        </ul>
        <Button onClick={() => go("loop")}>Open it in the editor</Button>
      </div>
    </div>
  );
}

const MOST = 26;

/** From the decorator to the end of the signature; the beginning of a text that has none. */
function signature(source: string): string {
  const lines = source.split("\n");
  const start = Math.max(
    lines.findIndex((line) => /^@\s*(\w+\.)?procedure\b/.test(line)),
    0,
  );
  const end = lines.findIndex(
    (line, i) => i > start && /^\s*\)?.*:\s*(#.*)?$/.test(line) && /^\)|^def .*:\s*$/.test(line),
  );
  return lines.slice(start, end < 0 ? start + MOST : Math.min(end + 1, start + MOST)).join("\n");
}

function limits({ kind, low, high, options }: Parameter): string {
  if (kind === "binary") return "yes or no";
  if (kind === "choice") return (options ?? []).map(shown).join(", ");
  return `${shown(low)} to ${shown(high)}${kind === "integer" ? ", whole" : ""}`;
}
