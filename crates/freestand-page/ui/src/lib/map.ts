/** The map of objects on a canvas. */
import { STEPS, stepOf, type Field } from './spectra';
import { prepared, type Look } from './scene';
import type { Units } from './units';
import { t } from './words';

/** One blue, from light to dark: monotonic in lightness. On a dark page the small values are the dark ones. */
const RAMP = ['#e8f1f8', '#c3dcee', '#92c1e0', '#5a9fcc', '#2f7bb0', '#155a8a', '#0b3a5e'] as const;

const [LEFT, RIGHT, TOP, BELOW] = [56, 18, 10, 42];
const FONT = 'system-ui, sans-serif';

/** The colours of the steps of the ramp. */
export function ramp(isDark: boolean): string[] {
  return isDark ? [...RAMP].reverse() : [...RAMP];
}

/** Where the map is on its canvas. */
export interface Place { left: number; top: number; width: number; height: number }

export function placeOf(width: number, height: number): Place {
  return { left: LEFT, top: TOP, width: width - LEFT - RIGHT, height: height - TOP - BELOW };
}

/** The row and the column of the object at a point of the canvas. */
export function objectAt(place: Place, cells: { heights: number[]; thicknesses: number[] }, x: number, y: number): [number, number] {
  const bounded = (index: number, count: number) => Math.max(0, Math.min(count - 1, index));
  const row = Math.floor((1 - (y - place.top) / place.height) * cells.heights.length);
  const column = Math.floor(((x - place.left) / place.width) * cells.thicknesses.length);
  return [bounded(row, cells.heights.length), bounded(column, cells.thicknesses.length)];
}

/** Round values within a range, about `count` of them: multiples of 1, 2 or 5 times a power of ten. */
export function ticks(first: number, last: number, count: number): number[] {
  const least = (last - first) / count;
  const power = 10 ** Math.floor(Math.log10(least));
  const step = [1, 2, 5, 10].map((one) => one * power).find((one) => one >= least * 0.999) ?? 10 * power;
  const from = Math.ceil(first / step - 1e-9);
  return Array.from({ length: Math.floor(last / step + 1e-9) - from + 1 }, (_, i) => Number(((from + i) * step).toPrecision(12)));
}

/** Draws the objects, the axes and a frame around the chosen one. */
export function drawMap(canvas: HTMLCanvasElement, cells: Field, values: Float64Array, width: number, chosen: [number, number], units: Units, colours: Look, isDark: boolean) {
  const tall = Math.max(300, Math.min(460, canvas.clientWidth * 0.78));
  const ready = prepared(canvas, tall);
  if (!ready) return;
  const [context, w, h] = ready;
  const place = placeOf(w, h);
  const steps = ramp(isDark);
  const [rows, columns] = [cells.heights.length, cells.thicknesses.length];
  const X = (column: number) => place.left + (column / columns) * place.width;
  const Y = (row: number) => place.top + place.height - (row / rows) * place.height;
  const hatch = new Path2D();
  for (let row = 0; row < rows; row += 1) {
    for (let column = 0; column < columns; column += 1) {
      const object = row * columns + column;
      const value = values[object]!;
      const [left, top] = [Math.floor(X(column)), Math.floor(Y(row + 1))];
      const [wide, high] = [Math.ceil(X(column + 1)) - left, Math.ceil(Y(row)) - top];
      const step = stepOf(value, width);
      context.fillStyle = Number.isNaN(value) ? colours.ln : value === Infinity ? colours.reb : step < 0 ? colours.pa : steps[step]!;
      context.fillRect(left, top, wide, high);
      if (2 * cells.fallen[object]! >= cells.motions.length) hatch.rect(left, top, wide, high);
    }
  }
  // One hatch over all of them: lines that go on from object to object.
  context.save();
  context.clip(hatch);
  context.strokeStyle = colours.re;
  context.globalAlpha = 0.6;
  context.lineWidth = 1;
  context.beginPath();
  for (let from = -place.height; from < place.width; from += 8) {
    context.moveTo(place.left + from, place.top + place.height);
    context.lineTo(place.left + from + place.height, place.top);
  }
  context.stroke();
  context.restore();
  context.strokeStyle = colours.mu;
  context.lineWidth = 1;
  context.strokeRect(place.left - 0.5, place.top - 0.5, place.width + 1, place.height + 1);
  context.fillStyle = colours.mu;
  context.font = `12px ${FONT}`;
  // The values of a grid are evenly spaced: an object is in the middle of its rectangle.
  const along = (values: number[], value: number) => ((value - values[0]!) / (values.at(-1)! - values[0]! || 1)) * (values.length - 1) + 0.5;
  const [tall_m, deep_m] = units === 'si' ? [1, 0.001] : [0.3048, 0.0254];
  context.textAlign = 'right';
  for (const mark of ticks(cells.heights[0]! / tall_m, cells.heights.at(-1)! / tall_m, 6)) {
    context.fillText(mark.toFixed(1), place.left - 7, Y(along(cells.heights, mark * tall_m)) + 4);
  }
  context.textAlign = 'center';
  for (const mark of ticks(cells.thicknesses[0]! / deep_m, cells.thicknesses.at(-1)! / deep_m, w < 420 ? 5 : 9)) {
    context.fillText(String(mark), X(along(cells.thicknesses, mark * deep_m)), place.top + place.height + 17);
  }
  context.fillText(t(`spectra.depth.${units}`), place.left + place.width / 2, h - 6);
  context.save();
  context.translate(12, place.top + place.height / 2);
  context.rotate(-Math.PI / 2);
  context.fillText(t(`spectra.height.${units}`), 0, 0);
  context.restore();
  context.textAlign = 'left';
  const [row, column] = chosen;
  context.strokeStyle = colours.pa;
  context.lineWidth = 4;
  context.strokeRect(X(column) - 3, Y(row + 1) - 3, X(column + 1) - X(column) + 6, Y(row) - Y(row + 1) + 6);
  context.strokeStyle = colours.ink;
  context.lineWidth = 2;
  context.strokeRect(X(column) - 3, Y(row + 1) - 3, X(column + 1) - X(column) + 6, Y(row) - Y(row + 1) + 6);
}

/** The number of steps of the ramp, for a legend. */
export const LEGEND = Array.from({ length: STEPS }, (_, step) => step);
