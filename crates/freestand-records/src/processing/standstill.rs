//! Whether a floor stands still after its shaking.

use crate::notes::{Note, NoteKind};
use freestand::measures::cumulative_trapezoid;
use freestand::motion::Motion;
use freestand_input::words::number;

/// A warning if the floor never moves, or ends at a constant velocity: an offset within the shaking was integrated, and objects land on
/// a floor that moves on for ever.
///
/// # Example
/// ```
/// use freestand::motion::Motion;
/// use freestand_records::processing::standstill_note;
/// let pulse = [vec![0.0], vec![2.0; 100], vec![0.0; 200]].concat();
/// assert!(standstill_note(&Motion::new(0.01, pulse)?).is_some());
/// let stopped = [vec![0.0], vec![2.0; 100], vec![-2.0; 100], vec![0.0; 200]].concat();
/// assert_eq!(standstill_note(&Motion::new(0.01, stopped)?), None);
/// assert!(standstill_note(&Motion::new(0.01, vec![0.0; 9])?).is_some());
/// # Ok::<(), freestand::motion::MotionError>(())
/// ```
pub fn standstill_note(motion: &Motion) -> Option<Note> {
    /// Of the record, counted from its end.
    const TAIL: f64 = 0.1;
    /// Of its peak velocity: integration and rounding leave less.
    const SHARE: f64 = 0.1;
    /// How far the velocity of the tail may be from its mean, as a share of that: otherwise the floor still shakes.
    const STEADY: f64 = 0.1;
    /// Slower than any shaking that matters \[m/s\].
    const LEAST_M_S: f64 = 0.01;
    let velocity = cumulative_trapezoid(motion.dt_s(), motion.accel_m_s2());
    let count = velocity.len();
    let tail = velocity.get(count - (TAIL * count as f64).ceil() as usize..)?;
    let mean_m_s = tail.iter().sum::<f64>() / tail.len() as f64;
    let peak_m_s = velocity.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
    if motion.peak_m_s2() == 0.0 {
        return Some(Note::new(
            NoteKind::Still,
            "all values are zero: the floor does not move",
        ));
    }
    let is_steady = tail
        .iter()
        .all(|v| (v - mean_m_s).abs() <= STEADY * mean_m_s.abs());
    (is_steady && tail.len() > 1 && mean_m_s.abs() > LEAST_M_S.max(SHARE * peak_m_s)).then(|| {
        let words = format!(
            "the floor does not stop: at the end it moves at {} m/s, {} % of its largest velocity; correct an offset of \
             the record with `baseline`, for example `baseline = \"graizer\"`",
            number(mean_m_s, 3),
            number(100.0 * (mean_m_s / peak_m_s).abs(), 2)
        );
        Note::new(NoteKind::MovesOn, words).amount(mean_m_s, "m/s")
    })
}
