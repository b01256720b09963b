/** The key that the studio gave this page when its printed address was opened; other servers of this host lack it. */

const KEPT = "shapewright.key";
const arrived = /^#key=([\w-]+)$/.exec(location.hash)?.[1];

if (arrived) {
  localStorage.setItem(KEPT, arrived);
  history.replaceState(null, "", location.pathname);
}

const key = (): string => localStorage.getItem(KEPT) ?? "";

/** Headers of every request. */
export const keyHeaders = (): Record<string, string> => ({ "X-Shapewright-Key": key() });

/** What a WebSocket offers: browsers let it set no headers. */
export const protocols = (): string[] => ["shapewright", ...(key() ? [key()] : [])];
