#[path = "../../../freestand-records/src/formats/mseed/fixture.rs"]
mod mseed;

mod building_tables;
mod hazard;

use super::*;
use crate::target::TargetDoubt;
use freestand_records::formats::ReadOptions;
use freestand_records::processing::Processing;

fn problems(text: &str) -> Vec<String> {
    match resolve(text, Some(Path::new("s.toml")), Path::new("")) {
        Ok(_) => Vec::new(),
        Err(error) => error.problems.iter().map(ToString::to_string).collect(),
    }
}

fn study(text: &str) -> Study {
    resolve(text, None, Path::new("")).unwrap()
}

/// What is dumped is what is run, and every default of the resolver is the one that the dump shows.
#[test]
fn the_built_in_study_is_the_same_as_no_study_at_all() {
    let dumped = builtin(&Overrides::default()).unwrap();
    let mut nothing = of_values(&Values::default()).unwrap();
    nothing.toml.clone_from(&dumped.toml);
    assert!(dumped.is_builtin && !nothing.is_builtin);
    assert!(nothing.place_is_assumed && nothing.building_is_assumed);
    nothing.is_builtin = true;
    // What nobody stated is said; the built-in study states it.
    assert_eq!(nothing.doubts.len(), 1);
    nothing.doubts.clear();
    let Ground::Synthetic(ground) = &mut nothing.ground else {
        panic!()
    };
    assert!(ground.target.place_is_assumed);
    (ground.target.place_is_assumed, ground.target.doubts) = (false, Vec::new());
    assert_eq!(nothing, dumped);
    assert_eq!(dumped.objects.blocks.len(), 130);
    assert_eq!(dumped.doubts, []);
    assert!((dumped.building.unwrap().along.period_s() - 1.9166).abs() < 1e-3);
    // Height by height, thickness by thickness within each.
    assert_eq!(
        (
            dumped.objects.blocks[1].height_m(),
            dumped.objects.blocks[1].thickness_m()
        ),
        (0.5, 0.3)
    );
}

/// What a study leaves to the built-in study, and what `place` and `storeys` add to it.
#[test]
fn what_nobody_stated_is_known() {
    let unstated = |text: &str| {
        let study = study(text);
        (study.place_is_assumed, study.building_is_assumed)
    };
    for (text, expected) in [
        ("[assessment]\n", (true, true)),
        (
            "[building]\nname = \"Our museum in Wellington\"\n",
            (true, true),
        ),
        ("[building]\nperiod = \"0.5 s\"\n", (true, true)),
        ("[building]\nstoreys = 3\n", (true, false)),
        ("[building]\nheight = \"12 m\"\n", (true, false)),
        (
            "[ground]\nsite = \"Ce\"\nreturn_period_years = 1000\n[building]\nstoreys = 3\n",
            (true, false),
        ),
        ("[ground]\nplace = \"Wellington\"\n", (false, true)),
        ("[ground]\ncity = \"Perth\"\n", (false, true)),
        ("[ground]\nhazard_factor = 0.1\n", (false, true)),
        (
            "[ground]\npoint_source = { magnitude = 6.0, distance = \"30 km\" }\n",
            (false, true),
        ),
        (
            "[ground]\nplace = \"Wellington\"\n[building]\nstoreys = 3\n",
            (false, false),
        ),
    ] {
        assert_eq!(unstated(text), expected, "{text}");
    }
    let empty = resolve("# nothing yet\n", Some(Path::new("s.toml")), Path::new("")).unwrap_err();
    assert!(
        empty.problems[0].message.contains("is empty") && empty.problems[0].hint.is_some(),
        "{empty}"
    );

    let overrides = |storeys, place: &str| {
        let hazard = [("place", place.to_owned())]
            .into_iter()
            .filter(|(_, place)| !place.is_empty())
            .collect();
        Overrides {
            storeys,
            hazard,
            ..Overrides::default()
        }
    };
    let of = |study: Study| {
        (
            study.place_is_assumed,
            study.building_is_assumed,
            study.building.unwrap().storeys,
        )
    };
    assert_eq!(of(builtin(&overrides(None, "")).unwrap()), (true, true, 30));
    assert_eq!(
        of(builtin(&overrides(None, "Wellington")).unwrap()),
        (false, true, 30)
    );
    assert_eq!(
        of(builtin(&overrides(Some(7), "Wellington")).unwrap()),
        (false, false, 7)
    );
    // A building that is stated is the one that shakes.
    let stated = "[building]\nstoreys = 3\n";
    assert_eq!(
        of(resolve_with(stated, None, Path::new(""), &overrides(Some(7), "")).unwrap()).2,
        3
    );
    let named = "[building]\nname = \"Annex\"\nframe = \"concrete-moment\"\n";
    let named = resolve_with(
        named,
        None,
        Path::new(""),
        &overrides(Some(7), "Wellington"),
    )
    .unwrap();
    assert_eq!(
        (
            named.building_name.as_deref(),
            named.building.unwrap().storeys
        ),
        (Some("Annex"), 7)
    );
    // Two ways to the same building.
    let one = builtin(&overrides(Some(7), "Wellington")).unwrap();
    let other = of_values(&Values {
        hazard: Hazard::Keys(Words::from_iter([("place", "Wellington")])),
        storeys: Some(7),
        ..Values::default()
    })
    .unwrap();
    assert_eq!(
        (one.building, one.building_name),
        (other.building, other.building_name)
    );
    assert!(one.toml.contains("storeys = 7") && !one.toml.contains("name = \"tower\""));
}

