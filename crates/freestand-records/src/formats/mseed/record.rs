//! The headers of miniSEED 2 and 3: channel, start, sampling rate, and the place of the samples.

use crate::formats::binary::{Order, as_written, field};
use crate::formats::instant::Instant;
use crate::text::lines::joined;
use freestand_input::problem::Problem;

/// The channel that recorded.
#[derive(Debug, Clone, Default, PartialEq, Eq, Hash)]
pub(in crate::formats) struct Source {
    pub(in crate::formats) network: String,
    pub(in crate::formats) station: String,
    pub(in crate::formats) location: String,
    pub(in crate::formats) channel: String,
}

/// A record with samples.
#[derive(Debug, Clone)]
pub(super) struct Record<'a> {
    /// In the file, from 1.
    pub(super) number: usize,
    /// Where it begins in the file.
    pub(super) at: usize,
    pub(super) start: Instant,
    /// Time step \[s\]; `None` where the header has no rate.
    pub(super) dt_s: Option<f64>,
    pub(super) samples: usize,
    /// Code of the encoding; `None` where blockette 1000 is missing.
    pub(super) encoding: Option<u8>,
    pub(super) order: Order,
    /// Data quality flags of version 2.
    pub(super) quality: u8,
    pub(super) data: &'a [u8],
}

/// A record and its channel.
type Found<'a> = (Source, Record<'a>);

/// A problem with a record.
pub(super) fn problem(number: usize, at: usize, what: &str) -> Problem {
    // The caller may give a better hint.
    Problem::format(
        format!("record {number} (byte {at}) {what}"),
        "the file is damaged or cut off: fetch it again",
    )
}

const HEADER: usize = 48;
/// Powers of two of the lengths of records: 128 to 65536 bytes.
const LENGTHS: std::ops::RangeInclusive<u8> = 7..=16;

/// The byte order of a version 2 header: only in the right order are year and day possible. `None`
/// if this is not such a header.
pub(super) fn header_order(bytes: &[u8]) -> Option<Order> {
    let head = bytes.get(..HEADER)?;
    let is_number = |b: &u8| b.is_ascii_digit() || matches!(b, b' ' | 0);
    let has_form = head[..6].iter().all(is_number)
        && matches!(head[6], b'D' | b'R' | b'Q' | b'M')
        && matches!(head[7], b' ' | 0)
        && head[24] <= 23
        && head[25] <= 59
        && head[26] <= 60;
    let is_date = |order: &Order| {
        order
            .u16(head, 20)
            .is_some_and(|year| (1900..=2100).contains(&year))
            && order
                .u16(head, 22)
                .is_some_and(|day| (1..=366).contains(&day))
    };
    has_form
        .then(|| [Order::Big, Order::Little].into_iter().find(is_date))
        .flatten()
}

/// The blockettes that are used.
#[derive(Default)]
struct Blockettes {
    /// Blockette 1000: encoding, order of the samples, power of two of the length.
    data_only: Option<(u8, Order, u8)>,
    /// Blockette 1001: microseconds to add to the start.
    microseconds: i8,
    /// Blockette 100: the measured rate \[Hz\].
    rate_hz: Option<f32>,
}

