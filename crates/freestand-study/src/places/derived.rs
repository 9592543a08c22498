//! Values of a place at another return period than the one that was read, for screening.

use freestand_input::words::number;

use super::{Confidence, Place, PlaceHazard, TBDY_YEARS};

/// The return periods to which values are converted: the exponents were measured between them \[years\].
pub(crate) const CONVERTED_YEARS: [u32; 2] = [72, 2475];
/// The 95 % quantile of the standard normal distribution.
const NORMAL_95: f64 = 1.645;

/// How a value at one return period T was converted to another: a ∝ T^(1/k).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Derived {
    /// The return period of the value that was read \[years\].
    pub read_years: u32,
    /// That to which it was converted \[years\].
    pub years: u32,
    /// k, its smallest and its largest value.
    pub slopes: [f64; 3],
    /// The other return period that was read, where the values lie between both: they have no range then \[years\].
    pub between_years: Option<u32>,
}

impl Derived {
    fn by(self, slope: f64) -> f64 {
        (f64::from(self.years) / f64::from(self.read_years)).powf(slope.recip())
    }

    /// What the value that was read is multiplied by.
    pub fn ratio(&self) -> f64 {
        self.by(self.slopes[0])
    }

    /// The least and the most that this may be.
    pub fn range(&self) -> [f64; 2] {
        let [one, two] = [self.by(self.slopes[1]), self.by(self.slopes[2])];
        [one.min(two), one.max(two)]
    }

    /// The standard deviation of the logarithm of the value: the range is taken as the middle 90 % of a lognormal distribution.
    /// Nobody knows the exponent of a place beyond the places where it was measured, and the logarithm of the other factor on all
    /// ground motions is normal as well.
    pub fn ln_spread(&self) -> f64 {
        let [least, most] = self.range();
        (most / least).ln() / (2.0 * NORMAL_95)
    }

    /// `the value of 475 years × 1.73 (1.46 to 2.38)`
    pub fn words(&self) -> String {
        if let Some(other) = self.between_years {
            return format!(
                "between the values of {} and {other} years",
                self.read_years
            );
        }
        let [ratio, least, most] =
            [self.ratio(), self.range()[0], self.range()[1]].map(|one| number(one, 3));
        format!(
            "the value of {} years × {ratio} ({least} to {most})",
            self.read_years
        )
    }
}

/// k of a country with its range. For Türkiye it was measured on the grid of AFAD (14,036 nodes). EN 1998-1, 2.1, recommends 3,
/// which is also the median of the grid of Italy (10,751 nodes: 2.3 to 4.4); the range is that of all grids which were measured,
/// with New Zealand (3,740 points: 1.9 to 2.5).
fn slopes(hazard: PlaceHazard) -> [f64; 3] {
    match hazard {
        PlaceHazard::Tbdy2018 { .. } => [2.5, 1.9, 3.0],
        _ => [3.0, 1.9, 4.4],
    }
}

/// Why a place has no values at a return period.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum NotDerived {
    /// The values have none themselves.
    Unknown,
    /// It is too short or too long.
    Beyond,
}

impl Place {
    /// The place with its values at another return period than its own; `None` where its code has values or factors of its own.
    pub(crate) fn derived_at(&self, years: u32) -> Option<Result<Self, NotDerived>> {
        let read_years = match self.hazard {
            PlaceHazard::Eurocode8 { .. } | PlaceHazard::Shape { .. } => {
                match self.hazard.return_period_years() {
                    Some(own) => own,
                    None => return Some(Err(NotDerived::Unknown)),
                }
            }
            PlaceHazard::Tbdy2018 { .. } => {
                let away = |own: &u32| (f64::from(years) / f64::from(*own)).ln().abs();
                *TBDY_YEARS
                    .iter()
                    .min_by(|a, b| away(a).total_cmp(&away(b)))?
            }
            _ => return None,
        };
        if years == read_years {
            return None;
        }
        if !(CONVERTED_YEARS[0]..=CONVERTED_YEARS[1]).contains(&years) {
            return Some(Err(NotDerived::Beyond));
        }
        if let PlaceHazard::Tbdy2018 { ss_g, s1_g } = self.hazard
            && (TBDY_YEARS[0]..TBDY_YEARS[1]).contains(&years)
        {
            return Some(Ok(self.between(years, ss_g, s1_g)));
        }
        let derived = Derived {
            read_years,
            years,
            slopes: slopes(self.hazard),
            between_years: None,
        };
        let ratio = derived.ratio();
        let hazard = match self.hazard {
            PlaceHazard::Eurocode8 {
                ground_acceleration_g,
                type2_ground_acceleration_g,
                annex,
                only_type,
            } => PlaceHazard::Eurocode8 {
                ground_acceleration_g: ratio * ground_acceleration_g,
                type2_ground_acceleration_g: type2_ground_acceleration_g.map(|two| ratio * two),
                annex,
                only_type,
            },
            PlaceHazard::Shape {
                acceleration_g,
                is_on_site,
                corner_period_s,
                by,
                ..
            } => PlaceHazard::Shape {
                acceleration_g: ratio * acceleration_g,
                is_on_site,
                corner_period_s,
                by,
                return_period_years: Some(years),
            },
            PlaceHazard::Tbdy2018 { ss_g, s1_g } => {
                let level = usize::from(read_years == TBDY_YEARS[1]);
                PlaceHazard::Tbdy2018 {
                    ss_g: [ratio * ss_g[level]; 2],
                    s1_g: [ratio * s1_g[level]; 2],
                }
            }
            other => other,
        };
        let confidence = match self.confidence {
            // What was recalled is no better for being converted.
            Confidence::Approximate => Confidence::Approximate,
            _ => Confidence::Derived,
        };
        Some(Ok(Self {
            hazard,
            confidence,
            derived: Some(derived),
            ..self.clone()
        }))
    }

