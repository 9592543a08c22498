use super::*;
use crate::figures::figures;
use crate::study::fixture;
use freestand_output::figure::Figure;
use freestand_study::provenance::provenance;
use freestand_study::study::StudyDoubt;

fn rendered(recorded: bool) -> (Vec<Figure>, String) {
    let mut study = fixture::study();
    let mut result = fixture::result(&study);
    if recorded {
        study = fixture::recorded(study, &result);
        for ground in &mut result.ground {
            ground.name = "<b>El & \"Centro\"</b> $x$ $y$".into();
            ground.misfit = None;
        }
        for (level, named) in result.levels.iter_mut().zip(&study.levels) {
            level.level = named.clone();
        }
        result
            .doubts
            .push(StudyDoubt::OfRecords("<script>alert(2)</script>".into()));
        let history = result.history.as_mut().unwrap();
        history.level = study.levels[1].name.clone();
        history.motion = result.ground[0].name.clone();
    }
    let figures = figures(&study, &result).unwrap();
    let html = report(&study, &result, &figures, &provenance(&study));
    (figures, html)
}

fn texts(document: &roxmltree::Document) -> String {
    document
        .descendants()
        .filter_map(|node| node.is_text().then(|| node.text()).flatten())
        .collect::<Vec<_>>()
        .join("\n")
}

/// Every report is well-formed, loads no other file, and has no NaN and no duplicate id.
fn check(html: &str) {
    let options = roxmltree::ParsingOptions {
        allow_dtd: true,
        ..Default::default()
    };
    let document = roxmltree::Document::parse_with_options(html, options).unwrap();
    let mut ids: Vec<&str> = document
        .descendants()
        .filter_map(|node| node.attribute("id"))
        .collect();
    let all = ids.len();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), all, "an id stands twice");
    for node in document.descendants() {
        assert!(!["script", "link", "img", "iframe", "object"].contains(&node.tag_name().name()));
        for attribute in node.attributes() {
            let name = attribute.name();
            assert!(!name.starts_with("on") && name != "src", "{name}");
            if name == "href" {
                let target = attribute.value().strip_prefix('#').unwrap();
                assert!(ids.contains(&target), "{target}");
            }
            if let Some((_, id)) = attribute.value().split_once("url(#") {
                assert!(ids.contains(&id.trim_end_matches(')')), "{id}");
            }
        }
    }
    for namespace in ["http://www.w3.org/2000/svg", "http://www.w3.org/1999/xhtml"] {
        assert!(html.contains(namespace));
    }
    let rest = html.replace("http://www.w3.org/", "");
    for unwanted in ["http://", "https://", "<script", "@import", "NaN", "inf "] {
        assert!(!rest.contains(unwanted), "{unwanted}");
    }
}

#[test]
fn every_figure_is_drawn_with_its_axes() {
    let (figures, _) = rendered(false);
    let expected: [(&str, &[&str]); 8] = [
        (
            "urs",
            &[
                "Height of the object (m)",
                "Uplift (mm)",
                "t = 200 mm",
                "overturned",
                "roof",
                "mid-height",
            ],
        ),
        (
            "srs",
            &[
                "Height of the object (m)",
                "Shock (g)",
                "uplift ceiling",
                "half or more overturn it",
            ],
        ),
        (
            "overturning",
            &["Height of the object (m)", "Share of motions"],
        ),
        (
            "floor_spectra",
            &[
                "Period (s)",
                "Spectral acceleration (g)",
                "ground",
                "target: code spectrum",
                "T₁",
            ],
        ),
        (
            "floor_profile",
            &[
                "Peak floor acceleration (g)",
                "Height (m)",
                "median",
                "16 and 84 %",
                "a code’s line",
            ],
        ),
        (
            "history",
            &[
                "Time (s)",
                "Rotation θ/α (–)",
                "Floor acceleration (g)",
                "Shock (g)",
            ],
        ),
        ("record_01", &["Time (s)"]),
        ("record_02", &["Time (s)"]),
    ];
    assert_eq!(figures.len(), expected.len());
    for (figure, (name, labels)) in figures.iter().zip(expected) {
        assert_eq!(figure.name, name);
        let document = roxmltree::Document::parse(&figure.svg).unwrap();
        let texts = texts(&document);
        for label in labels {
            assert!(texts.contains(label), "{name}: {label}");
        }
        assert!(
            !figure.svg.contains("NaN") && !figure.svg.contains("inf\""),
            "{name}"
        );
        assert!(document.root_element().attribute("viewBox").is_some());
        assert!(figure.png.starts_with(b"\x89PNG\r\n\x1a\n"), "{name}");
        assert!(!figure.title.is_empty() && !figure.caption.is_empty());
    }
}

