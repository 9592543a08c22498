/** What a reload of the page finds again: kept in this tab of the browser, for this run of the program alone. */
import { token } from './api';

/** What was kept under a name, if the program is still the one that it was kept for. */
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
    // A browser that keeps nothing: a reload begins anew.
  }
}
