/** How the stage is drawn, and pictures of it to take away. */

import { useSignal } from "@preact/signals";
import { Popover } from "../../ui/popover";
import { Button, Segments, Toggle } from "../../ui/controls";
import { fixed } from "../../ui/numbers";
import { furnished, parallel, section, stage, wireframe } from "../pair/layout";
import { slug } from "../pair/session";
import { savePicture, saveTurntable, turning } from "../../files/turntable";

export function StageTools() {
  const open = useSignal(false);
  return (
    <>
      <Button icon="fit" title="Fit both shapes to the pane (.)" kind="quiet" onClick={() => stage.value?.fit()} />
      <Popover
        icon="look"
        label="Stage"
        title="Wireframe, grid, section, and pictures to take away"
        open={open.value}
        toggle={(on) => (open.value = on)}
        class="stage-tools"
      >
        <Toggle
          label="Wireframe"
          title="The edges of all triangles (w)"
          on={wireframe.value}
          onChange={(on) => (wireframe.value = on)}
        />
        <Toggle
          label="Grid and axes"
          title="A grid under the shapes, a tenth of the largest extent wide, and the axes (g)"
          on={furnished.value}
          onChange={(on) => (furnished.value = on)}
        />
        <Toggle
          label="Orthographic"
          title="Without perspective: what is equally long looks equally long (o)"
          on={parallel.value}
          onChange={(on) => (parallel.value = on)}
        />
        <SectionTools />
        <div class="row end">
          <Button icon="download" onClick={() => savePicture(stage.value, slug.value)}>
            Picture
          </Button>
          <Button
            icon="turned"
            disabled={turning.value !== null}
            title="An animated GIF of one turn"
            onClick={() => void saveTurntable(stage.value, slug.value)}
          >
            {turning.value === null ? "Turntable" : `${Math.round(100 * turning.value)} %`}
          </Button>
        </div>
      </Popover>
    </>
  );
}

function SectionTools() {
  const now = section.value;
  return (
    <div class="section-tools">
      <Segments
        label="Section"
        value={now?.axis ?? "off"}
        onChange={(axis) => (section.value = axis === "off" ? null : { axis, at: 0, flipped: false })}
        options={[
          { value: "off", label: "Whole", title: "Cut nothing away" },
          { value: "x", label: "x", title: "Cut across x" },
          { value: "y", label: "y", title: "Cut across y" },
          { value: "z", label: "z", title: "Cut across z" },
        ]}
      />
      {now && (
        <div class="row">
          <input
            type="range"
            aria-label={`Section along ${now.axis}`}
            min={-0.5}
            max={0.5}
            step={0.005}
            value={now.at}
            onInput={(event) => (section.value = { ...now, at: event.currentTarget.valueAsNumber })}
          />
          <output>{fixed(now.at, 2)}</output>
          <Toggle label="other side" on={now.flipped} onChange={(flipped) => (section.value = { ...now, flipped })} />
        </div>
      )}
    </div>
  );
}
