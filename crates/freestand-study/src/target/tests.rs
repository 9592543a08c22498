use super::code::CODES;
use super::*;
use crate::places::WhyDoubted;
use freestand_input::problem::Problem;

/// Keys and their values.
type Pairs<'a> = &'a [(&'static str, &'a str)];

fn words(pairs: Pairs) -> Words {
    pairs.iter().copied().collect()
}

fn target(pairs: Pairs) -> Target {
    Target::resolve(&words(pairs), "".as_ref()).unwrap()
}

/// Every problem: message and hint.
fn problems(pairs: Pairs) -> Vec<String> {
    let shown = |one: Problem| format!("{one} | {}", one.hint.as_deref().unwrap_or("-"));
    Target::resolve(&words(pairs), "".as_ref())
        .unwrap_err()
        .into_iter()
        .map(shown)
        .collect()
}

fn in_file(name: &str, text: &str, pairs: Pairs) -> Result<Target, Problems> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(name), text).unwrap();
    let mut words = words(pairs);
    words.set("spectrum", name);
    Target::resolve(&words, folder.path())
}

/// Why the values of the place are doubted.
fn why(doubts: &[TargetDoubt]) -> Option<WhyDoubted> {
    doubts.iter().find_map(|doubt| match doubt {
        TargetDoubt::Place(doubt) => Some(doubt.why),
        _ => None,
    })
}

#[test]
fn nothing_said_is_melbourne_on_deep_soil() {
    let target = target(&[]);
    assert_eq!(
        target.one_line(),
        "AS 1170.4-2007 (Amdt 1, 2), site De, Z = 0.08 (Melbourne), 500 years, kpZ = 0.08 g"
    );
    // Nobody chose it, which is said.
    assert!(target.place_is_assumed);
    assert_eq!(target.doubts, [TargetDoubt::PlaceAssumed("Melbourne")]);
    assert_eq!(
        (
            target.kpz_g(),
            target.as1170_4().map(As1170_4::minimum_governs)
        ),
        (Some(0.08), Some(false))
    );
}

/// One hand value of each code: Ce 2.5 · 0.11 · 1.8 at 0.5 s; 2.5 · 1.2 · 0.15 g · 1.4 (E); ⅔ · 1.5
/// · 1.2 g; 0.4 · 1.3 · 2.93.
#[test]
fn every_code_by_its_words() {
    let cases: [(Pairs, f64, f64, &str); 6] = [
        (
            &[
                ("code", "AS 1170.4"),
                ("site", "ce"),
                ("hazard_factor", "11 %"),
                ("return_period_years", "2500"),
            ],
            0.5,
            0.495,
            "site Ce, Z = 0.11, 2500 years, kpZ = 0.198 g",
        ),
        (
            &[
                ("code", "EC8"),
                ("spectrum_type", "1"),
                ("site", "e"),
                ("ground_acceleration", "0.15 g"),
                ("importance_factor", "1.2"),
            ],
            0.3,
            0.63,
            "type 1, ground E, a_g = 0.18 g",
        ),
        (
            &[
                ("code", "eurocode8"),
                ("spectrum_type", "2"),
                ("ground_acceleration", "0.1 g"),
                ("soil_factor", "1.3"),
                ("corner_periods", "0.1 s, 0.4 s, 1.5 s"),
            ],
            0.2,
            0.325,
            "type 2, ground not given, a_g = 0.1 g",
        ),
        (
            &[
                ("code", "asce7"),
                ("sds", "1 g"),
                ("sd1", "600 mg"),
                ("long_period", "8 s"),
                ("edition", "16"),
            ],
            2.0,
            0.3,
            "SDS = 1 g, SD1 = 0.6 g, TL = 8 s",
        ),
        (
            &[
                ("code", "ASCE 7"),
                ("ss", "1.5 g"),
                ("fa", "1.2"),
                ("s1", "0.6 g"),
                ("fv", "1.7"),
                ("long_period", "8 s"),
            ],
            0.3,
            1.2,
            "SDS = 1.2 g, SD1 = 0.68 g, TL = 8 s",
        ),
        (
            &[
                ("code", "nzs1170.5"),
                ("site", "C"),
                ("hazard_factor", "0.40"),
                ("return_period_years", "1000"),
                ("fault_distance", "2 km"),
            ],
            0.2,
            1.5236,
            "site C, Z = 0.4, 1000 years, Z R = 0.52 g, a fault 2 km away",
        ),
    ];
    for (pairs, period_s, sa_g, line) in cases {
        let target = target(pairs);
        // Accelerations come through m/s² and back: a few units of the last place.
        assert!(
            (target.spectrum.sa_g(period_s) - sa_g).abs() < 1e-14,
            "{line}: {}",
            target.spectrum.sa_g(period_s)
        );
        assert_eq!(target.parameters(), line);
        assert!(
            target
                .facts
                .iter()
                .all(|(name, value)| !name.is_empty() && !value.is_empty())
        );
        assert!(target.check_matched_band().is_ok());
    }
}

