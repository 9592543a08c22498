//! Measurement files of LabVIEW (LVM): a header of keys, then columns whose times and units stand in the header.

use crate::text::fortran;
use crate::text::lines::{Line, lines, text_of};
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;

const END: &str = "***End_of_Header***";

fn is_end(line: &Line) -> bool {
    line.bytes.trim_ascii_start().starts_with(END.as_bytes())
}

/// The header of a file.
struct Header {
    separator: char,
    has_decimal_comma: bool,
    has_x_column: bool,
    x_heading: String,
    /// The first time and the step, from which times are calculated: a column of them is rounded.
    times_s: Option<(f64, f64)>,
    units: Vec<String>,
}

impl Header {
    /// # Errors
    /// Channels with times of their own.
    fn of(rows: &[(usize, String)]) -> Result<Self, Problem> {
        let separator = if rows.iter().any(|(_, row)| row.trim() == "Separator,Comma") {
            ','
        } else {
            '\t'
        };
        // A key counts where it stands last: those of the segment follow those of the file.
        let row_of = |key: &str| {
            let is_of_key = |row: &str| {
                row.split(separator)
                    .next()
                    .is_some_and(|cell| cell.trim() == key)
            };
            rows.iter().rev().find(|(_, row)| is_of_key(row))
        };
        let values = |key: &str| -> Vec<&str> {
            row_of(key).map_or(Vec::new(), |(_, row)| {
                row.split(separator).skip(1).map(str::trim).collect()
            })
        };
        let first = |key: &str| values(key).first().copied().unwrap_or_default().to_owned();
        let has_decimal_comma = first("Decimal_Separator") == ",";
        if first("X_Columns") == "Multi" {
            return Err(of_their_own(
                "every channel of the LabVIEW file has times of its own",
            ));
        }
        let numbers = |key: &str| -> Vec<f64> {
            values(key)
                .iter()
                .filter_map(|value| value.replace(',', ".").parse().ok())
                .collect()
        };
        for key in ["X0", "Delta_X"] {
            let (mut different, line) = (numbers(key), row_of(key).map_or(0, |(line, _)| *line));
            different.dedup();
            if different.len() > 1 {
                return Err(of_their_own(&format!(
                    "the channels of the LabVIEW file differ in {key}"
                ))
                .at_line(line));
            }
        }
        let number = |key: &str| numbers(key).first().copied();
        let dimension = first("X_Dimension");
        let is_time = dimension.is_empty() || dimension.eq_ignore_ascii_case("time");
        let step_s = number("Delta_X").filter(|step_s| is_time && *step_s > 0.0);
        let x_heading = if is_time {
            "time [s]".to_owned()
        } else {
            format!("{dimension} [{}]", first("X_Unit_Label"))
        };
        Ok(Self {
            separator,
            has_decimal_comma,
            has_x_column: first("X_Columns") != "No",
            x_heading,
            times_s: step_s.map(|step_s| (number("X0").unwrap_or(0.0), step_s)),
            units: values("Y_Unit_Label")
                .into_iter()
                .map(str::to_owned)
                .collect(),
        })
    }

    /// Whether the plain table has a column of times or another X.
    fn has_x(&self) -> bool {
        self.times_s.is_some() || self.has_x_column
    }

    /// Checks a written time, which is rounded, against the calculated one.
    fn check_time(&self, written: &str, time_s: f64, step_s: f64) -> Result<(), Problem> {
        let text = written.replace(',', ".");
        let is_near = fortran::number(text.as_bytes()).is_some_and(|number| {
            let rounding_s = 0.5 * 10f64.powi(number.last_digit_exponent);
            (number.value - time_s).abs() <= 0.5 * step_s + rounding_s
        });
        if is_near || !self.has_x_column || written.is_empty() {
            return Ok(());
        }
        let message = format!(
            "the time \"{}\" is not the one of X0 and Delta_X, {time_s:.9} s",
            shorten(written)
        );
        Err(Problem::format(
            message,
            "rows may be missing: save the measurement again, or save it as CSV with its written times",
        ))
    }

