//! Hazard files: tests. Headers are those of published files; the numbers of most are made up.

use super::*;

mod statistics;

fn at(latitude_deg: f64, longitude_deg: f64) -> Wanted {
    Wanted {
        at: Some(Coordinates {
            latitude_deg,
            longitude_deg,
        }),
        ..Wanted::default()
    }
}

fn read(text: &str, wanted: &Wanted) -> Result<SiteHazard, Problem> {
    read_hazard(text.as_bytes(), Path::new("h.csv"), wanted)
}

fn anywhere(text: &str) -> Result<SiteHazard, Problem> {
    read(text, &Wanted::default())
}

/// Equal up to some roundings.
fn close(value: f64, expected: f64) {
    assert!(
        (value / expected - 1.0).abs() < 1e-12,
        "{value} is not {expected}"
    );
}

fn refused(found: Result<SiteHazard, Problem>, line: Option<usize>, said: &str) {
    let problem = found.expect_err(said);
    assert!(
        problem.to_string().contains(said) && problem.hint.is_some() && problem.path.is_some(),
        "{said}: {problem:?}"
    );
    assert_eq!(problem.line, line, "{problem}");
}

const CURVES: &str = "#,,,,\"generated_by='OpenQuake engine 3.18.0', start_date='2023-10-03T06:09:08', \
                      checksum=2107362341, kind='mean', investigation_time=50.0, imt='PGV'\"\n\
                      lon,lat,depth,poe-1.0,poe-10.0,poe-100.0\n\
                      151.20000,-33.90000,0.0,1.0,0.1,0.001\n150.0,-33.0,0.0,0.9,0.1,0.0\n";

/// 10 % in 50 years is a rate of −ln(0.9)/50; PGV in cm/s.
#[test]
fn probabilities_of_openquake_become_rates() {
    let site = read(CURVES, &at(-33.9, 151.2)).unwrap();
    assert_eq!(site.format, HazardFormat::OpenquakeCurves);
    assert_eq!((site.statistic, site.sites), (Some(Statistic::Mean), 2));
    let [curve] = &site.curves[..] else { panic!() };
    assert_eq!(
        (
            curve.measure,
            curve.certain,
            curve.equal,
            curve.points.len()
        ),
        (GroundMeasure::Pgv, 1, 0, 2)
    );
    close(curve.points[0].0, 0.1);
    close(curve.points[0].1, -(0.9_f64.ln()) / 50.0);
    // The nearest site of the file, 1.3 km away, and none beyond 20 km.
    let near = read(CURVES, &at(-33.9, 151.214)).unwrap();
    let km = near.distance_km.unwrap();
    assert!((km - 1.29).abs() < 0.01, "{km}");
    let far = read(CURVES, &at(-33.0, 151.2));
    refused(
        far,
        Some(2),
        "no site at -33, 151.2: the nearest, -33.9, 151.2, is 100 km away",
    );
    refused(anywhere(CURVES), Some(2), "the file has 2 sites");
}

/// Equal probabilities: the stronger intensity has the rate.
#[test]
fn equal_points_are_one() {
    let text = "#,\"investigation_time=10.0, imt='SA(0.5)'\"\nlon,lat,depth,poe-0.1,poe-0.2,poe-0.4\n1,2,0,0.5,0.5,0.1\n";
    let site = anywhere(text).unwrap();
    let curve = &site.curves[0];
    assert_eq!(curve.measure, GroundMeasure::Sa { period_s: 0.5 });
    assert_eq!(
        (curve.points.len(), curve.equal, curve.points[0].0),
        (2, 1, 0.2)
    );
    close(curve.points[0].1, 0.5_f64.ln().abs() / 10.0);
}

/// OpenQuake does not write the periods of AvgSA: they must be added, as our exports do.
#[test]
fn averages_need_their_periods() {
    let of = |imt: &str| read(&CURVES.replace("imt='PGV'", imt), &at(-33.9, 151.2));
    let site = of("imt='AvgSA', measure='sa_avg(0.2:2)'").unwrap();
    let measure = GroundMeasure::SaAverage {
        from_s: 0.2,
        to_s: 2.0,
    };
    assert_eq!(site.curves[0].measure, measure);
    for (imt, said) in [
        (
            "imt='AvgSA'",
            "does not state the periods of AvgSA as measure",
        ),
        (
            "imt='AvgSA', measure='0.2:2'",
            "\"0.2:2\" of AvgSA does not state its periods",
        ),
        (
            "imt='AvgSA', measure='sa_avg(2:0.2)'",
            "of AvgSA does not state its periods",
        ),
        ("imt='IA'", "not one of PGA, PGV, SA and AvgSA"),
    ] {
        refused(of(imt), Some(2), said);
    }
}

