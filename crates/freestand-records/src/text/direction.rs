//! Direction of a component.

/// The direction of positive motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Direction {
    /// Horizontal, this many degrees clockwise from north; from 0 to below 360.
    Azimuth(f64),
    /// Vertical, positive upwards.
    Up,
}

impl Direction {
    /// The direction that a record's header names: `N-S`, `EW`, `UP`, `360`, `90 DEG`, `N08W`,
    /// `S 74 E`, and the last letter of a SEED channel such as `HNE`. `None` for `H1`, `LONG` and
    /// other names without a direction, and for `WE` and `SN`, whose sign differs between agencies.
    ///
    /// # Example
    /// ```
    /// use freestand_records::formats::Direction;
    /// assert_eq!(Direction::parse("N08W"), Some(Direction::Azimuth(352.0)));
    /// assert_eq!(Direction::parse("360"), Some(Direction::Azimuth(0.0)));
    /// assert_eq!(Direction::parse("Up"), Some(Direction::Up));
    /// assert_eq!(Direction::parse("H1"), None);
    /// ```
    pub fn parse(text: &str) -> Option<Self> {
        let name: String = text
            .chars()
            .filter(|c| !c.is_whitespace() && *c != '-')
            .collect::<String>()
            .to_uppercase();
        let name = name
            .trim_end_matches(['°', '.'])
            .trim_end_matches("DEGREES")
            .trim_end_matches("DEG");
        match name {
            "N" | "NS" | "NORTH" | "NORTHSOUTH" => return Some(Self::Azimuth(0.0)),
            "E" | "EW" | "EAST" | "EASTWEST" => return Some(Self::Azimuth(90.0)),
            "S" | "SOUTH" => return Some(Self::Azimuth(180.0)),
            "W" | "WEST" => return Some(Self::Azimuth(270.0)),
            "UP" | "U" | "UD" | "Z" | "V" | "VERT" | "VERTICAL" | "UPDOWN" => {
                return Some(Self::Up);
            }
            _ => {}
        }
        if let Ok(degrees) = name.parse::<f64>() {
            return (0.0..=360.0)
                .contains(&degrees)
                .then_some(Self::Azimuth(degrees % 360.0));
        }
        if let [first @ (b'N' | b'S'), middle @ .., last @ (b'E' | b'W')] = name.as_bytes()
            && let Some(degrees) = std::str::from_utf8(middle)
                .ok()
                .and_then(|digits| digits.parse::<f64>().ok())
            && (0.0..=90.0).contains(&degrees)
        {
            let azimuth = match (first, last) {
                (b'N', b'E') => degrees,
                (b'S', b'E') => 180.0 - degrees,
                (b'S', _) => 180.0 + degrees,
                _ => 360.0 - degrees,
            };
            return Some(Self::Azimuth(azimuth % 360.0));
        }
        // Band, instrument, orientation: H or B or E or C, then L, N, G or H.
        match name.as_bytes() {
            [
                b'B' | b'C' | b'E' | b'H' | b'S',
                b'L' | b'N' | b'G' | b'H',
                axis,
            ] => match axis {
                b'N' => Some(Self::Azimuth(0.0)),
                b'E' => Some(Self::Azimuth(90.0)),
                b'Z' => Some(Self::Up),
                _ => None,
            },
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_as_headers_write_them() {
        for (text, azimuth) in [
            ("N-S", 0.0),
            ("e-w", 90.0),
            (" 90 DEG", 90.0),
            ("000", 0.0),
            ("360 Deg", 0.0),
            ("S16W", 196.0),
            ("S74E", 106.0),
            ("N 08 W", 352.0),
            ("N00E", 0.0),
            ("HNN", 0.0),
            ("BNE", 90.0),
            ("W", 270.0),
        ] {
            assert_eq!(
                Direction::parse(text),
                Some(Direction::Azimuth(azimuth)),
                "{text}"
            );
        }
        for text in ["UP", "u-d", "Vertical", "HNZ", "Z"] {
            assert_eq!(Direction::parse(text), Some(Direction::Up), "{text}");
        }
        for text in [
            "H1", "H2", "WE", "SN", "LONG", "TRAN", "", "N95E", "361", "-5E", "NaN", "inf", "DOWN",
        ] {
            assert_eq!(Direction::parse(text), None, "{text}");
        }
    }
}
