import { expect, it } from 'vitest';
import type { Ask } from './api';
import { pythonLine } from './python';

const lines = (ask: Ask, names = {}) => pythonLine(ask, names)?.split('\n').slice(1);

it('asks about an object in SI units', () => {
  const options = { height: '1.8 m', thickness: '400 mm', place: 'Melbourne', floor: 'roof', storeys: '30', mass: '150 kg', on: '4380 N/mm' };
  expect(lines({ command: 'object', options })).toEqual(
    ['fs.check_object(1.8, 0.4, mass_kg=150, stiffness_n_m=4380000, place="Melbourne", floor="roof", storeys=30)'],
  );
  const more = { height: '6\'0"', thickness: '18 in', on: 'rubber-foot', tolerance: '15 g 11 ms', friction: '0.3-0.5', 'wall-gap': '0 mm' };
  expect(lines({ command: 'object', options: more, files: { motion: ['1'] } }, { 1: 'roof.csv' })).toEqual([
    'fs.check_object(1.8288, 0.4572, cushion="rubber-foot", tolerance_g=15, tolerance_duration_s=0.011, friction=(0.3, 0.5), wall_gap_m=0, motions=fs.read_motions(["roof.csv"]))',
  ]);
});

it('says nothing where only the program understands a text', () => {
  expect(pythonLine({ command: 'object', options: { height: '1 fathom', thickness: '400 mm' } })).toBeNull();
  expect(pythonLine({ command: 'object', options: { height: '', thickness: '400 mm' } })).toBeNull();
  expect(pythonLine({ command: 'shock', options: {} })).toBeNull();
});

it('asks for spectra under files and at a place', () => {
  const options = { heights: '0.3 m:3 m:64', thicknesses: '100 mm:1 m:64', mass: '150 kg', stiffness: '4380 N/mm', accuracy: 'fast' };
  expect(lines({ command: 'spectrum', options, files: { motion: ['1', '2'] } }, { 1: 'a.csv', 2: 'b.csv' })).toEqual([
    'import numpy as np',
    'fs.spectrum(fs.read_motions(["a.csv", "b.csv"]), np.linspace(0.3, 3, 64), np.linspace(0.1, 1, 64), mass_kg=150, stiffness_n_m=4380000, accuracy="fast")',
  ]);
  expect(lines({ command: 'spectrum', options: { ...options, place: 'Athens', 'level-ratio': 0.5, storeys: 4, 'restitution-factor': 0.9 } })).toEqual([
    'fs.run({"building": {"storeys": 4, "levels": [{"name": "floor", "level_ratio": 0.5}]}, "objects": {"heights": "0.3 m:3 m:64", ' +
      '"thicknesses": "100 mm:1 m:64", "mass": "150 kg", "stiffness": "4380 N/mm", "restitution_factor": 0.9, "accuracy": "fast"}}, place="Athens").rows',
  ]);
});

it('asks about drop tests, records and lists', () => {
  expect(lines({ command: 'cushion drop', options: { mass: '0.365 kg', 'impact-velocity': '1.40 m/s' }, files: { file: ['1'] } }, { 1: 'drop.csv' })).toEqual(
    ['fs.drop_test(["drop.csv"], mass_kg=0.365, impact_velocity_m_s=1.4)'],
  );
  expect(lines({ command: 'motion spectrum', options: { taper: '5 %', 'low-cut': '0.1 Hz' }, files: { file: ['1'] } }, { 1: 'r.at2' })).toEqual(
    ['fs.read_motion("r.at2", taper_ratio=0.05, low_cut_hz=0.1).spectrum()'],
  );
  expect(lines({ command: 'assess', options: { place: 'Athens' }, files: { inventory: ['1'] } }, { 1: 'list.xlsx' })).toEqual(
    ['fs.assess(inventory="list.xlsx", place="Athens")'],
  );
});
