//! Reads the spectrum of each code.

use freestand::G0_M_S2;
use freestand::code_spectrum::{
    As1170_4, Asce7, Asce7Edition, CodeSpectrum, CodeSpectrumError, Edition, Eurocode8, GroundType, Nzs1170_5,
    SiteClass, SpectrumShape, SpectrumType, SubsoilClass, hazard_factor, hazard_factor_places, minimum_kpz,
    probability_factor, return_period_factor,
};

use super::Target;
use super::words::{Code, missing, needed};
use freestand_input::quantity::{Dimension, shorten};
use freestand_input::word_reader::WordReader;
use freestand_input::words::{nearest, number};

/// Default return period \[years\].
pub const DEFAULT_YEARS: u32 = 500;
const DEFAULT_SITE: SiteClass = SiteClass::De;
const DEFAULT_CITY: &str = "Melbourne";

/// A fact of a report.
fn fact(name: &str, value: impl Into<String>) -> (String, String) {
    (name.to_owned(), value.into())
}

/// A target without a file.
fn target(spectrum: CodeSpectrum, facts: Vec<(String, String)>) -> Target {
    let mut all = vec![fact("Target", format!("{}, elastic, 5 % damping", spectrum.name()))];
    all.extend(facts);
    let warnings: Vec<String> = spectrum.doubt().into_iter().map(str::to_owned).collect();
    all.extend(warnings.iter().map(|doubt| fact("Not confirmed", doubt.as_str())));
    Target { spectrum, city: None, facts: all, file: None, table_csv: None, warnings }
}

fn in_g(value_g: f64) -> String {
    format!("{} g", number(value_g, 4))
}

pub(super) fn as1170_4(reader: &mut WordReader) -> Option<Target> {
    let editions = [("2007", Edition::As1170_4Ed2007Amd2), ("2024", Edition::As1170_4Ed2024Unconfirmed)];
    let edition = edition(reader, &editions, "2007 (with Amendments 1 and 2) or 2024 (not confirmed)");
    let (hazard, city) = hazard_of_a_place(reader);
    let site = match reader.words.get("site") {
        None => Some(DEFAULT_SITE),
        Some(text) => {
            let hint = "Ae strong rock, Be rock, Ce shallow soil, De deep or soft soil, Ee very soft soil";
            site_class(reader, text, SiteClass::parse, Code::As1170_4, hint)
        }
    };
    let years =
        return_period(reader, |years| probability_factor(years).map(|_| ()), "see Tables 3.1 and 3.2 of AS 1170.4");
    let code = As1170_4::new(edition?, site?, hazard?, years?).ok()?;
    let minimum = if code.minimum_governs() { " (the code’s minimum governs)" } else { "" };
    let mut facts: Vec<(String, String)> = city.iter().map(|city| fact("Place", city.as_str())).collect();
    facts.extend([
        fact("Site class", format!("{}: {}", code.site().name(), code.site().description())),
        fact("Hazard design factor Z", number(code.hazard_factor(), 4)),
        fact("Return period", format!("{} years", code.return_period_years())),
        fact("kp·Z", format!("{}{minimum}", in_g(code.kpz_g()))),
    ]);
    let mut target = Target { city, ..target(code.into(), facts) };
    if let Some(least) = minimum_kpz(code.return_period_years()).filter(|_| code.minimum_governs()) {
        target.warnings.push(format!(
            "the code's minimum kpZ of {least} for {} years governs: Z = {} would give less",
            code.return_period_years(),
            code.hazard_factor()
        ));
    }
    Some(target)
}

