//! The records of one channel, joined in the order of time.

use super::record::{Record, Source, problem};
use super::steim::{self, Packing};
use crate::formats::instant::Instant;
use crate::motion_file::refuse_not_finite;
use crate::notes::{Note, NoteKind};
use freestand_input::problem::Problem;
use freestand_input::words::counted;

/// A channel without gaps.
pub(super) struct Series {
    pub(super) source: Source,
    pub(super) start: Instant,
    pub(super) end: Instant,
    pub(super) dt_s: f64,
    pub(super) values: Vec<f64>,
    /// What was concluded or left out.
    pub(super) notes: Vec<Note>,
}

/// How much the rates of one channel may differ: a measured rate varies by parts in a million.
const RATE_TOLERANCE: f64 = 1e-4;

/// The samples of one channel.
///
/// # Errors
/// Records that leave a gap or overlap by more than half a sample, that differ in rate, or that
/// cannot be decoded.
pub(super) fn join(
    source: Source,
    mut records: Vec<Record<'_>>,
) -> Result<Option<Series>, Problem> {
    let name = source.full_name();
    records.sort_by_key(|record| (record.start, record.number));
    let mut notes = Vec::from_iter(quality_note(&records, &name));
    let all = records.len();
    records.dedup_by(|later, first| {
        (later.start, later.samples, later.encoding) == (first.start, first.samples, first.encoding)
            && later.data == first.data
    });
    let Some(first) = records.first() else {
        return Ok(None);
    };
    if records.len() < all {
        let words = format!(
            "{} ignored",
            counted(all - records.len(), "repeated record")
        );
        notes.push(Note::of(&name, NoteKind::RowsIgnored, words));
    }
    let Some(dt_s) = first.dt_s else {
        return Err(problem(first.number, first.at, "has no sampling rate")
            .hint("use a file that states it: fetch the record again"));
    };
    check_steps(&records, dt_s, &name)?;
    notes.extend(drift_note(&records, dt_s, &name));
    let mut values = Vec::new();
    for record in &records {
        refuse_other_encodings(record)?;
        append(record, &mut values).map_err(|what| problem(record.number, record.at, &what))?;
    }
    refuse_not_finite(&values, &format!("{name}: "))?;
    if first.encoding.is_none() {
        let words =
            "no encoding is stated (blockette 1000); read as Steim-1, whose check samples match";
        notes.push(Note::of(&name, NoteKind::Encoding, words));
    }
    let end = records
        .last()
        .map_or(first.start, |last| end_of(last, dt_s));
    Ok(Some(Series {
        source,
        start: first.start,
        end,
        dt_s,
        values,
        notes,
    }))
}

/// The time of the sample that would follow the last one.
fn end_of(record: &Record<'_>, dt_s: f64) -> Instant {
    record.start.later_by_s(record.samples as f64 * dt_s)
}

