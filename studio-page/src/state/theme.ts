/** Light or dark: as the system has it, until the author chooses. */

import { effect, signal } from "@preact/signals";

export type Theme = "light" | "dark";
const KEPT = "shapewright.theme";
const system = matchMedia("(prefers-color-scheme: dark)");

const chosen = signal<Theme | null>(read());
const systemDark = signal(system.matches);
system.addEventListener("change", () => (systemDark.value = system.matches));

export const theme = signal<Theme>("light");
effect(() => {
  theme.value = chosen.value ?? (systemDark.value ? "dark" : "light");
  document.documentElement.dataset.theme = theme.value;
});

export function switchTheme(): void {
  chosen.value = theme.value === "dark" ? "light" : "dark";
  localStorage.setItem(KEPT, chosen.value);
}

function read(): Theme | null {
  const kept = localStorage.getItem(KEPT);
  return kept === "light" || kept === "dark" ? kept : null;
}
