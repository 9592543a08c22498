//! Reads the spectrum of each code.

use freestand::G0_M_S2;
use freestand::code_spectrum::{
    As1170_4, Asce7, Asce7Edition, Asce7Site, CodeSpectrum, CodeSpectrumError, Edition, Eurocode8,
    GroundType, Nzs1170_5, SiteClass, SpectrumShape, SpectrumType, SubsoilClass, minimum_kpz,
    probability_factor, return_period_factor, site_coefficients,
};

use super::Target;
use super::code::{Code, missing, needed};
use super::doubt::{AnnexSpectrum, TargetDoubt};
use super::named::named_place;
use crate::places::{FAR_KM, Place, PlaceHazard};
use freestand_input::quantity::{Dimension, shorten};
use freestand_input::word_reader::WordReader;
use freestand_input::words::number;

/// Default return period \[years\].
pub const DEFAULT_YEARS: u32 = 500;
const DEFAULT_SITE: SiteClass = SiteClass::De;
const DEFAULT_CITY: &str = "Melbourne";
/// The subsoil class of NZS 1170.5, where a place gives the hazard.
const DEFAULT_SUBSOIL: SubsoilClass = SubsoilClass::C;
/// The ground type of Eurocode 8, where a place gives the hazard.
const DEFAULT_GROUND: GroundType = GroundType::B;
/// The site class of ASCE 7, where a place gives the hazard.
const DEFAULT_ASCE7_SITE: Asce7Site = Asce7Site::D;
/// The long-period transition of ASCE 7, where a place gives the hazard \[s\]: 4 to 16 s on the maps,
/// 8 s in most of California and much of the west.
const DEFAULT_LONG_PERIOD_S: f64 = 8.0;
/// The same as a person writes it.
pub(super) const DEFAULT_LONG_PERIOD_WORDS: &str = "8 s";

/// A fact of a report.
pub(super) fn fact(name: &str, value: impl Into<String>) -> (String, String) {
    (name.to_owned(), value.into())
}

/// A target with the place that gave its hazard, what is said about it first.
pub(super) fn at(place: Option<&Place>, mut target: Target) -> Target {
    let Some(place) = place else { return target };
    let facts = [
        fact("Place", place.short_name()),
        fact("Hazard from", place.provenance()),
    ];
    // The first fact is the code.
    target.facts.splice(1..1, facts);
    target.doubts.extend(place.doubt().map(TargetDoubt::Place));
    let derived = place.derived.filter(|one| one.between_years.is_none());
    target
        .doubts
        .extend(derived.map(|derived| TargetDoubt::Derived {
            place: place.name.to_string(),
            derived,
        }));
    target.place = Some(place.clone());
    target
}