#[test]
fn what_is_not_confirmed_is_a_doubt() {
    let new = target(&[("edition", "2024")]);
    assert!(new.one_line().starts_with("AS 1170.4:2024 (not confirmed)"));
    assert_eq!(new.doubts[0], TargetDoubt::EditionUnread);
    let hobart = target(&[("city", "hobart")]);
    assert_eq!(hobart.place_name().as_deref(), Some("Hobart"));
    let least = TargetDoubt::MinimumGoverns {
        least_ratio: 0.08,
        years: 500,
        hazard_factor: 0.03,
    };
    assert_eq!(hobart.doubts, [least]);
    let otira = target(&[
        ("code", "nzs1170.5"),
        ("site", "B"),
        ("hazard_factor", "0.6"),
        ("return_period_years", "2500"),
    ]);
    assert!(matches!(
        otira.doubts[..],
        [TargetDoubt::MaximumGoverns { .. }]
    ));
}

#[test]
fn all_problems_are_told_at_once() {
    assert_eq!(
        problems(&[
            ("code", "ec8"),
            ("hazard_factor", "0.1"),
            ("site", "Q"),
            ("ground_acceleration", "0.1")
        ]),
        [
            "`hazard_factor` is not part of Eurocode 8 | leave it out, or name a code that has it: `code = \
             \"as1170.4\"` or `code = \"nzs1170.5\"`",
            "`ground_acceleration`: \"0.1\" needs a unit | write \"0.1 g\" or \"0.1 m/s2\"",
            "Eurocode 8 needs `spectrum_type` | give `spectrum_type = \"1\"`",
            "`site` \"Q\" is not a ground type of Eurocode 8 | A rock, B very dense or very stiff, C dense or stiff, \
             D loose or soft, E a layer of C or D over rock",
        ]
    );
    assert_eq!(
        problems(&[
            ("code", "asce7"),
            ("sds", "-1 g"),
            ("return_period_years", "500")
        ]),
        [
            "`return_period_years` is not part of ASCE 7 | leave it out, or name a code that has it: `code = \
             \"as1170.4\"` or `code = \"eurocode8\"` or `code = \"nzs1170.5\"` or `code = \"ntc2018\"` or `code = \"tbdy2018\"` or \
             `code = \"ts1170.5\"`",
            "ASCE 7 needs `long_period` | give `long_period = \"8 s\"`",
            "`sds` must be positive, not \"-1 g\" | give an acceleration above 0",
            "ASCE 7 needs `sd1` | give `sd1 = \"0.6 g\"`",
        ]
    );
    assert_eq!(
        problems(&[("code", "as1170.5")]),
        [
            "`code` \"as1170.5\" is not known | known: as1170.4, eurocode8, asce7, nzs1170.5, ntc2018, tbdy2018, ts1170.5, table"
        ]
    );
}

