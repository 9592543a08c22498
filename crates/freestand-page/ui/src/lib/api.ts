/** What the page asks the program. The token is in the address behind the #, which no server sees. */

import type { Edit } from './inventory';
import type { Quantity, Units } from './units';
import { t } from './words';

export interface Failure { kind: string; key: string | null; file: string | null; line: number | null; message: string; hint: string; others?: Failure[] }

export class Refused extends Error {
  constructor(readonly status: number, readonly failure: Failure) {
    super(failure.message);
  }
}

export type Option = string | number | boolean | string[];

export interface Ask {
  command: string;
  options: Record<string, Option>;
  files?: Record<string, string[]>;
  history?: boolean | { motion: string };
  shape?: 'columns' | 'events';
  slot?: string;
  continues?: string;
  edits?: Edit[];
}

/** What asks the same in a shell, and in Python where there is such a function. */
export interface Typed { line: string; python: string | null }

/** A text in a field, and the units that its form showed. */
export interface Entered { text: string; quantity: Quantity; units: Units }

/** The text as it is asked, and its value in SI if it has one. */
export interface Reading { asked: string; si: number | null }

export interface Uploaded { id: string; name: string; bytes: number; sha256: string; kind: string }

const KEPT = 'freestand-token';

/** Takes the token out of the address. */
export function takeToken(): string | null {
  const fragment = location.hash.slice(1);
  if (/^[0-9a-f]{64}$/.test(fragment)) {
    sessionStorage.setItem(KEPT, fragment);
    history.replaceState(null, '', '#/fall');
  }
  return sessionStorage.getItem(KEPT);
}

/** The secret of this run of the program. */
export const token = () => sessionStorage.getItem(KEPT) ?? '';

/** In place of a status, where there was no answer. */
const LOST = 0;

const lost = () => new Refused(LOST, { kind: 'io', key: null, file: null, line: null, message: t('lost'), hint: t('lost.hint') });

async function answered(path: string, init: RequestInit = {}): Promise<Response> {
  const headers = new Headers(init.headers);
  headers.set('Authorization', `Bearer ${token()}`);
  const response = await fetch(`/api/v1/${path}`, { ...init, headers }).catch(() => { throw lost(); });
  if (response.ok) return response;
  const told = (await response.json().catch(() => null)) as { error?: Failure } | null;
  const nothing = { kind: 'defect', key: null, file: null, line: null, message: `status ${response.status}`, hint: '' };
  throw new Refused(response.status, told?.error ?? nothing);
}

const json = (body: unknown): RequestInit => ({
  method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(body),
});

export async function facts<T>(): Promise<T> {
  return (await answered('facts')).json() as Promise<T>;
}

/** This tab, for as long as it shows the page: what another tab asks stops nothing here. A copy of a tab has a name of its own. */
const TAB = Array.from(crypto.getRandomValues(new Uint32Array(4)), (one) => one.toString(16)).join('');
/** The number of the newest request of each slot. */
const newest = new Map<string, number>();
/** How often a request is sent again that was stopped by none of this tab. */
const MOST_TRIES = 5;
const SUPERSEDED = 409;

export async function run<T>(ask: Ask, signal?: AbortSignal): Promise<T> {
  const slot = ask.slot ?? '';
  const mine = (newest.get(slot) ?? 0) + 1;
  newest.set(slot, mine);
  const body = ask.slot ? { ...ask, tab: TAB } : ask;
  for (let tries = 1; ; tries += 1) {
    try {
      return await ((await answered('run', { ...json(body), ...(signal ? { signal } : {}) })).json() as Promise<T>);
    } catch (error) {
      // A newer request of this tab counts; without one, the question still stands and is asked again.
      const isOwn = newest.get(slot) !== mine;
      if (!(error instanceof Refused) || error.status !== SUPERSEDED || isOwn || tries >= MOST_TRIES) throw error;
    }
  }
}

export async function typed(ask: Ask): Promise<Typed> {
  return (await answered('asked', json(ask))).json() as Promise<Typed>;
}

/** Texts of fields as the program reads them, in their order. */
export async function readings(texts: Entered[]): Promise<Reading[]> {
  return ((await (await answered('quantities', json({ texts }))).json()) as { read: Reading[] }).read;
}

/** The triangles of the object of a question, as bytes. */
export async function surfaceBytes(ask: Ask): Promise<ArrayBuffer> {
  return (await answered('surface', json(ask))).arrayBuffer();
}

export async function upload(files: Iterable<File>): Promise<Uploaded[]> {
  const form = new FormData();
  for (const file of files) form.append('file', file, file.name);
  const told = (await (await answered('files', { method: 'POST', body: form })).json()) as { files: Uploaded[] };
  return told.files;
}

export async function begin(ask: Ask): Promise<string> {
  return ((await (await answered('jobs', json(ask))).json()) as { id: string }).id;
}

export async function cancel(id: string): Promise<void> {
  await answered(`jobs/${id}`, { method: 'DELETE' });
}

export async function file(id: string, name: string): Promise<Blob> {
  return (await answered(`jobs/${id}/files/${name}`)).blob();
}

/** Connections that may break one after the other without an event. */
const MAX_SILENT = 5;
/** Time before a connection is made again [ms]. */
const PAUSE = 300;
/** Events after which nothing comes. */
const LAST = ['done', 'failed', 'cancelled'];

/** The blocks of one connection, until it ends or breaks. */
async function* blocks(id: string, after: number): AsyncGenerator<string> {
  const response = await answered(`jobs/${id}/events`, { headers: { 'Last-Event-ID': String(after) } }).catch((error: unknown) => {
    if (error instanceof Refused && error.status === LOST) return null;
    throw error;
  });
  const reader = response?.body?.pipeThrough(new TextDecoderStream()).getReader();
  if (!reader) return;
  try {
    let rest = '';
    for (;;) {
      const { done, value } = await reader.read().catch(() => ({ done: true, value: undefined }));
      if (done || value === undefined) return;
      const whole = (rest + value).split('\n\n');
      rest = whole.pop() ?? '';
      yield* whole;
    }
  } finally {
    void reader.cancel().catch(() => undefined);
  }
}

/** The events of a job up to its last one. If the connection breaks, it is made again; if that fails, this throws. */
export async function follow(id: string, each: (name: string, data: never) => void): Promise<void> {
  let [last, silent] = [0, 0];
  while (silent < MAX_SILENT) {
    silent += 1;
    for await (const block of blocks(id, last)) {
      silent = 0;
      const field = (name: string) => block.split('\n').find((line) => line.startsWith(name))?.slice(name.length);
      const [name, data] = [field('event: '), field('data: ')];
      if (!name || !data) continue;
      last = Number(field('id: ') ?? last);
      each(name, JSON.parse(data) as never);
      if (LAST.includes(name)) return;
    }
    await new Promise((resolve) => setTimeout(resolve, PAUSE));
  }
  throw lost();
}
