//! What a reader concluded, left out or doubts about a record, and the notes of many records in few sentences.

use std::collections::HashSet;
use std::fmt;

use freestand_input::quantity::shorten;
use freestand_input::words::{counted, number, some};

/// A note about one record, for those who read its results.
#[derive(Debug, Clone, PartialEq)]
pub struct Note {
    /// What it is about; by it the notes of many records are grouped.
    pub kind: NoteKind,
    /// The component, or the line of the file.
    about: Option<String>,
    words: String,
    /// How much, with its unit.
    amount: Option<(f64, &'static str)>,
}

impl Note {
    /// A note about a file.
    pub fn new(kind: NoteKind, words: impl Into<String>) -> Self {
        Self {
            kind,
            about: None,
            words: printable(&words.into()),
            amount: None,
        }
    }

    /// A note about a component.
    pub fn of(component: &str, kind: NoteKind, words: impl Into<String>) -> Self {
        Self {
            about: Some(printable(&shorten(component))),
            ..Self::new(kind, words)
        }
    }

    /// A note about a line of a file.
    pub(crate) fn at(line: usize, kind: NoteKind, words: impl Into<String>) -> Self {
        Self {
            about: Some(format!("line {line}")),
            ..Self::new(kind, words)
        }
    }

    /// The same about a component, unless it is about a part already.
    #[must_use]
    pub fn about(self, component: &str) -> Self {
        let about = self.about.or_else(|| Some(component.to_owned()));
        Self { about, ..self }
    }

    /// How much it is about: of several records the largest is stated.
    #[must_use]
    pub fn amount(self, amount: f64, unit: &'static str) -> Self {
        Self {
            amount: Some((amount.abs(), unit)),
            ..self
        }
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(about) = &self.about {
            write!(f, "{about}: ")?;
        }
        f.write_str(&self.words)
    }
}

/// A text of a file without control characters, by which a terminal would be told to do something.
pub(crate) fn printable(text: &str) -> String {
    text.chars()
        .map(|c| if c.is_control() { '\u{fffd}' } else { c })
        .collect()
}

/// Declares the kinds, each with what is said of several records: `{}` stands for their number and names.
macro_rules! kinds {
    ($($kind:ident $words:literal)*) => {
        /// What a note is about.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        #[allow(missing_docs, reason = "the words say it")]
        pub enum NoteKind { $($kind),* }

        impl NoteKind {
            fn of_several(self) -> &'static str {
                match self { $(Self::$kind => $words),* }
            }
        }
    };
}

kinds! {
    CountDiffers "the number of values is not the one stated in {}"
    CountUnstated "no number of values is stated in {}"
    PeakDiffers "the largest value is not the peak stated in {}"
    DurationDiffers "the duration is not the one stated in {}"
    StepDiffers "two time steps are stated in {}"
    CutOff "a channel or the mark of its end is missing, so that the file may be cut off, in {}"
    OddDigits "a number is printed unlike all others, so that the file may be damaged there, in {}"
    GapMark "a value that may mark a missing one is read as a value in {}"
    Extreme "values are larger than any ground or floor motion in {}; check their unit, and look for a damaged digit"
    OddStep "the time step is too long or too short for an earthquake in {}; check the unit of the times"
    Clipped "the values stay at their largest one again and again, so that the motion was stronger, in {}"
    EndsEarly "strong shaking goes on to the end, so that what followed is not known, in {}"
    Offset "the values do not lie about zero in {}; remove the offset with `baseline = \"mean\"`"
    TextIgnored "text below the values was ignored in {}"
    ColumnIgnored "a column was ignored in {}"
    RowsIgnored "rows, blocks or records were ignored in {}"
    ChannelLeftOut "a channel that is not an acceleration was left out of {}"
    UnitFromText "the unit is taken from the text of {}"
    StepFromText "the time step is taken from the text of {}"
    StepFromDuration "the time step is the duration divided by the number of values in {}"
    UnitAssumed "the unit is assumed in {}"
    TimeAssumed "a column without a unit is read as time in seconds in {}"
    ColumnsAssumed "no line names the columns, which are read in the usual order, in {}"
    FirstRow "the first row may be the number of values in {}"
    MayBeTime "a column that may be the time is read as an acceleration in {}"
    NotCorrected "the baseline was not removed, as the header says, in {}"
    Relative "the accelerations are relative to the ground, and rocking needs absolute ones, in {}"
    FactorIgnored "a factor of the header was not applied in {}"
    Readings "the readings have the unit of the header, not mm/s2, in {}"
    Sensitivity "counts are divided by a sensitivity, and the response of the instrument is not removed, in {}"
    EpochEnds "the epoch of the StationXML file ends before the end of {}"
    XmlUnused "the StationXML file was not used for {}"
    Borehole "the bottom of a borehole, not the surface, was recorded in {}"
    Encoding "no encoding is stated, and Steim-1 was assumed, in {}"
    Clock "the clock and the sampling rate disagree in {}"
    Flagged "the instrument flagged faulty samples in {}"
    Interpolated "uneven times were interpolated on straight lines in {}"
    PeakReduced "interpolation reduced a peak in {}; a shorter step keeps it"
    MeanRemoved "the mean was removed from {}"
    Trimmed "samples that only one of two components has were left out of {}"
    Apart "the samples of the two components are not at the same instants in {}"
    StepsDiffer "the time steps of the two components differ by rounding in {}"
    Identical "the two components are identical in {}"
    NotPerpendicular "the two components are not perpendicular, but are treated as if they were, in {}"
    FarFactor "the factor is so far from 1 that the motion no longer represents its earthquake in {}"
    ShortPeriod "the shortest period of the target has fewer than ten steps in {}"
    LatePeak "the floor reaches its peak only after the end of {}; let it ring down with `tail`"
    FewSamples "the fastest oscillators have few samples in a period in {}"
    Target "a part of the target spectrum was left out for {}"
    Still "the floor does not move, as all values are zero, in {}"
    MovesOn "the floor does not stop at the end of {}; correct an offset with `baseline`, for example \"graizer\""
    StartsLater "the time column does not begin at 0 s, but the written motion does, in {}"
    Given "notes were given with {}"
}