/// Notes keys that state the hazard although the place does.
pub(super) fn refuse_beside_place(reader: &mut WordReader, keys: &[&'static str]) {
    let Some((place, _)) = named_place(reader.words) else {
        return;
    };
    for key in keys
        .iter()
        .filter(|key| reader.has(key))
        .copied()
        .collect::<Vec<_>>()
    {
        reader.note(
            &[place, key],
            format!("`{place}` and `{key}` exclude each other"),
            "keep one of them",
        );
    }
}

/// A target without a file.
pub(super) fn target(spectrum: CodeSpectrum, facts: Vec<(String, String)>) -> Target {
    let mut all = vec![fact(
        "Target",
        format!("{}, elastic, 5 % damping", spectrum.name()),
    )];
    all.extend(facts);
    let is_unread = matches!(
        &spectrum,
        CodeSpectrum::As1170_4(code) if code.edition() == Edition::As1170_4Ed2024Unconfirmed
    );
    Target {
        spectrum,
        place: None,
        place_is_assumed: false,
        facts: all,
        alternative: None,
        parts_edition: None,
        file: None,
        table_csv: None,
        doubts: Vec::from_iter(is_unread.then_some(TargetDoubt::EditionUnread)),
        period_doubts: Vec::new(),
    }
}

pub(super) fn in_g(value_g: f64) -> String {
    format!("{} g", number(value_g, 4))
}

pub(super) fn as1170_4(reader: &mut WordReader, place: Option<&Place>) -> Option<Target> {
    let editions = [
        ("2007", Edition::As1170_4Ed2007Amd2),
        ("2024", Edition::As1170_4Ed2024Unconfirmed),
    ];
    let edition = edition(
        reader,
        &editions,
        "2007 (with Amendments 1 and 2) or 2024 (not confirmed)",
    );
    refuse_beside_place(reader, &["hazard_factor"]);
    let given = reader.positive("hazard_factor", Dimension::Ratio);
    // Melbourne where nothing is stated.
    let place_is_assumed = place.is_none() && !reader.has("hazard_factor");
    let assumed = place_is_assumed
        .then(|| Place::find(DEFAULT_CITY))
        .flatten();
    let place = place.or(assumed.as_ref());
    let hazard = match place.map(|place| place.hazard) {
        Some(PlaceHazard::As1170_4 { hazard_factor }) => Some(hazard_factor),
        _ => given,
    };
    let site = match reader.words.get("site") {
        None => Some(DEFAULT_SITE),
        Some(text) => {
            let hint =
                "Ae strong rock, Be rock, Ce shallow soil, De deep or soft soil, Ee very soft soil";
            site_class(reader, text, SiteClass::parse, Code::As1170_4, hint)
        }
    };
    let years = return_period(
        reader,
        DEFAULT_YEARS,
        |years| probability_factor(years).map(|_| ()),
        "see Tables 3.1 and 3.2 of AS 1170.4",
    );
    let code = As1170_4::new(edition?, site?, hazard?, years?).ok()?;
    let minimum = if code.minimum_governs() {
        " (the code’s minimum governs)"
    } else {
        ""
    };
    let facts = vec![
        fact(
            "Site class",
            format!("{}: {}", code.site().name(), code.site().description()),
        ),
        fact("Hazard design factor Z", number(code.hazard_factor(), 4)),
        fact(
            "Return period",
            format!("{} years", code.return_period_years()),
        ),
        fact("kp·Z", format!("{}{minimum}", in_g(code.kpz_g()))),
    ];
    let mut target = at(place, target(code.into(), facts));
    target.place_is_assumed = place_is_assumed;
    if place_is_assumed {
        let doubt = TargetDoubt::PlaceAssumed(DEFAULT_CITY);
        target.doubts.push(doubt);
    }
    let least = minimum_kpz(code.return_period_years()).filter(|_| code.minimum_governs());
    target
        .doubts
        .extend(least.map(|least_ratio| TargetDoubt::MinimumGoverns {
            least_ratio,
            years: code.return_period_years(),
            hazard_factor: code.hazard_factor(),
        }));
    Some(target)
}

/// An edition by its year, with two or four digits.
fn edition<T: Copy>(reader: &mut WordReader, known: &[(&str, T)], expected: &str) -> Option<T> {
    let Some(text) = reader.words.get("edition") else {
        return known.first().map(|(_, edition)| *edition);
    };
    let year = text.trim();
    let found = known
        .iter()
        .find(|(name, _)| *name == year || name.strip_prefix("20") == Some(year));
    if found.is_none() {
        let message = format!("`edition` must be {expected}, not \"{}\"", shorten(text));
        reader.note(
            &["edition"],
            message,
            format!("give `edition` as {expected}"),
        );
    }
    found.map(|(_, edition)| *edition)
}

pub(super) fn site_class<T>(
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
            Code::Asce7 => "a class of ASCE 7",
            Code::Ntc2018 => "a ground of NTC 2018",
            Code::Tbdy2018 => "a class of TBDY 2018",
            Code::Ts1170_5 => "a class of TS 1170.5",
            _ => "a class of AS 1170.4",
        };
        reader.note(
            &["site"],
            format!("`site` \"{}\" is not {what}", shorten(text)),
            hint,
        );
    }
    found
}

