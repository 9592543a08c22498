import en from '../words/en.json';

export type Word = keyof typeof en;

/** A text of the page, with {names} replaced. */
export function t(word: Word, values: Record<string, string | number> = {}): string {
  return en[word].replace(/\{(\w+)\}/g, (_, name: string) => String(values[name] ?? ''));
}
