//! Hazard curves: tests.

use freestand::code_spectrum::Nzs1170_5;

use super::*;

fn file(text: &str) -> Result<MeasuredHazard, Problems> {
    from_file(
        text.as_bytes(),
        Path::new("h.csv"),
        HazardPlace::Stated(None),
        None,
    )
}

/// The only problem.
fn only(result: Result<MeasuredHazard, Problems>) -> Problem {
    let problems = result.unwrap_err();
    assert_eq!(problems.len(), 1, "{problems}");
    problems.problems[0].clone()
}

#[test]
fn points_are_read_and_refused_with_their_cell() {
    let read = file("pgv [cm/s],annual_rate\n5,0.02\n50,0.0002\n").unwrap();
    assert_eq!((read.measure, read.at), (Measure::Pgv, At::Ground));
    assert!((read.hazard.annual_rate(0.05) - 0.02).abs() < 1e-15);
    let text = b"pgv [m/s],annual_rate\n0.05,0.02\n0.5,0.0002\n";
    let place = HazardPlace::Stated(None);
    let site = Some((151.2, -33.9));
    let sited = from_file(text, Path::new("h.csv"), place, site).unwrap();
    let doubts: Vec<HazardDoubt> = sited.doubts_at(site).collect();
    assert_eq!(doubts, [HazardDoubt::IdleSite]);
    assert_eq!(sited.doubts_at(None).count(), 0);
    let cases = [
        (
            "pgv [cm/s],annual_rate\n10,0.02\n10,0.01\n",
            "h.csv:3: column 1 (\"pgv [cm/s]\"): the intensity 10 is not above 10",
        ),
        (
            "pgv [m/s],annual_rate\n0.1,0.02\n0.2,0.02\n",
            "h.csv:3: column 2 (\"annual_rate\"): the rate 0.02 is not below 0.02",
        ),
        (
            "pgv [m/s],annual_rate\n0.1,0\n0.2,0.02\n",
            "h.csv:2: column 2",
        ),
        ("pgv [m/s],annual_rate\n0.1,0.02\n", "at least two points"),
        (
            "pgv [m/s],rate\n0.1,0.02\n",
            "there is no column \"annual_rate\"",
        ),
        ("pgv,annual_rate\n0.1,0.02\n", "pgv has no unit"),
        (
            "rate,annual_rate\n0.1,0.02\n",
            "there is no column with an intensity measure",
        ),
        (
            "pgv [m/s],pga [g],annual_rate\n0.1,0.1,0.02\n0.2,0.2,0.01\n",
            "h.csv:1: there are two intensity measures, pgv and pga",
        ),
    ];
    for (text, said) in cases {
        let problem = only(file(text));
        assert!(
            problem.to_string().contains(said) && problem.hint.is_some(),
            "{said}: {problem}"
        );
    }
    // The hint is that of the unit, not that of the whole table.
    assert!(
        only(file("pgv,annual_rate\n0.1,0.02\n"))
            .hint
            .is_some_and(|hint| hint.contains("pgv [m/s]"))
    );
    let ugly = "pgv [m/s],annual_rate\n0.05,3\n0.1,0.02\n0.1,0.01\n0.3,0\nx,\n0.4,0.05\n";
    let lines: Vec<Option<usize>> = file(ugly)
        .unwrap_err()
        .problems
        .iter()
        .map(|one| one.line)
        .collect();
    assert_eq!(
        lines,
        [Some(4), Some(5), Some(6), Some(6), Some(7)],
        "all bad rows at once"
    );
    // Motions may be more frequent than once a year.
    assert!(file("pgv [m/s],annual_rate\n0.001,30\n0.1,0.02\n").is_ok());
}

const OPENQUAKE: &str = "#,,,,\"generated_by='OpenQuake engine 3.26.2', start_date='2026-01-01T00:00:00', \
                         checksum=1, kind='mean', investigation_time=50.0, imt='PGV'\"\n\
                         lon,lat,depth,poe-1.0,poe-10.0,poe-100.0\n\
                         151.20000,-33.90000,0.0,1.0,0.1,0.001\n150.0,-33.0,0.0,0.9,0.1,0.0\n";

