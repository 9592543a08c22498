use std::fs;

use freestand_input::problem::Problems;

use super::*;

#[test]
fn the_builtin_libraries_are_read_whole() {
    let text = include_str!("tolerance.csv");
    assert_eq!(
        ToleranceLibrary::builtin().entries().len(),
        text.lines().count() - 1
    );
    let text = include_str!("cushions.csv");
    assert_eq!(
        CushionLibrary::builtin().entries().len(),
        text.lines().count() - 1
    );
}

/// An entry without a source, or without page and clause, is recalled and decides nothing; nor does
/// a fragility.
#[test]
fn nothing_without_a_page_decides() {
    for entry in ToleranceLibrary::builtin().entries() {
        let is_located = !entry.page.is_empty() || !entry.clause.is_empty();
        let is_found = is_located && !entry.source.is_empty();
        assert!(
            is_found || entry.confidence == Confidence::Recalled,
            "{}",
            entry.id
        );
        assert_eq!(
            entry.decides,
            entry.confidence.decides() && entry.kind != Kind::Fragility,
            "{}",
            entry.id
        );
        if let Some(tolerance) = to_tolerance(entry) {
            assert_eq!(
                tolerance.confidence.decides(),
                entry.decides,
                "{}",
                entry.id
            );
            assert!(
                tolerance.source.starts_with(&entry.id)
                    && tolerance.source.contains(entry.confidence.name())
            );
        }
    }
    let deciding = ToleranceLibrary::builtin()
        .entries()
        .iter()
        .filter(|entry| entry.decides)
        .count();
    assert_eq!(
        deciding, 6,
        "two placeholders, a card twice, a drive, a limit of pseudo-velocity"
    );
    assert!(
        CushionLibrary::builtin()
            .entries()
            .iter()
            .all(|entry| !entry.confidence.decides())
    );
}

/// IEC 60068-2-27's severities with 2AT/π to two decimals, computed apart; half a unit of the last.
#[test]
fn severities_have_their_velocity_changes() {
    let library = ToleranceLibrary::builtin();
    for (id, velocity_m_s) in [
        ("5g-30ms", 0.94),
        ("15g-11ms", 1.03),
        ("30g-18ms", 3.37),
        ("30g-11ms", 2.06),
        ("30g-6ms", 1.12),
        ("50g-11ms", 3.43),
        ("50g-3ms", 0.94),
        ("100g-11ms", 6.87),
        ("200g-3ms", 3.75),
        ("500g-1ms", 3.12),
        ("1500g-0p5ms", 4.68),
        ("3000g-0p2ms", 3.75),
    ] {
        let entry = library.find(&format!("IEC-60068-2-27-{id}")).unwrap();
        let got = entry.pulse_velocity_change_m_s.unwrap();
        assert!((got - velocity_m_s).abs() < 5.1e-3, "{id}: {got}");
        assert_eq!(
            to_tolerance(entry).unwrap().velocity_change_m_s,
            None,
            "the velocity change of the pulse is not a critical one"
        );
    }
}

/// Medians and spreads of FEMA P-58, and P at 0.4 m/s and 0.5 g by hand.
#[test]
fn fragilities_are_those_of_p_58() {
    let library = ToleranceLibrary::builtin();
    let shelf = library.find("p58-bookcase-5-shelves").unwrap();
    assert_eq!(
        (shelf.pfv_median_m_s, shelf.beta, to_tolerance(shelf)),
        (Some(0.29), Some(0.5), None)
    );
    assert!(
        shelf.notice.contains("Leland Stanford Junior University")
            && shelf.licence == "BSD-3-Clause"
    );
    let mcc = library.find("p58-motor-control-centre").unwrap();
    let p = freestand::fragility::lognormal_probability(
        0.5,
        mcc.pfa_median_g.unwrap(),
        mcc.beta.unwrap(),
    );
    assert!((p - 0.20018).abs() < 5.1e-6);
    assert!(
        library
            .entries()
            .iter()
            .filter(|e| e.licence == "BSD-3-Clause")
            .all(|e| e.notice.contains("AS IS"))
    );
}