/// Values are taken as the same values in a text are.
#[test]
fn values_are_those_of_a_text_with_the_same_keys() {
    use freestand::code_spectrum::{GroundType, SpectrumType};
    // A third has no short decimal.
    let target = Target::eurocode8(SpectrumType::Type2, GroundType::C, 1.0 / 3.0).unwrap();
    let values = Values {
        hazard: Hazard::Spectrum(Box::new(target)),
        count: Some(3),
        seed: Some(7),
        storeys: Some(12),
        storey_height_m: Some(10.0 / 3.0),
    };
    let text = format!(
        "[ground]\ncode = \"eurocode8\"\nspectrum_type = 2\nsite = \"C\"\nground_acceleration = \"{} g\"\n\
         count = 3\nseed = 7\n[building]\nstoreys = 12\nstorey_height = \"{} m\"\n",
        1.0 / 3.0,
        10.0 / 3.0
    );
    let mut written = study(&text);
    assert_eq!(std::mem::take(&mut written.toml), text);
    assert_eq!(of_values(&values).unwrap(), written);
    let wrong = Values {
        count: Some(0),
        storeys: Some(501),
        storey_height_m: Some(0.5),
        ..values
    };
    let problems = of_values(&wrong).unwrap_err().problems;
    let said: Vec<String> = problems.iter().map(ToString::to_string).collect();
    assert_eq!(
        said,
        [
            "storeys must be a whole number from 1 to 500, not 501",
            "storey_height must be a height between 1 and 30 m, not \"0.5 m\"",
            "count must be a whole number from 1 to 1000, not 0",
        ]
    );
}

