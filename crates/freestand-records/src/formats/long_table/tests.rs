use super::*;
use crate::formats::{MotionFile, parse_motions};
use freestand_input::problem::Problems;

const ETABS: &str = "TABLE:  Joint Accelerations - Absolute\n\
    Story,Label,Unique Name,Output Case,Case Type,Step Type,Step Number,UX,UY,UZ,RX,RY,RZ\n\
    ,,,,,,,m/sec\u{b2},m/sec\u{b2},m/sec\u{b2},rad/sec\u{b2},rad/sec\u{b2},rad/sec\u{b2}\n\
    Story12,5,23,TH-1,LinModHist,Step By Step,1,0.1,0.2,0,0,0,0\n\
    Story12,5,23,TH-1,LinModHist,Step By Step,2,-0.5,1.2E-01,0,0,0,0\n\
    Story12,5,23,TH-1,LinModHist,Step By Step,3,0.3,0.1,0,0,0,0\n\
    Story3,5,7,TH-1,LinModHist,Step By Step,1,1,2,0,0,0,0\n\
    Story3,5,7,TH-1,LinModHist,Step By Step,2,3,4,0,0,0,0\n\
    Story3,5,7,TH-1,LinModHist,Step By Step,3,5,6,0,0,0,0\n";

fn parse(text: &str, dt_s: Option<f64>) -> Result<MotionFile, Problems> {
    let options = ReadOptions {
        dt_s,
        ..ReadOptions::default()
    };
    parse_motions(text.as_bytes().to_vec(), "table.csv".as_ref(), &options)
}

fn names(file: &MotionFile) -> Vec<&str> {
    file.components
        .iter()
        .map(|one| one.name.as_str())
        .collect()
}

#[test]
fn every_storey_and_direction_is_a_component() {
    let file = parse(ETABS, Some(0.02)).unwrap();
    assert_eq!(file.format, "ETABS/SAP2000 table");
    assert_eq!(
        names(&file),
        [
            "Story12 UX",
            "Story12 UY",
            "Story12 UZ",
            "Story3 UX",
            "Story3 UY",
            "Story3 UZ"
        ]
    );
    assert_eq!(file.components[0].motion.accel_m_s2(), [0.1, -0.5, 0.3]);
    assert_eq!(file.components[4].motion.accel_m_s2(), [2.0, 4.0, 6.0]);
    assert_eq!(
        (file.components[0].motion.dt_s(), file.notes.len()),
        (0.02, 0)
    );
    // Interleaved rows, as when the table is sorted by step.
    let mut rows: Vec<&str> = ETABS.lines().collect();
    rows[3..].sort_by_key(|row| row.split(',').nth(6).map(str::to_owned));
    let sorted = parse(&rows.join("\n"), Some(0.02)).unwrap();
    for (one, other) in sorted.components.iter().zip(&file.components) {
        assert_eq!((&one.name, &one.motion), (&other.name, &other.motion));
    }
}

#[test]
fn numbered_steps_need_a_time_step() {
    let problem = parse(ETABS, None).unwrap_err().problems.remove(0);
    assert!(
        problem.message.contains("numbers the steps") && problem.hint.unwrap().contains("`dt`")
    );
}

#[test]
fn times_give_the_step() {
    let timed = ETABS
        .replace("Step Number", "Time")
        .replace("Step By Step,1", "Step By Step,0.00");
    let timed = timed
        .replace("Step By Step,2", "Step By Step,0.01")
        .replace("Step By Step,3", "Step By Step,0.02");
    assert_eq!(
        parse(&timed, None).unwrap().components[0].motion.dt_s(),
        0.01
    );
    assert!(
        parse(&timed, Some(0.02)).unwrap_err().problems[0]
            .message
            .contains("according to the table")
    );
    let uneven = timed.replace(",0.02,0.3", ",0.05,0.3");
    assert!(parse(&uneven, None).is_err());
}

/// SAP2000: joints without storeys, semicolons and decimal commas, times in the column of the steps,
/// accelerations relative to the ground in inches.
#[test]
fn sap2000_in_another_dialect() {
    let text = "TABLE:  Joint Accelerations - Relative\n\
        Joint;OutputCase;CaseType;StepType;StepNum;U1;U2;U3\n\
        Text;Text;Text;Text;Unitless;in/sec2;in/sec2;in/sec2\n\
        23;EQ;LinModHist;Time;0,000;10;0;0\n\
        23;EQ;LinModHist;Time;0,005;-20,5;0;0\n\
        23;EQ;LinModHist;Time;0,010;5;0;0\n";
    let file = parse(text, None).unwrap();
    assert_eq!(names(&file), ["Joint 23 U1", "Joint 23 U2", "Joint 23 U3"]);
    assert_eq!(file.components[0].motion.dt_s(), 0.005);
    // 20.5 in/s² of 0.0254 m: one product and one division.
    assert!((file.components[0].motion.accel_m_s2()[1] + 0.5207).abs() < 1e-15);
    assert!(
        file.notes[0].to_string().contains("rocking needs absolute"),
        "{:?}",
        file.notes
    );
}

#[test]
fn several_joints_and_cases_are_named() {
    let text = ETABS.replace("Story3,5,7,TH-1", "Story12,9,7,TH-2");
    let file = parse(&text, Some(0.02)).unwrap();
    assert_eq!(
        (
            file.components[0].name.as_str(),
            file.components[3].name.as_str()
        ),
        ("Story12 5 TH-1 UX", "Story12 9 TH-2 UX")
    );
}

#[test]
fn what_is_not_a_history_is_refused() {
    let cases = [
        (
            ETABS.replace("Step By Step,1", "Max,1"),
            "largest and smallest values",
        ),
        (
            ETABS.replace("-0.5,1.2E-01", "-0.5,n/a"),
            "\"n/a\" in column 9 is not a number",
        ),
        (
            ETABS.lines().take(8).collect::<Vec<_>>().join("\n"),
            "joint Story3 5 has fewer steps than others",
        ),
        (
            ETABS.lines().take(3).collect::<Vec<_>>().join("\n"),
            "has no rows",
        ),
        (
            ETABS.replace("m/sec\u{b2},m/sec\u{b2},m/sec\u{b2}", ",,"),
            "is not stated",
        ),
    ];
    for (text, said) in cases {
        let problems = parse(&text, Some(0.02)).unwrap_err();
        assert!(
            problems.problems[0].message.contains(said),
            "{said}: {problems}"
        );
    }
}
