/** Thumbnails: grey pictures, tinted in the page by the colour of a grade; and the marks of grades. */

import { useRef, useLayoutEffect } from "preact/hooks";
import type { Grade } from "../wire/messages";
import { SIGN_PATHS } from "./signs";

/** `tint` null leaves it grey. `dim` is for what is no longer true. */
export function Picture(props: { url: string | null; tint: string | null; alt: string; dim?: boolean }) {
  const element = useRef<HTMLSpanElement>(null);
  useLayoutEffect(() => {
    const style = element.current?.style;
    if (!style) return;
    // Addresses of pictures are made of a digest by the server; quotes keep anything else harmless.
    const picture = props.url ? `url(${JSON.stringify(props.url)})` : "none";
    style.setProperty("--picture", picture);
    style.setProperty("--tint", props.tint ?? "transparent");
  }, [props.url, props.tint]);
  if (!props.url) return <span class="picture missing" role="img" aria-label={`${props.alt}: none`} />;
  return (
    <span
      ref={element}
      class={`picture ${props.tint ? "tinted" : ""} ${props.dim ? "dim" : ""}`}
      role={props.alt ? "img" : undefined}
      aria-label={props.alt || undefined}
    />
  );
}

/** A check for replicated, a tilde for close, a cross for different; a ring where nothing is measured. */
export function GradeMark({ grade }: { grade: Grade | null }) {
  return (
    <svg class={`grade ${grade ?? "none"}`} viewBox="0 0 10 10" role="img" aria-label={grade ?? "not measured"}>
      {grade ? <path d={SIGN_PATHS[grade]} /> : <circle cx={5} cy={5} r={4} />}
    </svg>
  );
}