#[test]
fn every_value_is_checked_and_every_problem_reported() {
    let got = problems(
        "[ground]\ncode = \"as1170.4\"\nedition = 1993\ncity = \"Melborne\"\nsite = \"X\"\ncount = 0\n\
         [building]\nstoreys = 0\nstorey_height = \"-3 m\"\nframe = \"wood\"\nperiod = \"0 s\"\ndamping = 1
shear_flexure = -1\nmodes = 51\n\
         levels = [{ name = \"a/b\", level_ratio = 0.5 }, { name = \"roof\", level_ratio = 1.5 }, { name = \
                              \"Roof\", level_ratio = 1 }, { name = \"x\" }]\n\
         [objects]\nheights = \"-1 m, 1 m\"\nthicknesses = []\nmass = \"0 kg\"\nstiffness = \"-1 \
                                N/mm\"\nrestitution = 1.2\naccuracy = \"loose\"\ntolerance = \"0 g\"\nfriction = 0\n\
         [outputs]\nhistory = { level = \"attic\", height = \"1.5 m\", thickness = \"300 mm\" }\n",
    );
    let expected = [
        "s.toml:3: edition must be 2007 (with Amendments 1 and 2) or 2024 (not confirmed), not \"1993\"",
        "s.toml:4: city \"Melborne\" is not in the table of places",
        "s.toml:5: site \"X\" is not a class of AS 1170.4",
        "s.toml:6: count must be a whole number from 1 to 1000, not 0",
        "s.toml:8: storeys must be a whole number from 1 to 500, not 0",
        "s.toml:9: storey_height must be a height between 1 and 30 m, not \"-3 m\"",
        "s.toml:10: frame \"wood\" is not known",
        "s.toml:11: period must be positive, not \"0 s\"",
        "s.toml:11: period and frame exclude each other",
        "s.toml:12: damping must be from 0 to below 1, not \"1\"",
        "s.toml:13: shear_flexure must be 0 or more, not \"-1\"",
        "s.toml:14: modes must be a whole number from 1 to 50, not 51",
        "s.toml:15: \"a/b\" cannot be the name of a level, because it would also name an output folder",
        "s.toml:15: level_ratio must be a share from 0 (ground) to 1 (roof), not 1.5",
        "s.toml:15: two levels have the name \"Roof\"",
        "s.toml:15: the level has no level_ratio",
        "s.toml:17: heights must be positive, not -1 m",
        "s.toml:18: thicknesses is empty",
        "s.toml:19: mass must be positive, not 0 kg",
        "s.toml:20: stiffness: the stiffness must be positive, not \"-1 N/mm\"",
        "s.toml:22: accuracy \"loose\" is not known",
        "s.toml:23: tolerance must be positive, not 0 g",
        "s.toml:24: friction must be positive, not 0",
        "s.toml:26: history: no level has the name \"attic\"",
    ];
    for line in expected {
        assert!(
            got.iter().any(|problem| problem == line),
            "{line}\n{got:#?}"
        );
    }
}

#[test]
fn contradictions_and_products_are_refused() {
    assert_eq!(
        problems("[ground]\ncity = \"Perth\"\nhazard_factor = 0.09\n"),
        ["s.toml:3: city and hazard_factor exclude each other"]
    );
    assert_eq!(
        problems("[ground]\nscale = 2\n"),
        ["s.toml:2: scale needs motions"]
    );
    assert_eq!(
        problems("[objects]\nrestitution = \"housner\"\nrestitution_factor = 0.9\n"),
        ["s.toml:3: restitution and restitution_factor exclude each other"]
    );
    assert!(problems("[objects]\nrestitution_factor = 1.1\n")[0].contains("would gain energy"));
    assert!(problems("[objects]\nrestitution = 0\n")[0].contains("above 0 and at most 1"));
    assert!(
        problems("[objects]\nheights = \"1 m:2 m:1001\"\nthicknesses = \"1 m:2 m:1001\"\n")[0]
            .contains("1000000 objects")
    );
    assert!(
        problems("[ground]\nreturn_period_years = 475\n")[0].starts_with(
            "s.toml:2: return_period_years: the code has no factor for a return period of 475 years"
        )
    );
    assert!(
        problems("[ground]\nhazard_factor = -0.1\n")[0]
            .starts_with("s.toml:2: hazard_factor must be positive")
    );
    // One that is wrong does not hide another.
    assert_eq!(
        problems("[ground]\nsite = \"Q\"\nreturn_period_years = 501\nhazard_factor = 0\n").len(),
        3
    );
    assert_eq!(
        problems("[objects]\nheights = \"-1 m\"\nrestitution = 1.2\n").len(),
        2
    );
}

#[test]
fn what_the_reader_must_know_is_a_doubt() {
    let hobart = study("[ground]\ncity = \"hobart\"\n");
    assert!(
        matches!(
            hobart.doubts[0],
            StudyDoubt::Target(TargetDoubt::MinimumGoverns { .. })
        ),
        "{:?}",
        hobart.doubts
    );
    let Ground::Synthetic(ground) = hobart.ground else {
        panic!()
    };
    assert_eq!(
        (ground.target.place_name().as_deref(), ground.target.kpz_g()),
        (Some("Hobart"), Some(0.08))
    );
    let stated = "[ground]\ncity = \"Sydney\"\n[building]\nstoreys = 30\n";
    let squat = study(&format!("{stated}[objects]\nheights = \"0.3 m\"\n"));
    assert!(
        matches!(&squat.doubts[0], StudyDoubt::Squat(found) if (found.count, found.objects) == (2, 5)),
        "{:?}",
        squat.doubts
    );
    assert_eq!(
        study(&format!("{stated}[objects]\nstiffness = \"4380 N/m\"\n"))
            .doubts
            .len(),
        2
    );
    assert_eq!(
        study("[objects]\nstiffness = \"4380 N/m\"\n").doubts.len(),
        4,
        "no place, no building"
    );
}

#[test]
fn every_code_and_a_table_by_the_keys_of_ground() {
    let ground = |text: &str| match study(&format!("[ground]\n{text}")).ground {
        Ground::Synthetic(ground) => ground.target,
        _ => panic!(),
    };
    // Keys that state their unit take bare numbers: 2.5 · 1.2 · 0.2 g, and SDS of 0.8 g.
    let europe = ground(
        "code = \"eurocode8\"\nspectrum_type = 1\nsite = \"B\"\nground_acceleration_g = 0.2\n",
    );
    assert!((europe.spectrum.sa_g(0.3) - 0.6).abs() < 1e-14);
    let america = ground(
        "code = \"asce7\"\nedition = 2016\nsds_g = 0.8\nsd1 = \"0.4 g\"\nlong_period_s = 6\n",
    );
    assert!((america.spectrum.sa_g(0.3) - 0.8).abs() < 1e-14);
    let annex = "code = \"ec8\"\nspectrum_type = 1\nground_acceleration = \"0.2 g\"\nsoil_factor = 1.5\n\
                 corner_periods = [\"0.1 s\", \"400 ms\", \"2 s\"]\n";
    assert!((ground(annex).spectrum.sa_g(0.3) - 0.75).abs() < 1e-14);
    assert_eq!(
        problems(
            "[ground]\ncode = \"nzs1170.5\"\nsite = \"C\"\nhazard_factor = 0.4\nsds = \"1 g\"\n"
        ),
        ["s.toml:5: sds is not part of NZS 1170.5"]
    );
    // What is missing is the fault of the code's line; what could not be read is told once.
    assert_eq!(
        problems("[ground]\n\ncode = \"nzs1170.5\"\nsite = \"C\"\n"),
        ["s.toml:3: NZS 1170.5 needs hazard_factor"]
    );
    assert_eq!(
        problems("[ground]\ncode = \"nzs1170.5\"\nsite = \"C\"\nhazard_factor = true\n").len(),
        1
    );
}

#[test]
fn a_table_lies_beside_the_study() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("uhs.csv"),
        "T [s],PSA [g]\n0.1,0.3\n2,0.05\n",
    )
    .unwrap();
    let file = folder.path().join("s.toml");
    let with = |more: &str| {
        std::fs::write(&file, format!("[ground]\nspectrum = \"uhs.csv\"\n{more}")).unwrap();
        load(&file, &Overrides::default())
    };
    let problem = with("").unwrap_err().problems.remove(0);
    assert_eq!(problem.line, Some(2));
    assert!(
        problem.message.contains("covers 0.1 s to 2 s")
            && problem.hint.unwrap().contains("beyond = \"hold\"")
    );
    let study = with("beyond = \"hold\"\n").unwrap();
    assert_eq!(motion_paths(&study), [folder.path().join("uhs.csv")]);
    std::fs::write(
        folder.path().join("uhs.csv"),
        "T [s],PSA [g]\n0.1,0.3\n2,-1\n",
    )
    .unwrap();
    let problem = with("").unwrap_err().problems.remove(0);
    assert_eq!(
        (problem.line, problem.path),
        (Some(3), Some(folder.path().join("uhs.csv")))
    );
    std::fs::remove_file(folder.path().join("uhs.csv")).unwrap();
    assert_eq!(with("").unwrap_err().problems[0].line, Some(2));
}

