use std::path::Path;

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::motion::Motion;
use freestand::signal::resample::MAX_LENGTH;

use super::*;
use crate::doubt::MotionDoubt;
use crate::pair::{PairFiles, read_pair};
use crate::recorded::{MotionFiles, ReadMotion};
use freestand_records::formats::ReadOptions;
use freestand_records::processing::{Processing, Scale};

fn request(folder: &Path, files: &[(&str, &str)]) -> InfoRequest {
    let paths = files
        .iter()
        .map(|(name, text)| {
            let path = folder.join(name);
            std::fs::write(&path, text).unwrap();
            path
        })
        .collect();
    InfoRequest {
        files: MotionFiles {
            paths,
            read: ReadOptions::default(),
            component: None,
            second: crate::recorded::Second::None,
            vertical: Default::default(),
            processing: Processing::default(),
        },
        block: None,
        keep_motions: false,
    }
}

const TWO: &str = "time [s],ns [g],up [g]\n0,0,0\n0.5,0.5,0.1\n1,-1,0\n1.5,0,0\n";

#[test]
fn files_keep_their_order_and_names_differ() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("b")).unwrap();
    let request = request(
        folder.path(),
        &[("z.csv", TWO), ("a.csv", TWO), ("b/z.csv", TWO)],
    );
    let report = info(&request).unwrap();
    let names: Vec<&str> = report.motions.iter().map(|one| one.name.as_str()).collect();
    assert_eq!(names, ["z_ns", "z_up", "a_ns", "a_up", "z_ns-2", "z_up-2"]);
}

#[test]
fn values_are_those_of_the_file_and_measures_those_after_the_processing() {
    let folder = tempfile::tempdir().unwrap();
    let mut request = request(folder.path(), &[("z.csv", TWO)]);
    request.files.processing.scale = Scale::Factor(-2.0);
    // α = atan(1/2): uplift at 0.5 g.
    request.block = Some(Block::uniform(2.0, 1.0).unwrap());
    let one = serde_json::to_value(&info(&request).unwrap().motions[0]).unwrap();
    let number = |name: &str| one[name].as_f64();
    let values = |name: &str| {
        one[name]
            .as_array()
            .unwrap()
            .iter()
            .filter_map(|v| v.as_f64())
            .collect::<Vec<f64>>()
    };
    let g = G0_M_S2;
    assert_eq!(
        (values("first_values_m_s2"), values("last_values_m_s2")),
        (vec![0.0, 0.5 * g, -g, 0.0], vec![-g, 0.0])
    );
    assert_eq!(
        values("processed_first_values_m_s2"),
        [0.0, -g, 2.0 * g, 0.0]
    );
    assert_eq!(values("processed_last_values_m_s2"), [2.0 * g, 0.0]);
    assert_eq!(
        (number("sum_abs_m_s2"), number("mean_m_s2")),
        (Some(1.5 * g), Some(-0.125 * g))
    );
    assert_eq!(
        (number("scale_ratio"), number("pga_signed_m_s2")),
        (Some(-2.0), Some(2.0 * g))
    );
    assert_eq!(one["pga_index"], 2);
    assert_eq!(one["processing"], serde_json::json!(["multiplied by -2"]));
    assert_eq!(
        (
            number("uplift_threshold_g"),
            number("excursions_above_threshold")
        ),
        (Some(0.5), Some(2.0))
    );
    // −1 g at 0.5 s beyond −0.5 g from 0.25 s to 0.5 s + (0.5/3)·0.5 s; +2 g beyond 0.5 g from
    // there + 1/3 to 1.375 s.
    let want = (0.5 + 0.25 / 3.0 - 0.25) + (1.375 - (0.5 + 0.25));
    assert!((number("time_above_threshold_s").unwrap() - want).abs() < 1e-14);
    assert_eq!(number("pga_over_threshold_ratio"), Some(4.0));
}

