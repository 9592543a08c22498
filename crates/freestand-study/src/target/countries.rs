//! Reads the spectra of codes whose hazard is that of a place: NTC 2018, TBDY 2018 and TS 1170.5:2025.

use freestand::code_spectrum::{
    CodeSpectrumError, GroundType, Ntc2018, Tbdy2018, TbdySite, Topography, Ts1170_5, TsSite,
};
use freestand_input::word_reader::WordReader;
use freestand_input::words::number;

use super::Target;
use super::code::{Code, missing};
use super::codes::{
    at, fact, in_g, made, mapped, refuse_beside_place, return_period, site_class, target,
};
use crate::places::{
    FAR_KM, NTC_DEFAULT_YEARS, NTC_YEARS, Place, PlaceHazard, TBDY_YEARS, TS_DEFAULT_YEARS,
    ntc_hazard,
};

/// The ground of NTC 2018, where none is stated.
const DEFAULT_GROUND: GroundType = GroundType::B;
/// The class of TBDY 2018, where none is stated: that of class D of ASCE 7.
const DEFAULT_TBDY_SITE: TbdySite = TbdySite::ZD;
/// The class of TS 1170.5, where none is stated: near the class C of NZS 1170.5.
const DEFAULT_TS_SITE: TsSite = TsSite::III;

/// A return period for which there are no values.
fn no_values(years: u32, known: impl IntoIterator<Item = u32>) -> CodeSpectrumError {
    CodeSpectrumError::ReturnPeriod {
        return_period_years: years,
        known_years: known.into_iter().collect(),
    }
}

fn site_fact(reader: &WordReader, name: &str) -> String {
    let assumed = if reader.has("site") { "" } else { ", assumed" };
    format!("{name}{assumed}")
}

fn years_fact(years: u32) -> (String, String) {
    fact("Return period", format!("{years} years"))
}

pub(super) fn ntc2018(reader: &mut WordReader, place: Option<&Place>) -> Option<Target> {
    const CODE: Code = Code::Ntc2018;
    let Some(PlaceHazard::Ntc2018 { at: point }) = place.map(|place| place.hazard) else {
        missing(reader, "place", CODE, "42.35, 13.40");
        return None;
    };
    let ground = match reader.words.get("site") {
        None => Some(DEFAULT_GROUND),
        Some(text) => {
            let hint = "A rock, B very dense or very stiff, C dense or stiff, D loose or soft, E a layer of C or D over rock";
            site_class(reader, text, GroundType::parse, CODE, hint)
        }
    };
    let topography = match reader.words.get("topography") {
        None => Some(Topography::default()),
        Some(text) => Topography::parse(text)
            .map_err(|error| reader.note(&["topography"], error.to_string(), "T1 is flat ground"))
            .ok(),
    };
    let [first, .., last] = NTC_YEARS;
    let known = |years: u32| {
        let fine = (first..=last).contains(&years);
        fine.then_some(())
            .ok_or_else(|| no_values(years, [first, last]))
    };
    let hint = "annex B has 30 to 2475 years; between its columns the logarithms are linear";
    let years = return_period(reader, NTC_DEFAULT_YEARS, known, hint)?;
    let code = Ntc2018::new(ntc_hazard(point, years)?, years, ground?, topography?);
    let code = made(reader, &["place"], code)?;
    let hazard = code.hazard();
    let [tb_s, tc_s, td_s] = code.corner_periods_s().map(|period_s| number(period_s, 4));
    let (name, description) = (code.ground().name(), code.ground().description());
    let topography = if reader.has("topography") {
        ""
    } else {
        ", assumed"
    };
    let facts = vec![
        fact(
            "Ground",
            site_fact(reader, &format!("{name}: {description}")),
        ),
        fact(
            "Topographic category",
            format!("{}{topography}", code.topography().name()),
        ),
        years_fact(years),
        fact(
            "ag, F0, Tc*",
            format!(
                "{}, {}, {} s",
                in_g(hazard.ag_g),
                number(hazard.f0_ratio, 4),
                number(hazard.tc_star_s, 3)
            ),
        ),
        fact(
            "S_S, S_T",
            format!(
                "{}, {}",
                number(code.soil_factor_ratio(), 4),
                number(code.topography().factor_ratio(), 4)
            ),
        ),
        fact("TB, TC, TD", format!("{tb_s} s, {tc_s} s, {td_s} s")),
    ];
    Some(at(place, target(code.into(), facts)))
}

