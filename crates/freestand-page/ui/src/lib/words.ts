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

/** A message of the program with names of fields in place of flags and keys: who fills in a form has no command line. */
export function plain(text: string): string {
  return text.replace(/"[^"]*"|'--([a-z-]+) <\w+>'|(?<![\w-])--([a-z][a-z-]*)|`([a-z][a-z_]*)`/g, (found, whole?: string, bare?: string, key?: string) => {
    const name = whole ?? bare ?? key?.replaceAll('_', '-');
    // What the user typed stands in quotes.
    if (name === undefined) return found;
    const word = name === 'floor' ? 'level' : name;
    const label = word in en ? t(word as Word).replace(/:.*/, '') : name.charAt(0).toUpperCase() + name.slice(1).replaceAll('-', ' ');
    return `“${label}”`;
  });
}

/** A message of the program as a sentence. */
export function sentence(text: string): string {
  // The page cannot show the help of a command.
  const parts = text.split('; ').filter((part) => !/(?<![\w-])--help\b|^usage:|\bfreestand [a-z]/.test(part));
  const named = plain(parts.join('; '));
  if (!named) return '';
  const first = /^[a-z]+[ ,]/.test(named) ? named.charAt(0).toUpperCase() + named.slice(1) : named;
  return /[.!?…]$/.test(first) ? first : `${first}.`;
}