#[test]
fn damaged_curves_are_refused_with_their_place() {
    let of = |comment: &str, levels: &str, row: &str| {
        anywhere(&format!(
            "#,,,,\"kind='mean', {comment}imt='PGA'\"\nlon,lat,depth,{levels}\n{row}\n"
        ))
    };
    let ten = "investigation_time=10.0, ";
    for (comment, levels, row, line, said) in [
        (
            "",
            "poe-0.1,poe-0.2",
            "1,2,0,0.5,0.1",
            2,
            "does not state investigation_time",
        ),
        (
            "investigation_time=0, ",
            "poe-0.1,poe-0.2",
            "1,2,0,0.5,0.1",
            2,
            "\"0\" is not a number of years",
        ),
        (
            "investigation_time=1, investigation_time=50, ",
            "poe-0.1,poe-0.2",
            "1,2,0,0.5,0.1",
            2,
            "states two values of investigation_time, 1 and 50",
        ),
        (
            ten,
            "poe-0.1,poe-0.2",
            "1,2,0,0.1,0.5",
            3,
            "column 5 (\"poe-0.2\"): the rate 0.5 is not below 0.1",
        ),
        (
            ten,
            "poe-0.1,poe-0.1",
            "1,2,0,0.5,0.1",
            2,
            "the column \"poe-0.1\" appears twice",
        ),
        (
            ten,
            "poe-0.2,poe-0.1",
            "1,2,0,0.5,0.1",
            2,
            "column 5: \"poe-0.1\" is not above",
        ),
        (
            ten,
            "poe-0.1,poe-0.2",
            "1,2,0,0.5,1.5",
            3,
            "column 5 (\"poe-0.2\"): 1.5 is not a probability",
        ),
        (
            ten,
            "poe-0.1,poe-0.2",
            "1,2,0,0.5,-0.1",
            3,
            "-0.1 is not a probability",
        ),
        (
            ten,
            "poe-0.1,poe-0.2",
            "1,2,0,0.5,nan",
            3,
            "NaN is not a probability",
        ),
        (
            ten,
            "poe-0.1,poe-0.2",
            "1,2,0,0.5,",
            3,
            "\"\" is not a number",
        ),
        (
            ten,
            "poe-0.1,poe-0.2",
            "1,2,0,0.5",
            3,
            "this row has 4 cells, and the header has 5",
        ),
        (
            ten,
            "poe-0.1,poe-x",
            "1,2,0,0.5,0.1",
            2,
            "column 5: \"poe-x\" states no intensity",
        ),
        (
            ten,
            "poe-0.1,poe-0.2",
            "1,200,0,0.5,0.1",
            3,
            "200 is not an angle from -90 to 90 degrees",
        ),
        (
            ten,
            "poe-0.1,poe-0.2,poe-0.4",
            "1,2,0,1,0.5,0",
            3,
            "1 intensity of the site has",
        ),
        (ten, "poe-0.1,poe-0.2", "", 2, "no rows follow"),
    ] {
        refused(of(comment, levels, row), Some(line), said);
    }
    let twice = CURVES.replace("150.0,-33.0", "151.20000,-33.90000");
    refused(
        read(&twice, &at(-33.9, 151.2)),
        Some(4),
        "two sites of the file are at -33.9, 151.2",
    );
}

const HEAD: &str =
    "#,,,,\"generated_by='OpenQuake engine 3.15.0', kind='rlz-001', investigation_time=1.0\"\n";

/// The headings of files that the engine 3.26.2 wrote for one area source, with made-up numbers: a map has one return period, in
/// its name alone, and the probabilities of a spectrum are those in the investigation time.
#[test]
fn files_of_the_engine() {
    let comment = "#,,,,\"generated_by='OpenQuake engine 3.26.2', start_date='2026-11-29T16:45:01', checksum=233251172\"\n";
    let map = format!(
        "{comment}lon,lat,PGA,SA(0.2),SA(1.0)\n10.00000,45.00000,1.6E-01,3.3E-01,5.8E-02\n"
    );
    let of =
        |name: &str, text: &str| read_hazard(text.as_bytes(), name.as_ref(), &Wanted::default());
    let site = of("hazard_map-mean-475y_1.csv", &map).unwrap();
    assert_eq!(
        (site.format, site.return_periods()),
        (HazardFormat::OpenquakeMap, vec![475.0])
    );
    let found = site.spectrum(Some(475.0)).unwrap();
    assert_eq!(found.values, [(0.0, 0.16), (0.2, 0.33), (1.0, 0.058)]);
    let only_pga = format!("{comment}lon,lat,PGA\n10.0,45.0,0.16\n");
    let site = of("hazard_map-mean-2475y_7.csv", &only_pga).unwrap();
    assert_eq!(site.return_periods(), [2475.0]);
    refused(
        of("map.csv", &map),
        Some(2),
        "state the return period of the map",
    );
    let spectra = "#,,,,,,,\"generated_by='OpenQuake engine 3.26.2', kind='mean', investigation_time=50.0\"\n\
                   lon,lat,0.100000~PGA,0.100000~SA(0.2),0.020000~PGA,0.020000~SA(0.2)\n10.0,45.0,0.16,0.33,0.37,0.77\n";
    let site = of("hazard_uhs-mean_1.csv", spectra).unwrap();
    close(site.return_periods()[0], -50.0 / (-0.1_f64).ln_1p());
    assert_eq!(
        site.spectrum(Some(475.0)).unwrap().values,
        [(0.0, 0.16), (0.2, 0.33)]
    );
    // A spectrum that falls with the return period at one period is no reason to refuse the others.
    let falling = spectra.replace("0.37,0.77", "0.37,0.33");
    let site = of("hazard_uhs-mean_1.csv", &falling).unwrap();
    assert!(site.spectrum(Some(475.0)).is_ok());
    let told = site.hazard_curves().unwrap_err();
    assert!(told.message.contains("the value at 2475 years"), "{told}");
}