#[test]
#[ignore = "seconds: a report, twice"]
fn the_same_result_gives_the_same_report() {
    assert_eq!(rendered(false), rendered(false));
}

#[test]
fn report_holds_figures_tables_and_definitions() {
    let (figures, html) = rendered(false);
    check(&html);
    crate::print_check::check_print(
        &html,
        "Free-standing objects in a 500-year earthquake: Melbourne, site class De",
        "",
    );
    let options = roxmltree::ParsingOptions {
        allow_dtd: true,
        ..Default::default()
    };
    let document = roxmltree::Document::parse_with_options(&html, options).unwrap();
    let count = |tag: &str| {
        document
            .descendants()
            .filter(|n| n.tag_name().name() == tag)
            .count()
    };
    assert_eq!(count("svg"), figures.len());
    assert_eq!(count("figcaption"), figures.len());
    let texts = texts(&document);
    for words in [
        "Summary of each level",
        "failed",
        "Histories that failed",
        "g + ü_v ≤ 0",
        "Validity warnings",
        "How well the motions fit their target",
        "3.35 times its ZPA",
        "Fundamental period T₁",
        "about 3.5 g",
        "up to 5 g",
        "overturned",
        "N/mm: only then",
        "ChaCha12Rng",
        "AS 1170.4",
        "150 kg",
        "4380 N/mm",
        "Housner",
    ] {
        assert!(texts.contains(words), "{words}");
    }
    // Every object of every level is in the tables once: 26 heights, and 5 overturned shares or
    // blanks each.
    let rows = document
        .descendants()
        .filter(|n| n.tag_name().name() == "tr");
    assert_eq!(
        rows.filter(|row| row
            .children()
            .filter(|c| c.attribute("class") == Some("n share"))
            .count()
            == 5)
            .count(),
        52
    );
}

#[test]
#[ignore = "seconds: several reports"]
fn texts_of_others_are_escaped_and_the_tolerance_is_marked() {
    let (figures, html) = rendered(true);
    check(&html);
    for figure in &figures {
        roxmltree::Document::parse(&figure.svg).unwrap();
    }
    assert!(html.contains("&lt;script&gt;alert(2)&lt;/script&gt;"));
    assert!(html.contains("roof &amp; &lt;i&gt;mast&lt;/i&gt;"));
    assert!(html.contains("▲") && html.contains("tolerance of 2 g"));
    assert!(!html.contains("target: code spectrum"));
    // Ten recorded motions: the first six are drawn, each with its steps, and the report says so.
    let records: Vec<_> = figures
        .iter()
        .filter(|figure| figure.name.starts_with("record_"))
        .collect();
    assert_eq!((records.len(), records[5].name.as_str()), (6, "record_06"));
    assert!(
        records
            .iter()
            .all(|figure| figure.caption.contains("processing: multiplied by 1.25"))
    );
    assert!(html.contains("Figures show the first 6 of the 10 recorded ground motions"));
}

