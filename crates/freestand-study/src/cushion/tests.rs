use super::*;

fn words(entries: &[(&'static str, &str)]) -> Words {
    entries.iter().copied().collect()
}

fn resolved(entries: &[(&'static str, &str)]) -> EdgeCushion {
    resolve(&words(entries), Some(140.0)).unwrap()
}

fn refused(entries: &[(&'static str, &str)]) -> String {
    let problems = resolve(&words(entries), None).unwrap_err();
    problems
        .into_iter()
        .map(|problem| problem.message)
        .collect::<Vec<_>>()
        .join("; ")
}

#[test]
fn every_law_has_its_words() {
    let law = |entries: &[(&'static str, &str)]| resolved(entries).cushion.law().clone();
    assert_eq!(
        law(&[("stiffness", "4380 N/mm")]),
        ContactLaw::Linear {
            stiffness_n_m: 4.38e6
        }
    );
    assert_eq!(
        law(&[("law", "Hertz"), ("stiffness", "2e7 N/m^1.5")]),
        ContactLaw::Power {
            coefficient_n_mn: 2e7,
            exponent: 1.5
        }
    );
    assert_eq!(
        law(&[
            ("law", "power"),
            ("exponent", "2"),
            ("stiffness", "3 N/mm^2")
        ]),
        ContactLaw::Power {
            coefficient_n_mn: 3e6,
            exponent: 2.0
        }
    );
    let hunt = [
        ("law", "hunt_crossley"),
        ("stiffness", "2e7 N/m^1.5"),
        ("dissipation", "0.3 s/m"),
    ];
    let expected = ContactLaw::HuntCrossley {
        coefficient_n_mn: 2e7,
        exponent: 1.5,
        dissipation_s_m: 0.3,
    };
    assert_eq!(law(&hunt), expected);
    assert_eq!(
        law(&[
            ("law", "tangent"),
            ("stiffness", "1000 N/mm"),
            ("bottoming", "12 mm")
        ]),
        ContactLaw::Tangent {
            stiffness_n_m: 1e6,
            bottoming_m: 0.012
        }
    );
    assert_eq!(
        law(&[
            ("law", "tabulated"),
            ("compressions", "0 mm, 1 mm, 2 mm"),
            ("forces", "0 N, 1 kN, 3 kN")
        ]),
        ContactLaw::Tabulated {
            compressions_m: vec![0.0, 1e-3, 2e-3],
            forces_n: vec![0.0, 1e3, 3e3]
        }
    );
}

/// 2 × 2190 N/mm with 2 × 150 N s/m; a ratio is of the mass on the whole edge: 2 · 0.05 · √(4.38e6
/// · 140) = 2476.2875.
#[test]
fn pads_bring_their_damping_with_them() {
    let pads = [
        ("law", "kelvin-voigt"),
        ("pad_stiffness", "2190 N/mm"),
        ("pads_per_edge", "2"),
    ];
    let with = |damping: &str| {
        let mut words = words(&pads);
        words.set("damping", damping);
        resolve(&words, Some(140.0)).unwrap()
    };
    let edge = |damping_n_s_m| ContactLaw::KelvinVoigt {
        stiffness_n_m: 4.38e6,
        damping_n_s_m,
    };
    assert_eq!(*with("150 N s/m").cushion.law(), edge(300.0));
    let ContactLaw::KelvinVoigt { damping_n_s_m, .. } = *with("5 %").cushion.law() else {
        panic!("another law")
    };
    assert!((damping_n_s_m - 2476.2875).abs() < 1e-4);
    assert!(matches!(
        with("5 %").notes[..],
        [
            CushionNote::Pads { count: 2, .. },
            CushionNote::DampingRatio {
                ratio: 0.05,
                mass_kg: 140.0,
                ..
            }
        ]
    ));
    let mut without_mass = words(&pads);
    without_mass.set("damping", "5%");
    assert!(
        resolve(&without_mass, None).unwrap_err().problems[0]
            .message
            .contains("needs the mass")
    );
}

#[test]
fn layers_are_told() {
    let edge = resolved(&[
        ("pad_stiffness", "2190 N/mm"),
        ("pads_per_edge", "2"),
        ("series_stiffness", "4380 N/mm"),
        ("series_stiffness", "2190 N/mm"),
    ]);
    assert!((edge.cushion.linear_stiffness_n_m().unwrap() / 1.095e6 - 1.0).abs() < 1e-14);
    let layers = [4.38e6, 4.38e6, 2.19e6].map(|k| Cushion::linear(k).unwrap());
    let in_series = CushionNote::InSeries {
        layers: layers.to_vec(),
        whole: edge.cushion,
    };
    assert_eq!(edge.notes[1], in_series);
}

#[test]
fn what_does_not_belong_together_is_refused_by_its_key() {
    let cases: [(&[(&'static str, &str)], &str); 12] = [
        (&[], "the stiffness of the cushion is missing"),
        (&[("stiffness", "4380")], "needs a unit"),
        (
            &[("stiffness", "4380 N/mm"), ("exponent", "2")],
            "`exponent` is not part of a linear law",
        ),
        (
            &[("stiffness", "4380 N/mm"), ("pad_stiffness", "1 N/mm")],
            "exclude each other",
        ),
        (
            &[("stiffness", "4380 N/mm"), ("pads_per_edge", "2")],
            "`pads_per_edge` needs `pad_stiffness`",
        ),
        (&[("pad_stiffness", "4380 N/mm")], "needs `pads_per_edge`"),
        (
            &[("pad_stiffness", "4380 N/mm"), ("pads_per_edge", "0")],
            "at least 1",
        ),
        (
            &[("law", "spring"), ("stiffness", "1 N/mm")],
            "`law` \"spring\" is not known",
        ),
        (
            &[("law", "kelvin-voigt"), ("stiffness", "1 N/mm")],
            "a kelvin-voigt law needs `damping`",
        ),
        (
            &[("law", "tangent"), ("stiffness", "1 N/mm")],
            "a tangent law needs `bottoming`",
        ),
        (
            &[("law", "tabulated"), ("stiffness", "1 N/mm")],
            "`stiffness` is not part of a tabulated law",
        ),
        (
            &[
                ("law", "kelvin-voigt"),
                ("stiffness", "1 N/mm"),
                ("damping", "1 N s/m"),
                ("series_stiffness", "1 N/mm"),
            ],
            "in series must be undamped",
        ),
    ];
    for (entries, message) in cases {
        let got = refused(entries);
        assert!(got.contains(message), "{entries:?}: {got}");
    }
}

#[test]
fn a_cushion_file_is_one_pad() {
    let folder = std::env::temp_dir().join(format!("freestand-cushion-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("pad.toml");
    std::fs::write(
        &path,
        "law = \"kelvin-voigt\"\nstiffness_n_mm = 2190\ndamping = \"150 N s/m\"\n",
    )
    .unwrap();
    let (file, _) = read_cushion_file(&path).unwrap();
    let flags = words(&[("cushion", "pad.toml"), ("pads_per_edge", "2")]);
    let edge = resolve(&with_file(&flags, file.clone()).unwrap(), None).unwrap();
    assert_eq!(
        *edge.cushion.law(),
        ContactLaw::KelvinVoigt {
            stiffness_n_m: 4.38e6,
            damping_n_s_m: 300.0
        }
    );
    let without_pads = with_file(&words(&[("cushion", "pad.toml")]), file.clone()).unwrap_err();
    assert_eq!(without_pads.message, "`cushion` needs `pads_per_edge`");
    let twice = words(&[
        ("cushion", "pad.toml"),
        ("pads_per_edge", "2"),
        ("stiffness", "1 N/mm"),
    ]);
    assert_eq!(
        with_file(&twice, file).unwrap_err().message,
        "`cushion` and `stiffness` exclude each other"
    );
    std::fs::write(&path, "stifness = \"2190 N/mm\"\n").unwrap();
    assert!(
        read_cushion_file(&path)
            .unwrap_err()
            .to_string()
            .contains("stifness")
    );
    std::fs::remove_dir_all(&folder).unwrap();
}