/// Both hold the same numbers; PGA is the value at 0 s. A probability of 0.002105 in a year is 474.6 years.
#[test]
fn spectra_and_maps_of_openquake() {
    let spectra = "lon,lat,0.002105~PGA,0.002105~SA(0.2),0.002105~SA(1.0),0.000404~PGA,0.000404~SA(0.2),0.000404~SA(1.0)\n\
                   -123.23738,49.27479,0.25,0.5,0.2,0.5,1.0,0.4\n";
    let map = "lon,lat,PGA-0.002105,SA(0.2)-0.002105,SA(1.0)-0.002105,PGV-0.002105,PGA-4.04E-04,SA(0.2)-4.04E-04,SA(1.0)-4.04E-04\n\
               -123.23738,49.27479,0.25,0.5,0.2,30,0.5,1.0,0.4\n";
    for (text, format) in [
        (spectra, HazardFormat::OpenquakeSpectra),
        (map, HazardFormat::OpenquakeMap),
    ] {
        let text = format!("{HEAD}{text}");
        let site = anywhere(&text).unwrap();
        assert_eq!(site.format, format);
        assert_eq!(site.statistic, Some(Statistic::Realization));
        let years = site.return_periods();
        close(years[0], -1.0 / (-0.002105_f64).ln_1p());
        let found = site.spectrum(Some(475.0)).unwrap();
        assert_eq!(found.values, [(0.0, 0.25), (0.2, 0.5), (1.0, 0.2)]);
        assert_eq!(site.spectrum(Some(2475.0)).unwrap().values[1], (0.2, 1.0));
        // Two return periods make a curve for each period.
        let curves = site.hazard_curves().unwrap();
        let measures: Vec<GroundMeasure> = curves.iter().map(|one| one.measure).collect();
        let sa = |period_s| GroundMeasure::Sa { period_s };
        assert_eq!(measures, [GroundMeasure::Pga, sa(0.2), sa(1.0)]);
        assert_eq!((curves[1].points[1].0, curves[1].points.len()), (1.0, 2));
        close(curves[1].points[0].1, years[0].recip());
        let several = site.spectrum(None).unwrap_err();
        assert!(
            several.message.contains("spectra at 475, 2475 years"),
            "{several}"
        );
        let other = site.spectrum(Some(1000.0)).unwrap_err();
        assert!(other.hint.unwrap().contains("475, 2475"));
    }
    let plain = format!(
        "{HEAD}lon,lat,PGA-0.002105,SA(0.2)-0.002105,SA(1.0)-0.002105,PGV-0.002105\n-123.2,49.2,0.25,0.5,0.2,30\n"
    );
    let site = anywhere(&plain).unwrap();
    assert_eq!(site.format, HazardFormat::OpenquakeMap);
    let found = site.spectrum(None).unwrap();
    assert_eq!(found.values, [(0.0, 0.25), (0.2, 0.5), (1.0, 0.2)]);
    for (text, line, said) in [
        (
            plain.replace("0.25", "-0.25"),
            3,
            "column 3 (\"PGA-0.002105\"): the acceleration -0.25",
        ),
        (plain.replace("0.25", "nan"), 3, "the acceleration NaN"),
        (
            plain.replace("PGA-0.002105", "PGA-0.0"),
            2,
            "\"PGA-0.0\" states no probability",
        ),
        (
            plain.replace("SA(1.0)", "SA(0.20)"),
            3,
            "the period 0.2 s is listed twice",
        ),
    ] {
        refused(anywhere(&text), Some(line), said);
    }
}

#[test]
fn spectra_of_aelo_have_a_row_for_each_measure() {
    let comment = "#,,\"generated_by='OpenQuake engine 3.20.0', investigation_time=50.0\"\n";
    for rows in [
        ",poe-0.02,poe-0.1\nPGA,0.5,0.25\nSA(0.2),1,0.5\n",
        "period,poe-0.02,poe-0.1\n0,0.5,0.25\n0.2,1,0.5\n",
    ] {
        let site = anywhere(&format!("{comment}{rows}")).unwrap();
        assert_eq!((site.format, site.at), (HazardFormat::Aelo, None));
        let found = site.spectrum(Some(2475.0)).unwrap();
        assert_eq!(found.values, [(0.0, 0.5), (0.2, 1.0)]);
        refused(anywhere(rows), Some(1), "does not state investigation_time");
        let bad = rows.replace("1,0.5", "x,0.5");
        refused(
            anywhere(&format!("{comment}{bad}")),
            Some(4),
            "\"x\" is not a number",
        );
    }
}

