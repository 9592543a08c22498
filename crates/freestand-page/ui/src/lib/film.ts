/** A body in three dimensions on its floor. It is loaded only where one is shown: three.js is larger than the page. */
import {
  BufferAttribute, BufferGeometry, CircleGeometry, Color, DirectionalLight, DoubleSide, GridHelper, Group, HemisphereLight, Mesh,
  MeshBasicMaterial, MeshLambertMaterial, PerspectiveCamera, Scene, Vector3, WebGLRenderer,
} from 'three';
import { coarser, noPose, poseAt, reach, type Surface } from './body';
import { along, floorMoves, valueAt, type History, type Space } from './history';
import type { Look } from './scene';

const G0_M_S2 = 9.80665;
const ANGLE_DEG = 28;
/** Highest and lowest view [rad]: from a little above the floor to straight from above. */
const [LOW, HIGH] = [0.03, 1.5];

/** So many triangles move smoothly where the processor draws: large surfaces take it longer than a frame. */
const MOST_IN_MOTION = 3000;

const TIP = new Vector3();

export interface Film {
  canvas: HTMLCanvasElement;
  /** Where the tip of the arrow to the weakest side was drawn last [CSS px]. */
  tip: { x: number; y: number; isSeen: boolean };
  show: (history: History, surface: Surface, colours: Look) => void;
  size: (width: number, height: number) => void;
  /** Turns the view [rad]. */
  turn: (around: number, up: number) => void;
  /** Draws the body at a time; in motion with fewer triangles, where the processor draws. */
  draw: (time: number, isMoving: boolean) => void;
  end: () => void;
}

/** An arrow along +x on the floor, of length 1. */
function arrow(): BufferGeometry {
  const flat = [0, -0.025, 0.8, -0.025, 0.8, 0.025, 0, 0.025, 0.8, -0.075, 1, 0, 0.8, 0.075];
  const places = Float32Array.from({ length: 21 }, (_, i) => (i % 3 === 2 ? 0 : flat[2 * Math.floor(i / 3) + (i % 3)]!));
  return new BufferGeometry().setAttribute('position', new BufferAttribute(places, 3)).setIndex([0, 1, 2, 0, 2, 3, 4, 5, 6]);
}

function geometryOf({ places, corners }: Surface): BufferGeometry {
  return new BufferGeometry().setAttribute('position', new BufferAttribute(places, 3)).setIndex(new BufferAttribute(corners, 1));
}

/** What draws in place of a graphics card: browsers tell it by its name alone. */
const PROCESSORS = /swiftshader|llvmpipe|softpipe|software|basic render/i;

function hasCard(): boolean {
  const context = document.createElement('canvas').getContext('webgl2');
  const names = context?.getExtension('WEBGL_debug_renderer_info');
  const name = context?.getParameter(names?.UNMASKED_RENDERER_WEBGL ?? context.RENDERER) as string | undefined;
  context?.getExtension('WEBGL_lose_context')?.loseContext();
  return !PROCESSORS.test(name ?? '');
}