#[test]
fn recorded_motions_are_named_and_fingerprinted() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("b")).unwrap();
    for (name, end) in [("quake one.csv", ""), ("b/quake one.csv", "0.02,0.1\n")] {
        std::fs::write(
            folder.path().join(name),
            format!("time [s],a [g]\n0,0\n0.01,0.5\n{end}"),
        )
        .unwrap();
    }
    let path = folder.path().join("study.toml");
    std::fs::write(
        &path,
        "[ground]\nmotions = [\n  \"quake one.csv\",\n  \"b/quake one.csv\",\n]\nscale = -2\n",
    )
    .unwrap();
    let study = load(&path, &Overrides::default()).unwrap();
    let Ground::Recorded(motions) = study.ground else {
        panic!()
    };
    assert_eq!(
        motions.iter().map(|m| m.name.as_str()).collect::<Vec<_>>(),
        ["quake-one", "quake-one-2"]
    );
    assert_eq!(motions[0].motion.accel_m_s2()[1], -freestand::G0_M_S2);
    assert_eq!(
        (motions[0].sha256.len(), motions[0].scale_ratio),
        (64, -2.0)
    );

    std::fs::write(
        &path,
        "[ground]\nmotions = [\n  \"quake one.csv\",\n  \"gone.csv\",\n]\ncount = 3\n",
    )
    .unwrap();
    let error = load(&path, &Overrides::default()).unwrap_err();
    let lines: Vec<Option<usize>> = error.problems.iter().map(|problem| problem.line).collect();
    assert_eq!(lines, [Some(4), Some(6)], "{error}");

    // Files of the command line take the place of the table, whatever it holds.
    let files = MotionFiles {
        paths: vec![folder.path().join("quake one.csv")],
        read: ReadOptions::default(),
        component: None,
        second: crate::recorded::Second::None,
        vertical: Default::default(),
        processing: Processing::default(),
    };
    let study = builtin(&Overrides {
        seed: Some(7),
        motions: Some(files),
        ..Overrides::default()
    })
    .unwrap();
    assert!(matches!(study.ground, Ground::Recorded(motions) if motions.len() == 1));
}

