/** The earthquakes of an answer in words. */
import type { Earthquake } from './documents';
import { end, liftShown, type History } from './history';
import { gShown, lengthShown, type Units } from './units';
import { t } from './words';

/** Whether the object ends on the floor or at a wall. */
export const hasFallen = (one: Earthquake) => one.outcome === 'overturned' || one.outcome === 'leaned';

/** An edge that has lifted has not lifted by 0 mm, even if its uplift rounds to that. */
const LEAST_M = 1e-9;
const lift = (one: Earthquake | undefined, units: Units) => lengthShown(Math.max(one?.uplift_m ?? 0, LEAST_M), units);

/** What an earthquake does to the object, for its button. */
export function effect(one: Earthquake, units: Units): string {
  if (one.outcome === 'overturned') return t('motion.falls');
  if (one.outcome === 'leaned') return t('motion.leaned');
  if (one.outcome === 'no-uplift') return t('motion.still');
  if (one.outcome === 'unresolved') return t('motion.unresolved');
  return one.landing_acceleration_g === null ? lift(one, units) : gShown(one.landing_acceleration_g);
}

/** From the gentlest to the hardest, by what its button says: the hardest landing, or the uplift where no landing is known; a fall is the hardest of all. */
export function gentlestFirst(all: Earthquake[]): Earthquake[] {
  const strength = (one: Earthquake) => (one.landing_acceleration_g ?? (one.outcome === 'no-uplift' ? -1 : (one.uplift_m ?? 0)));
  return [...all].sort((a, b) => Number(hasFallen(a)) - Number(hasFallen(b)) || strength(a) - strength(b));
}

/** The place of an earthquake in a list; −1 if the list does not have it. */
export const placeOf = (all: Earthquake[], name: string) => all.findIndex((one) => one.name === name);

/** The title of the animation of an earthquake. */
export function titleOf(earthquakes: Earthquake[], name: string, history: History, units: Units): string {
  const sorted = gentlestFirst(earthquakes);
  const at = placeOf(sorted, name);
  const values = {
    number: at + 1, all: earthquakes.length, time: end(history).toFixed(1), lift: lift(sorted[at], units),
  };
  // What the film shows counts: on pads an edge may leave the floor by less than the model calls an uplift.
  if (history.outcome === 'no-uplift' && history.impacts.length > 0) return t('stage.stays', { ...values, lift: lengthShown(Math.max(liftShown(history), LEAST_M), units) });
  if (history.outcome === 'no-uplift') return t('stage.rest', values);
  if (history.outcome === 'unresolved') return t('stage.unresolved', values);
  if (history.outcome === 'shifted') return t('stage.shifted', values);
  if (history.outcome === 'leaned') return t('stage.leans', values);
  return t(history.outcome === 'rocked' ? 'stage.stays' : 'stage.falls', values);
}
