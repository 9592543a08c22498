//! Places by name or by coordinates, with the hazard that the code of their country gives them and its source.

mod cities;
mod derived;
mod find;
mod grid;
mod rows;

use std::borrow::Cow;

use freestand::code_spectrum::{NationalAnnex, NtcHazard, SpectrumType, TsSite, TsValues};
use freestand_input::words::number;
use freestand_output::answer_of;
pub use freestand_records::tables::hazard::{Coordinates, NTC_YEARS};
use strum::EnumCount;

pub use derived::Derived;
pub(crate) use derived::{CONVERTED_YEARS, NotDerived};
pub use find::{NotFound, Unlisted, coordinates, is_country, nearest, wanted_site};
pub use grid::ntc_hazard;
pub use rows::places;

/// Whether a point of the grid of Italy may lie in France, Switzerland, Austria or Slovenia, or in San Marino: north of the
/// plain of the Po, or west of Savona. The grid has no border, and its cells reach some kilometres beyond it.
fn is_near_the_border_of_italy(at: Coordinates) -> bool {
    let is_san_marino =
        (43.89..43.995).contains(&at.latitude_deg) && (12.40..12.52).contains(&at.longitude_deg);
    at.latitude_deg > 45.3 || at.longitude_deg < 7.8 || is_san_marino
}

/// A place, and what its code says about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Place {
    /// Its name; of a point, its coordinates.
    pub name: Cow<'static, str>,
    /// Other names, separated by commas.
    pub(crate) other_names: &'static str,
    /// The state, as its two letters, in the United States; elsewhere what tells places of one name apart.
    pub region: &'static str,
    /// The country.
    pub country: &'static str,
    /// What it is: a name means the largest.
    pub(crate) size: Size,
    /// The hazard in the terms of the code.
    pub hazard: PlaceHazard,
    /// The source of the values.
    pub source: Cow<'static, str>,
    /// How far the values can be trusted.
    pub confidence: Confidence,
    /// Where it is, where that is known.
    pub coordinates: Option<Coordinates>,
    /// From the coordinates that were asked for to it; of a point, to the nearest node of the grid \[km\].
    pub distance_km: Option<f64>,
    /// To the nearest major fault, where the table of its code has that; [`FAR_KM`] stands for more \[km\].
    pub fault_distance_km: Option<f64>,
    /// How its values were converted from the return period at which they were read, if they were.
    pub derived: Option<Derived>,
}

/// What a place is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Size {
    /// A town or a city.
    City,
    /// A municipality of a country of which all are in the tables.
    Municipality,
    /// A part of one.
    Parish,
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
    },
    /// ASCE 7-16, risk-targeted maximum considered earthquake, class B/C: it has no return period.
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
        /// The type, where the annex has one alone for this place.
        only_type: Option<SpectrumType>,
    },
    /// NTC 2018: [`ntc_hazard`] of this point.
    Ntc2018 {
        /// Where it is.
        at: Coordinates,
    },
    /// TBDY 2018, Vs30 760 m/s, by level of ground motion: DD-2 (475 years), DD-1 (2475 years).
    Tbdy2018 {
        /// Ss \[g\].
        ss_g: [f64; 2],
        /// S1 \[g\].
        s1_g: [f64; 2],
    },
    /// TS 1170.5:2025: [`TsLevel`]s.
    Ts1170_5 {
        /// The rows of Table 3.1 for the settlement.
        levels: &'static [TsLevel],
    },
    /// A peak ground acceleration, with the shape of Eurocode 8, type 1: the code of the country is not in the program.
    Shape {
        /// Peak ground acceleration \[g\].
        acceleration_g: f64,
        /// Whether it holds on the soil of the place, not on rock.
        is_on_site: bool,
        /// Where the plateau ends, if that is known \[s\].
        corner_period_s: Option<f64>,
        /// Its return period, if that is known \[years\].
        return_period_years: Option<u32>,
        /// The code or the model that has it; `None`: the file of a user.
        by: Option<&'static str>,
    },
}

/// The distance to a fault from which it has no effect in NZS 1170.5 \[km\].
pub const FAR_KM: f64 = 20.0;

/// The return periods of DD-2 and DD-1 of TBDY 2018 \[years\].
pub const TBDY_YEARS: [u32; 2] = [475, 2475];