/// 2000, -1000, 0 and 500 counts, 1000 for 1 m/s2, around their mean of 375.
#[test]
fn a_raw_record_has_its_station_and_its_mean_in_the_study() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("a.mseed"), mseed::mseed_record()).unwrap();
    std::fs::create_dir(folder.join("xml")).unwrap();
    let xml = "<FDSNStationXML><Network code='XX'><Station code='ABC'><Channel code='HNE' locationCode=''><Response>\
        <InstrumentSensitivity><Value>1000</Value><InputUnits><Name>M/S**2</Name></InputUnits>\
        <OutputUnits><Name>COUNTS</Name></OutputUnits></InstrumentSensitivity></Response></Channel></Station></Network></FDSNStationXML>";
    std::fs::write(folder.join("xml/s.xml"), xml).unwrap();
    let study = |keys: &str| {
        resolve(
            &format!("[ground]\nmotions = [\"a.mseed\"]\n{keys}"),
            Some(Path::new("s.toml")),
            folder,
        )
    };
    for (keys, peak_m_s2) in [
        ("", 1.625),
        ("processing = { keep_mean = false }\n", 1.625),
        ("processing = { keep_mean = true }\n", 2.0),
    ] {
        let Ground::Recorded(motions) = study(&format!("station_xml = \"xml/s.xml\"\n{keys}"))
            .unwrap()
            .ground
        else {
            panic!()
        };
        // Exact: halves and eighths.
        assert_eq!(motions[0].motion.peak_m_s2(), peak_m_s2, "{keys}");
    }
    let message = study("station_xml = \"s.xml\"\n").unwrap_err().to_string();
    assert!(message.contains("s.xml: cannot open"), "{message}");
    assert_eq!(
        problems("[ground]\nstation_xml = \"a\"\n"),
        ["s.toml:2: station_xml needs motions"]
    );
}

#[test]
fn the_motion_of_the_history_is_one_of_the_study() {
    let study = |name: &str| {
        problems(&format!(
            "[ground]\ncount = 3\n[outputs]\nhistory = {{ level = \"roof\", motion = \"{name}\", height = \"1.5 \
             m\", thickness = \"300 mm\" }}\n"
        ))
    };
    assert_eq!(study("synthetic-03"), [] as [String; 0]);
    for name in ["nope", "synthetic-04", "synthetic-3"] {
        assert_eq!(
            study(name),
            [format!(
                "s.toml:4: history: no motion has the name \"{name}\""
            )]
        );
    }
}

