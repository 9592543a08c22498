//! Places by name, with the hazard that the code of their country gives them and its source.

use std::sync::LazyLock;

use freestand::code_spectrum::NationalAnnex;
use freestand_input::words::{canonical, number};
use freestand_output::answer_of;

/// A place, and what its code says about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Its name.
    pub name: &'static str,
    /// Other names, separated by commas.
    other_names: &'static str,
    /// The state, as its two letters; empty outside the United States.
    pub region: &'static str,
    /// The country.
    pub country: &'static str,
    /// The hazard in the terms of the code.
    pub hazard: PlaceHazard,
    /// The source of the values.
    pub source: &'static str,
    /// How far the values can be trusted.
    pub confidence: Confidence,
}

/// The hazard of a place in the terms of its code.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PlaceHazard {
    /// AS 1170.4.
    As1170_4 {
        /// Hazard design factor Z.
        hazard_factor: f64,
    },
    /// NZS 1170.5.
    Nzs1170_5 {
        /// Hazard factor Z.
        hazard_factor: f64,
        /// Distance to the nearest fault; [`FAR_KM`] stands for more \[km\].
        fault_distance_km: f64,
    },
    /// ASCE 7-16, risk-targeted maximum considered earthquake, class B/C.
    Asce7 {
        /// Mapped acceleration at short periods \[g\].
        ss_g: f64,
        /// Mapped acceleration at 1 s \[g\].
        s1_g: f64,
    },
    /// Eurocode 8.
    Eurocode8 {
        /// Reference ground acceleration on rock a_gR, of type 1 where the annex has two \[g\].
        ground_acceleration_g: f64,
        /// That of type 2, where the national annex has both \[g\].
        type2_ground_acceleration_g: Option<f64>,
        /// The national annex; `None`: it was not read, and the shape is the recommended one.
        annex: Option<NationalAnnex>,
    },
}

/// The distance to a fault from which it has no effect in NZS 1170.5 \[km\].
pub const FAR_KM: f64 = 20.0;

