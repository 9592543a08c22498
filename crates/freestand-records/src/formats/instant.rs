//! Points in time: of the records of one file, and of the epochs in the description of a station.

use std::fmt;

use chrono::{DateTime, Datelike, NaiveDate, NaiveDateTime, NaiveTime};

const SECOND_NS: i128 = 1_000_000_000;

/// Nanoseconds since 1970-01-01 in UTC without leap seconds. After a leap second in a record, its
/// times are off by 1 s.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Instant(i128);

impl Instant {
    fn of(time: NaiveDateTime) -> Self {
        let time = time.and_utc();
        Self(i128::from(time.timestamp()) * SECOND_NS + i128::from(time.timestamp_subsec_nanos()))
    }

    /// From a year, its day from 1, a time of that day as hour, minute and second, and nanoseconds.
    pub(super) fn from_day<T: Into<u32>>(
        year: u16,
        day: u16,
        time: [T; 3],
        nanosecond: u32,
    ) -> Self {
        let [hour, minute, second] = time.map(Into::into);
        let second = 3600 * hour + 60 * minute + second;
        let first = NaiveDate::from_ymd_opt(i32::from(year.max(1)), 1, 1).unwrap_or_default();
        let seconds = (i128::from(day) - 1) * 86_400 + i128::from(second);
        Self::of(first.into()).later_by_ns(seconds * SECOND_NS + i128::from(nanosecond))
    }

    /// Seconds since 1970, rounded to a quarter of a microsecond for present-day dates.
    pub(super) fn seconds(self) -> f64 {
        self.seconds_since(Self(0))
    }

    pub(super) fn later_by_ns(self, ns: i128) -> Self {
        Self(self.0.saturating_add(ns))
    }

    pub(super) fn later_by_s(self, seconds: f64) -> Self {
        self.later_by_ns((seconds * 1e9).round() as i128)
    }

    /// Seconds from `earlier` to this instant.
    pub(super) fn seconds_since(self, earlier: Self) -> f64 {
        // Divided before it is added up: the difference of two records is small, but that of two
        // epochs is not.
        let ns = self.0 - earlier.0;
        (ns / SECOND_NS) as f64 + (ns % SECOND_NS) as f64 / 1e9
    }

    /// `2012-04-13T17:28:00`, with a fraction, with `Z` or an offset such as `+01:00`, or the date
    /// alone.
    pub(super) fn parse(text: &str) -> Option<Self> {
        let text = text.trim();
        let (date, time) = text.split_once(['T', ' ']).unwrap_or((text, "00:00:00"));
        let date = NaiveDate::parse_from_str(date, "%Y-%m-%d")
            .ok()
            .filter(|date| (1..=9999).contains(&date.year()))?;
        // XML allows the end of a day to be written as its hour 24; chrono does not.
        if let Some(zone) = time.strip_prefix("24:00:00") {
            let midnight = Self::parse(&format!("{date}T00:00:00{zone}"))?;
            return Some(midnight.later_by_ns(86_400 * SECOND_NS));
        }
        let with_zone =
            || DateTime::parse_from_str(&format!("{date}T{time}"), "%Y-%m-%dT%H:%M:%S%.f%#z").ok();
        let time = match NaiveTime::parse_from_str(time, "%H:%M:%S%.f") {
            Ok(time) => date.and_time(time),
            Err(_) => with_zone()?.naive_utc(),
        };
        Some(Self::of(time))
    }
}

impl fmt::Display for Instant {
    /// ISO 8601 with milliseconds.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (seconds, ns) = (self.0.div_euclid(SECOND_NS), self.0.rem_euclid(SECOND_NS));
        let time = i64::try_from(seconds)
            .ok()
            .and_then(|seconds| DateTime::from_timestamp(seconds, ns as u32));
        match time {
            Some(time) => write!(f, "{}", time.format("%Y-%m-%dT%H:%M:%S%.3f")),
            None => write!(f, "a time beyond the calendar"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_counted_as_the_calendar_has_them() {
        // Seconds since 1970 from the table of POSIX time: 2000-03-01 is day 11017, 2019-07-06 is
        // day 18083.
        for (text, days) in [
            ("1970-01-01", 0),
            ("2000-03-01", 11_017),
            ("2019-07-06", 18_083),
            ("1969-12-31", -1),
        ] {
            let instant = Instant(days * 86_400 * SECOND_NS);
            assert_eq!(Instant::parse(text), Some(instant), "{text}");
            assert_eq!(instant.to_string(), format!("{text}T00:00:00.000"));
        }
        let start = Instant::from_day(2019, 187, [3u8, 19, 23], 38_300_000);
        assert_eq!(start.to_string(), "2019-07-06T03:19:23.038");
        assert_eq!(Instant::parse("2019-07-06T03:19:23.0383Z"), Some(start));
        for text in [
            "2019-07-06T05:19:23.0383+02:00",
            "2019-07-06 05:19:23.038300000+02",
            "2019-07-06T03:19:23.0383",
        ] {
            assert_eq!(Instant::parse(text), Some(start), "{text}");
        }
        assert_eq!(
            Instant::parse("2019-07-06T24:00:00Z"),
            Instant::parse("2019-07-07")
        );
        assert_eq!(
            Instant::parse("2016-12-31T23:59:60"),
            Instant::parse("2017-01-01")
        );
        // A day that the year does not have, and times beyond the calendar.
        assert_eq!(
            Instant::from_day(2019, 366, [0u8; 3], 0),
            Instant::from_day(2020, 1, [0u8; 3], 0)
        );
        assert_eq!(
            start.later_by_s(f64::MAX).to_string(),
            "a time beyond the calendar"
        );
        // 38.3 ms before the second, exactly.
        assert_eq!(
            start.seconds_since(Instant::parse("2019-07-06T03:19:23").unwrap()),
            0.0383
        );
        assert!(Instant::parse("3000-01-01T00:00:00").unwrap() > start);
        assert_eq!(
            Instant::parse("2024-12-31").unwrap().to_string(),
            "2024-12-31T00:00:00.000"
        );
    }

    #[test]
    fn what_is_no_date_is_none() {
        for text in [
            "",
            "2019",
            "2019-13-01",
            "2019-01-01T00:00:00Zx",
            "2019-01-01T24:30:00",
            "2019-02-29",
            "2019-1-1T",
            "2019-01-01T25:00",
            "a-b-c",
            "2019-01-01T00:00:00.",
            "0000-01-01",
        ] {
            assert_eq!(Instant::parse(text), None, "{text}");
        }
    }
}