#[test]
fn broken_files_are_listed_beside_what_could_be_read() {
    let folder = tempfile::tempdir().unwrap();
    let broken = "time [s],a [g]\n0,0\n0.1,x\n0.2,0\n";
    let mut request = request(
        folder.path(),
        &[("a.csv", broken), ("b.csv", TWO), ("c.csv", "")],
    );
    let report = info(&request).unwrap();
    let names: Vec<&str> = report.motions.iter().map(|one| one.name.as_str()).collect();
    assert_eq!(names, ["b_ns", "b_up"]);
    let failed: Vec<_> = report
        .failed
        .iter()
        .map(|one| Path::new(&one.path).file_name().unwrap())
        .collect();
    assert_eq!(failed, ["a.csv", "c.csv"]);
    // The reason does not repeat the path; the message for people has it.
    assert!(
        report.failed[0].reason.starts_with("line 3: "),
        "{:?}",
        report.failed
    );
    assert!(
        report.failed[0].problem.to_string().contains("a.csv:3: ")
            && report.failed[0].problem.hint.is_some()
    );
    assert_eq!(
        report.measures_table().unwrap().to_string().lines().count(),
        3
    );
    // Of broken files only, or of one, there is nothing to report.
    request.files.paths.remove(1);
    let problems = info(&request).unwrap_err();
    let files: Vec<_> = problems
        .problems
        .iter()
        .map(|p| p.path.as_ref().unwrap().file_name().unwrap().to_owned())
        .collect();
    assert_eq!(files, ["a.csv", "c.csv"]);
}

/// A component of zeros has no factor to a target; the other one of its file has.
#[test]
fn a_component_that_fails_hides_no_other() {
    let folder = tempfile::tempdir().unwrap();
    let still = TWO.replace("0.1\n", "0\n");
    let mut request = request(folder.path(), &[("one.csv", TWO), ("two.csv", &still)]);
    request.files.processing.scale = Scale::Peak { target_m_s2: 1.0 };
    let report = info(&request).unwrap();
    assert_eq!((report.motions.len(), report.failed.len()), (3, 1));
    assert!(
        report.failed[0].reason.starts_with("component up: scale: "),
        "{:?}",
        report.failed
    );
    request.files.paths.remove(0);
    assert_eq!(info(&request).unwrap_err().len(), 1);
}

#[test]
fn measures_as_csv_have_a_row_a_component_and_no_lists() {
    let folder = tempfile::tempdir().unwrap();
    let csv = info(&request(folder.path(), &[("z.csv", TWO)]))
        .unwrap()
        .measures_table()
        .unwrap();
    let text = csv.to_string();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 3);
    assert!(lines[0].starts_with(
        "motion,format,component,station,direction,azimuth_deg,unit,is_raw,dt_s,npts"
    ));
    assert!(
        lines[0].ends_with(",mean_m_s2,sum_abs_m_s2,scale_ratio,processing")
            && !lines[0].contains("values")
    );
    // No station, no block: empty fields.
    assert!(
        lines[1].starts_with("z_ns,CSV,ns,,horizontal,0,g,false,0.5,4,1.5,"),
        "{}",
        lines[1]
    );
    assert_eq!(lines[0].split(',').count(), lines[1].split(',').count());
}

fn read(dt_s: f64, accel: Vec<f64>) -> ReadMotion {
    let motion = crate::study::RecordedMotion {
        name: "x".into(),
        path: "x.csv".into(),
        sha256: String::new(),
        description: String::new(),
        scale_ratio: 1.0,
        station_xml: Vec::new(),
        scale_target: None,
        processing: Vec::new(),
        motion: Motion::new(dt_s, accel).unwrap(),
        matched: None,
        suite: None,
        across: None,
        vertical: None,
    };
    ReadMotion {
        motion,
        notes: Vec::new(),
        start_note: None,
        unit: "m/s2",
    }
}

#[test]
fn short_periods_are_doubted_unless_there_are_samples_enough() {
    let motion = read(0.02, vec![0.0, 1.0, 0.0, -1.0, 0.0]);
    let doubts = |periods: &[f64], upsample| {
        let request = SpectrumRequest {
            damping_ratios: vec![0.05],
            periods_s: periods.to_vec(),
            upsample,
        };
        spectrum(&motion, &request).unwrap().doubts
    };
    // Ten steps of 0.02 s are 0.2 s; half of that needs twice the samples.
    assert_eq!(doubts(&[0.0, 0.2, 1.0], 1), []);
    let few = MotionDoubt::FewSteps {
        shortest_s: 0.1,
        dt_s: 0.02,
        upsample: 1,
        needed: 2.0,
    };
    assert_eq!(doubts(&[0.1, 1.0], 1), [few]);
    assert_eq!(doubts(&[0.1, 1.0], 2), []);
}

