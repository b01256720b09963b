/** Two drawings: beside each other, over each other, or only where they differ. */

import type { DrawingMessage } from "../wire/messages";
import { failure, original, replica } from "./pair/session";
import { blend, layout, under } from "./pair/layout";

/** Drawings lie within half a unit of the origin, y up. */
const FRAME = "-0.54 -0.54 1.08 1.08";

const drawing = (shape: typeof original.value): DrawingMessage | null => (shape?.type === "drawing" ? shape : null);

export function Plane() {
  const reference = drawing(original.value);
  const made = drawing(replica.value);
  const stale = failure.value ? "stale" : "";
  if (layout.value === "beside") {
    return (
      <div class="plane beside">
        <Sheet>{reference && <path class="ink" d={reference.path} />}</Sheet>
        <Sheet>{made && <path class={`ink ${stale}`} d={made.path} />}</Sheet>
      </div>
    );
  }
  return (
    <div class="plane">
      <Sheet>
        {layout.value === "over" ? (
          <>
            {reference && <path class="reference" d={reference.path} style={{ opacity: under.value }} />}
            {made && <path class={`replica ${stale}`} d={made.path} style={{ opacity: blend.value }} />}
          </>
        ) : (
          <>
            {reference && <path class="agrees" d={reference.path} />}
            {made?.missing && <path class="missing" d={made.missing} />}
            {made?.excess && <path class="excess" d={made.excess} />}
          </>
        )}
      </Sheet>
    </div>
  );
}

function Sheet({ children }: { children: preact.ComponentChildren }) {
  return (
    <svg class="sheet" viewBox={FRAME}>
      <g transform="scale(1 -1)">{children}</g>
    </svg>
  );
}

export function DifferenceLegend() {
  return (
    <p class="legend">
      <span>
        <i class="swatch missing" />
        only in the reference
      </span>
      <span>
        <i class="swatch excess" />
        only in the replica
      </span>
    </p>
  );
}
