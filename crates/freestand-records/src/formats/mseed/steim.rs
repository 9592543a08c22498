//! Steim-1 and Steim-2: differences of 32-bit integers, packed into frames of 64 bytes (SEED 2.4
//! manual, appendix B).

use crate::formats::binary::Order;

const FRAME: usize = 64;

/// How differences are packed into a word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Packing {
    Steim1,
    Steim2,
}

/// Appends the samples of one record.
///
/// The first word of a frame holds sixteen codes of two bits, one for each word, which say how many
/// differences the word holds. Words 1 and 2 of the first frame are the first and the last sample;
/// the first difference refers to the record before and is not used. The last sample proves that
/// nothing was lost or misread.
///
/// # Errors
/// A code that is not defined, too few differences, a last sample other than the one stated.
pub(super) fn decode(
    data: &[u8],
    order: Order,
    packing: Packing,
    samples: usize,
    out: &mut Vec<f64>,
) -> Result<(), String> {
    let (Some(first), Some(last)) = (order.i32(data, 4), order.i32(data, 8)) else {
        return Err("has no room for a frame of Steim data".to_owned());
    };
    let mut value = first;
    let mut found = 0;
    for (number, frame) in data.chunks_exact(FRAME).enumerate() {
        let codes = order.u32(frame, 0).unwrap_or_default();
        for word in if number == 0 { 3 } else { 1 }..16 {
            let code = codes >> (30 - 2 * word) & 3;
            let Some(raw) = frame.get(4 * word..4 * word + 4) else {
                break;
            };
            let (differences, count) = unpack(raw, code, order, packing).ok_or_else(|| {
                format!(
                    "has an undefined code in word {word} of frame {}",
                    number + 1
                )
            })?;
            for difference in differences.into_iter().take(count.min(samples - found)) {
                // The first difference refers to the record before.
                value = if found == 0 {
                    first
                } else {
                    value.wrapping_add(difference)
                };
                out.push(f64::from(value));
                found += 1;
            }
        }
        if found == samples {
            break;
        }
    }
    if found < samples {
        return Err(format!("ends after {found} of {samples} samples"));
    }
    if value != last {
        return Err(format!(
            "ends with the sample {value}, but states {last} as its last sample"
        ));
    }
    Ok(())
}

/// The differences of one word and their number, or `None` for an undefined code.
fn unpack(raw: &[u8], code: u32, order: Order, packing: Packing) -> Option<([i32; 7], usize)> {
    let mut values = [0; 7];
    let word = order.u32(raw, 0)?;
    let count = match (code, packing) {
        (0, _) => 0,
        // Bytes, and in Steim-1 pairs of bytes, are in the order of time for both byte orders.
        (1, _) => {
            for (value, &byte) in values.iter_mut().zip(raw) {
                *value = i32::from(byte.cast_signed());
            }
            4
        }
        (2, Packing::Steim1) => {
            values[0] = i32::from(order.i16(raw, 0)?);
            values[1] = i32::from(order.i16(raw, 2)?);
            2
        }
        (3, Packing::Steim1) => {
            values[0] = word.cast_signed();
            1
        }
        _ => {
            let (count, bits) = match (code, word >> 30) {
                (2, 1) => (1, 30),
                (2, 2) => (2, 15),
                (2, 3) => (3, 10),
                (3, 0) => (5, 6),
                (3, 1) => (6, 5),
                (3, 2) => (7, 4),
                _ => return None,
            };
            for (i, value) in values.iter_mut().take(count).enumerate() {
                let below = bits * (count - 1 - i);
                // To the top of the word and back, which copies the sign.
                *value = (word >> below << (32 - bits)).cast_signed() >> (32 - bits);
            }
            count
        }
    };
    Some((values, count))
}
