/** Lengths, masses and their texts in SI and US units. The program reads the same texts. */

export type Units = 'si' | 'us';

const INCH_M = 0.0254;
const FOOT_M = 0.3048;
const POUND_KG = 0.45359237;
export const POUND_PER_INCH_N_M = 175.12683524647636;

const LENGTHS: Record<string, number> = {
  m: 1, mm: 0.001, cm: 0.01, in: INCH_M, '"': INCH_M, '″': INCH_M, ft: FOOT_M, "'": FOOT_M, '′': FOOT_M,
};

/** A text with its decimal commas as points. Three digits behind a comma may also be thousands: the program refuses them. */
const pointed = (text: string) => text.trim().replace(/(\d),(\d{1,2}|\d{4,})(?!\d)/g, '$1.$2');

/** A length in metres; null for a text that only the program may understand. */
export function lengthM(text: string): number | null {
  const plain = pointed(text);
  const parts = [...plain.matchAll(/(\d+(?:\.\d+)?)\s*(mm|cm|m|in|ft|"|″|'|′)\s*/gy)];
  const read = parts.map((part) => part[0]).join('').trim();
  if (parts.length === 0 || parts.length > 2 || read !== plain) return null;
  const sum = parts.reduce((all, [, number, unit]) => all + Number(number) * LENGTHS[unit!]!, 0);
  return sum > 0 ? sum : null;
}

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

/** Above this, a bare number is in millimetres: nothing here is taller in metres. */
const TALLEST_M = 12;

/** A number without a unit. */
const bare = (text: string) => (/^\d+(?:\.\d+)?$/.test(text) ? Number(text) : null);

/**
 * A length as it was entered, with its unit, as a list would be read: 1,8 m is 1.8 m, 1800 is 1800 mm, 1.8 is 1.8 m, and
 * in US units a bare number is in inches. What is no length stays as it is: the program says what is wrong with it.
 */
export function lengthEntered(text: string, units: Units): string {
  const plain = pointed(text);
  const number = bare(plain);
  if (number === null) return plain;
  return `${plain} ${units === 'us' ? 'in' : number > TALLEST_M || number === 0 ? 'mm' : 'm'}`;
}

/** Another quantity as it was entered; a bare number is in the unit in which masses and stiffnesses are shown. */
export function enteredIn(text: string, unit: string): string {
  const plain = pointed(text);
  return unit && bare(plain) !== null ? `${plain} ${unit}` : plain;
}

/** What a field holds. */
export type Quantity = 'length' | 'mass' | 'stiffness' | 'other';

/**
 * A text that was typed in one system of units, in the other. Only what is shown changes: what is asked is the text as it was
 * typed, so that changing the units never changes the object.
 */
export function inUnits(text: string, quantity: Quantity, units: Units): string {
  if (quantity === 'length') {
    const metres = lengthM(text);
    return metres === null ? text : lengthText(metres, units);
  }
  if (quantity === 'mass') {
    const kg = massKg(text);
    return kg === null ? text : units === 'si' ? `${Number(kg.toPrecision(4))} kg` : `${Number((kg / POUND_KG).toPrecision(4))} lb`;
  }
  if (quantity === 'stiffness') {
    const n_m = stiffnessNM(text);
    return n_m === null ? text : units === 'si' ? `${Number((n_m / 1000).toPrecision(4))} N/mm` : `${Number((n_m / POUND_PER_INCH_N_M).toPrecision(4))} lb/in`;
  }
  return text;
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

/** A stiffness for people. */
export function stiffnessShown(n_m: number, units: Units): string {
  return units === 'si' ? `${Number((n_m / 1000).toPrecision(3))} N/mm` : `${Number((n_m / POUND_PER_INCH_N_M).toPrecision(3))} lb/in`;
}

/** A stiffness in N/m; null for a text that only the program may understand. */
export function stiffnessNM(text: string): number | null {
  const [, number, unit] = /^(\d+(?:\.\d+)?)\s*(N\/mm|kN\/m|N\/m|lb\/in|kip\/in)$/.exec(pointed(text)) ?? [];
  if (!number || !unit) return null;
  const factor = { 'N/mm': 1000, 'kN/m': 1000, 'N/m': 1, 'lb/in': POUND_PER_INCH_N_M, 'kip/in': 1000 * POUND_PER_INCH_N_M }[unit];
  const value = Number(number) * (factor ?? NaN);
  return value > 0 ? value : null;
}

/** A mass in kilograms; null for a text that only the program may understand. */
export function massKg(text: string): number | null {
  const [, number, unit] = /^(\d+(?:\.\d+)?)\s*(kg|t|g|lb)$/.exec(pointed(text)) ?? [];
  if (!number || !unit) return null;
  const value = Number(number) * ({ kg: 1, t: 1000, g: 0.001, lb: POUND_KG }[unit] ?? NaN);
  return value > 0 ? value : null;
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
