//! A spectrum from a hazard file that people download: `spectrum` names it, `return_period_years` the spectrum in it, and
//! the place the site.

use std::path::Path;

use freestand::G0_M_S2;
use freestand::code_spectrum::OutOfRange;
use freestand::synthesis::LONGEST_PERIOD_S;
use freestand_input::file::{InputFile, file_name};
use freestand_input::keys::Words;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_input::words::number;
use freestand_records::tables::hazard::{
    CodeValues, ReturnSpectrum, SiteHazard, load_hazard, read_hazard, recognised,
};

use super::code::Code;
use super::codes::{self, fact};
use super::doubt::TargetDoubt;
use super::named::named_place;
use super::table::{self, Rows};
use super::words::{Remedies, check_keys};
use super::{Target, countries};
use crate::places::{Confidence, Coordinates, Place, PlaceHazard, Size, wanted_site};

/// The values that a file states in place of the words.
const STATED: [&str; 5] = ["ss", "s1", "sds", "sd1", "ground_acceleration"];

/// The target of a hazard file; `None` where the words name none.
pub(super) fn resolve(
    words: &Words,
    base_dir: &Path,
    remedies: Remedies,
) -> Option<Result<Target, Problems>> {
    let path = base_dir.join(words.get("spectrum")?);
    let bytes = match load_hazard(&path) {
        Ok(bytes) => bytes,
        // Beside words that a table does not take, a hazard file is meant.
        Err(problem)
            if named_place(words).is_some() || words.get("return_period_years").is_some() =>
        {
            return Some(Err(problem.of(&["spectrum"]).into()));
        }
        Err(_) => return None,
    };
    recognised(&bytes)?;
    Some(read(words, &path, &bytes, remedies))
}

fn read(words: &Words, path: &Path, bytes: &[u8], remedies: Remedies) -> Result<Target, Problems> {
    let mut reader = WordReader::new(words);
    for key in STATED {
        reader.exclusive("spectrum", key);
    }
    let years = match reader.has("return_period_years") {
        true => reader.positive("return_period_years", Dimension::Ratio),
        false => None,
    };
    let place = named_place(words);
    let wanted = reader
        .problems
        .keep(wanted_site(place.as_ref().map(|(_, text)| text.as_str())));
    let key = place.as_ref().map_or("place", |(key, _)| key);
    let of_key = |problem: Problem| match problem.is_about("place") {
        true => problem.renamed("place", key),
        false => problem.of(&["spectrum"]),
    };
    let site = wanted.and_then(|wanted| {
        let site = read_hazard(bytes, path, &wanted);
        reader.problems.keep(site.map_err(of_key))
    });
    let ground = site.as_ref().and_then(|site| {
        let ground = ground(site, years);
        reader
            .problems
            .keep(ground.map_err(|problem| of_key(problem).in_file(path)))
    });
    let target = site.zip(ground).and_then(|(site, ground)| {
        let file = InputFile::new(path, bytes);
        let name = file_name(path).unwrap_or_default();
        let target = match ground {
            FoundGround::Values(code, hazard) => {
                let place = place_in_file(&site, hazard, &name);
                let mut left = words.clone();
                for key in ["spectrum", "interpolation", "beyond"] {
                    left.remove(key);
                }
                // A level of TBDY 2018 has a return period, and ASCE 7 refuses one; a map of the other codes was chosen
                // by it.
                if !matches!(code, Code::Tbdy2018 | Code::Asce7) {
                    left.remove("return_period_years");
                }
                // The file was asked for a site class, and knows the long-period transition: without others, these count.
                if let Some(CodeValues::Asce7 {
                    site_class,
                    long_period_s,
                    ..
                }) = &site.code
                {
                    let long_period = long_period_s.map(|seconds| format!("{seconds} s"));
                    for (key, value) in [("site", site_class.clone()), ("long_period", long_period)]
                    {
                        if let (None, Some(value)) = (left.get(key), value) {
                            left.set(key, value);
                        }
                    }
                }
                of_values(&mut reader, &left, code, &place, remedies)
            }
            FoundGround::Spectrum(spectrum) => {
                of_spectrum(&mut reader, &site, spectrum, &name, remedies)
            }
        };
        let mut target = target?;
        if let Some(statistic) = site.other_than_mean() {
            target.doubts.push(TargetDoubt::NotMean {
                name,
                statistic: statistic.clone(),
            });
        }
        target.file = Some(file);
        Some(target)
    });
    reader.problems.finish(target)
}