/// The measure is the name of the folder or of the file.
#[test]
fn tables_of_nshmp_haz() {
    let text = "name,lon,lat,0.005,0.05,0.5\nLos Angeles CA,-118.25,34.05,0.4,0.05,0.001\nBoise ID,-116.2,43.6,0.1,0.004,0\n";
    let of = |path: &str, wanted: &Wanted| read_hazard(text.as_bytes(), Path::new(path), wanted);
    let site = of("run/SA0P2/curves.csv", &at(34.05, -118.25)).unwrap();
    assert_eq!(site.name.as_deref(), Some("Los Angeles CA"));
    assert_eq!(site.curves[0].measure, GroundMeasure::Sa { period_s: 0.2 });
    assert_eq!(
        site.curves[0].points,
        [(0.005, 0.4), (0.05, 0.05), (0.5, 0.001)]
    );
    let boise = Wanted {
        name: Some("Boise ID".to_owned()),
        ..Wanted::default()
    };
    // A rate of 0 is no point.
    assert_eq!(
        of("hazard-PGA.csv", &boise).unwrap().curves[0].points.len(),
        2
    );
    refused(
        of("curves.csv", &boise),
        Some(1),
        "does not say whether its intensities are PGA",
    );
    let rising = text.replace("0.4,0.05", "0.04,0.05");
    let found = read_hazard(rising.as_bytes(), Path::new("PGA.csv"), &at(34.05, -118.25));
    refused(
        found,
        Some(2),
        "column 5 (\"0.05\"): the rate 0.05 is not below 0.04",
    );
}

/// The curve of USGS for Los Angeles as its web services send it: both names of the lists, and the newest layout.
#[test]
fn curves_of_the_services_of_usgs() {
    let old = r#"{"status":"success","request":{"longitude":-118,"latitude":34},"response":[
      {"metadata":{"imt":{"value":"PGA"},"xvals":[0.005,0.05,0.5]},"data":[{"component":"Total","yvals":[0.4,0.05,0.001]}]},
      {"metadata":{"imt":{"value":"SA1P0"},"xvals":[0.0025,0.025,0.25]},"data":[{"component":"Grid","yvals":[9,8,7]},{"component":"Total","yvals":[0.6,0.06,0]}]}]}"#;
    let middle = old.replace("xvals", "xvalues").replace("yvals", "yvalues");
    let new = r#"{"request":{"parameters":{"longitude":"-118","latitude":"34"}},"response":{"metadata":{},"hazardCurves":[
      {"imt":{"value":"PGA"},"data":[{"component":"Total","values":{"xs":[0.005,0.05,0.5],"ys":[0.4,0.05,0.001]}}]},
      {"imt":{"value":"SA1P0"},"data":[{"component":"Total","values":{"xs":[0.0025,0.025,0.25],"ys":[0.6,0.06,0]}}]}]}}"#;
    for text in [old, &middle, new] {
        let site = read(text, &at(34.05, -118.0)).unwrap();
        assert_eq!(site.format, HazardFormat::UsgsCurvesJson);
        assert!(site.distance_km.is_some_and(|km| (km - 5.56).abs() < 0.01));
        assert_eq!(
            site.curves[0].points,
            [(0.005, 0.4), (0.05, 0.05), (0.5, 0.001)]
        );
        assert_eq!(site.curves[1].points, [(0.0025, 0.6), (0.025, 0.06)]);
        // Between 0.05 g and 0.5 g the rate falls as x^−1.699: 100 years are 0.05·5^(1/1.699).
        let spectrum = site.spectrum(Some(100.0)).unwrap_err();
        assert!(
            spectrum.message.contains("does not reach 100 years"),
            "{spectrum}"
        );
        let k = 50_f64.log10();
        let found = site.spectrum(Some(1.0 / 0.06)).unwrap();
        close(
            found.values[0].1,
            0.005 * (0.4_f64 / 0.06).powf(1.0 / 8_f64.log10()),
        );
        close(found.values[1].1, 0.025);
        let pga = &site.curves[0];
        close(pga.intensity_at(100.0).unwrap(), 0.05 * 5_f64.powf(1.0 / k));
    }
    let bad = [
        (
            old.replace("0.005,0.05", "0.05,0.05"),
            None,
            "the intensities[1]: the intensity 0.05 is not above",
        ),
        (
            old.replace("[0.4,", "["),
            None,
            "response[0] has 3 intensities and 2 rates",
        ),
        (
            old.replace("0.001", "-0.001"),
            None,
            "-0.001 is not an annual rate",
        ),
        (old.replace("0.001", "\"x\""), None, "\"x\" is not a number"),
        (
            old.replace("\"PGA\"", "\"CAV\""),
            None,
            "the measure \"CAV\" is not known",
        ),
        (
            old[..old.len() - 40].to_owned(),
            Some(3),
            "the JSON is damaged",
        ),
    ];
    for (text, line, said) in bad {
        refused(anywhere(&text), line, said);
    }
}

