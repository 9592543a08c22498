import { expect, test } from 'vitest';
import { chosen, hiddenRows, nextProblem, problemCells, ranked, rowsOf, windowed, type Problem, type Row } from './inventory';

const row = (rank: number, id: string, more: Partial<Row> = {}): Row => ({
  rank, id, item: null, quantity: 1, floor: '1', decision: 'leave', why: '', row: rank, p_overturn: null, p_overturn_low: null,
  p_overturn_high: null, edge_acceleration_g_median: null, ...more,
});
const problem = (cells: string[]): Problem => ({ severity: 'error', kind: 'x', heading: null, count: cells.length, rows: [], cells, message: '', hint: '', edits: [] });

test('problems are visited in the order of the sheet, round the end', () => {
  const cells = problemCells([problem(['D7', 'AA3', 'D10']), problem(['B3', 'D7'])]);
  expect(cells.map((one) => one.cell)).toEqual(['B3', 'AA3', 'D7', 'D7', 'D10']);
  expect(nextProblem(cells, null)).toBe('B3');
  expect(nextProblem(cells, 'D7')).toBe('D10');
  expect(nextProblem(cells, 'D10')).toBe('B3');
  expect(nextProblem(cells, 'B4')).toBe('D7');
  expect(nextProblem([], 'D10')).toBe(null);
});

test('a problem of rows without cells names its rows', () => {
  const hidden = (rows: number[]) => ({ ...problem([]), kind: 'hidden-row', rows });
  expect([[3], [3, 5], []].map((rows) => rowsOf(hidden(rows)))).toEqual(['Row 3', 'Rows 3, 5', '']);
  expect(rowsOf(hidden([1, 2, 3]), 2)).toBe('Rows 1, 2 and 1 more');
  expect(rowsOf({ ...problem(['D7']), rows: [7] })).toBe('');
  expect([...hiddenRows([problem(['D7']), hidden([3, 5])])]).toEqual([3, 5]);
});

test('rows that come one by one end in the order of their urgency', () => {
  const urgency: Record<string, number> = { a: 3, b: 1, c: 2, d: 0, e: 5 };
  const told: string[] = [];
  let rows: Row[] = [];
  for (const id of ['a', 'b', 'c', 'd', 'e']) {
    rows = ranked(rows, [row(told.filter((one) => urgency[one]! < urgency[id]!).length + 1, id)]);
    told.push(id);
  }
  expect(rows.map((one) => one.id)).toEqual(['d', 'b', 'c', 'a', 'e']);
  expect(rows.map((one) => one.rank)).toEqual([1, 2, 3, 4, 5]);
});

test('rows are filtered and sorted; what has no value is last', () => {
  const rows = [
    row(1, 'A-10', { p_overturn: 0.5, edge_acceleration_g_median: 2 }), row(2, 'A-2', { p_overturn: null, edge_acceleration_g_median: 'overturned' }),
    row(3, 'B', { decision: 'restrain', floor: '2', p_overturn: 0.1, why: 'It falls.' }),
  ];
  const ids = (wanted: Partial<{ text: string; verdict: string; floor: string }>, by: string, down = false) =>
    chosen(rows, { text: '', verdict: '', floor: '', ...wanted }, { by, down }).map((one) => one.id);
  expect(ids({}, 'id')).toEqual(['A-2', 'A-10', 'B']);
  expect(ids({}, 'p_overturn')).toEqual(['B', 'A-10', 'A-2']);
  expect(ids({}, 'p_overturn', true)).toEqual(['A-10', 'B', 'A-2']);
  expect(ids({}, 'edge_acceleration_g_median', true)).toEqual(['A-2', 'A-10', 'B']);
  expect(ids({ text: 'FALLS' }, 'rank')).toEqual(['B']);
  expect(ids({ verdict: 'leave', floor: '1' }, 'rank', true)).toEqual(['A-2', 'A-10']);
});

test('a long list has few rows in the document', () => {
  expect(windowed(10_000, 0, 40, 40)).toEqual({ from: 0, to: 40 });
  expect(windowed(10_000, 399_000, 40, 40)).toEqual({ from: 9960, to: 10_000 });
  expect(windowed(5, 0, 40, 40)).toEqual({ from: 0, to: 5 });
  const { from, to } = windowed(10_000, 4000, 40, 40);
  expect([from <= 100, to - from]).toEqual([true, 40]);
});
