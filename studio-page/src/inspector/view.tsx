/** The inspector: one reference and its replica, large, with everything about them. */

import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { neighbour } from "../collection/order";
import { at } from "../collection/focus";
import { PrintedFor } from "../console/panel";
import { mark } from "../state/actions";
import { useKeys } from "../state/keys";
import { go, inspect } from "../state/route";
import { dimension, marks, tileOf } from "../state/studio";
import { Button, Empty, Segments } from "../ui/controls";
import type { Slug } from "../wire/messages";
import { VIEWS } from "../viewer/eye";
import type { View } from "../viewer/eye";
import { Causes, regionsShown } from "./causes";
import { Facts, Figures, Judgement, Standing } from "./figures";
import { LayoutSwitch, Legend, OverLegend } from "./legend";
import { MeasureCard } from "./measuring/card";
import { take, tool, undo } from "./measuring/points";
import { NotedOf } from "./noted";
import { Parameters } from "./parameters";
import { Pictures } from "./pictures";
import { DifferenceLegend, Plane } from "./plane";
import { edited } from "./pair/edits";
import { colouring, failure, open, original, redo, replica, reset, undo as undoEdit } from "./pair/session";
import { furnished, layout, parallel, stage, wireframe } from "./pair/layout";
import { Steps } from "../history/steps";
import { ToldOf } from "./told";
import { Space } from "./space";
import { StageTools } from "./stage/tools";

export function Inspector({ slug }: { slug: Slug }) {
  return tileOf(slug) ? <Pair slug={slug} /> : <Gone slug={slug} />;
}

/** An address may name a reference that was there once, or never. */
function Gone({ slug }: { slug: Slug }) {
  const close = () => go("collection");
  useKeys("Inspector", [{ keys: ["Escape"], does: "close", run: close }]);
  return (
    <Empty title="There is no such reference">
      <p>
        The collection has no <code>{slug}</code>. Its file was renamed or taken away, or the address is wrong.
      </p>
      <Button onClick={close}>To the collection</Button>
    </Empty>
  );
}

function Pair({ slug }: { slug: Slug }) {
  const webgl = useSignal(true);
  const flat = dimension.value === 2;
  useEffect(() => {
    at.value = slug;
    take(tool.value);
    return open(slug);
  }, [slug]);
  const self = useRef<HTMLDivElement>(null);
  useEffect(() => self.current?.focus(), []);
  useEffect(() => {
    if (!flat && layout.value === "difference") layout.value = "over";
  }, [flat]);
  const step = (by: number) => {
    const next = neighbour(slug, by);
    if (next) inspect(next);
  };
  const close = () => go("collection");
  return (
    <div class="inspector" role="main" aria-label="Inspector" tabIndex={-1} ref={self}>
      <InspectorKeys slug={slug} step={step} close={close} />
      <div class="workplace">
        <div class="tools">
          <LayoutSwitch flat={flat} />
          {!flat && webgl.value && <SpaceTools />}
        </div>
        <div class="shapes">
          {flat ? <Plane /> : webgl.value ? <Space onFail={() => (webgl.value = false)} /> : <Pictures />}
          <Captions />
        </div>
        <div class="foot">
          {flat ? (
            layout.value === "over" ? (
              <OverLegend />
            ) : (
              layout.value === "difference" && <DifferenceLegend />
            )
          ) : (
            <Legend />
          )}
        </div>
      </div>
      <aside>
        <header>
          <h2 title={slug}>{tileOf(slug)?.name ?? slug}</h2>
          <Button kind="quiet" icon="left" title="Previous (←)" onClick={() => step(-1)} />
          <Button kind="quiet" icon="right" title="Next (→)" onClick={() => step(1)} />
          <Button kind="quiet" icon="close" title="Close (Esc)" onClick={close} />
        </header>
        {!flat && webgl.value && <MeasureCard />}
        <Figures />
        <Standing />
        <Parameters />
        <Causes />
        <Judgement />
        <PrintedFor slug={slug} />
        <Facts />
        <NotedOf slug={slug} />
        <Steps slug={slug} />
        <ToldOf />
      </aside>
    </div>
  );
}

