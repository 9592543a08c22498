//! What is done to a record after reading: baseline, filter, time step, scale.

use crate::program::execute;
use crate::{RECORD, cases, folder, freestand, freestand_in, two_components};

/// What was done is said step by step, with what was found.
#[test]
fn records_are_processed_step_by_step() {
    let folder = folder(&[("two.csv", &two_components("time [s],N [g],E [g]"))]);
    let processed = |flags: &[&str]| {
        let args = [
            &["motion", "convert", "two.csv", "--to", "csv", "--json"],
            flags,
        ]
        .concat();
        let output = execute(folder.path(), &args);
        let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap_or_default();
        let motion = &json["motions"][0];
        format!(
            "$ {}\n{}\ndt {} npts {} warnings {}\n{}",
            flags.join(" "),
            serde_json::to_string_pretty(&motion["processing"]).unwrap(),
            motion["dt_s"],
            motion["npts"],
            json["warnings"],
            String::from_utf8_lossy(&output.stderr)
        )
    };
    let all = [
        processed(&["--component", "N"]),
        processed(&["--component", "N", "--baseline", "mean", "--taper", "5%"]),
        processed(&[
            "--component",
            "E",
            "--baseline",
            "pre-event:0.5s",
            "--low-cut",
            "0.5 Hz",
        ]),
        processed(&[
            "--component",
            "E",
            "--baseline",
            "graizer:2:1s",
            "--high-cut",
            "10Hz",
            "--filter-order",
            "2",
        ]),
        processed(&[
            "--component",
            "1",
            "--baseline",
            "boore:1s:3s",
            "--resample",
            "10 ms",
        ]),
        processed(&[
            "--azimuth",
            "30 deg",
            "--baseline",
            "poly:2",
            "--scale-to",
            "0.3 g",
        ]),
        processed(&[
            "--azimuth",
            "-60 deg",
            "--resample",
            "0.04 s",
            "--scale-to-sa",
            "9 g at 1.2 s, 2 %",
        ]),
    ];
    cases::each("records_are_processed_step_by_step", &all);
}

#[test]
fn wrong_processing_is_refused() {
    let folder = folder(&[
        ("two.csv", &two_components("time [s],N [g],E [g]")),
        ("h1h2.csv", &two_components("time [s],H1 [g],H2 [g]")),
        ("other.csv", RECORD),
    ]);
    let convert = |flags: &[&str]| {
        freestand_in(
            folder.path(),
            &[
                &[
                    "motion",
                    "convert",
                    "two.csv",
                    "--to",
                    "csv",
                    "--component",
                    "1",
                ],
                flags,
            ]
            .concat(),
        )
    };
    let all = [
        convert(&[
            "--low-cut",
            "-1 Hz",
            "--taper",
            "60%",
            "--filter-order",
            "0",
            "--resample",
            "0 s",
        ]),
        convert(&[
            "--low-cut",
            "5",
            "--baseline",
            "straight",
            "--scale-to",
            "0 g",
            "--filter-order",
            "two",
        ]),
        convert(&["--low-cut", "5 Hz", "--high-cut", "5 Hz"]),
        convert(&["--high-cut", "25 Hz"]),
        convert(&["--low-cut", "1e-9 Hz"]),
        convert(&["--resample", "1000 s"]),
        convert(&["--resample", "50 s"]),
        convert(&["--resample", "0.0173 s", "--filter-order", "4"]),
        convert(&["--resample", "0.017321 s"]),
        convert(&["--baseline", "pre-event:50s"]),
        convert(&["--scale-to-sa", "0.4 g"]),
        convert(&["--scale", "2", "--scale-to", "1 g"]),
        convert(&["--azimuth", "30 deg"]),
        freestand_in(
            folder.path(),
            &[
                "motion",
                "convert",
                "h1h2.csv",
                "--to",
                "csv",
                "--azimuth",
                "30 deg",
            ],
        ),
        freestand_in(
            folder.path(),
            &[
                "motion",
                "convert",
                "other.csv",
                "--to",
                "csv",
                "--azimuth",
                "30 deg",
            ],
        ),
        freestand_in(
            folder.path(),
            &["motion", "info", "two.csv", "--azimuth", "30 deg"],
        ),
        freestand(&["run", "--low-cut", "1 Hz", "--azimuth", "3 deg"]),
    ];
    cases::each("wrong_processing_is_refused", &all);
}

