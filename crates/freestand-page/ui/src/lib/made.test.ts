import { expect, it } from 'vitest';
import { columnsOf, EXAMPLE, listOf, studyOf, timeLeft } from './made';

const nothing = { place: '', site: '', years: '', pga: '', hazard: null, storeys: '', frame: '', period: '' };

it('makes a study only of what no option says', () => {
  expect(studyOf({ ...nothing, place: 'Wellington', storeys: '7' })).toBe(null);
  expect(studyOf({ ...nothing, place: 'Wellington', site: 'C', storeys: '7', frame: 'steel-braced', period: '0,8' }))
    .toBe('[ground]\nplace = "Wellington"\nsite = "C"\n[building]\nstoreys = 7\nframe = "steel-braced"\nperiod = "0.8 s"\n');
  expect(studyOf({ ...nothing, place: '-0.18, -78.47', years: '475', hazard: 'uhs.csv', frame: 'other' }))
    .toBe('[ground]\nplace = "-0.18, -78.47"\nreturn_period_years = "475"\nspectrum = "uhs.csv"\n[building]\nframe = "other"\n');
  // No option says a peak acceleration.
  expect(studyOf({ ...nothing, pga: '0,3' }))
    .toBe('[ground]\nsite = "B"\ncode = "eurocode8"\nspectrum_type = "1"\nground_acceleration = "0.3 g"\n');
});

it('makes a list of the rows in which something was typed', () => {
  expect(listOf([['', ' ', '', '', '', '']])).toBe(null);
  expect(listOf([['cabinet, old', '1', '1,8 m', '400 mm', '', ''], ['', '', '', '', '', '']])).toBe('id,item,floor,height,thickness,mass,quantity\n1,"cabinet, old",1,"1,8 m",400 mm,,');
  expect(listOf(EXAMPLE)!.split('\n').length).toBe(EXAMPLE.length + 1);
});

it('makes a mapping of the columns that were named', () => {
  expect(columnsOf({})).toBe(null);
  expect(columnsOf({ 'Hgt "all"': 'height' })).toBe('[columns]\n"Hgt \\"all\\"" = "height"\n');
});

it('tells the time that is left once something is done', () => {
  expect([timeLeft(0, 21, 60), timeLeft(7, 21, 60), timeLeft(21, 21, 60)]).toEqual([null, 120, null]);
});
