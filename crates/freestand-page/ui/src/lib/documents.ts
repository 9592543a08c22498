/**
 * What the page reads of the program's documents. The program lists the facts of a document when it writes it, so there is no
 * schema to generate these types from; `browser/documents.mjs` holds them against its answers.
 */
import type { History } from './history';
import type { SpectrumColumns } from './spectra';

/** A simulated earthquake of `freestand object`. */
export interface Earthquake { name: string; outcome: string; uplift_m: number | null; landing_acceleration_g: number | null }

/** `freestand object` with a history. */
export interface ObjectDocument {
  answer: string;
  answer_kind: string;
  model: string | null;
  motions: number;
  motions_lifted: number;
  motions_overturned: number;
  p_overturn: number | null;
  p_overturn_low: number | null;
  p_overturn_high: number | null;
  confidence: number | null;
  lift_acceleration_g: number;
  level_ratio: number | null;
  uplift_m_max: number | null;
  landing_acceleration_g_max: number | null;
  floor_acceleration_g: { median: number | null; max: number | null };
  assumptions: string[];
  warnings: string[];
  /** Whether nobody has said where the object stands. */
  place_is_assumed: boolean;
  building_is_assumed: boolean;
  /** Present only for an object that rocks in a plane. */
  earthquakes?: Earthquake[];
  followed?: string;
  history?: History;
}

/** `freestand spectrum` by columns. */
export interface SpectrumDocument { rows: SpectrumColumns; warnings: string[] }

/** `freestand spectrum` of one object with its history. */
export interface FollowedDocument { followed: string; history: History }

/** A file that was not read. */
export interface RefusedFile { path: string; reason: string; hint?: string }

/** A motion of `freestand motion info`. */
export interface Measures {
  name: string;
  dt_s: number;
  duration_s: number;
  pga_g: number;
  pga_time_s: number;
  pgv_m_s: number;
  pgd_m: number;
  arias_m_s: number;
  cav_m_s: number;
  d5_95_s: number;
  mean_period_s: number;
  predominant_period_s: number;
}

export interface InfoDocument { motions: Measures[]; failed: RefusedFile[]; warnings: string[] }

/** `freestand motion convert --to csv`, with velocities and displacements for the charts. */
export interface ConvertDocument {
  motions: { text: string; processing: string[] }[];
  traces: { velocity_m_s: number[]; displacement_m: number[] }[];
}

/** A place as the program knows it. */
export interface PlaceFound {
  name: string;
  region: string | null;
  country: string;
  code: string;
  confidence: string;
  latitude_deg: number | null;
  longitude_deg: number | null;
  distance_km: number | null;
}

/** `freestand place show` and `freestand place list`. */
export interface PlaceDocument { places: PlaceFound[]; warnings: string[] }

/** `freestand motion code-spectrum`: what a place or a file of hazard means. */
export interface TargetDocument { place: PlaceFound | null; facts: { name: string; value: string }[]; warnings: string[] }

/** `freestand motion spectrum`. */
export interface ResponseDocument { periods_s: number[]; sa_g: number[] }

/** One drop of `freestand cushion drop`. */
export interface DropTest {
  path: string;
  drop: number;
  peak_acceleration_g: number | null;
  restitution_ratio: number | null;
  stiffness_n_m: Record<string, number | null> | null;
  stiffness_ci95_n_m: [number, number] | null;
  quality: { residual_ratio: number | null; flags: string[] } | null;
  reason: string | null;
}

/** `freestand cushion drop` with its loops. */
export interface DropDocument {
  tests: DropTest[];
  pooled: {
    stiffness_n_m: number | null;
    ci95_n_m: [number, number] | null;
    exponent: number | null;
    count: number;
    law: string;
    restitution_ratio: number | null;
    reason: string | null;
  };
  failed: RefusedFile[];
  warnings: string[];
  loops: { compression_m: number[]; force_n: number[] }[];
}
