//! One record is one earthquake, however often it is named.

use freestand::motion::Motion;
use freestand_input::problem::Problem;
use freestand_input::words::some;

use crate::study::RecordedMotion;

/// The most names in a message.
const MOST_NAMED: usize = 6;

/// Refuses motions that are counted as earthquakes of their own but have the same samples: a result would look
/// surer than it is. Each has a name, and up to three components.
///
/// # Errors
/// The first motion that has copies, with their names.
pub fn refuse_copies<'a, const N: usize>(
    motions: impl IntoIterator<Item = (&'a str, [Option<&'a Motion>; N])>,
) -> Result<(), Problem> {
    let mut left: Vec<_> = motions.into_iter().collect();
    while let Some((name, samples)) = left.pop() {
        let mut names: Vec<&str> = left
            .iter()
            .filter(|other| other.1 == samples)
            .map(|other| other.0)
            .collect();
        if names.is_empty() {
            continue;
        }
        names.push(name);
        let message = format!(
            "{} have the same samples: copies of one record are one earthquake, not several",
            some(&names, MOST_NAMED)
        );
        return Err(Problem::value(message, "name every record once"));
    }
    Ok(())
}

impl RecordedMotion {
    /// Its name and its components, for [`refuse_copies`].
    pub fn samples(&self) -> (&str, [Option<&Motion>; 3]) {
        let across = self.across.as_ref().map(|one| &one.motion);
        let vertical = self.vertical.as_ref().map(|one| &one.motion);
        (&self.name, [Some(&self.motion), across, vertical])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_are_named_and_other_records_pass() {
        let one = Motion::new(0.01, vec![0.0, 1.0, 0.0]).unwrap();
        let slower = Motion::new(0.02, vec![0.0, 1.0, 0.0]).unwrap();
        let checked = |motions: &[(&'static str, &Motion)]| {
            refuse_copies(motions.iter().map(|&(name, motion)| (name, [Some(motion)])))
        };
        assert_eq!(checked(&[("a", &one), ("b", &slower)]), Ok(()));
        let told =
            checked(&[("a", &one), ("b", &slower), ("a-2", &one), ("a-3", &one)]).unwrap_err();
        assert!(
            told.message
                .starts_with("a, a-2, a-3 have the same samples"),
            "{}",
            told.message
        );
        let many = checked(&[("a", &one); 9]).unwrap_err();
        assert!(
            many.message.starts_with("a, a, a, a, a, a and 3 more have"),
            "{}",
            many.message
        );
    }
}
