use crate::formats::{Component, ReadOptions, Start, parse_motions};
use crate::processing::tests::three;
use crate::processing::{Processed, Processing, process_pair};
use freestand::motion::Motion;
use freestand_input::problem::Problem;

fn pair(first: &Component, second: &Component) -> Result<(Processed, Processed), Problem> {
    process_pair(
        (first, second),
        (&first.name, &second.name),
        &Processing::default(),
    )
}

/// Two channels of one instrument that begin 0.05 s apart: the same times belong together, whatever
/// their numbers.
#[test]
fn components_are_brought_to_the_times_that_both_have() {
    let whole = three();
    let mut file = three();
    let late = file.components[1].motion.accel_m_s2()[5..].to_vec();
    file.components[1].motion = Motion::new(0.01, late).unwrap();
    file.components[1].start = file.components[1]
        .start
        .map(|start| Start::Date(start.seconds() + 0.05));
    let (one, two) = pair(&file.components[0], &file.components[1]).unwrap();
    assert_eq!(
        one.motion.accel_m_s2(),
        &whole.components[0].motion.accel_m_s2()[5..]
    );
    assert_eq!(
        two.motion.accel_m_s2(),
        &whole.components[1].motion.accel_m_s2()[5..]
    );
    assert_eq!(
        one.notes,
        ["first 5 samples of N-S left out: the other component begins later"]
    );
    let (two, one) = pair(&file.components[1], &file.components[0]).unwrap();
    assert_eq!(
        (one.motion.accel_m_s2().len(), two.motion.accel_m_s2().len()),
        (796, 796)
    );
    file.components[1].start = Some(Start::Date(1e9));
    let problem = pair(&file.components[0], &file.components[1]).unwrap_err();
    assert!(problem.message.contains("no time in common"), "{problem}");
    // A third of a sample is left, and said; without a time on both sides the first samples belong
    // together.
    file.components[1].start = Some(Start::Date(0.0533));
    let (one, _) = pair(&file.components[0], &file.components[1]).unwrap();
    assert_eq!(
        one.notes[0],
        "components N-S and E-W are 0.33 of a sample apart"
    );
    file.components[1].start = None;
    let (one, _) = pair(&file.components[0], &file.components[1]).unwrap();
    assert_eq!(
        one.notes,
        ["last 5 samples of N-S left out: the other component ends earlier"]
    );
}

/// Times of 128 samples a second in four decimals: the step of 1000 rows is not that of 900.
#[test]
fn steps_of_rounded_times_are_one() {
    let recorded = |name: &str, rows: u32, dt_s: f64| {
        let pace = 1e-4 * f64::from(rows);
        let line = |k: u32| {
            format!(
                "{:.4},{}\n",
                f64::from(k) * dt_s,
                (f64::from(k) * pace).sin()
            )
        };
        let text: String = (0..rows).map(line).collect();
        let path = format!("{name}.csv");
        let text = format!("time [s],{name} [g]\n{text}").into_bytes();
        parse_motions(text, path.as_ref(), &ReadOptions::default())
            .unwrap()
            .components
            .remove(0)
    };
    let (long, short) = (
        recorded("a", 1000, 1.0 / 128.0),
        recorded("b", 900, 1.0 / 128.0),
    );
    assert_ne!(long.motion.dt_s(), short.motion.dt_s());
    let (one, two) = pair(&long, &short).unwrap();
    assert_eq!(
        (one.motion.dt_s(), two.motion.dt_s()),
        (long.motion.dt_s(), long.motion.dt_s())
    );
    assert_eq!(
        one.notes,
        ["last 100 samples of a left out: the other component ends earlier"]
    );
    assert!(
        two.notes[0]
            .to_string()
            .starts_with("time step of b taken as 0.0078125"),
        "{:?}",
        two.notes
    );
    assert!(
        two.notes[0]
            .to_string()
            .contains(", that of a, in place of 0.007812"),
        "{:?}",
        two.notes
    );
    assert!(one.steps == one.notes && two.steps == two.notes);
    // 900 samples with a step that is longer by 1/18000 are 0.05 of a sample apart at the last,
    // nearly.
    let stretched = |ratio: f64| {
        let mut other = short.clone();
        other.motion = Motion::new(
            long.motion.dt_s() * (1.0 + ratio),
            short.motion.accel_m_s2().to_vec(),
        )
        .unwrap();
        let (one, two) = pair(&long, &other).unwrap();
        one.motion.dt_s() == two.motion.dt_s()
    };
    assert!(stretched(0.049 / 899.0) && stretched(-0.049 / 899.0));
    assert!(!stretched(0.051 / 899.0) && !stretched(-0.051 / 899.0));
}

#[test]
fn a_copy_of_a_component_is_noticed() {
    let file = three();
    let (one, two) = pair(&file.components[0], &file.components[0]).unwrap();
    assert_eq!(one.notes, ["components N-S and N-S are identical"]);
    assert!(two.notes.is_empty());
}

/// A note about both is written once; each has its own steps.
#[test]
fn each_component_has_its_own_steps() {
    let mut file = three();
    for component in &mut file.components {
        component.is_raw = true;
    }
    file.components[1].start = file.components[0]
        .start
        .map(|start| Start::Date(start.seconds() + 0.0033));
    let (one, two) = pair(&file.components[0], &file.components[1]).unwrap();
    let apart = "components N-S and E-W are 0.33 of a sample apart";
    for (done, own) in [
        (&one, "removed from N-S (raw record)"),
        (&two, "removed from E-W (raw record)"),
    ] {
        assert!(
            done.steps == done.notes && done.steps.last().unwrap().ends_with(own),
            "{:?}",
            done.steps
        );
    }
    assert_eq!(
        (
            one.notes.len(),
            two.notes.len(),
            one.notes[0].to_string().as_str()
        ),
        (2, 1, apart)
    );
}
