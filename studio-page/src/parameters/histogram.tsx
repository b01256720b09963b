/** One parameter: where the references lie, how well it is found, and which ends are pressed. */

import { Icon } from "../ui/icons";
import { fixed, percent, plural, significant, words } from "../ui/numbers";
import { brushed, brushes, brushing, toggleBin } from "./brushes";
import type { Spread } from "./brushes";
import { table } from "./table";

const HEIGHT = 54;

export function ParameterCard({ spread }: { spread: Spread }) {
  const { parameter, bins, members, idle, pressed } = spread;
  const { name, kind, low, high, meaning } = parameter;
  const most = Math.max(1, ...members.map(({ length }) => length));
  const chosen = brushes.value[name] ?? [];
  const some = brushing.value;
  return (
    <section class="parameter-card card" data-histogram={name} aria-label={name} title={meaning || undefined}>
      <header>
        <h3>{words(name)}</h3>
        <Recovered name={name} />
      </header>
      <div class={`histogram ${kind}`} role="group" aria-label={`References by ${name}`}>
        {members.map((slugs, i) => {
          const inside = some ? slugs.filter((slug) => brushed.value.has(slug)).length : 0;
          const label = `${words(name)} ${bins[i]!.label}: ${plural(slugs.length, "reference")}`;
          return (
            <button
              key={i}
              type="button"
              class={`bar ${slugs.length ? "" : "none"}`}
              aria-pressed={chosen.includes(i)}
              aria-label={label}
              title={label}
              onClick={() => toggleBin(name, i)}
            >
              <i style={{ height: `${(slugs.length / most) * HEIGHT}px` }} />
              {inside > 0 && <i class="inside" style={{ height: `${(inside / most) * HEIGHT}px` }} />}
            </button>
          );
        })}
      </div>
      <div class={`ends ${bins.length < 6 ? "each" : ""}`} aria-hidden="true">
        {kind === "scalar" || bins.length > 6 ? (
          <>
            <span>{kind === "choice" ? bins[0]!.label : significant(low ?? 0, 3)}</span>
            <span>{kind === "choice" ? bins.at(-1)!.label : significant(high ?? 0, 3)}</span>
          </>
        ) : (
          bins.map(({ label }) => <span key={label}>{label}</span>)
        )}
      </div>
      <Pressed name={name} pressed={pressed} count={members.flat().length} />
      {idle > 0 && <p class="soft">It changes nothing in {idle}.</p>}
    </section>
  );
}

/** An end counts as pressed where a tenth of the references rest on it, and three at least. */
const MANY = 0.1;
const LEAST = 3;

function Pressed({ name, pressed, count }: { name: string; pressed: [number, number]; count: number }) {
  const told = (["lower", "upper"] as const).flatMap((end, i) =>
    pressed[i]! >= Math.max(LEAST, MANY * count) ? [`${pressed[i]} of ${count} at its ${end} end`] : [],
  );
  if (!told.length) return null;
  return (
    <p class="warn pressed" data-pressed={name}>
      <Icon name="limit" /> {told.join(", ")}
    </p>
  );
}

/** How well the network of the run finds it on samples that it had not seen. */
function Recovered({ name }: { name: string }) {
  const found = table.value.validation[name];
  const number = (key: string) => (typeof found?.[key] === "number" ? found[key] : null);
  const [error, right, f1] = [number("mae"), number("accuracy"), number("f1")];
  if (error === null && right === null) return <span class="soft">not predicted yet</span>;
  const rows = number("rows") ?? 0;
  const from = `On ${plural(rows, "sample")} that the network had not seen`;
  const quality = error === null ? (right ?? 0) : 1 - 3 * error;
  return (
    <span
      class={`recovered ${quality > 0.8 ? "good" : quality > 0.4 ? "warn" : "bad"}`}
      data-recovered={name}
      title={
        error === null
          ? `${from}: right in ${percent(right ?? 0)}, F1 ${fixed(f1, 2)}`
          : `${from}: the mean error as a share of its Range`
      }
    >
      {error === null ? `right in ${percent(right ?? 0)}` : `± ${percent(error)} of its Range`}
    </span>
  );
}
