/** All parameters of the open pair: live, with what was predicted for them. */

import { proposeRange } from "../loop/editing";
import { MODIFIER } from "../state/keys";
import type { TargetedKeyboardEvent } from "preact";
import { useLayoutEffect, useRef } from "preact/hooks";
import { procedure } from "../state/studio";
import { Button } from "../ui/controls";
import { Icon } from "../ui/icons";
import { percent, shown, significant, words } from "../ui/numbers";
import type { Parameter, Value } from "../wire/messages";
import { ControlOf } from "./control";
import { edited, past, undone } from "./pair/edits";
import { active, alone, atLimit, isBeyond, redo, reference, reset, resetOne, set, undo, values } from "./pair/session";

export function Parameters() {
  const found = reference.value;
  const { parameters } = procedure.value;
  const changed = edited.value !== null && parameters.some(({ name }) => differs(name));
  return (
    <section class="parameters" data-own-undo>
      <header>
        <h3>Parameters</h3>
        <Button
          kind="quiet"
          icon="undo"
          disabled={!past.value.length}
          title={`Undo the last change of parameters (${MODIFIER}Z)`}
          onClick={undo}
        />
        <Button
          kind="quiet"
          icon="redo"
          disabled={!undone.value.length}
          title={`Do it again (${MODIFIER}Shift Z)`}
          onClick={redo}
        />
        {!alone.value && (
          <>
            <Button
              kind="quiet"
              disabled={!found?.predicted}
              title="Set everything to what the network predicted, before the search"
              onClick={() => reset(found?.predicted ?? null)}
            >
              As predicted
            </Button>
            <Button
              kind="quiet"
              icon="reset"
              disabled={!changed}
              title="Back to what was found (r)"
              onClick={() => reset()}
            >
              As found
            </Button>
          </>
        )}
      </header>
      {parameters.length === 0 && <p class="soft">The procedure has no parameters that could be read.</p>}
      {parameters.map((parameter) => (
        <Row key={parameter.name} parameter={parameter} />
      ))}
    </section>
  );
}

const differs = (name: string): boolean => {
  const found = reference.value?.parameters?.[name];
  const now = values.value[name];
  if (found === undefined || now === undefined) return false;
  return typeof found === "number" && typeof now === "number" ? Math.abs(found - now) > 1e-9 : found !== now;
};

/** One line of a fixed height: nothing moves under the pointer that drags. */
function Row({ parameter }: { parameter: Parameter }) {
  const { name, kind, meaning } = parameter;
  const found = reference.value;
  const value = values.value[name] ?? parameter.default;
  const used = active.value.size === 0 || active.value.has(name);
  const predicted = predictionSaid(parameter, found?.predicted?.[name] ?? null);
  const told = [used ? "" : NO_EFFECT, rangeSaid(parameter), predicted].filter(Boolean).join("\n");
  return (
    <div
      class={`parameter ${kind} ${used ? "" : "unused"}`}
      data-parameter={name}
      role="group"
      aria-label={name}
      title={meaning || undefined}
    >
      <span class="label" title={meaning ? `${name}: ${meaning}` : name}>
        {words(name)}
      </span>
      <ControlOf
        parameter={parameter}
        value={value}
        found={found?.parameters?.[name] ?? null}
        predicted={found?.predicted?.[name] ?? null}
        spread={found?.spread?.[name] ?? null}
        disabled={!used}
        told={told}
        onChange={(next) => set(name, next)}
      />
      {kind === "scalar" && <NumberField parameter={parameter} text={significant(Number(value))} disabled={!used} />}
      <Remark parameter={parameter} used={used} predicted={predicted} told={told} />
      {isBeyond(parameter, value) && <Beyond parameter={parameter} value={Number(value)} />}
    </div>
  );
}

const NO_EFFECT = "With the other parameters as they are, this one changes nothing";

const rangeSaid = ({ low, high }: Parameter): string =>
  low === null || high === null ? "" : `Range: ${shown(low)} to ${shown(high)}`;

