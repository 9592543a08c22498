//! What is doubted about the values of a component, whatever format they come from.

use super::Component;
use crate::notes::{Note, NoteKind};
use freestand_input::words::number;

/// All doubts about the values of a component.
pub(crate) fn doubts(component: &Component) -> impl Iterator<Item = Note> {
    [extreme, offset, odd_step, clipped, ends_early, relative]
        .into_iter()
        .filter_map(|doubt| doubt(component))
}

/// A history of fewer values has no level, and may be a pulse.
const MIN_SAMPLES: usize = 50;

/// A note if a value is larger than any motion has.
///
/// The largest acceleration of the ground on record is 4.4 g (Iwate-Miyagi 2008, IWTH25). Floors
/// amplify the ground a few times, so 20 g is beyond both: a lost decimal point or a wrong unit is
/// more likely than a pyrotechnic shock.
fn extreme(component: &Component) -> Option<Note> {
    const HIGHEST_M_S2: f64 = 20.0 * freestand::G0_M_S2;
    let motion = &component.motion;
    // The offset of an instrument's own values may be anything; it is removed before they are used.
    let offset_m_s2 = if component.is_raw {
        motion.mean_m_s2()
    } else {
        0.0
    };
    let (at, peak_m_s2) = motion
        .accel_m_s2()
        .iter()
        .map(|a| (a - offset_m_s2).abs())
        .enumerate()
        .fold(
            (0, 0.0),
            |(at, peak), (i, a)| if a > peak { (i, a) } else { (at, peak) },
        );
    (peak_m_s2 > HIGHEST_M_S2).then(|| {
        let peak_g = peak_m_s2 / freestand::G0_M_S2;
        let words = format!(
            "value {} is {peak_g:.1} g, more than any ground or floor motion: check the unit ({}) and look for a \
             damaged digit or decimal point",
            at + 1,
            component.unit
        );
        Note::of(&component.name, NoteKind::Extreme, words).amount(peak_g, "g")
    })
}

/// A note if the time step is longer or shorter than that of any record of shaking: times in ms were read as s or s as ms,
/// or most samples are missing.
fn odd_step(component: &Component) -> Option<Note> {
    const LONGEST_S: f64 = 0.1;
    /// A step of 50 ms, which was read as 50 µs.
    const SHORTEST_S: f64 = 5e-5;
    let dt_s = component.motion.dt_s();
    let odd = if dt_s > LONGEST_S {
        "long"
    } else if dt_s < SHORTEST_S {
        "short"
    } else {
        return None;
    };
    let words = format!(
        "a time step of {} s is too {odd} for a record of an earthquake: check the unit of its times",
        number(dt_s, 4)
    );
    Some(Note::of(&component.name, NoteKind::OddStep, words).amount(dt_s, "s"))
}

/// A note if the values lie about another level than zero: an instrument that shows gravity, or an offset that was not
/// removed. A floor that accelerates by a constant is a slope for everything that stands on it.
///
/// Before and after an earthquake the values are near zero, so that their median is: half of them lie above and half
/// below. That of the corrected records of agencies is below 1 % of the peak.
fn offset(component: &Component) -> Option<Note> {
    /// Below this, an offset moves no object and decides nothing.
    const LEAST_M_S2: f64 = 0.01 * freestand::G0_M_S2;
    const SHARE: f64 = 0.1;
    let accel = component.motion.accel_m_s2();
    if component.is_raw || accel.len() < MIN_SAMPLES {
        return None;
    }
    let mut sorted = accel.to_vec();
    let (_, median, _) = sorted.select_nth_unstable_by(accel.len() / 2, f64::total_cmp);
    let offset_m_s2 = *median;
    let reach = accel
        .iter()
        .fold(0.0, |most: f64, a| most.max((a - offset_m_s2).abs()));
    (offset_m_s2.abs() > LEAST_M_S2 && offset_m_s2.abs() > SHARE * reach).then(|| {
        let offset_g = offset_m_s2 / freestand::G0_M_S2;
        let cause =
            if (offset_g.abs() - 1.0).abs() < 0.1 { "the sensor shows gravity" } else { "an offset is left in it" };
        let words = format!(
            "the values lie about {offset_g:.3} g, not about zero: {cause}, and objects react as on a slope that \
             never ends: remove it with `baseline = \"mean\"`"
        );
        Note::of(&component.name, NoteKind::Offset, words).amount(offset_g, "g")
    })
}

