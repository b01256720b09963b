/** Pictures drawn by the server, turned in steps: for browsers without WebGL. They follow the parameters. */

import { useSignal, useSignalEffect } from "@preact/signals";
import { tileOf } from "../state/studio";
import { Button } from "../ui/controls";
import { referenceUrl, replicaUrl } from "../wire/requests";
import { edited } from "./pair/edits";
import { beyond, replica, slug } from "./pair/session";

const STEP = 30;
const ELEVATION = 25;

export function Pictures() {
  const azimuth = useSignal(35);
  const drawn = useSignal<{ open: string; url: string; of: string } | null>(null);
  useSignalEffect(() => {
    // A picture is asked for when the replica of these parameters was built, so at most one is under way.
    const open = slug.value;
    if (!open || !replica.value) return;
    const of = { parameters: edited.value, beyond: beyond() };
    const url = replicaUrl(open, { azimuth: azimuth.value, elevation: ELEVATION }, of);
    let wanted = true;
    const image = new Image();
    image.onload = () => wanted && (drawn.value = { open, url, of: JSON.stringify(of.parameters) });
    image.src = url;
    return () => (wanted = false);
  });
  const open = slug.value;
  if (!open) return null;
  const shown = drawn.value?.open === open ? drawn.value : null;
  return (
    <div class="pictures">
      <img src={referenceUrl(open, { azimuth: azimuth.value, elevation: ELEVATION })} alt="reference" />
      {shown && tileOf(open) ? <img src={shown.url} alt="replica" data-of={shown.of} /> : <span />}
      <div class="row">
        <Button icon="left" title="Turn left" onClick={() => (azimuth.value = (azimuth.value + 360 - STEP) % 360)} />
        <Button icon="right" title="Turn right" onClick={() => (azimuth.value = (azimuth.value + STEP) % 360)} />
        <span class="soft">This browser has no WebGL: the studio draws pictures instead.</span>
      </div>
    </div>
  );
}