/** A film to be shown; null where the browser draws nothing in three dimensions. */
export function begin(): Film | null {
  let renderer: WebGLRenderer;
  const isFast = hasCard();
  try {
    // Smooth edges take the processor longer than all the rest.
    renderer = new WebGLRenderer({ antialias: isFast });
  } catch {
    return null;
  }
  renderer.setPixelRatio(Math.min(devicePixelRatio || 1, 2));
  const scene = new Scene();
  const camera = new PerspectiveCamera(ANGLE_DEG, 1, 0.01, 100);
  camera.up.set(0, 0, 1);
  const light = new DirectionalLight('#ffffff', 1.9);
  scene.add(new HemisphereLight('#ffffff', '#888888', 1.7), light);
  // Floor and body move together.
  const world = new Group();
  const body = new Group();
  const skin = new MeshLambertMaterial({ flatShading: true, side: DoubleSide });
  const mesh = new Mesh(new BufferGeometry(), skin);
  mesh.frustumCulled = false;
  body.add(mesh);
  const ground = new Mesh(new CircleGeometry(1, 64), new MeshBasicMaterial());
  let grid = new GridHelper(2, 10);
  const weakest = new Mesh(arrow(), new MeshBasicMaterial({ side: DoubleSide }));
  const pushed = new Mesh(arrow(), new MeshBasicMaterial({ side: DoubleSide }));
  world.add(body, ground, grid, weakest, pushed);
  scene.add(world);

  const pose = noPose();
  // From where the arrow to the weakest side points to the right and a little to the front.
  let [around, up, wide, high, size] = [-Math.PI / 3, 0.32, 1, 1, 1];
  let [history, space]: [History | null, Space | null] = [null, null];
  let moves: [number[], number[]] = [[], []];
  let length = 1;
  let drawn: Surface | null = null;
  let whole: BufferGeometry = mesh.geometry;
  /** What moves. */
  let moving: BufferGeometry = mesh.geometry;
  const film: Film = {
    canvas: renderer.domElement,
    tip: { x: 0, y: 0, isSeen: false },
    show(one, surface, colours) {
      [history, space] = [one, one.space ?? null];
      if (!space) return;
      const accel = [one.base_accel_m_s2, space.base_accel_y_m_s2] as const;
      moves = accel.map((base_accel_m_s2) => floorMoves({ base_time_s: one.base_time_s, base_accel_m_s2 })) as [number[], number[]];
      if (drawn !== surface) {
        whole.dispose();
        moving.dispose();
        [drawn, whole, size] = [surface, geometryOf(surface), reach(surface)];
        moving = isFast ? whole : geometryOf(coarser(surface, MOST_IN_MOTION));
      }
      mesh.scale.set(...space.scale_ratio);
      mesh.position.set(...space.shift_m);
      skin.color.set(colours.obj).lerp(new Color(colours.mu), 0.5);
      (ground.material as MeshBasicMaterial).color.set(colours.pa).lerp(new Color(colours.ln), 0.6);
      (weakest.material as MeshBasicMaterial).color.set(colours.re);
      (pushed.material as MeshBasicMaterial).color.set(colours.ac);
      world.remove(grid);
      grid.dispose();
      grid = new GridHelper(3.6 * size, 18, colours.ed, colours.ed);
      grid.rotateX(Math.PI / 2);
      world.add(grid);
      renderer.setClearColor(colours.pa);
      ground.scale.setScalar(2.6 * size);
      ground.position.z = -0.004 * size;
      grid.position.z = -0.002 * size;
      length = Math.max(0.9 * size, one.base_width_m);
      weakest.visible = space.weakest_rad !== null;
      weakest.scale.setScalar(length);
      weakest.rotation.z = space.weakest_rad ?? 0;
      weakest.position.z = 0.002 * size;
      pushed.position.z = 0.004 * size;
    },
    size(width, height) {
      if (width === wide && height === high) return;
      [wide, high] = [width, height];
      renderer.setSize(wide, high);
      camera.aspect = wide / high;
    },
    turn(by, upward) {
      around += by;
      up = Math.max(LOW, Math.min(HIGH, up + upward));
    },
    draw(time, isMoving) {
      if (!history || !space) return;
      mesh.geometry = isMoving ? moving : whole;
      poseAt(history, space, time, pose);
      body.position.set(...pose.place);
      body.quaternion.set(pose.turn[1], pose.turn[2], pose.turn[3], pose.turn[0]);
      const place = along(history.base_time_s, time);
      const room = 0.35 * size;
      world.position.x = Math.max(-room, Math.min(room, valueAt(moves[0], place)));
      world.position.y = Math.max(-room, Math.min(room, valueAt(moves[1], place)));
      const [x, y] = [valueAt(history.base_accel_m_s2, place), valueAt(space.base_accel_y_m_s2, place)];
      const strength = Math.hypot(x, y) / G0_M_S2;
      pushed.visible = strength > 0.01 && time <= (history.base_time_s.at(-1) ?? 0);
      pushed.scale.setScalar(Math.min(1.6, 1.2 * strength) * size);
      pushed.rotation.z = Math.atan2(y, x);
      const middle = 0.9 * history.cg_height_m;
      // As far as a ball about the body fits, in the narrower direction of the picture.
      const half = Math.atan(Math.tan((ANGLE_DEG * Math.PI) / 360) * Math.min(1, camera.aspect));
      const far = (1.3 * size) / Math.sin(half);
      camera.near = 0.05 * far;
      camera.far = 4 * far;
      const from = (space.weakest_rad ?? 0) + around;
      camera.position.set(far * Math.cos(up) * Math.cos(from), far * Math.cos(up) * Math.sin(from), middle + far * Math.sin(up));
      camera.lookAt(0, 0, middle);
      camera.updateProjectionMatrix();
      light.position.set(Math.cos(from + 0.9), Math.sin(from + 0.9), 1.4);
      renderer.render(scene, camera);
      TIP.set(length * Math.cos(space.weakest_rad ?? 0), length * Math.sin(space.weakest_rad ?? 0), 0).add(world.position).project(camera);
      film.tip.x = (0.5 + 0.5 * TIP.x) * wide;
      film.tip.y = (0.5 - 0.5 * TIP.y) * high;
      film.tip.isSeen = weakest.visible && Math.abs(TIP.x) < 0.95 && Math.abs(TIP.y) < 0.95;
    },
    end() {
      whole.dispose();
      moving.dispose();
      renderer.dispose();
      renderer.forceContextLoss();
    },
  };
  return film;
}