#[test]
fn design_values_of_usgs() {
    let seven_16 = r#"{"request":{"parameters":{"latitude":34,"longitude":-118,"siteClass":"C"}},"response":{"data":{"pga":0.8,"ss":1.9,"s1":0.7,"sds":1.52,"tl":12}}}"#;
    let old = r#"{"data":{"data":{"ss":1.9,"s1":0.7,"tl":null}}}"#;
    let of_class_c = Some("C".to_owned());
    for (text, site_class, long_period_s) in [(seven_16, of_class_c, Some(12.0)), (old, None, None)]
    {
        let site = anywhere(text).unwrap();
        assert_eq!(
            site.code,
            Some(CodeValues::Asce7 {
                ss_g: 1.9,
                s1_g: 0.7,
                long_period_s,
                site_class,
            })
        );
    }
    let seven_22 = r#"{"response":{"data":{"ss":1.9,"s1":0.7,"multiPeriodDesignSpectrum":{"periods":[0,0.2,1],"ordinates":[0.5,1.2,0.7]}}}}"#;
    let site = anywhere(seven_22).unwrap();
    let found = site.spectrum(None).unwrap();
    assert_eq!((found.years, found.values.len()), (None, 3));
    let none = site.spectrum(Some(475.0)).unwrap_err();
    assert!(none.message.contains("has no return period"), "{none}");
    refused(
        anywhere(&seven_16.replace("12", "-12")),
        None,
        "data.tl is -12, not a period above 0",
    );
    refused(
        anywhere(&old.replace("1.9", "null")),
        None,
        "data.ss is null, not an acceleration",
    );
    refused(
        anywhere(&seven_22.replace("[0.5,", "[")),
        None,
        "has 3 periods and 2 ordinates",
    );
    refused(
        anywhere(&seven_22.replace("0.2,", "0,")),
        None,
        "the period 0 s is listed twice",
    );
}

/// As EFEHR answers for ESHM20 near Bucharest: the layout of NRML 0.3. `saPeriod` is that of the model, not of PGA.
const NRML: &str = r#"<?xml version="1.0" encoding="UTF-8" standalone="yes"?>
<ns2:nrml xmlns:ns2="http://openquake.org/xmlns/nrml/0.3" xmlns:ns1="http://www.opengis.net/gml">
    <ns2:hazardResult ns1:id="gml_id_15092">
        <ns2:config>
            <ns2:hazardProcessing saDamping="0.05" saPeriod="0.1" IDmodel="European Seismic hazard Model 2020 (ESHM20)" investigationTimeSpan="50.0"/>
        </ns2:config>
        <ns2:hazardCurveField quantileValue="0.5" statistics="mean" ns1:id="gml_id_15093">
            <ns2:IML IMT="PGA">0.01 0.1 0.5 1.0</ns2:IML>
            <ns2:HCNode ns1:id="gml_id_15094">
                <ns2:site><ns1:Point srsName="4326">
                    <ns1:pos>26.0821339 44.4</ns1:pos></ns1:Point></ns2:site>
                <ns2:hazardCurve>
                    <ns2:poE>1.0 0.5 0.1 0.01</ns2:poE>
                </ns2:hazardCurve>
            </ns2:HCNode>
        </ns2:hazardCurveField>
    </ns2:hazardResult>
</ns2:nrml>"#;

