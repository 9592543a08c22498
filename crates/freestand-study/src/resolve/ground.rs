//! `[ground]` as meant.

use freestand::code_spectrum::{
    As1170_4, Edition, SiteClass, hazard_factor, hazard_factor_places, minimum_kpz, probability_factor,
};

use super::recorded::reading_keys;
use super::{MAX_MOTIONS, Overrides, Resolver, or};
use crate::options::{GroundOptions, Written, nearest};
use crate::quantity::{Dimension, shorten};
use crate::study::{Ground, SyntheticGround};

impl Resolver<'_> {
    pub(super) fn ground(&mut self, written: &GroundOptions, overrides: &Overrides) -> Option<Ground> {
        if let Some(files) = &overrides.motions {
            return self.read(files, None).map(Ground::Recorded);
        }
        let Some(motions) = &written.motions else {
            for (key, line) in reading_keys(written) {
                if line.is_some() {
                    self.note(line, format!("{key} goes with motions"), "name the files: motions = [\"record.AT2\"]");
                }
            }
            return self.synthetic(written, overrides);
        };
        for (key, line) in synthetic_keys(written) {
            if let Some(line) = line {
                let message = format!("{key} and motions exclude each other");
                self.note(Some(line.max(motions.line)), message, "keep one of them");
            }
        }
        self.motions(written, motions, &written.across).map(Ground::Recorded)
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
        let spectrum = As1170_4::new(Edition::default(), site?, hazard?, years).ok()?;
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

/// The keys of `[ground]` that describe synthetic motions, with their lines.
pub(super) fn synthetic_keys(written: &GroundOptions) -> [(&'static str, Option<usize>); 8] {
    [
        ("code", written.code.as_ref().map(|w| w.line)),
        ("city", written.city.as_ref().map(|w| w.line)),
        ("hazard_factor", written.hazard_factor.as_ref().map(|w| w.line)),
        ("site", written.site.as_ref().map(|w| w.line)),
        ("return_period_years", written.return_period_years.as_ref().map(|w| w.line)),
        ("edition", written.edition.as_ref().map(|w| w.line)),
        ("count", written.count.as_ref().map(|w| w.line)),
        ("seed", written.seed.as_ref().map(|w| w.line)),
    ]
}

/// Says where the code's least kpZ took the place of the product.
pub fn minimum_governs_warning(spectrum: &As1170_4) -> Option<String> {
    let least = minimum_kpz(spectrum.return_period_years()).filter(|_| spectrum.minimum_governs())?;
    Some(format!(
        "the code's minimum kpZ of {least} for {} years governs: Z = {} alone would give less",
        spectrum.return_period_years(),
        spectrum.hazard_factor()
    ))
}
