/** A map of the collection: references and random shapes of the procedure, alike ones near each other. */

import { useSignal, useSignalEffect } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { select, selected } from "../curating/selection";
import { change as explore } from "../explore/shapes";
import { table, watchTable } from "../parameters/table";
import { tintOf } from "../state/scale";
import { complain } from "../state/notices";
import { go, inspect } from "../state/route";
import { collection, duplicates, procedure, tags, tiles } from "../state/studio";
import { Button, Select } from "../ui/controls";
import { plural, shown as said, words } from "../ui/numbers";
import { Picture } from "../ui/picture";
import type { CollectionMap, MappedSample, Slug, Tile } from "../wire/messages";
import { requests } from "../wire/requests";
import { colourOf, legendOf } from "./colours";
import type { Colouring } from "./colours";

const NONE: CollectionMap = { references: [], samples: [], left: 0 };
const REACH = 1.08;
type Box = { x0: number; y0: number; x1: number; y1: number };

/** shown: the references that pass the filters of the collection. */
export function MapView({ shown }: { shown: readonly Tile[] }) {
  const map = useSignal<CollectionMap | null>(null);
  const colouring = useSignal<Colouring>("grade");
  const over = useSignal<{ slug: Slug } | { sample: MappedSample } | null>(null);
  const box = useSignal<Box | null>(null);
  useEffect(watchTable, []);
  useSignalEffect(() => {
    // When all references are looked at, which may be later, duplicates are told.
    void [duplicates.value, collection.value.tiles.length, procedure.value.digest];
    requests.map().then((found) => (map.value = found), complain);
  });
  const { references, samples, left } = map.value ?? NONE;
  const there = new Map(shown.map((tile) => [tile.slug, tile]));
  const parameters = new Map(table.value.rows.map(({ slug, parameters, active }) => [slug, { parameters, active }]));
  const dots = references.flatMap(({ slug, x, y }) => {
    const tile = there.get(slug);
    return tile ? [{ tile, x, y: -y, fill: colourOf(colouring.value, tile, parameters.get(slug)) }] : [];
  });
  const at = (event: PointerEvent): [number, number] => {
    const frame = (event.currentTarget as SVGElement).getBoundingClientRect();
    const side = Math.min(frame.width, frame.height);
    const from = (value: number, start: number, length: number) => ((value - start - length / 2) / side) * 2 * REACH;
    return [from(event.clientX, frame.left, frame.width), from(event.clientY, frame.top, frame.height)];
  };
  const drop = () => {
    const { x0, y0, x1, y1 } = box.value!;
    box.value = null;
    if (Math.abs(x1 - x0) < 0.02 && Math.abs(y1 - y0) < 0.02) return;
    const within = (value: number, a: number, b: number) => value >= Math.min(a, b) && value <= Math.max(a, b);
    select(dots.filter(({ x, y }) => within(x, x0, x1) && within(y, y0, y1)).map(({ tile }) => tile.slug));
  };
  return (
    <div class="map-view">
      <div class="row">
        <Select
          label="Colour"
          options={options()}
          value={colouring.value}
          onChange={(next) => (colouring.value = next)}
        />
        <p class="legend" data-map-legend>
          {legendOf(colouring.value).map(({ fill, label }) => (
            <span key={label}>
              <i class="swatch" style={{ backgroundColor: fill }} /> {label}
            </span>
          ))}
          <span>
            <i class="swatch sample" /> random shape of the procedure
          </span>
        </p>
      </div>
      <div class="map-frame">
        <svg
          class="map"
          viewBox={`${-REACH} ${-REACH} ${2 * REACH} ${2 * REACH}`}
          role="img"
          aria-label={`A map of ${plural(dots.length, "reference")} and ${plural(samples.length, "random shape")}; the tiles hold the same references`}
          onPointerDown={(event) => {
            if (event.button !== 0 || event.target !== event.currentTarget) return;
            event.currentTarget.setPointerCapture(event.pointerId);
            const [x, y] = at(event);
            box.value = { x0: x, y0: y, x1: x, y1: y };
          }}
          onPointerMove={(event) => {
            if (!box.value) return;
            const [x, y] = at(event);
            box.value = { ...box.value, x1: x, y1: y };
          }}
          onPointerUp={() => box.value && drop()}
          onPointerCancel={() => (box.value = null)}
        >
          {samples.map((sample, i) => (
            <rect
              key={`sample ${i}`}
              class="sample"
              x={sample.x - 0.011}
              y={-sample.y - 0.011}
              width={0.022}
              height={0.022}
              transform={`rotate(45 ${sample.x} ${-sample.y})`}
              onPointerEnter={() => (over.value = { sample })}
              onClick={() => open(sample)}
            />
          ))}
          {dots.map(({ tile, x, y, fill }) => (
            <circle
              key={tile.slug}
              cx={x}
              cy={y}
              r={0.018}
              data-dot={tile.slug}
              class={selected.value.has(tile.slug) ? "selected" : ""}
              style={{ fill }}
              onPointerEnter={() => (over.value = { slug: tile.slug })}
              onClick={() => inspect(tile.slug)}
            />
          ))}
          {box.value && (
            <rect
              class="brush"
              x={Math.min(box.value.x0, box.value.x1)}
              y={Math.min(box.value.y0, box.value.y1)}
              width={Math.abs(box.value.x1 - box.value.x0)}
              height={Math.abs(box.value.y1 - box.value.y0)}
            />
          )}
        </svg>
        <aside class="card">
          {!map.value && <p class="soft">Reading…</p>}
          {left > 0 && <p class="soft">{plural(left, "reference")} still to be looked at.</p>}
          <Under of={over.value} />
          <p class="soft">Drag over the map to select; click to open.</p>
        </aside>
      </div>
    </div>
  );
}

function open({ parameters }: MappedSample): void {
  const [first] = Object.keys(parameters);
  explore({ base: parameters, locked: {}, vary: first ? [first] : [] });
  go("explore");
}

function Under({ of }: { of: { slug: Slug } | { sample: MappedSample } | null }) {
  if (!of) return null;
  if ("sample" in of) {
    return (
      <dl class="values">
        {Object.entries(of.sample.parameters).map(([name, value]) => (
          <div key={name}>
            <dt>{words(name)}</dt>
            <dd>{said(value)}</dd>
          </div>
        ))}
      </dl>
    );
  }
  const tile = tiles.value.get(of.slug);
  if (!tile) return null;
  return (
    <>
      <b>{tile.name}</b>
      <div class="pair">
        <Picture url={tile.reference} tint={null} alt="reference" />
        <Picture url={tile.replica} tint={tintOf(tile)} alt="replica" dim={tile.stale} />
      </div>
      <Button onClick={() => inspect(tile.slug)}>Open</Button>
    </>
  );
}

function options(): { value: Colouring; label: string }[] {
  return [
    { value: "grade", label: "by grade" },
    { value: "fidelity", label: "by fidelity" },
    ...[...tags.value.keys()].map((tag) => ({ value: `tag ${tag}` as const, label: `by the tag ${tag}` })),
    ...procedure.value.parameters.map(({ name }) => ({
      value: `parameter ${name}` as const,
      label: `by ${words(name)}`,
    })),
  ];
}
