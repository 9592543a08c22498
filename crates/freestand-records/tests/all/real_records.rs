//! Recorded motions against facts that were found by other means. The records belong to others and
//! are not shipped: the tests read them where they are at hand (`FREESTAND_SHARED`, else
//! `../shared` beside the workspace) and say so if not.

#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "the lint configuration exempts test functions, but not the helpers of an integration test"
)]

use freestand_records::formats::{Direction, MotionFile, ReadOptions, read_motions};
use freestand_records::processing::{Processing, process};
use serde_json::Value;
use std::path::{Path, PathBuf};

fn shared() -> Option<PathBuf> {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let folder = std::env::var_os("FREESTAND_SHARED")
        .map_or_else(|| workspace.join("../shared"), PathBuf::from);
    let found = folder.join("records/index.json").is_file();
    if !found {
        println!("skipped: recorded motions are not in $FREESTAND_SHARED/records (../shared)");
    }
    found.then_some(folder)
}

fn read(path: &Path, unit: Option<&str>, dt_s: Option<f64>) -> MotionFile {
    let options = ReadOptions {
        unit: unit.map(str::to_owned),
        dt_s,
        ..ReadOptions::default()
    };
    read_motions(path, &options).unwrap_or_else(|error| panic!("{error}"))
}

#[track_caller]
fn assert_close(found: f64, fact: &Value, relative: f64) {
    let fact = fact.as_f64().expect("a number");
    assert!(
        (found - fact).abs() <= relative * fact.abs(),
        "{found} is not {fact}"
    );
}

#[test]
fn records_agree_with_their_facts() {
    let Some(shared) = shared() else { return };
    let index: Value =
        serde_json::from_slice(&std::fs::read(shared.join("records/index.json")).unwrap()).unwrap();
    // What the files leave open is known from where they came.
    let mut read_files = 0;
    for (name, format, unit, dt_s) in [
        ("elCentro.AT2", "PEER AT2", None, None),
        ("RSN175_IMPVALL.H_H-E12140.AT2", "PEER AT2", None, None),
        ("tabasFN.txt", "columns", Some("g"), Some(0.02)),
        ("Northridge.dat", "columns", None, None),
        ("20180212_211557_WPWS_20.V2A", "GeoNet V2A", None, None),
        (
            "HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC",
            "DYNA",
            None,
            None,
        ),
        ("CE23837.V1C", "COSMOS V1", None, None),
        ("CICLC.v1", "CSMIP V1", None, None),
        ("ce36456p_CE36456.V2", "CSMIP V2", None, None),
        ("017m30bt.s0a", "USC V2", None, None),
    ] {
        let record = index["records"]
            .as_array()
            .unwrap()
            .iter()
            .find(|record| record["file"] == name)
            .expect(name);
        let file = read(&shared.join("records").join(name), unit, dt_s);
        let channels = record["channels"].as_array().unwrap();
        assert_eq!(
            (file.format, file.components.len()),
            (format, channels.len()),
            "{name}"
        );
        for (component, fact) in file.components.iter().zip(channels) {
            let accel = component.motion.accel_m_s2();
            assert_eq!(accel.len() as u64, fact["npts"].as_u64().unwrap(), "{name}");
            // Exact: both are the f64 nearest to the printed decimal.
            assert_eq!(
                Some(component.motion.dt_s()),
                fact["dt_s"].as_f64(),
                "{name}"
            );
            assert_eq!(Some(component.unit), fact["unit"].as_str());
            let unit_m_s2 = fact["to_m_per_s2"].as_f64().unwrap();
            let peak = fact["pga_as_given_index"].as_u64().unwrap() as usize;
            // The facts have 7 significant digits: half of 1e-6 of the leading digit.
            assert_close(accel[peak] / unit_m_s2, &fact["pga_as_given"], 5.1e-7);
            assert_close(
                component.motion.peak_m_s2(),
                &Value::from(fact["pga_m_per_s2"].as_f64().unwrap().abs()),
                5.1e-7,
            );
            let sum: f64 = accel.iter().map(|a| a.abs() / unit_m_s2).sum();
            assert_close(sum, &fact["sum_abs"], 5.1e-7);
            let first = fact["first4"].as_array().unwrap().iter().zip(accel);
            let last = fact["last2"]
                .as_array()
                .unwrap()
                .iter()
                .zip(&accel[accel.len() - 2..]);
            for (fact, a) in first.chain(last) {
                assert_close(a / unit_m_s2, fact, 5.1e-7);
            }
        }
        read_files += 1;
    }
    assert_eq!(read_files, 10);

    let rsn = read(
        &shared.join("records/RSN175_IMPVALL.H_H-E12140.AT2"),
        None,
        None,
    );
    assert_eq!(rsn.components[0].name, "140");
    assert_eq!(
        rsn.components[0].station.as_deref(),
        Some("El Centro Array #12")
    );
    let esm = read(
        &shared.join("records/HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC"),
        None,
        None,
    );
    let station = esm.components[0].station.as_deref();
    assert_eq!(
        (esm.components[0].name.as_str(), station),
        ("HNE", Some("HI.ARS1 Town Hall,Argos,Argolis,Peloponnese"))
    );
    let geonet = read(
        &shared.join("records/20180212_211557_WPWS_20.V2A"),
        None,
        None,
    );
    let directions: Vec<_> = geonet
        .components
        .iter()
        .map(|component| component.direction)
        .collect();
    assert_eq!(
        directions,
        [
            Some(Direction::Azimuth(196.0)),
            Some(Direction::Azimuth(106.0)),
            Some(Direction::Up)
        ]
    );
    // The headers' peaks are those of the values.
    assert!(
        esm.notes.is_empty() && geonet.notes.is_empty(),
        "{:?} {:?}",
        esm.notes,
        geonet.notes
    );
}

