import { Refused, type Failure } from './api';

/** What went wrong, for people; null: a newer request has taken the place of this one. */
export function failureOf(error: unknown): Failure | null {
  if (error instanceof Refused) return error.status === 409 ? null : error.failure;
  return { kind: 'io', key: null, file: null, line: null, message: String(error), hint: '' };
}
