/** Requests to the server; all of them raise a RequestError that can be shown to the author. */

import { keyHeaders } from "./access";
import { decode } from "./binary";
import type { MeshMessage } from "./binary";
import type {
  ChosenSettings,
  CollectionMap,
  Comparison,
  Copied,
  DrawingMessage,
  Explanation,
  JobKind,
  MarkOrder,
  NoteOrder,
  ExportOrder,
  ParameterTable,
  Reference,
  RunDetail,
  Replaced,
  Revision,
  RevisionDetail,
  Slug,
  Source,
  Step,
  TellOrder,
  Told,
  ToldAnswer,
  ToldChange,
  Turn,
} from "./messages";

export class RequestError extends Error {
  constructor(
    message: string,
    readonly status: number,
    readonly body: Record<string, unknown>,
  ) {
    super(message);
  }
}

async function answer(path: string, init?: RequestInit): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(path, { ...init, headers: { ...init?.headers, ...keyHeaders() } });
  } catch {
    throw new RequestError("The server does not answer. Is `shapewright studio` still running?", 0, {});
  }
  if (response.ok) return response;
  const body = (await response.json().catch(() => ({}))) as Record<string, unknown>;
  throw new RequestError(
    typeof body.error === "string" ? body.error : `${response.status} ${path}`,
    response.status,
    body,
  );
}

async function get<T>(path: string): Promise<T> {
  return (await (await answer(path)).json()) as T;
}

async function send<T>(method: "POST" | "PUT" | "PATCH", path: string, body: unknown): Promise<T> {
  const headers = { "Content-Type": "application/json" };
  return (await (await answer(path, { method, headers, body: JSON.stringify(body) })).json()) as T;
}

const id = encodeURIComponent;

export const requests = {
  reference: (slug: Slug) => get<Reference>(`/api/references/${id(slug)}`),
  mesh: async (slug: Slug) =>
    decode(await (await answer(`/api/references/${id(slug)}/shape`)).arrayBuffer()) as MeshMessage,
  drawing: (slug: Slug) => get<DrawingMessage>(`/api/references/${id(slug)}/shape`),
  tell: (order: TellOrder) => send("PATCH", "/api/references", order),
  note: (order: NoteOrder) => send<ToldAnswer>("PATCH", "/api/notes", order),
  turn: (slugs: Slug[], turn: Turn) => send<ToldAnswer>("POST", "/api/references/turn", { slugs, turn }),
  unit: (slugs: Slug[], unit: Told["unit"]) => send<ToldAnswer>("POST", "/api/references/unit", { slugs, unit }),
  told: () => get<ToldChange[]>("/api/told"),
  undoTold: (number: number) => send<ToldAnswer>("POST", `/api/told/${number}/undo`, {}),
  parameters: () => get<ParameterTable>("/api/parameters"),
  map: () => get<CollectionMap>("/api/map"),
  steps: (slug: Slug) => get<Step[]>(`/api/references/${id(slug)}/steps`),
  alike: (slug: Slug) => get<Record<Slug, number>>(`/api/references/${id(slug)}/alike`),
  source: () => get<Source>("/api/source"),
  saveSource: (text: string, digest: string | null) => send<Replaced>("PUT", "/api/source", { text, digest }),
  saveCopy: (text: string) => send<Copied>("POST", "/api/source/copy", { text }),
  revisions: () => get<Revision[]>("/api/revisions"),
  revision: (number: number) => get<RevisionDetail>(`/api/revisions/${number}`),
  undo: (number: number, digest: string | null) => send<Replaced>("POST", `/api/revisions/${number}/undo`, { digest }),
  fit: (fresh: boolean) => send("POST", "/api/fit", { fresh }),
  explain: () => send("POST", "/api/explain", {}),
  export: (order: ExportOrder) => send("POST", "/api/export", order),
  cancel: (kind: JobKind) => send("POST", "/api/cancel", { kind }),
  settings: (change: Partial<ChosenSettings>) => send<ChosenSettings>("PATCH", "/api/settings", change),
  mark: (order: MarkOrder) => send("PATCH", "/api/marks", order),
  run: (run: string) => get<RunDetail>(`/api/runs/${id(run)}`),
  compare: (before: string, after: string) => get<Comparison>(`/api/compare?before=${id(before)}&after=${id(after)}`),
  restore: (run: string, digest: string | null) => send<Replaced>("POST", `/api/runs/${id(run)}/restore`, { digest }),
  explanation: () => get<Explanation>("/api/explanation"),
  applyToCopy: (index: number) => send<Copied>("POST", `/api/suggestions/${index}/apply`, { to: "copy" }),
  applyToProcedure: (index: number, digest: string | null) =>
    send<Replaced>("POST", `/api/suggestions/${index}/apply`, { to: "procedure", digest }),
};

/** A picture drawn by the server, for browsers without WebGL. */
export function renderUrl(slug: Slug, shape: "reference" | "replica", azimuth: number, elevation: number, size = 512) {
  const query = new URLSearchParams({ shape, azimuth: `${azimuth}`, elevation: `${elevation}`, size: `${size}` });
  return `/api/references/${id(slug)}/render?${query.toString()}`;
}
