/** A run as it was, to look at: its replicas, parameters, procedure and settings. Nothing here can be changed. */

import { useSignal, useSignalEffect } from "@preact/signals";
import { tintOf } from "../state/scale";
import { valueOf } from "../state/grades";
import { useKeys } from "../state/keys";
import { complain } from "../state/notices";
import { go, route } from "../state/route";
import { collection as shownNow, runs } from "../state/studio";
import { Button, Empty } from "../ui/controls";
import { fixed, shown, words } from "../ui/numbers";
import { GradeMark, Picture } from "../ui/picture";
import type { RunDetail, Tile } from "../wire/messages";
import { requests } from "../wire/requests";
import { said } from "./chart";
import { Steps } from "./steps";

/** rest: the run, and after a stroke the reference that is open. */
export function OldRun({ rest }: { rest: string }) {
  const [run = "", slug] = rest.split("/").map(decoded);
  const detail = useSignal<RunDetail | null>(null);
  const asked = useSignal(run);
  asked.value = run;
  useSignalEffect(() => {
    const now = asked.value;
    void runs.value.length;
    requests.run(now).then(
      (found) => asked.peek() === now && (detail.value = found),
      (error) => {
        complain(error);
        go("history");
      },
    );
  });
  const close = () => (slug ? (location.hash = `history/${encodeURIComponent(run)}`) : go("history"));
  const found = detail.value?.run.run === run ? detail.value : null;
  if (!found) return <Empty title={`Reading run ${run}…`} />;
  const tile = slug ? found.collection.tiles.find((one) => one.slug === slug) : undefined;
  return (
    <div class="old-run">
      <OldRunKeys close={close} />
      <header class="row">
        <Button icon="left" title="Back (Esc)" onClick={close}>
          {slug ? `Run ${run}` : "History"}
        </Button>
        <h2>
          Run {run} <span class="badge">read-only</span>
        </h2>
        <p class="soft grow">{said(found.run)}</p>
        {shownNow.value.run === run && <span class="badge good">shown in the collection</span>}
      </header>
      {tile ? (
        <Pair tile={tile} detail={found} />
      ) : slug ? (
        <p>This run does not know {slug}.</p>
      ) : (
        <Whole detail={found} />
      )}
    </div>
  );
}

function OldRunKeys({ close }: { close: () => void }) {
  const step = (by: number) => {
    const all = runs.value.map(({ run }) => run);
    const [run = "", slug] = (route.value.rest ?? "").split("/");
    const next = all[all.indexOf(decoded(run)) + by];
    if (next) location.hash = `history/${encodeURIComponent(next)}${slug ? `/${slug}` : ""}`;
  };
  useKeys("Old run", [
    { keys: ["Escape"], does: "back", run: close },
    { keys: ["ArrowLeft", "p"], does: "the run before", run: () => step(-1) },
    { keys: ["ArrowRight", "n"], does: "the next run", run: () => step(1) },
  ]);
  return null;
}

function Whole({ detail }: { detail: RunDetail }) {
  const { collection, run, source, settings } = detail;
  const tiles = collection.tiles.filter(({ replica, problem }) => replica || problem);
  return (
    <>
      <details>
        <summary>Its procedure</summary>
        <pre class="source">{source || "This run kept no procedure."}</pre>
      </details>
      <details>
        <summary>Its settings</summary>
        <dl class="values">
          {Object.entries(settings).map(([name, value]) => (
            <div key={name}>
              <dt>{words(name)}</dt>
              <dd>{typeof value === "object" ? JSON.stringify(value) : String(value)}</dd>
            </div>
          ))}
        </dl>
      </details>
      {run.references > tiles.length && (
        <p class="soft">{run.references - tiles.length} of its references are not here any more.</p>
      )}
      <div class="tiles">
        {tiles.map((tile) => (
          <article key={tile.slug} class="tile">
            <a
              class="pair"
              href={`#history/${encodeURIComponent(run.run)}/${encodeURIComponent(tile.slug)}`}
              aria-label={`${tile.name}: ${tile.grade}`}
            >
              <Picture url={tile.reference} tint={null} alt="reference" />
              <Picture url={tile.replica} tint={tintOf(tile)} alt="replica" />
            </a>
            <footer>
              <span class="name">{tile.name}</span>
              <Value tile={tile} detail={detail} />
            </footer>
          </article>
        ))}
      </div>
    </>
  );
}

function Value({ tile, detail }: { tile: Tile; detail: RunDetail }) {
  const value = valueOf(detail.collection.judge, tile);
  return (
    <span class="value">
      <GradeMark grade={value === null ? null : tile.grade} />
      {fixed(value, 2)}
    </span>
  );
}

function Pair({ tile, detail }: { tile: Tile; detail: RunDetail }) {
  const values = detail.values[tile.slug];
  return (
    <>
      <h3>{tile.name}</h3>
      <div class="old-pair">
        <figure>
          <Picture url={tile.reference} tint={null} alt="reference" />
          <figcaption class="soft">Reference</figcaption>
        </figure>
        <figure>
          <Picture url={tile.replica} tint={tintOf(tile)} alt="replica" />
          <figcaption>
            <Value tile={tile} detail={detail} /> {tile.grade}
            {tile.problem && <span class="bad"> {tile.problem.message}</span>}
          </figcaption>
        </figure>
        <div>
          <h3>Parameters then</h3>
          <dl class="values">
            {Object.entries(values ?? {}).map(([name, value]) => (
              <div key={name}>
                <dt>{words(name)}</dt>
                <dd>{shown(value)}</dd>
              </div>
            ))}
          </dl>
          <a href={`#inspect/${encodeURIComponent(tile.slug)}`}>Open it as it is now</a>
        </div>
      </div>
      <Steps slug={tile.slug} at={detail.run.run} />
    </>
  );
}

function decoded(part: string): string {
  try {
    return decodeURIComponent(part);
  } catch {
    return part;
  }
}