/// Counts with the instrument's offset in them: as they are read, and about their mean as they are
/// used.
#[test]
fn counts_agree_with_their_facts() {
    let Some(shared) = shared() else { return };
    let index: Value =
        serde_json::from_slice(&std::fs::read(shared.join("records/index.json")).unwrap()).unwrap();
    for (name, format, component) in [
        ("AOM0011801241951.NS", "K-NET", "N-S"),
        ("AICH040010061330.NS2", "K-NET", "NS2"),
    ] {
        let record = index["records"]
            .as_array()
            .unwrap()
            .iter()
            .find(|record| record["file"] == name)
            .expect(name);
        let file = read(&shared.join("records").join(name), None, None);
        // The header's peak, to three decimals, is the one about the mean: no note says otherwise.
        assert_eq!((file.format, &file.notes), (format, &Vec::new()), "{name}");
        let one = file.select(Some(component)).unwrap();
        let fact = &record["channels"][0];
        assert_eq!(
            Some(one.motion.accel_m_s2().len() as u64),
            fact["npts"].as_u64(),
            "{name}"
        );
        assert_eq!(Some(one.motion.dt_s()), fact["dt_s"].as_f64(), "{name}");
        assert_eq!(
            (Some(one.unit), one.is_raw),
            (fact["unit"].as_str(), true),
            "{name}"
        );
        let to_m_s2 = fact["to_m_per_s2"].as_f64().unwrap();
        let as_given: Vec<f64> = one
            .motion
            .accel_m_s2()
            .iter()
            .map(|a| a / to_m_s2)
            .collect();
        let processed = process(one, &Processing::default()).unwrap().motion;
        let centred: Vec<f64> = processed.accel_m_s2().iter().map(|a| a / to_m_s2).collect();
        // The facts have 7 significant digits: half of 1e-6 of the leading digit.
        for (values, basis) in [(&as_given, "pga_as_given"), (&centred, "pga_mean_removed")] {
            let peak = (0..values.len())
                .max_by(|&i, &j| values[i].abs().total_cmp(&values[j].abs()))
                .unwrap();
            assert_eq!(
                Some(peak as u64),
                fact[format!("{basis}_index")].as_u64(),
                "{name}"
            );
            assert_close(values[peak], &fact[basis], 5.1e-7);
        }
        assert_close(
            processed.peak_m_s2(),
            &Value::from(fact["pga_m_per_s2"].as_f64().unwrap().abs()),
            5.1e-7,
        );
        assert_close(
            as_given.iter().map(|a| a.abs()).sum(),
            &fact["sum_abs"],
            5.1e-7,
        );
        let first = fact["first4"].as_array().unwrap().iter().zip(&as_given);
        for (fact, a) in first.chain(
            fact["last2"]
                .as_array()
                .unwrap()
                .iter()
                .zip(&as_given[as_given.len() - 2..]),
        ) {
            assert_close(*a, fact, 5.1e-7);
        }
    }
}

