/** A list of objects as the program read it, and the verdicts on them. */

import { t } from './words';

export interface Problem { severity: string; kind: string; heading: string | null; count: number; rows: number[]; cells: string[]; message: string; hint: string; edits: string[] }
export interface Column { column: string; heading: string; name: string; unit: string | null }
export interface Item {
  row: number; id: string; item: string | null; quantity: number; floor: string | null; level_ratio: number | null;
  height_m: number | null; thickness_m: number | null; width_m: number | null; cg_height_m: number | null; mass_kg: number | null;
}
export interface Cells { columns: string[]; headings: string[]; rows: number[]; texts: string[][] }
export interface Checked {
  counts: { rows: number; objects: number }; columns: Column[]; problems: Problem[]; objects: Item[]; warnings: string[]; cells?: Cells;
}

export interface Edit { cell: string; value: string }

/** A row of objects.csv; other columns are there too. */
export interface Row {
  rank: number; id: string; item: string | null; quantity: number; floor: string | null; decision: string | null; why: string; row: number;
  p_overturn: number | null; p_overturn_low: number | null; p_overturn_high: number | null;
  edge_acceleration_g_median: number | string | null;
  [column: string]: unknown;
}

/** The plan within a budget, and one of its measures. */
export interface Plan { currency: string }
export interface PlanRow {
  id: string; measure: string; decision: string; quantity: number; cost: number; p_overturn: number;
  p_overturn_after: number | null; p_overturn_after_low: number | null; p_overturn_after_high: number | null;
}

export const VERDICTS = { restrain: '▲', soften: '◆', lock: '■', 'no-verdict': '?', leave: '●' } as const;
export type Verdict = keyof typeof VERDICTS;
/** The colour of a verdict: nothing is green in a place or a building that nobody has named. */
export const colour = (decision: string | null, isAssumed: boolean): string | null =>
  decision === 'leave' && isAssumed ? 'no-verdict' : decision;

/** The name of the copy of a list with the corrected cells. */
export const CHECKED = 'checked.xlsx';

/** A cell by its name: D7 is row 7, column D. */
export function parts(cell: string): { column: string; row: number } {
  const [, column = '', row = '0'] = /^([A-Z]+)(\d+)$/.exec(cell) ?? [];
  return { column, row: Number(row) };
}

/** The order in which one reads a sheet. */
function inSheet(a: string, b: string): number {
  const [one, other] = [parts(a), parts(b)];
  const columns = one.column.length - other.column.length || (one.column < other.column ? -1 : Number(one.column > other.column));
  return one.row - other.row || columns;
}

/** The text of a cell; empty where the sheet has none. */
export function textOf(cells: Cells, cell: string): string {
  const { column, row } = parts(cell);
  return cells.texts[cells.rows.indexOf(row)]?.[cells.columns.indexOf(column)] ?? '';
}

/** Problems by cell, in the order in which one reads the sheet. */
export function problemCells(problems: Problem[]): { cell: string; problem: Problem }[] {
  return problems.flatMap((problem) => problem.cells.map((cell) => ({ cell, problem }))).sort((a, b) => inSheet(a.cell, b.cell));
}

/** The rows of a problem that has no cells, such as a hidden row; empty where it is of the whole list. */
export function rowsOf({ rows, cells }: Problem, most = 10): string {
  if (rows.length === 0 || cells.length > 0) return '';
  const [named, more] = [rows.slice(0, most).join(', '), rows.length - most];
  return more > 0 ? t('inventory.row.more', { rows: named, more }) : t(rows.length === 1 ? 'inventory.row.one' : 'inventory.row.some', { rows: named });
}

/** The rows that a spreadsheet does not show. */
export function hiddenRows(problems: Problem[]): Set<number> {
  return new Set(problems.flatMap((problem) => (problem.kind === 'hidden-row' ? problem.rows : [])));
}

/** The problem after a cell, round the end; the first without a cell. */
export function nextProblem(cells: { cell: string }[], from: string | null): string | null {
  const after = from === null ? undefined : cells.find((one) => inSheet(one.cell, from) > 0);
  return (after ?? cells[0])?.cell ?? null;
}

/** Takes rows that come one by one to their rank, which counts those before them. */
export function ranked(rows: Row[], coming: Row[]): Row[] {
  const all = [...rows];
  for (const row of coming) all.splice(row.rank - 1, 0, row);
  return all.map((row, i) => (row.rank === i + 1 ? row : { ...row, rank: i + 1 }));
}

/** An object after some of its worlds: no verdict. */
export interface Estimate {
  row: number; id: string; worlds: number; p_overturn: number; p_overturn_low: number; p_overturn_high: number; is_settled: boolean;
}

const MOST_ESTIMATES = 15;

/** The objects that fall most often so far. */
export function likeliest(estimates: Map<number, Estimate>): Estimate[] {
  return [...estimates.values()].sort((a, b) => b.p_overturn - a.p_overturn || a.row - b.row).slice(0, MOST_ESTIMATES);
}

export interface Wanted { text: string; verdict: string; floor: string }
export interface Order { by: string; down: boolean }

const collator = new Intl.Collator(undefined, { numeric: true });

/** The rows that are wanted, in order; what has no value is last either way. */
export function chosen(rows: Row[], wanted: Wanted, { by, down }: Order): Row[] {
  const text = wanted.text.trim().toLowerCase();
  const is = (row: Row) =>
    (!wanted.verdict || row.decision === wanted.verdict) && (!wanted.floor || row.floor === wanted.floor) &&
    (!text || `${row.id} ${row.item ?? ''} ${row.floor ?? ''} ${row.why}`.toLowerCase().includes(text));
  // An object that falls ranks above every number.
  const value = (row: Row) => (row[by] === 'overturned' ? Infinity : row[by]);
  const sign = down ? -1 : 1;
  const compare = (a: Row, b: Row) => {
    const [x, y] = [value(a) ?? null, value(b) ?? null];
    if (x === null || y === null) return Number(x === null) - Number(y === null);
    return sign * (typeof x === 'number' && typeof y === 'number' ? (x === y ? 0 : x - y) : collator.compare(String(x), String(y)));
  };
  return rows.filter(is).sort((a, b) => compare(a, b) || a.rank - b.rank);
}

/** The rows of a long list that are in the document: some before and after what is seen. */
export function windowed(count: number, top: number, rowPx: number, most: number): { from: number; to: number } {
  const from = Math.max(0, Math.min(count - most, Math.floor(top / rowPx) - 10));
  return { from, to: Math.min(count, from + most) };
}