/// What Table 3.1 of TS 1170.5:2025 has for a settlement and a return period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TsLevel {
    /// Return period \[years\].
    pub years: u32,
    /// The mean magnitude of the earthquakes behind the values.
    pub magnitude: Option<f64>,
    /// To the nearest fault; [`FAR_KM`] stands for more, `None` where the table has none \[km\].
    pub fault_distance_km: Option<f64>,
    /// For each class.
    pub values: [TsValues; TsSite::ALL.len()],
}

impl PlaceHazard {
    /// The name of the code in flags and studies.
    pub fn code(&self) -> &'static str {
        match self {
            Self::As1170_4 { .. } => "as1170.4",
            Self::Nzs1170_5 { .. } => "nzs1170.5",
            Self::Asce7 { .. } => "asce7",
            Self::Eurocode8 { .. } | Self::Shape { .. } => "eurocode8",
            Self::Ntc2018 { .. } => "ntc2018",
            Self::Tbdy2018 { .. } => "tbdy2018",
            Self::Ts1170_5 { .. } => "ts1170.5",
        }
    }

    /// The name of the code in print.
    pub fn code_title(&self) -> &'static str {
        match self {
            Self::As1170_4 { .. } => "AS 1170.4",
            Self::Nzs1170_5 { .. } => "NZS 1170.5",
            Self::Asce7 { .. } => "ASCE 7-16",
            Self::Eurocode8 {
                annex: Some(NationalAnnex::Spain { .. }),
                ..
            } => "NCSE-02",
            Self::Eurocode8 { .. } => "Eurocode 8",
            Self::Shape { .. } => "shape of Eurocode 8",
            Self::Ntc2018 { .. } => "NTC 2018",
            Self::Tbdy2018 { .. } => "TBDY 2018",
            Self::Ts1170_5 { .. } => "TS 1170.5:2025",
        }
    }

    /// The values with their symbols: `Z = 0.08`, `Ss = 1.976 g, S1 = 0.704 g`.
    pub fn words(&self) -> String {
        match self {
            Self::As1170_4 { hazard_factor } | Self::Nzs1170_5 { hazard_factor } => {
                format!("Z = {}", number(*hazard_factor, 4))
            }
            Self::Asce7 { ss_g, s1_g } => {
                format!("Ss = {} g, S1 = {} g", number(*ss_g, 4), number(*s1_g, 4))
            }
            Self::Eurocode8 {
                ground_acceleration_g,
                type2_ground_acceleration_g,
                annex,
                only_type,
            } => {
                let symbol = match annex {
                    Some(NationalAnnex::Spain { .. }) => "a_b",
                    _ => "a_gR",
                };
                let one = format!("{symbol} = {} g", number(*ground_acceleration_g, 4));
                let two = type2_ground_acceleration_g.map_or_else(String::new, |two| {
                    format!(" (type 1), {} g (type 2)", number(two, 4))
                });
                let only =
                    only_type.map_or_else(String::new, |one| format!(" (type {})", one.number()));
                let rest = match annex {
                    Some(NationalAnnex::Romania { corner_period_s }) => {
                        format!(" (225 years), TC = {} s", number(*corner_period_s, 4))
                    }
                    Some(NationalAnnex::Spain { contribution_ratio }) => {
                        format!(" (500 years), K = {}", number(*contribution_ratio, 4))
                    }
                    _ => String::new(),
                };
                format!("{one}{two}{only}{rest}")
            }
            Self::Ntc2018 { .. } => self.ntc().map_or_else(String::new, |found| {
                format!(
                    "ag = {} g, F0 = {}, Tc* = {} s ({NTC_DEFAULT_YEARS} years)",
                    number(found.ag_g, 4),
                    number(found.f0_ratio, 4),
                    number(found.tc_star_s, 3)
                )
            }),
            Self::Tbdy2018 { ss_g, s1_g } => {
                let level = |k: usize| {
                    let (ss, s1) = (number(ss_g[k], 4), number(s1_g[k], 4));
                    format!("Ss = {ss} g, S1 = {s1} g ({} years)", TBDY_YEARS[k])
                };
                format!("{}; {}", level(0), level(1))
            }
            Self::Ts1170_5 { .. } => {
                self.ts_class_iii()
                    .map_or_else(String::new, |TsValues { pga_g, sas_g, .. }| {
                        let (pga, sas) = (number(pga_g, 3), number(sas_g, 3));
                        format!(
                            "PGA = {pga} g, Sa,s = {sas} g (class III, {TS_DEFAULT_YEARS} years)"
                        )
                    })
            }
            Self::Shape {
                acceleration_g,
                is_on_site,
                return_period_years,
                by,
                ..
            } => {
                let on = if *is_on_site {
                    "on the soil"
                } else {
                    "on rock"
                };
                let years = return_period_years.map(|years| format!("{years} years"));
                let rest: Vec<String> = by.map(str::to_owned).into_iter().chain(years).collect();
                let rest = match rest.is_empty() {
                    true => String::new(),
                    false => format!(" ({})", rest.join(", ")),
                };
                format!("PGA = {} g {on}{rest}", number(*acceleration_g, 4))
            }
        }
    }

    /// The return periods at which its own values are known \[years\].
    pub fn return_periods(&self) -> Vec<u32> {
        match self {
            Self::Ntc2018 { .. } => NTC_YEARS.to_vec(),
            Self::Tbdy2018 { .. } => TBDY_YEARS.to_vec(),
            Self::Ts1170_5 { levels } => levels.iter().map(|level| level.years).collect(),
            _ => Vec::new(),
        }
    }

    /// Whether it has values at several return periods: of its code, or derived ones.
    pub fn takes_return_period(&self) -> bool {
        match self {
            Self::As1170_4 { .. }
            | Self::Nzs1170_5 { .. }
            | Self::Ntc2018 { .. }
            | Self::Tbdy2018 { .. }
            | Self::Eurocode8 { .. }
            | Self::Ts1170_5 { .. } => true,
            Self::Shape {
                return_period_years,
                ..
            } => return_period_years.is_some(),
            Self::Asce7 { .. } => false,
        }
    }

    /// Its values by NTC 2018 at the return period that stands for all.
    fn ntc(&self) -> Option<NtcHazard> {
        match self {
            Self::Ntc2018 { at } => ntc_hazard(*at, NTC_DEFAULT_YEARS),
            _ => None,
        }
    }

    /// Its values by TS 1170.5, class III, at the return period that stands for all.
    fn ts_class_iii(&self) -> Option<TsValues> {
        match self {
            Self::Ts1170_5 { levels } => {
                let level = levels
                    .iter()
                    .find(|level| level.years == TS_DEFAULT_YEARS)?;
                let [_, _, values, ..] = level.values;
                Some(values)
            }
            _ => None,
        }
    }

    /// k of a ∝ T^(1/k) from the return period that stands for all to the longest one, a being what the code has: a_g of NTC
    /// 2018, S_s of TBDY 2018, PGA of class III of TS 1170.5.
    pub fn slope(&self) -> Option<f64> {
        let [from, to, low, high] = match self {
            Self::Ntc2018 { at } => {
                let [.., last] = NTC_YEARS;
                let of = |years| ntc_hazard(*at, years).map(|found| found.ag_g);
                let (low, high) = (of(NTC_DEFAULT_YEARS)?, of(last)?);
                [f64::from(NTC_DEFAULT_YEARS), f64::from(last), low, high]
            }
            Self::Tbdy2018 {
                ss_g: [low, high], ..
            } => {
                let [from, to] = TBDY_YEARS.map(f64::from);
                [from, to, *low, *high]
            }
            Self::Ts1170_5 { levels } => {
                let last = levels.last()?;
                let (low, high) = (self.ts_class_iii()?.pga_g, last.values[2].pga_g);
                [
                    f64::from(TS_DEFAULT_YEARS),
                    f64::from(last.years),
                    low,
                    high,
                ]
            }
            _ => return None,
        };
        let slope = (to / from).ln() / (high / low).ln();
        slope.is_finite().then_some(slope)
    }

    /// Its return period \[years\], where its code has one alone.
    pub fn return_period_years(&self) -> Option<u32> {
        match self {
            Self::Eurocode8 { annex, .. } => {
                Some(annex.map_or(EUROCODE_YEARS, NationalAnnex::return_period_years))
            }
            Self::Shape {
                return_period_years,
                ..
            } => *return_period_years,
            _ => None,
        }
    }
}