/// Each on its own: the number of problems and a word of the first.
#[test]
fn words_that_contradict_themselves() {
    let cases: [(Pairs, usize, &str); 10] = [
        (
            &[("city", "Perth"), ("hazard_factor", "0.09")],
            1,
            "exclude each other",
        ),
        (&[("city", "Melborne")], 1, "is not in the table of places"),
        (
            &[("return_period_years", "475")],
            1,
            "no factor for a return period of 475 years",
        ),
        (
            &[("return_period_years", "5e2")],
            1,
            "must be a whole number",
        ),
        (
            &[("return_period_years", "99999999999999")],
            1,
            "must be a smaller number",
        ),
        (&[("edition", "1993")], 1, "`edition` must be 2007"),
        (
            &[("code", "asce7"), ("sds", "1 g"), ("ss", "1 g")],
            1,
            "exclude each other",
        ),
        (
            &[
                ("code", "asce7"),
                ("sds", "0.5 g"),
                ("sd1", "0.5 g"),
                ("long_period", "0.5 s"),
            ],
            1,
            "TL must be at least TS",
        ),
        (
            &[
                ("code", "nzs1170.5"),
                ("site", "C"),
                ("hazard_factor", "0.4"),
                ("fault_distance", "-1 km"),
            ],
            1,
            "must be 0 or more",
        ),
        (
            &[("spectrum", "x.csv"), ("site", "De")],
            2,
            "`site` is not part of a user's table",
        ),
    ];
    for (pairs, count, word) in cases {
        let got = problems(pairs);
        assert!(got.len() == count && got[0].contains(word), "{got:?}");
    }
    let annex = [
        ("code", "ec8"),
        ("spectrum_type", "1"),
        ("site", "A"),
        ("ground_acceleration", "1 m/s2"),
    ];
    for corners in ["0.1 s, 0.4 s", "0.4 s, 0.1 s, 2 s", "0 s, 0.1 s, 2 s"] {
        let got = problems(&[&annex[..], &[("corner_periods", corners)]].concat());
        assert!(
            got.len() == 1 && got[0].contains("three periods"),
            "{got:?}"
        );
    }
}

#[test]
fn a_table_is_its_file() {
    let text = "T [s]; Sa [m/s2]\n5; 0,1\n0; 2\n0,5; 4\n";
    let table = in_file("uhs.csv", text, &[("interpolation", "linear")]).unwrap();
    // Halfway up: 3 m/s².
    assert!((table.spectrum.sa_g(0.25) - 3.0 / 9.80665).abs() < 1e-15);
    assert_eq!(
        table.one_line(),
        "user's table, uhs.csv, 3 periods from 0 s to 5 s"
    );
    assert_eq!(
        (table.code(), table.check_matched_band()),
        ("table", Ok(()))
    );
    // What a run leaves behind is the same table to the bit.
    let again = in_file(
        "again.csv",
        table.table_csv.as_deref().unwrap(),
        &[("interpolation", "linear")],
    )
    .unwrap();
    assert_eq!(again.spectrum, table.spectrum);
}

#[test]
fn a_short_table_is_refused_for_motions_or_held() {
    let text = "T [s],PSA [g]\n0.1,0.3\n2,0.05\n";
    let short = in_file("short.csv", text, &[]).unwrap();
    let problem = short.check_matched_band().unwrap_err();
    assert_eq!(
        problem.message,
        "the spectrum short.csv covers 0.1 s to 2 s; motions are matched from 0.05 s to 5 s, and their PGA to the \
         value at 0 s"
    );
    assert!(problem.hint.unwrap().contains("`beyond = \"hold\"`"));
    let held = in_file("short.csv", text, &[("beyond", "hold")]).unwrap();
    assert_eq!(held.check_matched_band(), Ok(()));
    // Constant Sa below, constant displacement beyond: a quarter at twice the period.
    assert!(
        (held.spectrum.sa_g(0.0) - 0.3).abs() < 1e-15
            && (held.spectrum.sa_g(4.0) - 0.0125).abs() < 1e-15
    );
    let begins = TargetDoubt::BeginsLate {
        name: "short.csv".to_owned(),
        first_s: 0.1,
    };
    assert_eq!(held.doubts, [begins]);
}

