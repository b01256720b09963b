/** Parameters at a glance: where the references lie, how well each is found, which ends are pressed. */

import { useEffect } from "preact/hooks";
import { filter } from "../collection/order";
import { go, inspect } from "../state/route";
import { tiles } from "../state/studio";
import { Button, Empty } from "../ui/controls";
import { plural } from "../ui/numbers";
import { Picture } from "../ui/picture";
import { brushed, brushes, brushing, followBrushes, spreads } from "./brushes";
import { ParameterCard } from "./histogram";
import { Parallel } from "./parallel";
import { table, watchTable } from "./table";

const FEW = 40;

export function ParametersView() {
  useEffect(watchTable, []);
  useEffect(followBrushes, []);
  const { rows, samples } = table.value;
  if (!rows.length || !spreads.value.length) {
    return (
      <Empty title="No parameters are known yet">
        <p>After the first fit, this shows for each parameter where your references lie and how well it is found.</p>
      </Empty>
    );
  }
  return (
    <div class="parameters-view">
      <p class="soft">
        {plural(rows.length, "reference")} by the parameters of their replicas.
        {samples !== null && ` How well a parameter is found was measured on samples held out of ${samples}.`} Choose
        bars, or drag along an axis below, to select the references that lie there.
      </p>
      <Chosen />
      <div class="parameter-cards">
        {spreads.value.map((spread) => (
          <ParameterCard key={spread.parameter.name} spread={spread} />
        ))}
      </div>
      <Parallel />
    </div>
  );
}

function Chosen() {
  if (!brushing.value) return null;
  const slugs = [...brushed.value];
  const show = () => {
    filter.value = "selected";
    go("collection");
  };
  return (
    <section class="brushed card" aria-label="Selected references" data-brushed={slugs.length}>
      <header class="row">
        <b role="status">{plural(slugs.length, "reference")} selected</b>
        <Button disabled={!slugs.length} onClick={show}>
          Show in the collection
        </Button>
        <Button kind="quiet" icon="reset" onClick={() => (brushes.value = {})}>
          Select none
        </Button>
      </header>
      <ul>
        {slugs.slice(0, FEW).map((slug) => {
          const tile = tiles.value.get(slug);
          return (
            tile && (
              <li key={slug}>
                <button
                  type="button"
                  class="thumb"
                  title={tile.name}
                  aria-label={tile.name}
                  onClick={() => inspect(slug)}
                >
                  <Picture url={tile.reference} tint={null} alt="" />
                </button>
              </li>
            )
          );
        })}
        {slugs.length > FEW && <li class="soft">and {slugs.length - FEW} more</li>}
      </ul>
    </section>
  );
}
