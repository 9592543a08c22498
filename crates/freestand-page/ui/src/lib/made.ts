/** Files that the page makes of what is entered: a list, the columns of a list, and a study of a place and a building. */

/** The study that a page makes of its fields. */
export const STUDY = 'building.toml';
/** The columns of a list, as they were chosen. */
export const COLUMNS = 'columns.toml';
/** A list that was typed on the page. */
export const TYPED = 'list.csv';

/** The structures of a building whose first period a code estimates. */
export const FRAMES = ['steel-moment', 'concrete-moment', 'steel-braced', 'other'] as const;

export interface Building {
  place: string; site: string; years: string; storeys: string; frame: string; period: string;
  /** The peak ground acceleration on rock, in place of a place. */
  pga: string;
  /** The name of a file of hazard, which lies beside the study. */
  hazard: string | null;
}

const quoted = (text: string) => JSON.stringify(text);

/** A number as it was typed, with this unit where it has none. */
function withUnit(text: string, unit: string): string {
  const number = text.trim();
  return /^\d+(?:[.,]\d+)?$/.test(number) ? `${number.replace(',', '.')} ${unit}` : number;
}

/** The ground type that is assumed, as where a peak acceleration alone is asked about. */
const GROUND = 'B';

/** The options of a peak acceleration on rock: the spectrum of Eurocode 8, type 1, on this soil. */
export function onRock(pga: string, site: string): Record<string, string> {
  return { code: 'eurocode8', 'spectrum-type': '1', site: site || GROUND, 'ground-acceleration': withUnit(pga, 'g') };
}

/**
 * A study with this place and building; null where the fields say nothing that needs one: a place with its soil, its return
 * period and its file, and a number of storeys are options of the command.
 */
export function studyOf({ place, site, years, pga, hazard, storeys, frame, period }: Building): string | null {
  if (!frame && !period.trim() && !pga.trim()) return null;
  const ground = Object.entries({
    place: place.trim(), site, return_period_years: years.trim(), spectrum: hazard ?? '', ...(pga.trim() ? onRock(pga, site) : {}),
  }).filter(([, text]) => text).map(([name, text]) => `${name.replaceAll('-', '_')} = ${quoted(text)}`);
  const building = [
    ...(storeys.trim() ? [`storeys = ${/^\d+$/.test(storeys.trim()) ? Number(storeys) : quoted(storeys.trim())}`] : []),
    ...(frame ? [`frame = ${quoted(frame)}`] : []), ...(period.trim() ? [`period = ${quoted(withUnit(period, 's'))}`] : []),
  ];
  return `${ground.length > 0 ? `[ground]\n${ground.join('\n')}\n` : ''}${building.length > 0 ? `[building]\n${building.join('\n')}\n` : ''}`;
}

/** What is in the columns of a list, by their headings. */
export function columnsOf(meanings: Record<string, string>): string | null {
  const lines = Object.entries(meanings).map(([heading, name]) => `${quoted(heading)} = ${quoted(name)}`);
  return lines.length > 0 ? `[columns]\n${lines.join('\n')}\n` : null;
}

/** The columns of a list that is typed on the page. */
export const TYPED_COLUMNS = ['item', 'floor', 'height', 'thickness', 'mass', 'quantity'] as const;

/** A list as CSV; rows in which nothing was typed are left out, and each row has a number. */
export function listOf(rows: string[][]): string | null {
  const cell = (text: string) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
  const filled = rows.map((row) => row.map((text) => text.trim())).filter((row) => row.some((text) => text !== ''));
  if (filled.length === 0) return null;
  return [['id', ...TYPED_COLUMNS].join(','), ...filled.map((row, i) => [String(i + 1), ...row].map(cell).join(','))].join('\n');
}

/** A list to try the page with. */
export const EXAMPLE = [
  ['instrument cabinet', '2', '1800 mm', '400 mm', '140 kg', '1'], ['bookcase', '1', '2 m', '300 mm', '180 kg', '2'],
  ['server rack', 'ground', '2 m', '600 mm', '400 kg', '1'], ['vase', '1', '600 mm', '250 mm', '', '1'],
  ['refrigerator', 'roof', '1.9 m', '700 mm', '90 kg', '1'], ['drawer unit', '2', '0.7 m', '500 mm', '40 kg', '3'],
];

/** The time that is left, from what was done in the time so far [s]; null before anything is done. */
export function timeLeft(done: number, total: number, seconds: number): number | null {
  return done > 0 && total > done ? (seconds / done) * (total - done) : null;
}