#[test]
fn files_that_are_no_spectrum_for_5_per_cent() {
    let refused = |text: &str| {
        let problems = in_file("x.csv", text, &[]).unwrap_err();
        assert_eq!(problems.len(), 1);
        problems.problems[0].message.clone()
    };
    assert!(
        refused("T [s],PSA [g],damping [%]\n0.1,0.3,2\n2,0.05,2\n").contains("for 2 % damping")
    );
    assert!(refused("T [s],PSA [g]\n0.1,0.3\n").contains("at least two periods"));
    assert!(
        refused("T [s],PSA [g]\n0.1,0.3\n0.1,0.2\n").contains("the period 0.1 s is listed twice")
    );
    assert!(refused("T [s],PSA [g]\n0.1,-0.3\n0.2,0.2\n").contains("above 0"));
    let got = problems(&[("code", "table")]);
    assert_eq!(
        got,
        ["a user's table needs `spectrum` | give `spectrum = \"target.csv\"`"]
    );
    let got = problems(&[
        ("spectrum", "gone.csv"),
        ("beyond", "holt"),
        ("interpolation", "cubic"),
    ]);
    assert_eq!(got.len(), 3, "{got:?}");
    assert!(got[1].contains("did you mean hold?"), "{got:?}");
}

/// A word that is forgotten in one of the lists would be refused, or read and never looked at.
#[test]
fn the_lists_of_words_agree() {
    let mut of_codes: Vec<&str> = CODES
        .iter()
        .flat_map(|(_, code)| code.keys())
        .chain(["code", "fault_magnitude"])
        .collect();
    of_codes.sort_unstable();
    of_codes.dedup();
    let mut known = crate::options::TARGET_KEYS.map(|(key, _)| key);
    known.sort_unstable();
    assert_eq!(of_codes, known);
    // A study reads each of them as a word of the spectrum.
    for key in known {
        let (options, problems) =
            crate::options::parse(&format!("[ground]\n{key} = \"1\"\n"), None, None);
        let read: Vec<&str> = options
            .ground
            .target
            .entries()
            .map(|(key, _)| key)
            .collect();
        assert_eq!((read, problems.len()), (vec![key], 0));
    }
}

/// The plateau or the acceleration at 0 s of each code, by hand: 0.08 · 3.68; 0.4 · 1.0 · 2.93 (C at
/// 0.2 s); ⅔ · 1.2 · 1.976 g (class D assumed: Fa at least 1.2); 2.5 · 0.16 · 1.2 (type 1, B).
#[test]
fn a_place_brings_its_code_and_its_hazard() {
    let cases: [(&str, f64, &str); 4] = [
        (
            "Sydney",
            0.2944,
            "site De, Z = 0.08 (Sydney), 500 years, kpZ = 0.08 g",
        ),
        (
            "wellington",
            1.172,
            "site C, Z = 0.4 (Wellington), 500 years, Z R = 0.4 g, a fault 0 km away",
        ),
        (
            "Los Angeles",
            1.5808,
            "site D, SDS = 1.581 g, SD1 = 0.7979 g (Los Angeles), TL = 8 s",
        ),
        (
            "athens",
            0.48,
            "type 1, ground B, a_g = 0.16 g (Athens, approximate)",
        ),
    ];
    for (place, sa_g, line) in cases {
        for key in ["place", "city"] {
            let target = target(&[(key, place)]);
            // Three products: a few ulp.
            assert!(
                (target.spectrum.sa_g(0.2) - sa_g).abs() < 1e-14,
                "{place}: {}",
                target.spectrum.sa_g(0.2)
            );
            assert_eq!(target.parameters(), line);
            assert!(
                target.facts[1].0 == "Place" && target.facts[2].0 == "Hazard from",
                "{:?}",
                target.facts
            );
            assert!(target.check_matched_band().is_ok());
        }
    }
    let doubts = |place: &str| target(&[("place", place)]).doubts;
    assert_eq!(why(&doubts("Athens")), Some(WhyDoubted::AnnexNotRead));
    assert!(doubts("Sydney").is_empty() && doubts("Wellington").is_empty());
    assert_eq!(doubts("Los Angeles"), [TargetDoubt::AsksForStudy]);
    assert_eq!(
        target(&[("place", "Los Angeles")]).spectrum.name(),
        "ASCE 7-16"
    );
    let chosen = target(&[
        ("place", "Chicago"),
        ("site", "E"),
        ("edition", "2022"),
        ("long_period", "12 s"),
    ]);
    // Fa 2.4 and Fv 4.2 of soft clay.
    assert_eq!(
        chosen.parameters(),
        "site E, SDS = 0.1872 g, SD1 = 0.1764 g (Chicago), TL = 12 s"
    );
    assert_eq!(chosen.doubts, [TargetDoubt::CoefficientsOf2016]);
    let own = target(&[("place", "Chicago"), ("fa", "1.5"), ("fv", "2")]);
    assert_eq!(
        own.parameters(),
        "SDS = 0.117 g, SD1 = 0.084 g (Chicago), TL = 8 s"
    );
}