/// The notes of files, each with the name of its file. Those of one kind about several files are one sentence.
///
/// # Example
/// ```
/// use freestand_records::notes::{Note, NoteKind, grouped};
/// let [a, b] = ["10 s are stated", "12 s are stated"].map(|words| Note::new(NoteKind::DurationDiffers, words));
/// assert_eq!(grouped([("A", &a)]), ["A: 10 s are stated"]);
/// let both = "the duration is not the one stated in 2 records: A, B (for example A: 10 s are stated)";
/// assert_eq!(grouped([("A", &a), ("B", &b)]), [both]);
/// ```
pub fn grouped<'a, N: AsRef<str>>(notes: impl IntoIterator<Item = (N, &'a Note)>) -> Vec<String> {
    let mut kinds: Vec<(NoteKind, Vec<(N, &Note)>)> = Vec::new();
    for (name, note) in notes {
        match kinds.iter_mut().find(|(kind, _)| *kind == note.kind) {
            Some((_, all)) => all.push((name, note)),
            None => kinds.push((note.kind, vec![(name, note)])),
        }
    }
    kinds
        .iter()
        .flat_map(|(kind, all)| sentences(*kind, all))
        .collect()
}

/// The sentences about notes of one kind.
fn sentences<N: AsRef<str>>(kind: NoteKind, all: &[(N, &Note)]) -> Vec<String> {
    /// How many names a sentence has.
    const NAMED: usize = 3;
    let said = |(name, note): &(N, &Note)| format!("{}: {note}", name.as_ref());
    let mut names: Vec<&str> = all.iter().map(|(name, _)| name.as_ref()).collect();
    let mut seen = HashSet::new();
    names.retain(|name| seen.insert(*name));
    if names.len() == 1 {
        return all.iter().map(said).collect();
    }
    let most = all
        .iter()
        .filter_map(|(_, note)| note.amount)
        .max_by(|a, b| a.0.total_cmp(&b.0));
    let (count, names) = (counted(names.len(), "record"), some(&names, NAMED));
    let records = match (most, all) {
        (Some((amount, unit)), _) => {
            format!("{count} (up to {} {unit}): {names}", number(amount, 2))
        }
        (None, [first, ..]) => format!("{count}: {names} (for example {})", said(first)),
        (None, []) => return Vec::new(),
    };
    vec![kind.of_several().replace("{}", &records)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// For the tests of readers, which know the sentences.
    impl PartialEq<&str> for Note {
        fn eq(&self, words: &&str) -> bool {
            self.to_string().as_str() == *words
        }
    }

    impl PartialEq<Note> for String {
        fn eq(&self, note: &Note) -> bool {
            note == &self.as_str()
        }
    }

    #[test]
    fn one_kind_of_many_records_is_one_sentence_with_the_most_and_few_names() {
        let names: Vec<String> = (1..=44).map(|number| format!("R{number}")).collect();
        let mean = |number: usize| {
            Note::new(NoteKind::MeanRemoved, "mean removed").amount(-0.001 * number as f64, "m/s2")
        };
        let note = |index: usize| {
            if index == 7 {
                Note::new(NoteKind::Identical, "equal")
            } else {
                mean(index + 1)
            }
        };
        let notes: Vec<Note> = (0..names.len()).map(note).collect();
        let said = grouped(names.iter().map(String::as_str).zip(&notes));
        let means =
            "the mean was removed from 43 records (up to 0.044 m/s2): R1, R2, R3 and 40 more";
        assert_eq!(said, [means, "R8: equal"]);
    }

    /// Several components of one file are told one by one, and count as one record beside others.
    #[test]
    fn a_file_with_several_notes_of_a_kind_counts_once() {
        let of = |component| Note::of(component, NoteKind::Borehole, "recorded in a borehole");
        let (north, east) = (of("NS"), of("EW"));
        let alone = grouped([("A", &north), ("A", &east)]);
        assert_eq!(
            alone,
            [
                "A: NS: recorded in a borehole",
                "A: EW: recorded in a borehole"
            ]
        );
        let both = grouped([("A", &north), ("A", &east), ("B", &east)]);
        let words = "the bottom of a borehole, not the surface, was recorded in 2 records: A, B (for example A: NS: \
                     recorded in a borehole)";
        assert_eq!(both, [words]);
        // Wherever its notes stand.
        assert_eq!(
            grouped([("A", &north), ("B", &east), ("A", &east)]),
            [words]
        );
    }
}
