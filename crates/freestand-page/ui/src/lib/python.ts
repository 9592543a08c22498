/** The call of the Python package that asks the same as a request of the page. */
import type { Ask, Option } from './api';
import { lengthM, massKg, stiffnessNM } from './units';

/** Two values that Python takes as a tuple. */
class Pair {
  constructor(readonly low: number, readonly high: number) {}
}

type Value = string | number | Pair | Value[] | { [name: string]: Value };

const G0_M_S2 = 9.80665;

/** A value as Python writes it. */
function written(value: Value): string {
  if (typeof value === 'number') return String(value).replace('e+', 'e');
  if (typeof value === 'string') return JSON.stringify(value);
  if (value instanceof Pair) return `(${value.low}, ${value.high})`;
  if (Array.isArray(value)) return `[${value.map(written).join(', ')}]`;
  return `{${Object.entries(value).map(([name, one]) => `${JSON.stringify(name)}: ${written(one)}`).join(', ')}}`;
}

const call = (name: string, first: string[], named: Record<string, Value | undefined>) => {
  const rest = Object.entries(named).flatMap(([key, value]) => (value === undefined ? [] : [`${key}=${written(value)}`]));
  return `${name}(${[...first, ...rest].join(', ')})`;
};

/** Thrown where a text is understood by the program alone. */
class Unread extends Error {}

function read<T>(text: Option | undefined, reader: (text: string) => T | null): T | undefined {
  if (text === undefined || text === '') return undefined;
  const found = reader(String(text));
  if (found === null) throw new Unread(String(text));
  return found;
}

const metres = (text: Option | undefined) => read(text, (one) => {
  if (/^0\s*\w*$/.test(one.trim())) return 0;
  const found = lengthM(one);
  return found === null ? null : Number(found.toPrecision(12));
});
const number = (text: Option | undefined) => read(text, (one) => {
  const [, value, percent] = /^\s*(-?\d+(?:\.\d+)?(?:e-?\d+)?)\s*(%?)\s*$/.exec(one) ?? [];
  return value === undefined ? null : Number(value) / (percent ? 100 : 1);
});
const withUnit = (units: Record<string, number>) => (text: Option | undefined) => read(text, (one) => {
  const [, value, unit] = /^\s*(\d+(?:\.\d+)?)\s*([^\d\s]\S*)\s*$/.exec(one) ?? [];
  const factor = units[unit ?? ''];
  return value === undefined || factor === undefined ? null : Number((Number(value) * factor).toPrecision(12));
});
const speed = withUnit({ 'm/s': 1, 'mm/s': 0.001, 'cm/s': 0.01, 'in/s': 0.0254, 'ft/s': 0.3048 });
const hertz = withUnit({ Hz: 1, kHz: 1000 });
const text = (value: Option | undefined) => (value === undefined || value === '' ? undefined : String(value));

/** One ratio, or the two ends of a range. */
function friction(value: Option | undefined): Value | undefined {
  const ends = text(value)?.split(/\s+to\s+|\s*-\s*/);
  if (!ends) return undefined;
  const [low, high] = ends.map((one) => number(one)!);
  return high === undefined ? low : new Pair(low!, high);
}

/** A peak, perhaps with the duration of its half-sine: 10 g, 15 g 11 ms. */
function tolerance(value: Option | undefined): Record<string, Value | undefined> {
  const given = text(value);
  if (given === undefined) return {};
  const [, peak, unit, ms] = /^\s*(\d+(?:\.\d+)?)\s*(g|m\/s2)(?:[\s,]+(\d+(?:\.\d+)?)\s*ms)?\s*$/.exec(given) ?? [];
  if (!peak) throw new Unread(given);
  return { tolerance_g: unit === 'g' ? Number(peak) : Number(peak) / G0_M_S2, tolerance_duration_s: ms === undefined ? undefined : Number(ms) / 1000 };
}

const stiffness = (value: Option | undefined) => read(value, stiffnessNM);
const mass = (value: Option | undefined) => read(value, massKg);

/** A value that a call needs. */
function needed(value: number | undefined): string {
  if (value === undefined) throw new Unread('');
  return written(value);
}

