/** A sign for each grade, so that no colour has to tell it alone. */

import type { Grade } from "../wire/messages";

export const SIGNS: Record<Grade, string> = { replicated: "✓", close: "~", different: "✗" };
/** The same, drawn on ten by ten. */
export const SIGN_PATHS: Record<Grade, string> = {
  replicated: "M1.2 5.600 3.900 8.300 8.800 2.100",
  close: "M.9 6.200C2.300 3.100 3.700 3.300 5 5s2.700 1.900 4.100-1.200",
  different: "M1.5 1.500l7 7M8.5 1.500l-7 7",
};
