/** Calls a function at most once in a time; of several calls in it, the last one counts. */
export function throttled(every: number, call: () => void): () => void {
  let waiting: ReturnType<typeof setTimeout> | null = null;
  let last = -Infinity;
  return () => {
    if (waiting !== null) return;
    const wait = Math.max(0, last + every - performance.now());
    waiting = setTimeout(() => {
      waiting = null;
      last = performance.now();
      call();
    }, wait);
  };
}
