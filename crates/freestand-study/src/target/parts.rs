//! The code by which the restraint of an object is designed: the words of a spectrum, of which the
//! clauses for parts need fewer.

use freestand::code_spectrum::CodeSpectrum;
use freestand_input::keys::Words;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::words::number;

use super::Target;
use super::code::{CODES, Code};
use super::codes::DEFAULT_LONG_PERIOD_WORDS;
use super::doubt::TargetDoubt;
use super::named::named_place;
use super::words::{self, Remedies};
use crate::places::{Place, PlaceHazard};

impl Target {
    /// The code for parts that words with the keys of a spectrum describe.
    ///
    /// The clauses use the spectrum at T = 0, or S_DS alone in ASCE 7: SD1 and TL may be missing,
    /// and the spectrum at other periods then means nothing. Nothing stands in for a hazard: a place
    /// or its values must be given.
    ///
    /// # Errors
    /// Everything that is wrong with the words; a table, which is no code.
    ///
    /// # Example
    /// ```
    /// use freestand_study::target::Target;
    /// let words = [("code", "asce7"), ("edition", "2016"), ("sds", "1 g")].into_iter().collect();
    /// assert_eq!(Target::for_parts(&words)?.spectrum.plateau_g(), 1.0);
    /// let bare = [("code", "as1170.4")].into_iter().collect();
    /// assert!(Target::for_parts(&bare).is_err());
    /// # Ok::<(), freestand_input::problem::Problems>(())
    /// ```
    pub fn for_parts(words: &Words) -> Result<Self, Problems> {
        let has = |key: &str| words.get(key).is_some();
        let has_place = named_place(words).is_some();
        if !has("code") && !has_place {
            return Err(nameless(words).into());
        }
        let code = words.get("code").and_then(Code::parse);
        if let (Some(text), None) = (words.get("code"), code) {
            // A table is no code for parts.
            let codes = CODES.iter().map(|(_, code)| *code);
            let known = codes.filter(|code| code.has_parts());
            return Err(words::unknown_code(text, known).into());
        }
        if let (None, Some((key, text))) = (code, named_place(words))
            && let Ok(place) = Place::look_up(&text, None)
            && let PlaceHazard::Shape { by: Some(by), .. } = place.hazard
        {
            let message = format!("the clauses of {by} for parts are not in the program");
            let hint = "give `floor_acceleration`, or a code with its values, such as `code = \"asce7\"` and `sds = \"1 g\"`";
            return Err(Problem::value(message, hint).of(&[key]).into());
        }
        if code == Some(Code::Table) || has("spectrum") {
            let hint = "name a code, such as `code = \"asce7\"`, or a place";
            return Err(Problem::value("a table has no clause for parts", hint)
                .of(&[if has("spectrum") { "spectrum" } else { "code" }])
                .into());
        }
        if code == Some(Code::As1170_4) && !has_place && !has("hazard_factor") {
            let problem = Problem::new(
                ProblemKind::Missing,
                "AS 1170.4 needs `hazard_factor` or a place",
            )
            .hint("give `hazard_factor = \"0.08\"`, or a place: freestand place list")
            .of(&["hazard_factor", "code"]);
            return Err(problem.into());
        }
        if code == Some(Code::Asce7) && !has_place && !has("sds") && !has("ss") {
            let problem = Problem::new(ProblemKind::Missing, "ASCE 7 needs `sds`")
                .hint("give `sds = \"1 g\"`, or a place: freestand place list")
                .of(&["sds", "code"]);
            return Err(problem.into());
        }
        let mut words = words.clone();
        let mut filled = Vec::new();
        if code == Some(Code::Asce7) && !has_place {
            for (known, missing) in [("sds", "sd1"), ("ss", "s1"), ("fa", "fv")] {
                // Only with Fa: the tables give Fv for S1 alone.
                let needs = known == "sds" || has("fa");
                if let Some(text) = words
                    .get(known)
                    .map(str::to_owned)
                    .filter(|_| needs && !has(missing))
                {
                    words.set(missing, text);
                    filled.push(missing);
                }
            }
            if !has("long_period") {
                words.set("long_period", DEFAULT_LONG_PERIOD_WORDS);
            }
        }
        match words::resolve(&words, "".as_ref(), Remedies::Parts) {
            // The clauses use no long periods.
            Ok(target) => Ok(Self {
                period_doubts: Vec::new(),
                ..target.of_larger_type()
            }),
            Err(mut problems) => {
                // The value that stands in is wrong where the value that it repeats is.
                problems
                    .problems
                    .retain(|problem| !problem.key().is_some_and(|key| filled.contains(&key)));
                Err(problems)
            }
        }
    }

    /// Of two spectra of a national annex the one that asks more of parts, alone.
    fn of_larger_type(self) -> Self {
        if self.alternative.is_none() {
            return self;
        }
        let spectrum = self.parts_spectrum().clone();
        Self {
            spectrum,
            alternative: None,
            doubts: self
                .place
                .as_ref()
                .and_then(Place::doubt)
                .map(TargetDoubt::Place)
                .into_iter()
                .collect(),
            ..self
        }
    }