/// Direction and station as the headers print them; their peaks are those of the values.
#[test]
fn channels_of_the_caltech_family_are_named() {
    let Some(shared) = shared() else { return };
    for (name, names, station) in [
        (
            "CE23837.V1C",
            &["360 deg", "Up", "90 deg"][..],
            "Pomona - Orange Grove & Fairplex",
        ),
        (
            "CICLC.v1",
            &["90 Deg", "360 Deg", "Up"],
            "China Lake, G2 Tower Rd.",
        ),
        (
            "ce36456p_CE36456.V2",
            &["90 DEG", "UP", "0 DEG"],
            "PARKFIELD FAULT ZONE 14",
        ),
        (
            "017m30bt.s0a",
            &["N08W"],
            "BIG TUJUNGA STATION, ANGELES NATIONAL FOREST, CA",
        ),
    ] {
        let file = read(&shared.join("records").join(name), None, None);
        let found: Vec<&str> = file
            .components
            .iter()
            .map(|one| one.name.as_str())
            .collect();
        assert_eq!(found, names);
        assert!(
            file.components
                .iter()
                .all(|one| one.station.as_deref() == Some(station) && one.direction.is_some())
        );
        assert_eq!(file.notes, [], "{name}");
    }
}

/// Counts with a StationXML next to them, and single-precision values in g: both with the offset of
/// the instrument.
#[test]
fn raw_binary_records_agree_with_their_facts() {
    let Some(shared) = shared() else { return };
    let index: Value =
        serde_json::from_slice(&std::fs::read(shared.join("records/index.json")).unwrap()).unwrap();
    for (name, format, unit, station, unit_m_s2) in [
        ("CI.CLC..HNE.mseed", "miniSEED 2", None, "CI.CLC", 1.0),
        (
            "20190706031952.CJ.T001230.HNE.sac",
            "SAC",
            Some("g"),
            "CJ.T001230",
            freestand::G0_M_S2,
        ),
    ] {
        let record = index["records"]
            .as_array()
            .unwrap()
            .iter()
            .find(|record| record["file"] == name)
            .expect(name);
        let fact = &record["channels"][0];
        let file = read(&shared.join("records").join(name), unit, None);
        let [one] = file.components.as_slice() else {
            panic!("{} components", file.components.len())
        };
        assert_eq!(
            (file.format, one.name.as_str(), one.station.as_deref()),
            (format, "HNE", Some(station))
        );
        assert_eq!(
            (one.direction, one.is_raw),
            (Some(Direction::Azimuth(90.0)), true)
        );
        assert_eq!(Some(one.unit), fact["unit"].as_str());
        let accel = one.motion.accel_m_s2();
        assert_eq!(accel.len() as u64, fact["npts"].as_u64().unwrap());
        // Exact: the decimal that the header means.
        assert_eq!(Some(one.motion.dt_s()), fact["dt_s"].as_f64());
        let given: Vec<f64> = accel.iter().map(|a| a / unit_m_s2).collect();
        let first = fact["first4"].as_array().unwrap().iter().zip(&given);
        let last = fact["last2"]
            .as_array()
            .unwrap()
            .iter()
            .zip(&given[given.len() - 2..]);
        // The facts have 7 significant digits: half of 1e-6 of the leading digit.
        for (fact, a) in first.chain(last) {
            assert_close(*a, fact, 5.1e-7);
        }
        assert_close(
            given[fact["pga_as_given_index"].as_u64().unwrap() as usize],
            &fact["pga_as_given"],
            5.1e-7,
        );
        assert_close(
            given.iter().map(|a| a.abs()).sum(),
            &fact["sum_abs"],
            5.1e-7,
        );
        for (raw, a) in fact["raw_first4"]
            .as_array()
            .into_iter()
            .flatten()
            .zip(&given)
        {
            // Counts are whole: the product with the sensitivity has two roundings.
            assert_close(
                a * fact["sensitivity"].as_f64().unwrap(),
                raw,
                2.0 * f64::EPSILON,
            );
        }
        let used = process(one, &Processing::default()).unwrap();
        let peak = &fact["pga_m_per_s2"];
        assert_close(used.motion.peak_m_s2(), peak, 5.1e-7);
        assert!(used.steps[0].contains("mean of"), "{:?}", used.steps);
    }
    let file = read(&shared.join("records/CI.CLC..HNE.mseed"), None, None);
    assert!(
        file.notes.iter().any(|note| note
            .to_string()
            .contains("in CI.CLC.xml, 213945 counts/(M/S**2)")),
        "{:?}",
        file.notes
    );
}

#[test]
fn records_that_leave_unit_or_step_open_are_refused() {
    let Some(shared) = shared() else { return };
    let path = shared.join("records/tabasFN.txt");
    for (unit, dt_s, wanted) in [
        (None, None, "time step"),
        (Some("g"), None, "time step"),
        (None, Some(0.02), "unit"),
    ] {
        let options = ReadOptions {
            unit: unit.map(str::to_owned),
            dt_s,
            ..ReadOptions::default()
        };
        let error = read_motions(&path, &options).unwrap_err();
        assert!(error.problems[0].message.contains(wanted), "{error}");
    }
}