pub(super) fn tbdy2018(reader: &mut WordReader, place: Option<&Place>) -> Option<Target> {
    const CODE: Code = Code::Tbdy2018;
    refuse_beside_place(reader, &["ss", "s1"]);
    let site = match reader.words.get("site") {
        None if place.is_some() => Some(DEFAULT_TBDY_SITE),
        None => {
            missing(reader, "site", CODE, "ZC");
            None
        }
        Some(text) => {
            let hint = "ZA hard rock, ZB rock, ZC very dense soil or weathered rock, ZD medium dense or stiff soil, ZE loose or \
                        soft soil; ZF needs a study";
            site_class(reader, text, TbdySite::parse, CODE, hint)
        }
    };
    let (ss_g, s1_g, years) = match place.map(|place| place.hazard) {
        Some(PlaceHazard::Tbdy2018 { ss_g, s1_g }) => {
            let derived = place.and_then(|place| place.derived);
            let level = |years: u32| match derived {
                // Both levels have what was derived.
                Some(derived) => (derived.years == years).then_some(0),
                None => TBDY_YEARS.iter().position(|&known| known == years),
            };
            let known = |years: u32| {
                level(years)
                    .map(|_| ())
                    .ok_or_else(|| no_values(years, TBDY_YEARS))
            };
            let hint = "DD-2 has 475 years, DD-1 2475 years";
            let years = return_period(reader, NTC_DEFAULT_YEARS, known, hint)?;
            let k = level(years)?;
            (*ss_g.get(k)?, *s1_g.get(k)?, Some(years))
        }
        _ => {
            // Ss and S1 are those of the level that the user means.
            let years = match reader.has("return_period_years") {
                true => Some(reader.whole("return_period_years")?),
                false => None,
            };
            let [ss, s1] = ["ss", "s1"].map(|key| mapped(reader, key, CODE));
            (ss?, s1?, years)
        }
    };
    let code = made(
        reader,
        &["ss", "s1"],
        Tbdy2018::new(ss_g, s1_g, site?, years),
    )?;
    let [fs, f1] = code.factors().map(|factor| number(factor, 4));
    let [ta_s, tb_s, tl_s] = code.corner_periods_s().map(|period_s| number(period_s, 4));
    let (name, description) = (code.site().name(), code.site().description());
    let mut facts = vec![
        fact(
            "Site class",
            site_fact(reader, &format!("{name}: {description}")),
        ),
        fact("Ss, S1", format!("{}, {}", in_g(ss_g), in_g(s1_g))),
        fact("F_S, F_1", format!("{fs}, {f1}")),
        fact(
            "S_DS, S_D1",
            format!("{}, {}", in_g(code.sds_g()), in_g(code.sd1_g())),
        ),
        fact("TA, TB, TL", format!("{ta_s} s, {tb_s} s, {tl_s} s")),
    ];
    facts.extend(years.map(years_fact));
    Some(at(place, target(code.into(), facts)))
}

pub(super) fn ts1170_5(reader: &mut WordReader, place: Option<&Place>) -> Option<Target> {
    const CODE: Code = Code::Ts1170_5;
    let Some(PlaceHazard::Ts1170_5 { levels }) = place.map(|place| place.hazard) else {
        missing(reader, "place", CODE, "Hastings");
        return None;
    };
    let site = match reader.words.get("site") {
        None => Some(DEFAULT_TS_SITE),
        Some(text) => {
            let hint = "I is rock (Vs30 above 750 m/s), VI the softest soil (150 to 200 m/s)";
            site_class(reader, text, TsSite::parse, CODE, hint)
        }
    };
    let level = |years: u32| levels.iter().find(|level| level.years == years);
    let known = |years: u32| {
        let all = || levels.iter().map(|level| level.years);
        level(years)
            .map(|_| ())
            .ok_or_else(|| no_values(years, all()))
    };
    let hint = "see Table 3.1 of TS 1170.5:2025";
    let years = return_period(reader, TS_DEFAULT_YEARS, known, hint)?;
    let (site, level) = (site?, level(years)?);
    let class = TsSite::ALL.iter().position(|&one| one == site)?;
    let values = *level.values.get(class)?;
    let code = made(reader, &["place"], Ts1170_5::new(values, site, years))?;
    let mut facts = vec![
        fact("Site class", site_fact(reader, site.name())),
        years_fact(years),
        fact(
            "PGA, Sa,s",
            format!("{}, {}", in_g(values.pga_g), in_g(values.sas_g)),
        ),
        fact(
            "Tc, Td",
            format!("{} s, {} s", number(values.tc_s, 3), number(values.td_s, 3)),
        ),
    ];
    facts.extend(level.fault_distance_km.map(|km| {
        let words = if km >= FAR_KM {
            format!("more than {} km away", number(FAR_KM, 3))
        } else {
            format!(
                "{} km away: its effect on long periods is not in this spectrum",
                number(km, 3)
            )
        };
        fact("Major fault", words)
    }));
    Some(at(place, target(code.into(), facts)))
}
