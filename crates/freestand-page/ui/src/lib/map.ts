/** The map of objects on a canvas. */
import { STEPS, stepOf, type Field } from './spectra';
import { prepared, type Look } from './scene';
import { axisLength, type Units } from './units';
import { t } from './words';

/** One blue, from light to dark: monotonic in lightness. On a dark page the small values are the dark ones. */
const RAMP = ['#e8f1f8', '#c3dcee', '#92c1e0', '#5a9fcc', '#2f7bb0', '#155a8a', '#0b3a5e'] as const;

const [LEFT, RIGHT, TOP, BELOW] = [56, 10, 10, 42];
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

/** Indices of rows or columns whose values are written at an axis: about `count` of them. */
export function ticks(values: number[], count: number): number[] {
  const every = Math.max(1, Math.round((values.length - 1) / count));
  return values.map((_, i) => i).filter((i) => i % every === 0);
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
  context.textAlign = 'right';
  for (const row of ticks(cells.heights, 6)) context.fillText(axisLength(cells.heights[row]!, units), place.left - 7, Y(row + 0.5) + 4);
  context.textAlign = 'center';
  for (const column of ticks(cells.thicknesses, w < 420 ? 4 : 7)) {
    context.fillText(axisLength(cells.thicknesses[column]!, units), X(column + 0.5), place.top + place.height + 17);
  }
  context.fillText(t('spectra.axes'), place.left + place.width / 2, h - 6);
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