/// A note if the values stay at their largest or smallest one again and again: the instrument could not show more, and the
/// motion was stronger.
///
/// Values that are written with few digits also repeat at a rounded top. There they fall by at most 9 digits of the last
/// place as far beyond the repetition as it is long, since a parabola falls with the square of the distance from its top.
fn clipped(component: &Component) -> Option<Note> {
    /// Shorter repetitions and fewer of them happen in a pulse with a flat top.
    const MIN_REPEATED: usize = 3;
    const MIN_PLACES: usize = 3;
    /// Twice what rounding allows.
    const DIGITS: f64 = 20.0;
    let accel = component.motion.accel_m_s2();
    let peak_m_s2 = component.motion.peak_m_s2();
    let near_peak = |a: f64| a.abs() > 0.5 * peak_m_s2;
    let steps = accel
        .windows(2)
        .filter(|pair| pair.iter().all(|a| near_peak(*a)) && pair[0] * pair[1] > 0.0);
    let steps = steps
        .map(|pair| (pair[1] - pair[0]).abs())
        .filter(|step| *step > 0.0);
    // Where nothing but tops is near the peak, nothing is known of the digits.
    let last_place = steps.reduce(f64::min).unwrap_or(0.0);
    let [lowest, highest] =
        [f64::min, f64::max].map(|extreme| accel.iter().copied().fold(0.0, extreme));
    let mut start = 0_usize;
    let (mut places, mut samples) = (0, 0);
    for run in accel.chunk_by(|a, b| a == b) {
        let (count, level) = (run.len(), run[0]);
        let falls = |at: Option<usize>| {
            at.and_then(|at| accel.get(at))
                .is_some_and(|a| (level - a).abs() > DIGITS * last_place)
        };
        let is_extreme = near_peak(level) && (level == lowest || level == highest);
        if count >= MIN_REPEATED
            && is_extreme
            && falls(start.checked_sub(count))
            && falls(Some(start + 2 * count - 1))
        {
            (places, samples) = (places + 1, samples + count);
        }
        start += count;
    }
    (accel.len() >= MIN_SAMPLES && places >= MIN_PLACES).then(|| {
        let peak_g = peak_m_s2 / freestand::G0_M_S2;
        let words = format!(
            "the values stay at their largest one, {} g, in {places} places ({samples} samples): the instrument could not \
             show more, and the motion was stronger",
            number(peak_g, 3)
        );
        Note::of(&component.name, NoteKind::Clipped, words).amount(peak_g, "g")
    })
}

/// A note if a record ends while it shakes strongly: what came later is not known, and may have overturned an object.
///
/// A pulse that ends at its peak is a choice, and crosses zero a few times at most.
fn ends_early(component: &Component) -> Option<Note> {
    const MIN_CROSSINGS: usize = 10;
    /// Fewer samples, 3.5 s at 10 ms, are an excerpt and no record.
    const MIN_RECORD: usize = 350;
    /// The part of the record that is its end, and the share of the peak that is strong there: the root mean square of
    /// strong shaking is about a third of the peak.
    const END: f64 = 0.02;
    const STRONG: f64 = 0.2;
    let accel = component.motion.accel_m_s2();
    let peak_m_s2 = component.motion.peak_m_s2();
    let crossings = accel
        .windows(2)
        .filter(|pair| pair[0] * pair[1] < 0.0)
        .count();
    let count = ((END * accel.len() as f64) as usize).max(5);
    let end = accel.get(accel.len().checked_sub(count)?..)?;
    let rms_m_s2 = (end.iter().map(|a| a * a).sum::<f64>() / count as f64).sqrt();
    (!component.is_raw && accel.len() >= MIN_RECORD && crossings >= MIN_CROSSINGS && rms_m_s2 > STRONG * peak_m_s2).then(|| {
        let percent = 100.0 * rms_m_s2 / peak_m_s2;
        let words = format!(
            "the record ends in strong shaking (its last {} s have {percent:.0} % of the peak): what followed is not known, \
             and may have overturned an object",
            number(count as f64 * component.motion.dt_s(), 2)
        );
        Note::of(&component.name, NoteKind::EndsEarly, words).amount(percent, "% of the peak")
    })
}

