//! Two components: turned, and their spectra over all directions.

use crate::program::execute;
use crate::{cases, folder, freestand_in, two_components};

#[test]
fn components_are_turned() {
    let folder = folder(&[
        ("two.csv", &two_components("time [s],N [g],E [g]")),
        ("h1h2.csv", &two_components("time [s],H1 [g],H2 [g]")),
        ("one.csv", "time [s],a [g]\n0,0\n0.02,0.3\n0.04,-0.3\n"),
        (
            "other.csv",
            "time [s],a [g]\n0,0\n0.02,0.4\n0.04,0\n0.06,0\n",
        ),
        ("slow.csv", "time [s],a [g]\n0,0\n0.04,0.4\n0.08,0\n"),
    ]);
    let rotate =
        |args: &[&str]| freestand_in(folder.path(), &[&["motion", "rotate"], args].concat());
    let short = |text: String| text.lines().take(8).collect::<Vec<_>>().join("\n");
    let all = [
        rotate(&[
            "one.csv",
            "other.csv",
            "--azimuths",
            "0 deg, 90 deg",
            "--to",
            "53.13010235415598 deg",
        ]),
        rotate(&[
            "one.csv",
            "other.csv",
            "--azimuths",
            "0 deg, 90 deg",
            "--to",
            "90 deg",
            "--json",
        ]),
        short(rotate(&["two.csv", "--to", "-30 deg", "--format", "at2"])),
        short(rotate(&[
            "h1h2.csv",
            "--azimuths",
            "10 deg, 100 deg",
            "--components",
            "H2, H1",
            "--to",
            "45 deg",
        ])),
        rotate(&["h1h2.csv", "--to", "45 deg"]),
        rotate(&["one.csv", "other.csv", "--to", "45 deg"]),
        rotate(&[
            "one.csv",
            "slow.csv",
            "--azimuths",
            "0 deg, 90 deg",
            "--to",
            "45 deg",
        ]),
        rotate(&[
            "one.csv",
            "other.csv",
            "--azimuths",
            "0 deg, 175 deg",
            "--to",
            "45 deg",
        ]),
        rotate(&["one.csv", "--azimuths", "0 deg, 90 deg", "--to", "45 deg"]),
        rotate(&["two.csv", "--components", "N, N", "--to", "45 deg"]),
        rotate(&[
            "two.csv",
            "--components",
            "N",
            "--azimuths",
            "0 deg",
            "--to",
            "45",
        ]),
        rotate(&["two.csv", "--azimuth", "0 deg", "--to", "45 deg"]),
        rotate(&["one.csv", "other.csv", "two.csv", "--to", "45 deg"]),
    ];
    cases::each("components_are_turned", &all);
}

#[test]
fn spectra_over_all_directions() {
    let folder = folder(&[
        ("two.csv", &two_components("time [s],N [g],E [g]")),
        ("skew.csv", &two_components("time [s],N [g],N60E [g]")),
    ]);
    let rotd = |args: &[&str]| freestand_in(folder.path(), &[&["motion", "rotd"], args].concat());
    let all = [
        rotd(&[
            "two.csv",
            "--periods",
            "0 s, 0.5 s, 2 s",
            "--baseline",
            "mean",
        ]),
        rotd(&[
            "two.csv",
            "--periods",
            "0.5 s",
            "--percentiles",
            "0, 50, 100",
            "--damping",
            "2%",
            "--json",
        ]),
        rotd(&["skew.csv", "--periods", "0.5 s"]),
        rotd(&["two.csv", "--percentiles", "150", "--periods", "0.5 s"]),
        rotd(&["two.csv", "--periods", "-1 s"]),
        rotd(&["two.csv", "--scale-to", "1 g"]),
        rotd(&["two.csv", "--component", "N"]),
        rotd(&["two.csv", "--percentiles", "50, 50"]),
    ];
    cases::each("spectra_over_all_directions", &all);
    rotd(&["two.csv", "--periods", "0.5 s, 1 s", "--out", "out"]);
    let csv = std::fs::read_to_string(folder.path().join("out/rotd.csv")).unwrap();
    assert!(
        csv.starts_with(
            "period_s,rotd50_g,rotd100_g,larger_g,geometric_mean_g,first_g,second_g\n0.5,"
        ),
        "{csv}"
    );
}

/// A turned record has more energy in its own direction than in any other: the same is found by
/// `--azimuth`.
#[test]
fn azimuth_and_rotate_agree() {
    let folder = folder(&[("two.csv", &two_components("time [s],N [g],E [g]"))]);
    let text = |args: &[&str]| execute(folder.path(), args).stdout;
    let converted = text(&[
        "motion",
        "convert",
        "two.csv",
        "--to",
        "csv",
        "--azimuth",
        "30 deg",
    ]);
    let rotated = text(&["motion", "rotate", "two.csv", "--to", "30 deg"]);
    assert!(converted == rotated && converted.len() > 1000);
}

/// One recorder, times in four decimals, two lengths: one pair. Components of one name are told
/// apart by their files, each warning is said once, and one file is no pair.
#[test]
fn pairs_of_two_files() {
    let recorded = |rows: u32, pace: f64| {
        let row = |k: u32| {
            format!(
                "{:.4},{}\n",
                f64::from(k) / 128.0,
                0.1 * (pace * f64::from(k)).sin()
            )
        };
        format!(
            "time [s],a0 [g]\n{}",
            (0..rows).map(row).collect::<String>()
        )
    };
    let (north, east) = (recorded(1000, 0.1), recorded(900, 0.13));
    let folder = folder(&[
        ("north.csv", &north),
        ("east.csv", &east),
        ("copy.csv", &north),
    ]);
    let rotd = |files: &[&str]| {
        freestand_in(
            folder.path(),
            &[&["motion", "rotd"], files, &["--periods", "0.05 s, 0.5 s"]].concat(),
        )
    };
    let all = [
        rotd(&["north.csv", "east.csv"]),
        rotd(&["north.csv", "copy.csv"]),
        rotd(&["north.csv", "./north.csv"]),
        rotd(&["north.csv", "east.csv", "--json"]),
    ];
    cases::each("pairs_of_two_files", &all);
}