/// The file of the target is next to the study, whatever the working folder; the summary states its
/// fingerprint.
#[test]
fn a_study_scales_to_a_spectrum_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("a.csv"),
        "time [s],a [g]\n0,0\n0.01,0.5\n0.02,0\n",
    )
    .unwrap();
    std::fs::create_dir(folder.path().join("targets")).unwrap();
    let target = "T [s];PSA [g]\n0;1,5\n2;99\n";
    std::fs::write(folder.path().join("targets/t.csv"), target).unwrap();
    let text = "[ground]\nmotions = \"a.csv\"\nprocessing = { scale_to_spectrum = \"targets/t.csv, 0 s to 1 s\" }\n";
    let study = resolve(text, Some(Path::new("s.toml")), folder.path()).unwrap();
    let provenance = crate::provenance::provenance(&study);
    let Ground::Recorded(motions) = study.ground else {
        panic!()
    };
    // At 0 s the spectrum is the peak: 1.5 g over 0.5 g, by way of a logarithm.
    assert!((motions[0].scale_ratio - 3.0).abs() < 1e-14);
    let end =
        " to the spectrum of t.csv (1 period of 0 s, 5 % damping; misfit below 0.01 % rms in ln)";
    assert!(
        motions[0].processing[0].ends_with(end),
        "{:?}",
        motions[0].processing
    );
    let file = motions[0].scale_target.as_ref().unwrap();
    assert_eq!(file.path, folder.path().join("targets/t.csv"));
    assert_eq!(
        provenance.inputs[1],
        (
            "t.csv".to_owned(),
            freestand_input::file::sha256_hex(target.as_bytes())
        )
    );
}

/// What scales the counts of a record is an input like the record itself, named or found beside it.
#[test]
fn a_study_has_the_station_xml_among_its_inputs() {
    let folder = tempfile::tempdir().unwrap();
    let seeds = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds");
    let copy =
        |from: &str, to: &str| std::fs::copy(seeds.join(from), folder.path().join(to)).unwrap();
    copy("mseed/int32.mseed", "a.mseed");
    copy("station_xml/one.xml", "a.xml");
    let sha256 =
        freestand_input::file::sha256_hex(&std::fs::read(folder.path().join("a.xml")).unwrap());
    for key in ["", "station_xml = \"a.xml\"\n"] {
        let text = format!("[ground]\nmotions = [\"a.mseed\"]\n{key}");
        let study = resolve(&text, Some(Path::new("s.toml")), folder.path()).unwrap();
        let inputs = crate::provenance::provenance(&study).inputs;
        assert_eq!(
            (inputs.len(), &inputs[1]),
            (2, &("a.xml".to_owned(), sha256.clone()))
        );
        assert_eq!(motion_paths(&study)[1], folder.path().join("a.xml"));
    }
}

/// The record has no step and no unit: only the mistakes in the study are reported, not their
/// consequences.
#[test]
fn files_are_not_read_without_what_was_refused() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("bare.txt"), "0\n1\n2\n").unwrap();
    std::fs::write(folder.path().join("other.txt"), "0\n2\n1\n").unwrap();
    let found = |keys: &str| {
        let text = format!("[ground]\nmotions = [\"bare.txt\", \"other.txt\"]\n{keys}");
        let error = resolve(&text, Some(Path::new("s.toml")), folder.path())
            .map(|_| ())
            .unwrap_err();
        error
            .problems
            .iter()
            .map(ToString::to_string)
            .collect::<Vec<_>>()
    };
    for (keys, expected) in [
        (
            "unit = \"g\"\ndt = 0.01\n",
            "s.toml:4: dt: \"0.01\" needs a unit",
        ),
        (
            "unit = 3\ndt = \"10 ms\"\n",
            "s.toml:3: unit must be text, not 3",
        ),
        (
            "unit = \"furlong\"\ndt = \"10 ms\"\n",
            "s.toml:3: unit: \"furlong\" is not a unit of an acceleration",
        ),
        (
            "unit = \"g\"\nstep = \"10 ms\"\n",
            "s.toml:4: unknown key step in [ground]",
        ),
        (
            "unit = \"g\"\ndt = \"1000 s\"\n",
            "s.toml:4: dt: the time step must be from 1e-6 s to 100 s, not 1000.0 s",
        ),
        (
            "unit = \"g\"\ndt = \"0.01 s\"\n[objects]\nheights = 5\n[outputs]\n\
             history = { level = \"roof\", height = \"5 m\", thickness = \"200 mm\" }\n",
            "s.toml:6: heights: \"5\" needs a unit",
        ),
    ] {
        assert_eq!(found(keys), [expected], "{keys}");
    }
}