#[test]
fn curves_of_openquake_become_rates() {
    let read = |site| {
        from_file(
            OPENQUAKE.as_bytes(),
            Path::new("h.csv"),
            HazardPlace::Stated(None),
            site,
        )
    };
    let read_one = read(Some((151.2, -33.9))).unwrap();
    let Hazard::Points(points) = &read_one.hazard else {
        panic!()
    };
    assert_eq!((points.len(), read_one.measure), (2, Measure::Pgv));
    let doubts: Vec<HazardDoubt> = read_one.doubts_at(Some((151.2, -33.9))).collect();
    assert_eq!(doubts, [HazardDoubt::CertainPoints(1)]);
    assert!((points[0].intensity - 0.1).abs() < 1e-15);
    assert!((points[0].annual_rate + 0.9_f64.ln() / 50.0).abs() < 1e-15);
    assert!(only(read(None)).message.contains("2 sites"));
    let elsewhere = only(read(Some((0.0, 0.0))));
    assert!(elsewhere.message.contains("no site at 0,0"), "{elsewhere}");
    assert!(
        elsewhere
            .hint
            .is_some_and(|hint| hint.contains("151.2,-33.9"))
    );
}

/// OpenQuake does not write the periods of AvgSA: they must be added, as our exports do.
#[test]
fn averages_of_openquake_need_their_periods() {
    let of = |imt: &str| {
        file(
            &OPENQUAKE
                .replace("imt='PGV'", imt)
                .replace("150.0,-33.0,0.0,0.9,0.1,0.0\n", ""),
        )
    };
    let read = of("imt='AvgSA', measure='sa_avg(0.2:2)'").unwrap();
    assert_eq!(
        (read.measure, read.at),
        (
            Measure::SaAverage {
                from_s: 0.2,
                to_s: 2.0
            },
            At::Ground
        )
    );
    let Hazard::Points(points) = &read.hazard else {
        panic!()
    };
    assert_eq!(points[0].intensity, 10.0);
    for (imt, said) in [
        (
            "imt='AvgSA'",
            "does not state the periods of AvgSA as measure",
        ),
        (
            "imt='AvgSA', measure='0.2:2'",
            "\"0.2:2\" of AvgSA does not state its periods",
        ),
        ("imt='AvgSA', measure='pga'", "\"pga\" of AvgSA"),
        ("imt='IA'", "not one of PGA, PGV, SA and AvgSA"),
    ] {
        let problem = only(of(imt));
        assert!(
            problem.message.contains(said) && problem.hint.is_some(),
            "{said}: {problem}"
        );
    }
}

#[test]
fn ugly_curves_of_openquake_are_refused_or_mended_aloud() {
    let file = |comment: &str, levels: &str, row: &str| {
        file(&format!(
            "#,,,,\"kind='mean', {comment}imt='PGA'\"\nlon,lat,depth,{levels}\n{row}\n"
        ))
    };
    let ten = "investigation_time=10.0, ";
    let cases = [
        (
            file("", "poe-0.1,poe-0.2", "1,2,0,0.5,0.1"),
            "h.csv:2: the comment above the headings does not state",
        ),
        (
            file("investigation_time=0, ", "poe-0.1,poe-0.2", "1,2,0,0.5,0.1"),
            "\"0\" is not a number of years",
        ),
        (
            file(ten, "poe-0.1,poe-0.2", "1,2,0,0.1,0.5"),
            "h.csv:3: column 5 (\"poe-0.2\"): the rate 0.5 is not below",
        ),
        (
            file(ten, "poe-0.1,poe-0.1", "1,2,0,0.5,0.1"),
            "h.csv:2: the column \"poe-0.1\" appears twice",
        ),
        (
            file(ten, "poe-0.2,poe-0.1", "1,2,0,0.5,0.1"),
            "h.csv:2: column 5: \"poe-0.1\" is not above",
        ),
        (
            file(ten, "poe-0.1,poe-0.2", "1,2,0,0.5,1.5"),
            "h.csv:3: column 5 (\"poe-0.2\"): 1.5 is not a probability",
        ),
        (
            file(ten, "poe-0.1,poe-x", "1,2,0,0.5,0.1"),
            "h.csv:2: column 5: \"poe-x\" states no intensity",
        ),
        (
            file(ten, "poe-0.1,poe-0.2", "1,200,0,0.5,0.1"),
            "h.csv:3: column 2",
        ),
        (
            file(ten, "poe-0.1,poe-0.2,poe-0.4", "1,2,0,1,0.5,0"),
            "h.csv:3: 1 intensity of the site has",
        ),
    ];
    for (read, said) in cases {
        let problem = only(read);
        assert!(
            problem.to_string().contains(said) && problem.hint.is_some(),
            "{said}: {problem}"
        );
    }
    // Equal probabilities: the stronger intensity has the rate.
    let flat = file(ten, "poe-0.1,poe-0.2,poe-0.4", "1,2,0,0.5,0.5,0.1").unwrap();
    let Hazard::Points(points) = &flat.hazard else {
        panic!()
    };
    assert_eq!((points.len(), points[0].intensity), (2, 0.2));
    assert_eq!(flat.doubts, [HazardDoubt::EqualPoints(1)]);
    assert!((points[0].annual_rate - 0.5_f64.ln().abs() / 10.0).abs() < 1e-15);
}

