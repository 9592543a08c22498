use super::*;
use freestand_records::formats::ReadOptions;
use freestand_records::processing::{Processing, Scale};

const BOTH: &str = "time [s],N [g],E [g]\n0,0,0\n0.01,0.3,0.4\n0.02,0,0\n";
const ONE: &str = "time [s],H [g]\n0,0\n0.01,0.2\n0.02,0\n";

/// A request for files that are written into a folder.
fn request(folder: &std::path::Path, files: &[(&str, &str)]) -> PairFiles {
    let written = files.iter().map(|(name, text)| {
        let path = folder.join(name);
        std::fs::write(&path, text).unwrap();
        path
    });
    let (read, processing) = (ReadOptions::default(), Processing::default());
    let files = MotionFiles {
        paths: written.collect(),
        read,
        component: None,
        second: crate::recorded::Second::None,
        vertical: Default::default(),
        processing,
    };
    PairFiles {
        files,
        components: None,
    }
}

#[test]
fn a_pair_is_two_components_of_one_file_or_one_of_each_of_two() {
    let folder = tempfile::tempdir().unwrap();
    let names = |request: &PairFiles| {
        let read = read_pair(request).unwrap();
        let (first, second) = read.components().unwrap();
        (first.name.clone(), second.name.clone())
    };
    let both = request(folder.path(), &[("both.csv", BOTH)]);
    assert_eq!(names(&both), ("N".to_owned(), "E".to_owned()));
    let swapped = PairFiles {
        components: Some(("2".to_owned(), "N".to_owned())),
        ..both
    };
    assert_eq!(names(&swapped), ("E".to_owned(), "N".to_owned()));
    let mut two = request(folder.path(), &[("a.csv", ONE), ("b.csv", ONE)]);
    assert_eq!(names(&two), ("H".to_owned(), "H".to_owned()));
    two.files.component = Some("H".to_owned());
    assert_eq!(names(&two), ("H".to_owned(), "H".to_owned()));
}

#[test]
fn what_does_not_go_together_is_refused_before_a_file_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let one = request(folder.path(), &[("both.csv", BOTH)]);
    let messages = |change: &dyn Fn(&mut PairFiles)| {
        let mut changed = one.clone();
        change(&mut changed);
        read_pair(&changed)
            .unwrap_err()
            .into_iter()
            .map(|problem| problem.message)
            .collect::<Vec<_>>()
    };
    let three = |request: &mut PairFiles| request.files.paths = vec!["missing.csv".into(); 3];
    assert_eq!(messages(&three), ["give one or two files"]);
    let none = |request: &mut PairFiles| request.files.paths.clear();
    assert_eq!(messages(&none), ["give one or two files"]);
    let azimuth = |request: &mut PairFiles| request.files.processing.azimuth_deg = Some(0.0);
    assert!(messages(&azimuth)[0].starts_with("`azimuth` cannot be combined with a pair"));
    let component = |request: &mut PairFiles| request.files.component = Some("N".to_owned());
    assert!(
        messages(&component)[0]
            .starts_with("`component` chooses one component of each of two files")
    );
    let components = |request: &mut PairFiles| {
        request.files.paths = vec!["missing.csv".into(); 2];
        request.components = Some(("1".to_owned(), "2".to_owned()));
    };
    assert!(
        messages(&components)[0].starts_with("`components` chooses two components of one file")
    );
}

#[test]
fn both_broken_files_are_reported() {
    let folder = tempfile::tempdir().unwrap();
    let problems =
        read_pair(&request(folder.path(), &[("a.csv", ""), ("b.csv", "x")])).unwrap_err();
    let files: Vec<_> = problems
        .problems
        .iter()
        .map(|p| p.path.as_ref().unwrap().file_name().unwrap().to_owned())
        .collect();
    assert_eq!(files, ["a.csv", "b.csv"]);
}