/// What a file has for `[ground]`.
enum FoundGround {
    /// The values of a code.
    Values(Code, PlaceHazard),
    /// A spectrum.
    Spectrum(ReturnSpectrum),
}

fn ground(site: &SiteHazard, years: Option<f64>) -> Result<FoundGround, Problem> {
    let in_program = |what: &str, example: &str| {
        let message = format!("the values of {what} are in the program");
        let hint = format!("name the place alone, without `spectrum`: `place = \"{example}\"`");
        Err(Problem::value(message, hint).of(&["spectrum"]))
    };
    match &site.code {
        Some(CodeValues::Asce7 { ss_g, s1_g, .. }) => {
            let (ss_g, s1_g) = (*ss_g, *s1_g);
            return Ok(FoundGround::Values(
                Code::Asce7,
                PlaceHazard::Asce7 { ss_g, s1_g },
            ));
        }
        Some(CodeValues::Tbdy2018 { ss_g, s1_g }) => {
            let (ss_g, s1_g) = (*ss_g, *s1_g);
            let hazard = PlaceHazard::Tbdy2018 { ss_g, s1_g };
            return Ok(FoundGround::Values(Code::Tbdy2018, hazard));
        }
        Some(CodeValues::Ntc2018) => {
            let at = site.at.map_or_else(String::new, Coordinates::words);
            return in_program("NTC 2018", &at);
        }
        Some(CodeValues::Ts1170_5(_)) => {
            return in_program("TS 1170.5", site.name.as_deref().unwrap_or("Hastings"));
        }
        None => {}
    }
    let spectrum = site.spectrum(years)?;
    match spectrum.values[..] {
        [(0.0, acceleration_g)] => Ok(FoundGround::Values(
            Code::Eurocode8,
            PlaceHazard::Shape {
                acceleration_g,
                // Maps are for rock, unless the site model of the calculation has another Vs30.
                is_on_site: false,
                corner_period_s: None,
                return_period_years: spectrum.years.map(|years| years.round() as u32),
                by: None,
            },
        )),
        [_] => Err(Problem::value(
            "the file has one spectral acceleration alone, which is no spectrum",
            "give a file with several periods, or with the peak ground acceleration",
        )),
        _ => Ok(FoundGround::Spectrum(spectrum)),
    }
}

/// A site of the file as a place, so that codes read its values as those of any place.
fn place_in_file(site: &SiteHazard, hazard: PlaceHazard, name: &str) -> Place {
    let at = site.at.map(Coordinates::words);
    let called = site.name.clone().or(at).unwrap_or_else(|| name.to_owned());
    Place {
        name: called.into(),
        other_names: "",
        region: "",
        country: "",
        size: Size::City,
        hazard,
        source: format!("{name} ({})", site.format.name()).into(),
        confidence: Confidence::Read,
        coordinates: site.at,
        distance_km: site.distance_km,
        fault_distance_km: None,
        derived: None,
    }
}

fn of_values(
    reader: &mut WordReader,
    left: &Words,
    code: Code,
    place: &Place,
    remedies: Remedies,
) -> Option<Target> {
    let mut own = WordReader::new(left);
    let stated = left.get("code").map(Code::parse);
    if stated.is_some_and(|stated| stated != Some(code)) {
        let message = format!("the file of `spectrum` has values for {}", code.title());
        own.note(&["code"], message, "leave `code` out");
    }
    check_keys(&mut own, code, remedies);
    let target = match code {
        Code::Asce7 => codes::asce7(&mut own, Some(place)),
        Code::Tbdy2018 => countries::tbdy2018(&mut own, Some(place)),
        _ => codes::eurocode8(&mut own, Some(place)),
    };
    for problem in own.problems {
        reader.problems.push(problem);
    }
    target
}