/// Everything of a motion that may be drawn: nothing but zeros, two samples, a drift, a million
/// samples.
#[test]
#[ignore = "seconds: reports with many records"]
fn records_of_every_kind_are_drawn_small() {
    let million: Vec<f64> = (0..1_000_000)
        .map(|i| (i as f64 * 0.7).sin() * 1e-6)
        .collect();
    for accel in [vec![0.0; 3], vec![0.0, 1.0], vec![9.0; 5000], million] {
        let motion = freestand::motion::Motion::new(0.005, accel).unwrap();
        let words = crate::figures::Words {
            name: "a <b> $x$",
            description: "CSV",
            processing: &[],
        };
        let figure = crate::figures::record_figure(words, &motion).unwrap();
        let document = roxmltree::Document::parse(&figure.svg).unwrap();
        let texts = texts(&document);
        for label in ["Time (s)", "Arias intensity (%)", "largest value"] {
            assert!(texts.contains(label), "{label}");
        }
        assert!(!figure.svg.contains("NaN") && !figure.svg.contains("inf\""));
        // Four points a pixel column of 20 characters in three panels of 694 columns, and the Husid
        // curve: 250 kB.
        assert!(figure.svg.len() < 300_000, "{}", figure.svg.len());
    }
}

/// One motion, one height, one thickness, no history, nothing uplifts: still a report.
#[test]
fn the_smallest_study_has_a_report_too() {
    let mut study = fixture::study();
    study.objects.heights_m.truncate(1);
    study.objects.thicknesses_m = vec![0.6];
    study.objects.blocks = vec![freestand::block::Block::uniform(0.5, 0.6).unwrap()];
    study.levels.truncate(1);
    let mut result = fixture::result(&study);
    result.ground.truncate(1);
    result.history = None;
    result.doubts.clear();
    for level in &mut result.levels {
        level.floors.truncate(1);
        level.spectra.truncate(1);
        level.responses.truncate(1);
        level.statistics = vec![freestand_study::statistics::object_statistics(
            level.responses.iter().map(|row| &row[0]),
        )];
    }
    let figures = figures(&study, &result).unwrap();
    assert_eq!(figures.len(), 6);
    check(&report(&study, &result, &figures, &provenance(&study)));

    result.levels[0].statistics = vec![None];
    result.levels[0].responses = vec![vec![freestand_study::result::ObjectResponse::Failed(
        "no".into(),
    )]];
    let figures = crate::figures::figures(&study, &result).unwrap();
    check(&report(&study, &result, &figures, &provenance(&study)));
}

/// Four levels on two rows with ten thicknesses: no bands, two tables a level; a history that ends
/// on the floor.
#[test]
#[ignore = "seconds: a report of a large study"]
fn many_levels_and_thicknesses_and_a_fall_are_drawn() {
    let mut study = fixture::study();
    study.levels.insert(
        0,
        freestand_study::study::Level {
            name: "ground floor".into(),
            level_ratio: Some(0.0),
            motions: Vec::new(),
        },
    );
    study.levels.insert(
        1,
        freestand_study::study::Level {
            name: "quarter".into(),
            level_ratio: Some(0.25),
            motions: Vec::new(),
        },
    );
    study.objects.heights_m = vec![1.0, 1.25, 3.0];
    study.objects.thicknesses_m = (0..10).map(|i| 0.1 + 0.05 * f64::from(i)).collect();
    study.objects.blocks.clear();
    for &h in &study.objects.heights_m {
        for &t in &study.objects.thicknesses_m {
            study
                .objects
                .blocks
                .push(freestand::block::Block::uniform(h, t).unwrap());
        }
    }
    let mut result = fixture::result(&study);
    let history = result.history.as_mut().unwrap();
    history.outcome = freestand::rocking::Outcome::Overturned;
    let topples = |t: &f64| {
        if *t < 6.0 {
            0.0
        } else {
            ((t - 6.0) * 0.5).min(std::f64::consts::FRAC_PI_2)
        }
    };
    history.theta_rad = history.time_s.iter().map(topples).collect();
    history.impacts.clear();
    let figures = figures(&study, &result).unwrap();
    let urs = &figures[0].svg;
    assert!(urs.contains("quarter") && urs.contains("t = 550 mm") && !urs.contains("16–84"));
    let history = figures
        .iter()
        .find(|figure| figure.name == "history")
        .unwrap();
    assert!(history.svg.contains("overturns"));
    let html = report(&study, &result, &figures, &provenance(&study));
    check(&html);
    assert!(html.contains(">1.25<") && html.contains(">3.00<"));
}