#[test]
fn records_are_scaled_to_a_spectrum() {
    let folder = folder(&[
        ("two.csv", &two_components("time [s],N [g],E [g]")),
        (
            "target.csv",
            "# 500 years\nperiod [s]; PSA [g]\n0,2; 0,8\n0,5; 1,1\n1; 0,35\n2; 0,1\n",
        ),
        ("bare.csv", "T,Sa\n0.2,0.8\n"),
        ("zero.csv", "T (s),Sa (m/s2)\n0.2,8\n0.5,0\n"),
    ]);
    let run = |args: &[&str]| freestand_in(folder.path(), args);
    let convert = |target: &str| {
        let text = run(&[
            "motion",
            "convert",
            "two.csv",
            "--to",
            "csv",
            "--component",
            "1",
            "--json",
            "--scale-to-spectrum",
            target,
        ]);
        // The samples are those of other tests.
        text.lines()
            .filter(|line| !line.contains("\"text\""))
            .collect::<Vec<_>>()
            .join("\n")
    };
    let rock = [
        "rock",
        "--motion",
        "two.csv",
        "--component",
        "1",
        "--height",
        "2 m",
        "--thickness",
        "500 mm",
        "--quiet",
    ];
    let all = [
        convert("target.csv"),
        convert("target.csv, 0.5 s to 1 s, 2 %"),
        convert("target.csv, 3 s to 4 s"),
        convert("target.csv, 5 s"),
        convert("bare.csv"),
        convert("zero.csv"),
        convert("two.csv"),
        convert("none.csv"),
        run(&[
            "motion",
            "rotd",
            "two.csv",
            "--scale-to-spectrum",
            "target.csv",
        ]),
        run(&[
            "motion",
            "info",
            "two.csv",
            "--scale-to-spectrum",
            "target.csv",
            "--scale-to-sa",
            "1 g at 1 s",
        ]),
        // The vertical component has a factor of its own.
        run(&[
            &rock[..],
            &[
                "--vertical",
                "two.csv",
                "--vertical-component",
                "2",
                "--scale-to-spectrum",
                "target.csv",
            ],
        ]
        .concat()),
    ];
    cases::each("records_are_scaled_to_a_spectrum", &all);
}

/// The spectrum that the program writes is a target that it reads: a motion has the factor 1 to its
/// own, at any damping in the file, and 2 to that of twice the motion.
#[test]
fn a_motion_is_scaled_to_the_spectrum_of_its_own() {
    let folder = folder(&[("two.csv", &two_components("time [s],N [g],E [g]"))]);
    let json = |args: &[&str]| -> serde_json::Value {
        let output = execute(folder.path(), args);
        assert!(
            output.status.success(),
            "{args:?}: {}",
            String::from_utf8_lossy(&output.stderr)
        );
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let one = [
        "motion",
        "spectrum",
        "two.csv",
        "--component",
        "N",
        "--damping",
        "2 %, 5 %",
        "--json",
    ];
    json(&[&one[..], &["--out", "once"]].concat());
    json(&[&one[..], &["--scale", "2", "--out", "twice"]].concat());
    for (target, expected) in [
        ("once/spectrum.csv", 1.0),
        ("once/spectrum.csv, 2 %", 1.0),
        ("twice/spectrum.csv", 2.0),
        ("twice/spectrum.csv, 0.1 s to 2 s, 2 %", 2.0),
    ] {
        let scaled = json(&[&one[..], &["--scale-to-spectrum", target]].concat());
        let plain = json(&one);
        for (scaled, plain) in ["psa_g", "sa_g"]
            .map(|key| (&scaled[key], &plain[key]))
            .into_iter()
            .flat_map(|(a, b)| a.as_array().unwrap().iter().zip(b.as_array().unwrap()))
        {
            let ratio = scaled.as_f64().unwrap() / plain.as_f64().unwrap();
            // The file has every digit: roundings of 122 logarithms, and of the response.
            assert!((ratio - expected).abs() < 1e-12, "{target}: {ratio}");
        }
        let step = &scaled["processing"];
        // A factor of 1 has its step too.
        let misfit = step[0]
            .as_str()
            .is_some_and(|step| step.ends_with("misfit below 0.01 % rms in ln)"));
        assert!(
            misfit && (scaled["scale_ratio"].as_f64().unwrap() / expected - 1.0).abs() < 1e-12,
            "{step}"
        );
        // Where the damping is not named, the one that is left out is.
        let is_named = target.ends_with('%');
        let left_out = scaled["warnings"]
            .to_string()
            .contains("those for 2 % are left out");
        assert_eq!(left_out, !is_named, "{target}: {}", scaled["warnings"]);
    }
    // What is read is not replaced, whatever is allowed.
    let before = std::fs::read(folder.path().join("once/spectrum.csv")).unwrap();
    for flag in ["--scale-to-spectrum", "--station-xml"] {
        let onto = [
            &one[..],
            &[flag, "once/spectrum.csv", "--out", "once", "--force"],
        ]
        .concat();
        let refused = freestand_in(folder.path(), &onto);
        assert!(
            refused.contains("exit status 2") && refused.contains("once/spectrum.csv"),
            "{refused}"
        );
        assert_eq!(
            std::fs::read(folder.path().join("once/spectrum.csv")).unwrap(),
            before
        );
    }
}