/// The return period of a_gR that EN 1998-1, 2.1, recommends \[years\].
const EUROCODE_YEARS: u32 = 475;
/// The return period of NTC 2018 and TBDY 2018, where none is stated: that of their ultimate limit state for a building of
/// usual importance \[years\].
pub(crate) const NTC_DEFAULT_YEARS: u32 = 475;
/// That of TS 1170.5:2025 \[years\].
pub(crate) const TS_DEFAULT_YEARS: u32 = 500;

/// How far the values of a place can be trusted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::IntoStaticStr, strum::EnumIter)]
#[strum(serialize_all = "kebab-case")]
pub enum Confidence {
    /// Read in a public source.
    Read,
    /// Read, and interpolated between the nodes of a grid.
    #[strum(serialize = "read, interpolated")]
    Interpolated,
    /// Converted from a value at another return period, for screening.
    Derived,
    /// Recalled, or read in a source that nobody checked: every output asks the reader to confirm it.
    Approximate,
}

impl Confidence {
    /// The name in outputs.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

impl Place {
    /// Its name, its other names.
    fn names(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.name.as_ref())
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

    /// Its name for an answer: with its state and country unless it is one of the table by hand, which has no two of a name,
    /// and no large city abroad has that name.
    pub fn told_name(&self) -> String {
        let mut by_hand = places().iter().take(rows::by_hand());
        if self.is_point()
            || by_hand.any(|place| place.source == self.source && place.name == self.name)
                && !self.shares_its_name()
        {
            return self.name.to_string();
        }
        format!("{}, {}", self.name, self.whereabouts())
    }