#[test]
fn curves_and_spectra_of_nrml() {
    let site = read(NRML, &at(44.43, 26.1)).unwrap();
    assert_eq!(
        (site.format, site.statistic),
        (HazardFormat::Nrml, Some(Statistic::Mean))
    );
    let curve = &site.curves[0];
    assert_eq!(
        (curve.measure, curve.certain, curve.points.len()),
        (GroundMeasure::Pga, 1, 3)
    );
    close(curve.points[1].1, -(0.9_f64.ln()) / 50.0);
    let sa = anywhere(&NRML.replace("IMT=\"PGA\"", "IMT=\"SA\"")).unwrap();
    assert_eq!(sa.curves[0].measure, GroundMeasure::Sa { period_s: 0.1 });
    let newer = r#"<?xml version="1.0"?><nrml xmlns="http://openquake.org/xmlns/nrml/0.5" xmlns:gml="http://www.opengis.net/gml">
<hazardCurves IMT="SA" saPeriod="0.2" saDamping="5.0" investigationTime="50.0" statistics="mean">
<IMLs>0.1 0.5</IMLs><hazardCurve><gml:Point><gml:pos>26.0 44.4</gml:pos></gml:Point><poEs>0.5 0.1</poEs></hazardCurve>
</hazardCurves></nrml>"#;
    assert_eq!(
        anywhere(newer).unwrap().curves[0].measure,
        GroundMeasure::Sa { period_s: 0.2 }
    );
    let damped = anywhere(&newer.replace("5.0", "10.0")).unwrap_err();
    assert!(damped.to_string().contains("is 10.0, not 5 %"), "{damped}");
    let spectra = r#"<?xml version="1.0"?><nrml xmlns="http://openquake.org/xmlns/nrml/0.4" xmlns:gml="http://www.opengis.net/gml">
<uniformHazardSpectra investigationTime="50.0" poE="0.1" statistics="mean"><periods>0.0 0.2 1.0</periods>
<uhs><gml:Point><gml:pos>26.0 44.4</gml:pos></gml:Point><IMLs>0.25 0.5 0.2</IMLs></uhs></uniformHazardSpectra></nrml>"#;
    let site = anywhere(spectra).unwrap();
    assert_eq!(
        site.spectrum(Some(475.0)).unwrap().values,
        [(0.0, 0.25), (0.2, 0.5), (1.0, 0.2)]
    );
    for (text, line, said) in [
        (
            NRML.replace("0.5 0.1 0.01", "0.1 0.5 0.01"),
            Some(13),
            "poE, value 3: the rate 0.5 is not below 0.1",
        ),
        (
            NRML.replace("1.0 0.5 0.1 0.01", "1.0 0.5 0.1"),
            Some(9),
            "4 values of IML and 3 of poE",
        ),
        (
            NRML.replace("0.1 0.01<", "0.1 nan<"),
            Some(13),
            "NaN is not a probability",
        ),
        (
            NRML.replace("investigationTimeSpan=\"50.0\"", ""),
            Some(9),
            "does not have investigationTime",
        ),
        (
            NRML.replace("26.0821339 44.4", "26.08"),
            Some(11),
            "\"26.08\" is not a longitude",
        ),
        (NRML[..900].to_owned(), Some(16), "the XML is damaged"),
        (
            spectra.replace("poE=\"0.1\"", "poE=\"1.5\""),
            Some(3),
            "poE \"1.5\" is not a probability",
        ),
    ] {
        refused(anywhere(&text), line, said);
    }
}

/// The first rows of AFAD's grid as it is published.
const AFAD: &str = "LON,LAT,PGA-DD1,PGA-DD2,PGA-DD3,PGA-DD4,Ss-DD1,Ss-DD2,Ss-DD3,Ss-DD4,S1-DD1,S1-DD2,S1-DD3,S1-DD4,PGV-DD4,PGV-DD3,PGV-DD2,PGV-DD1\n\
                    24.55,39.95,1.32,0.716,0.218,0.138,3.273,1.714,0.501,0.317,0.878,0.437,0.121,0.076,7.596,12.321,44.717,83.452\n\
                    24.55,40.05,0.906,0.516,0.19,0.127,2.291,1.246,0.439,0.297,0.617,0.324,0.111,0.074,7.324,11.01,31.6,57.991\n";

#[test]
fn the_grid_of_afad() {
    let site = read(AFAD, &at(39.96, 24.56)).unwrap();
    let expected = CodeValues::Tbdy2018 {
        ss_g: [1.714, 3.273],
        s1_g: [0.437, 0.878],
    };
    assert_eq!((site.code, site.sites), (Some(expected), 2));
    let of = |measure: GroundMeasure| {
        site.curves
            .iter()
            .find(|one| one.measure == measure)
            .unwrap()
    };
    let pga = of(GroundMeasure::Pga);
    assert_eq!(
        pga.points.iter().map(|one| one.0).collect::<Vec<_>>(),
        [0.138, 0.218, 0.716, 1.32]
    );
    close(pga.points[2].1, 1.0 / 475.0);
    // The columns of PGV stand in reverse order, in cm/s.
    let pgv = of(GroundMeasure::Pgv);
    close(pgv.points[3].0, 0.83452);
    close(pgv.points[0].0, 0.07596);
    refused(
        read(AFAD, &at(41.0, 29.0)),
        Some(1),
        "the nearest, 40.05, 24.55, is 391 km away",
    );
    let bad = AFAD.replace("PGA-DD1,PGA-DD2", "PGA-DD2,PGA-DD1");
    refused(read(&bad, &at(39.96, 24.56)), Some(2), "is not above");
}