/// By hand, at 0.2 s. Istanbul, ZD: F_S = 1.1004. Kaitaia, class III: S_a,s. Kathmandu: 2.5 · 0.35 · 1.2. Xichang: 2.5 · 0.4 g on
/// the soil. Taipei: S_DS = 0.6 g, up to 1.6 s. Lorca, terrain II: S = 1.04 − 0.04 · 0.02/0.3, 2.5 · 0.12 · S.
#[test]
fn codes_and_shapes_of_other_countries() {
    for (place, period_s, sa_g, line) in [
        (
            "Istanbul",
            0.2,
            0.999 * 1.1004,
            "site ZD, Ss = 0.999 g, S1 = 0.276 g (Istanbul), 475 years",
        ),
        (
            "Kaitaia",
            0.2,
            0.38,
            "site III, PGA = 0.18 g, Sa,s = 0.38 g (Kaitaia), 500 years",
        ),
        (
            "Kathmandu",
            0.2,
            1.05,
            "type 1, ground B, a_g = 0.35 g (Kathmandu, approximate)",
        ),
        (
            "Xichang",
            0.2,
            1.0,
            "type 1, ground B, a_g = 0.4 g (Xichang, approximate)",
        ),
        (
            "Taipei",
            1.6,
            0.6,
            "type 1, ground B, a_g = 0.24 g (Taipei, approximate)",
        ),
        (
            "Lorca",
            0.2,
            2.5 * 0.12 * (1.04 - 0.04 * 0.02 / 0.3),
            "type 1, ground B, a_g = 0.12 g (Lorca, Murcia, Spain)",
        ),
    ] {
        let target = target(&[("place", place)]);
        assert!(
            (target.spectrum.sa_g(period_s) - sa_g).abs() < 1e-12,
            "{place}"
        );
        assert_eq!(target.parameters(), line);
    }
    for place in ["Istanbul", "Kaitaia", "Lorca"] {
        assert_eq!(target(&[("place", place)]).doubts, [], "{place}");
    }
    for (place, is_approximate) in [("Quito", false), ("Kathmandu", true)] {
        let found = why(&target(&[("place", place)]).doubts);
        assert!(
            matches!(found, Some(WhyDoubted::Shape { by: Some(_), is_approximate: also }) if also == is_approximate),
            "{place}: {found:?}"
        );
    }
    let rare = target(&[("place", "Istanbul"), ("return_period_years", "2475")]);
    assert!((rare.spectrum.plateau_g() - 1.747).abs() < 1e-12);
    let azores = target(&[("place", "Ponta Delgada")]);
    assert_eq!(
        (azores.spectrum_type(), azores.other_type()),
        (Some(2), None)
    );
    let faro = target(&[("place", "Faro")]);
    assert_eq!(
        (faro.spectrum_type(), faro.other_type()),
        (Some(1), Some(2))
    );
    let refused = problems(&[("place", "Ponta Delgada"), ("spectrum_type", "1")]);
    assert!(refused[0].contains("type 2 alone"), "{refused:?}");
}