    /// Its name in a sentence: with its province and country where it is a small municipality or a parish, of whose name
    /// there may be others that the tables do not have.
    pub fn short_name(&self) -> String {
        match self.size != Size::City && self.largest_rank().is_none() {
            true => self.told_name(),
            false => self.name.to_string(),
        }
    }

    /// Whether it is a point of a grid, whose name is its coordinates.
    pub fn is_point(&self) -> bool {
        matches!(self.name, Cow::Owned(_))
    }

    /// Its name, which with what follows it finds this place and no other.
    pub fn full_name(&self) -> String {
        let follows = if self.region.is_empty() {
            self.country
        } else {
            self.region
        };
        format!("{}, {follows}", self.name)
    }

    /// The values of its hazard with their symbols, and its distance to a fault.
    pub fn words(&self) -> String {
        let words = match self.derived {
            None => self.hazard.words(),
            Some(derived) => {
                let values = self.hazard.words();
                // The first value, without the return period of the one that was read.
                let value = values.split([';', '(']).next().unwrap_or_default().trim();
                let how = match derived.between_years {
                    Some(_) => "interpolated",
                    None => "derived",
                };
                format!("{value} ({} years, {how})", derived.years)
            }
        };
        match self.fault_distance_km {
            None => words,
            Some(km) if km >= FAR_KM => {
                format!("{words}, no major fault within {} km", number(FAR_KM, 3))
            }
            Some(km) => format!("{words}, a major fault {} km away", number(km, 3)),
        }
    }

    /// The source of its values, how far away they are, and how far they can be trusted.
    pub fn provenance(&self) -> String {
        let away = match (self.distance_km, self.hazard) {
            (None, _) => String::new(),
            (Some(km), PlaceHazard::Ntc2018 { .. }) => {
                format!(", nearest node {} km away", number(km, 2))
            }
            (Some(km), _) => format!(", {} km away", number(km, 2)),
        };
        let confidence = match self.confidence {
            Confidence::Approximate => "approximate, confirm it",
            other => other.name(),
        };
        let derived = match (self.derived, self.confidence) {
            (None, _) => String::new(),
            (Some(derived), Confidence::Derived | Confidence::Interpolated) => {
                format!(", {}", derived.words())
            }
            (Some(derived), _) => format!(", derived: {}", derived.words()),
        };
        format!("{}: {confidence}{derived}{away}", self.source)
    }

    /// What the reader must know about its values.
    pub fn doubt(&self) -> Option<PlaceDoubt> {
        let is_approximate = self.confidence == Confidence::Approximate;
        let why = match self.hazard {
            PlaceHazard::Shape { by, .. } => WhyDoubted::Shape { by, is_approximate },
            PlaceHazard::Eurocode8 { annex: None, .. } if is_approximate => {
                WhyDoubted::AnnexNotRead
            }
            PlaceHazard::Ntc2018 { at } if self.is_point() && is_near_the_border_of_italy(at) => {
                WhyDoubted::PerhapsAbroad
            }
            _ if is_approximate => WhyDoubted::Approximate,
            _ => return None,
        };
        Some(PlaceDoubt {
            place: self.name.to_string(),
            values: self.words(),
            why,
        })
    }
}

/// What the reader must know about the values of a place.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaceDoubt {
    /// The name of the place.
    pub place: String,
    /// The values.
    pub values: String,
    /// Why they are doubted.
    pub why: WhyDoubted,
}