impl PlaceHazard {
    /// The name of the code in flags and studies.
    pub fn code(&self) -> &'static str {
        match self {
            Self::As1170_4 { .. } => "as1170.4",
            Self::Nzs1170_5 { .. } => "nzs1170.5",
            Self::Asce7 { .. } => "asce7",
            Self::Eurocode8 { .. } => "eurocode8",
        }
    }

    /// The name of the code in print.
    pub fn code_title(&self) -> &'static str {
        match self {
            Self::As1170_4 { .. } => "AS 1170.4",
            Self::Nzs1170_5 { .. } => "NZS 1170.5",
            Self::Asce7 { .. } => "ASCE 7-16",
            Self::Eurocode8 { .. } => "Eurocode 8",
        }
    }

    /// The values with their symbols: `Z = 0.08`, `Ss = 1.976 g, S1 = 0.704 g`.
    pub fn words(&self) -> String {
        match self {
            Self::As1170_4 { hazard_factor } => format!("Z = {}", number(*hazard_factor, 4)),
            Self::Nzs1170_5 {
                hazard_factor,
                fault_distance_km,
            } => {
                format!(
                    "Z = {}, {}",
                    number(*hazard_factor, 4),
                    fault_words(*fault_distance_km)
                )
            }
            Self::Asce7 { ss_g, s1_g } => {
                format!("Ss = {} g, S1 = {} g", number(*ss_g, 4), number(*s1_g, 4))
            }
            Self::Eurocode8 {
                ground_acceleration_g,
                type2_ground_acceleration_g,
                annex,
            } => {
                let one = format!("a_gR = {} g", number(*ground_acceleration_g, 4));
                let two = type2_ground_acceleration_g.map_or_else(String::new, |two| {
                    format!(" (type 1), {} g (type 2)", number(two, 4))
                });
                let corner = match annex {
                    Some(NationalAnnex::Romania { corner_period_s }) => {
                        format!(" (225 years), TC = {} s", number(*corner_period_s, 4))
                    }
                    _ => String::new(),
                };
                format!("{one}{two}{corner}")
            }
        }
    }

    /// The values of a row of the table: numbers, then names with values (`fault=6`, `annex=pt`).
    fn parse(code: &str, values: &str) -> Option<Self> {
        let (named, numbers): (Vec<&str>, Vec<&str>) = values
            .split(',')
            .map(str::trim)
            .partition(|value| value.contains('='));
        let numbers: Vec<f64> = numbers
            .into_iter()
            .map(str::parse)
            .collect::<Result<_, _>>()
            .ok()?;
        let named: Vec<(&str, &str)> = named
            .into_iter()
            .filter_map(|value| value.split_once('='))
            .collect();
        let eurocode8 =
            |ground_acceleration_g, type2_ground_acceleration_g, annex| Self::Eurocode8 {
                ground_acceleration_g,
                type2_ground_acceleration_g,
                annex,
            };
        match (code, numbers.as_slice(), named.as_slice()) {
            ("as1170.4", &[hazard_factor], []) => Some(Self::As1170_4 { hazard_factor }),
            ("nzs1170.5", &[hazard_factor], [("fault", km)]) => Some(Self::Nzs1170_5 {
                hazard_factor,
                fault_distance_km: km.parse().ok()?,
            }),
            ("asce7", &[ss_g, s1_g], []) => Some(Self::Asce7 { ss_g, s1_g }),
            ("eurocode8", &[a_g], []) => Some(eurocode8(a_g, None, None)),
            ("eurocode8", &[a_g], [("annex", "fr")]) => {
                Some(eurocode8(a_g, None, Some(NationalAnnex::France)))
            }
            ("eurocode8", &[a_g, two], [("annex", "pt")]) => {
                Some(eurocode8(a_g, Some(two), Some(NationalAnnex::Portugal)))
            }
            ("eurocode8", &[a_g], [("annex", "ro"), ("tc", corner)]) => {
                let corner_period_s = corner.parse().ok()?;
                let annex = NationalAnnex::Romania { corner_period_s };
                Some(eurocode8(a_g, None, Some(annex)))
            }
            _ => None,
        }
    }

    /// Whether its code has factors for several return periods.
    pub fn takes_return_period(&self) -> bool {
        matches!(self, Self::As1170_4 { .. } | Self::Nzs1170_5 { .. })
    }

    /// Its return period \[years\], where its code has one alone.
    pub fn return_period_years(&self) -> Option<u32> {
        match self {
            Self::Eurocode8 { annex, .. } => {
                Some(annex.map_or(EUROCODE_YEARS, NationalAnnex::return_period_years))
            }
            _ => None,
        }
    }
}

/// The return period of a_gR that EN 1998-1, 2.1, recommends \[years\].
const EUROCODE_YEARS: u32 = 475;

/// `a fault 6 km away`, `no fault within 20 km`.
fn fault_words(fault_distance_km: f64) -> String {
    if fault_distance_km >= FAR_KM {
        format!("no fault within {} km", number(FAR_KM, 3))
    } else {
        format!("a fault {} km away", number(fault_distance_km, 3))
    }
}

/// How far the values of a place can be trusted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum Confidence {
    /// Read in a public source.
    Read,
    /// Recalled: every output asks the reader to confirm it.
    Approximate,
}

impl Confidence {
    /// The name in outputs.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// All places, in the order of the table: Australia, the United States, New Zealand, Europe.
pub fn places() -> &'static [Place] {
    static PLACES: LazyLock<Vec<Place>> = LazyLock::new(|| rows().filter_map(read).collect());
    &PLACES
}

/// The rows of the table.
fn rows() -> impl Iterator<Item = &'static str> {
    include_str!("places.csv")
        .lines()
        .filter(|line| !line.starts_with('#') && !line.is_empty())
}

