//! Spectra of codes and places, and motions made for them.

use crate::{cases, freestand, freestand_in};

#[test]
fn code_spectrum() {
    let all = [
        freestand(&[
            "motion",
            "code-spectrum",
            "--city",
            "Hobart",
            "--periods",
            "0 s, 0.3 s, 2 s",
        ]),
        freestand(&["motion", "code-spectrum", "--site", "X"]),
        freestand(&["motion", "code-spectrum", "--return-period", "475"]),
    ];
    cases::each("code_spectrum", &all);
}

#[test]
fn spectra_of_other_codes_and_what_is_wrong_with_them() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("short.csv"),
        "T [s],PSA [g]\n0.1,0.3\n2,0.05\n",
    )
    .unwrap();
    let spectrum = |more: &[&str]| {
        freestand_in(
            folder.path(),
            &[&["motion", "code-spectrum"], more].concat(),
        )
    };
    let periods = ["--periods", "0 s, 0.3 s, 2 s"];
    let europe = [
        "--code",
        "ec8",
        "--spectrum-type",
        "1",
        "--site",
        "B",
        "--ground-acceleration",
        "0.2g",
    ];
    let all = [
        spectrum(&[&europe[..], &periods, &["--parts"]].concat()),
        spectrum(
            &[
                &[
                    "--code",
                    "asce7",
                    "--sds",
                    "1g",
                    "--sd1",
                    "0.6g",
                    "--long-period",
                    "8s",
                ],
                &periods[..],
            ]
            .concat(),
        ),
        spectrum(
            &[
                &[
                    "--code",
                    "nzs1170.5",
                    "--site",
                    "C",
                    "--hazard-factor",
                    "0.4",
                    "--json",
                ],
                &periods[..],
            ]
            .concat(),
        ),
        spectrum(&[&["--edition", "2024"], &periods[..]].concat()),
        spectrum(&["--spectrum", "short.csv", "--periods", "0.1 s, 2 s, 2.1 s"]),
        spectrum(&["--spectrum", "short.csv", "--parts"]),
        spectrum(&["--parts"]),
        spectrum(&[
            "--code",
            "ec8",
            "--city",
            "Oslo",
            "--ground-acceleration",
            "0.1",
        ]),
        spectrum(&[
            "--code",
            "nzs1170.5",
            "--site",
            "De",
            "--hazard-factor",
            "-1",
            "--fault-distance",
            "3",
        ]),
        spectrum(&["--code", "as1170.5"]),
        freestand_in(
            folder.path(),
            &["motion", "synth", "--spectrum", "short.csv"],
        ),
        freestand_in(
            folder.path(),
            &["motion", "synth", "--spectrum", "gone.csv"],
        ),
    ];
    cases::each("spectra_of_other_codes_and_what_is_wrong_with_them", &all);
}

/// Every flag of a code has its place in `--out`: the spectrum with its corners, as numbers and as
/// a picture.
#[test]
fn a_code_spectrum_is_written_with_its_corners() {
    let folder = tempfile::tempdir().unwrap();
    let shown = freestand_in(
        folder.path(),
        &[
            "motion",
            "code-spectrum",
            "--parts",
            "--building-height",
            "96 m",
            "--out",
            "s",
            "-q",
        ],
    );
    assert!(shown.contains("exit status 0"), "{shown}");
    let csv = std::fs::read_to_string(folder.path().join("s/spectrum.csv")).unwrap();
    // De ends its plateau at 1.98/3.68 s.
    let corner = format!("\n{},", 1.98 / 3.68);
    assert!(
        csv.starts_with("period_s,sa_g\n0,0.088")
            && csv.contains(&corner)
            && csv.contains("\n1.5,"),
        "{csv}"
    );
    for name in [
        "spectrum.svg",
        "spectrum.png",
        "result.json",
        "manifest.json",
    ] {
        assert!(folder.path().join("s").join(name).exists(), "{name}");
    }
}

/// The same numbers on one thread and on two, and a seed that matters.
#[test]
#[ignore = "seconds: motions, several times"]
fn synthetic_motions_do_not_depend_on_threads() {
    let synth = |more: &[&str]| {
        let folder = tempfile::tempdir().unwrap();
        let shown = freestand_in(
            folder.path(),
            &[
                &["motion", "synth", "--count", "2", "--out", "m", "-q"],
                more,
            ]
            .concat(),
        );
        assert!(shown.contains("exit status 0"), "{shown}");
        std::fs::read(folder.path().join("m/synthetic-02.csv")).unwrap()
    };
    let one = synth(&["--threads", "1"]);
    assert!(one == synth(&["--threads", "2", "--seed", "1"]));
    assert!(one != synth(&["--seed", "2"]));
}

#[test]
fn places_are_listed_and_shown() {
    let cases: [&[&str]; 12] = [
        &["place", "list", "nzs1170.5"],
        &[
            "place",
            "list",
            "--country",
            "Turkey",
            "--near",
            "41.01, 28.97",
        ],
        &["place", "show", "42.35, 13.40"],
        &["place", "show", "41.01, 28.97"],
        &["place", "show", "40, 31"],
        &["place", "show", "Mexico City"],
        &["place", "show", "Lagoa"],
        &["place", "show", "zürich"],
        &["place", "show", "Salt Lake City", "--json"],
        &["place", "show", "Welington"],
        &["place", "list", "atlantis"],
        &[
            "motion",
            "code-spectrum",
            "--place",
            "Athens",
            "--periods",
            "0.2 s, 1 s",
        ],
    ];
    cases::each("places_are_listed_and_shown", &cases.map(freestand));
    assert_eq!(
        freestand(&["place", "list", "--json"])
            .matches("\"confidence\":")
            .count(),
        4197
    );
}
