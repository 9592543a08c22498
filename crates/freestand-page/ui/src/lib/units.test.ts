import { describe, expect, it } from 'vitest';
import { enteredIn, gShown, inUnits, lengthEntered, lengthM, lengthShown, lengthText, massKg, massShown, percent, stiffnessNM, stiffnessShown } from './units';

describe('lengths', () => {
  it('are read as the program reads them', () => {
    const read: [string, number | null][] = [
      ['1.8 m', 1.8], ['400mm', 0.4], ['40 cm', 0.4], ['18in', 0.4572], ["6'6\"", 1.9812], ['6 ft 6 in', 1.9812],
      ['3 apples', null], ['', null], ['-1 m', null], ['0 m', null], ['1.8', null], ['1 m 2', null],
    ];
    for (const [text, metres] of read) {
      const found = lengthM(text);
      if (metres === null || found === null) expect(found, text).toBe(metres);
      else expect(found, text).toBeCloseTo(metres, 10);
    }
  });

  it('come back from their text to a quarter of a millimetre', () => {
    for (const units of ['si', 'us'] as const) {
      for (const metres of [0.05, 0.3, 0.4, 0.9999, 1, 1.8, 2.345]) {
        expect(Math.abs(lengthM(lengthText(metres, units))! - metres)).toBeLessThan(0.00025);
      }
    }
    expect([lengthText(1.8, 'si'), lengthText(0.4, 'si'), lengthText(1.8, 'us')]).toEqual(['1.8 m', '400 mm', '5\'10.87"']);
  });

  it('are shown as people write them', () => {
    expect([1.8, 0.4, 0.0036, 0.00002, 0].map((one) => lengthShown(one, 'si'))).toEqual(['1.80 m', '400 mm', '3.6 mm', '< 1 mm', '0 mm']);
    expect([1.8, 0.0254, 0.0036, 0.0009, 0].map((one) => lengthShown(one, 'us'))).toEqual(['5′ 11″', '1″', '0.14″', '< 0.04″', '0″']);
    expect([massShown(150, 'si'), massShown(150, 'us')]).toEqual(['150 kg', '331 lb']);
  });
});

describe('masses and stiffnesses', () => {
  it('are read and shown in both units', () => {
    expect([massKg('150 kg'), massKg('2lb'), massKg('heavy'), massKg('0 kg')]).toEqual([150, 0.90718474, null, null]);
    expect([stiffnessNM('4380 N/mm'), stiffnessNM('4380 kN/m'), stiffnessNM('rubber-foot'), stiffnessNM('4380')]).toEqual([4.38e6, 4.38e6, null, null]);
    // One pound-force is 4.4482216152605 N, one inch 25.4 mm.
    expect(stiffnessNM('1 lb/in')).toBeCloseTo(4.4482216152605 / 0.0254, 9);
    expect([stiffnessShown(4.38e6, 'si'), stiffnessShown(4.38e6, 'us')]).toEqual(['4380 N/mm', '25000 lb/in']);
  });
});

describe('shares and accelerations', () => {
  it('have the digits of the program', () => {
    // 12.5 and 13.5 % are halves: the program writes 12 % and 14 %.
    expect([0, 0.125, 0.135, 0.35, 1, 0.0013, 0.5875, 0.095].map(percent)).toEqual(['0', '12', '14', '35', '100', '0.13', '59', '9.5']);
    expect([0, 0.0001, 0.1, 3, 12.34, 321].map((g) => gShown(g))).toEqual(['0 g', '< 0.001 g', '0.10 g', '3.0 g', '12 g', '321 g']);
  });
});

it('a text that is shown in other units is still the text that was typed', () => {
  // What is asked is the typed text; what is shown is made of it, however often the units change.
  for (const typed of ['400 mm', '1.8 m', '5\'11"', '15.75 in']) {
    expect(lengthM(inUnits(typed, 'length', 'us'))).toBeCloseTo(lengthM(typed)!, 3);
  }
  expect(inUnits('400 mm', 'length', 'us')).toBe('1\'3.75"');
  expect(inUnits('150 kg', 'mass', 'us')).toBe('330.7 lb');
  expect(inUnits('4380 N/mm', 'stiffness', 'us')).toBe('25010 lb/in');
  expect(inUnits('rubber-foot', 'stiffness', 'us')).toBe('rubber-foot');
});

it('sizes as people write them', () => {
  expect(lengthEntered('1,8 m', 'si')).toBe('1.8 m');
  // Metres or thousands of millimetres: nobody guesses.
  expect([lengthEntered('1,800 mm', 'si'), lengthEntered('1,800', 'si'), enteredIn('1,200 kg', 'kg')]).toEqual(['1,800 mm', '1,800', '1,200 kg']);
  expect([lengthM('1,800 mm'), massKg('1,200 kg'), lengthM('1,85 m')]).toEqual([null, null, 1.85]);
  expect(lengthEntered('1800', 'si')).toBe('1800 mm');
  expect(lengthEntered('1.8', 'si')).toBe('1.8 m');
  expect(lengthEntered('0', 'si')).toBe('0 mm');
  expect(lengthEntered('36', 'us')).toBe('36 in');
  expect(lengthEntered('3 apples', 'si')).toBe('3 apples');
  expect([enteredIn('0,3', 'g'), enteredIn('0.3 g', 'g'), enteredIn('0,2-0,8', '')]).toEqual(['0.3 g', '0.3 g', '0.2-0.8']);
});
