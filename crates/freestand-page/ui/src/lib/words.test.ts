import { expect, it } from 'vitest';
import { ordinal, plain, sentence, t } from './words';

it('fills names in, and counts in English', () => {
  expect(t('spectra.of', { count: 4, all: 10 })).toBe('4 of 10');
  expect([5, 11, 21, 42, 53, 84].map(ordinal)).toEqual(['5th', '11th', '21st', '42nd', '53rd', '84th']);
});

it('makes sentences of remarks', () => {
  expect(sentence('write a unit')).toBe('Write a unit.');
  expect(sentence('--thickness is larger than --height')).toBe(`“${t('thickness')}” is larger than “${t('height')}”.`);
  expect(sentence("a wrong '--storeys <N>'")).toBe(`A wrong “${t('storeys')}”.`);
  expect(sentence('give --pga, or a study')).toBe(`Give “${t('pga')}”, or a study.`);
  expect(sentence('--help shows what is accepted')).toBe('');
  expect(sentence('Is it there?')).toBe('Is it there?');
  expect(sentence('')).toBe('');
});

it('names no flag, known or not', () => {
  expect(plain('give --out-of-the-blue or --height')).toBe(`give “Out of the blue” or “${t('height')}”`);
  expect(sentence('freestand place list shows all places; give --place')).toBe(`Give “${t('place')}”.`);
  expect(plain('`cg_height` is odd')).toBe(`“${t('cg-height')}” is odd`);
  expect(plain('sheet--old.csv, 3 -- 4')).toBe('sheet--old.csv, 3 -- 4');
  expect(sentence('usage: freestand object; see --help')).toBe('');
  expect(plain('--height: "0.4 m --out x" is not a length')).toBe(`“${t('height')}”: "0.4 m --out x" is not a length`);
});