#[test]
fn a_range_gives_its_low_end_and_a_sawtooth_nothing() {
    let library = ToleranceLibrary::builtin();
    let disk = to_tolerance(library.find("hdd-35-operating").unwrap()).unwrap();
    assert!((disk.peak_m_s2.unwrap() - 490.3325).abs() < 1e-9 && disk.duration_s == Some(0.002));
    assert!(!disk.confidence.decides());
    assert_eq!(
        to_tolerance(library.find("mil-std-810h-functional").unwrap()),
        None
    );
    let class = to_tolerance(library.find("iec-60721-3-3-3m4").unwrap()).unwrap();
    assert_eq!(
        class.peak_m_s2,
        Some(100.0),
        "a cell with a unit of its own"
    );
    let lift = to_tolerance(library.find("gr-63-handling-25-50kg").unwrap()).unwrap();
    assert_eq!((lift.edge_lift_m, lift.peak_m_s2), (Some(0.05), None));
}

/// E₀A/t and E₀(1 + 2kS²)A/t of a pad of 78 × 78 × 20 mm, S = 0.975, by hand: 669 and 1598, 1354
/// and 2821, 2233 and 4483 N/mm.
#[test]
fn pads_follow_gent_and_lindley() {
    let library = CushionLibrary::builtin();
    for (irhd, free, glued) in [
        (50, 669.0, 1598.0),
        (60, 1354.0, 2821.0),
        (70, 2233.0, 4483.0),
    ] {
        let pad = library.find(&format!("pad-78x78x20-{irhd}-irhd")).unwrap();
        // The ends are written in whole N/mm.
        assert!(
            (pad.stiffness_low_n_m / 1e3 - 1.2 * free).abs() < 1.2,
            "{irhd}"
        );
        assert!(
            (pad.stiffness_high_n_m / 1e3 - 2.0 * glued).abs() < 1.5,
            "{irhd}"
        );
    }
    let paper = library.find("pad-78x78x20-50-irhd").unwrap();
    assert!(
        paper.stiffness_low_n_m < 2.19e6 && paper.stiffness_high_n_m > 2.19e6,
        "the pad of the paper is in its range"
    );
}

/// √(50·500) = 158.114 in series with √(300·3000) = 948.683 N/mm: 135.527 each, two to an edge. The
/// carpet has 0.857 of the compression: ln k scatters by 1.1513 √(0.857² + 0.143²) = 1.0004.
#[test]
fn layers_act_in_series() {
    let prior = CushionLibrary::builtin()
        .prior("rubber-foot + Carpet-underlay")
        .unwrap();
    let edge = freestand_study::cushion::resolve(&prior.words, None)
        .unwrap()
        .cushion
        .linear_stiffness_n_m()
        .unwrap();
    assert!((edge / 1e3 - 2.0 * 135.527).abs() < 2e-3, "{edge}");
    assert!((prior.log_sd - 1.0004).abs() < 5e-5, "{}", prior.log_sd);
    assert!(prior.source.contains("an estimate") && prior.source.contains("carpet-underlay"));
    let problem = CushionLibrary::builtin().prior("rubber-feet").unwrap_err();
    assert!(problem.hint.unwrap().contains("rubber-foot"));
}

fn user(text: &str) -> Result<ToleranceLibrary, Problems> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.csv");
    fs::write(&path, text).unwrap();
    ToleranceLibrary::builtin().with_file(Some(&path))
}

#[test]
fn a_users_library_adds_and_overrides() {
    let text = "\u{feff}# ours\nID,class,kind,state,Peak (m/s2),duration [s],source,page,confidence,colour\n\
        hdd-35-operating,our disks,vendor-limit,operating,650,0.002,data sheet 7,3,stated,red\n\
        ct-scanner,scanner,vendor-limit,operating,2 g,0.011,manual,12,stated,\n\n";
    let library = user(text).unwrap();
    assert_eq!(
        library.entries().len(),
        ToleranceLibrary::builtin().entries().len() + 1
    );
    let disk = library.find("hdd-35-operating").unwrap();
    assert_eq!(
        (disk.peak_m_s2, disk.decides, disk.confidence),
        (Some(650.0), true, Confidence::Stated)
    );
    assert!(disk.origin.ends_with("mine.csv") && library.inputs.len() == 1);
    assert!((library.find("CT-scanner").unwrap().peak_g.unwrap() - 2.0).abs() < 1e-12);
    assert!(
        library.warnings[0].contains("\"colour\" does not belong to a library"),
        "{:?}",
        library.warnings
    );
}

