/** Thumbnails: grey pictures, tinted in the page by the colour of a distance. */

import { useRef, useLayoutEffect } from "preact/hooks";

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
      role="img"
      aria-label={props.alt}
    />
  );
}

/** A dot of the distance's colour. */
export function Dot({ colour }: { colour: string | null }) {
  return <i class="dot" style={{ backgroundColor: colour ?? "var(--faint)" }} />;
}
