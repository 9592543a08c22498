//! Writes motions as text that this program and others can read.

use freestand::G0_M_S2;
use freestand::motion::Motion;
use std::fmt::Write;

use freestand_input::words::push_shortest;

/// freestand's own CSV: `time_s,accel_m_s2`, LF, shortest numbers that read back to the same bits.
///
/// # Example
/// ```
/// let motion = freestand::motion::Motion::new(0.5, vec![0.0, -2.5])?;
/// assert_eq!(freestand_records::formats::write_csv(&motion), "time_s,accel_m_s2\n0,0\n0.5,-2.5\n");
/// # Ok::<(), freestand::motion::MotionError>(())
/// ```
pub fn write_csv(motion: &Motion) -> String {
    csv(
        "time_s,accel_m_s2",
        motion.dt_s(),
        motion.accel_m_s2().iter().map(|a| [*a]),
    )
}

/// Rows of times and samples.
fn csv<const N: usize>(
    heading: &str,
    dt_s: f64,
    rows: impl ExactSizeIterator<Item = [f64; N]>,
) -> String {
    let mut out = String::with_capacity(16 * (N + 1) * (rows.len() + 1));
    out.push_str(heading);
    for (i, samples) in rows.enumerate() {
        out.push('\n');
        push_shortest(&mut out, i as f64 * dt_s);
        for sample in samples {
            out.push(',');
            push_shortest(&mut out, sample);
        }
    }
    out.push('\n');
    out
}

/// Two components of one length and step: `time_s,along_m_s2,across_m_s2`, numbers as in
/// [`write_csv`].
///
/// # Example
/// ```
/// use freestand::motion::Motion;
/// let (along, across) = (Motion::new(0.5, vec![0.0, -2.5])?, Motion::new(0.5, vec![1.0, 0.0])?);
/// let text = freestand_records::formats::write_pair_csv(&along, &across);
/// assert_eq!(text, "time_s,along_m_s2,across_m_s2\n0,0,1\n0.5,-2.5,0\n");
/// # Ok::<(), freestand::motion::MotionError>(())
/// ```
pub fn write_pair_csv(along: &Motion, across: &Motion) -> String {
    let rows = along.accel_m_s2().iter().zip(across.accel_m_s2());
    csv(
        "time_s,along_m_s2,across_m_s2",
        along.dt_s(),
        rows.map(|(a, b)| [*a, *b]),
    )
}

/// PEER AT2 in g: four header lines, five values a line.
///
/// # Limitation
/// AT2 prints 8 significant digits: a value read back differs by up to 5·10⁻⁸ of itself. Use CSV to
/// keep every bit.
pub fn write_at2(motion: &Motion, title: &str) -> String {
    // The title is one line of ASCII: Fortran readers count lines and bytes.
    let title: String = title
        .chars()
        .map(|c| if matches!(c, ' '..='~') { c } else { ' ' })
        .take(200)
        .collect();
    let accel_m_s2 = motion.accel_m_s2();
    let mut out = String::with_capacity(17 * accel_m_s2.len() + 512);
    out.push_str("PEER STRONG MOTION FORMAT AT2, WRITTEN BY FREESTAND\n");
    out.push_str(title.trim());
    out.push_str("\nACCELERATION TIME SERIES IN UNITS OF G\n");
    let _ = write!(out, "NPTS= {:6}, DT= ", accel_m_s2.len());
    push_shortest(&mut out, motion.dt_s());
    out.push_str(" SEC\n");
    for row in accel_m_s2.chunks(5) {
        for accel in row {
            push_e15_7(&mut out, accel / G0_M_S2);
        }
        out.push('\n');
    }
    out
}

/// Width 16 leaves a blank before `-1.2345678E-101` too.
fn push_e15_7(out: &mut String, value: f64) {
    let text = format!("{value:.7e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let (sign, digits) = exponent
        .strip_prefix('-')
        .map_or(('+', exponent), |digits| ('-', digits));
    let _ = write!(out, "{:>16}", format!("{mantissa}E{sign}{digits:0>2}"));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at2_looks_as_peer_writes_it() {
        let motion = Motion::new(
            0.005,
            vec![
                0.0,
                G0_M_S2,
                -0.5 * G0_M_S2,
                1e-110 * G0_M_S2,
                -1e-9 * G0_M_S2,
                1.0,
            ],
        )
        .unwrap();
        let text = write_at2(&motion, "A, 1/1/2000,\nB, 90\u{e9}");
        let expected = "PEER STRONG MOTION FORMAT AT2, WRITTEN BY FREESTAND\nA, 1/1/2000, B, 90\n\
            ACCELERATION TIME SERIES IN UNITS OF G\nNPTS=      6, DT= 0.005 SEC\n   \
            0.0000000E+00   1.0000000E+00  -5.0000000E-01  1.0000000E-110  -1.0000000E-09\n   1.0197162E-01\n";
        assert_eq!(text, expected);
    }
}