/// Reads a version 2 record at `at`, and tells how long it is. Records without samples are `None`.
pub(super) fn version2(
    bytes: &[u8],
    at: usize,
    number: usize,
    order: Order,
) -> Result<(Option<Found<'_>>, usize), Problem> {
    let wrong = |what: &str| problem(number, at, what);
    let rest = bytes.get(at..).unwrap_or_default();
    let cut = || wrong("is cut off");
    let u16_at = |from: usize| order.u16(rest, from).ok_or_else(cut);
    let samples = usize::from(u16_at(30)?);
    let data_at = usize::from(u16_at(44)?);
    let blockettes =
        blockettes(rest, order).ok_or_else(|| wrong("has a broken chain of blockettes"))?;
    let length = match blockettes.data_only {
        Some((_, _, power)) if LENGTHS.contains(&power) => 1usize << power,
        Some((_, _, power)) => return Err(wrong(&format!("states a length of 2^{power} bytes"))),
        None => found_length(rest).ok_or_else(|| {
            wrong("does not state its length (blockette 1000), and no record follows it")
        })?,
    };
    let record = rest.get(..length).ok_or_else(cut)?;
    // A record of 0 samples reports the state of the instrument; or its number is damaged.
    let has_data = record
        .get(data_at..)
        .is_some_and(|data| data_at >= HEADER && data.iter().any(|byte| *byte != 0));
    let is_text = blockettes
        .data_only
        .is_some_and(|(encoding, ..)| encoding == 0);
    if samples == 0 && (is_text || !has_data) {
        return Ok((None, length));
    }
    let data = record
        .get(data_at..)
        .filter(|_| data_at >= HEADER)
        .ok_or_else(|| {
            wrong(&format!(
                "has {samples} samples, but puts them at byte {data_at} of {length}"
            ))
        })?;
    let start = start_time(record, order, blockettes.microseconds).ok_or_else(cut)?;
    let factor = order.i16(record, 32).ok_or_else(cut)?;
    let multiplier = order.i16(record, 34).ok_or_else(cut)?;
    let measured = blockettes
        .rate_hz
        .filter(|rate| *rate > 0.0 && rate.is_finite());
    let (encoding, data_order) = blockettes
        .data_only
        .map_or((None, order), |(code, order, _)| (Some(code), order));
    let source = Source {
        station: field(record, 8, 13),
        location: field(record, 13, 15),
        channel: field(record, 15, 18),
        network: field(record, 18, 20),
    };
    let record = Record {
        number,
        at,
        start,
        dt_s: measured
            .map(|rate| 1.0 / as_written(rate))
            .or_else(|| nominal_step(factor, multiplier)),
        samples,
        encoding,
        order: data_order,
        quality: record[38],
        data,
    };
    Ok((Some((source, record)), length))
}

/// Follows the chain, which must lead forwards.
fn blockettes(record: &[u8], order: Order) -> Option<Blockettes> {
    let mut found = Blockettes::default();
    let mut at = usize::from(order.u16(record, 46)?);
    while at != 0 {
        let (kind, next) = (
            order.u16(record, at)?,
            usize::from(order.u16(record, at + 2)?),
        );
        match kind {
            100 => found.rate_hz = Some(order.f32(record, at + 4)?),
            1000 => {
                let data_order = if *record.get(at + 5)? == 0 {
                    Order::Little
                } else {
                    Order::Big
                };
                found.data_only = Some((*record.get(at + 4)?, data_order, *record.get(at + 6)?));
            }
            1001 => found.microseconds = record.get(at + 5)?.cast_signed(),
            _ => {}
        }
        if next != 0 && next < at + 4 {
            return None;
        }
        at = next;
    }
    Some(found)
}

/// The length of a record that does not state it: the smallest with which another record, or the
/// end of the file, follows.
fn found_length(rest: &[u8]) -> Option<usize> {
    let ends = |length: &usize| {
        *length == rest.len()
            || rest
                .get(*length..)
                .is_some_and(|next| header_order(next).is_some())
    };
    LENGTHS.map(|power| 1usize << power).find(ends)
}

/// Start with microseconds and the correction of the clock, unless the flag says that it was
/// applied.
fn start_time(record: &[u8], order: Order, microseconds: i8) -> Option<Instant> {
    let time: [u8; 3] = record.get(24..27)?.try_into().ok()?;
    let is_applied = record.get(36)? & 2 != 0;
    let correction = if is_applied {
        0
    } else {
        i128::from(order.i32(record, 40)?)
    };
    let fraction = i128::from(order.u16(record, 28)?);
    let start = Instant::from_day(order.u16(record, 20)?, order.u16(record, 22)?, time, 0);
    Some(start.later_by_ns((fraction + correction) * 100_000 + i128::from(microseconds) * 1000))
}

/// Factor and multiplier: positive ones are samples per second, negative ones seconds per sample or
/// divisors. One division makes the step of 100 Hz the f64 nearest to 0.01.
fn nominal_step(factor: i16, multiplier: i16) -> Option<f64> {
    let (factor, multiplier) = (
        f64::from(factor),
        f64::from(if multiplier == 0 { 1 } else { multiplier }),
    );
    let step = match (factor > 0.0, multiplier > 0.0) {
        (true, true) => 1.0 / (factor * multiplier),
        (true, false) => -multiplier / factor,
        (false, true) => -factor / multiplier,
        (false, false) => factor * multiplier,
    };
    (step > 0.0 && step.is_finite()).then_some(step)
}

/// Whether a version 3 record begins here.
pub(super) fn is_version3(bytes: &[u8]) -> bool {
    bytes.starts_with(b"MS\x03")
        && bytes
            .get(12..15)
            .is_some_and(|time| time[0] <= 23 && time[1] <= 59 && time[2] <= 60)
}

