/** What one tab hands to another. */
export interface Shared {
  /** Stiffness of what is under one edge [N/m]. */
  pad: number | null;
  /** An uploaded record that is the motion of the floor. */
  motion: { id: string; name: string } | null;
}