#[test]
fn a_pair_is_turned_and_processed() {
    let folder = tempfile::tempdir().unwrap();
    let mut asked = request(folder.path(), &[("both.csv", BOTH)]);
    asked.files.processing.scale = Scale::Factor(2.0);
    let read = read_pair(&asked).unwrap();
    // 0.3 north and 0.4 east are 0.5 towards atan(4/3) and nothing across it.
    let along_deg = 4f64.atan2(3.0).to_degrees();
    let turned = rotate(
        &read,
        &RotateRequest {
            azimuth_deg: along_deg,
            azimuths_deg: None,
        },
    )
    .unwrap();
    // Twice 0.5 g; the rounding of a sine, a cosine and three products.
    assert!((turned.processed.motion.peak_m_s2() / freestand::G0_M_S2 - 1.0).abs() < 1e-15);
    assert_eq!(
        (turned.name.as_str(), turned.processed.steps.len()),
        ("both-53.1301deg", 2)
    );
    let across = rotate(
        &read,
        &RotateRequest {
            azimuth_deg: along_deg - 90.0,
            azimuths_deg: None,
        },
    )
    .unwrap();
    assert!(across.processed.motion.peak_m_s2() < 1e-14);
    let west = RotateRequest {
        azimuth_deg: -90.0,
        azimuths_deg: Some((0.0, 270.0)),
    };
    let west = rotate(&read, &west).unwrap();
    let is_direction = |one: &&MotionDoubt| matches!(one, MotionDoubt::OtherDirection { .. });
    let doubts: Vec<&MotionDoubt> = west.doubts.iter().filter(is_direction).collect();
    assert!(
        matches!(
            doubts[..],
            [MotionDoubt::OtherDirection {
                stated_deg: 90.0,
                used_deg: 270.0,
                ..
            }]
        ),
        "{doubts:?}"
    );
    for same in [(0.0, 90.0), (359.8, 90.5), (360.0, 450.0)] {
        let request = RotateRequest {
            azimuth_deg: 0.0,
            azimuths_deg: Some(same),
        };
        let turned = rotate(&read, &request).map(|turned| turned.doubts);
        // What is not perpendicular is refused.
        assert!(!turned.is_ok_and(|all| all.iter().any(|one| is_direction(&one))));
    }
    assert_eq!(
        (west.name.as_str(), west.azimuth_deg),
        ("both-270deg", -90.0)
    );
    let second = read.components().unwrap().1.motion.peak_m_s2();
    assert_eq!(west.processed.motion.peak_m_s2(), 2.0 * second);
}

#[test]
fn a_vertical_component_is_no_part_of_a_pair() {
    let folder = tempfile::tempdir().unwrap();
    let text = "time [s],N [g],Up [g]\n0,0,0\n0.01,0.3,0.4\n0.02,0,0\n";
    let mut asked = request(folder.path(), &[("two.csv", text)]);
    asked.components = Some(("1".to_owned(), "2".to_owned()));
    let problem = read_pair(&asked).unwrap().components().unwrap_err();
    assert_eq!(problem.message, "component Up is vertical");
}

#[test]
fn one_file_twice_is_refused_and_equal_names_are_told_apart() {
    let folder = tempfile::tempdir().unwrap();
    let mut twice = request(folder.path(), &[("one.csv", ONE)]);
    std::fs::create_dir(folder.path().join("b")).unwrap();
    twice.files.paths.push(folder.path().join("b/../one.csv"));
    let problems = read_pair(&twice).unwrap_err();
    assert!(
        problems.len() == 1 && problems.problems[0].message.starts_with("is given twice"),
        "{problems:?}"
    );
    let names = |files: &[(&str, &str)]| {
        let read = read_pair(&request(folder.path(), files)).unwrap();
        read.names(read.components().unwrap())
    };
    let other = ONE.replace("H [g]", "V2 [g]");
    assert_eq!(
        names(&[("one.csv", ONE), ("c.csv", &other)]),
        ("H".to_owned(), "V2".to_owned())
    );
    assert_eq!(
        names(&[("one.csv", ONE), ("c.csv", ONE)]),
        ("H of one.csv".to_owned(), "H of c.csv".to_owned())
    );
    let (first, second) = names(&[("one.csv", ONE), ("b/one.csv", ONE)]);
    assert!(
        first != second && second.starts_with("H of ") && second.ends_with("one.csv"),
        "{first} {second}"
    );
}

#[test]
fn turned_components_of_equal_names_are_named_with_their_files() {
    let folder = tempfile::tempdir().unwrap();
    let longer = ONE.replace("0.2\n", "0.1\n") + "0.03,0\n";
    let read = read_pair(&request(
        folder.path(),
        &[("north.csv", ONE), ("east.csv", &longer)],
    ))
    .unwrap();
    let turned = rotate(
        &read,
        &RotateRequest {
            azimuth_deg: 30.0,
            azimuths_deg: Some((0.0, 90.0)),
        },
    )
    .unwrap();
    assert_eq!(
        turned.processed.steps,
        [
            "last sample of H of east.csv left out: the other component ends earlier",
            "components H of north.csv (0 deg) and H of east.csv (90 deg) rotated to 30 deg"
        ]
    );
}
