/** The export menu: what to take away, as what, and the download when it is ready. */

import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { cancel } from "../state/actions";
import { complain } from "../state/notices";
import { dimension, jobs } from "../state/studio";
import { Button, Select } from "../ui/controls";
import type { ExportFormat, ExportOrder, Frame, Part } from "../wire/messages";
import { requests } from "../wire/requests";

const WHAT = [
  { name: "replicas", label: "Replicas", note: "one file for each reference" },
  { name: "samples", label: "Random samples", note: "of the procedure, with a manifest" },
  { name: "report", label: "Report", note: "one page that needs nothing else" },
  { name: "parameters", label: "Parameters", note: "CSV" },
] as const;
const FORMATS = (["glb", "ply", "obj", "stl", "off"] as ExportFormat[]).map((value) => ({
  value,
  label: value.toUpperCase(),
}));

const FRAMES: { value: Frame; label: string }[] = [
  { value: "procedure", label: "as built" },
  { value: "reference", label: "over the references" },
];

export function ExportMenu() {
  const open = useSignal(false);
  const what = useSignal<Part[]>(["replicas", "parameters"]);
  const order = useSignal({ format: "glb" as ExportFormat, frame: "procedure" as Frame, count: 50, seed: 0 });
  const place = useRef<HTMLDivElement>(null);
  const job = jobs.export.value;
  const running = job.state === "running" || job.state === "cancelling";

  useEffect(() => {
    const away = (event: Event) => {
      const escape = event instanceof KeyboardEvent && event.key === "Escape";
      if (escape || (event.type === "pointerdown" && !place.current?.contains(event.target as Node)))
        open.value = false;
    };
    window.addEventListener("pointerdown", away);
    window.addEventListener("keydown", away);
    return () => {
      window.removeEventListener("pointerdown", away);
      window.removeEventListener("keydown", away);
    };
  }, []);

  const start = () => {
    const request: ExportOrder = { what: what.value, ...order.value };
    requests.export(request).catch(complain);
  };
  const choose = (name: Part, on: boolean) => {
    what.value = WHAT.map((one) => one.name).filter((one) => (one === name ? on : what.value.includes(one)));
  };

  return (
    <div class="menu" ref={place}>
      <Button icon="download" pressed={open.value} onClick={() => (open.value = !open.value)}>
        Export
      </Button>
      {open.value && (
        <div class="popover export" role="dialog" aria-label="Export">
          {WHAT.map(({ name, label, note }) => (
            <label key={name} class="choice">
              <input
                type="checkbox"
                checked={what.value.includes(name)}
                onChange={(event) => choose(name, event.currentTarget.checked)}
              />
              <span>
                {label} <small>{note}</small>
              </span>
            </label>
          ))}
          <div class="row">
            {dimension.value === 3 && (
              <>
                <Select
                  label="Format"
                  options={FORMATS}
                  value={order.value.format}
                  onChange={(format) => (order.value = { ...order.value, format })}
                />
                {what.value.includes("replicas") && (
                  <Select
                    label="Replicas"
                    title="Axes, units and place of the replicas"
                    options={FRAMES}
                    value={order.value.frame}
                    onChange={(frame) => (order.value = { ...order.value, frame })}
                  />
                )}
              </>
            )}
            {what.value.includes("samples") && (
              <>
                <Count
                  label="Samples"
                  value={order.value.count}
                  min={1}
                  set={(count) => (order.value = { ...order.value, count })}
                />
                <Count
                  label="Seed"
                  value={order.value.seed}
                  min={0}
                  set={(seed) => (order.value = { ...order.value, seed })}
                />
              </>
            )}
          </div>
          <div class="row end">
            {job.problem && <p class="bad grow">{job.problem.message}</p>}
            {job.state === "done" && job.result?.url && (
              <a class="grow link" href={job.result.url} download>
                Download ({((job.result.bytes ?? 0) / 1e6).toFixed(1)} MB)
              </a>
            )}
            {running ? (
              <>
                <p class="soft grow">
                  {job.stages.at(-1)?.name ?? "starting"} {job.stages.at(-1)?.done ?? 0}/{job.stages.at(-1)?.total ?? 0}
                </p>
                <Button onClick={() => cancel("export")}>Cancel</Button>
              </>
            ) : (
              <Button kind="primary" disabled={!what.value.length} onClick={start}>
                Export
              </Button>
            )}
          </div>
        </div>
      )}
    </div>
  );
}

function Count(props: { label: string; value: number; min: number; set: (value: number) => void }) {
  return (
    <label class="field">
      <span>{props.label}</span>
      <input
        type="number"
        min={props.min}
        value={props.value}
        onChange={(event) => props.set(Math.max(props.min, Math.round(event.currentTarget.valueAsNumber || 0)))}
      />
    </label>
  );
}
