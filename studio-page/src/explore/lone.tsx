/** One shape without a reference: large, with its sliders. */

import { effect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { useSignal } from "@preact/signals";
import { Color } from "three";
import { Parameters } from "../inspector/parameters";
import { COLOURS } from "../inspector/pair/layout";
import { failure, openAlone, outcome, redo, replica, reset, undo, values } from "../inspector/pair/session";
import { copy } from "../state/actions";
import { useKeys } from "../state/keys";
import { go } from "../state/route";
import { dimension } from "../state/studio";
import { theme } from "../state/theme";
import { Button, Empty } from "../ui/controls";
import { significant } from "../ui/numbers";
import { Picture } from "../ui/picture";
import { plain } from "../viewer/paint";
import { replicaShown } from "../viewer/diagnostics";
import { Stage } from "../viewer/stage";
import { change, faults, planned, shapes } from "./shapes";

export function LoneShape({ index }: { index: number }) {
  const start = planned.value[index];
  const drawn = start && JSON.stringify(start);
  useEffect(() => (start ? openAlone(start) : undefined), [index, drawn]);
  const count = planned.value.length;
  const step = (by: number) => (location.hash = `explore/${(index + by + count) % count}`);
  if (!start) {
    return (
      <Empty title="This shape is not there">
        <Button onClick={() => go("explore")}>Back to the shapes</Button>
      </Empty>
    );
  }
  return (
    <div class="inspector lone" role="region" aria-label={`Shape ${index + 1}`}>
      <LoneKeys step={step} />
      <div class="workplace">
        <div class="shapes">{dimension.value === 2 ? <Sheet /> : <Solid index={index} />}</div>
        <div class="foot">
          <p class="legend soft">{failure.value ? failure.value.message : size()}</p>
        </div>
      </div>
      <aside>
        <header>
          <h2>Shape {index + 1}</h2>
          <Button kind="quiet" icon="left" title="Previous (←)" onClick={() => step(-1)} />
          <Button kind="quiet" icon="right" title="Next (→)" onClick={() => step(1)} />
          <Button kind="quiet" icon="close" title="Close (Esc)" onClick={() => go("explore")} />
        </header>
        <section>
          <p data-lone-soundness>{soundnessSaid(index)}</p>
          <div class="row">
            <Button icon="reset" title="Back to the values that were drawn" onClick={() => reset(start)}>
              As drawn
            </Button>
            <Button title="Go along a parameter from this shape on" onClick={varyAround}>
              Vary this one
            </Button>
            <Button
              icon="copy"
              title="Its parameters as JSON"
              onClick={() => void copy(JSON.stringify(values.value, null, 1), "the parameters")}
            >
              Copy
            </Button>
          </div>
        </section>
        <Parameters />
      </aside>
    </div>
  );
}

/** The grid goes along the first parameter from this shape on, until another one is chosen. */
function varyAround(): void {
  const first = Object.keys(values.value)[0];
  change({ base: values.value, locked: {}, vary: first ? [first] : [] });
  go("explore");
}

function soundnessSaid(index: number): string {
  const sound = shapes.value.get(index)?.soundness;
  if (!sound) return "";
  const wrong = faults(sound);
  return `As drawn: ${wrong.length ? wrong.join(", ") : "sound"}; ${sound.triangles} triangles.`;
}

const size = () => {
  const units = outcome.value?.units;
  return units ? `${units.size.map((side) => significant(side, 4)).join(" × ")}, in the procedure's units` : "";
};

function LoneKeys({ step }: { step: (by: number) => void }) {
  useKeys("Shape", [
    { keys: ["Escape"], does: "back to all shapes", run: () => go("explore") },
    { keys: ["ArrowRight", "n"], does: "next", run: () => step(1) },
    { keys: ["ArrowLeft", "p"], does: "previous", run: () => step(-1) },
    { keys: ["z", "Z"], modified: true, does: "undo a change, with Shift do it again", run: (e) => (e.shiftKey ? redo() : undo()) }, // prettier-ignore
  ]);
  return null;
}

function Sheet() {
  const shape = replica.value;
  return (
    <div class="plane">
      <svg class="sheet" viewBox="-0.54 -0.54 1.08 1.08">
        <g transform="scale(1 -1)">{shape?.type === "drawing" && <path class="ink" d={shape.path} />}</g>
      </svg>
    </div>
  );
}

function Solid({ index }: { index: number }) {
  const place = useRef<HTMLDivElement>(null);
  const webgl = useSignal(true);
  useEffect(() => {
    let open: Stage;
    try {
      open = new Stage(place.current!);
    } catch {
      webgl.value = false;
      return undefined;
    }
    open.arrange("over");
    const end = effect(() => {
      const found = replica.value;
      const mesh = found?.type === "mesh" ? found : null;
      const colours = COLOURS[theme.value];
      const { replica: surface } = open.surfaces;
      surface.show(mesh?.solid ?? null);
      if (mesh) surface.cover(mesh.solid.sight, plain(colours.replica));
      const failed = failure.value !== null;
      surface.dress(failed ? 0.35 : 1, new Color().setStyle(colours.ink), failed ? 0.25 : 0.75);
      replicaShown();
      open.invalidate();
    });
    return () => {
      end();
      open.dispose();
    };
  }, []);
  if (!webgl.value) return <Picture url={shapes.value.get(index)?.picture ?? null} tint={null} alt="The shape" />;
  return <div class="space" ref={place} data-stage />;
}