/// Z as given, or of a city of the code's table; by default Melbourne.
fn hazard_of_a_place(reader: &mut WordReader) -> (Option<f64>, Option<String>) {
    let words = reader.words;
    let given = reader.positive("hazard_factor", Dimension::Ratio);
    match (words.get("hazard_factor"), words.get("city")) {
        (Some(_), Some(_)) => {
            let message = "`city` and `hazard_factor` exclude each other";
            reader.note(&["city", "hazard_factor"], message, "keep one of them");
            (given, None)
        }
        (Some(_), None) => (given, None),
        (None, None) => (hazard_factor(DEFAULT_CITY), Some(DEFAULT_CITY.to_owned())),
        (None, Some(city)) => {
            let places: Vec<&str> = hazard_factor_places().collect();
            let place = places.iter().find(|place| place.eq_ignore_ascii_case(city.trim()));
            if place.is_none() {
                let hint = match nearest(city, &places) {
                    Some(near) => format!("did you mean \"{near}\"?"),
                    None => "give `hazard_factor` instead; the code's table has Melbourne, Sydney, Adelaide, Perth, …"
                        .to_owned(),
                };
                reader.note(&["city"], format!("`city` \"{}\" is not in AS 1170.4", shorten(city)), hint);
            }
            (hazard_factor(city), place.map(|&place| place.to_owned()))
        }
    }
}

/// An edition by its year, with two or four digits.
fn edition<T: Copy>(reader: &mut WordReader, known: &[(&str, T)], expected: &str) -> Option<T> {
    let Some(text) = reader.words.get("edition") else { return known.first().map(|(_, edition)| *edition) };
    let year = text.trim();
    let found = known.iter().find(|(name, _)| *name == year || name.strip_prefix("20") == Some(year));
    if found.is_none() {
        let message = format!("`edition` must be {expected}, not {}", shorten(text));
        reader.note(&["edition"], message, format!("give `edition` as {expected}"));
    }
    found.map(|(_, edition)| *edition)
}

fn site_class<T>(
    reader: &mut WordReader,
    text: &str,
    parse: impl Fn(&str) -> Result<T, CodeSpectrumError>,
    code: Code,
    hint: &str,
) -> Option<T> {
    let found = parse(text).ok();
    if found.is_none() {
        let what = match code {
            Code::Eurocode8 => "a ground type of Eurocode 8",
            Code::Nzs1170_5 => "a class of NZS 1170.5",
            _ => "a class of AS 1170.4",
        };
        reader.note(&["site"], format!("`site` \"{}\" is not {what}", shorten(text)), hint);
    }
    found
}

fn return_period(
    reader: &mut WordReader,
    known: impl Fn(u32) -> Result<(), CodeSpectrumError>,
    hint: &str,
) -> Option<u32> {
    let key = "return_period_years";
    if !reader.has(key) {
        return Some(DEFAULT_YEARS);
    }
    let years = reader.whole(key)?;
    match known(years) {
        Ok(()) => Some(years),
        Err(error) => {
            reader.note(&[key], format!("`{key}`: {error}"), hint);
            None
        }
    }
}