/** What there is to say of the value, in a place that is always kept for it. */
function Remark(props: { parameter: Parameter; used: boolean; predicted: string; told: string }) {
  const { parameter, used, predicted, told } = props;
  const { name, kind } = parameter;
  const found = reference.value;
  const limited = atLimit.value.has(name) && used;
  const longer = limited && edited.value === null && found?.longer.includes(name);
  return (
    <span class="remark" title={told}>
      {differs(name) ? (
        <Button
          kind="quiet"
          icon="reset"
          title={`${name} as found: ${shown(found?.parameters?.[name])}`}
          onClick={() => resetOne(name)}
        />
      ) : limited ? (
        <span
          class={longer ? "badge warn" : "soft"}
          role="img"
          aria-label={longer ? "Range too short" : "at its end"}
          title={
            longer ? "A longer Range brings the replica nearer: see why it differs" : "It rests on the end of its Range"
          }
        >
          <Icon name="limit" />
        </span>
      ) : (
        kind !== "scalar" && predicted && <i class="prediction" role="img" aria-label={predicted} title={predicted} />
      )}
    </span>
  );
}

/** The DOM holds what is being typed: an answer that arrives meanwhile does not take it away. */
function NumberField({ parameter, text, disabled }: { parameter: Parameter; text: string; disabled: boolean }) {
  const field = useRef<HTMLInputElement>(null);
  useLayoutEffect(() => {
    field.current!.value = text;
  }, [text]);
  return (
    <input
      class="number"
      type="number"
      ref={field}
      aria-label={`${parameter.name}, typed`}
      title={parameter.meaning || undefined}
      step="any"
      disabled={disabled}
      onChange={(event) => typed(parameter, event.currentTarget)}
      onKeyDown={(event) => takeBack(event, parameter)}
    />
  );
}

/** A value outside the Range was tried; the Range can be made to hold it. */
function Beyond({ parameter: { name, low, high }, value }: { parameter: Parameter; value: number }) {
  const wider = [Math.min(low ?? value, value), Math.max(high ?? value, value)].map((end) => significant(end));
  return (
    <span class="beyond">
      <span class="badge warn" title={`The Range goes from ${shown(low)} to ${shown(high)}; this is a trial`}>
        beyond its Range
      </span>
      <Button
        title={`Change the Range to ${wider.join(" … ")} in the editor; you save it, or not`}
        onClick={() => void proposeRange(name, wider[0]!, wider[1]!)}
      >
        Widen
      </Button>
    </span>
  );
}

/** A typed value is tried, inside the Range or not. What is no number gives way to the value that holds. */
function typed(parameter: Parameter, input: HTMLInputElement): void {
  const value = input.valueAsNumber;
  if (Number.isFinite(value)) set(parameter.name, value);
  else input.value = holds(parameter);
}

/** What the field of a number shows when nothing is being typed. */
const holds = ({ name, default: usual }: Parameter): string => significant(Number(values.value[name] ?? usual));

/** Undoing in a field takes first what is typed and not tried yet; never does it show what does not hold. */
function takeBack(event: TargetedKeyboardEvent<HTMLInputElement>, parameter: Parameter): void {
  const undoes = (event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "z";
  const now = holds(parameter);
  if (!undoes || event.currentTarget.value === now) return;
  event.preventDefault();
  event.currentTarget.value = now;
}

/** What the network predicted before the search, and how sure it was. */
function predictionSaid({ name, kind }: Parameter, value: Value | null): string {
  const found = reference.value;
  if (value === null || !found) return "";
  const spread = found.spread?.[name];
  const likely = found.likelihood?.[name];
  const best =
    likely &&
    Object.entries(likely)
      .sort(([, a], [, b]) => b - a)
      .slice(0, 2);
  const sure = best && best[0] && best[0][1] > 0.995;
  const said =
    kind === "scalar" || !best
      ? `${shown(value)}${spread === undefined ? "" : ` ± ${significant(spread, 2)}`}`
      : best
          .filter(([, share]) => share > 0.005)
          .map(([option, share]) => `${readable(option)}${sure ? "" : ` ${percent(share)}`}`)
          .join(", ");
  return `Predicted before the search: ${said}`;
}

const readable = (option: string): string => ({ true: "yes", false: "no" })[option] ?? option;