/// A point of Italy, in both ways in which a study says it, and what is said of it.
#[test]
fn coordinates_bring_the_hazard_of_a_grid() {
    let named = target(&[
        ("place", "42.3498, 13.3995"),
        ("site", "C"),
        ("topography", "T2"),
    ]);
    let stated = target(&[
        ("latitude", "42.3498"),
        ("longitude", "13.3995"),
        ("site", "C"),
        ("topography", "T2"),
    ]);
    assert_eq!(named, stated);
    assert_eq!(named.code(), "ntc2018");
    let from = &named
        .facts
        .iter()
        .find(|(name, _)| name == "Hazard from")
        .unwrap()
        .1;
    assert!(from.contains("read, interpolated, nearest node "), "{from}");
    assert!(
        named.parameters().contains("ground C, T2, ag = 0.26"),
        "{}",
        named.parameters()
    );
    let rare = target(&[
        ("place", "L'Aquila"),
        ("code", "ntc2018"),
        ("return_period_years", "975"),
    ]);
    assert!(
        rare.spectrum.sa_g(0.0)
            > target(&[("place", "L'Aquila"), ("code", "ntc2018")])
                .spectrum
                .sa_g(0.0)
    );
    for (pairs, word) in [
        (&[("latitude", "42")][..], "needs `longitude`"),
        (
            &[("latitude", "42"), ("longitude", "13"), ("place", "Rome")],
            "exclude each other",
        ),
        (&[("place", "95, 13")], "are no coordinates"),
        (&[("place", "40, 31")], "no hazard is known at"),
        (&[("place", "Mexico City")], "lake zone"),
        (&[("place", "Lagoa")], "the name of 2 places"),
        (
            &[("place", "42.35, 13.4"), ("return_period_years", "20")],
            "20 years",
        ),
        (
            &[("place", "42.35, 13.4"), ("topography", "T5")],
            "T1, T2, T3, T4",
        ),
        (&[("code", "ntc2018")], "needs `place`"),
        (
            &[("place", "Istanbul"), ("return_period_years", "10000")],
            "outside of the 72 to 2475 years",
        ),
    ] {
        let got = problems(pairs);
        assert!(got[0].contains(word), "{pairs:?} {got:?}");
    }
}

/// By hand. Bucharest, 0.3 g, S = 1, T_C = 1.6 s: 0.75 g up to 1.6 s and 0.6 g at 2 s, where the recommended
/// type 1 on ground B had 2.5 · 0.3 · 1.2 · 0.5/2 = 0.225 g. Lisbon, type 1, 0.153 g = 1.5004 m/s²: S = 1.35
/// − 0.35 · 0.5004/3 = 1.29162, plateau 0.49404 g to 0.6 s; type 2, 0.173 g = 1.69655 m/s²: S = 1.26874,
/// plateau 0.54873 g to 0.25 s. Nice, 0.163 g, ground B: S = 1.35, plateau 0.550125 g to 0.25 s.
#[test]
fn spectra_of_national_annexes() {
    let near =
        |got: f64, expected: f64| assert!((got / expected - 1.0).abs() < 1e-4, "{got} {expected}");
    let bucharest = target(&[("place", "Bucharest")]);
    near(bucharest.spectrum.sa_g(1.5), 0.75);
    near(bucharest.spectrum.sa_g(2.0), 0.6);
    assert_eq!(bucharest.spectrum.return_period_years(), Some(225));
    assert!(problems(&[("place", "Bucharest"), ("site", "B")])[0].contains("no ground types"));
    let lisbon = target(&[("place", "Lisbon")]);
    near(lisbon.spectrum.sa_g(0.5), 0.49404);
    near(lisbon.spectrum.sa_g(1.2), 0.24702);
    let other = lisbon.alternative.as_ref().unwrap();
    near(other.sa_g(0.2), 0.54873);
    near(other.sa_g(0.5), 0.274365);
    // Parts take the larger acceleration of the ground, and a type that is named counts alone.
    assert_eq!(lisbon.parts_spectrum(), other);
    let parts = Target::for_parts(&[("place", "Lisbon")].into_iter().collect()).unwrap();
    assert_eq!((&parts.spectrum, &parts.alternative), (other, &None));
    let second = target(&[("place", "Lisbon"), ("spectrum_type", "2")]);
    assert_eq!((&second.spectrum, &second.alternative), (other, &None));
    assert!(
        target(&[("place", "Lisbon"), ("spectrum_type", "1")])
            .alternative
            .is_none()
    );
    let nice = target(&[("place", "Nice")]);
    near(nice.spectrum.sa_g(0.2), 0.550_125);
    near(nice.spectrum.sa_g(0.5), 0.275_062_5);
    // Stated values take the place of the annex.
    let own = target(&[("place", "Nice"), ("soil_factor", "1.2")]);
    near(own.spectrum.sa_g(0.2), 0.163 * 2.5 * 1.2);
}