/// Notes values that the core refuses in combination although each alone is valid.
fn made<T>(reader: &mut WordReader, keys: &[&'static str], result: Result<T, CodeSpectrumError>) -> Option<T> {
    result
        .map_err(|error| {
            reader.note(keys, error.to_string(), format!("check `{}`", keys.join("`, `")));
        })
        .ok()
}

pub(super) fn eurocode8(reader: &mut WordReader) -> Option<Target> {
    const CODE: Code = Code::Eurocode8;
    edition(reader, &[("2004", ())], "2004 (EN 1998-1:2004)");
    let acceleration = needed(reader, "ground_acceleration", Dimension::Acceleration, CODE, "0.15 g");
    let importance = match reader.has("importance_factor") {
        false => Some(1.0),
        true => reader.positive("importance_factor", Dimension::Ratio),
    };
    if !reader.has("spectrum_type") {
        missing(reader, "spectrum_type", CODE, "1");
    }
    let types = [("1", SpectrumType::Type1), ("2", SpectrumType::Type2)];
    let spectrum_type = reader.one_of("spectrum_type", &types);
    let soil_factor = reader.positive("soil_factor", Dimension::Ratio);
    let corners = eurocode8_corners(reader);
    let is_complete = ["soil_factor", "corner_periods"].iter().all(|key| reader.has(key));
    let ground = match reader.words.get("site") {
        Some(text) => {
            let hint =
                "A rock, B very dense or very stiff, C dense or stiff, D loose or soft, E a layer of C or D over rock";
            site_class(reader, text, GroundType::parse, CODE, hint)
        }
        None => {
            if !is_complete {
                missing(reader, "site", CODE, "B");
            }
            None
        }
    };
    if !reader.problems.is_empty() {
        return None;
    }
    let recommended = ground.zip(spectrum_type).map(|(ground, kind)| SpectrumShape::recommended(kind, ground));
    let shape = eurocode8_shape(recommended, soil_factor, corners)?;
    let result = Eurocode8::with_shape(spectrum_type?, ground, acceleration? / G0_M_S2, importance?, shape);
    let code = made(reader, &["ground_acceleration", "soil_factor", "corner_periods"], result)?;
    let given = |is_given: bool| if is_given { "as given" } else { "recommended" };
    let ground_words =
        ground.map_or_else(|| "not given".to_owned(), |ground| format!("{}: {}", ground.name(), ground.description()));
    let [tb_s, tc_s, td_s] = code.corner_periods_s().map(|period_s| number(period_s, 4));
    let facts = vec![
        fact("Type of spectrum", code.spectrum_type().number().to_string()),
        fact("Ground type", ground_words),
        fact("Reference ground acceleration a_gR", in_g(code.reference_acceleration_g())),
        fact("Importance factor γ_I", number(code.importance_factor_ratio(), 4)),
        fact("Soil factor S", format!("{}, {}", number(shape.soil_factor_ratio, 4), given(soil_factor.is_some()))),
        fact("TB, TC, TD", format!("{tb_s} s, {tc_s} s, {td_s} s, {}", given(corners.is_some()))),
    ];
    let mut target = target(code.into(), facts);
    if !code.is_recommended() {
        target.warnings.push(
            "the soil factor or the corner periods differ from those that EN 1998-1 recommends: check them against \
             the national annex"
                .to_owned(),
        );
    }
    Some(target)
}

fn eurocode8_corners(reader: &mut WordReader) -> Option<[f64; 3]> {
    let periods_s = reader.grid("corner_periods", Dimension::Time)?;
    match periods_s[..] {
        [tb_s, tc_s, td_s] if tb_s > 0.0 && tc_s >= tb_s && td_s >= tc_s => Some([tb_s, tc_s, td_s]),
        _ => {
            let message = "`corner_periods` must be three periods, 0 < TB ≤ TC ≤ TD";
            reader.note(&["corner_periods"], message, "give `corner_periods = \"0.15 s, 0.5 s, 2 s\"`");
            None
        }
    }
}

/// The recommended shape with the values that were given.
fn eurocode8_shape(
    recommended: Option<SpectrumShape>,
    soil_factor_ratio: Option<f64>,
    corners_s: Option<[f64; 3]>,
) -> Option<SpectrumShape> {
    let [tb_s, tc_s, td_s] = corners_s.or_else(|| recommended.map(|shape| [shape.tb_s, shape.tc_s, shape.td_s]))?;
    let soil_factor_ratio = soil_factor_ratio.or_else(|| recommended.map(|shape| shape.soil_factor_ratio))?;
    Some(SpectrumShape { soil_factor_ratio, tb_s, tc_s, td_s })
}

pub(super) fn asce7(reader: &mut WordReader) -> Option<Target> {
    const CODE: Code = Code::Asce7;
    let editions = [("2022", Asce7Edition::Asce7_22), ("2016", Asce7Edition::Asce7_16)];
    let edition = edition(reader, &editions, "2022 or 2016");
    let is_mapped = ["ss", "s1", "fa", "fv"].iter().any(|key| reader.has(key));
    let design: Vec<&'static str> = ["sds", "sd1"].into_iter().filter(|key| reader.has(key)).collect();
    if let (true, Some(key)) = (is_mapped, design.first().copied()) {
        let message = format!("`{key}` and mapped accelerations exclude each other");
        reader.note(&[key, "ss", "s1", "fa", "fv"], message, "give SDS and SD1, or Ss, S1, Fa and Fv");
        return None;
    }
    let long_period_s = needed(reader, "long_period", Dimension::Time, CODE, "8 s");
    let mut facts = Vec::new();
    let code = if is_mapped {
        let ss = needed(reader, "ss", Dimension::Acceleration, CODE, "1.5 g").map(|value| value / G0_M_S2);
        let s1 = needed(reader, "s1", Dimension::Acceleration, CODE, "0.6 g").map(|value| value / G0_M_S2);
        let fa = needed(reader, "fa", Dimension::Ratio, CODE, "1.0");
        let fv = needed(reader, "fv", Dimension::Ratio, CODE, "1.7");
        let (ss, s1, fa, fv) = (ss?, s1?, fa?, fv?);
        facts.push(fact("Ss, S1", format!("{}, {}", in_g(ss), in_g(s1))));
        facts.push(fact("Fa, Fv", format!("{}, {}", number(fa, 4), number(fv, 4))));
        let result = Asce7::from_mapped(edition?, (ss, fa), (s1, fv), long_period_s?);
        made(reader, &["ss", "s1", "fa", "fv", "long_period"], result)?
    } else {
        let sds = needed(reader, "sds", Dimension::Acceleration, CODE, "1 g");
        let sd1 = needed(reader, "sd1", Dimension::Acceleration, CODE, "0.6 g");
        let result = Asce7::new(edition?, sds? / G0_M_S2, sd1? / G0_M_S2, long_period_s?);
        made(reader, &["sds", "sd1", "long_period"], result)?
    };
    let [t0_s, ts_s, tl_s] = code.corner_periods_s().map(|period_s| number(period_s, 4));
    facts.push(fact("SDS, SD1", format!("{}, {}", in_g(code.sds_g()), in_g(code.sd1_g()))));
    facts.push(fact("T0, TS, TL", format!("{t0_s} s, {ts_s} s, {tl_s} s")));
    Some(target(code.into(), facts))
}

pub(super) fn nzs1170_5(reader: &mut WordReader) -> Option<Target> {
    const CODE: Code = Code::Nzs1170_5;
    edition(reader, &[("2004", ())], "2004");
    let hazard = needed(reader, "hazard_factor", Dimension::Ratio, CODE, "0.40");
    let site = match reader.words.get("site") {
        Some(text) => {
            let hint = "A strong rock, B rock, C shallow soil, D deep or soft soil, E very soft soil";
            site_class(reader, text, SubsoilClass::parse, CODE, hint)
        }
        None => {
            missing(reader, "site", CODE, "C");
            None
        }
    };
    let years = return_period(reader, |years| return_period_factor(years).map(|_| ()), "see Table 3.5 of NZS 1170.5");
    let distance_km = if reader.has("fault_distance") {
        Some(reader.non_negative("fault_distance", Dimension::Length)? / 1e3)
    } else {
        None
    };
    let code = Nzs1170_5::new(site?, hazard?, years?, distance_km);
    let code = made(reader, &["hazard_factor", "fault_distance"], code)?;
    let maximum = if code.maximum_governs() { " (the code’s maximum governs)" } else { "" };
    let fault = match distance_km {
        None => "none near: N(T, D) = 1".to_owned(),
        Some(km) if code.is_near_fault() => format!("{} km away: N(T, D) rises from 1.5 s on", number(km, 4)),
        Some(km) => format!("{} km away: N(T, D) = 1 by the code", number(km, 4)),
    };
    let facts = vec![
        fact("Site subsoil class", format!("{}: {}", code.site().name(), code.site().description())),
        fact("Hazard factor Z", number(code.hazard_factor(), 4)),
        fact("Return period", format!("{} years, R = {}", code.return_period_years(), code.return_factor_ratio())),
        fact("Z·R", format!("{}{maximum}", in_g(code.zr_g()))),
        fact("Major fault", fault),
    ];
    let mut target = target(code.into(), facts);
    if code.maximum_governs() {
        target.warnings.push(format!(
            "Z R = {} is above the maximum of NZS 1170.5, so 0.7 governs",
            number(code.hazard_factor() * code.return_factor_ratio(), 4)
        ));
    }
    Some(target)
}