    /// What the clauses for parts use of it: `S_DS = 1 g`, `site De, Z = 0.08 (Melbourne), 500
    /// years, kpZ = 0.08 g`.
    pub fn parts_words(&self) -> String {
        match &self.spectrum {
            CodeSpectrum::Asce7(code) => {
                let site = code
                    .site()
                    .map_or_else(String::new, |site| format!("site {}, ", site.name()));
                format!(
                    "{site}S_DS = {} g{}",
                    number(code.sds_g(), 4),
                    self.place_in_brackets()
                )
            }
            _ => self.parameters(),
        }
    }
}

/// Keys of a hazard without a code.
fn nameless(words: &Words) -> Problem {
    let first = words.entries().next();
    let known = first.and_then(|(key, _)| {
        Some((
            key,
            CODES.iter().find(|(_, code)| code.keys().contains(&key))?.1,
        ))
    });
    match known {
        Some((key, code)) => Problem::new(ProblemKind::Missing, format!("`{key}` needs a code or a place"))
            .hint(format!("give `code = \"{}\"`, or `place = \"Wellington\"`", code.name()))
            .of(&[key]),
        None => Problem::new(ProblemKind::Missing, "neither `code` nor `place` is given")
            .hint("give `place = \"Wellington\"`, or a code with its values: `code = \"asce7\"`, `sds = \"1 g\"`"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(words: &[(&'static str, &'static str)]) -> Result<Target, String> {
        Target::for_parts(&words.iter().copied().collect()).map_err(|problems| problems.to_string())
    }

    #[test]
    fn what_the_clauses_need_is_enough() {
        let words = |words| of(words).unwrap().parts_words();
        assert_eq!(
            words(&[("code", "asce7"), ("sds", "1.2 g")]),
            "S_DS = 1.2 g"
        );
        assert_eq!(
            words(&[("code", "asce7"), ("ss", "1.5 g"), ("fa", "1.2")]),
            "S_DS = 1.2 g"
        );
        assert_eq!(
            words(&[("place", "Los Angeles")]),
            "site D, S_DS = 1.581 g (Los Angeles)"
        );
        let melbourne = words(&[("place", "Melbourne")]);
        assert_eq!(
            melbourne,
            "site De, Z = 0.08 (Melbourne), 500 years, kpZ = 0.08 g"
        );
        let europe = [
            ("code", "eurocode8"),
            ("site", "B"),
            ("ground_acceleration", "0.2 g"),
            ("spectrum_type", "1"),
        ];
        assert_eq!(words(&europe), "type 1, ground B, a_g = 0.2 g");
    }

    #[test]
    fn nothing_stands_in_for_a_hazard() {
        for (words, expected) in [
            (&[][..], "neither `code` nor `place`"),
            (&[("sds", "1 g")], "`sds` needs a code or a place"),
            (
                &[("code", "as1170.4")],
                "AS 1170.4 needs `hazard_factor` or a place",
            ),
            (&[("code", "asce7")], "ASCE 7 needs `sds`"),
            (
                &[("code", "nzs1170.5"), ("site", "C")],
                "NZS 1170.5 needs `hazard_factor`",
            ),
            (&[("code", "table")], "a table has no clause"),
            (&[("code", "asce8"), ("sds", "1 g")], "is not known"),
            (
                &[("code", "asce7"), ("place", "Wellington")],
                "has values for NZS 1170.5, not for ASCE 7",
            ),
            (
                &[("place", "Quito")],
                "the clauses of NEC-SE-DS 2015 for parts are not in the program",
            ),
            (&[("place", "Wellinton")], "is not in the table of places"),
            (
                &[("place", "Wellington"), ("sds", "1 g")],
                "`sds` is not part of NZS 1170.5",
            ),
        ] {
            let error = of(words).unwrap_err();
            assert!(error.contains(expected), "{words:?}: {error}");
        }
    }

    /// A table of values is no hazard for parts, so no hint offers one.
    #[test]
    fn no_hint_offers_a_table() {
        for words in [
            &[("place", "Wellinton")][..],
            &[("place", "Wellington"), ("interpolation", "linear")],
        ] {
            let words = words.iter().copied().collect();
            let problems = Target::for_parts(&words).unwrap_err().problems;
            let hints: Vec<&str> = problems
                .iter()
                .filter_map(|one| one.hint.as_deref())
                .collect();
            assert!(
                !hints.is_empty() && !hints.concat().contains("table in"),
                "{hints:?}"
            );
            assert!(!hints.concat().contains("`spectrum`"), "{hints:?}");
        }
    }

    #[test]
    fn only_codes_with_clauses_are_known() {
        let words = [("code", "asce8")].into_iter().collect();
        let problems = Target::for_parts(&words).unwrap_err().problems;
        let hint = "known: as1170.4, eurocode8, asce7, nzs1170.5, ntc2018, tbdy2018, ts1170.5";
        assert_eq!(problems[0].hint.as_deref(), Some(hint));
    }
}
