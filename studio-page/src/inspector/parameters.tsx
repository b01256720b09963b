/** All parameters of the open pair: live, with what was predicted for them. */

import { procedure } from "../state/studio";
import { Button } from "../ui/controls";
import { percent, shown, significant, words } from "../ui/numbers";
import type { Parameter, Value } from "../wire/messages";
import { ControlOf } from "./control";
import { active, atLimit, edited, reference, reset, resetOne, set, values } from "./pair/session";

export function Parameters() {
  const found = reference.value;
  const { parameters } = procedure.value;
  const changed = edited.value !== null && parameters.some(({ name }) => differs(name));
  return (
    <section class="parameters">
      <header>
        <h3>Parameters</h3>
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

function Row({ parameter }: { parameter: Parameter }) {
  const { name, kind, meaning } = parameter;
  const found = reference.value;
  const value = values.value[name] ?? parameter.default;
  const used = active.value.size === 0 || active.value.has(name);
  const limited = atLimit.value.has(name) && used;
  const control = (
    <ControlOf
      parameter={parameter}
      value={value}
      found={found?.parameters?.[name] ?? null}
      predicted={found?.predicted?.[name] ?? null}
      spread={found?.spread?.[name] ?? null}
      disabled={!used}
      onChange={(next) => set(name, next)}
    />
  );
  const short = kind === "binary" || kind === "integer";
  return (
    <div
      class={`parameter ${used ? "" : "unused"}`}
      data-parameter={name}
      role="group"
      aria-label={name}
      title={meaning || undefined}
    >
      <div class="head">
        <span class="label" title={meaning ? `${name}: ${meaning}` : name}>
          {words(name)}
        </span>
        {used ? <Predicted parameter={parameter} value={found?.predicted?.[name] ?? null} /> : <NoEffect />}
        {limited && (
          <span class="badge warn" title="It rests on the end of its Range: perhaps the Range ends too soon">
            at limit
          </span>
        )}
        {differs(name) && (
          <Button
            kind="quiet"
            icon="reset"
            title={`${name} as found: ${shown(found?.parameters?.[name])}`}
            onClick={() => resetOne(name)}
          />
        )}
        {kind === "scalar" && (
          <input
            class="number"
            type="number"
            aria-label={`${name}, typed`}
            title={meaning || undefined}
            step="any"
            disabled={!used}
            value={significant(Number(value))}
            onChange={(event) => typed(parameter, event.currentTarget)}
          />
        )}
        {short && control}
      </div>
      {!short && control}
    </div>
  );
}

function NoEffect() {
  return (
    <span class="prediction" title="With the other parameters as they are, this one changes nothing">
      no effect
    </span>
  );
}

/** A typed value is held inside the Range. */
function typed({ name, low, high }: Parameter, input: HTMLInputElement): void {
  const value = input.valueAsNumber;
  if (Number.isFinite(value)) set(name, Math.min(high ?? value, Math.max(low ?? value, value)));
}

function Predicted({ parameter: { name, kind }, value }: { parameter: Parameter; value: Value | null }) {
  const found = reference.value;
  if (value === null || !found) return null;
  const spread = found.spread?.[name];
  const likely = found.likelihood?.[name];
  const best =
    likely &&
    Object.entries(likely)
      .sort(([, a], [, b]) => b - a)
      .slice(0, 2);
  const sure = best && best[0] && best[0][1] > 0.995;
  return (
    <span class="prediction" title="What the network predicted, before the search">
      <i />
      {kind === "scalar" || !best
        ? `${shown(value)}${spread === undefined ? "" : ` ± ${significant(spread, 2)}`}`
        : best
            .filter(([, share]) => share > 0.005)
            .map(([option, share]) => `${readable(option)}${sure ? "" : ` ${percent(share)}`}`)
            .join(", ")}
    </span>
  );
}

const readable = (option: string): string => ({ true: "yes", false: "no" })[option] ?? option;
