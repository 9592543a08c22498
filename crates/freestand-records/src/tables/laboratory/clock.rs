//! Times of the day in the first column: `12:00:03.125`, `2026-11-24 12:00:03,125`.

use crate::text::lines::{Line, lines, text_of};

/// Seconds of a day.
const DAY_S: u64 = 86_400;

/// A time of the day at the beginning of a row.
struct Clock<'a> {
    /// Whole seconds since midnight.
    seconds: u64,
    /// Its fraction, `.125`, with the decimal sign of the file.
    fraction: &'a str,
    rest: &'a str,
}

impl<'a> Clock<'a> {
    fn of(row: &'a str) -> Option<Self> {
        let row = row.trim_start();
        let (is_quoted, row) = row
            .strip_prefix('"')
            .map_or((false, row), |inside| (true, inside));
        let row = after_date(row).unwrap_or(row);
        let (hours, row) = number(row, 24)?;
        let (minutes, row) = number(row.strip_prefix(':')?, 60)?;
        // A leap second.
        let (seconds, row) = number(row.strip_prefix(':')?, 61)?;
        let digits =
            |text: &str| text.len() - text.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let length = match row.chars().next() {
            Some('.') => 1 + digits(&row[1..]),
            // A comma is a decimal sign where another separator follows.
            Some(',') if row[1 + digits(&row[1..])..].starts_with([';', '\t', ' ', '"']) => {
                1 + digits(&row[1..])
            }
            _ => 0,
        };
        let (fraction, rest) = row.split_at(length);
        let rest = if is_quoted {
            rest.strip_prefix('"')?
        } else {
            rest
        };
        let is_end = rest.is_empty() || rest.starts_with([',', ';', '\t', ' ']);
        is_end.then_some(Self {
            seconds: 3600 * hours + 60 * minutes + seconds,
            fraction,
            rest,
        })
    }
}

/// What follows `2026-11-24 `, `24.11.2026 ` or `2026-11-24T`.
fn after_date(row: &str) -> Option<&str> {
    let end = row
        .find([' ', 'T'])
        .filter(|end| row[..*end].split(['-', '/', '.']).count() == 3)?;
    let is_date = row[..end]
        .chars()
        .all(|c| c.is_ascii_digit() || "-/.".contains(c));
    is_date.then(|| row[end + 1..].trim_start())
}

fn number(text: &str, below: u64) -> Option<(u64, &str)> {
    let (digits, rest) = text.split_at(
        text.find(|c: char| !c.is_ascii_digit())
            .unwrap_or(text.len()),
    );
    let value = digits
        .parse()
        .ok()
        .filter(|value| *value < below && digits.len() <= 2)?;
    Some((value, rest))
}

/// The text with seconds in place of the times of the day, counted from the minute of the first one; only differences
/// count. A time that falls by more than half a day is on the next day. `None` without such times.
pub(super) fn in_seconds(bytes: &[u8]) -> Option<Vec<u8>> {
    let is_row = |line: &Line| !line.is_blank() && !line.is_comment();
    let first = lines(bytes)
        .filter(is_row)
        .find_map(|line| Some(Clock::of(&text_of(line.bytes))?.seconds / 60 * 60))?;
    let (mut out, mut day_s, mut last_s) = (Vec::with_capacity(bytes.len()), 0, first);
    for line in lines(bytes) {
        let text = text_of(line.bytes);
        match Clock::of(&text).filter(|_| is_row(&line)) {
            Some(Clock {
                seconds,
                fraction,
                rest,
            }) => {
                day_s += if seconds + DAY_S / 2 < last_s {
                    DAY_S
                } else {
                    0
                };
                last_s = seconds;
                // The first time of a row that goes back is below that of the first row.
                let since = (day_s + seconds) as i64 - first as i64;
                out.extend(format!("{since}{fraction}{rest}").bytes());
            }
            None => out.extend(line.bytes),
        }
        out.push(b'\n');
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seconds(text: &str) -> Option<String> {
        in_seconds(text.as_bytes()).map(|bytes| String::from_utf8(bytes).unwrap())
    }

    #[test]
    fn clock_times_become_seconds() {
        for (text, expected) in [
            (
                "time,a [g]\n12:00:03.125,0.1\n12:00:03.250,0.2\n",
                "time,a [g]\n3.125,0.1\n3.250,0.2\n",
            ),
            (
                "t;a [g]\n12:00:59,9;0,1\n12:01:00,0;0,2\n",
                "t;a [g]\n59,9;0,1\n60,0;0,2\n",
            ),
            (
                "2026-11-24 23:59:59.5\t1\n2026-11-25 00:00:00.5\t2\n",
                "59.5\t1\n60.5\t2\n",
            ),
            (
                "24.11.2026 07:08:09.1 1\n24.11.2026 07:08:09.2 2\n",
                "9.1 1\n9.2 2\n",
            ),
            ("\"2026-11-24T07:08:09.1\",1\n", "9.1,1\n"),
            // Commas between whole numbers are separators.
            ("12:00:03,125,7\n", "3,125,7\n"),
        ] {
            assert_eq!(seconds(text).as_deref(), Some(expected), "{text}");
        }
        for text in [
            "0.1,2\n",
            "# 12:00:03\n0,1\n",
            "25:00:00,1\n",
            "12:61:00,1\n",
            "12:00,1\n",
            "started 12:00:00\n0,1\n",
        ] {
            assert_eq!(seconds(text), None, "{text}");
        }
    }
}