#[test]
fn power_laws_have_three_keys_with_units() {
    let law = power_law("k0=1e-4 /yr, k=2.5, reference=100 cm/s", Measure::Pgv).unwrap();
    assert_eq!(
        law,
        Hazard::PowerLaw {
            rate: 1e-4,
            reference: 1.0,
            exponent: 2.5
        }
    );
    for (text, said) in [
        ("k0=1e-4, k=2.5, reference=1 m/s", "k0 needs the unit"),
        ("k0=1e-4 /yr, k=2.5", "reference is missing"),
        ("k0=1e-4 /yr, k=2.5, reference=1", "pgv has no unit"),
        (
            "k0=1e-4 /yr, k=-2.5, reference=1 m/s",
            "not a number above 0",
        ),
        ("k0", "is not key=value"),
        ("q=3", "is not k0"),
    ] {
        let problem = power_law(text, Measure::Pgv).unwrap_err();
        assert!(
            problem.message.contains(said) && problem.hint.is_some(),
            "{said}: {problem}"
        );
    }
}

/// Sydney, rock: 0.08 g every 500 years, 1.8 times as much every 2500.
#[test]
fn the_return_periods_of_a_code_are_points() {
    let hazard = of_code(HazardCode::As1170_4, "Be", 0.08, None, Measure::Pga)
        .unwrap()
        .hazard;
    assert!((hazard.annual_rate(0.08) - 1.0 / 500.0).abs() < 1e-15);
    assert!((hazard.annual_rate(0.08 * 1.8) * 2500.0 - 1.0).abs() < 1e-12);
    let new_zealand = of_code(
        HazardCode::Nzs1170_5,
        "C",
        0.4,
        None,
        Measure::Sa { period_s: 0.5 },
    )
    .unwrap()
    .hazard;
    assert!((new_zealand.annual_rate(0.8) - 1.0 / 500.0).abs() < 1e-15);
    // Near a fault every point is the spectrum of the code, which ignores the fault up to 250 years.
    let near = of_code(
        HazardCode::Nzs1170_5,
        "C",
        0.4,
        Some(2.0),
        Measure::Sa { period_s: 2.0 },
    )
    .unwrap()
    .hazard;
    for years in [100, 250, 500, 1000] {
        let code = Nzs1170_5::new(SubsoilClass::C, 0.4, years, Some(2.0)).unwrap();
        assert!(
            (near.annual_rate(code.sa_g(2.0)) * f64::from(years) - 1.0).abs() < 1e-12,
            "{years}"
        );
    }
    assert!(of_code(HazardCode::As1170_4, "X", 0.08, None, Measure::Pga).is_err());
    assert!(of_code(HazardCode::As1170_4, "Be", 0.08, None, Measure::Pgv).is_err());
}
