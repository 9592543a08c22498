//! The hazard target: from the words of flags and studies to a [`CodeSpectrum`].

mod code;
mod codes;
mod countries;
mod doubt;
mod downloaded;
mod named;
mod parts;
mod spectrum;
mod table;
mod words;

use std::path::Path;

use freestand::code_spectrum::{
    As1170_4, Asce7Edition, CodeSpectrum, CodeSpectrumError, GroundType, PeriodCode, SiteClass,
    SpectrumType,
};
use freestand::synthesis;

pub(crate) use code::Code;
pub use codes::DEFAULT_YEARS;
pub use doubt::{AnnexSpectrum, TargetDoubt};
pub(crate) use named::place_of;
pub use spectrum::{
    CodeParts, CodeSpectrumReport, PartsLevel, PartsReport, code_parts, code_spectrum,
    usual_periods_s,
};
use words::Remedies;
pub use words::period_code;
pub(crate) use words::{code_of, key_of_other_code};

use crate::places::{Confidence, Place, PlaceHazard};
use freestand_input::file::{InputFile, file_name};
use freestand_input::keys::Words;
use freestand_input::problem::{Problem, Problems};
use freestand_input::words::number;

/// A spectrum, with everything that outputs state about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Target {
    /// The spectrum, 5 % damping.
    pub spectrum: CodeSpectrum,
    /// The place whose hazard was used.
    pub place: Option<Place>,
    /// Whether nobody stated that place, nor a hazard in another way.
    pub place_is_assumed: bool,
    /// Its description and the sources of its numbers, for reports: name and value.
    pub facts: Vec<(String, String)>,
    /// The other spectrum of a national annex that has two: type 2 of Portugal. What happens to an
    /// object is calculated for both, and the worse counts; `spectrum` has the larger velocity.
    pub alternative: Option<CodeSpectrum>,
    /// The edition of ASCE 7 in force for parts at the place, where it is not that of the hazard.
    pub parts_edition: Option<Asce7Edition>,
    /// The file of a table.
    pub file: Option<InputFile>,
    /// A table as text, for outputs that need no other file: reading it gives the same bits.
    pub table_csv: Option<String>,
    /// What the reader must know.
    pub doubts: Vec<TargetDoubt>,
    /// What the reader must know about periods above about 1 s, and about nothing else;
    /// [`Self::resolve`] adds it to the others.
    period_doubts: Vec<TargetDoubt>,
}

impl Target {
    /// The spectrum that words with the keys of a spectrum describe, with its facts; paths are
    /// relative to `base_dir`.
    ///
    /// # Errors
    /// Everything that is wrong with the words.
    ///
    /// # Example
    /// ```
    /// use freestand_input::keys::Words;
    /// use freestand_study::target::Target;
    /// let mut words = Words::default();
    /// words.set("code", "eurocode8");
    /// words.set("spectrum_type", "2");
    /// words.set("site", "B");
    /// words.set("ground_acceleration", "0.1 g");
    /// let target = Target::resolve(&words, "".as_ref())?;
    /// assert!((target.spectrum.sa_g(0.1) - 0.3375).abs() < 1e-15); // 2.5 · 0.1 g · 1.35
    /// # Ok::<(), freestand_input::problem::Problems>(())
    /// ```
    pub fn resolve(words: &Words, base_dir: &Path) -> Result<Self, Problems> {
        Self::resolve_as(words, base_dir, Remedies::Codes)
    }

    /// As [`Target::resolve`], of words beside which nobody can name a code or its values: no remedy does.
    ///
    /// # Errors
    /// As [`Target::resolve`].
    pub fn resolve_place(words: &Words) -> Result<Self, Problems> {
        Self::resolve_as(words, Path::new(""), Remedies::PlaceAlone)
    }

    fn resolve_as(words: &Words, base_dir: &Path, remedies: Remedies) -> Result<Self, Problems> {
        let of_file = downloaded::resolve(words, base_dir, remedies);
        let found = of_file.unwrap_or_else(|| words::resolve(words, base_dir, remedies));
        found.map(|mut target| {
            target.doubts.append(&mut target.period_doubts);
            target
        })
    }

    /// The spectrum that Eurocode 8 recommends, with importance factor 1; `ground_acceleration_g` is a_gR,
    /// on rock.
    ///
    /// # Errors
    /// An acceleration that is not positive.
    pub fn eurocode8(
        spectrum_type: SpectrumType,
        ground: GroundType,
        ground_acceleration_g: f64,
    ) -> Result<Self, CodeSpectrumError> {
        codes::recommended_eurocode8(spectrum_type, ground, ground_acceleration_g)
    }

    /// The code of the periods of buildings that goes with it.
    pub(crate) fn period_code(&self) -> Option<PeriodCode> {
        words::period_code_named(self.code())
    }