/// A note if the name of a component says that it is relative to the ground.
fn relative(component: &Component) -> Option<Note> {
    component.name.to_lowercase().contains("relative").then(|| {
        let words = "its name says that the accelerations are relative to the ground: rocking needs absolute ones";
        Note::of(&component.name, NoteKind::Relative, words)
    })
}

#[cfg(test)]
mod tests {
    use crate::formats::{ReadOptions, parse_motions};
    use crate::notes::NoteKind;

    /// The kinds of the notes of a file with these values at a step of 10 ms.
    fn kinds(heading: &str, values: impl Iterator<Item = f64>, digits: usize) -> Vec<NoteKind> {
        let rows: String = values
            .enumerate()
            .map(|(i, a)| format!("{:.2},{a:.digits$}\n", 0.01 * i as f64))
            .collect();
        let text = format!("{heading}\n{rows}");
        let file =
            parse_motions(text.into_bytes(), "x.csv".as_ref(), &ReadOptions::default()).unwrap();
        file.notes.iter().map(|note| note.kind).collect()
    }

    /// A train of waves of 0.4 g that grows and dies away in 10 s.
    fn waves() -> impl Iterator<Item = f64> {
        (0..1000)
            .map(|i| f64::from(i) * 0.01)
            .map(|t| 0.4 * (0.6 * t).sin().max(0.0) * (9.0 * t).sin())
    }

    #[test]
    fn what_an_instrument_could_not_show_is_said() {
        let heading = "time [s],a [g]";
        assert_eq!(kinds(heading, waves(), 6), []);
        assert_eq!(
            kinds(heading, waves().map(|a| a.clamp(-0.2, 0.2)), 6),
            [NoteKind::Clipped]
        );
        assert_eq!(
            kinds(heading, waves().map(|a| a.min(0.3)), 6),
            [NoteKind::Clipped]
        );
        // So much that hardly more than the limit is left.
        assert_eq!(
            kinds(heading, waves().map(|a| (100.0 * a).clamp(-0.2, 0.2)), 6),
            [NoteKind::Clipped]
        );
        // A steady wave in three digits repeats its rounded top of 0.1 g.
        let steady = |scale: f64| (0..1000).map(move |i| scale * (0.02 * f64::from(i)).sin());
        assert!(!kinds(heading, steady(0.1), 3).contains(&NoteKind::Clipped));
        assert!(
            kinds(heading, steady(0.1).map(|a| a.clamp(-0.08, 0.08)), 3)
                .contains(&NoteKind::Clipped)
        );
    }

    #[test]
    fn a_record_that_is_cut_is_told_from_a_pulse() {
        let heading = "time [s],a [g]";
        assert_eq!(kinds(heading, waves().take(400), 6), [NoteKind::EndsEarly]);
        let pulse = (0..60).map(|i| 0.4 * (0.1 * f64::from(i)).cos());
        assert!(!kinds(heading, pulse, 6).contains(&NoteKind::EndsEarly));
    }

    #[test]
    fn what_a_heading_contradicts_is_said() {
        assert_eq!(kinds("time [ms],a [g]", waves(), 6), [NoteKind::OddStep]);
        assert_eq!(
            kinds("time [s],relative acceleration [g]", waves(), 6),
            [NoteKind::Relative]
        );
    }
}
