import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { follow, Refused, run } from './api';
import { t } from './words';

const event = (id: number, name: string) => `id: ${id}\nevent: ${name}\ndata: {"id":${id}}\n\n`;

/** A connection that tells this much and then breaks off. */
function broken(text: string): Response {
  let isTold = false;
  return new Response(new ReadableStream({
    pull(controller) {
      if (isTold || !text) controller.error(new TypeError('network error'));
      else controller.enqueue(new TextEncoder().encode(text));
      isTold = true;
    },
  }));
}

/** Follows a job over these connections; what the page heard, what it asked for, and how it ended. */
async function followed(connections: (() => Response)[]) {
  const [told, asked]: [string[], string[]] = [[], []];
  vi.stubGlobal('fetch', async (_: string, init: RequestInit) => {
    asked.push(new Headers(init.headers).get('Last-Event-ID') ?? '');
    const next = connections[asked.length - 1];
    if (!next) throw new TypeError('connection refused');
    return next();
  });
  const ended = follow('job-1', (name, data) => told.push(`${name} ${(data as { id: number }).id}`)).then(() => null, (error: unknown) => error);
  await vi.runAllTimersAsync();
  return { told, asked, error: await ended };
}

beforeEach(() => {
  vi.useFakeTimers();
  vi.stubGlobal('sessionStorage', { getItem: () => 'token' });
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

it('goes on where a connection broke off, as long as each one tells something', async () => {
  const rows = Array.from({ length: 12 }, (_, i) => () => broken(event(i + 1, 'object')));
  const { told, asked, error } = await followed([...rows, () => new Response(event(13, 'done'))]);
  expect(error).toBe(null);
  expect(told).toEqual([...rows.map((_, i) => `object ${i + 1}`), 'done 13']);
  expect(asked).toEqual(Array.from({ length: 13 }, (_, i) => String(i)));
});

it('does not end as if the job had, where connections break off or end without its last event', async () => {
  for (const silent of [() => broken(''), () => new Response(''), () => { throw new TypeError('connection refused'); }]) {
    const { told, asked, error } = await followed([() => broken(event(1, 'object')), silent, silent, silent, silent, silent]);
    expect(told).toEqual(['object 1']);
    expect(error).toBeInstanceOf(Refused);
    expect((error as Refused).failure.message).toBe(t('lost'));
    // The connection that told something, and five that told nothing.
    expect(asked).toEqual(['0', '1', '1', '1', '1', '1']);
  }
});

it('does not try again what is refused, or what the page itself does wrong', async () => {
  const refusal = JSON.stringify({ error: { kind: 'missing', key: null, file: null, line: null, message: 'there is no such job', hint: '' } });
  const refused = await followed([() => new Response(refusal, { status: 404 })]);
  expect([(refused.error as Refused).status, refused.asked.length]).toEqual([404, 1]);
  vi.stubGlobal('fetch', async () => new Response(event(1, 'object')));
  await expect(follow('job-1', () => { throw new RangeError('defect'); })).rejects.toBeInstanceOf(RangeError);
});

/** Answers of the program one after the other. */
function answers(...all: { status: number; body: unknown }[]) {
  const asked: Record<string, unknown>[] = [];
  vi.stubGlobal('fetch', async (_: string, init: RequestInit) => {
    asked.push(JSON.parse(String(init.body)) as Record<string, unknown>);
    const { status, body } = all[asked.length - 1]!;
    return new Response(JSON.stringify(body), { status });
  });
  return asked;
}
const superseded = { status: 409, body: { error: { kind: 'superseded', message: '', hint: '' } } };

it('asks again where none of this tab has stopped it, and names its tab', async () => {
  const asked = answers(superseded, { status: 200, body: { n: 1 } });
  expect(await run({ command: 'object', options: {}, slot: 'again' })).toEqual({ n: 1 });
  expect(asked.length).toBe(2);
  expect(asked[0]!['tab']).toMatch(/^[0-9a-f]+$/);
  expect(asked[1]).toEqual(asked[0]);
});

it('does not ask again what a newer question of this tab has replaced', async () => {
  const asked = answers(superseded, { status: 200, body: { n: 2 } });
  const older = run({ command: 'object', options: { n: 1 }, slot: 'newer' }).catch((error: unknown) => error);
  const newer = run({ command: 'object', options: { n: 2 }, slot: 'newer' });
  expect(await older).toBeInstanceOf(Refused);
  expect(await newer).toEqual({ n: 2 });
  expect(asked.length).toBe(2);
});