/// By hand: k = 3 gives (2475/475)^(1/3) = 1.7336 for Athens, 0.16 g, ground B, S = 1.2; its σ of ln is 0.1500. For Istanbul
/// the nearer level counts: (1500/2475)^(1/2.5) = 0.8185 of its Ss.
#[test]
fn a_return_period_that_the_table_lacks() {
    let athens = target(&[("place", "Athens"), ("return_period_years", "2475")]);
    assert!((athens.spectrum.sa_g(0.3) / (2.5 * 1.2 * 0.16 * 1.7336) - 1.0).abs() < 1e-4);
    assert_eq!(athens.return_period_years(), Some(2475));
    assert!((athens.hazard_spread() - 0.1500).abs() < 1e-4);
    let told = "derived: the value of 475 years × 1.73 (1.46 to 2.38)";
    assert!(
        athens.facts.iter().any(|(_, value)| value.contains(told)),
        "{:?}",
        athens.facts
    );
    let is_derived = |doubt: &TargetDoubt| matches!(doubt, TargetDoubt::Derived { .. });
    assert!(athens.doubts.iter().any(is_derived), "{:?}", athens.doubts);
    assert!(
        athens.one_line().contains("(Athens, approximate, derived)"),
        "{}",
        athens.one_line()
    );
    let istanbul = target(&[("place", "Istanbul"), ("return_period_years", "1500")]);
    assert_eq!(istanbul.return_period_years(), Some(1500));
    let rare = target(&[("place", "Istanbul"), ("return_period_years", "2475")]);
    assert_eq!(
        (rare.hazard_spread(), rare.place.as_ref().unwrap().derived),
        (0.0, None)
    );
    let mapped = |target: &Target| match &target.spectrum {
        CodeSpectrum::Tbdy2018(code) => code.mapped_g()[0],
        other => panic!("{other:?}"),
    };
    // On the line in logarithms between the two levels: ln(2475/1500)/ln(2475/475) = 0.30338 of the way from the rare one.
    let usual = target(&[("place", "Istanbul")]);
    let expected = (mapped(&usual) / mapped(&rare)).powf(0.30338);
    assert!((mapped(&istanbul) / mapped(&rare) - expected).abs() < 1e-5);
    assert_eq!(istanbul.hazard_spread(), 0.0);
    assert!(istanbul.one_line().contains("(Istanbul, interpolated)"));
    // The annex of Spain is at 500 years: asked or not, it is what was read.
    let lorca = target(&[("place", "Lorca"), ("return_period_years", "500")]);
    assert_eq!(lorca.hazard_spread(), 0.0);
    assert_eq!(lorca.spectrum, target(&[("place", "Lorca")]).spectrum);
    for (pairs, word) in [
        (
            &[("place", "Athens"), ("return_period_years", "20")][..],
            "outside of the 72 to 2475 years",
        ),
        (
            &[("place", "Athens"), ("return_period_years", "2,475")],
            "must be a whole number",
        ),
        (
            &[("place", "Tokyo"), ("return_period_years", "475")],
            "have no return period",
        ),
        (
            &[
                ("place", "Athens"),
                ("return_period_years", "1000"),
                ("importance_factor", "1.2"),
            ],
            "`importance_factor`",
        ),
        (
            &[
                ("code", "eurocode8"),
                ("spectrum_type", "1"),
                ("site", "B"),
                ("ground_acceleration", "0.2 g"),
                ("return_period_years", "1000"),
            ],
            "`return_period_years` needs a `place`",
        ),
    ] {
        let got = problems(pairs);
        assert!(got[0].contains(word), "{pairs:?} {got:?}");
    }
}

