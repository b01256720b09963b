/** Of each parameter: whether all shapes have one value of it, or go along it. */

import { ControlOf } from "../inspector/control";
import { procedure } from "../state/studio";
import { Button } from "../ui/controls";
import { shown, words } from "../ui/numbers";
import type { Parameter } from "../wire/messages";
import { asked, change, lock, locked, switchVary, vary } from "./shapes";

export function Locks() {
  const some = Object.keys(locked.value).length > 0 || vary.value.length > 0;
  return (
    <section class="parameters">
      <header>
        <h3>Parameters</h3>
        <Button
          kind="quiet"
          icon="reset"
          disabled={!some}
          title="All parameters at random"
          onClick={() => change({ locked: {}, vary: [], base: null })}
        >
          All at random
        </Button>
      </header>
      <p class="soft">
        {vary.value.length > 0
          ? `Along ${vary.value.map(words).join(" and ")}; all others ${asked.value.base ? "are those of the shape that you chose" : "are at their defaults"}.`
          : "Lock what is to stay; choose one or two to go along."}
      </p>
      {procedure.value.parameters.map((parameter) => (
        <Row key={parameter.name} parameter={parameter} />
      ))}
    </section>
  );
}

function Row({ parameter }: { parameter: Parameter }) {
  const { name, kind, meaning } = parameter;
  const value = locked.value[name];
  const held = value !== undefined;
  const usual = asked.value.base?.[name] ?? parameter.default;
  const short = kind === "binary" || kind === "integer";
  const control = held && (
    <ControlOf
      parameter={parameter}
      value={value}
      found={null}
      predicted={null}
      spread={null}
      disabled={false}
      told=""
      onChange={(next) => lock(name, next)}
    />
  );
  return (
    <div class="parameter" data-lock={name} role="group" aria-label={name} title={meaning || undefined}>
      <div class="head">
        <span class="label grow">{words(name)}</span>
        {held && kind === "scalar" && <output>{shown(value)}</output>}
        {short && control}
        <Button
          kind="quiet"
          icon="lock"
          pressed={held}
          title={held ? `Let ${name} be random again` : `Lock ${name} at ${shown(usual)}`}
          onClick={() => lock(name, held ? null : usual)}
        />
        <Button
          kind="quiet"
          icon="along"
          pressed={vary.value.includes(name)}
          title={vary.value.includes(name) ? `Stop going along ${name}` : `Go along ${name}`}
          onClick={() => switchVary(name)}
        />
      </div>
      {!short && control}
    </div>
  );
}
