/** How references and the procedure's shapes stand: pictures with axes and sizes, so that the eye can tell. */

import { useSignal, useSignalEffect } from "@preact/signals";
import { complain } from "../state/notices";
import { bench, collection, procedure, tileOf } from "../state/studio";
import { Select } from "../ui/controls";
import { significant } from "../ui/numbers";
import type { Reference, Slug, Vector } from "../wire/messages";
import { referenceUrl, replicaUrl, requests } from "../wire/requests";
import { AXES, axisOf, cameraOf, dot, project as projected } from "./axes";

const CAMERA = { azimuth: 35, elevation: 25 };
const SIDE = 240;

export function Standing() {
  const slug = collection.value.tiles.find(({ problem }) => problem === null)?.slug ?? null;
  const known = useSignal<Reference | null>(null);
  useSignalEffect(() => {
    const first = collection.value.tiles.find(({ problem }) => problem === null)?.slug;
    // Its picture changes when its axes do.
    void (first && tileOf(first)?.reference);
    if (first && bench.value === "ready") void requests.reference(first).then((found) => (known.value = found), quiet);
  });
  const open = known.value?.slug === slug ? known.value : null;
  if (!slug) return null;
  return (
    <div class="standing-pair">
      <Figure
        url={bench.value === "ready" ? `${referenceUrl(slug, CAMERA)}&v=${tileOf(slug)?.reference ?? ""}` : null}
        name={tileOf(slug)?.name ?? slug}
        size={open?.units ? own(open) : null}
        axes={open?.units ? { up: axisOf(open.units, 1), front: axisOf(open.units, 2) } : null}
      />
      <Figure
        url={
          procedure.value.state === "good"
            ? `${replicaUrl(null, CAMERA, { parameters: null, beyond: [] })}&v=${procedure.value.digest}`
            : null
        }
        name={`${procedure.value.name || "the procedure"}, first values`}
        size={null}
        axes={null}
      />
      <div class="say">
        <p>
          Both are to stand on their feet and look the same way. If they do not, say which axis of the files points up,
          and which to the front:
        </p>
        {open && <Axes open={open} />}
        <p class="soft">
          Sizes may be in any unit: shapes are compared at the same size. The files' own sizes are used where the
          procedure says <code>size="given"</code>.
        </p>
      </div>
    </div>
  );
}

const quiet = () => undefined;

/** Extents across, up and to the front, in the file's units. */
function own({ units }: Reference): Vector | null {
  if (!units || units.axes.length !== 3) return null;
  const along = units.axes.map((axis) => {
    const place = axis.findIndex((part) => Math.abs(part) > 0.5);
    return units.size[place] ?? 0;
  });
  return along as Vector;
}

function Axes({ open }: { open: Reference }) {
  if (!open.units) return null;
  const now = { up: axisOf(open.units, 1), front: axisOf(open.units, 2) };
  const all: Slug[] = collection.value.tiles.map(({ slug }) => slug);
  const say = (told: Partial<Reference["told"]>) => {
    const both = { ...open.told, up: open.told.up ?? now.up, front: open.told.front ?? now.front, ...told };
    requests.tell({ slugs: all, told: both }).catch(complain);
  };
  const options = (not: string) =>
    AXES.filter((axis) => axis.replace("-", "") !== not.replace("-", "")).map((axis) => ({ value: axis, label: axis }));
  const otherFront = (up: string) => (up.endsWith("z") ? "-y" : "z") as typeof now.front;
  return (
    <div class="row">
      <Select
        label="Up"
        options={AXES.map((axis) => ({ value: axis, label: axis }))}
        value={now.up}
        onChange={(up) => say({ up, ...(up.endsWith(now.front.replace("-", "")) ? { front: otherFront(up) } : {}) })}
      />
      <Select label="Front" options={options(now.up)} value={now.front} onChange={(front) => say({ front })} />
      <span class="soft">for all {all.length}</span>
    </div>
  );
}

type Point = readonly [number, number];
/** Where the compass stands in a picture, and how long its arrows are. */
const COMPASS: Point = [46, 196];
const LONG = 38;
const line = (from: Point, to: Point): string => `M${from.map(tenth).join(" ")}L${to.map(tenth).join(" ")}`;
const tenth = (part: number): string => part.toFixed(1);

/** A picture, and over it the box of the shape with its axes and sizes. */
function Figure(props: {
  url: string | null;
  name: string;
  size: Vector | null;
  axes: { up: string; front: string } | null;
}) {
  const failed = useSignal("");
  const { url, name, size, axes } = props;
  const camera = cameraOf(CAMERA);
  const [x, y, z] = size ? (size.map((side) => side / Math.max(...size) / 2) as Vector) : [0, 0, 0];
  const at = (point: Vector) => projected(camera, point, SIDE);
  const [base, foot, right] = [at([-x, -y, -z]), at([-x, -y, z]), at([x, -y, z])];
  const tip = (axis: Vector): Point => [
    COMPASS[0] + LONG * dot(axis, camera.right),
    COMPASS[1] - LONG * dot(axis, camera.up),
  ];
  const [up, front] = [tip([0, 1, 0]), tip([0, 0, 1])];
  const number = (side: number) => significant(side, 3);
  return (
    <figure data-standing-of={name}>
      <div class="shown">
        {url && failed.value !== url ? (
          <img src={url} alt={name} onError={() => (failed.value = url)} />
        ) : (
          <span class="soft">{url ? "no picture" : "drawing…"}</span>
        )}
        <svg viewBox={`0 0 ${SIDE} ${SIDE}`} aria-hidden="true">
          <defs>
            <marker id="arrow-head" viewBox="0 0 8 8" refX="6" refY="4" markerWidth="7" markerHeight="7" orient="auto">
              <path d="M0 0l8 4-8 4z" class="head" />
            </marker>
          </defs>
          {size && <path class="box" d={`${line(base, foot)}${line(foot, right)}`} />}
          <path class="axis up" d={line(COMPASS, up)} />
          <path class="axis front" d={line(COMPASS, front)} />
          <text x={up[0]} y={up[1] - 6} class="middle">
            {axes ? `up: ${axes.up}` : "up"}
          </text>
          <text x={front[0] + 4} y={front[1] + 14} class="middle">
            {axes ? `front: ${axes.front}` : "front"}
          </text>
        </svg>
      </div>
      <figcaption>
        <b>{name}</b>
        {size && (
          <span class="soft" title="In the units of its file">
            {number(size[0])} wide, {number(size[1])} high, {number(size[2])} deep
          </span>
        )}
      </figcaption>
    </figure>
  );
}