    /// The place of TBDY 2018 with values between those of its two return periods, on a line in logarithms.
    fn between(&self, years: u32, ss_g: [f64; 2], s1_g: [f64; 2]) -> Self {
        let [from, to] = TBDY_YEARS.map(f64::from);
        let slope = |[low, high]: [f64; 2]| (to / from).ln() / (high / low).ln();
        let derived = |values: [f64; 2]| Derived {
            read_years: TBDY_YEARS[0],
            years,
            slopes: [slope(values); 3],
            between_years: Some(TBDY_YEARS[1]),
        };
        let at = |values: [f64; 2]| [derived(values).ratio() * values[0]; 2];
        Self {
            hazard: PlaceHazard::Tbdy2018 {
                ss_g: at(ss_g),
                s1_g: at(s1_g),
            },
            confidence: Confidence::Interpolated,
            derived: Some(derived(ss_g)),
            ..self.clone()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: (2475/475)^(1/3) = 1.7336, with k = 1.9 and 4.4 2.384 and 1.455; ln(2.3840/1.4552)/3.29 = 0.1500. Athens has 0.16 g.
    #[test]
    fn another_return_period() {
        let athens = Place::find("Athens").unwrap().derived_at(2475).unwrap();
        let athens = athens.unwrap();
        let derived = athens.derived.unwrap();
        assert!((derived.ratio() - 1.7336).abs() < 5e-5);
        let [least, most] = derived.range();
        assert!((least - 1.455).abs() < 5e-4 && (most - 2.384).abs() < 5e-4);
        assert!((derived.ln_spread() - 0.1500).abs() < 5e-5);
        let PlaceHazard::Eurocode8 {
            ground_acceleration_g,
            ..
        } = athens.hazard
        else {
            panic!("{athens:?}");
        };
        assert!((ground_acceleration_g - 0.16 * 1.733_646).abs() < 1e-5);
        // A shorter one: the range is in its order as well.
        let lorca = Place::find("Lorca").unwrap().derived_at(100).unwrap();
        let lorca = lorca.unwrap();
        let derived = lorca.derived.unwrap();
        assert_eq!((derived.read_years, derived.years), (500, 100));
        let [least, most] = derived.range();
        assert!(least < derived.ratio() && derived.ratio() < most && most < 1.0);
        assert_eq!(lorca.confidence, Confidence::Derived);
        // What was approximate stays so.
        assert_eq!(athens.confidence, Confidence::Approximate);
    }

    #[test]
    fn what_is_not_converted() {
        let find = |name: &str| Place::find(name).unwrap();
        assert_eq!(find("Lorca").derived_at(500), None);
        assert_eq!(find("Istanbul").derived_at(2475), None);
        assert_eq!(find("Wellington").derived_at(100), None);
        assert_eq!(find("Roma").derived_at(100), None);
        assert_eq!(find("Lorca").derived_at(10), Some(Err(NotDerived::Beyond)));
        // Japan's level 2 has no return period.
        assert_eq!(
            find("Tokyo").derived_at(475),
            Some(Err(NotDerived::Unknown))
        );
    }

    /// TBDY 2018 has two levels: between them values lie on a line in logarithms, and rise with the return period.
    #[test]
    fn between_the_levels_of_tbdy() {
        let istanbul = Place::find("Istanbul").unwrap();
        let of = |place: &Place| match place.hazard {
            PlaceHazard::Tbdy2018 { ss_g, s1_g } => (ss_g, s1_g),
            _ => panic!("{place:?}"),
        };
        let (ss_g, s1_g) = of(&istanbul);
        // √(475·2475) = 1084.26 years is the middle: the geometric mean, but for the rounding of the years.
        let middle = istanbul.derived_at(1084).unwrap().unwrap();
        let (ss, s1) = of(&middle);
        assert!((ss[0] / (ss_g[0] * ss_g[1]).sqrt() - 1.0).abs() < 2e-4);
        assert!((s1[0] / (s1_g[0] * s1_g[1]).sqrt() - 1.0).abs() < 2e-4);
        assert_eq!(middle.confidence, Confidence::Interpolated);
        assert_eq!(middle.derived.unwrap().ln_spread(), 0.0);
        let mut before = ss_g[0];
        for years in (500..2475).step_by(25) {
            let (ss, _) = of(&istanbul.derived_at(years).unwrap().unwrap());
            assert!(before < ss[0] && ss[0] < ss_g[1], "{years}");
            before = ss[0];
        }
        // Outside of them they are converted.
        let short = istanbul.derived_at(100).unwrap().unwrap();
        assert_eq!(short.derived.unwrap().read_years, 475);
    }
}