    /// The name of the code in flags and studies.
    pub fn code(&self) -> &'static str {
        Code::of(&self.spectrum).name()
    }

    /// Its return period \[years\], where its code or its place has one.
    pub fn return_period_years(&self) -> Option<u32> {
        let derived = self.place.as_ref().and_then(|place| place.derived);
        derived
            .map(|derived| derived.years)
            .or_else(|| self.spectrum.return_period_years())
    }

    /// The standard deviation of the logarithm of a hazard that was derived from another return period; 0 for one that was read.
    pub fn hazard_spread(&self) -> f64 {
        let derived = self.place.as_ref().and_then(|place| place.derived);
        derived.map_or(0.0, |derived| derived.ln_spread())
    }

    /// Its place, where the hazard of that is approximate.
    pub fn approximate_place(&self) -> Option<&Place> {
        let is_approximate = |place: &&Place| place.confidence == Confidence::Approximate;
        self.place.as_ref().filter(is_approximate)
    }

    /// The name of the place whose hazard was used.
    pub fn place_name(&self) -> Option<String> {
        self.place.as_ref().map(Place::told_name)
    }

    /// Hazard factor Z, if the code has one \[g\].
    pub fn hazard_factor(&self) -> Option<f64> {
        match &self.spectrum {
            CodeSpectrum::As1170_4(code) => Some(code.hazard_factor()),
            CodeSpectrum::Nzs1170_5(code) => Some(code.hazard_factor()),
            _ => None,
        }
    }

    /// The spectrum by AS 1170.4, if it is one.
    pub fn as1170_4(&self) -> Option<&As1170_4> {
        if let CodeSpectrum::As1170_4(code) = &self.spectrum {
            Some(code)
        } else {
            None
        }
    }

    /// The site class of AS 1170.4.
    pub fn site_class(&self) -> Option<SiteClass> {
        Some(self.as1170_4()?.site())
    }

    /// kp·Z of AS 1170.4 \[g\].
    pub fn kpz_g(&self) -> Option<f64> {
        Some(self.as1170_4()?.kpz_g())
    }

    /// The spectrum that asks more of parts: of two, the one with the larger acceleration of the ground.
    pub fn parts_spectrum(&self) -> &CodeSpectrum {
        let larger = self
            .alternative
            .as_ref()
            .filter(|other| other.sa_g(0.0) > self.spectrum.sa_g(0.0));
        larger.unwrap_or(&self.spectrum)
    }

    /// Whether the clauses of its code for parts are those of the place: a place of which the spectrum has only the shape of
    /// Eurocode 8 has a code of its own.
    pub fn has_parts(&self) -> bool {
        let hazard = self.place.as_ref().map(|place| place.hazard);
        !matches!(hazard, Some(PlaceHazard::Shape { .. }))
    }

    /// The type of its spectrum, by Eurocode 8.
    pub fn spectrum_type(&self) -> Option<u8> {
        spectrum_type(&self.spectrum)
    }

    /// The type of the other spectrum of the national annex, where that has two.
    pub fn other_type(&self) -> Option<u8> {
        spectrum_type(self.alternative.as_ref()?)
    }

    /// On one line: `AS 1170.4-2007 (Amdt 1, 2), site De, Z = 0.08 (Melbourne), 500 years, kpZ =
    /// 0.08 g`.
    pub fn one_line(&self) -> String {
        format!("{}, {}", self.spectrum.name(), self.parameters())
    }

    /// The parameters on one line, without the code.
    pub fn parameters(&self) -> String {
        let place = self.place_in_brackets();
        match &self.spectrum {
            CodeSpectrum::As1170_4(code) => format!(
                "site {}, Z = {}{place}, {} years, kpZ = {} g",
                code.site().name(),
                number(code.hazard_factor(), 6),
                code.return_period_years(),
                number(code.kpz_g(), 4)
            ),
            CodeSpectrum::Eurocode8(code) => format!(
                "type {}, ground {}, a_g = {} g{place}",
                code.spectrum_type().number(),
                code.ground().map_or("not given", |ground| ground.name()),
                number(code.ground_acceleration_g(), 4)
            ),
            CodeSpectrum::Asce7(code) => format!(
                "{}SDS = {} g, SD1 = {} g{place}, TL = {} s",
                code.site()
                    .map_or_else(String::new, |site| format!("site {}, ", site.name())),
                number(code.sds_g(), 4),
                number(code.sd1_g(), 4),
                number(code.long_period_s(), 4)
            ),
            CodeSpectrum::Nzs1170_5(code) => {
                let near = match code.fault_distance_km() {
                    Some(km) if code.is_near_fault() => {
                        format!(", a fault {} km away", number(km, 4))
                    }
                    _ => String::new(),
                };
                format!(
                    "site {}, Z = {}{place}, {} years, Z R = {} g{near}",
                    code.site().name(),
                    number(code.hazard_factor(), 6),
                    code.return_period_years(),
                    number(code.zr_g(), 4)
                )
            }
            CodeSpectrum::Ntc2018(code) => {
                let hazard = code.hazard();
                format!(
                    "ground {}, {}, ag = {} g{place}, F0 = {}, Tc* = {} s, {} years",
                    code.ground().name(),
                    code.topography().name(),
                    number(hazard.ag_g, 4),
                    number(hazard.f0_ratio, 4),
                    number(hazard.tc_star_s, 3),
                    code.return_period_years()
                )
            }
            CodeSpectrum::Tbdy2018(code) => {
                let [ss, s1] = code.mapped_g().map(|value| number(value, 4));
                let years = code
                    .return_period_years()
                    .map_or_else(String::new, |years| format!(", {years} years"));
                format!(
                    "site {}, Ss = {ss} g, S1 = {s1} g{place}{years}",
                    code.site().name()
                )
            }
            CodeSpectrum::Ts1170_5(code) => {
                let values = code.values();
                format!(
                    "site {}, PGA = {} g, Sa,s = {} g{place}, {} years",
                    code.site().name(),
                    number(values.pga_g, 4),
                    number(values.sas_g, 4),
                    code.return_period_years()
                )
            }
            CodeSpectrum::Table(table) => format!(
                "{}, {} periods from {} s to {} s",
                self.file_name(),
                table.periods_s().len(),
                number(table.first_period_s(), 4),
                number(table.last_period_s(), 4)
            ),
        }
    }

    /// ` (Melbourne)`, ` (Athens, approximate, derived)`; empty without a place.
    fn place_in_brackets(&self) -> String {
        match &self.place {
            None => String::new(),
            Some(place) => {
                let approximate = match place.confidence {
                    Confidence::Approximate => ", approximate",
                    _ => "",
                };
                let derived = match place.derived.map(|derived| derived.between_years) {
                    None => "",
                    Some(None) => ", derived",
                    Some(Some(_)) => ", interpolated",
                };
                format!(" ({}{approximate}{derived})", place.short_name())
            }
        }
    }

    /// The site that the plateau of the spectrum belongs to: `site class De`.
    pub fn site_words(&self) -> String {
        match (&self.spectrum, self.spectrum.site_name()) {
            (CodeSpectrum::Eurocode8(_) | CodeSpectrum::Ntc2018(_), Some(ground)) => {
                format!("ground type {ground}")
            }
            (_, Some(class)) => format!("site class {class}"),
            (CodeSpectrum::Table(_), None) => "this table (its largest value)".to_owned(),
            (_, None) => "this spectrum".to_owned(),
        }
    }

    /// Refuses a spectrum that does not cover all the periods that motions are matched at.
    ///
    /// # Errors
    /// A table that is shorter and that does not extend beyond its ends.
    pub fn check_matched_band(&self) -> Result<(), Problem> {
        let (from_s, to_s) = (
            self.spectrum.shortest_period_s(),
            self.spectrum.longest_period_s(),
        );
        if from_s <= 0.0 && to_s.is_none_or(|to_s| to_s >= synthesis::LONGEST_PERIOD_S) {
            return Ok(());
        }
        let range = match to_s {
            Some(to_s) => format!("{} s to {} s", number(from_s, 4), number(to_s, 4)),
            None => format!("{} s and more", number(from_s, 4)),
        };
        let message = format!(
            "the spectrum {} covers {range}; motions are matched from {} s to {} s, and their PGA to the value at 0 s",
            self.file_name(),
            synthesis::SHORTEST_PERIOD_S,
            synthesis::LONGEST_PERIOD_S
        );
        let hint = "add the missing periods (0 s is the peak acceleration), or give `beyond = \"hold\"` for constant \
                    Sa below the first period and constant displacement beyond the last";
        Err(Problem::value(message, hint))
    }

    /// The peak acceleration that motions can be scaled to: the value at T = 0 \[g\].
    ///
    /// # Errors
    /// A table that begins above T = 0: its extension to T = 0 is a plateau, not a peak acceleration.
    pub fn peak_g(&self) -> Result<f64, Problem> {
        match &self.spectrum {
            CodeSpectrum::Table(table) if table.first_period_s() > 0.0 => {
                let first_s = table.first_period_s();
                let message =
                    format!("the table begins at {first_s} s and has no peak acceleration");
                let hint = "add a row with a period of 0 s, the peak acceleration, or leave `match_pga` out";
                Err(Problem::value(message, hint))
            }
            spectrum => Ok(spectrum.sa_g(0.0)),
        }
    }

    /// The name of the table's file.
    pub fn file_name(&self) -> String {
        let name = self.file.as_ref().and_then(|file| file_name(&file.path));
        name.unwrap_or_else(|| "of the user".to_owned())
    }
}

/// The type of a spectrum by Eurocode 8.
fn spectrum_type(spectrum: &CodeSpectrum) -> Option<u8> {
    match spectrum {
        CodeSpectrum::Eurocode8(code) => Some(code.spectrum_type().number()),
        _ => None,
    }
}

#[cfg(test)]
mod tests;
