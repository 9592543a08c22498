/** Draws the object on its floor, and its rotation against time. */

import { noPose, poseAt, reach, silhouette, type Surface } from './body';
import { at, degrees, end, floor, tilt, type History, type Impact } from './history';
import type { Units } from './units';
import { t } from './words';

const FONT = 'system-ui, sans-serif';
/** How long a flash is seen [s of the watcher]. */
const FLASH_S = 0.35;
/** Rotations below this are drawn larger [rad]: 1.2°. */
const SMALL_RAD = 0.02;
const G0_M_S2 = 9.80665;
/** Steps between marks of height, in the unit of lengths; the first above MARK_PX is used. */
const MARKS = [0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 1000] as const;
const MARK_PX = 80;

export interface Look { ink: string; mu: string; ln: string; ac: string; re: string; obj: string; fl: string; pa: string; reb: string; ed: string }

export function look(): Look {
  const style = getComputedStyle(document.documentElement);
  const of = (name: string) => style.getPropertyValue(`--${name}`).trim();
  return { ink: of('ink'), mu: of('mu'), ln: of('ln'), ac: of('ac'), re: of('re'), obj: of('obj'), fl: of('fl'), pa: of('pa'), reb: of('reb'), ed: of('ed') };
}

/** The canvas in CSS pixels, sharp on every screen. */
export function prepared(canvas: HTMLCanvasElement, height: number): [CanvasRenderingContext2D, number, number] | null {
  const ratio = devicePixelRatio || 1;
  const width = canvas.clientWidth;
  const context = canvas.getContext('2d');
  if (!context || width === 0) return null;
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) {
    canvas.width = w;
    canvas.height = h;
    canvas.style.height = `${height}px`;
  }
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return [context, width, height];
}

/** How many times as large small rotations are drawn. */
export function enlarged(history: History): number {
  if (history.space) return 1;
  const most = history.theta_rad.reduce((all, theta) => Math.max(all, Math.abs(theta)), 0);
  return most > 0 && most < SMALL_RAD ? 5 : 1;
}

/** Shapes whose outline is not a box; the box is what is calculated. */
const VASE = [[0.36, 0], [0.64, 0], [0.62, 0.1], [0.66, 0.2], [1, 0.48], [0.92, 0.66], [0.66, 0.88], [0.7, 0.93], [1, 1], [0, 1], [0.3, 0.93], [0.34, 0.88], [0.08, 0.66], [0, 0.48], [0.34, 0.2], [0.38, 0.1]] as const;
/** From here down a vase is its foot: it ends at the edges about which it turns. */
const FOOT = 0.9;
const BOTTLE = [[0.4, 0], [0.6, 0], [0.6, 0.08], [0.92, 0.16], [1, 0.22], [1, 1], [0, 1], [0, 0.22], [0.08, 0.16], [0.4, 0.08]] as const;
const STATUE = [[0.42, 0], [0.58, 0], [0.62, 0.08], [0.56, 0.13], [0.76, 0.22], [0.8, 0.7], [1, 0.7], [1, 1], [0, 1], [0, 0.7], [0.2, 0.7], [0.24, 0.22], [0.44, 0.13], [0.38, 0.08]] as const;
const OUTLINES: Record<string, readonly (readonly [number, number])[]> = { vase: VASE, 'gas-bottle': BOTTLE, statue: STATUE };

/** The outline of an object in its box. */
function outline(context: CanvasRenderingContext2D, shape: string | undefined, w: number, h: number) {
  const points = shape === undefined ? undefined : OUTLINES[shape];
  context.beginPath();
  if (!points) {
    context.roundRect(0, 0, w, h, 3);
    return;
  }
  const [first] = points;
  context.moveTo(first![0] * w, first![1] * h);
  points.forEach(([x, y], i) => {
    if (shape !== 'vase' || y > FOOT) return context.lineTo(x * w, y * h);
    const [nx, ny] = points[(i + 1) % points.length]!;
    context.quadraticCurveTo(x * w, y * h, ((x + nx) / 2) * w, ((y + ny) / 2) * h);
  });
  context.closePath();
}

/** What is on the front of a box: shelves and handles. */
function front(context: CanvasRenderingContext2D, w: number, h: number) {
  context.lineWidth = 1;
  context.globalAlpha = 0.6;
  for (const part of [0.3, 0.55, 0.78]) {
    context.beginPath();
    context.moveTo(5, h * part);
    context.lineTo(w - 5, h * part);
    context.stroke();
  }
  context.globalAlpha = 1;
  context.lineWidth = 2;
  for (const part of [0.15, 0.42, 0.66, 0.88]) {
    context.beginPath();
    context.moveTo(w * 0.38, h * part);
    context.lineTo(w * 0.62, h * part);
    context.stroke();
  }
}

