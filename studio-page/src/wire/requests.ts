/** Requests to the server; all of them raise a RequestError that can be shown to the author. */

import { keyHeaders } from "./access";
import { decode } from "./binary";
import type { MeshMessage } from "./binary";
import type {
  Arrived,
  ChosenSettings,
  CollectionMap,
  Comparison,
  Copied,
  DrawingMessage,
  Explanation,
  JobKind,
  MarkOrder,
  Merging,
  NextStep,
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
  Values,
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
/** Which text file is meant: empty for the procedure. */
const of = (file: string) => (file ? `?file=${id(file)}` : "");

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
  texts: () => get<string[]>("/api/texts"),
  source: (file: string) => get<Source>(`/api/source${of(file)}`),
  saveSource: (file: string, text: string, digest: string | null) =>
    send<Replaced>("PUT", `/api/source${of(file)}`, { text, digest }),
  saveCopy: (text: string) => send<Copied>("POST", "/api/source/copy", { text }),
  revisions: (file = "") => get<Revision[]>(`/api/revisions${of(file)}`),
  revision: (number: number, file = "") => get<RevisionDetail>(`/api/revisions/${number}${of(file)}`),
  undo: (number: number, digest: string | null, file = "") =>
    send<Replaced>("POST", `/api/revisions/${number}/undo${of(file)}`, { digest }),
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
  next: () => get<NextStep>("/api/next"),
  merging: (index: number) => get<Merging>(`/api/suggestions/${index}/merge`),
  /** hunks: the parts that are accepted, of the text with this digest. */
  applyToCopy: (index: number, digest: string, hunks: number[]) =>
    send<Copied>("POST", `/api/suggestions/${index}/apply`, { to: "copy", digest, hunks }),
  applyToProcedure: (index: number, digest: string, hunks: number[]) =>
    send<Replaced>("POST", `/api/suggestions/${index}/apply`, { to: "procedure", digest, hunks }),
  /** Put a file among the references. beside: under a free name, where another file has its name. */
  arrive: async (file: File, beside: boolean) => {
    const query = new URLSearchParams({ name: file.name, beside: `${beside}` });
    return (await (await answer(`/api/arrivals?${query}`, { method: "POST", body: file })).json()) as Arrived;
  },
};

/** From where a picture is drawn, in degrees. */
export interface Camera {
  azimuth: number;
  elevation: number;
}

/** Of a replica that is drawn: its parameters, null for those that were found, and those of them beyond their Range. */
export interface Drawn {
  parameters: Values | null;
  beyond: string[];
}

/** A picture of a reference drawn by the server, for browsers without WebGL. */
export const referenceUrl = (slug: Slug, camera: Camera): string =>
  `/api/references/${id(slug)}/render?${query(camera, { shape: "reference" })}`;

/** A picture of a replica, or with no slug of a shape of the procedure. */
export const replicaUrl = (slug: Slug | null, camera: Camera, of: Drawn): string =>
  `/api/${slug === null ? "procedure" : `references/${id(slug)}`}/render?${query(camera, { shape: "replica", of: JSON.stringify(of) })}`;

const query = ({ azimuth, elevation }: Camera, more: Record<string, string>): string =>
  new URLSearchParams({ azimuth: `${azimuth}`, elevation: `${elevation}`, size: "512", ...more }).toString();
