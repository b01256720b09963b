/** The WebSocket: changes of the state come in, evaluations go out and come back. */

import { keyHeaders, protocols } from "./access";
import { decode } from "./binary";
import type { Evaluated } from "./binary";
import type { Change, Explore, ExploredMessage, ExploringMessage, PageMessage, Slug, Values } from "./messages";

const FIRST_WAIT = 400;
const LONGEST_WAIT = 5000;
const EVALUATED = new Set(["verdict", "drawing", "failed"]);
const EXPLORED = new Set(["exploring", "explored"]);
type Explored = ExploringMessage | ExploredMessage;

export interface Listener {
  changed(change: Change): void;
  /** null, or why there is no connection; and whether a studio is there that does not know this page. */
  connected(why: string | null, anew: boolean): void;
}

let socket: WebSocket | null = null;
let lastId = 0;
let evaluationListener: (message: Evaluated) => void = () => undefined;
let exploreListener: (message: Explored) => void = () => undefined;

/** Connect, and again whenever the connection is lost. */
export function connect(listener: Listener, wait = FIRST_WAIT): void {
  const url = new URL("/api/live", location.href);
  url.protocol = url.protocol === "https:" ? "wss:" : "ws:";
  socket = new WebSocket(url, protocols());
  socket.binaryType = "arraybuffer";
  let next = Math.min(2 * wait, LONGEST_WAIT);
  socket.addEventListener("open", () => {
    next = FIRST_WAIT;
    listener.connected(null, false);
  });
  socket.addEventListener("message", ({ data }: MessageEvent<string | ArrayBuffer>) => {
    if (data instanceof ArrayBuffer) return evaluationListener(decode(data));
    const message = JSON.parse(data) as Change | Evaluated | Explored;
    if (EXPLORED.has(message.type)) return exploreListener(message as Explored);
    if (EVALUATED.has(message.type)) evaluationListener(message as Evaluated);
    else listener.changed(message as Change);
  });
  socket.addEventListener("close", () => {
    void isAnew().then(
      (anew) => socket?.readyState !== WebSocket.OPEN && listener.connected(anew ? ANEW : SILENT, anew),
    );
    setTimeout(() => connect(listener, next), wait);
  });
}

const ANEW = "The studio was started anew, and does not know this page.";
const SILENT = "The studio does not answer. The page connects again by itself.";

/** Whether a studio is there, but another one than the one that opened this page. */
async function isAnew(): Promise<boolean> {
  const answer = await fetch("/api/state", { headers: keyHeaders() }).catch(() => null);
  return answer?.status === 401;
}

/** Ask for a replica; the answers come to the one listener. Returns the number that they carry. */
export function evaluate(slug: Slug | null, parameters: Values | null, beyond: string[], residuals: boolean): number {
  lastId += 1;
  send({ type: "evaluate", id: lastId, slug, parameters, beyond, residuals });
  return lastId;
}

/** Ask for shapes without references; returns the number that the answers carry. */
export function explore(order: Omit<Explore, "type" | "id">): number {
  lastId += 1;
  send({ type: "explore", id: lastId, ...order });
  return lastId;
}

/** Who hears of these shapes; returns how to stop listening. */
export function onExplored(listener: (message: Explored) => void): () => void {
  exploreListener = listener;
  return () => {
    if (exploreListener === listener) exploreListener = () => undefined;
  };
}

/** Say which pairs the author looks at. */
export function look(slugs: Slug[]): void {
  send({ type: "visible", slugs });
}

function send(message: PageMessage): void {
  if (socket?.readyState === WebSocket.OPEN) socket.send(JSON.stringify(message));
}

/** Who hears the answers of evaluations; returns how to stop listening. */
export function onEvaluated(listener: (message: Evaluated) => void): () => void {
  evaluationListener = listener;
  return () => {
    if (evaluationListener === listener) evaluationListener = () => undefined;
  };
}