/** Height of the pads under an object, as they are drawn [px]. */
const PAD_PX = 7;

function body(context: CanvasRenderingContext2D, history: History, scale: number, x: number, y: number, theta: number, colours: Look, isGhost: boolean, shape?: string) {
  const [w, h, base] = [history.thickness_m * scale, history.height_m * scale, history.base_width_m * scale];
  context.save();
  // It turns about the edge that carries it: the right one where θ > 0.
  const edge = theta >= 0 ? base / 2 : -base / 2;
  context.translate(x + edge, y);
  context.rotate(theta);
  if (history.base === 'compliant' && !isGhost) {
    context.fillStyle = colours.mu;
    const wide = Math.max(6, Math.min(18, base * 0.22));
    for (const at of [-edge - base / 2, -edge + base / 2 - wide]) context.fillRect(at, -PAD_PX, wide, PAD_PX);
  }
  if (history.base === 'compliant') context.translate(0, -PAD_PX);
  context.translate(-edge - w / 2, -h);
  if (isGhost) {
    context.setLineDash([4, 4]);
    context.strokeStyle = colours.mu;
    context.globalAlpha = 0.55;
    outline(context, shape, w, h);
    context.stroke();
  } else {
    context.fillStyle = colours.obj;
    context.strokeStyle = colours.ink;
    context.lineWidth = 2;
    outline(context, shape, w, h);
    context.fill();
    context.stroke();
    if (shape === undefined || !(shape in OUTLINES)) front(context, w, h);
    context.fillStyle = colours.ac;
    context.beginPath();
    context.arc(w / 2, h - history.cg_height_m * scale, 4, 0, 7);
    context.fill();
  }
  context.restore();
}

