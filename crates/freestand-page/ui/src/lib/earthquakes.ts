/** The earthquakes of an answer in words. */
import type { Earthquake } from './documents';
import { end, type History } from './history';
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
  return one.landing_acceleration_g === null ? lift(one, units) : gShown(one.landing_acceleration_g);
}

/** The place of an earthquake in a list; −1 if the list does not have it. */
export const placeOf = (all: Earthquake[], name: string) => all.findIndex((one) => one.name === name);

/** The title of the animation of an earthquake. */
export function titleOf(earthquakes: Earthquake[], name: string, history: History, units: Units): string {
  const at = placeOf(earthquakes, name);
  const values = {
    number: at + 1, all: earthquakes.length, time: end(history).toFixed(1), lift: lift(earthquakes[at], units),
  };
  if (history.outcome === 'no-uplift') return t('stage.rest', values);
  if (history.outcome === 'leaned') return t('stage.leans', values);
  return t(history.outcome === 'rocked' ? 'stage.stays' : 'stage.falls', values);
}