fn read(row: &'static str) -> Option<Place> {
    let fields: Vec<&str> = row.split(';').map(str::trim).collect();
    let &[
        name,
        other_names,
        region,
        country,
        code,
        values,
        source,
        confidence,
    ] = fields.as_slice()
    else {
        return None;
    };
    let hazard = PlaceHazard::parse(code, values)?;
    let confidence = [Confidence::Read, Confidence::Approximate]
        .into_iter()
        .find(|one| one.name() == confidence)?;
    Some(Place {
        name,
        other_names,
        region,
        country,
        hazard,
        source,
        confidence,
    })
}

impl Place {
    /// The place with this name. Capitals, accents and punctuation do not matter; the state or the
    /// country may follow: `Charleston, SC`, `Wellington New Zealand`.
    ///
    /// # Example
    /// ```
    /// use freestand_study::places::{Place, PlaceHazard};
    /// let place = Place::find("zürich").unwrap();
    /// assert_eq!((place.name, place.country), ("Zurich", "Switzerland"));
    /// assert!(matches!(place.hazard, PlaceHazard::Eurocode8 { ground_acceleration_g: 0.06, .. }));
    /// assert_eq!(Place::find("Atlantis"), None);
    /// ```
    pub fn find(name: &str) -> Option<&'static Self> {
        let wanted = canonical(name);
        places().iter().find(|place| {
            place.names().any(|name| {
                let name = canonical(name);
                wanted.strip_prefix(&name).is_some_and(|rest| {
                    let rest = rest.trim_start();
                    rest.is_empty()
                        || rest == canonical(place.region)
                        || rest == canonical(place.country)
                })
            })
        })
    }

    fn names(&self) -> impl Iterator<Item = &'static str> {
        std::iter::once(self.name)
            .chain(self.other_names.split(',').filter(|name| !name.is_empty()))
    }

    /// The state, where it has one, and the country.
    pub fn whereabouts(&self) -> String {
        if self.region.is_empty() {
            self.country.to_owned()
        } else {
            format!("{}, {}", self.region, self.country)
        }
    }

    /// What the reader must know about its values.
    pub fn doubt(&self) -> Option<String> {
        let has_shape = !matches!(self.hazard, PlaceHazard::Eurocode8 { annex: None, .. });
        (self.confidence == Confidence::Approximate).then(|| {
            let shape = if has_shape {
                ""
            } else {
                ", and the shape of its spectrum is the one that EN 1998-1 recommends, because the national annex was \
                 not read"
            };
            format!(
                "the hazard of {} ({}) is approximate{shape}: confirm it in the national annex before you rely on it",
                self.name,
                self.hazard.words()
            )
        })
    }
}

answer_of!(Place as place {
    name: &'static str;
    /// The state, in the United States.
    region: Option<&'static str> = Some(place.region).filter(|region| !region.is_empty());
    country: &'static str;
    code: &'static str = place.hazard.code();
    ss_g: Option<f64> = match place.hazard { PlaceHazard::Asce7 { ss_g, .. } => Some(ss_g), _ => None };
    s1_g: Option<f64> = match place.hazard { PlaceHazard::Asce7 { s1_g, .. } => Some(s1_g), _ => None };
    hazard_factor: Option<f64> = match place.hazard {
        PlaceHazard::As1170_4 { hazard_factor } | PlaceHazard::Nzs1170_5 { hazard_factor, .. } => Some(hazard_factor),
        _ => None,
    };
    ground_acceleration_g: Option<f64> = match place.hazard {
        PlaceHazard::Eurocode8 { ground_acceleration_g, .. } => Some(ground_acceleration_g),
        _ => None,
    };
    type2_ground_acceleration_g: Option<f64> = match place.hazard {
        PlaceHazard::Eurocode8 { type2_ground_acceleration_g, .. } => type2_ground_acceleration_g,
        _ => None,
    };
    annex: Option<&'static str> = match place.hazard {
        PlaceHazard::Eurocode8 { annex, .. } => annex.map(NationalAnnex::name),
        _ => None,
    };
    return_period_years: Option<u64> = place.hazard.return_period_years().map(u64::from);
    fault_distance_km: Option<f64> = match place.hazard {
        PlaceHazard::Nzs1170_5 { fault_distance_km, .. } => Some(fault_distance_km),
        _ => None,
    };
    source: &'static str;
    /// How far the values can be trusted.
    confidence: &'static str = place.confidence.name();
});