/** The object at a time; `shown` are the impacts that may flash at this speed. */
export function stage(canvas: HTMLCanvasElement, history: History, time: number, shown: Impact[], speed: number, units: Units, colours: Look, isSmall = false, shape?: string, moves: number[] = []) {
  const wide = canvas.clientWidth;
  const ready = prepared(canvas, isSmall ? 150 : Math.min(330, wide * 0.56 + 50));
  if (!ready) return;
  const [context, w, h] = ready;
  const diagonal = Math.hypot(history.height_m, history.thickness_m);
  const scale = Math.min((w - 16) / (2 * diagonal + history.base_width_m), (h - 50) / ((isSmall ? 1.02 : 1.13) * diagonal));
  // The floor carries the object along; it is drawn where the picture has room for it.
  const room = Math.max(0, w / 2 - (0.5 * history.base_width_m + 1.02 * diagonal) * scale);
  const shift = Math.max(-room, Math.min(room, (moves.length > 0 ? at(history.base_time_s, moves, time) : 0) * scale));
  const [x, y] = [w / 2 + shift, h - 40];
  const theta = tilt(history, time) * enlarged(history);
  const minus = (text: string) => text.replace('-', '−');
  if (!isSmall) {
    context.strokeStyle = colours.ln;
    context.fillStyle = colours.mu;
    context.font = `12px ${FONT}`;
    context.lineWidth = 1;
    const [unit, name] = units === 'si' ? [1, 'm'] : [0.3048, 'ft'];
    const step = MARKS.find((one) => one * unit * scale >= MARK_PX) ?? MARKS[MARKS.length - 1]!;
    for (let mark = 0; mark * unit * scale < y - 6; mark += step) {
      const line = y - mark * unit * scale;
      context.beginPath();
      context.moveTo(0, line);
      context.lineTo(w, line);
      context.stroke();
      if (mark > 0 && line > 14) context.fillText(`${Number(mark.toPrecision(6))} ${name}`, 8, line - 4);
    }
    if (theta !== 0) {
      const side = Math.sign(theta);
      const edge = x + (side * history.base_width_m * scale) / 2;
      context.setLineDash([2, 4]);
      context.strokeStyle = colours.mu;
      context.beginPath();
      context.moveTo(edge, y);
      context.lineTo(edge, y - 1.12 * diagonal * scale);
      context.stroke();
      context.setLineDash([]);
      context.textAlign = side > 0 ? 'left' : 'right';
      // Above the body, wherever it turns.
      context.fillText(t('stage.balance'), edge + side * 6, y - 1.08 * diagonal * scale);
      context.textAlign = 'left';
    }
  }
  context.fillStyle = colours.fl;
  for (const [wall, side] of [[history.wall_left, -1], [history.wall_right, 1]] as const) {
    if (!wall) continue;
    const face = x + side * (history.thickness_m / 2 + wall.gap_m) * scale;
    const tall = wall.height_m === null ? y : wall.height_m * scale;
    context.fillRect(side > 0 ? face : face - 10, y - tall, 10, tall);
  }
  context.fillRect(0, y, w, isSmall ? 4 : 10);
  if (!isSmall) {
    // Marks on the floor show that it moves.
    context.fillStyle = colours.ed;
    for (let mark = ((shift % 40) + 40) % 40; mark < w; mark += 40) context.fillRect(mark, y, 2, 10);
  }
  if (Math.abs(theta) > 0.004) body(context, history, scale, x, y, 0, colours, true, shape);
  body(context, history, scale, x, y, theta, colours, false, shape);
  if (isSmall) return;
  const g = floor(history, time) / G0_M_S2;
  const arrow = Math.max(-0.45 * w, Math.min(0.45 * w, g * 180));
  context.strokeStyle = colours.ac;
  context.fillStyle = colours.ac;
  context.lineWidth = 3;
  if (Math.abs(arrow) > 3) {
    const head = Math.sign(arrow);
    context.beginPath();
    context.moveTo(x, y + 22);
    context.lineTo(x + arrow, y + 22);
    context.stroke();
    context.beginPath();
    context.moveTo(x + arrow + 6 * head, y + 22);
    context.lineTo(x + arrow - 2 * head, y + 17);
    context.lineTo(x + arrow - 2 * head, y + 27);
    context.fill();
  }
  context.font = `12px ${FONT}`;
  context.fillStyle = colours.mu;
  context.fillText(minus(t('stage.floor', { g: g.toFixed(2) })), 10, y + 26);
  context.textAlign = 'right';
  context.fillText(minus(t('stage.tilt', { deg: degrees(tilt(history, time)).toFixed(1) })), w - 10, y + 26);
  context.textAlign = 'left';
  const lasts = Math.max(0.1, FLASH_S) * speed;
  // Of several landings of an edge, the hardest is shown: their numbers would hide each other.
  const seen = shown.filter(({ time_s }) => time >= time_s && time - time_s < lasts);
  const hardest = (['left', 'right'] as const).flatMap((side) => {
    const own = seen.filter(({ edge }) => edge === side);
    return own.length > 0 ? [own.reduce((a, b) => ((b.edge_acceleration_g ?? 0) > (a.edge_acceleration_g ?? 0) ? b : a))] : [];
  });
  for (const { time_s, edge_acceleration_g, edge } of hardest) {
    const since = time - time_s;
    const left = 1 - since / lasts;
    const side = edge === 'right' ? 1 : -1;
    const corner = x + (side * history.base_width_m * scale) / 2;
    const strength = edge_acceleration_g ?? 0;
    const radius = 6 + Math.min(strength, 12) * 7 * (1.3 - left * 0.6);
    context.globalAlpha = left;
    context.strokeStyle = colours.re;
    context.fillStyle = colours.re;
    context.lineWidth = 3;
    for (let ray = 0; ray < 5; ray += 1) {
      const angle = (-Math.PI * (ray + 0.5)) / 5;
      context.beginPath();
      context.moveTo(corner + Math.cos(angle) * radius * 0.6, y + Math.sin(angle) * radius * 0.6);
      context.lineTo(corner + Math.cos(angle) * radius * 1.25, y + Math.sin(angle) * radius * 1.25);
      context.stroke();
    }
    context.font = `700 15px ${FONT}`;
    context.textAlign = side > 0 ? 'left' : 'right';
    context.fillText(`${strength.toFixed(1)} g`, corner + side * (radius * 1.3 + 6), y - 8);
    context.textAlign = 'left';
    context.globalAlpha = 1;
  }
}

