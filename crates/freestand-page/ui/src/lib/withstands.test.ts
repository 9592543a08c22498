import { expect, it } from 'vitest';
import { meaning } from './withstands';
import { t } from './words';

const known = [{ class: 'rack server', state: 'operating', peak_g: 2, confidence: 'recalled' }, { class: 'fragile museum object', state: 'any', peak_g: 20, confidence: 'recalled' }];

it('says a shock by what withstands less and what withstands more', () => {
  expect(meaning(14, known)).toContain('14 g');
  expect(meaning(14, known)).toContain(t('means.more', { what: `rack server, ${t('state.operating')}`, g: '2.0 g' }));
  expect(meaning(14, known)).toContain(t('means.less', { what: 'fragile museum object', g: '20 g' }));
  expect(meaning(14, [])).toBe('');
});