/// The first row of annex B as it circulates, ag in g/10; with semicolons and decimal commas as well.
#[test]
fn the_grid_of_ntc() {
    let head = "\"OBJECTID\",\"ID\",\"LON\",\"LAT\",\"T30ag\",\"T30F0\",\"T30Tc\",\"T50ag\",\"T50F0\",\"T50Tc\",\"T72ag\",\"T72F0\",\"T72Tc\",\"T101ag\",\"T101F0\",\"T101Tc\",\"T140ag\",\"T140F0\",\"T140Tc\",\"T201ag\",\"T201F0\",\"T201Tc\",\"T475ag\",\"T475F0\",\"T475Tc\",\"T975ag\",\"T975F0\",\"T975Tc\",\"T2475ag\",\"T2475F0\",\"T2475Tc\"";
    let row = "1,13111,6.544813,45.13446,0.26297,2.4951,0.17895,0.34013,2.5099,0.20544,0.3944,2.5455,0.21943,0.46949,2.4898,0.23635,0.54488,2.5002,0.23866,0.63955,2.4941,0.2528,0.94255,2.4352,0.2666,1.2666,2.4202,0.27439,1.7672,2.4342,0.28556";
    let german = |text: &str| text.replace(',', ";").replace('.', ",");
    for text in [
        format!("{head}\n{row}\n"),
        format!("\u{feff}{}\r\n{}\r\n", german(head), german(row)),
    ] {
        let site = read(&text, &at(45.13, 6.54)).unwrap();
        assert_eq!(site.code, Some(CodeValues::Ntc2018));
        let points = &site.curves[0].points;
        close(points[6].0, 0.094255);
        close(points[6].1, 1.0 / 475.0);
    }
}

/// Table 3.1 of TS 1170.5 as published: with a byte-order mark, `" 1/500"` and `>20`.
#[test]
fn the_table_of_ts1170_5() {
    let classes = ["I", "II", "III", "IV", "V", "VI"];
    let names: Vec<String> = classes
        .iter()
        .map(|class| format!("\"{class}-PGA\",\"{class}-Sas\",\"{class}-Tc\",\"{class}-Td\""))
        .collect();
    let row = |place: &str, apoe: &str, d: &str, pga: f64| {
        let four = format!("{pga},{},0.4,2.5", 2.0 * pga);
        format!(
            "\"{place}\",\"{place}\",\"{apoe}\",6.2,{d},{}\n",
            vec![four; 6].join(",")
        )
    };
    let text = format!(
        "\u{feff}\"location\",\"location_ascii\",\"apoe\",\"M\",\"D\",{}\n{}{}{}{}",
        names.join(","),
        row("Kaitaia", " 1/25", "\"n/a\"", 0.02),
        row("Kaitaia", " 1/500", "\">20\"", 0.1),
        row("Hastings", " 1/500", "7", 0.6),
        row("Hastings", " 1/2500", "7", 1.0)
    );
    let named = |name: &str| Wanted {
        name: Some(name.to_owned()),
        ..Wanted::default()
    };
    let site = read(&text, &named("hastings")).unwrap();
    let Some(CodeValues::Ts1170_5(levels)) = &site.code else {
        panic!()
    };
    let years: Vec<(u32, Option<f64>)> = levels
        .iter()
        .map(|one| (one.years, one.fault_distance_km))
        .collect();
    assert_eq!(
        (site.sites, years),
        (2, vec![(500, Some(7.0)), (2500, Some(7.0))])
    );
    assert_eq!(levels[0].values[5], [0.6, 1.2, 0.4, 2.5]);
    assert_eq!(
        site.curves[0].points,
        [(0.6, 1.0 / 500.0), (1.0, 1.0 / 2500.0)]
    );
    let Some(CodeValues::Ts1170_5(levels)) = read(&text, &named("Kaitaia")).unwrap().code else {
        panic!()
    };
    assert_eq!(
        (levels[0].fault_distance_km, levels[1].fault_distance_km),
        (None, Some(20.0))
    );
    refused(
        read(&text, &named("Sydney")),
        Some(1),
        "the file has no site \"Sydney\"",
    );
    refused(
        read(&text, &at(-39.6, 176.8)),
        Some(1),
        "have names, not coordinates",
    );
    let bad = text.replace(" 1/2500", "often");
    refused(
        read(&bad, &named("Hastings")),
        Some(5),
        "\"often\" is not 1/years",
    );
}

/// A map of 3 × 2 cells of 0.5° from 28° E and 42° N, as GEM's: doubles, without compression.
fn map(values: [f64; 6]) -> Vec<u8> {
    use tiff::encoder::{TiffEncoder, colortype::Gray64Float};
    let mut bytes = std::io::Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes).unwrap();
    let mut image = encoder.new_image::<Gray64Float>(3, 2).unwrap();
    image.rows_per_strip(1).unwrap();
    let tags = image.encoder();
    use tiff::tags::Tag;
    tags.write_tag(Tag::ModelPixelScaleTag, &[0.5, 0.5, 0.0][..])
        .unwrap();
    tags.write_tag(Tag::ModelTiepointTag, &[0.0, 0.0, 0.0, 28.0, 42.0, 0.0][..])
        .unwrap();
    image.write_data(&values).unwrap();
    bytes.into_inner()
}

