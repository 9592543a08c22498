import type { Ask } from './api';

export interface Place { name: string; region: string | null; country: string; code: string; confidence: string }
export interface Picture { id: string; height_m: number; thickness_m: number }
/** What an object withstands, from the tolerance library. */
export interface Withstands { class: string; state: string; peak_g: number | null; confidence: string }
export interface Facts {
  withstands: Withstands[];
  /** Names of the columns that a list may have. */
  columns: string[];
  /** An inventory to fill in, as CSV. */
  template: string;
  version: string;
  places: Place[];
  sites: Record<string, string[]>;
  pictures: Picture[];
  examples: Ask[];
  limits: { file_bytes: number };
}
