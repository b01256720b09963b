/** What a screen reader says when it has stayed the same for a moment: a slider that is dragged does not talk on and on. */

import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";

const REST = 1200; // ms, longer than between two changes of one drag

export function Spoken({ text }: { text: string }) {
  const said = useSignal("");
  useEffect(() => {
    const timer = setTimeout(() => (said.value = text), REST);
    return () => clearTimeout(timer);
  }, [text]);
  return (
    <p class="unseen" role="status">
      {said.value}
    </p>
  );
}