function SpaceTools() {
  return (
    <>
      <Segments
        label="Colours"
        value={colouring.value}
        onChange={(value) => (colouring.value = value)}
        options={[
          { value: "plain", label: "Plain", title: "One colour each (v)" },
          { value: "distance", label: "Residual", title: "How far each place is from the other surface (v)" },
          { value: "parts", label: "Parts", title: "By the labels of the procedure's parts (v)" },
        ]}
      />
      <Segments
        label="Measure"
        value={tool.value}
        onChange={(value) => take(tool.value === value ? "off" : value)}
        options={[
          { value: "off", label: "Orbit", title: "Turn with the mouse" },
          { value: "distance", label: "Distance", title: "Measure between two points (m)" },
          { value: "angle", label: "Angle", title: "Measure at a corner (a)" },
        ]}
      />
      <div class="views">
        {(Object.keys(VIEWS) as View[]).map((view) => (
          <Button key={view} kind="quiet" title={`Look from: ${view}`} onClick={() => stage.value?.eye.look(view)}>
            {view === "three-quarter" ? "3/4" : view}
          </Button>
        ))}
        <StageTools />
      </div>
    </>
  );
}

/** Which half is which, and whether what is shown is still true. */
function Captions() {
  const beside = layout.value === "beside";
  return (
    <div class={`captions ${beside ? "" : "over"}`}>
      <span>{beside ? "Reference" : "Reference and replica"}</span>
      {beside && (
        <span>
          Replica
          {failure.value && replica.value ? (
            <b class="badge bad">last good</b>
          ) : (
            edited.value && <b class="badge">edited</b>
          )}
        </span>
      )}
      {!original.value && <span class="soft">reading…</span>}
    </div>
  );
}

function InspectorKeys({ slug, step, close }: { slug: Slug; step: (by: number) => void; close: () => void }) {
  const cycle = <T,>(all: readonly T[], now: T): T => all[(all.indexOf(now) + 1) % all.length]!;
  const layouts = dimension.value === 2 ? (["beside", "over", "difference"] as const) : (["beside", "over"] as const);
  const say = (same: boolean) => {
    const given = marks.value.find(({ a, b }) => a === slug && b === slug)?.same;
    mark(slug, slug, given === same ? null : same);
  };
  const turn = (right: number, up: number, closer = 1) => stage.value?.eye.turn(right, up, closer);
  useKeys("Inspector", [
    { keys: ["Escape"], does: "stop measuring; close", run: () => (tool.value === "off" ? close() : take("off")) },
    { keys: ["ArrowRight", "n"], does: "next", run: () => step(1) },
    { keys: ["ArrowLeft", "p"], does: "previous", run: () => step(-1) },
    {
      keys: ["b"],
      does: "side by side, overlay",
      run: () => (layout.value = cycle<typeof layout.value>(layouts, layout.value)),
    },
    {
      keys: ["v"],
      does: "plain, residual, parts",
      run: () => (colouring.value = cycle(["plain", "distance", "parts"], colouring.value)),
    },
    { keys: ["r"], does: "parameters as found", run: () => reset() },
    {
      keys: ["z", "Z"],
      modified: true,
      does: "undo a change of parameters, with Shift do it again",
      run: ({ shiftKey }) => (shiftKey ? redo() : undoEdit()),
    },
    { keys: ["y"], modified: true, does: "do it again", run: redo },
    { keys: ["m"], does: "measure a distance", run: () => take(tool.value === "distance" ? "off" : "distance") },
    { keys: ["a"], does: "measure an angle", run: () => take(tool.value === "angle" ? "off" : "angle") },
    { keys: ["Backspace"], does: "take the last point back", run: undo },
    { keys: ["h", "l"], does: "turn", run: ({ key }) => turn(key === "l" ? 15 : -15, 0) },
    { keys: ["j", "k"], does: "tilt", run: ({ key }) => turn(0, key === "k" ? 10 : -10) },
    { keys: ["+", "=", "-"], does: "closer, farther", run: ({ key }) => turn(0, 0, key === "-" ? 0.85 : 1 / 0.85) },
    { keys: ["0"], does: "look from three quarters", run: () => stage.value?.eye.look("three-quarter") },
    { keys: ["."], does: "fit both shapes to the pane", run: () => stage.value?.fit() },
    { keys: ["w"], does: "wireframe", run: () => (wireframe.value = !wireframe.value) },
    { keys: ["g"], does: "grid and axes", run: () => (furnished.value = !furnished.value) },
    { keys: ["o"], does: "with or without perspective", run: () => (parallel.value = !parallel.value) },
    { keys: ["e"], does: "mark where they differ", run: () => (regionsShown.value = !regionsShown.value) },
    { keys: ["s"], does: "mark the pair as the same", run: () => say(true) },
    { keys: ["x"], does: "mark the pair as different", run: () => say(false) },
  ]);
  return null;
}