pub(super) fn return_period(
    reader: &mut WordReader,
    default: u32,
    known: impl Fn(u32) -> Result<(), CodeSpectrumError>,
    hint: &str,
) -> Option<u32> {
    let key = "return_period_years";
    if !reader.has(key) {
        return Some(default);
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
pub(super) fn made<T>(
    reader: &mut WordReader,
    keys: &[&'static str],
    result: Result<T, CodeSpectrumError>,
) -> Option<T> {
    result
        .map_err(|error| {
            reader.note(
                keys,
                error.to_string(),
                format!("check `{}`", keys.join("`, `")),
            );
        })
        .ok()
}

pub(super) fn eurocode8(reader: &mut WordReader, place: Option<&Place>) -> Option<Target> {
    const CODE: Code = Code::Eurocode8;
    edition(reader, &[("2004", ())], "2004 (EN 1998-1:2004)");
    refuse_beside_place(reader, &["ground_acceleration"]);
    if place.is_none() && reader.has("return_period_years") {
        reader.note(
            &["return_period_years"],
            "`return_period_years` needs a `place`: a `ground_acceleration` holds for a return period of its own",
            "leave it out, or give `place` in place of `ground_acceleration`",
        );
    }
    if place.is_some() && reader.has("return_period_years") {
        // γ_I stands for another return period as well.
        reader.exclusive("return_period_years", "importance_factor");
        // The values are those of the place already: what is no number is noted here alone.
        reader.whole("return_period_years");
    }
    let hazard = place.map(|place| place.hazard);
    let (of_place, of_type_2, annex, only_type) = match hazard {
        Some(PlaceHazard::Eurocode8 {
            ground_acceleration_g,
            type2_ground_acceleration_g,
            annex,
            only_type,
        }) => (
            Some(ground_acceleration_g),
            type2_ground_acceleration_g,
            annex,
            only_type,
        ),
        Some(PlaceHazard::Shape { acceleration_g, .. }) => (Some(acceleration_g), None, None, None),
        _ => (None, None, None, None),
    };
    let stated_g = match of_place {
        Some(_) => None,
        None => needed(
            reader,
            "ground_acceleration",
            Dimension::Acceleration,
            CODE,
            "0.15 g",
        )
        .map(|a| a / G0_M_S2),
    };
    let importance = match reader.has("importance_factor") {
        false => Some(1.0),
        true => reader.positive("importance_factor", Dimension::Ratio),
    };
    let types = [("1", SpectrumType::Type1), ("2", SpectrumType::Type2)];
    let spectrum_type = match (reader.has("spectrum_type"), place) {
        (false, Some(_)) => Some(only_type.unwrap_or(SpectrumType::Type1)),
        (false, None) => {
            missing(reader, "spectrum_type", CODE, "1");
            None
        }
        (true, _) => reader.one_of("spectrum_type", &types),
    };
    if let (Some(only), Some(asked)) = (only_type, spectrum_type)
        && only != asked
    {
        let message = format!(
            "the national annex has type {} alone for this place",
            only.number()
        );
        reader.note(&["spectrum_type"], message, "leave `spectrum_type` out");
    }
    let own_of_type_2 = of_type_2.filter(|_| spectrum_type == Some(SpectrumType::Type2));
    let acceleration_g = own_of_type_2.or(of_place).or(stated_g);
    let soil_factor = reader.positive("soil_factor", Dimension::Ratio);
    let corners = eurocode8_corners(reader);
    let is_complete = ["soil_factor", "corner_periods"]
        .iter()
        .all(|key| reader.has(key));
    let ground = match reader.words.get("site") {
        Some(text) => {
            let hint = "A rock, B very dense or very stiff, C dense or stiff, D loose or soft, E a layer of C or D over rock";
            site_class(reader, text, GroundType::parse, CODE, hint)
        }
        None if is_complete => None,
        None if place.is_some() => Some(DEFAULT_GROUND),
        None => {
            missing(reader, "site", CODE, "B");
            None
        }
    };
    if !reader.problems.is_empty() {
        return None;
    }
    let (spectrum_type, acceleration_g, importance) =
        (spectrum_type?, acceleration_g?, importance?);
    let is_shape = matches!(hazard, Some(PlaceHazard::Shape { .. }));
    let (soil_factor, corners) = match hazard {
        Some(PlaceHazard::Shape {
            is_on_site,
            corner_period_s,
            ..
        }) => {
            let of_type =
                SpectrumShape::recommended(spectrum_type, ground.unwrap_or(DEFAULT_GROUND));
            // A value on the soil has its amplification in it.
            let soil_factor = soil_factor.or(is_on_site.then_some(1.0));
            let corners = corners
                .or(corner_period_s.map(|tc_s| [of_type.tb_s, tc_s, of_type.td_s.max(tc_s)]));
            (soil_factor, corners)
        }
        _ => (soil_factor, corners),
    };
    // Values that the user states take the place of a shape of the annex.
    let annex = annex.filter(|_| soil_factor.is_none() && corners.is_none());
    let of_annex = annex.zip(ground).map(|(annex, ground)| {
        let of_type = |kind, a_g| Eurocode8::of_annex(annex, kind, ground, a_g, importance);
        // The type that the user names counts alone.
        let other = of_type_2.filter(|_| !reader.has("spectrum_type"));
        (
            of_type(spectrum_type, acceleration_g),
            other.map(|a_g| of_type(SpectrumType::Type2, a_g)),
        )
    });
    let recommended = ground.map(|ground| SpectrumShape::recommended(spectrum_type, ground));
    let (result, alternative) = match of_annex {
        Some((code, other)) => (code, other.and_then(Result::ok)),
        None => {
            let shape = eurocode8_shape(recommended, soil_factor, corners)?;
            (
                Eurocode8::with_shape(spectrum_type, ground, acceleration_g, importance, shape),
                None,
            )
        }
    };
    let code = made(
        reader,
        &["ground_acceleration", "soil_factor", "corner_periods"],
        result,
    )?;
    // Where one spectrum must serve, it is the one with the larger velocity: that is what tips objects over.
    let peak_velocity = |code: &Eurocode8| code.plateau_g() * code.shape().tc_s;
    let (code, alternative) = match alternative {
        Some(other) if peak_velocity(&other) > peak_velocity(&code) => (other, Some(code)),
        other => (code, other),
    };
    if annex.is_some_and(|annex| !annex.has_ground_types()) && reader.has("site") {
        let message =
            "the national annex has no ground types: the corner period belongs to the place";
        reader.note(&["site"], message, "leave `site` out");
        return None;
    }
    let unstated = if annex.is_some() {
        "of the national annex"
    } else {
        "recommended"
    };
    let given = |is_given: bool| if is_given { "as given" } else { unstated };
    let facts = eurocode8_facts(
        &code,
        |key| reader.has(key),
        [given(soil_factor.is_some()), given(corners.is_some())],
    );
    let mut target = at(place, target(code.into(), facts));
    target
        .facts
        .extend(annex.map(|annex| fact("National annex", annex.name())));
    let years = match hazard {
        Some(PlaceHazard::Shape {
            return_period_years,
            ..
        }) => return_period_years,
        _ => place.and_then(|place| Some(place.derived?.years)),
    };
    if let Some(years) = years {
        target
            .facts
            .push(fact("Return period", format!("{years} years")));
    }
    if let Some(other) = alternative {
        let both = [&code, &other].map(|code| AnnexSpectrum {
            number: code.spectrum_type().number(),
            reference_acceleration_g: code.reference_acceleration_g(),
        });
        target
            .facts
            .push(fact("Second spectrum of the annex", both[1].name()));
        target.doubts.push(TargetDoubt::TwoSpectra(both));
        target.alternative = Some(other.into());
    }
    if !code.is_recommended() && annex.is_none() && !is_shape {
        target.doubts.push(TargetDoubt::OwnShape);
    }
    Some(target)
}

/// The spectrum that EN 1998-1 recommends, every value of which is stated.
pub(super) fn recommended_eurocode8(
    spectrum_type: SpectrumType,
    ground: GroundType,
    ground_acceleration_g: f64,
) -> Result<Target, CodeSpectrumError> {
    let code = Eurocode8::new(spectrum_type, ground, ground_acceleration_g, 1.0)?;
    let facts = eurocode8_facts(&code, |_| true, ["recommended"; 2]);
    Ok(target(code.into(), facts))
}

/// What reports state about a spectrum: whether a key was stated, and where the soil factor and the corner
/// periods come from.
fn eurocode8_facts(
    code: &Eurocode8,
    is_stated: impl Fn(&str) -> bool,
    [soil_from, corners_from]: [&str; 2],
) -> Vec<(String, String)> {
    let assumed = |key: &str| if is_stated(key) { "" } else { ", assumed" };
    let shape = code.shape();
    let ground = code.ground().map_or_else(
        || "not given".to_owned(),
        |ground| {
            let (name, description) = (ground.name(), ground.description());
            format!("{name}: {description}{}", assumed("site"))
        },
    );
    let kind = code.spectrum_type().number();
    let [tb_s, tc_s, td_s] = code.corner_periods_s().map(|period_s| number(period_s, 4));
    vec![
        fact(
            "Type of spectrum",
            format!("{kind}{}", assumed("spectrum_type")),
        ),
        fact("Ground type", ground),
        fact(
            "Reference ground acceleration a_gR",
            in_g(code.reference_acceleration_g()),
        ),
        fact(
            "Importance factor γ_I",
            number(code.importance_factor_ratio(), 4),
        ),
        fact(
            "Soil factor S",
            format!("{}, {soil_from}", number(shape.soil_factor_ratio, 4)),
        ),
        fact(
            "TB, TC, TD",
            format!("{tb_s} s, {tc_s} s, {td_s} s, {corners_from}"),
        ),
    ]
}

fn eurocode8_corners(reader: &mut WordReader) -> Option<[f64; 3]> {
    let periods_s = reader.grid("corner_periods", Dimension::Time)?;
    match periods_s[..] {
        [tb_s, tc_s, td_s] if tb_s > 0.0 && tc_s >= tb_s && td_s >= tc_s => {
            Some([tb_s, tc_s, td_s])
        }
        _ => {
            let message = "`corner_periods` must be three periods, 0 < TB ≤ TC ≤ TD";
            reader.note(
                &["corner_periods"],
                message,
                "give `corner_periods = \"0.15 s, 0.5 s, 2 s\"`",
            );
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
    let [tb_s, tc_s, td_s] =
        corners_s.or_else(|| recommended.map(|shape| [shape.tb_s, shape.tc_s, shape.td_s]))?;
    let soil_factor_ratio =
        soil_factor_ratio.or_else(|| recommended.map(|shape| shape.soil_factor_ratio))?;
    Some(SpectrumShape {
        soil_factor_ratio,
        tb_s,
        tc_s,
        td_s,
    })
}

pub(super) fn asce7(reader: &mut WordReader, place: Option<&Place>) -> Option<Target> {
    const CODE: Code = Code::Asce7;
    // The values of places are those of 2016.
    let known = [
        ("2022", Asce7Edition::Asce7_22),
        ("2016", Asce7Edition::Asce7_16),
    ];
    let edition = match reader.has("edition") || place.is_none() {
        true => edition(reader, &known, "2022 or 2016"),
        false => Some(Asce7Edition::Asce7_16),
    };
    refuse_beside_place(reader, &["ss", "s1", "sds", "sd1"]);
    let is_mapped = place.is_some()
        || ["ss", "s1", "fa", "fv", "site"]
            .iter()
            .any(|key| reader.has(key));
    let design: Vec<&'static str> = ["sds", "sd1"]
        .into_iter()
        .filter(|key| reader.has(key))
        .collect();
    if let (true, Some(key), None) = (is_mapped, design.first().copied(), place) {
        let message = format!("`{key}` and mapped accelerations exclude each other");
        reader.note(
            &[key, "ss", "s1", "fa", "fv", "site"],
            message,
            "give SDS and SD1, or Ss, S1 and the site",
        );
        return None;
    }
    let long_period_s = match reader.has("long_period") || place.is_none() {
        true => needed(reader, "long_period", Dimension::Time, CODE, "8 s"),
        false => Some(DEFAULT_LONG_PERIOD_S),
    };
    let mut facts = Vec::new();
    let (mut doubts, mut period_doubts) = (Vec::new(), Vec::new());
    let code = if is_mapped {
        let (ss, s1) = match place.map(|place| place.hazard) {
            Some(PlaceHazard::Asce7 { ss_g, s1_g }) => (Some(ss_g), Some(s1_g)),
            _ => ["ss", "s1"].map(|key| mapped(reader, key, CODE)).into(),
        };
        let found = coefficients(reader, ss, s1, place.is_some());
        let (
            ss,
            s1,
            Coefficients {
                fa,
                fv,
                site,
                asks_for_study,
            },
        ) = (ss?, s1?, found?);
        facts.push(fact("Ss, S1", format!("{}, {}", in_g(ss), in_g(s1))));
        if let Some(site) = site {
            let assumed = if reader.has("site") { "" } else { ", assumed" };
            facts.push(fact(
                "Site class",
                format!("{}: {}{assumed}", site.name(), site.description()),
            ));
        }
        facts.push(fact(
            "Fa, Fv",
            format!("{}, {}", number(fa, 4), number(fv, 4)),
        ));
        if asks_for_study {
            period_doubts.push(TargetDoubt::AsksForStudy);
        }
        if site.is_some() && edition == Some(Asce7Edition::Asce7_22) {
            doubts.push(TargetDoubt::CoefficientsOf2016);
        }
        let result = Asce7::from_mapped(edition?, (ss, fa), (s1, fv), long_period_s?);
        let code = made(reader, &["ss", "s1", "fa", "fv", "long_period"], result)?;
        site.map_or(code, |site| code.on_site(site))
    } else {
        let sds = needed(reader, "sds", Dimension::Acceleration, CODE, "1 g");
        let sd1 = needed(reader, "sd1", Dimension::Acceleration, CODE, "0.6 g");
        let result = Asce7::new(edition?, sds? / G0_M_S2, sd1? / G0_M_S2, long_period_s?);
        made(reader, &["sds", "sd1", "long_period"], result)?
    };
    let [t0_s, ts_s, tl_s] = code.corner_periods_s().map(|period_s| number(period_s, 4));
    let assumed = if reader.has("long_period") {
        ""
    } else {
        " (TL assumed: confirm it on the maps of the code)"
    };
    facts.push(fact(
        "SDS, SD1",
        format!("{}, {}", in_g(code.sds_g()), in_g(code.sd1_g())),
    ));
    facts.push(fact(
        "T0, TS, TL",
        format!("{t0_s} s, {ts_s} s, {tl_s} s{assumed}"),
    ));
    let mut target = at(place, target(code.into(), facts));
    target.doubts.extend(doubts);
    target.period_doubts = period_doubts;
    let in_force = place.and_then(parts_edition_in_force);
    target.parts_edition = in_force.filter(|_| !reader.has("edition"));
    Some(target)
}

/// The edition of ASCE 7 that a state has adopted, where it is known not to be that of the mapped
/// values: the California Building Code of 2025, in force since 2026-01-01, refers to ASCE 7-22 through
/// the International Building Code of 2024.
fn parts_edition_in_force(place: &Place) -> Option<Asce7Edition> {
    (place.region == "CA").then_some(Asce7Edition::Asce7_22)
}

/// A mapped acceleration \[g\].
pub(super) fn mapped(reader: &mut WordReader, key: &'static str, code: Code) -> Option<f64> {
    let example = if key == "ss" { "1.5 g" } else { "0.6 g" };
    needed(reader, key, Dimension::Acceleration, code, example).map(|value| value / G0_M_S2)
}

/// The site coefficients of ASCE 7, and where they are from.
struct Coefficients {
    fa: f64,
    fv: f64,
    site: Option<Asce7Site>,
    asks_for_study: bool,
}

/// Fa and Fv as given, or of the site class.
fn coefficients(
    reader: &mut WordReader,
    ss_g: Option<f64>,
    s1_g: Option<f64>,
    has_place: bool,
) -> Option<Coefficients> {
    let is_given = reader.has("fa") || reader.has("fv");
    if is_given || !reader.has("site") && !has_place {
        for key in ["fa", "fv"] {
            reader.exclusive("site", key);
            if !reader.has(key) {
                let (example, also) = if key == "fa" {
                    ("1.0", "D")
                } else {
                    ("1.7", "D")
                };
                let hint = format!(
                    "give `{key} = \"{example}\"`, or `site = \"{also}\"` for the tables of the code"
                );
                reader.missing(&[key, "code"], format!("ASCE 7 needs `{key}`"), hint);
            }
        }
        let fa = reader.positive("fa", Dimension::Ratio);
        let fv = reader.positive("fv", Dimension::Ratio);
        return Some(Coefficients {
            fa: fa?,
            fv: fv?,
            site: None,
            asks_for_study: false,
        });
    }
    let site = match reader.words.get("site") {
        None => Some(DEFAULT_ASCE7_SITE),
        Some(text) => {
            let hint = "A hard rock, B rock, C very dense soil or soft rock, D stiff soil, E soft clay; class F needs a \
                        site-specific study: give its `sds` and `sd1`";
            site_class(reader, text, Asce7Site::parse, Code::Asce7, hint)
        }
    }?;
    match site_coefficients(site, ss_g?, s1_g?, !reader.has("site")) {
        Ok(found) => Some(Coefficients {
            fa: found.fa_ratio,
            fv: found.fv_ratio,
            site: Some(site),
            asks_for_study: found.asks_for_study,
        }),
        Err(error) => {
            reader.note(
                &["site"],
                error.to_string(),
                "give `sds` and `sd1` of the study, or another site class",
            );
            None
        }
    }
}

pub(super) fn nzs1170_5(reader: &mut WordReader, place: Option<&Place>) -> Option<Target> {
    const CODE: Code = Code::Nzs1170_5;
    edition(reader, &[("2004", ())], "2004");
    refuse_beside_place(reader, &["hazard_factor"]);
    let hazard = match place.map(|place| place.hazard) {
        Some(PlaceHazard::Nzs1170_5 { hazard_factor }) => Some(hazard_factor),
        _ => needed(reader, "hazard_factor", Dimension::Ratio, CODE, "0.40"),
    };
    let site = match reader.words.get("site") {
        Some(text) => {
            let hint =
                "A strong rock, B rock, C shallow soil, D deep or soft soil, E very soft soil";
            site_class(reader, text, SubsoilClass::parse, CODE, hint)
        }
        None if place.is_some() => Some(DEFAULT_SUBSOIL),
        None => {
            missing(reader, "site", CODE, "C");
            None
        }
    };
    let years = return_period(
        reader,
        DEFAULT_YEARS,
        |years| return_period_factor(years).map(|_| ()),
        "see Table 3.5 of NZS 1170.5",
    );
    let distance_km = match reader.has("fault_distance") {
        true => Some(reader.non_negative("fault_distance", Dimension::Length)? / 1e3),
        false => place.and_then(|place| place.fault_distance_km),
    };
    let code = Nzs1170_5::new(site?, hazard?, years?, distance_km);
    let code = made(reader, &["hazard_factor", "fault_distance"], code)?;
    let maximum = if code.maximum_governs() {
        " (the code’s maximum governs)"
    } else {
        ""
    };
    let fault = match distance_km {
        Some(km) if km >= FAR_KM => format!("{} km away or more: N(T, D) = 1", number(km, 4)),
        None => "none near: N(T, D) = 1".to_owned(),
        Some(km) if code.is_near_fault() => {
            format!("{} km away: N(T, D) rises from 1.5 s on", number(km, 4))
        }
        Some(km) => format!("{} km away: N(T, D) = 1 by the code", number(km, 4)),
    };
    let assumed = if reader.has("site") { "" } else { ", assumed" };
    let facts = vec![
        fact(
            "Site subsoil class",
            format!(
                "{}: {}{assumed}",
                code.site().name(),
                code.site().description()
            ),
        ),
        fact("Hazard factor Z", number(code.hazard_factor(), 4)),
        fact(
            "Return period",
            format!(
                "{} years, R = {}",
                code.return_period_years(),
                code.return_factor_ratio()
            ),
        ),
        fact("Z·R", format!("{}{maximum}", in_g(code.zr_g()))),
        fact("Major fault", fault),
    ];
    let mut target = at(place, target(code.into(), facts));
    if code.maximum_governs() {
        let zr_ratio = code.hazard_factor() * code.return_factor_ratio();
        target.doubts.push(TargetDoubt::MaximumGoverns { zr_ratio });
    }
    Some(target)
}
