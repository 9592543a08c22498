//! Numbers in binary files.

/// Which byte of a number comes first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Order {
    Little,
    Big,
}

impl Order {
    /// `N` bytes from `at`, if the file has them; the most significant one first.
    fn bytes<const N: usize>(self, data: &[u8], at: usize) -> Option<[u8; N]> {
        let mut bytes: [u8; N] = data.get(at..at.checked_add(N)?)?.try_into().ok()?;
        if self == Self::Little {
            bytes.reverse();
        }
        Some(bytes)
    }

    pub(super) fn u16(self, data: &[u8], at: usize) -> Option<u16> {
        self.bytes(data, at).map(u16::from_be_bytes)
    }

    pub(super) fn u32(self, data: &[u8], at: usize) -> Option<u32> {
        self.bytes(data, at).map(u32::from_be_bytes)
    }

    pub(super) fn i16(self, data: &[u8], at: usize) -> Option<i16> {
        self.u16(data, at).map(u16::cast_signed)
    }

    pub(super) fn i32(self, data: &[u8], at: usize) -> Option<i32> {
        self.u32(data, at).map(u32::cast_signed)
    }

    pub(super) fn f32(self, data: &[u8], at: usize) -> Option<f32> {
        self.u32(data, at).map(f32::from_bits)
    }

    pub(super) fn f64(self, data: &[u8], at: usize) -> Option<f64> {
        self.bytes(data, at).map(f64::from_be_bytes)
    }
}

/// The decimal that a single-precision header field stands for: 0.02 is stored as 0.0199999995529…,
/// and the shortest decimal that has the same single-precision value is 0.02.
pub(super) fn as_written(value: f32) -> f64 {
    value
        .to_string()
        .parse()
        .unwrap_or_else(|_| f64::from(value))
}

/// The letters and digits of a header field that is padded with blanks or zero bytes.
pub(super) fn field(data: &[u8], from: usize, to: usize) -> String {
    let bytes = data.get(from..to).unwrap_or_default();
    let end = bytes.iter().position(|&b| b == 0).unwrap_or(bytes.len());
    let text: String = bytes[..end]
        .iter()
        .map(|&b| char::from(b))
        .filter(|c| !c.is_control())
        .collect();
    text.trim().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_either_order_and_none_beyond_the_end() {
        let data = [1, 2, 3, 4];
        assert_eq!(
            (Order::Big.u16(&data, 0), Order::Little.u16(&data, 0)),
            (Some(0x0102), Some(0x0201))
        );
        assert_eq!(
            (Order::Big.i32(&data, 0), Order::Little.i32(&data, 0)),
            (Some(0x0102_0304), Some(0x0403_0201))
        );
        assert_eq!(
            (
                Order::Big.u16(&data, 3),
                Order::Big.u16(&data, usize::MAX),
                Order::Big.f64(&data, 0)
            ),
            (None, None, None)
        );
    }

    #[test]
    fn single_precision_means_the_shortest_decimal() {
        for (value, decimal) in [
            (0.02f32, 0.02),
            (0.005, 0.005),
            (0.1, 0.1),
            (99.999_9, 99.999_9),
            (1e-7, 1e-7),
            (4.0, 4.0),
        ] {
            assert_eq!(as_written(value), decimal);
        }
    }

    #[test]
    fn fields_end_at_the_padding() {
        assert_eq!(field(b"xxAB \0Cyy", 2, 7), "AB");
        assert_eq!(field(b"xx", 5, 7), "");
    }
}