#[test]
fn a_seed_of_the_command_line_wins() {
    let study = builtin(&Overrides {
        seed: Some(7),
        ..Overrides::default()
    })
    .unwrap();
    assert!(matches!(study.ground, Ground::Synthetic(ground) if ground.seed == 7));
}

#[test]
fn what_is_not_a_study_file_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let none = Overrides::default();
    assert!(load(&folder.path().join("no.toml"), &none).is_err());
    assert!(
        load(folder.path(), &none)
            .unwrap_err()
            .to_string()
            .contains("is a folder")
    );
    let binary = folder.path().join("b.toml");
    std::fs::write(&binary, [0xff, 0xfe, 0x00]).unwrap();
    assert!(
        load(&binary, &none)
            .unwrap_err()
            .to_string()
            .contains("is not text")
    );
    #[cfg(unix)]
    assert!(
        load(Path::new("/dev/zero"), &none)
            .unwrap_err()
            .to_string()
            .contains("is a device")
    );
}

#[test]
fn records_are_processed_as_the_study_says() {
    let folder = tempfile::tempdir().unwrap();
    let rows: String = (0..=400)
        .map(|k| {
            let wave = (0.1 * f64::from(k)).sin();
            format!("{},{},{}\n", f64::from(k) / 100.0, 0.1 * wave, 0.2 * wave)
        })
        .collect();
    std::fs::write(
        folder.path().join("two.csv"),
        format!("time [s],N [g],E [g]\n{rows}"),
    )
    .unwrap();
    let resolved = |keys: &str| {
        let text = format!("[ground]\nmotions = \"two.csv\"\n{keys}");
        resolve(&text, Some(Path::new("s.toml")), folder.path())
    };
    let study = resolved(
        "[ground.processing]\nazimuth = \"90 deg\"\nbaseline = \"mean\"\ntaper = \"5 %\"\nlow_cut_hz = 0.5\n\
         high_cut = \"20 Hz\"\nfilter_order = 2\nresample = \"5 ms\"\nscale_to = \"0.3 g\"\n",
    )
    .unwrap();
    let Ground::Recorded(motions) = study.ground else {
        panic!()
    };
    let motion = &motions[0];
    assert_eq!(motion.processing.len(), 6, "{:?}", motion.processing);
    assert_eq!(motion.description, "CSV, components N and E");
    // One rounding of the largest sample.
    assert!((motion.motion.peak_m_s2() / (0.3 * freestand::G0_M_S2) - 1.0).abs() < 1e-15);
    assert_eq!(motion.motion.dt_s(), 0.005);
    assert!(motion.scale_ratio > 1.0);
    let found = |keys: &str| {
        resolved(keys)
            .unwrap_err()
            .problems
            .iter()
            .map(ToString::to_string)
            .collect::<Vec<_>>()
    };
    for (keys, expected) in [
        (
            "processing = { low_cut = \"-1 Hz\" }\n",
            "s.toml:3: low_cut must be positive, not \"-1 Hz\"",
        ),
        (
            "processing = { low_cut = \"5 Hz\", high_cut = \"1 Hz\" }\n",
            "s.toml:3: low_cut: 5 Hz is not below the high cut of 1 Hz",
        ),
        (
            "[ground.processing]\nlow_cut = \"5 Hz\"\nfilter_order = 0\n",
            "s.toml:5: filter_order must be 1 to 10, not 0",
        ),
        (
            "processing = { filter_order = 4 }\n",
            "s.toml:3: filter_order needs low_cut or high_cut",
        ),
        (
            "processing = { taper = \"60 %\" }\n",
            "s.toml:3: taper must be above 0 and at most 50 %, not \"60 %\"",
        ),
        (
            "processing = { resample = \"0.0001 ms\" }\n",
            "s.toml:3: resample: the time step must be from 1e-6 s to 100 s, not 1e-7 s",
        ),
        (
            "scale = 2\nprocessing = { scale_to = \"1 g\" }\n",
            "s.toml:4: scale and scale_to exclude each other",
        ),
        (
            "component = 1\nprocessing = { azimuth = \"3 deg\" }\n",
            "s.toml:4: component and azimuth exclude each other",
        ),
        (
            "processing = { baselin = \"mean\" }\n",
            "s.toml:3: unknown key baselin in [processing]",
        ),
        (
            "processing = { baseline = \"straight\" }\n",
            "s.toml:3: baseline: \"straight\" is not a baseline",
        ),
        (
            "processing = \"mean\"\n",
            "s.toml:3: processing must be a table, not \"mean\"",
        ),
    ] {
        assert_eq!(found(keys), [expected], "{keys}");
    }
    // A fault of this record under this processing is one of the file.
    let nyquist = found("component = 1\nprocessing = { high_cut = \"60 Hz\" }\n");
    assert!(
        nyquist.len() == 1 && nyquist[0].contains("two.csv: filter: a corner frequency"),
        "{nyquist:?}"
    );
    // So is one of a target; the path is relative to the study, and a missing file is reported at
    // the study's line.
    std::fs::write(folder.path().join("bad.csv"), "T [s],Sa [g]\n1,0\n").unwrap();
    let bad = found("component = 1\nprocessing = { scale_to_spectrum = \"bad.csv\" }\n");
    assert!(
        bad.len() == 1
            && bad[0]
                .ends_with("bad.csv:2: the acceleration of a target must be above 0, not 0 m/s2"),
        "{bad:?}"
    );
    for (keys, says) in [
        (
            "processing = { scale_to_spectrum = \"none.csv\" }\n",
            "s.toml:3: scale_to_spectrum: ",
        ),
        (
            "processing = { scale_to_spectrum = \"bad.csv, 5 s\" }\n",
            "s.toml:3: scale_to_spectrum: \"5 s\" is neither a range of periods nor a damping",
        ),
    ] {
        let problems = found(keys);
        assert!(
            problems.len() == 1 && problems[0].starts_with(says),
            "{problems:?}"
        );
    }
    std::fs::write(folder.path().join("good.csv"), "T [s],Sa [g]\n1,0.1\n").unwrap();
    for (scale, other) in [
        ("scale = 2\n", ""),
        ("", "scale_to = \"1 g\", "),
        ("", "scale_to_sa = \"1 g at 1 s\", "),
    ] {
        let text = format!("{scale}processing = {{ {other}scale_to_spectrum = \"good.csv\" }}\n");
        let problems = found(&text);
        assert!(
            problems.len() == 1
                && problems[0].ends_with("and scale_to_spectrum exclude each other"),
            "{problems:?}"
        );
    }
    let synthetic = problems("[ground]\nprocessing = { low_cut = \"1 Hz\" }\n");
    assert_eq!(synthetic, ["s.toml:2: processing needs motions"]);
}

