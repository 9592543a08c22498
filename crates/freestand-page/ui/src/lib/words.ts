import en from '../words/en.json';

export type Word = keyof typeof en;

/** A text of the page, with {names} replaced. */
export function t(word: Word, values: Record<string, string | number> = {}): string {
  return en[word].replace(/\{(\w+)\}/g, (_, name: string) => String(values[name] ?? ''));
}

const ORDINALS = new Intl.PluralRules('en', { type: 'ordinal' });

/** A number in a row: 1st, 52nd, 84th. */
export function ordinal(n: number): string {
  const rule = ORDINALS.select(n);
  return t(rule === 'one' || rule === 'two' || rule === 'few' ? `ordinal.${rule}` : 'ordinal.other', { n });
}

/** A remark of the program as a sentence: with a capital and a full stop. */
export function sentence(text: string): string {
  if (!text) return '';
  const first = /^[a-z]+[ ,]/.test(text) ? text.charAt(0).toUpperCase() + text.slice(1) : text;
  return /[.!?…]$/.test(first) ? first : `${first}.`;
}
