/** The few controls that every view is made of. */

import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { Icon } from "./icons";
import type { IconName } from "./icons";

export function Button(props: {
  children?: ComponentChildren;
  icon?: IconName;
  title?: string;
  kind?: "plain" | "primary" | "quiet";
  pressed?: boolean;
  disabled?: boolean;
  class?: string;
  onClick: (event: MouseEvent) => void;
}) {
  const { children, icon, title, kind = "plain", pressed, disabled, onClick } = props;
  return (
    <button
      type="button"
      class={`button ${kind} ${children ? "" : "bare"} ${props.class ?? ""}`}
      title={title}
      aria-label={children ? undefined : title}
      aria-pressed={pressed}
      disabled={disabled}
      onClick={onClick}
    >
      {icon && <Icon name={icon} />}
      {children && <span>{children}</span>}
    </button>
  );
}

export interface Option<T> {
  value: T;
  label: ComponentChildren;
  title?: string;
  disabled?: boolean;
}

/** One of a few, all of them in sight. */
export function Segments<T extends string>(props: {
  label: string;
  options: readonly Option<T>[];
  value: T;
  onChange: (value: T) => void;
}) {
  const step = (event: KeyboardEvent) => {
    const by = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    const open = props.options.filter(({ disabled }) => !disabled);
    const next = by && open.at((open.findIndex(({ value }) => value === props.value) + by) % open.length);
    if (!next) return;
    event.preventDefault();
    props.onChange(next.value);
    const buttons = (event.currentTarget as HTMLElement).querySelectorAll("button");
    buttons[props.options.indexOf(next)]?.focus();
  };
  return (
    <div class="segments" role="radiogroup" aria-label={props.label} onKeyDown={step}>
      {props.options.map(({ value, label, title, disabled }) => (
        <button
          type="button"
          role="radio"
          key={value}
          title={title}
          disabled={disabled}
          aria-checked={value === props.value}
          tabIndex={value === props.value ? 0 : -1}
          onClick={() => props.onChange(value)}
        >
          {label}
        </button>
      ))}
    </div>
  );
}

/** One of several, in a list that opens. */
export function Select<T extends string>(props: {
  label: string;
  options: readonly { value: T; label: string }[];
  value: T;
  title?: string;
  hidden?: boolean;
  onChange: (value: T) => void;
}) {
  return (
    <label class="field" title={props.title}>
      {!props.hidden && <span>{props.label}</span>}
      <select
        aria-label={props.label}
        value={props.value}
        onChange={(event) => props.onChange(event.currentTarget.value as T)}
      >
        {props.options.map(({ value, label }) => (
          <option key={value} value={value}>
            {label}
          </option>
        ))}
      </select>
    </label>
  );
}

/** name: what it is called where its label says how it stands. */
export function Toggle(props: {
  label: string;
  name?: string;
  on: boolean;
  title?: string;
  onChange: (on: boolean) => void;
}) {
  return (
    <label class="toggle" title={props.title}>
      <input
        type="checkbox"
        role="switch"
        aria-label={props.name}
        checked={props.on}
        onChange={(event) => props.onChange(event.currentTarget.checked)}
      />
      <span>{props.label}</span>
    </label>
  );
}

/** A window over the page: Escape, its cross, or a click beside it closes it. */
export function Dialog(props: { title: string; class?: string; onClose: () => void; children: ComponentChildren }) {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => {
    dialog.current?.showModal();
  }, []);
  return (
    <dialog
      ref={dialog}
      class={`dialog ${props.class ?? ""}`}
      aria-label={props.title}
      onClose={props.onClose}
      onClick={(event) => event.target === dialog.current && dialog.current?.close()}
    >
      <header>
        <h2>{props.title}</h2>
        <Button icon="close" kind="quiet" title="Close (Esc)" onClick={() => dialog.current?.close()} />
      </header>
      <div class="body">{props.children}</div>
    </dialog>
  );
}

/** What a view shows when it has nothing to show. */
export function Empty(props: { title: string; children?: ComponentChildren }) {
  return (
    <div class="empty">
      <h2>{props.title}</h2>
      {props.children}
    </div>
  );
}
