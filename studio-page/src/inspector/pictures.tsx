/** Pictures drawn by the server, turned in steps: for browsers without WebGL. */

import { useSignal } from "@preact/signals";
import { tileOf } from "../state/studio";
import { Button } from "../ui/controls";
import { renderUrl } from "../wire/requests";
import { replica, slug } from "./pair/session";

const STEP = 30;

export function Pictures() {
  const azimuth = useSignal(35);
  // Reading the replica draws this anew when it changes.
  void replica.value;
  const open = slug.value;
  if (!open) return null;
  return (
    <div class="pictures">
      {(["reference", "replica"] as const).map((shape) =>
        shape === "replica" && !tileOf(open)?.replica ? (
          <span key={shape} />
        ) : (
          <img key={shape} src={renderUrl(open, shape, azimuth.value, 25)} alt={shape} />
        ),
      )}
      <div class="row">
        <Button icon="left" title="Turn left" onClick={() => (azimuth.value = (azimuth.value + 360 - STEP) % 360)} />
        <Button icon="right" title="Turn right" onClick={() => (azimuth.value = (azimuth.value + STEP) % 360)} />
        <span class="soft">This browser has no WebGL: pictures of what was found are shown instead.</span>
      </div>
    </div>
  );
}