#[test]
fn maps_of_gem() {
    let name = "v2023_1_pga_475_rock_3min.tif";
    let bytes = map([0.1, 0.2, f64::NAN, 0.4, 0.5, -9999.0]);
    let of = |latitude, longitude| read_hazard(&bytes, Path::new(name), &at(latitude, longitude));
    let site = of(41.2, 28.8).unwrap();
    assert_eq!(site.spectrum(Some(475.0)).unwrap().values, [(0.0, 0.5)]);
    assert_eq!(
        site.at,
        Some(Coordinates {
            latitude_deg: 41.25,
            longitude_deg: 28.75
        })
    );
    assert_eq!(of(41.9, 28.1).unwrap().spectra[0].values, [(0.0, 0.1)]);
    refused(of(41.9, 29.4), None, "the map has no value at 41.9, 29.4");
    refused(of(41.2, 29.4), None, "the map has no value at 41.2, 29.4");
    refused(of(40.0, 28.5), None, "40, 28.5 lies outside the map");
    let wanted = at(41.2, 28.8);
    let cut = read_hazard(&bytes[..bytes.len() - 20], Path::new(name), &wanted);
    refused(cut, None, "the TIFF is damaged");
    let unnamed = read_hazard(&bytes, Path::new("map.tif"), &wanted);
    refused(unnamed, None, "does not say that it is PGA");
    let nowhere = read_hazard(&bytes, Path::new(name), &Wanted::default());
    refused(nowhere, None, "no point on it is named");
}

/// Where a record is expected, the message says what such a file is.
#[test]
fn a_hazard_file_is_no_record() {
    use crate::formats::{ReadOptions, parse_motions};
    for (text, said) in [
        (CURVES, "OpenQuake hazard curves"),
        (NRML, "NRML"),
        (AFAD, "AFAD"),
    ] {
        let path = Path::new("h");
        let found = parse_motions(text.as_bytes().to_vec(), path, &ReadOptions::default());
        let problems = found.unwrap_err();
        let told = format!("{problems:?}");
        assert!(
            told.contains("is a hazard file") && told.contains(said),
            "{told}"
        );
    }
}

/// Whatever is cut off anywhere: an answer or a problem, never a panic.
#[test]
fn cut_files_are_refused_or_read() {
    let openquake = format!("{HEAD}lon,lat,0.002105~PGA,0.002105~SA(0.2)\n1,2,0.25,0.5\n");
    for text in [CURVES, &openquake, NRML, AFAD] {
        for end in 0..text.len() {
            let found = read_hazard(&text.as_bytes()[..end], Path::new("h"), &at(44.4, 26.0));
            assert!(found.is_ok() || found.is_err_and(|problem| problem.hint.is_some()));
        }
    }
    let bytes = map([0.1; 6]);
    for end in 0..bytes.len() {
        let path = Path::new("pga_475.tif");
        let found = read_hazard(&bytes[..end], path, &at(41.2, 28.8));
        assert!(found.is_ok() || found.is_err_and(|problem| problem.hint.is_some()));
    }
}

/// The files that the specification names, where they are at hand.
#[test]
fn published_files() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/hazard");
    let Ok(table) = load_hazard(&folder.join("nz_ts1170_5_2025_table3-1.csv")) else {
        println!("skipped: the published files are not here");
        return;
    };
    let wanted = Wanted {
        name: Some("Wellington".to_owned()),
        ..Wanted::default()
    };
    let site = read_hazard(&table, Path::new("nz.csv"), &wanted).unwrap();
    assert_eq!((site.sites, site.format), (214, HazardFormat::Ts1170_5));
    let Some(CodeValues::Ts1170_5(levels)) = &site.code else {
        panic!()
    };
    assert_eq!(
        levels.iter().map(|level| level.years).collect::<Vec<_>>(),
        [25, 50, 100, 250, 500, 1000, 2500]
    );
    // The curve of Los Angeles of USGS: its numbers as the service wraps them.
    let sample = std::fs::read_to_string(folder.join("sample_usgs_hazard_curve_LA.txt")).unwrap();
    let list = |name: &str| {
        let line = sample
            .lines()
            .find_map(|line| line.strip_prefix(name))
            .unwrap();
        format!(
            "[{}]",
            line.split_whitespace().collect::<Vec<_>>().join(",")
        )
    };
    let entries = ["PGA", "SA0P2", "SA1P0"].map(|imt| {
        let [xs, ys] = ["x", "y"].map(|which| list(&format!("{imt} {which} ")));
        format!("{{\"metadata\":{{\"imt\":{{\"value\":\"{imt}\"}},\"xvals\":{xs}}},\"data\":[{{\"yvals\":{ys}}}]}}")
    });
    let text = format!("{{\"response\":[{}]}}", entries.join(","));
    let site = anywhere(&text).unwrap();
    let found = site.spectrum(Some(475.0)).unwrap();
    // By hand, between 0.284 g (0.0038794) and 0.397 g (0.0020752): 0.3936 g.
    let k = (0.003_879_4_f64 / 0.002_075_2).ln() / (0.397_f64 / 0.284).ln();
    close(
        found.values[0].1,
        0.284 * (0.003_879_4_f64 * 475.0).powf(1.0 / k),
    );
    assert_eq!(found.values.len(), 3);
}
