//! The header of a COSMOS channel: text, whole numbers and reals.

use super::Series;
use crate::formats::volumes::{first_integer, step_in};
use crate::motion_file::ReadOptions;
use crate::notes::{Note, NoteKind};
use crate::text::fixed_width::Format;
use crate::text::fortran::{is_missing_value, scan};
use crate::text::lines::Lines;
use freestand::G0_M_S2;
use freestand_input::problem::Problem;

/// The header of a channel.
pub(super) struct Header {
    pub(super) text: Vec<String>,
    pub(super) integers: Vec<f64>,
    pub(super) reals: Vec<f64>,
    pub(super) line_of_reals: usize,
    /// Numbers that mark an unknown value, in the headers and in the data.
    pub(super) missing: [f64; 2],
}

pub(super) fn read_header(first: String, rest: &mut Lines<'_>) -> Result<Header, Problem> {
    let lower = first.to_ascii_lowercase();
    let declared = lower
        .split("with")
        .nth(1)
        .and_then(first_integer)
        .unwrap_or(13);
    // The format has 13; this leaves room for the "exceptional cases" that it allows.
    if !(5..=200).contains(&declared) {
        return Err(Problem::format(
            format!("the header declares {declared} lines of text"),
            "a COSMOS header has 13: correct the number, or fetch the file again",
        )
        .at_line(rest.line_number()));
    }
    let mut text = vec![first];
    text.extend(rest.by_ref().take(declared - 1).map(|line| line.text()));
    let (integers, _) = read_block(rest, "integer header", 54)?;
    let (reals, line_of_reals) = read_block(rest, "real header", 64)?;
    Ok(Header {
        missing: missing_values(&text),
        text,
        integers,
        reals,
        line_of_reals,
    })
}

/// `100 Real-header values follow on 17 lines, Format= (6F13.6)`, and the values.
fn read_block(
    rest: &mut Lines<'_>,
    what: &str,
    least: usize,
) -> Result<(Vec<f64>, usize), Problem> {
    let line = rest.find(|line| !line.is_blank());
    let declared = line.and_then(|line| {
        let text = line.text();
        let names_it = text.to_ascii_lowercase().replace('-', " ").contains(what);
        names_it
            .then(|| Some((first_integer(&text)?, Format::named_in(&text)?)))
            .flatten()
    });
    let Some((count, format)) = declared else {
        return Err(Problem::format(
            format!("the line that describes the {what} is missing"),
            "it should read like \"100 Real-header values follow on  17 lines, Format= (6F13.6)\"",
        )
        .at_line(line.map_or(rest.line_number(), |line| line.number)));
    };
    let block = format.read(rest, count, &format!("the {what}"))?;
    if block.values.len() < least {
        return Err(Problem::format(
            format!("the {what} has {count} values; 100 are expected"),
            "the file may be damaged: fetch it again",
        )
        .at_line(block.first_line));
    }
    Ok((block.values, block.first_line))
}

/// Text line 13 ends with the whole number and the real number that mark unknown values.
fn missing_values(text: &[String]) -> [f64; 2] {
    let line = text
        .iter()
        .rev()
        .find(|line| line.to_ascii_lowercase().contains("unknown"));
    let listed = line
        .and_then(|line| line.rsplit_once(':'))
        .map_or("", |(_, list)| list);
    let mut found = listed
        .split([',', ' '])
        .filter_map(|word| scan(word.as_bytes()))
        .map(|number| number.value);
    [
        found.next().unwrap_or(-999.0),
        found.next().unwrap_or(-999.0),
    ]
}

impl Header {
    /// Real header `number`, counted from 1, if it is known.
    pub(super) fn real(&self, number: usize) -> Option<f64> {
        let value = *self.reals.get(number - 1)?;
        (value != self.missing[1] && !is_missing_value(value)).then_some(value)
    }