/// All problems at once, each with its line and column.
#[test]
fn all_problems_are_reported() {
    let text = "id,class,kind,state,peak [g],duration [ms],pfa_median [g],beta,source,page,confidence\n\
        a b,x,vendor-limit,operating,5,11,,,s,1,stated\n\
        c,x,limit,running,-5,11,,,s,1,stated\n\
        d,x,vendor-limit,operating,,11,,,s,1,stated\n\
        e,x,fragility,any,5,,0.4,,s,1,stated\n\
        f,x,vendor-limit,operating,5,eleven,,,s,,stated\n\
        g,,vendor-limit,operating,5,11,,,s,1,sure\n\
        h,x,vendor-limit,operating,5,11,,,s,1,stated\n\
        h,x,vendor-limit,operating,5,11,,,s,1,stated\n\
        i,x,fragility,any,,,0.4,40,s,1,stated\n";
    let error = user(text).unwrap_err();
    let said = |line: usize, column: &str| {
        error
            .problems
            .iter()
            .any(|p| p.line == Some(line) && p.message.starts_with(&format!("column {column}:")))
    };
    for (line, column) in [
        (2, "id"),
        (3, "kind"),
        (3, "state"),
        (3, "peak"),
        (4, "peak"),
        (4, "duration"),
        (5, "kind"),
        (6, "duration"),
        (6, "confidence"),
        (7, "class"),
        (7, "confidence"),
        (9, "id"),
        (10, "beta"),
    ] {
        assert!(said(line, column), "line {line}, column {column}: {error}");
    }
    assert!(
        error
            .problems
            .iter()
            .all(|problem| problem.hint.is_some() && problem.path.is_some())
    );
}

#[test]
fn what_is_not_a_library_is_refused() {
    let message = |text: &str| user(text).unwrap_err().problems[0].to_string();
    assert!(message("").contains("has no header"));
    assert!(message("id,class\n").contains("column kind is missing"));
    let header = "id,class,kind,state,peak,source,confidence\n";
    assert!(message(header).contains("column peak has no unit"));
    assert!(message(&header.replace("peak", "peak [mm]")).contains("column peak"));
    assert!(message(&header.replace("peak", "peak [g],peak [g]")).contains("twice"));
    let short = format!("{}a,b\n", header.replace("peak", "peak [g]"));
    assert!(
        message(&short).contains("this row has 2 cells, but the header has 7"),
        "{}",
        message(&short)
    );
    let folder = tempfile::tempdir().unwrap();
    assert!(
        ToleranceLibrary::builtin()
            .with_file(Some(folder.path()))
            .is_err()
    );
    assert!(
        ToleranceLibrary::builtin()
            .with_file(Some(&folder.path().join("no.csv")))
            .is_err()
    );
    let latin = folder.path().join("latin.csv");
    fs::write(&latin, b"id,cl\xe4ss\n").unwrap();
    assert!(
        ToleranceLibrary::builtin()
            .with_file(Some(&latin))
            .unwrap_err()
            .to_string()
            .contains("UTF-8")
    );
    let wide = user(&"id,".repeat(1000)).unwrap_err();
    assert!(wide.to_string().contains("columns"), "{wide}");
    let slips = format!(
        "{}{}",
        header.replace("peak", "peak [g]"),
        "a,,b,c,-1,s,sure\n".repeat(9000)
    );
    assert!(user(&slips).unwrap_err().problems.len() < 210);
    let rows = "a,x,vendor-limit,any,1,s,recalled\n".repeat(10_001);
    assert!(message(&format!("{}{rows}", header.replace("peak", "peak [g]"))).contains("10000"));
}

