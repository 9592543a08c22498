//! The tables of places: the first by hand, the others made by make.py and compressed.

use std::sync::LazyLock;

use freestand::code_spectrum::{NationalAnnex, SpectrumType, TsValues};
use strum::IntoEnumIterator as _;

use super::grid::inflated;
use super::{Confidence, Coordinates, Place, PlaceHazard, Size, TS_DEFAULT_YEARS, TsLevel};

/// All places, in the order of the tables: of two with one name, the first is meant.
pub fn places() -> &'static [Place] {
    static PLACES: LazyLock<Vec<Place>> = LazyLock::new(|| rows().filter_map(read).collect());
    &PLACES
}

/// How many places there are in the table by hand.
pub(super) fn by_hand() -> usize {
    static COUNT: LazyLock<usize> = LazyLock::new(|| lines(include_str!("places.csv")).count());
    *COUNT
}

/// The rows of the tables.
pub(super) fn rows() -> impl Iterator<Item = &'static str> {
    static NAMED: LazyLock<String> = LazyLock::new(|| {
        let bytes = inflated(include_bytes!("../../places/named.csv.zlib")).unwrap_or_default();
        String::from_utf8(bytes).unwrap_or_default()
    });
    lines(include_str!("places.csv")).chain(lines(&NAMED))
}

fn lines(table: &'static str) -> impl Iterator<Item = &'static str> {
    table
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
        latitude,
        longitude,
    ] = fields.as_slice()
    else {
        return None;
    };
    let coordinates = match (latitude.parse(), longitude.parse()) {
        (Ok(latitude_deg), Ok(longitude_deg)) => Some(Coordinates {
            latitude_deg,
            longitude_deg,
        }),
        _ => None,
    };
    let (hazard, fault_distance_km) = hazard(code, values, coordinates)?;
    Some(Place {
        name: name.into(),
        other_names,
        region,
        country,
        size: match country {
            "Ecuador" if region.contains(',') => Size::Parish,
            "Ecuador" | "Portugal" | "Spain" => Size::Municipality,
            _ => Size::City,
        },
        hazard,
        source: source.into(),
        confidence: Confidence::iter().find(|one| one.name() == confidence)?,
        coordinates,
        distance_km: None,
        fault_distance_km,
        derived: None,
    })
}

/// The values of a row: numbers, then names with values (`fault=6`, `annex=pt`); those of TS 1170.5 are a table of their own.
/// With them the distance to the nearest fault.
fn hazard(
    code: &str,
    values: &'static str,
    at: Option<Coordinates>,
) -> Option<(PlaceHazard, Option<f64>)> {
    if code == "ts1170.5" {
        // The table lives as long as the program.
        let levels: Vec<TsLevel> = values.split('|').map(ts_level).collect::<Option<_>>()?;
        let level = levels
            .iter()
            .find(|level| level.years == TS_DEFAULT_YEARS)?;
        let fault_distance_km = level.fault_distance_km;
        let levels = Vec::leak(levels);
        return Some((PlaceHazard::Ts1170_5 { levels }, fault_distance_km));
    }
    let parts = values
        .split(',')
        .map(str::trim)
        .filter(|value| !value.is_empty());
    let (named, numbers): (Vec<&str>, Vec<&str>) = parts.partition(|value| value.contains('='));
    let numbers: Vec<f64> = numbers
        .into_iter()
        .map(str::parse)
        .collect::<Result<_, _>>()
        .ok()?;
    let named: Vec<(&str, &str)> = named
        .into_iter()
        .filter_map(|value| value.split_once('='))
        .collect();
    let text = |name: &str| {
        named
            .iter()
            .find(|(one, _)| *one == name)
            .map(|(_, value)| *value)
    };
    let value = |name: &str| text(name)?.parse::<f64>().ok();
    let annex = match text("annex") {
        None => None,
        Some("fr") => Some(NationalAnnex::France),
        Some("pt") => Some(NationalAnnex::Portugal),
        Some("ro") => Some(NationalAnnex::Romania {
            corner_period_s: value("tc")?,
        }),
        Some("es") => Some(NationalAnnex::Spain {
            contribution_ratio: value("k")?,
        }),
        Some(_) => return None,
    };
    let hazard = match (code, numbers.as_slice()) {
        ("as1170.4", &[hazard_factor]) => PlaceHazard::As1170_4 { hazard_factor },
        ("nzs1170.5", &[hazard_factor]) => PlaceHazard::Nzs1170_5 { hazard_factor },
        ("asce7", &[ss_g, s1_g]) => PlaceHazard::Asce7 { ss_g, s1_g },
        ("eurocode8", &[ground_acceleration_g, ref two @ ..]) if two.len() < 2 => {
            PlaceHazard::Eurocode8 {
                ground_acceleration_g,
                type2_ground_acceleration_g: two.first().copied(),
                annex,
                only_type: match text("type") {
                    None => None,
                    Some("1") => Some(SpectrumType::Type1),
                    Some("2") => Some(SpectrumType::Type2),
                    Some(_) => return None,
                },
            }
        }
        ("ntc2018", &[]) => PlaceHazard::Ntc2018 { at: at? },
        ("tbdy2018", &[ss_475, s1_475, ss_2475, s1_2475]) => PlaceHazard::Tbdy2018 {
            ss_g: [ss_475, ss_2475],
            s1_g: [s1_475, s1_2475],
        },
        ("shape", &[acceleration_g]) => PlaceHazard::Shape {
            acceleration_g,
            is_on_site: text("ground") == Some("site"),
            corner_period_s: value("tc"),
            return_period_years: text("years").and_then(|years| years.parse().ok()),
            by: Some(text("by")?),
        },
        _ => return None,
    };
    Some((hazard, value("fault")))
}

/// A row of a settlement: `years,M,D,PGA,Sas,Tc,Td,…`, with four values for each class.
fn ts_level(row: &str) -> Option<TsLevel> {
    let fields: Vec<&str> = row.split(',').collect();
    let [years, magnitude, distance, numbers @ ..] = fields.as_slice() else {
        return None;
    };
    let numbers: Vec<f64> = numbers
        .iter()
        .map(|one| one.parse())
        .collect::<Result<_, _>>()
        .ok()?;
    let mut values = numbers.chunks_exact(4).map(|four| match *four {
        [pga_g, sas_g, tc_s, td_s] => Some(TsValues {
            pga_g,
            sas_g,
            tc_s,
            td_s,
        }),
        _ => None,
    });
    let mut next = || values.next().flatten();
    Some(TsLevel {
        years: years.parse().ok()?,
        magnitude: magnitude.parse().ok(),
        fault_distance_km: distance.parse().ok(),
        values: [next()?, next()?, next()?, next()?, next()?, next()?],
    })
}