fn of_spectrum(
    reader: &mut WordReader,
    site: &SiteHazard,
    spectrum: ReturnSpectrum,
    name: &str,
    remedies: Remedies,
) -> Option<Target> {
    let mut left = reader.words.clone();
    for key in STATED {
        left.remove(key);
    }
    for key in [
        "return_period_years",
        "place",
        "city",
        "latitude",
        "longitude",
    ] {
        left.remove(key);
    }
    let mut own = WordReader::new(&left);
    if left
        .get("code")
        .is_some_and(|text| Code::parse(text) != Some(Code::Table))
    {
        let hint = "leave `code` out: the spectrum is that of the file";
        own.note(
            &["code", "spectrum"],
            "`code` and `spectrum` exclude each other",
            hint,
        );
    }
    check_keys(&mut own, Code::Table, remedies);
    let interpolation = table::interpolation(&mut own);
    // Few of these spectra reach as far as motions are matched; tables of one's own are refused then, because their periods
    // are for their author to choose.
    let out_of_range = match own.has("beyond") {
        true => table::beyond(&mut own),
        false => Some(OutOfRange::Hold),
    };
    let last_s = spectrum.values.last().map_or(0.0, |value| value.0);
    let values = spectrum
        .values
        .iter()
        .map(|(period_s, sa_g)| (*period_s, sa_g * G0_M_S2));
    let rows = Rows {
        values: values.collect(),
        name,
    };
    let target = table::made(&mut own, rows, interpolation, out_of_range);
    let is_held = !own.has("beyond") && last_s < LONGEST_PERIOD_S;
    for problem in own.problems {
        reader.problems.push(problem);
    }
    let mut target = target?;
    if is_held {
        target.doubts.push(TargetDoubt::EndsEarly {
            name: name.to_owned(),
            last_s,
        });
    }
    if let (Some(at), Some(distance_km)) = (site.at, site.distance_km) {
        target.doubts.push(TargetDoubt::OtherSite {
            name: name.to_owned(),
            years: spectrum.years,
            at,
            distance_km,
        });
    }
    target.facts.extend(facts(site, spectrum.years));
    Some(target)
}

fn facts(site: &SiteHazard, years: Option<f64>) -> Vec<(String, String)> {
    let statistic = site
        .statistic
        .as_ref()
        .map_or_else(String::new, |statistic| format!(", {}", statistic.name()));
    let mut facts = vec![fact(
        "Hazard file",
        format!("{}{statistic}", site.format.name()),
    )];
    let at = site.at.map(Coordinates::words);
    let called = [site.name.clone(), at].into_iter().flatten();
    let called = called.collect::<Vec<_>>().join(", ");
    if !called.is_empty() {
        let away = site
            .distance_km
            .map_or_else(String::new, |km| format!(", {} km away", number(km, 2)));
        facts.push(fact("Site of the file", format!("{called}{away}")));
    }
    facts.extend(years.map(|years| fact("Return period", format!("{years:.0} years"))));
    facts
}

#[cfg(test)]
mod tests {
    use freestand_records::tables::hazard::Statistic;

    use super::*;
    use crate::places::WhyDoubted;