function ofObject(o: Ask['options'], motions: string[], study: string | undefined): string {
  const on = text(o['on']);
  const isEntry = on !== undefined && /^[a-z]/i.test(on);
  const floor = o['floor'] === undefined ? undefined : /^\d+$/.test(String(o['floor'])) ? Number(o['floor']) : String(o['floor']);
  return `${call('fs.check_object', [needed(metres(o['height'])), needed(metres(o['thickness']))], {
    width_m: metres(o['width']), cg_height_m: metres(o['cg-height']), mass_kg: mass(o['mass']),
    stiffness_n_m: isEntry ? undefined : stiffness(on), cushion: isEntry ? on : undefined, ...tolerance(o['tolerance']),
    study, place: text(o['place']), site: text(o['site']), floor, storeys: number(o['storeys']), friction: friction(o['friction']),
    wall_gap_m: metres(o['wall-gap']), neighbour_gap_m: metres(o['neighbour-gap']), wall_height_m: metres(o['wall-height']),
    wall_stiffness_n_m: stiffness(o['wall-stiffness']), wall_restitution: number(o['wall-restitution']), casters: text(o['casters']),
    rolling_resistance: number(o['rolling-resistance']), clearance_m: metres(o['clearance']),
    upper_height_m: metres(o['upper-height']), upper_thickness_m: metres(o['upper-thickness']), upper_mass_kg: mass(o['upper-mass']),
  }).slice(0, -1)}${motions.length > 0 ? `, motions=fs.read_motions(${written(motions)})` : ''})`;
}

/** "0.3 m:3 m:64" for NumPy. */
function grid(value: Option | undefined): string {
  const [from, to, count] = String(value).split(':');
  if (count === undefined) return `[${needed(metres(from))}]`;
  return `np.linspace(${needed(metres(from))}, ${needed(metres(to))}, ${count})`;
}

function ofSpectrum(o: Ask['options'], motions: string[]): string {
  if (motions.length === 0) {
    const study: Record<string, Value> = {
      building: { storeys: Number(o['storeys']), levels: [{ name: 'floor', level_ratio: Number(o['level-ratio']) }] },
      objects: {
        heights: String(o['heights']), thicknesses: String(o['thicknesses']), mass: String(o['mass']), stiffness: String(o['stiffness']),
        ...(o['restitution-factor'] === undefined ? {} : { restitution_factor: Number(o['restitution-factor']) }), accuracy: String(o['accuracy']),
      },
    };
    return `${call('fs.run', [written(study)], { place: text(o['place']), site: text(o['site']) })}.rows`;
  }
  const first = [`fs.read_motions(${written(motions)})`, grid(o['heights']), grid(o['thicknesses'])];
  const called = call('fs.spectrum', first, {
    mass_kg: mass(o['mass']), stiffness_n_m: stiffness(o['stiffness']), restitution_factor: number(o['restitution-factor']), accuracy: text(o['accuracy']),
  });
  return called.includes('np.') ? `import numpy as np\n${called}` : called;
}

function ofRecord(o: Ask['options'], file: string): string {
  const lowest = { baseline: text(o['baseline']), taper_ratio: number(o['taper']), low_cut_hz: hertz(o['low-cut']), high_cut_hz: hertz(o['high-cut']), scale: number(o['scale']), unit: text(o['unit']) };
  return `${call('fs.read_motion', [written(file)], lowest)}.spectrum()`;
}

/** The lines that ask the same in Python; null where a text is understood by the program alone. */
export function pythonLine(ask: Ask, names: Record<string, string> = {}): string | null {
  const files = (flag: string) => (ask.files?.[flag] ?? []).map((id) => names[id] ?? id);
  const o = ask.options;
  const line = () => {
    switch (ask.command) {
      case 'object': return ofObject(o, files('motion'), files('study')[0]);
      case 'spectrum': return ofSpectrum(o, files('motion'));
      case 'motion spectrum': return ofRecord(o, files('file')[0] ?? '');
      case 'cushion drop': return call('fs.drop_test', [written(files('file'))], { mass_kg: mass(o['mass']), height_m: metres(o['height']), impact_velocity_m_s: speed(o['impact-velocity']) });
      case 'inventory check': return call('fs.check_inventory', [written(files('inventory')[0] ?? files('file')[0] ?? '')], { storeys: number(o['storeys']) });
      case 'assess': return call('fs.assess', [], { study: files('study')[0], inventory: files('inventory')[0], place: text(o['place']), site: text(o['site']), storeys: number(o['storeys']) });
      default: return null;
    }
  };
  try {
    const told = line();
    return told === null ? null : `import freestand as fs\n${told}`;
  } catch (error) {
    if (error instanceof Unread) return null;
    throw error;
  }
}