/// Up to three places that a misspelt name may mean, the nearest first: at most a third of the
/// letters differ, or the name begins with what was written.
///
/// # Example
/// ```
/// use freestand_study::places::near;
/// assert_eq!(near("Melborne"), ["Melbourne"]);
/// assert_eq!(near("san f"), ["San Francisco"]);
/// ```
pub fn near(name: &str) -> Vec<&'static str> {
    let wanted = canonical(name);
    let length = wanted.chars().count();
    let mut found: Vec<(usize, &'static str)> = Vec::new();
    for place in places() {
        let distance = place.names().filter_map(|name| {
            let name = canonical(name);
            let distance = strsim::levenshtein(&wanted, &name);
            let is_near = 3 * distance <= length.max(name.chars().count());
            (is_near || length >= 3 && name.starts_with(&wanted)).then_some(distance)
        });
        found.extend(distance.min().map(|distance| (distance, place.name)));
    }
    found.sort_by_key(|(distance, _)| *distance);
    found.into_iter().take(3).map(|(_, name)| name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_is_read_and_found_by_each_of_its_names() {
        assert_eq!(places().len(), rows().count());
        for place in places() {
            for name in place.names() {
                assert_eq!(
                    Place::find(name).map(|found| found.name),
                    Some(place.name),
                    "{name}"
                );
            }
            assert!(
                !place.country.is_empty() && !place.source.is_empty(),
                "{place:?}"
            );
            // No code has a larger value than Macquarie Island's 0.6 or Santa Rosa's 2.26 g.
            let values = match place.hazard {
                PlaceHazard::Asce7 { ss_g, s1_g } => {
                    assert!(ss_g > s1_g, "{place:?}");
                    [ss_g / 3.0, s1_g]
                }
                PlaceHazard::As1170_4 { hazard_factor: one }
                | PlaceHazard::Nzs1170_5 {
                    hazard_factor: one, ..
                }
                | PlaceHazard::Eurocode8 {
                    ground_acceleration_g: one,
                    ..
                } => [one, one],
            };
            assert!(
                values.into_iter().all(|value| value > 0.0 && value < 0.9),
                "{place:?}"
            );
        }
        let by_code = |code: &str| {
            places()
                .iter()
                .filter(|place| place.hazard.code() == code)
                .count()
        };
        assert_eq!(
            ["as1170.4", "asce7", "nzs1170.5", "eurocode8"].map(by_code),
            [42, 23, 13, 21]
        );
    }

    #[test]
    fn names_as_people_write_them() {
        for (written, name) in [
            ("melbourne", "Melbourne"),
            (" port HEDLAND ", "Port Hedland"),
            ("st louis", "St. Louis"),
            ("Saint Louis, MO", "St. Louis"),
            ("Charleston, SC", "Charleston"),
            ("L’Aquila", "L'Aquila"),
            ("Bâle", "Basel"),
            ("Taupō", "Taupo"),
            ("Kaiko\u{304}ura", "Kaikoura"),
            ("Wellington, New Zealand", "Wellington"),
            ("NYC", "New York"),
        ] {
            assert_eq!(
                Place::find(written).map(|place| place.name),
                Some(name),
                "{written}"
            );
        }
        for written in [
            "",
            "Charleston, WV",
            "Melbourne, FL",
            "Wellingtonia",
            "Athens, Greece, Europe",
        ] {
            assert_eq!(Place::find(written), None, "{written}");
        }
    }

    #[test]
    fn misspelt_names() {
        assert_eq!(near("Welington"), ["Wellington"]);
        assert_eq!(near("los angelos"), ["Los Angeles"]);
        assert!(near("qqqqq").is_empty() && near("").is_empty());
    }
}
