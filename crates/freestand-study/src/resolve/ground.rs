//! `[ground]` as meant.

use freestand::code_spectrum::{
    CodeSpectrum, Edition, SiteClass, hazard_factor, hazard_factor_places, minimum_kpz, probability_factor,
};

use super::{MAX_MOTIONS, Overrides, Resolver, or};
use crate::options::{GroundOptions, Written, nearest};
use crate::quantity::{Dimension, shorten};
use crate::recorded::{MotionFiles, read_recorded};
use crate::records::ReadOptions;
use crate::study::{Ground, SyntheticGround};

impl Resolver<'_> {
    pub(super) fn ground(&mut self, written: &GroundOptions, overrides: &Overrides) -> Option<Ground> {
        if let Some(files) = &overrides.motions {
            return self.recorded(files, None);
        }
        let Some(motions) = &written.motions else {
            for (key, line) in [
                ("unit", written.unit.as_ref().map(|w| w.line)),
                ("dt", written.dt_s.as_ref().map(|w| w.line)),
                ("component", written.component.as_ref().map(|w| w.line)),
                ("station_xml", written.station_xml.as_ref().map(|w| w.line)),
                ("scale", written.scale.as_ref().map(|w| w.line)),
                ("processing", written.processing.as_ref().map(|w| w.line)),
            ] {
                if line.is_some() {
                    self.note(line, format!("{key} goes with motions"), "name the files: motions = [\"record.AT2\"]");
                }
            }
            return self.synthetic(written, overrides);
        };
        self.exclusive(("code", &written.code), ("motions", &written.motions));
        self.exclusive(("city", &written.city), ("motions", &written.motions));
        self.exclusive(("hazard_factor", &written.hazard_factor), ("motions", &written.motions));
        self.exclusive(("site", &written.site), ("motions", &written.motions));
        self.exclusive(("return_period_years", &written.return_period_years), ("motions", &written.motions));
        self.exclusive(("edition", &written.edition), ("motions", &written.motions));
        self.exclusive(("count", &written.count), ("motions", &written.motions));
        self.exclusive(("seed", &written.seed), ("motions", &written.motions));
        let before = self.problems.len();
        let unit_only = ReadOptions { unit: written.unit.clone().map(|unit| unit.value), ..ReadOptions::default() };
        let dt_only = ReadOptions { dt_s: written.dt_s.as_ref().map(|dt| dt.value), ..ReadOptions::default() };
        let lines = [written.unit.as_ref().map(|w| w.line), written.dt_s.as_ref().map(|w| w.line)];
        for ((key, line), options) in ["unit", "dt"].into_iter().zip(lines).zip([&unit_only, &dt_only]) {
            if let Err(problem) = options.check() {
                self.note(line, format!("{key}: {}", problem.message), problem.hint.unwrap_or_default());
            }
        }
        let processing = self.processing(written);
        if motions.value.is_empty() {
            self.note(Some(motions.line), "motions is empty", "name at least one file, or leave motions out");
            return None;
        }
        // Files read without what was refused would only be refused for the lack of it.
        if written.is_incomplete || self.problems.len() > before {
            return None;
        }
        let files = MotionFiles {
            paths: motions.value.iter().map(|file| self.base_dir.join(&file.value)).collect(),
            read: ReadOptions {
                unit: unit_only.unit,
                uneven_dt_s: processing.resample_dt_s,
                station_xml: written.station_xml.as_ref().map(|file| self.base_dir.join(&file.value)),
                ..dt_only
            },
            component: written.component.as_ref().map(|w| w.value.clone()),
            processing,
        };
        let lines: Vec<usize> = motions.value.iter().map(|file| file.line).collect();
        self.recorded(&files, Some(&lines))
    }

    /// Reads files; a file that is missing is a fault of the study's line, one that is broken of the file's.
    fn recorded(&mut self, files: &MotionFiles, lines: Option<&[usize]>) -> Option<Ground> {
        let (motions, failures) = read_recorded(files);
        let all_read = failures.is_empty();
        for (index, mut problem) in failures {
            if let (Some(line), Some(source), None) =
                (lines.and_then(|lines| lines.get(index)), self.source, problem.line)
            {
                problem.message = format!("motions: {problem}");
                problem.path = Some(source.to_path_buf());
                problem.line = Some(*line);
            }
            self.problems.push(problem);
        }
        for motion in &motions {
            self.warnings.extend(motion.notes.iter().map(|note| format!("{}: {note}", motion.motion.name)));
        }
        all_read.then(|| Ground::Recorded(motions.into_iter().map(|read| read.motion).collect()))
    }

    fn synthetic(&mut self, written: &GroundOptions, overrides: &Overrides) -> Option<Ground> {
        if let Some(Written { value, line }) = &written.code
            && !matches!(value.to_lowercase().as_str(), "as1170.4" | "as 1170.4")
        {
            self.note(Some(*line), format!("code \"{}\" is not known", shorten(value)), "known: \"as1170.4\"");
        }
        self.require(&written.edition, |edition| edition == 2007, "edition", "2007 (with Amendments 1 and 2)");
        self.require(
            &written.count,
            |count| (1..=MAX_MOTIONS).contains(&count),
            "count",
            "a whole number from 1 to 1000",
        );
        self.exclusive(("city", &written.city), ("hazard_factor", &written.hazard_factor));
        let (hazard, city) = match (&written.hazard_factor, &written.city) {
            (Some(hazard), _) => (Some(hazard.value), None),
            (None, Some(city)) => {
                let places: Vec<&str> = hazard_factor_places().collect();
                let place = places.iter().find(|place| place.eq_ignore_ascii_case(city.value.trim()));
                if place.is_none() {
                    let hint = match nearest(&city.value, &places) {
                        Some(near) => format!("did you mean \"{near}\"?"),
                        None => {
                            "give hazard_factor instead; the code's table has Melbourne, Sydney, Adelaide, Perth, …"
                                .to_owned()
                        }
                    };
                    self.note(Some(city.line), format!("city \"{}\" is not in AS 1170.4", shorten(&city.value)), hint);
                }
                (hazard_factor(&city.value), place.map(|&place| place.to_owned()))
            }
            (None, None) => (hazard_factor("Melbourne"), Some("Melbourne".to_owned())),
        };
        let site = match &written.site {
            None => Some(SiteClass::De),
            Some(Written { value, line }) => {
                let site = SiteClass::parse(value).ok();
                if site.is_none() {
                    self.note(
                        Some(*line),
                        format!("site \"{}\" is not a class of AS 1170.4", shorten(value)),
                        "Ae strong rock, Be rock, Ce shallow soil, De deep or soft soil, Ee very soft soil",
                    );
                }
                site
            }
        };
        // A number beyond u32 is no period of the code's table either.
        let years = u32::try_from(or(&written.return_period_years, 500)).unwrap_or(u32::MAX);
        // Each value on its own, so that one that is wrong does not hide another.
        const TABLES: &str = "see Tables 3.1 and 3.2 of AS 1170.4";
        if let Err(error) = probability_factor(years) {
            self.note(written.return_period_years.as_ref().map(|w| w.line), error.to_string(), TABLES);
        }
        self.positive(&written.hazard_factor, "hazard_factor", Dimension::Ratio);
        let spectrum = CodeSpectrum::new(Edition::default(), site?, hazard?, years).ok()?;
        self.warnings.extend(minimum_governs_warning(&spectrum));
        // Beyond, the count was refused above; its names are still listed.
        let count = usize::try_from(or(&written.count, 10).min(MAX_MOTIONS)).unwrap_or_default();
        Some(Ground::Synthetic(SyntheticGround {
            spectrum,
            city,
            count,
            seed: overrides.seed.unwrap_or(or(&written.seed, 1)),
        }))
    }
}

/// Says where the code's least kpZ took the place of the product.
pub fn minimum_governs_warning(spectrum: &CodeSpectrum) -> Option<String> {
    let least = minimum_kpz(spectrum.return_period_years()).filter(|_| spectrum.minimum_governs())?;
    Some(format!(
        "the code's minimum kpZ of {least} for {} years governs: Z = {} alone would give less",
        spectrum.return_period_years(),
        spectrum.hazard_factor()
    ))
}
