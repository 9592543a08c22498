/** Values that survive a reload: kept in this browser tab, for this run of the program only. */
import { token } from './api';

/** The value that was kept under a name, if the same run of the program still answers. */
export function kept<T>(name: string): T | null {
  try {
    const found = JSON.parse(sessionStorage.getItem(name) ?? 'null') as { token: string; value: T } | null;
    // Another run of the program has other files under the same ids.
    return found && found.token === token() ? found.value : null;
  } catch {
    return null;
  }
}

export function keep(name: string, value: unknown): void {
  try {
    sessionStorage.setItem(name, JSON.stringify({ token: token(), value }));
  } catch {
    // The browser keeps nothing, so a reload starts from the beginning.
  }
}