#[test]
fn entries_are_found_by_words_and_by_slips() {
    let library = ToleranceLibrary::builtin();
    let words = |text: &str| text.split(' ').map(str::to_owned).collect::<Vec<_>>();
    let found = library.search(&words("Bookcase p-58"));
    assert_eq!(found.len(), 5);
    assert!(
        library
            .search(&words("disk operating nearline"))
            .iter()
            .any(|e| e.id == "hdd-35-operating")
    );
    assert!(library.search(&words("no such thing")).is_empty());
    assert_eq!(library.nearest("hdd-35-operatin")[0], "hdd-35-operating");
    let problem = library.get("bookcase").unwrap_err();
    assert!(problem.hint.unwrap().contains("p58-bookcase-2-shelves"));
    assert!(
        library
            .get("zzz")
            .unwrap_err()
            .hint
            .unwrap()
            .starts_with("freestand tolerance list")
    );
}

/// As much of JSON Schema as the two schemas use: type, enum, const, required, exclusiveMinimum,
/// additionalProperties.
fn conforms(value: &serde_json::Value, schema: &serde_json::Value) -> Result<(), String> {
    let properties = schema["properties"].as_object().ok_or("no properties")?;
    let object = value.as_object().ok_or("no object")?;
    for name in schema["required"]
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(|name| name.as_str())
    {
        object
            .get(name)
            .ok_or_else(|| format!("{name} is missing"))?;
    }
    for (name, value) in object {
        let rule = properties
            .get(name)
            .ok_or_else(|| format!("{name} is not in the schema"))?;
        let types: Vec<&str> = match &rule["type"] {
            serde_json::Value::String(one) => vec![one],
            many => many
                .as_array()
                .into_iter()
                .flatten()
                .filter_map(|one| one.as_str())
                .collect(),
        };
        let own = match value {
            serde_json::Value::Null => "null",
            serde_json::Value::Bool(_) => "boolean",
            serde_json::Value::Number(number) if number.is_u64() && types.contains(&"integer") => {
                "integer"
            }
            serde_json::Value::Number(_) => "number",
            serde_json::Value::String(_) => "string",
            _ => "other",
        };
        if !types.contains(&own) {
            return Err(format!("{name}: {own} is not one of {types:?}"));
        }
        if rule["enum"]
            .as_array()
            .is_some_and(|names| !names.contains(value))
        {
            return Err(format!("{name}: {value} is not in the list"));
        }
        if let (Some(least), Some(number)) = (rule["exclusiveMinimum"].as_f64(), value.as_f64())
            && number <= least
        {
            return Err(format!("{name}: {number} is too small"));
        }
    }
    Ok(())
}

/// Every entry conforms to its schema, which has exactly the keys of an entry and refuses wrong
/// ones.
#[test]
fn entries_follow_their_schemas() {
    let schema = |text: &str| serde_json::from_str::<serde_json::Value>(text).unwrap();
    let tolerance = schema(include_str!("tolerance.schema.json"));
    let cushion = schema(include_str!("cushions.schema.json"));
    let entries = |library: &[ToleranceEntry]| {
        library
            .iter()
            .map(|e| serde_json::to_value(e).unwrap())
            .collect()
    };
    let tolerances: Vec<serde_json::Value> = entries(ToleranceLibrary::builtin().entries());
    let library = CushionLibrary::builtin();
    let cushions: Vec<_> = library
        .entries()
        .iter()
        .map(|e| serde_json::to_value(e).unwrap())
        .collect();
    for (entries, schema) in [(&tolerances, &tolerance), (&cushions, &cushion)] {
        for entry in entries {
            conforms(entry, schema).unwrap_or_else(|error| panic!("{}: {error}", entry["id"]));
        }
        let declared: Vec<&String> = schema["properties"].as_object().unwrap().keys().collect();
        let written: Vec<&String> = entries[0].as_object().unwrap().keys().collect();
        assert_eq!(declared, written, "in the same order");
        assert_eq!(schema["required"].as_array().unwrap().len(), declared.len());
        assert_eq!(schema["additionalProperties"], false);
    }
    let mut wrong = tolerances[0].clone();
    wrong["kind"] = "guess".into();
    assert!(
        conforms(&wrong, &tolerance)
            .unwrap_err()
            .starts_with("kind")
    );
    wrong["kind"] = "class".into();
    wrong["peak_m_s2"] = 0.0.into();
    assert!(
        conforms(&wrong, &tolerance)
            .unwrap_err()
            .starts_with("peak_m_s2")
    );
}
