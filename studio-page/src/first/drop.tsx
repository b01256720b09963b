/** Files that are dropped on the page: they go among the project's references, and over no other file. */

import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { complain, tell } from "../state/notices";
import { project } from "../state/studio";
import { Button } from "../ui/controls";
import { Icon } from "../ui/icons";
import { plural } from "../ui/numbers";
import { RequestError, requests } from "../wire/requests";

export interface Refusal {
  file: File;
  why: string;
  /** Whether another file has its name, so that it could be put beside that one. */
  taken: boolean;
}

/** How many of the files that were given last have arrived; null while none are under way. */
export const arriving = signal<{ done: number; total: number } | null>(null);
export const refusals = signal<Refusal[]>([]);

/** Send files one after the other. */
export async function take(files: readonly File[], beside = false): Promise<void> {
  if (arriving.value || !files.length) return;
  refusals.value = refusals.value.filter(({ file }) => !files.includes(file));
  let [arrived, there] = [0, 0];
  for (const [done, file] of files.entries()) {
    arriving.value = { done, total: files.length };
    try {
      const answer = await requests.arrive(file, beside);
      if (answer.there) there += 1;
      else arrived += 1;
    } catch (error) {
      const why = error instanceof Error ? error.message : String(error);
      const taken = error instanceof RequestError && error.body.taken === true;
      refusals.value = [...refusals.value, { file, why, taken }];
      if (error instanceof RequestError && error.status === 0) {
        complain(error);
        break;
      }
    }
  }
  arriving.value = null;
  if (arrived || there) tell(said(arrived, there));
}

function said(arrived: number, there: number): string {
  const parts = [
    ...(arrived ? [`${plural(arrived, "file")} taken over`] : []),
    ...(there ? [`${there} there already`] : []),
  ];
  return `${parts.join(", ")}.`;
}

/** Where files can be dropped or chosen. */
export function DropZone() {
  const field = useRef<HTMLInputElement>(null);
  if (!project.value.takes_files) {
    return (
      <p>
        The references are in <code>{project.value.references}</code>. Put files there: they appear here by themselves.
      </p>
    );
  }
  const under = arriving.value;
  return (
    <div class="drop" data-drop>
      <Icon name="upload" />
      {under ? (
        <p role="status">
          {under.done} of {plural(under.total, "file")}…
        </p>
      ) : (
        <p>
          Drop files here, or{" "}
          <button type="button" class="link" onClick={() => field.current?.click()}>
            choose some
          </button>
        </p>
      )}
      <p class="soft">
        Meshes (OBJ, PLY, STL, OFF, GLB, glTF, 3MF, DAE, FBX, USD, STEP, IGES), points, or drawings (SVG, DXF,
        pictures). They are copied into <code>references</code>.
      </p>
      <input
        ref={field}
        type="file"
        multiple
        hidden
        aria-label="Files of references"
        onChange={(event) => {
          void take([...(event.currentTarget.files ?? [])]);
          event.currentTarget.value = "";
        }}
      />
      <Refused />
    </div>
  );
}

function Refused() {
  if (!refusals.value.length) return null;
  const taken = refusals.value.filter((one) => one.taken).map(({ file }) => file);
  return (
    <div class="refused" role="alert">
      <ul>
        {refusals.value.map(({ file, why }) => (
          <li key={file.name}>
            <b>{file.name.slice(0, 60)}</b> was not taken over: {why}.
          </li>
        ))}
      </ul>
      <div class="row">
        {taken.length > 0 && (
          <Button title="Under free names, beside those that are there" onClick={() => void take(taken, true)}>
            Keep both
          </Button>
        )}
        <Button kind="quiet" onClick={() => (refusals.value = [])}>
          Put away
        </Button>
      </div>
    </div>
  );
}

/** Shown while files are dragged over the page, in whatever view; dropping them takes them over. */
const dragged = signal(false);

export function DropCover() {
  useEffect(() => {
    let depth = 0;
    const holds = (event: DragEvent) =>
      project.peek().takes_files && [...(event.dataTransfer?.types ?? [])].includes("Files");
    const enter = (event: DragEvent) => {
      if (!holds(event)) return;
      event.preventDefault();
      depth += 1;
      dragged.value = true;
    };
    const leave = () => {
      depth = Math.max(0, depth - 1);
      dragged.value = depth > 0;
    };
    const over = (event: DragEvent) => holds(event) && event.preventDefault();
    const drop = (event: DragEvent) => {
      [depth, dragged.value] = [0, false];
      if (!holds(event)) return;
      event.preventDefault();
      void take([...(event.dataTransfer?.files ?? [])]);
    };
    const ends = Object.entries({ dragenter: enter, dragleave: leave, dragover: over, drop }).map(([name, does]) => {
      window.addEventListener(name, does as EventListener);
      return () => window.removeEventListener(name, does as EventListener);
    });
    return () => ends.forEach((end) => end());
  }, []);
  return (
    <>
      {dragged.value && (
        <div class="drop-cover">
          <p>
            <Icon name="upload" /> Drop the files: they become references
          </p>
        </div>
      )}
      {/* Elsewhere than on the first page, refusals would not be seen. */}
      {refusals.value.length > 0 && !document.querySelector("[data-drop]") && (
        <div class="refused floating">
          <Refused />
        </div>
      )}
    </>
  );
}
