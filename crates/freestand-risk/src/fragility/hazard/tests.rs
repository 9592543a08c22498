//! Hazard curves: tests.

use freestand::code_spectrum::Nzs1170_5;
use freestand_records::tables::hazard::Statistic;

use super::*;

fn file(text: &str) -> Result<MeasuredHazard, Problems> {
    from_file(
        text.as_bytes(),
        Path::new("h.csv"),
        HazardPlace::Stated(None),
        Wanted::default(),
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
    let sited = from_file(text, Path::new("h.csv"), place, Wanted::default(), None).unwrap();
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

/// How each format is read is tested where that is done.
#[test]
fn a_downloaded_curve_is_that_of_the_measure() {
    let read = |site, measure| hazard_of_bytes(OPENQUAKE.as_bytes(), site, measure);
    let near = Some((151.2, -33.88));
    let read_one = read(near, None).unwrap();
    assert_eq!((read_one.measure, read_one.at), (Measure::Pgv, At::Ground));
    assert!((read_one.hazard.annual_rate(0.1) + 0.9_f64.ln() / 50.0).abs() < 1e-15);
    // 0.02° of latitude.
    let doubts: Vec<HazardDoubt> = read_one.doubts_at(near).collect();
    assert_eq!(
        doubts,
        [
            HazardDoubt::CertainPoints(1),
            HazardDoubt::SiteAway { metres: 2224 }
        ]
    );
    assert!(only(read(None, None)).message.contains("2 sites"));
    let quantile = OPENQUAKE.replace("'mean'", "'quantile-0.95'");
    let of_quantile = hazard_of_bytes(quantile.as_bytes(), near, None).unwrap();
    let doubts: Vec<HazardDoubt> = of_quantile.doubts_at(near).collect();
    assert!(doubts.contains(&HazardDoubt::OtherThanMean(Statistic::Quantile(0.95))));
    let several = "LON,LAT,PGA-DD1,PGA-DD2,PGA-DD3,PGA-DD4,Ss-DD1,Ss-DD2,Ss-DD3,Ss-DD4,S1-DD1,S1-DD2,S1-DD3,S1-DD4,PGV-DD4,PGV-DD3,PGV-DD2,PGV-DD1\n\
                   24.55,39.95,1.32,0.716,0.218,0.138,3.273,1.714,0.501,0.317,0.878,0.437,0.121,0.076,7.596,12.321,44.717,83.452\n";
    let of = |measure| hazard_of_bytes(several.as_bytes(), None, measure);
    let pgv = of(Some(Measure::Pgv)).unwrap();
    assert!((pgv.hazard.annual_rate(0.44717) * 475.0 - 1.0).abs() < 1e-12);
    let open = only(of(None));
    assert!(
        open.message.contains("curves of pga, sa(0.2), sa(1), pgv"),
        "{open}"
    );
    let other = only(of(Some(Measure::Sa { period_s: 0.5 })));
    assert!(other.message.contains("no curve of sa(0.5)"), "{other}");
    let map = "#,\"kind='mean', investigation_time=1.0\"\nlon,lat,PGA-0.002105\n1,2,0.3\n";
    let one = only(hazard_of_bytes(map.as_bytes(), None, None));
    assert!(
        one.message.contains("one return period alone") && one.hint.is_some(),
        "{one}"
    );
}

fn hazard_of_bytes(
    bytes: &[u8],
    site_deg: Option<(f64, f64)>,
    measure: Option<Measure>,
) -> Result<MeasuredHazard, Problems> {
    let wanted = Wanted {
        at: site_deg.map(on_globe),
        ..Wanted::default()
    };
    let place = HazardPlace::Stated(None);
    from_file(bytes, Path::new("h.csv"), place, wanted, measure)
}

/// The points are the spectra of the code at each return period: Rome by nine, Istanbul by two, with ± 0.5 of slope about 475
/// years; New Zealand's settlements and Z of older codes; no curve from one value.
#[test]
fn the_curve_of_a_place() {
    let of = |name: &str, measure| of_place(name, None, measure);
    let points = |hazard: &Hazard| match hazard {
        Hazard::Points(points) => points.clone(),
        Hazard::PowerLaw { .. } => panic!("points"),
    };
    let rome = of("Rome", Measure::Pga).unwrap();
    let all = points(&rome.hazard);
    assert_eq!(all.len(), 9);
    let code = |years: u32| {
        let mut words: Words = [("place", "Rome")].into_iter().collect();
        words.set("return_period_years", years.to_string());
        Target::resolve_place(&words).unwrap().spectrum.sa_g(0.0)
    };
    assert!((rome.hazard.annual_rate(code(475)) * 475.0 - 1.0).abs() < 1e-12);
    assert!((rome.hazard.annual_rate(code(975)) * 975.0 - 1.0).abs() < 1e-12);
    let istanbul = of("Istanbul", Measure::Sa { period_s: 0.2 }).unwrap();
    let [first, second] = points(&istanbul.hazard)[..] else {
        panic!()
    };
    let slope = |hazard: &Hazard| {
        let [a, b] = points(hazard)[..] else { panic!() };
        -(b.annual_rate / a.annual_rate).ln() / (b.intensity / a.intensity).ln()
    };
    let k = slope(&istanbul.hazard);
    let [flat, steep] = &istanbul.tilted[..] else {
        panic!()
    };
    assert!((slope(flat) - k + 0.5).abs() < 1e-9 && (slope(steep) - k - 0.5).abs() < 1e-9);
    assert!(first.intensity < second.intensity);
    assert!((flat.annual_rate(first.intensity) * 475.0 - 1.0).abs() < 1e-12);
    assert!(istanbul.doubts.contains(&HazardDoubt::SlopeOfPlace));
    // By two codes: of Wellington NZS 1170.5 comes first, of a smaller settlement TS 1170.5 alone.
    for name in ["Wellington", "Kaitaia", "Melbourne"] {
        assert!(
            points(&of(name, Measure::Pga).unwrap().hazard).len() > 3,
            "{name}"
        );
    }
    for name in ["Los Angeles", "Lisbon", "Atlantis"] {
        let problem = only(of(name, Measure::Pga));
        assert!(
            problem.is_about("place") && problem.hint.is_some(),
            "{problem}"
        );
    }
    assert!(only(of("Rome", Measure::Pgv)).message.contains("no pgv"));
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