    /// The heading of a channel. N means newton only for a force.
    fn heading(&self, channel: usize, name: &str) -> String {
        match self
            .units
            .get(channel)
            .map(String::as_str)
            .unwrap_or_default()
        {
            "" => name.to_owned(),
            "N" | "Newton" | "Newtons" | "newton" | "newtons" => format!("force {name} [N]"),
            unit => format!("{name} [{unit}]"),
        }
    }
}

/// The problem of channels that one column of times does not serve.
fn of_their_own(message: &str) -> Problem {
    Problem::format(message, "save it with one X column, or as CSV")
}

/// The text as a plain table, on the same lines; `None` if it is not a file of LabVIEW.
///
/// # Errors
/// A file with several segments or with times for every channel; a time that contradicts the header.
pub(super) fn plain(bytes: &[u8]) -> Result<Option<Vec<u8>>, Problem> {
    let is_lvm = lines(bytes)
        .find(|line| !line.is_blank())
        .is_some_and(|line| line.text().starts_with("LabVIEW Measurement"));
    // The header of the file, then that of the segment.
    let Some(end) = lines(bytes)
        .filter(is_end)
        .take(2)
        .last()
        .map(|line| line.number)
        .filter(|_| is_lvm)
    else {
        return Ok(None);
    };
    let rows: Vec<(usize, String)> = lines(bytes)
        .take(end)
        .map(|line| (line.number, text_of(line.bytes)))
        .collect();
    let header = Header::of(&rows)?;
    if let Some(line) = lines(bytes).skip(end).find(is_end) {
        return Err(Problem::format(
            "the LabVIEW file has several segments",
            "save each of them in a file of its own",
        )
        .at_line(line.number));
    }
    let mut out: Vec<u8> = vec![b'\n'; end];
    let (mut row, mut channels) = (0, None);
    for line in lines(bytes).skip(end) {
        let text = text_of(line.bytes);
        let cells: Vec<&str> = text.split(header.separator).map(str::trim).collect();
        match channels {
            _ if line.is_blank() => {}
            None => {
                let names: Vec<&str> = cells
                    .iter()
                    .skip(1)
                    .copied()
                    .filter(|name| *name != "Comment")
                    .collect();
                channels = Some(names.len());
                let headings = names
                    .iter()
                    .enumerate()
                    .map(|(channel, name)| header.heading(channel, name));
                let x = Some(header.x_heading.clone()).filter(|_| header.has_x());
                out.extend(
                    x.into_iter()
                        .chain(headings)
                        .collect::<Vec<_>>()
                        .join("\t")
                        .bytes(),
                );
            }
            Some(channels) => {
                let written = cells.first().copied().unwrap_or_default();
                let x = match header.times_s {
                    Some((first_s, step_s)) => {
                        let time_s = first_s + f64::from(row) * step_s;
                        header
                            .check_time(written, time_s, step_s)
                            .map_err(|problem| problem.at_line(line.number))?;
                        format!("{time_s:.12}")
                    }
                    None => written.to_owned(),
                };
                let numbers = cells
                    .iter()
                    .skip(1)
                    .take(channels)
                    .map(|cell| (*cell).to_owned());
                let x = Some(x).filter(|_| header.has_x());
                let text = x.into_iter().chain(numbers).collect::<Vec<_>>().join("\t");
                out.extend(
                    if header.has_decimal_comma {
                        text.replace(',', ".")
                    } else {
                        text
                    }
                    .bytes(),
                );
                row += 1;
            }
        }
        out.push(b'\n');
    }
    Ok(Some(out))
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "LabVIEW Measurement\t\nWriter_Version\t2\nReader_Version\t2\nSeparator\tTab\n\
                        Decimal_Separator\t.\nMulti_Headings\tYes\nX_Columns\tOne\nTime_Pref\tRelative\n\
                        Date\t2026/11/24\nTime\t12:00:03.125\n***End_of_Header***\t\n\t\nChannels\t2\t\t\n\
                        Samples\t3\t3\t\nY_Unit_Label\tVolts\tN\t\nX_Dimension\tTime\tTime\t\nX0\t0.0E+0\t0.0E+0\t\n\
                        Delta_X\t2.5E-5\t2.5E-5\t\n***End_of_Header***\t\t\t\nX_Value\tAcceleration\tLoad cell\tComment\n";
    const ROWS: &str = "0.000000\t0.1\t1\n0.000025\t0.2\t2\n0.000050\t0.3\t3\t\n";

    fn table(text: &str) -> String {
        String::from_utf8(plain(text.as_bytes()).unwrap().unwrap()).unwrap()
    }

    #[test]
    fn units_and_steps_stand_in_the_header() {
        let expected = "time [s]\tAcceleration [Volts]\tforce Load cell [N]\n0.000000000000\t0.1\t1\n\
                        0.000025000000\t0.2\t2\n0.000050000000\t0.3\t3\n";
        let found = table(&format!("{HEAD}{ROWS}"));
        assert_eq!(found, format!("{}{expected}", "\n".repeat(19)));
        // Without a column of times, and with decimal commas.
        let rows = ROWS
            .lines()
            .map(|row| format!("\t{}\n", row.split_once('\t').unwrap().1.replace('.', ",")));
        let head = HEAD
            .replace("X_Columns\tOne", "X_Columns\tNo")
            .replace("Separator\t.", "Separator\t,");
        assert_eq!(
            table(&format!(
                "{}{}",
                head.replace("2.5E", "2,5E"),
                rows.collect::<String>()
            )),
            found
        );
        let commas = format!("{HEAD}{ROWS}")
            .replace("Separator\tTab", "Separator\tComma")
            .replace('\t', ",");
        assert_eq!(table(&commas), found);
    }

    #[test]
    fn channels_with_steps_or_first_times_of_their_own_are_refused() {
        for (row, changed, line) in [
            ("2.5E-5\t2.5E-5", "2.5E-5\t5E-5", 18),
            ("0.0E+0\t0.0E+0", "0.0E+0\t1.0E-3", 17),
        ] {
            let problem =
                plain(format!("{HEAD}{ROWS}").replace(row, changed).as_bytes()).unwrap_err();
            assert!(
                problem.line == Some(line) && problem.hint.is_some(),
                "{problem:?}"
            );
        }
        assert!(
            plain(
                format!("{HEAD}{ROWS}")
                    .replace("2.5E-5\t2.5E-5", "2.5E-5\t0.000025")
                    .as_bytes()
            )
            .is_ok()
        );
    }

    #[test]
    fn times_that_contradict_the_header_are_refused() {
        // Half a step and half of the last digit are 0.0000130 s.
        for (written, is_read) in [
            ("0.000062", true),
            ("0.000064", false),
            ("0.000075", false),
            ("late", false),
        ] {
            let found = plain(
                format!("{HEAD}{ROWS}")
                    .replace("0.000050", written)
                    .as_bytes(),
            );
            let problem = found.err();
            assert_eq!(problem.is_none(), is_read, "{written}");
            assert!(
                problem.is_none_or(|problem| problem.line == Some(23) && problem.hint.is_some()),
                "{written}"
            );
        }
    }

    #[test]
    fn what_is_no_single_table_is_refused() {
        assert_eq!(plain(b"time [s],a [g]\n0,1\n").unwrap(), None);
        let several =
            plain(format!("{HEAD}{ROWS}{}", &HEAD[HEAD.find("Channels").unwrap()..]).as_bytes())
                .unwrap_err();
        assert_eq!(several.line, Some(30));
        assert!(
            plain(HEAD.replace("\tOne", "\tMulti").as_bytes())
                .unwrap_err()
                .hint
                .is_some()
        );
    }
}
