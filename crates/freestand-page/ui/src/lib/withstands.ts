/** What a shock of so many g means, by what known objects withstand. */
import type { Withstands } from './facts';
import { gShown } from './units';
import { t } from './words';

const named = ({ class: what, state }: Withstands) => (state === 'any' || !state ? what : `${what}, ${t(state === 'operating' ? 'state.operating' : 'state.non-operating')}`);

/** One line: what withstands less than this shock, and what withstands more. */
export function meaning(g: number, known: Withstands[]): string {
  const sorted = known.flatMap((one) => (one.peak_g === null ? [] : [{ ...one, peak_g: one.peak_g }])).sort((a, b) => a.peak_g - b.peak_g);
  const less = sorted.filter((one) => one.peak_g < g).at(-1);
  const more = sorted.find((one) => one.peak_g >= g);
  const parts = [
    ...(less ? [t('means.more', { what: named(less), g: gShown(less.peak_g) })] : []),
    ...(more ? [t('means.less', { what: named(more), g: gShown(more.peak_g) })] : []),
  ];
  return parts.length > 0 ? t('means', { g: gShown(g), parts: parts.join(' ') }) : '';
}