/// Reads a version 3 record at `at`, and tells how long it is. Records without samples are `None`.
pub(super) fn version3(
    bytes: &[u8],
    at: usize,
    number: usize,
) -> Result<(Option<Found<'_>>, usize), Problem> {
    let wrong = |what: &str| problem(number, at, what);
    let rest = bytes.get(at..).unwrap_or_default();
    let cut = || wrong("is cut off");
    let u16_at = |from: usize| Order::Little.u16(rest, from).ok_or_else(cut);
    let u32_at = |from: usize| Order::Little.u32(rest, from).ok_or_else(cut);
    let (name_length, extra_length, data_length) = (
        usize::from(*rest.get(33).ok_or_else(cut)?),
        usize::from(u16_at(34)?),
        u32_at(36)? as usize,
    );
    let data_at = 40 + name_length + extra_length;
    let record = data_at
        .checked_add(data_length)
        .and_then(|length| rest.get(..length))
        .ok_or_else(cut)?;
    if crc32c(record) != u32_at(28)? {
        return Err(wrong("does not match its checksum (CRC-32C)"));
    }
    let samples = u32_at(24)? as usize;
    if samples == 0 {
        return Ok((None, record.len()));
    }
    let [hour, minute, second, encoding] = *record.get(12..16).ok_or_else(cut)? else {
        return Err(cut());
    };

    let nanosecond = u32_at(4)?;
    let rate = Order::Little.f64(record, 16).ok_or_else(cut)?;
    let step = if rate > 0.0 { 1.0 / rate } else { -rate };
    let found = Record {
        number,
        at,
        start: Instant::from_day(u16_at(8)?, u16_at(10)?, [hour, minute, second], nanosecond),
        dt_s: (step > 0.0 && step.is_finite()).then_some(step),
        samples,
        encoding: Some(encoding),
        // Everything is little-endian but Steim's frames.
        order: if matches!(encoding, 10 | 11) {
            Order::Big
        } else {
            Order::Little
        },
        quality: 0,
        data: &record[data_at..],
    };
    Ok((
        Some((source_of(&field(record, 40, 40 + name_length)), found)),
        record.len(),
    ))
}

/// `FDSN:NET_STA_LOC_B_S_SS`; any other identifier is used as the name of the channel.
fn source_of(identifier: &str) -> Source {
    let parts: Vec<&str> = identifier
        .strip_prefix("FDSN:")
        .map_or_else(Vec::new, |rest| rest.split('_').collect());
    let [network, station, location, band, source, position] = parts.as_slice() else {
        return Source {
            channel: identifier.to_owned(),
            ..Source::default()
        };
    };
    // The older three codes have one letter each; longer ones keep their separators.
    let is_short = [band, source, position]
        .iter()
        .all(|code| code.chars().count() <= 1);
    let separator = if is_short { "" } else { "_" };
    Source {
        network: (*network).to_owned(),
        station: (*station).to_owned(),
        location: (*location).to_owned(),
        channel: [*band, *source, *position].join(separator),
    }
}

/// CRC-32C (Castagnoli, RFC 3309) of a version 3 record, with its own field taken as zero.
pub(super) fn crc32c(record: &[u8]) -> u32 {
    !record
        .iter()
        .enumerate()
        .fold(u32::MAX, |crc, (at, &byte)| {
            let byte = if (28..32).contains(&at) { 0 } else { byte };
            crc >> 8 ^ CRC_OF_BYTE[usize::from(crc.to_le_bytes()[0] ^ byte)]
        })
}

/// The eight steps of the division for each byte.
const CRC_OF_BYTE: [u32; 256] = {
    let mut table = [0; 256];
    let mut byte = 0;
    while byte < 256 {
        let mut crc = byte as u32;
        let mut bit = 0;
        while bit < 8 {
            crc = crc >> 1 ^ 0x82F6_3B78 & (crc & 1).wrapping_neg();
            bit += 1;
        }
        table[byte] = crc;
        byte += 1;
    }
    table
};

impl Source {
    /// `NET.STA`, or the part of it that is stated.
    pub(in crate::formats) fn full_station(&self) -> Option<String> {
        joined(&[&self.network, &self.station], ".")
    }

    /// `NET.STA.LOC.CHA`.
    pub(in crate::formats) fn full_name(&self) -> String {
        if self.station.is_empty() && self.network.is_empty() {
            return self.channel.clone();
        }
        format!(
            "{}.{}.{}.{}",
            self.network, self.station, self.location, self.channel
        )
    }
}
