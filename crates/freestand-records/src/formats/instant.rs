//! Points in time of the records of one file, and of the epochs of a station's description.

use std::fmt;

const SECOND_NS: i128 = 1_000_000_000;
const DAY_S: i128 = 86_400;

/// Nanoseconds since 1970-01-01 in UTC without leap seconds: a record that runs through one is off by a second behind it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Instant(pub(super) i128);

/// Days from 1970-01-01 to the first of January of a year from 1 on.
fn days_to_year(year: i128) -> i128 {
    let before = year - 1;
    365 * before + before / 4 - before / 100 + before / 400 - 719_162
}

fn is_leap(year: i128) -> bool {
    year % 4 == 0 && (year % 100 != 0 || year % 400 == 0)
}

fn month_lengths(year: i128) -> [i128; 12] {
    [31, if is_leap(year) { 29 } else { 28 }, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31]
}

impl Instant {
    /// From a year, its day from 1, a second of that day and nanoseconds.
    pub(super) fn from_day(year: u16, day: u16, second: u32, nanosecond: u32) -> Self {
        let days = days_to_year(i128::from(year.max(1))) + i128::from(day) - 1;
        Self((days * DAY_S + i128::from(second)) * SECOND_NS + i128::from(nanosecond))
    }

    /// Seconds since 1970, to a quarter of a microsecond today.
    pub(super) fn seconds(self) -> f64 {
        self.seconds_since(Self(0))
    }

    pub(super) fn later_by_ns(self, ns: i128) -> Self {
        Self(self.0 + ns)
    }

    pub(super) fn later_by_s(self, seconds: f64) -> Self {
        Self(self.0 + (seconds * 1e9).round() as i128)
    }

    /// Seconds from `earlier` to here.
    pub(super) fn seconds_since(self, earlier: Self) -> f64 {
        // Divided before it is added up: the difference of two records is small, but that of two epochs is not.
        let ns = self.0 - earlier.0;
        (ns / SECOND_NS) as f64 + (ns % SECOND_NS) as f64 / 1e9
    }

    /// `2012-04-13T17:28:00`, with a fraction, with `Z` or an offset such as `+01:00`, or the date alone.
    pub(super) fn parse(text: &str) -> Option<Self> {
        let text = text.trim();
        let (date, time) = text.split_once(['T', ' ']).unwrap_or((text, "00:00:00"));
        let mut parts = date.split('-').map(digits);
        let (year, month, day) = (parts.next()??, parts.next()??, parts.next()??);
        let length = *month_lengths(year).get(usize::try_from(month).ok()?.checked_sub(1)?)?;
        if parts.next().is_some() || !(1..=9999).contains(&year) || !(1..=length).contains(&day) {
            return None;
        }
        let day_of_year: i128 = month_lengths(year).iter().take(usize::try_from(month).ok()? - 1).sum::<i128>() + day;
        let (time, offset_s) = split_offset(time)?;
        let (time, fraction) = time.split_once('.').unwrap_or((time, "0"));
        let mut parts = time.split(':').map(digits);
        let (hour, minute, second) = (parts.next()??, parts.next()??, parts.next().unwrap_or(Some(0))?);
        if parts.next().is_some() || hour > 24 || minute > 59 || second > 60 || fraction.is_empty() {
            return None;
        }
        let ns = digits(&format!("{:0<9}", fraction).chars().take(9).collect::<String>())?;
        let days = days_to_year(year) + day_of_year - 1;
        Some(Self((days * DAY_S + 3600 * hour + 60 * minute + second - offset_s) * SECOND_NS + ns))
    }
}

fn digits(text: &str) -> Option<i128> {
    let all = (1..=9).contains(&text.len()) && text.bytes().all(|b| b.is_ascii_digit());
    all.then(|| text.parse().ok()).flatten()
}

/// The time of day and its offset from UTC \[s\].
fn split_offset(time: &str) -> Option<(&str, i128)> {
    if let Some(time) = time.strip_suffix(['Z', 'z']) {
        return Some((time, 0));
    }
    let Some(at) = time.rfind(['+', '-']) else { return Some((time, 0)) };
    let (hours, minutes) = time[at + 1..].split_once(':').unwrap_or((&time[at + 1..], "0"));
    let offset_s = 3600 * digits(hours)? + 60 * digits(minutes)?;
    Some((&time[..at], if time[at..].starts_with('-') { -offset_s } else { offset_s }))
}

impl fmt::Display for Instant {
    /// ISO 8601 with milliseconds.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ms = self.0.div_euclid(SECOND_NS / 1000);
        let (days, ms) = (ms.div_euclid(DAY_S * 1000), ms.rem_euclid(DAY_S * 1000));
        // A year has 365.2425 days; the quotient is off by one at most.
        let guess = 1970 + days * 400 / 146_097;
        let year = (guess - 1..=guess + 1).rev().find(|&year| days_to_year(year) <= days).unwrap_or(guess);
        let mut day = days - days_to_year(year);
        let mut month = 1;
        for length in month_lengths(year) {
            if day < length {
                break;
            }
            day -= length;
            month += 1;
        }
        let (hour, minute, second) = (ms / 3_600_000, ms / 60_000 % 60, ms / 1000 % 60);
        write!(f, "{year:04}-{month:02}-{:02}T{hour:02}:{minute:02}:{second:02}.{:03}", day + 1, ms % 1000)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_counted_as_the_calendar_has_them() {
        // Seconds since 1970 from the table of POSIX time: 2000-03-01 is day 11017, 2019-07-06 is day 18083.
        for (text, days) in [("1970-01-01", 0), ("2000-03-01", 11_017), ("2019-07-06", 18_083), ("1969-12-31", -1)] {
            assert_eq!(Instant::parse(text), Some(Instant(days * DAY_S * SECOND_NS)), "{text}");
            assert_eq!(Instant(days * DAY_S * SECOND_NS).to_string(), format!("{text}T00:00:00.000"));
        }
        let start = Instant::from_day(2019, 187, 3 * 3600 + 19 * 60 + 23, 38_300_000);
        assert_eq!(start.to_string(), "2019-07-06T03:19:23.038");
        assert_eq!(Instant::parse("2019-07-06T03:19:23.0383Z"), Some(start));
        assert_eq!(Instant::parse("2019-07-06T05:19:23.0383+02:00"), Some(start));
        // 38.3 ms before the second, exactly.
        assert_eq!(start.seconds_since(Instant::parse("2019-07-06T03:19:23").unwrap()), 0.0383);
        assert!(Instant::parse("3000-01-01T00:00:00").unwrap() > start);
        assert_eq!(Instant::parse("2024-12-31").unwrap().to_string(), "2024-12-31T00:00:00.000");
    }

    #[test]
    fn what_is_no_date_is_none() {
        for text in [
            "",
            "2019",
            "2019-13-01",
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