/// Why the values of a place are doubted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumCount)]
pub enum WhyDoubted {
    /// The spectrum has the shape of Eurocode 8.
    Shape {
        /// The code that is not in the program; `None`: a file has the peak of the ground alone.
        by: Option<&'static str>,
        /// Whether the values are approximate besides.
        is_approximate: bool,
    },
    /// They are approximate, and the national annex was not read.
    AnnexNotRead,
    /// The grid reaches beyond the border of Italy.
    PerhapsAbroad,
    /// They are approximate.
    Approximate,
}

answer_of!(Place as place {
    name: String = place.name.to_string();
    /// The state, in the United States; elsewhere what tells places of one name apart.
    region: Option<&'static str> = Some(place.region).filter(|region| !region.is_empty());
    country: &'static str;
    code: &'static str = place.hazard.code();
    ss_g: Option<f64> = match place.hazard {
        PlaceHazard::Asce7 { ss_g, .. } | PlaceHazard::Tbdy2018 { ss_g: [ss_g, _], .. } => Some(ss_g),
        _ => None,
    };
    s1_g: Option<f64> = match place.hazard {
        PlaceHazard::Asce7 { s1_g, .. } | PlaceHazard::Tbdy2018 { s1_g: [s1_g, _], .. } => Some(s1_g),
        _ => None,
    };
    hazard_factor: Option<f64> = match place.hazard {
        PlaceHazard::As1170_4 { hazard_factor } | PlaceHazard::Nzs1170_5 { hazard_factor } => Some(hazard_factor),
        _ => None,
    };
    /// On rock, or on the soil where `code` has no value on rock.
    ground_acceleration_g: Option<f64> = match place.hazard {
        PlaceHazard::Eurocode8 { ground_acceleration_g, .. } => Some(ground_acceleration_g),
        PlaceHazard::Shape { acceleration_g, .. } => Some(acceleration_g),
        PlaceHazard::Ntc2018 { .. } => place.hazard.ntc().map(|found| found.ag_g),
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
    f0_ratio: Option<f64> = place.hazard.ntc().map(|found| found.f0_ratio);
    tc_star_s: Option<f64> = place.hazard.ntc().map(|found| found.tc_star_s);
    /// PGA of class III, by TS 1170.5.
    class_iii_pga_g: Option<f64> = place.hazard.ts_class_iii().map(|values| values.pga_g);
    /// Sa,s of class III, by TS 1170.5.
    class_iii_sas_g: Option<f64> = place.hazard.ts_class_iii().map(|values| values.sas_g);
    /// Ss at 2475 years, by TBDY 2018.
    rare_ss_g: Option<f64> = match place.hazard {
        PlaceHazard::Tbdy2018 { ss_g: [_, rare], .. } if place.derived.is_none() => Some(rare),
        _ => None,
    };
    /// S1 at 2475 years, by TBDY 2018.
    rare_s1_g: Option<f64> = match place.hazard {
        PlaceHazard::Tbdy2018 { s1_g: [_, rare], .. } if place.derived.is_none() => Some(rare),
        _ => None,
    };
    /// k of a ∝ T^(1/k), T being the return period, from about 500 to about 2500 years.
    slope: Option<f64> = place.hazard.slope().filter(|_| place.derived.is_none());
    /// Of the values above, where it is known.
    return_period_years: Option<u64> = match place.hazard {
        _ if place.derived.is_some() => place.derived.map(|derived| u64::from(derived.years)),
        PlaceHazard::Ntc2018 { .. } | PlaceHazard::Tbdy2018 { .. } => Some(u64::from(NTC_DEFAULT_YEARS)),
        PlaceHazard::Ts1170_5 { .. } => Some(u64::from(TS_DEFAULT_YEARS)),
        other => other.return_period_years().map(u64::from),
    };
    /// The return period of the values that were read, where those above were converted from them.
    read_years: Option<u64> = place.derived.map(|derived| u64::from(derived.read_years));
    /// What they were multiplied by.
    derived_ratio: Option<f64> = place.derived.map(|derived| derived.ratio());
    derived_ratio_low: Option<f64> = place.derived.map(|derived| derived.range()[0]);
    derived_ratio_high: Option<f64> = place.derived.map(|derived| derived.range()[1]);
    fault_distance_km: Option<f64>;
    latitude_deg: Option<f64> = place.coordinates.map(|at| at.latitude_deg);
    longitude_deg: Option<f64> = place.coordinates.map(|at| at.longitude_deg);
    /// The distance from the requested coordinates to the place, or to the nearest node of the grid.
    distance_km: Option<f64>;
    source: String = place.source.to_string();
    /// How far the values can be trusted.
    confidence: &'static str = place.confidence.name();
});

#[cfg(test)]
mod tests;