    fn in_file(name: &str, text: &str, pairs: &[(&'static str, &str)]) -> Result<Target, Problems> {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join(name), text).unwrap();
        let mut words: Words = pairs.iter().copied().collect();
        words.set("spectrum", name);
        Target::resolve(&words, folder.path())
    }

    /// The only problem, with its hint.
    fn problem(found: Result<Target, Problems>) -> String {
        let problems = found.unwrap_err();
        assert_eq!(problems.len(), 1, "{problems}");
        let one = problems.into_iter().next().unwrap();
        format!("{one} | {}", one.hint.clone().unwrap())
    }

    const SPECTRA: &str = "#,\"kind='mean', investigation_time=50.0\"\n\
                           lon,lat,0.1~PGA,0.1~SA(0.2),0.1~SA(1.0),0.02~PGA,0.02~SA(0.2),0.02~SA(1.0)\n\
                           28.97,41.01,0.3,0.7,0.3,0.6,1.4,0.6\n29.5,41.0,0.2,0.5,0.2,0.4,1.0,0.4\n";

    /// What is not the mean of its model says so, and the period of the file's long-period transition counts unless another
    /// one is given.
    #[test]
    fn a_file_says_what_it_is() {
        let place = [("place", "41.0, 28.9"), ("return_period_years", "475")];
        let doubts = |text: &str| in_file("uhs.csv", text, &place).unwrap().doubts;
        for (kind, statistic) in [
            ("quantile-0.84", Statistic::Quantile(0.84)),
            ("rlz-001", Statistic::Realization),
        ] {
            let found = doubts(&SPECTRA.replace("mean", kind));
            let name = "uhs.csv".to_owned();
            let wanted = TargetDoubt::NotMean { name, statistic };
            assert!(found.contains(&wanted), "{found:?}");
        }
        let is_not_mean = |doubt: &TargetDoubt| matches!(doubt, TargetDoubt::NotMean { .. });
        assert!(!doubts(SPECTRA).iter().any(is_not_mean));
        let values = r#"{"response":{"data":{"ss":1.9,"s1":0.7,"tl":12}}}"#;
        let fact = |text: &str, pairs: &[(&'static str, &str)]| {
            let target = in_file("values.json", text, pairs).unwrap();
            let found = target.facts.iter().find(|fact| fact.0 == "T0, TS, TL");
            found.unwrap().1.clone()
        };
        assert!(fact(values, &[]).ends_with(", 12 s"));
        assert!(fact(values, &[("long_period", "6 s")]).ends_with(", 6 s"));
        let without = values.replace(",\"tl\":12", "");
        assert!(fact(&without, &[]).contains(", 8 s (TL assumed"));
    }

    /// The site by coordinates or by the name of a known place, the spectrum by its return period; the displacement is constant
    /// beyond the last period.
    #[test]
    fn a_spectrum_of_a_file() {
        fn of(pairs: &[(&'static str, &str)]) -> Result<Target, Problems> {
            in_file("uhs.csv", SPECTRA, pairs)
        }
        let years = ("return_period_years", "475");
        for place in [
            [("place", "41.0, 28.9"), years],
            [("place", "Istanbul"), years],
        ] {
            let target = of(&place).unwrap();
            let near = |period_s: f64, sa_g: f64| {
                assert!((target.spectrum.sa_g(period_s) / sa_g - 1.0).abs() < 1e-12);
            };
            near(0.0, 0.3);
            near(0.2, 0.7);
            near(2.0, 0.3 / 4.0);
            assert_eq!(
                (target.code(), target.check_matched_band()),
                ("table", Ok(()))
            );
            assert!(
                matches!(target.doubts[0], TargetDoubt::EndsEarly { last_s: 1.0, .. }),
                "{:?}",
                target.doubts
            );
            let fact = |name: &str| {
                let found = target.facts.iter().find(|fact| fact.0 == name);
                found.unwrap().1.clone()
            };
            assert_eq!(fact("Return period"), "475 years");
            assert!(
                fact("Site of the file").starts_with("41.01, 28.97, "),
                "{}",
                fact("Site of the file")
            );
            assert!(target.file.is_some() && target.place.is_none());
        }
        let rare = of(&[
            ("latitude", "41"),
            ("longitude", "29.5"),
            ("return_period_years", "2475"),
        ])
        .unwrap();
        assert_eq!(rare.spectrum.sa_g(0.0), 0.4);
        for (pairs, said) in [
            (
                &[years][..],
                "the file has 2 sites | name one, such as `place = \"41.01, 28.97\"`",
            ),
            (
                &[("place", "41, 28.97")],
                "the file has spectra at 475, 2475 years | name one: `return_period_years = 475`",
            ),
            (
                &[("place", "41, 28.97"), ("return_period_years", "1000")],
                "no spectrum at 1000 years",
            ),
            (
                &[("place", "Rome"), years],
                "the nearest, 41.01, 28.97, is 1",
            ),
            (
                &[("place", "41, 28.97"), years, ("ss", "1 g")],
                "`spectrum` and `ss` exclude each other",
            ),
            (
                &[("place", "41, 28.97"), years, ("code", "asce7")],
                "`code` and `spectrum` exclude",
            ),
            (
                &[("place", "41, 28.97"), years, ("site", "C")],
                "`site` is not part of a user's table",
            ),
            (
                &[("place", "41, 28.97"), years, ("beyond", "cut")],
                "beyond",
            ),
        ] {
            let told = problem(of(pairs));
            assert!(told.contains(said), "{said}: {told}");
        }
        // What a run leaves behind is the same table to the bit.
        let target = of(&[("place", "Istanbul"), years]).unwrap();
        let again = in_file(
            "again.csv",
            target.table_csv.as_deref().unwrap(),
            &[("beyond", "hold")],
        );
        assert_eq!(again.unwrap().spectrum, target.spectrum);
    }

    /// Values of a code are those of a place: the code makes the spectrum, on the site that the words name.
    #[test]
    fn values_of_codes_in_files() {
        let usgs = r#"{"request":{"parameters":{"latitude":34,"longitude":-118}},"response":{"data":{"ss":1.9,"s1":0.7}}}"#;
        let target = in_file("design.json", usgs, &[("site", "C")]).unwrap();
        // ASCE 7-16: Fa = 1.2 of class C.
        assert!((target.spectrum.plateau_g() - 2.0 / 3.0 * 1.2 * 1.9).abs() < 1e-12);
        assert_eq!(target.code(), "asce7");
        let place = target.place.unwrap();
        assert_eq!(place.name, "34, -118");
        assert!(place.source.contains("design.json"));
        let afad = "LON,LAT,PGA-DD1,PGA-DD2,PGA-DD3,PGA-DD4,Ss-DD1,Ss-DD2,Ss-DD3,Ss-DD4,S1-DD1,S1-DD2,S1-DD3,S1-DD4,PGV-DD4,PGV-DD3,PGV-DD2,PGV-DD1\n\
                    24.55,39.95,1.32,0.716,0.218,0.138,3.273,1.714,0.501,0.317,0.878,0.437,0.121,0.076,7.596,12.321,44.717,83.452\n";
        let of = |pairs: &[(&'static str, &str)]| in_file("afad.csv", afad, pairs);
        let target = of(&[("site", "ZB"), ("return_period_years", "2475")]).unwrap();
        // F_S = 0.9 of rock, ZB.
        assert!(
            (target.spectrum.plateau_g() - 0.9 * 3.273).abs() < 1e-12,
            "{}",
            target.one_line()
        );
        let told = problem(of(&[("return_period_years", "72")]));
        assert!(told.contains("72"), "{told}");
        let told = problem(of(&[("code", "asce7")]));
        assert!(
            told.contains("the file of `spectrum` has values for TBDY 2018"),
            "{told}"
        );
    }

    /// A peak acceleration alone has the shape of Eurocode 8; curves give a spectrum at any return period within them.
    #[test]
    fn peaks_and_curves() {
        let map = "#,\"kind='mean', investigation_time=1.0\"\nlon,lat,PGA-0.002105\n1,2,0.3\n";
        let target = in_file(
            "map.csv",
            map,
            &[("site", "A"), ("return_period_years", "475")],
        )
        .unwrap();
        // Type 1, rock: 2.5 a_g.
        assert!((target.spectrum.sa_g(0.2) - 0.75).abs() < 1e-12);
        let why = match &target.doubts[..] {
            [TargetDoubt::Place(doubt)] => doubt.why,
            other => panic!("{other:?}"),
        };
        let shape = WhyDoubted::Shape {
            by: None,
            is_approximate: false,
        };
        assert_eq!(why, shape);
        assert!(!target.has_parts());
        let curves = r#"{"response":[{"metadata":{"imt":{"value":"PGA"},"xvals":[0.1,1]},"data":[{"yvals":[0.01,0.0001]}]},
            {"metadata":{"imt":{"value":"SA0P2"},"xvals":[0.2,2]},"data":[{"yvals":[0.01,0.0001]}]}]}"#;
        // k = 2: 400 years are twice the intensity of 100 years.
        let target = in_file("curves.json", curves, &[("return_period_years", "400")]).unwrap();
        assert!((target.spectrum.sa_g(0.2) - 0.4).abs() < 1e-12);
        let told = problem(in_file("curves.json", curves, &[]));
        assert!(told.contains("a spectrum needs a return period"), "{told}");
        let told = problem(in_file(
            "curves.json",
            curves,
            &[("return_period_years", "40000")],
        ));
        assert!(
            told.contains("does not reach 40000 years: it has 100 to 10000 years"),
            "{told}"
        );
    }
}
