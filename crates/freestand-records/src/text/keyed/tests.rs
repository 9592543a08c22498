use super::*;
use crate::text::lines::lines;

fn read(text: &str) -> (Header, usize) {
    let mut rest = lines(text.as_bytes());
    let header = Header::read(&mut rest);
    (header, rest.line_number())
}

#[test]
fn a_key_ends_at_the_first_colon_and_the_header_before_the_numbers() {
    let (header, line) =
        read("\nTIME (ms) : 1:2:3\n\nfree words\nEMPTY:\n empty : 7 \n 1.5\n2.5\n");
    assert_eq!((header.entries.len(), line), (4, 6));
    assert_eq!(
        (
            header.text("time"),
            header.text("Empty"),
            header.text("none")
        ),
        ("1:2:3", "7", "")
    );
    assert_eq!(header.count("empty").unwrap(), Some((7, 6)));
    // A missing value in the first row must be refused as one, not skipped as a header.
    assert_eq!(read("A: 1\nNaN\n1\n").1, 1);
    assert_eq!(read("A: 1\n**** 1.0\n1\n").1, 1);
}

#[test]
fn steps_have_units_and_counts_are_whole() {
    let step_of = |text: &str, given_s: Option<f64>| {
        read(text)
            .0
            .step_s("dt", given_s)
            .map_err(|problem| problem.to_string())
    };
    let step = |text: &str| step_of(text, None);
    assert_eq!(step("DT (sec): 0.01"), Ok((0.01, 1)));
    assert_eq!(step("dt (ms): 5"), Ok((0.005, 1)));
    assert_eq!(step_of("dt (ms): 5", Some(0.02)), Ok((0.005, 1)));
    assert!(step("other: 5").unwrap_err().contains("no time step (dt)"));
    assert_eq!(step_of("other: 5", Some(0.02)), Ok((0.02, 1)));
    assert!(
        step("dt (min): 5")
            .unwrap_err()
            .contains("not a unit of time")
    );
    assert!(
        step("dt: O.01")
            .unwrap_err()
            .contains("a number is expected")
    );
    for text in ["n: 1.5", "n: -3", "n: 1e20", "n: NaN"] {
        assert!(read(text).0.count("n").is_err(), "{text}");
    }
}

#[test]
fn rows_are_counted_and_a_footer_is_noted() {
    let rows = |text: &str, declared: Option<usize>| {
        let mut notes = Vec::new();
        let declared = declared.map(|count| (count, 99));
        read_rows(&mut lines(text.as_bytes()), 2, declared, &mut notes)
            .map(|rows| (rows.columns, rows.first_line, notes.len()))
            .map_err(|problem| problem.to_string())
    };
    let expected = vec![vec![1.0, 3.0], vec![-2.0, 4.0]];
    assert_eq!(
        rows("\n1-2\n\n3 4\n\n", Some(2)),
        Ok((expected.clone(), 2, 0))
    );
    assert_eq!(rows("1 -2\n3 4", None), Ok((expected.clone(), 1, 0)));
    assert_eq!(rows("1 -2\n3 4\nthe end\n", Some(2)), Ok((expected, 1, 1)));
    for (text, declared, message) in [
        (
            "1 2\n3 4\nthe end\n",
            Some(3),
            "line 3: \"the\" is not a number",
        ),
        (
            "1 2\n3 4\n",
            Some(3),
            "line 99: the header declares 3 values, but the file has 2",
        ),
        (
            "1 2\n3 4\n",
            Some(1),
            "line 99: the header declares 1 values, but the file has 2",
        ),
        (
            "1 2\n3\n",
            Some(2),
            "line 2: a row must have 2 values, but this one has 1",
        ),
        (
            "1 2\n3 -999\n",
            Some(2),
            "line 2: \"-999\" marks a missing value",
        ),
        (
            "1 2\n3 NaN\n",
            Some(2),
            "line 2: \"NaN\" marks a missing value",
        ),
        ("\n", None, "line 1: no row of numbers follows the header"),
    ] {
        let found = rows(text, declared).expect_err(text);
        assert!(found.contains(message), "{found}");
    }
}