/// N(3 s, 0 km) = 0.24 · 3 + 0.64 = 1.36 in Wellington; 1 in Napier, which is far from faults; a distance
/// that is stated counts.
#[test]
fn the_fault_of_a_place_raises_long_periods() {
    let at = |words: Pairs| target(words).spectrum.sa_g(3.0);
    let near =
        |got: f64, expected: f64| assert!((got - expected).abs() < 1e-12, "{got} {expected}");
    let far = at(&[("place", "Wellington"), ("fault_distance", "20 km")]);
    near(at(&[("place", "Wellington")]), 1.36 * far);
    near(at(&[("place", "Napier")]), far * 0.38 / 0.4);
    near(
        at(&[("place", "Kaikoura"), ("fault_distance", "2 km")]),
        1.36 * far * 0.42 / 0.4,
    );
}

#[test]
fn places_that_contradict_other_words() {
    let cases: [(Pairs, usize, &str); 8] = [
        (
            &[("place", "Athens"), ("code", "nzs1170.5")],
            1,
            "has values for Eurocode 8, not for NZS 1170.5",
        ),
        (
            &[("place", "Athens"), ("city", "Athens")],
            1,
            "two names of the same key",
        ),
        (
            &[("place", "Athens"), ("ground_acceleration", "0.2 g")],
            1,
            "exclude each other",
        ),
        (
            &[("place", "Reno"), ("sds", "1 g"), ("ss", "1 g")],
            2,
            "exclude each other",
        ),
        (
            &[("place", "Reno"), ("site", "E")],
            1,
            "11.4.8, requires a site-specific study",
        ),
        (
            &[("place", "Reno"), ("site", "F")],
            1,
            "is not a class of ASCE 7",
        ),
        (
            &[("place", "Reno"), ("site", "D"), ("fa", "1")],
            2,
            "exclude each other",
        ),
        (
            &[("place", "Oslo"), ("code", "ec8"), ("site", "Q")],
            2,
            "no hazard is known for Oslo, Norway",
        ),
    ];
    for (pairs, count, word) in cases {
        let got = problems(pairs);
        assert!(
            got.len() == count && got[0].contains(word),
            "{pairs:?}: {got:?}"
        );
    }
    let got = problems(&[("place", "Welington"), ("site", "Q")]);
    assert!(
        got[0].ends_with("did you mean \"Wellington\"?") && got[1].contains("NZS 1170.5"),
        "{got:?}"
    );
}

#[test]
fn mapped_accelerations_with_a_site_class() {
    let words = [
        ("code", "asce7"),
        ("ss", "1.5 g"),
        ("s1", "0.6 g"),
        ("site", "C"),
        ("long_period", "8 s"),
    ];
    let target = target(&words);
    assert_eq!(
        target.parameters(),
        "site C, SDS = 1.2 g, SD1 = 0.56 g, TL = 8 s"
    );
    let got = problems(&words[..3]);
    assert!(
        got.iter().any(|one| one.contains("or `site = \"D\"`")),
        "{got:?}"
    );
}

/// Beside a place alone, no remedy names a code or a value that nobody can give.
#[test]
fn remedies_name_what_can_be_given() {
    let hints = |pairs: Pairs, is_alone: bool| {
        let words = pairs.iter().copied().collect();
        let found = match is_alone {
            true => Target::resolve_place(&words),
            false => Target::resolve(&words, "".as_ref()),
        };
        let problems = found.unwrap_err().problems;
        let hints: Vec<String> = problems.into_iter().filter_map(|one| one.hint).collect();
        assert_eq!(hints.len(), 1, "{pairs:?}: {hints:?}");
        hints.concat()
    };
    let cases: [(Pairs, &str); 2] = [
        (&[("place", "Nowhere")], "hazard_factor"),
        (
            &[("place", "Los Angeles"), ("return_period_years", "500")],
            "`code = ",
        ),
    ];
    for (pairs, other) in cases {
        assert!(hints(pairs, false).contains(other), "{pairs:?}");
        assert!(!hints(pairs, true).contains(other), "{pairs:?}");
    }
}