#[test]
fn worlds_that_cannot_be_drawn_are_refused_at_their_line() {
    for (keys, expected) in [
        ("spectral_spread = -0.1", "spectral_spread"),
        ("period_spread = 9", "period_spread"),
        (
            "component_correlation = 1.1",
            "component_correlation must be a correlation from 0 to 1",
        ),
        (
            "component_ratio = 0",
            "component_ratio must be above 0, at most 1",
        ),
        ("components = 3", "components must be 1 or 2"),
        (
            "confidence = 0.5",
            "confidence must be above 0.5 and below 1",
        ),
        ("first = 40\nmost = 20", "first = 40 is more than most = 20"),
        ("first = 0", "first must be a whole number from 1 to"),
    ] {
        let found = problems(&format!("[worlds]\n{keys}\n"));
        assert!(
            found.len() == 1 && found[0].starts_with(&format!("s.toml:2: {expected}")),
            "{keys}: {found:?}"
        );
    }
}

/// A stated spread wins over that of a measured period.
#[test]
fn a_measured_period_is_drawn_with_less_spread() {
    let spread = |text: &str| study(text).assessment.worlds.period_spread;
    let measured = "[building]\nperiod_measured = true\n";
    let found = [
        spread("[worlds]\n"),
        spread(measured),
        spread(&format!("{measured}[worlds]\nperiod_spread = 0.1\n")),
    ];
    assert_eq!(found, [0.2, 0.05, 0.1]);
}