/// A sine of 20 Hz in 100 samples a second, fading in and out, resonates at T = 0.05 s: PSA near
/// 1/(2ζ) = 10 times. On the straight lines between five samples a cycle its fundamental is smaller
/// by sinc²(0.2) = 0.875.
#[test]
fn upsampling_follows_the_curve_and_not_the_lines() {
    let (dt_s, f_hz) = (0.01, 20.0);
    let at =
        |t: f64| (std::f64::consts::TAU * f_hz * t).sin() * (-(t - 5.0) * (t - 5.0) / 4.0).exp();
    let of = |dt_s: f64, n: usize, upsample| {
        let motion = read(dt_s, (0..=n).map(|i| at(i as f64 * dt_s)).collect());
        let request = SpectrumRequest {
            damping_ratios: vec![0.05],
            periods_s: vec![0.05],
            upsample,
        };
        spectrum(&motion, &request).unwrap().first.psa_g[0]
    };
    let exact = of(dt_s / 64.0, 64_000, 1);
    // 10 samples a cycle from 2, 50 from 10: straight lines lose 1 − sinc²(1/50) = 0.13 %, peaks at
    // samples 0.2 %.
    assert!((of(dt_s, 1000, 10) / exact - 1.0).abs() < 4e-3);
    assert!((of(dt_s, 1000, 1) / exact - 0.875).abs() < 0.05);
}

#[test]
fn samples_are_refined_up_to_the_one_bound_of_resampling() {
    assert_eq!(check_upsampling(10, MAX_LENGTH / 10), Ok(()));
    // A longer motion that is left as it is needs no resampling.
    assert_eq!(check_upsampling(1, MAX_LENGTH + 1), Ok(()));
    for (factor, samples) in [(2, MAX_LENGTH / 2 + 1), (usize::MAX, 2)] {
        let problem = check_upsampling(factor, samples).unwrap_err();
        assert!(
            problem
                .message
                .ends_with("more than resampling allows (25000000)"),
            "{problem}"
        );
        assert!(!problem.message.contains("--"), "{problem}");
    }
    let request = SpectrumRequest {
        damping_ratios: vec![0.05],
        periods_s: vec![1.0],
        upsample: MAX_LENGTH,
    };
    let problem = spectrum(&read(0.01, vec![0.0, 1.0, 0.0]), &request).unwrap_err();
    assert!(
        problem.message.contains("upsampling 3 samples "),
        "{problem}"
    );
}

#[test]
fn short_periods_over_directions_are_warned_of_too() {
    let folder = tempfile::tempdir().unwrap();
    let pair = read_pair(&PairFiles {
        files: request(
            folder.path(),
            &[(
                "two.csv",
                "time [s],N [g],E [g]\n0,0,0\n0.01,0.3,0.4\n0.02,0,0\n",
            )],
        )
        .files,
        components: None,
    });
    let pair = pair.unwrap();
    let doubts = |period_s: f64| {
        let request = RotdRequest {
            damping_ratio: 0.05,
            periods_s: vec![0.0, period_s],
            percentiles: vec![50.0],
        };
        rotd(&pair, &request).unwrap().doubts
    };
    assert_eq!(doubts(0.1), []);
    assert!(matches!(
        &doubts(0.09)[..],
        [MotionDoubt::OfRecords(words)]
            if words.starts_with("the shortest period of the spectrum, 0.09 s, has fewer than ten steps")
    ));
}

