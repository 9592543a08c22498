/** Numbers as texts, in SI and US units. Only the program reads texts. */

export type Units = 'si' | 'us';

const INCH_M = 0.0254;
const POUND_KG = 0.45359237;
export const POUND_PER_INCH_N_M = 175.12683524647636;

function trimmed(value: number, digits: number): string {
  return value.toFixed(digits).replace(/\.?0+$/, '');
}

/** A length as one writes it: 1.8 m, 400 mm, 5'10.9". */
export function lengthText(metres: number, units: Units): string {
  if (units === 'si') {
    return metres >= 1 ? `${trimmed(metres, 3)} m` : `${trimmed(metres * 1000, 1)} mm`;
  }
  const inches = Math.round((metres / INCH_M) * 100) / 100;
  const feet = Math.floor(inches / 12);
  const rest = trimmed(inches - 12 * feet, 2) || '0';
  return feet > 0 ? `${feet}'${rest}"` : `${rest}"`;
}

/** What a field holds. */
export type Quantity = 'length' | 'mass' | 'stiffness' | 'acceleration' | 'other';

/** A value as one writes it in the other system of units; null for what has the same units in both. */
export function inUnits(si: number, quantity: Quantity, units: Units): string | null {
  const four = (value: number, unit: string) => `${Number(value.toPrecision(4))} ${unit}`;
  switch (quantity) {
    case 'length': return lengthText(si, units);
    case 'mass': return units === 'si' ? four(si, 'kg') : four(si / POUND_KG, 'lb');
    case 'stiffness': return units === 'si' ? four(si / 1000, 'N/mm') : four(si / POUND_PER_INCH_N_M, 'lb/in');
    default: return null;
  }
}

/** A length for people: 1.80 m, 3.6 mm, 5′ 11″, 0.14″. */
export function lengthShown(metres: number, units: Units): string {
  if (units === 'si') {
    const mm = metres * 1000;
    if (mm > 0 && mm < 1) return '< 1 mm';
    return mm >= 1000 ? `${metres.toFixed(2)} m` : `${mm >= 100 ? mm.toFixed(0) : Number(mm.toPrecision(2))} mm`;
  }
  const inches = metres / INCH_M;
  if (inches > 0 && inches < 0.04) return '< 0.04″';
  if (inches < 12) return `${Number(inches.toPrecision(inches >= 1 ? 3 : 2))}″`;
  const whole = Math.round(inches);
  return `${Math.floor(whole / 12)}′ ${whole % 12}″`;
}

const MILE_KM = 1.609344;

/** A distance on the Earth for people. */
export function distanceShown(km: number, units: Units): string {
  const value = units === 'si' ? km : km / MILE_KM;
  return `${value < 10 ? value.toFixed(1) : value.toFixed(0)} ${units === 'si' ? 'km' : 'mi'}`;
}

/** A stiffness for people. */
export function stiffnessShown(n_m: number, units: Units): string {
  return units === 'si' ? `${Number((n_m / 1000).toPrecision(3))} N/mm` : `${Number((n_m / POUND_PER_INCH_N_M).toPrecision(3))} lb/in`;
}

/** A mass for people. */
export function massShown(kg: number, units: Units): string {
  return units === 'si' ? `${Number(kg.toPrecision(3))} kg` : `${Math.round(kg / POUND_KG)} lb`;
}

/** A velocity (m/s) or a displacement (m) as a number in the unit that is shown. */
export const inLength = (metres: number, units: Units) => (units === 'si' ? metres : metres / INCH_M);

/** A share in percent with two digits; as in the program, halves go to the even digit. */
export function percent(share: number): string {
  const value = 100 * share;
  const factor = 10 ** Math.max(0, 1 - Math.floor(Math.log10(value || 1)));
  const rounded = Math.round(value * factor);
  const even = value * factor === rounded - 0.5 && rounded % 2 === 1 ? rounded - 1 : rounded;
  return String(Number((even / factor).toPrecision(2)));
}

/** Accelerations stay in g. */
export function gShown(g: number, digits = 2): string {
  if (g < 0.001) return g > 0 ? '< 0.001 g' : '0 g';
  return `${g >= 10 ** digits ? g.toFixed(0) : g.toPrecision(digits)} g`;
}

/** A force: in newtons, or in pounds. */
export const forceShown = (newtons: number, units: Units): string =>
  units === 'us' ? `${Math.round(newtons / 4.4482216152605)} lbf` : newtons >= 1000 ? `${Number((newtons / 1000).toPrecision(3))} kN` : `${Math.round(newtons)} N`;
