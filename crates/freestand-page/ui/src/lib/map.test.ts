import { expect, it } from 'vitest';
import { objectAt, placeOf, ramp, ticks } from './map';

it('finds the object at a point', () => {
  const place = placeOf(600, 400);
  const cells = { heights: [1, 2, 3], thicknesses: [0.1, 0.2] };
  expect(objectAt(place, cells, place.left + 1, place.top + place.height - 1)).toEqual([0, 0]);
  expect(objectAt(place, cells, place.left + place.width - 1, place.top + 1)).toEqual([2, 1]);
  expect([objectAt(place, cells, -99, 9999), objectAt(place, cells, 9999, -99)]).toEqual([[0, 0], [2, 1]]);
});

it('writes round values at the axes', () => {
  expect(ticks(0.3, 3, 6)).toEqual([0.5, 1, 1.5, 2, 2.5, 3]);
  expect(ticks(100, 1000, 9)).toEqual([100, 200, 300, 400, 500, 600, 700, 800, 900, 1000]);
});

it('has a ramp whose lightness is monotonic', () => {
  const light = (colour: string) => [1, 3, 5].reduce((all, at, i) => all + [0.2126, 0.7152, 0.0722][i]! * Number.parseInt(colour.slice(at, at + 2), 16), 0);
  const steps = ramp(false).map(light);
  expect(steps).toEqual([...steps].sort((a, b) => b - a));
  expect(ramp(true)).toEqual(ramp(false).reverse());
});
