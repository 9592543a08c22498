import type { Ask } from './api';

export interface Place { name: string; region: string | null; country: string; code: string; confidence: string }
export interface Picture { id: string; height_m: number; thickness_m: number }
export interface Facts {
  version: string;
  places: Place[];
  sites: Record<string, string[]>;
  pictures: Picture[];
  examples: Ask[];
}