/// Every record must begin where the one before ends, within half a sample, at the same rate.
fn check_steps(records: &[Record<'_>], dt_s: f64, name: &str) -> Result<(), Problem> {
    for (before, record) in records.iter().zip(records.iter().skip(1)) {
        if record
            .dt_s
            .is_none_or(|other_s| (other_s - dt_s).abs() > RATE_TOLERANCE * dt_s)
        {
            let rate = |step: Option<f64>| {
                step.map_or("no rate".to_owned(), |step| format!("{} Hz", 1.0 / step))
            };
            let what = format!(
                "has {}, but the records before it have {}",
                rate(record.dt_s),
                rate(Some(dt_s))
            );
            return Err(problem(record.number, record.at, &what)
                .hint("split the file where the rate changes"));
        }
        let expected = end_of(before, dt_s);
        let missing_s = record.start.seconds_since(expected);
        if missing_s.abs() <= 0.5 * dt_s {
            continue;
        }
        let samples = missing_s.abs() / dt_s;
        let (kind, hint) = if missing_s > 0.0 {
            (
                "a gap of",
                "a motion with gaps cannot be used: cut the file there, or fetch it again without the gap",
            )
        } else {
            (
                "an overlap of",
                "keep one of the records that overlap, or fetch the file again",
            )
        };
        let message = format!(
            "{name}: {kind} {:.6} s ({samples:.1} samples) before record {} (byte {}): {} follows {expected}",
            missing_s.abs(),
            record.number,
            record.at,
            record.start
        );
        return Err(Problem::format(message, hint));
    }
    Ok(())
}

/// A note if the clock and the rate disagree: each step may be off by half a sample, but not all in
/// the same direction.
fn drift_note(records: &[Record<'_>], dt_s: f64, name: &str) -> Option<Note> {
    let (first, last) = (records.first()?, records.last()?);
    let samples: usize = records
        .iter()
        .take(records.len() - 1)
        .map(|record| record.samples)
        .sum();
    let drift_s = last.start.seconds_since(first.start) - samples as f64 * dt_s;
    (drift_s.abs() > 0.5 * dt_s).then(|| {
        let words = format!(
            "the last record begins {:.6} s {} than the samples before it and the rate of {} Hz imply",
            drift_s.abs(),
            if drift_s > 0.0 { "later" } else { "earlier" },
            1.0 / dt_s
        );
        Note::of(name, NoteKind::Clock, words).amount(drift_s, "s")
    })
}

/// A note about flags that mark samples as faulty.
fn quality_note(records: &[Record<'_>], name: &str) -> Option<Note> {
    let flags = [
        "saturated amplifier",
        "clipped",
        "spikes",
        "glitches",
        "missing or padded data",
    ];
    let set = records.iter().fold(0, |set, record| set | record.quality);
    let found: Vec<&str> = (0..)
        .zip(flags)
        .filter(|(bit, _)| set >> bit & 1 != 0)
        .map(|(_, flag)| flag)
        .collect();
    let mut flagged = records.iter().filter(|record| record.quality & 0x1F != 0);
    let first = flagged.next()?;
    let words = format!(
        "{} flagged ({}), the first is record {}",
        counted(1 + flagged.count(), "record"),
        found.join(", "),
        first.number
    );
    Some(Note::of(name, NoteKind::Flagged, words))
}

fn refuse_other_encodings(record: &Record<'_>) -> Result<(), Problem> {
    match record.encoding {
        None | Some(1 | 3 | 4 | 5 | 10 | 11) => Ok(()),
        Some(code) => {
            let what = format!(
                "has the encoding {}, which cannot be read",
                encoding_name(code)
            );
            Err(problem(record.number, record.at, &what)
                .hint("convert the file to Steim-2 or to 32-bit integers"))
        }
    }
}

/// Appends the samples of a record.
fn append(record: &Record<'_>, out: &mut Vec<f64>) -> Result<(), String> {
    let (data, order, samples) = (record.data, record.order, record.samples);
    let width = match record.encoding {
        Some(1) => 2,
        Some(3 | 4) => 4,
        Some(5) => 8,
        Some(11) => return steim::decode(data, order, Packing::Steim2, samples, out),
        Some(10) => return steim::decode(data, order, Packing::Steim1, samples, out),
        None => {
            return steim::decode(data, order, Packing::Steim1, samples, out).map_err(|what| {
                format!("states no encoding (blockette 1000); read as Steim-1, it {what}")
            });
        }
        Some(_) => return Err("has an encoding that cannot be read".to_owned()),
    };
    if data.len() / width < samples {
        return Err(format!(
            "declares {samples} samples, but has room for {}",
            data.len() / width
        ));
    }
    let value = |at: usize| match record.encoding {
        Some(1) => order.i16(data, at).map(f64::from),
        Some(3) => order.i32(data, at).map(f64::from),
        Some(4) => order.f32(data, at).map(f64::from),
        _ => order.f64(data, at),
    };
    out.extend((0..samples).filter_map(|i| value(i * width)));
    Ok(())
}

/// Names of encodings that cannot be read (SEED 2.4 manual, blockette 1000).
fn encoding_name(code: u8) -> String {
    let name = match code {
        2 => "24-bit integers",
        12 => "GEOSCOPE, 24 bits",
        13 => "GEOSCOPE, 16 bits with 3 bits of gain",
        14 => "GEOSCOPE, 16 bits with 4 bits of gain",
        15 => "US National Network",
        16 => "CDSN, 16 bits with gain",
        17 => "Graefenberg, 16 bits with gain",
        18 => "IPG Strasbourg, 16 bits with gain",
        19 => "Steim-3",
        30 => "SRO",
        31 => "HGLP",
        32 => "DWWSSN, with gain",
        33 => "RSTN, 16 bits with gain",
        100 => "opaque data",
        _ => return format!("{code}"),
    };
    format!("{code} ({name})")
}