    /// The value of one count \[m/s²\]: volts per count divided by volts per g.
    pub(super) fn count_m_s2(&self, notes: &mut Vec<Note>) -> Result<f64, Problem> {
        let positive = |number: usize, what: &str| {
            self.real(number)
                .filter(|value| *value > 0.0)
                .ok_or_else(|| {
                    let message =
                        format!("the values are counts, but the header does not give the {what}");
                    Problem::format(
message,
format!("use the uncorrected file (V1) of the same record, or fill in real header {number}"),
)
                    .at_line(self.line_of_reals)
                })
        };
        let volts = positive(22, "recorder's microvolts per count (real header 22)")? / 1e6;
        let volts_a_g = positive(42, "sensor's volts per g (real header 42)")?;
        if let Some(gain) = self.real(47).filter(|gain| *gain != 1.0 && *gain != 0.0) {
            let words = format!(
                "the header states a gain of {gain} (real header 47), which was not applied"
            );
            notes.push(Note::new(NoteKind::FactorIgnored, words));
        }
        Ok(volts / volts_a_g * G0_M_S2)
    }

    /// The time step \[s\] and its line: real header 62 in ms, else the rate above the values,
    /// which the first version of the format has. Real header 34 is the step of the recorder, which
    /// applies to uncorrected values only.
    pub(super) fn step(
        &self,
        series: &Series,
        is_raw: bool,
        options: &ReadOptions,
    ) -> Result<(f64, usize), Problem> {
        let of_title = step_in(&series.title.to_ascii_uppercase());
        let of_header = self
            .real(62)
            .filter(|dt_ms| *dt_ms > 0.0)
            .map(|dt_ms| dt_ms / 1000.0);
        if let (Some(of_title), Some(of_header)) = (of_title, of_header)
            // Rates are printed with three digits or more.
            && (of_title - of_header).abs() > 1e-3 * of_header
        {
            let message = format!(
                "the time step is {of_header} s in the header, but {of_title} s above the values"
            );
            return Err(Problem::format(
                message,
                "one of the two is wrong: ask the source of the file, and correct it",
            )
            .at_line(series.line));
        }
        let recorder = self.real(34).filter(|dt_s| is_raw && *dt_s > 0.0);
        let at_reals = |dt_s| (dt_s, self.line_of_reals);
        let of_title = of_title.map(|dt_s| (dt_s, series.line));
        of_header
            .map(at_reals)
            .or(of_title)
            .or(recorder.or(options.dt_s).map(at_reals))
            .ok_or_else(|| {
                Problem::format(
                    "the header does not give the time step (real header 62)",
                    "give the time step, such as `dt = \"0.005 s\"`",
                )
                .at_line(self.line_of_reals)
            })
    }
}

/// `Sta Chan  1: 360 deg (Rcrdr Chan  1)`, `Sta Cha: 1     0 deg (Rcrdr Chan  1)`,
/// `Sta Chan   1  90    HNE   Location:`.
pub(super) fn channel_name(text: &[String]) -> Option<String> {
    let line = text
        .iter()
        .map(|line| line.trim_start())
        .find(|line| line.to_ascii_lowercase().starts_with("sta cha"))?;
    let line = line
        .split('(')
        .next()?
        .split("Loc")
        .next()?
        .get(7..)?
        .trim_start_matches(['n', 'N']);
    let is_between = |c: char| c == ':' || c.is_whitespace();
    let behind_number = line
        .trim_start_matches(is_between)
        .trim_start_matches(|c: char| c.is_ascii_digit());
    let name = behind_number
        .trim_matches(is_between)
        .split("   ")
        .next()?
        .trim();
    (!name.is_empty()).then(|| name.to_owned())
}

/// `Statn No: 05- 23837 Code:CE-23837  CGS  Pomona - Orange Grove & Fairplex`: the name begins in
/// column 41.
pub(super) fn station(text: &[String]) -> Option<String> {
    let line = text
        .iter()
        .find(|line| line.trim_start().to_ascii_lowercase().starts_with("stat"))?;
    let name: String = line.chars().skip(40).collect();
    let after = line.split_once(':').map_or("", |(_, after)| after);
    let name = if line.contains("Code:") {
        name.trim()
    } else {
        after.trim()
    };
    (!name.is_empty()).then(|| name.to_owned())
}