/** A body at a time from the side, its weakest side to the right: where nothing is drawn in three dimensions. */
export function fromTheSide(canvas: HTMLCanvasElement, history: History, surface: Surface, time: number, colours: Look, isSmall = false) {
  const { space } = history;
  const ready = space && prepared(canvas, isSmall ? 150 : Math.min(330, canvas.clientWidth * 0.56 + 50));
  if (!ready) return;
  const [context, w, h] = ready;
  const size = reach(surface);
  const scale = Math.min((w - 16) / (3.2 * size), (h - 30) / (2.1 * size));
  const [x, y] = [w / 2, h - 20];
  context.fillStyle = colours.fl;
  context.fillRect(0, y, w, isSmall ? 4 : 10);
  const pose = noPose();
  // As it rests, and as it is.
  for (const [at, isGhost] of [[0, true], [time, false]] as const) {
    if (isGhost && tilt(history, time) < 0.004) continue;
    poseAt(history, space, at, pose);
    context.beginPath();
    for (const [along, up] of silhouette(surface, space, pose, space.weakest_rad ?? 0)) context.lineTo(x + along * scale, y - up * scale);
    context.closePath();
    context.setLineDash(isGhost ? [4, 4] : []);
    context.strokeStyle = isGhost ? colours.mu : colours.ink;
    context.fillStyle = colours.obj;
    context.lineWidth = isGhost ? 1 : 2;
    if (!isGhost) context.fill();
    context.stroke();
  }
}

/** The colours of a picture on paper, whatever those of the screen are. */
const PAPER: Look = { ink: '#000', mu: '#444', ln: '#ccc', ac: '#00558c', re: '#a84300', obj: '#eee', fl: '#bbb', pa: '#fff', reb: '#fff', ed: '#666' };
const PAPER_PX = 800;

/** The object at a time as a picture for a sheet of paper; null where the browser draws nothing. */
export function onPaper(history: History, time: number, units: Units, shape?: string, surface?: Surface | null): string | null {
  const canvas = document.createElement('canvas');
  Object.assign(canvas.style, { position: 'absolute', left: `${-2 * PAPER_PX}px`, width: `${PAPER_PX}px` });
  document.body.append(canvas);
  if (history.space && surface) fromTheSide(canvas, history, surface, time, PAPER);
  else if (!history.space) stage(canvas, history, time, [], 1, units, PAPER, false, shape);
  const url = canvas.width > 0 ? canvas.toDataURL('image/png') : null;
  canvas.remove();
  return url;
}

/** Rotation over the balance angle, the acceleration of the floor behind it, impacts as ticks. */
export function timeline(canvas: HTMLCanvasElement, history: History, time: number, colours: Look) {
  const ready = prepared(canvas, 104);
  if (!ready) return;
  const [context, w, h] = ready;
  const last = end(history) || 1;
  const middle = h * 0.44;
  const X = (at: number) => (at / last) * w;
  const Y = (theta: number) => middle - Math.max(-1.25, Math.min(1.25, theta / history.balance_rad)) * middle * 0.74;
  const most = history.base_accel_m_s2.reduce((all, one) => Math.max(all, Math.abs(one)), 0) || 1;
  context.globalAlpha = 0.45;
  context.strokeStyle = colours.mu;
  context.lineWidth = 1;
  context.beginPath();
  history.base_time_s.forEach((at, i) => {
    if (at > last) return;
    context.lineTo(X(at), middle - (history.base_accel_m_s2[i]! / most) * middle * 0.5);
  });
  context.stroke();
  context.globalAlpha = 1;
  context.setLineDash([4, 4]);
  for (const side of [1, -1]) {
    context.beginPath();
    context.moveTo(0, Y(side * history.balance_rad));
    context.lineTo(w, Y(side * history.balance_rad));
    context.stroke();
  }
  context.setLineDash([]);
  context.fillStyle = colours.mu;
  context.font = `11px ${FONT}`;
  context.fillText(t('timeline.balance'), 8, Y(history.balance_rad) + 13);
  context.strokeStyle = colours.ac;
  context.lineWidth = 2.2;
  context.beginPath();
  history.time_s.forEach((at, i) => context.lineTo(X(at), Y(history.theta_rad[i]!)));
  context.stroke();
  context.strokeStyle = colours.re;
  context.lineWidth = 2;
  for (const { time_s, edge_acceleration_g } of history.impacts) {
    const size = edge_acceleration_g === null ? 6 : Math.min(26, Math.max(2, edge_acceleration_g * 4.6));
    context.beginPath();
    context.moveTo(X(time_s), h - 2);
    context.lineTo(X(time_s), h - 2 - size);
    context.stroke();
  }
  context.strokeStyle = colours.ink;
  context.fillStyle = colours.ink;
  context.lineWidth = 1.5;
  context.beginPath();
  context.moveTo(X(time), 0);
  context.lineTo(X(time), h);
  context.stroke();
  context.beginPath();
  context.arc(X(time), 6, 5, 0, 7);
  context.fill();
}
