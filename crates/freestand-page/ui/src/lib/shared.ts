/** What one tab hands to another. */
export interface Shared {
  /** What is under one edge, as the program reads it. */
  pad: string | null;
  /** An uploaded record that is the motion of the floor. */
  motion: { id: string; name: string } | null;
}