/// Two files with one component each, of the same name: the steps of each are listed once, under
/// the name of its file.
#[test]
fn notes_of_a_pair_are_said_once_with_their_files() {
    let folder = tempfile::tempdir().unwrap();
    let short = "time [s],a0 [g]\n0,0\n0.01,0.3\n0.02,0\n";
    let long = "time [s],a0 [g]\n0,0\n0.01,0.4\n0.02,0\n0.03,0.1\n";
    let files = request(folder.path(), &[("n.csv", short), ("e.csv", long)]).files;
    let pair = read_pair(&PairFiles {
        files,
        components: None,
    })
    .unwrap();
    let request = RotdRequest {
        damping_ratio: 0.05,
        periods_s: vec![0.5],
        percentiles: vec![50.0],
    };
    let report = rotd(&pair, &request).unwrap();
    let said = "last sample of a0 of e.csv left out: the other component ends earlier";
    assert_eq!(report.doubts, [MotionDoubt::OfRecords(said.to_owned())]);
    assert_eq!(report.processing, [vec![], vec![said.to_owned()]]);
}

fn directions(
    text: &str,
    percentiles: &[f64],
    processing: Processing,
) -> Result<RotdReport, freestand_input::problem::Problem> {
    let folder = tempfile::tempdir().unwrap();
    let mut files = request(folder.path(), &[("two.csv", text)]).files;
    files.processing = processing;
    let pair = read_pair(&PairFiles {
        files,
        components: None,
    })
    .unwrap();
    rotd(
        &pair,
        &RotdRequest {
            damping_ratio: 0.05,
            periods_s: vec![0.0],
            percentiles: percentiles.to_vec(),
        },
    )
}

const LEVEL: &str = "time [s],N [g],E [g]\n0,0,0\n0.01,0.3,0.4\n0.02,0,0\n";

#[test]
fn spectra_over_directions_keep_the_order_of_the_percentiles() {
    let report = directions(LEVEL, &[50.0, 100.0, 0.0, 16.5], Processing::default()).unwrap();
    let json = serde_json::to_value(&report).unwrap();
    let keys: Vec<&str> = json
        .as_object()
        .unwrap()
        .keys()
        .map(String::as_str)
        .collect();
    let ranked = ["rotd50_g", "rotd100_g", "rotd0_g", "rotd16.5_g"];
    let others = [
        "first_g",
        "second_g",
        "larger_g",
        "geometric_mean_g",
        "processing",
    ];
    assert_eq!(
        keys[..4],
        ["paths", "components", "damping_ratio", "periods_s"]
    );
    assert_eq!((&keys[4..8], &keys[8..]), (&ranked[..], &others[..]));
    let csv = report.table().unwrap().to_string();
    let header = "period_s,rotd50_g,rotd100_g,rotd0_g,rotd16.5_g,larger_g,geometric_mean_g,first_g,second_g\n0,";
    assert!(csv.starts_with(header), "{csv}");
    // One sample of 0.3 g and 0.4 g is 0.5 g along its direction, which is at most half a degree
    // from one that is calculated, and 0.5·|cos| over all: its median over the half circle is
    // 0.5·cos 45°, within a degree.
    let largest = report.rotd[1].psa_g[0];
    assert!(
        largest <= 0.5 + 1e-15 && largest > 0.5 * 0.5_f64.to_radians().cos(),
        "{largest}"
    );
    assert!((report.rotd[0].psa_g[0] - 0.5 * 0.5_f64.sqrt()).abs() < 0.5 * 1f64.to_radians());
    // The same as in the file but for the way from g to m/s² and back, and a square root.
    for (found, expected) in [
        (&report.first_g, 0.3),
        (&report.larger_g, 0.4),
        (&report.geometric_mean_g, 0.12_f64.sqrt()),
    ] {
        assert!((found[0] - expected).abs() < 1e-15, "{found:?}");
    }
}

#[test]
fn what_no_spectrum_over_directions_has_is_refused() {
    let refused = |percentiles: &[f64], processing| {
        directions(LEVEL, percentiles, processing)
            .unwrap_err()
            .message
    };
    assert_eq!(
        refused(&[50.0, 0.0, 50.0], Processing::default()),
        "percentile 50 is requested twice"
    );
    assert_eq!(
        refused(&[0.0, -0.0], Processing::default()),
        "percentile -0 is requested twice"
    );
    assert!(refused(&[101.0], Processing::default()).contains("from 0 to 100"));
    let scale = Scale::Peak { target_m_s2: 1.0 };
    assert!(
        refused(
            &[50.0],
            Processing {
                scale,
                ..Processing::default()
            }
        )
        .contains("two components cannot be scaled to a target: each would get its own factor")
    );
}
