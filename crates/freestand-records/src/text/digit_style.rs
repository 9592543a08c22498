//! How the numbers of a column are printed. Where all but one have the same form, that one is
//! damaged.

use super::fortran::Number;
use crate::notes::{Note, NoteKind};

/// A single number in another form means something only among at least this many. Programs that
/// omit trailing zeros print one number in ten shorter; that only one in a hundred is shorter has a
/// probability of 1 in 3000.
const MIN_NUMBERS: usize = 100;

/// How many characters the numbers of a column have after their decimal points. In Fortran's F and
/// E formats, and in the output of most programs, all have the same.
#[derive(Debug, Default)]
pub(crate) struct DigitStyle {
    /// The first two counts of characters, how many numbers have each, and the line of the first.
    met: [Option<(usize, usize, usize)>; 2],
    /// Whether there is a third count.
    has_more: bool,
}

impl DigitStyle {
    /// Adds a number from line `at`.
    pub(crate) fn see(&mut self, number: &Number, at: usize) {
        // Zero is often written in a form of its own: `0`, `0.00`, `0.000000` among numbers of nine digits.
        if number.value == 0.0 {
            return;
        }
        for met in &mut self.met {
            match met {
                Some((tail, count, _)) if *tail == number.tail => {
                    *count += 1;
                    return;
                }
                Some(_) => {}
                None => {
                    *met = Some((number.tail, 1, at));
                    return;
                }
            }
        }
        self.has_more = true;
    }

    /// Whether the first number, unless it is zero, has no point.
    pub(crate) fn first_is_whole(&self) -> bool {
        self.met[0].is_some_and(|(tail, ..)| tail == 0)
    }

    /// A note about the only number that is printed in a different form.
    pub(crate) fn note(&self) -> Option<Note> {
        let words = "a number has more or fewer characters after its decimal point than all others: the file may be damaged \
                     or cut off there";
        self.odd_one()
            .map(|line| Note::at(line, NoteKind::OddDigits, words))
    }

    /// The line of the only number that is printed in a different form.
    fn odd_one(&self) -> Option<usize> {
        match self.met {
            [Some((_, 1, at)), Some((_, count, _))] | [Some((_, count, _)), Some((_, 1, at))] => {
                (count >= MIN_NUMBERS && !self.has_more).then_some(at)
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fortran::number;
    use super::*;

    fn odd(texts: impl Iterator<Item = String>) -> Option<usize> {
        let mut style = DigitStyle::default();
        texts
            .enumerate()
            .for_each(|(at, text)| style.see(&number(text.as_bytes()).unwrap(), at));
        style.odd_one()
    }

    #[test]
    fn one_number_in_another_form_is_found() {
        let fixed = |i: usize| format!("{:.7}E-03", (i as f64 + 1.5).sin());
        for (damaged, at) in [
            ("-.2553", 199),
            ("-.2553209", 199),
            ("-.255320E-03", 7),
            ("-2553209E-03", 7),
            ("4000", 0),
        ] {
            let text = |i: usize| {
                if i == at {
                    damaged.to_owned()
                } else {
                    fixed(i)
                }
            };
            assert_eq!(odd((0..200).map(text)), Some(at), "{damaged}");
        }
        assert_eq!(odd((0..200).map(fixed)), None);
    }

    #[test]
    fn other_ways_to_print_are_left_alone() {
        // Shortest decimals, some rounded ones, few numbers, a zero.
        assert_eq!(
            odd((0..500).map(|i| format!("{}", f64::from(i).sin()))),
            None
        );
        assert_eq!(
            odd((0..500).map(|i| format!("{}", (f64::from(i).sin() * 1e4).round() / 1e4))),
            None
        );
        assert_eq!(
            odd((0..100).map(|i| if i == 50 {
                "1.5".to_owned()
            } else {
                "1.25".to_owned()
            })),
            None
        );
        for zero in ["0", "0.000000", "0.0E+00"] {
            let text = |i: usize| {
                if i == 0 {
                    zero.to_owned()
                } else {
                    format!("{i}.25")
                }
            };
            assert_eq!(odd((0..500).map(text)), None, "{zero}");
        }
    }
}
