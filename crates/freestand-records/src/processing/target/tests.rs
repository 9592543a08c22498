use super::*;
use freestand_input::file::sha256_hex;

fn read(text: &str, source: &str) -> Result<TargetSpectrum, Problem> {
    parse_target(
        text.as_bytes().to_vec(),
        &super::super::parse_target_source(source)?,
    )
}

const TWO_DAMPINGS: &str =
    "period_s,psa_g,damping_ratio\n0.5,0.3,0.02\n1,0.2,0.02\n0.5,0.25,0.05\n1,0.15,0.05\n";

#[test]
fn the_damping_is_that_of_the_file_unless_it_has_several() {
    let of = |text: &str, source: &str| {
        read(text, source).map(|target| (target.damping_ratio, target.psa_m_s2.len()))
    };
    let one = TWO_DAMPINGS.lines().take(3).collect::<Vec<_>>().join("\n");
    assert_eq!(of(&one, "t.csv"), Ok((0.02, 2)));
    assert_eq!(of(&one, "t.csv, 2 %"), Ok((0.02, 2)));
    assert_eq!(of(TWO_DAMPINGS, "t.csv"), Ok((0.05, 2)));
    let note = |source: &str| read(TWO_DAMPINGS, source).unwrap().note;
    let left_out = "t.csv has spectra for several dampings: that for 5 % is the target, those for 2 % are left out";
    assert!(note("t.csv").is_some_and(|note| note.to_string().starts_with(left_out)));
    assert_eq!(
        (note("t.csv, 5 %"), read(&one, "t.csv").unwrap().note),
        (None, None)
    );
    let chosen = read(TWO_DAMPINGS, "t.csv, 2 %").unwrap();
    assert_eq!(
        chosen.psa_m_s2,
        [0.3 * freestand::G0_M_S2, 0.2 * freestand::G0_M_S2]
    );
    assert_eq!(of("T [s],Sa [g]\n1,0.2\n", "t.csv"), Ok((0.05, 1)));
    assert_eq!(of("T [s],Sa [g]\n1,0.2\n", "t.csv, 10 %"), Ok((0.1, 1)));
    let other = read(TWO_DAMPINGS, "t.csv, 3 %").unwrap_err();
    assert_eq!(
        other.to_string(),
        "t.csv: the spectrum has no values for 3 % damping"
    );
    assert!(other.hint.is_some_and(|hint| hint.ends_with("2 %, 5 %")));
    let percent = read("T [s],Sa [g],damping\n1,0.2,5\n", "t.csv").unwrap_err();
    assert_eq!(percent.to_string(), "t.csv:2: 5 is not a damping ratio");
}

#[test]
fn a_range_keeps_its_ends() {
    let text = "T [s],Sa [g]\n0,0.1\n0.1,0.2\n0.30000000000000004,0.3\n2,0.1\n";
    let periods = |source: &str| read(text, source).map(|target| target.periods_s);
    assert_eq!(periods("t.csv, 0 s to 0.1 s"), Ok(vec![0.0, 0.1]));
    assert_eq!(
        periods("t.csv, 100 ms to 0.3 s, 5 %"),
        Ok(vec![0.1, 0.30000000000000004])
    );
    let none = periods("t.csv, 0.5 s to 1 s").unwrap_err();
    assert_eq!(
        none.to_string(),
        "t.csv: the spectrum has no period from 0.5 s to 1 s"
    );
    assert_eq!(
        none.hint.as_deref(),
        Some("choose a range within its periods, 0 s to 2 s")
    );
}

#[test]
fn values_that_no_spectrum_has_are_refused_with_their_line() {
    for (rows, says) in [
        ("1,0.2\n-0.1,0.3\n", "t.csv:3: a period must be 0 s or more"),
        (
            "1,0.2\n2,0\n",
            "t.csv:3: the acceleration of a target must be above 0",
        ),
        (
            "1,0.2\n2,-999\n",
            "t.csv:3: the acceleration of a target must be above 0",
        ),
        (
            "1,0.2\n\n2,0.1\n1,0.3\n",
            "t.csv:5: the period 1 s is listed twice",
        ),
        ("0,0.2\n-0,0.1\n", "t.csv:3: the period"),
    ] {
        let problem = read(&format!("T [s],Sa [g]\n{rows}"), "t.csv").expect_err(rows);
        assert!(
            problem.to_string().starts_with(says) && problem.hint.is_some(),
            "{problem:?}"
        );
    }
    let missing = read_target(&TargetSource {
        path: "no/such.csv".into(),
        range_s: None,
        damping_ratio: None,
    });
    assert!(
        missing
            .unwrap_err()
            .to_string()
            .starts_with("no/such.csv: cannot open the file")
    );
}

#[test]
fn a_target_has_words() {
    assert!(
        read(TWO_DAMPINGS, "a/t.csv")
            .unwrap()
            .words()
            .starts_with("t.csv (2 periods from 0.5 s to 1 s, 5 % damping")
    );
    let one = read("T [s],Sa [g]\n1,0.2\n", "t.csv").unwrap();
    assert_eq!(one.words(), "t.csv (1 period of 1 s, 5 % damping");
    let file = one.file.unwrap();
    assert_eq!(
        (file.path, file.sha256),
        ("t.csv".into(), sha256_hex(b"T [s],Sa [g]\n1,0.2\n"))
    );
}