#[test]
fn other_formats_are_not_taken_for_columns() {
    let Some(shared) = shared() else { return };
    let columns = ["tabasFN.txt", "Northridge.dat"];
    for entry in std::fs::read_dir(shared.join("records")).unwrap() {
        let path = entry.unwrap().path();
        if columns.iter().any(|name| path.ends_with(name)) {
            continue;
        }
        // A header that is taken for prose must not make a motion of the numbers that follow it.
        match read_motions(&path, &ReadOptions::default()) {
            Ok(file) => assert!(
                !["columns", "CSV"].contains(&file.format),
                "{}",
                path.display()
            ),
            Err(error) => assert!(
                error.problems[0].path.is_some() && error.problems[0].hint.is_some(),
                "{error}"
            ),
        }
    }
}

#[test]
fn validation_motions_state_their_unit_and_step() {
    let Some(shared) = shared() else { return };
    let mut count = 0;
    for entry in std::fs::read_dir(shared.join("cases/records")).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        let stated = |key: &str| {
            let (_, rest) = text.split_once(&format!(" {key}=")).unwrap();
            rest.split_whitespace().next().unwrap().to_owned()
        };
        let file = read(&path, None, None);
        assert_eq!(
            file.components.len().to_string(),
            stated("columns"),
            "{}",
            path.display()
        );
        let rows: Vec<&str> = text.lines().filter(|line| !line.starts_with('#')).collect();
        for (i, component) in file.components.iter().enumerate() {
            assert_eq!(
                component.motion.dt_s(),
                stated("dt").parse::<f64>().unwrap()
            );
            let expected: Vec<f64> = rows
                .iter()
                .map(|row| row.split(',').nth(i).unwrap().parse().unwrap())
                .collect();
            assert_eq!(
                component.motion.accel_m_s2(),
                expected,
                "to the bit: {}",
                path.display()
            );
        }
        count += 1;
    }
    assert!(count >= 9, "{count}");
}

/// Peak floor accelerations of El Centro: T₁ = 2 s, α₀ = 5, 5 % damping, 6 modes and the residual,
/// 20 s of zeros after it.
#[test]
fn floors_under_el_centro() {
    let Some(shared) = shared() else { return };
    let file = read(&shared.join("records/elCentro.AT2"), None, None);
    let ground = file.components[0].motion.with_zero_tail(20.0).unwrap();
    let building = freestand::building::Building::beam(2.0, 0.05, 5.0, 6).unwrap();
    let levels = [0.0, 0.25, 0.5, 1.0];
    let floors = freestand::building::floor_motions(&ground, &building, &levels).unwrap();
    assert_eq!(floors[0], ground);
    for (floor, expected) in floors[1..].iter().zip([0.43358, 0.47211, 0.74002]) {
        // Five decimals are known.
        assert!((floor.peak_m_s2() / freestand::G0_M_S2 - expected).abs() < 5.1e-6);
    }
}

/// Ten equal storeys under El Centro, against the matrices integrated in time by
/// `validation/building/mdof.py`: floors 1 and 5, half-way to floor 6, and the roof.
#[test]
fn a_shear_building_under_el_centro() {
    use freestand::building::{Building, Damping, Storey, floor_peaks};
    let Some(shared) = shared() else { return };
    let file = read(&shared.join("records/elCentro.AT2"), None, None);
    let ground = file.components[0].motion.with_zero_tail(20.0).unwrap();
    let stiffness_n_m = (std::f64::consts::PI / (std::f64::consts::PI / 42.0).sin()).powi(2);
    let storeys = [Storey {
        mass_kg: 1.0,
        stiffness_n_m,
        height_m: 3.0,
    }; 10];
    let uniform = Damping::Uniform(0.05);
    let rayleigh = Damping::Rayleigh {
        damping_ratio: 0.05,
        modes: [1, 3],
    };
    for (damping, modes, expected) in [
        (&uniform, 10, [0.345_313, 0.477_988, 0.472_055, 0.724_285]),
        (&rayleigh, 10, [0.345_821, 0.463_904, 0.464_624, 0.726_023]),
        (&uniform, 3, [0.325_481, 0.468_446, 0.472_962, 0.695_534]),
    ] {
        let building = Building::shear(&storeys, damping, modes).unwrap();
        assert!((building.period_s() - 1.0).abs() < 1e-13);
        let peaks = floor_peaks(&ground, &building, &[0.1, 0.5, 0.55, 1.0]).unwrap();
        for (peak, expected) in peaks.iter().zip(expected) {
            // Six decimals are printed; the script's steps are good to 1e-7.
            let pfa_g = peak.accel_m_s2 / freestand::G0_M_S2;
            assert!(
                (pfa_g - expected).abs() < 7e-7,
                "{damping:?}, {modes} modes: {pfa_g} and {expected}"
            );
        }
    }
}
