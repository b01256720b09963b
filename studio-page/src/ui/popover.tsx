/** A button with a small window under it, which goes away by Escape or a click beside it. */

import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { Button } from "./controls";
import type { IconName } from "./icons";

export function Popover(props: {
  label: string;
  icon: IconName;
  title: string;
  class?: string;
  open: boolean;
  toggle: (open: boolean) => void;
  children: ComponentChildren;
}) {
  const place = useRef<HTMLDivElement>(null);
  const { open, toggle } = props;
  useEffect(() => {
    if (!open) return undefined;
    const away = (event: PointerEvent) => {
      if (!place.current?.contains(event.target as Node)) toggle(false);
    };
    window.addEventListener("pointerdown", away);
    return () => window.removeEventListener("pointerdown", away);
  }, [open]);
  return (
    <div
      class="menu"
      ref={place}
      onKeyDown={(event) => {
        if (!open || event.key !== "Escape") return;
        // Escape means this window alone, not what lies under it.
        event.preventDefault();
        toggle(false);
        place.current?.querySelector("button")?.focus();
      }}
    >
      <Button icon={props.icon} title={props.title} pressed={open} onClick={() => toggle(!open)}>
        {props.label}
      </Button>
      {open && (
        <div class={`popover ${props.class ?? ""}`} role="dialog" aria-label={props.label}>
          {props.children}
        </div>
      )}
    </div>
  );
}
