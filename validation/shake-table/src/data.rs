//! The tests: the measured acceleration of the table, and which rock fell.

use std::path::Path;

use freestand::G0_M_S2;
use freestand::motion::Motion;
use freestand_input::problem::Problem;

/// The sampling of the table \[s\].
const DT_S: f64 = 0.005;

/// A test.
pub(crate) struct Test {
    /// The earthquake motion, which other tests have at other scales.
    pub(crate) motion: String,
    /// The acceleration of the table.
    pub(crate) table: Motion,
    /// Whether each rock overturned.
    pub(crate) fell: [bool; 2],
}

/// All tests of a folder, in the order of `tests.csv`.
pub(crate) fn tests(folder: &Path) -> Result<Vec<Test>, Problem> {
    let path = folder.join("tests.csv");
    let text = read(&path)?;
    let bad = |line: &str| {
        let message = format!("this line is no test: {line}");
        Problem::format(
            message,
            "the columns are test,motion,pga_g,samples,rock1_overturned,rock2_overturned",
        )
        .in_file(&path)
    };
    text.lines()
        .skip(1)
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            let [number, motion, _, _, first, second] = cells[..] else {
                return Err(bad(line));
            };
            let number: u32 = number.parse().map_err(|_| bad(line))?;
            let file = folder.join(format!("motions/test{number:03}.csv"));
            Ok(Test {
                motion: motion.to_owned(),
                table: table(&file)?,
                fell: [first == "1", second == "1"],
            })
        })
        .collect()
}

/// The names of the motions, once each.
pub(crate) fn motions(tests: &[Test]) -> Vec<&str> {
    let mut names: Vec<&str> = tests.iter().map(|test| test.motion.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    names
}

fn table(path: &Path) -> Result<Motion, Problem> {
    let text = read(path)?;
    let values: Result<Vec<f64>, _> = text.lines().skip(1).map(str::parse::<f64>).collect();
    let bad = |error: &dyn std::fmt::Display| {
        Problem::format(
            format!("this is no motion: {error}"),
            "it has one acceleration [g] on each line",
        )
        .in_file(path)
    };
    let values = values.map_err(|error| bad(&error))?;
    Motion::new(DT_S, values.into_iter().map(|g| G0_M_S2 * g).collect())
        .map_err(|error| bad(&error))
}

fn read(path: &Path) -> Result<String, Problem> {
    std::fs::read_to_string(path).map_err(|error| {
        Problem::format(format!("it cannot be read: {error}"), "give --data DIR").in_file(path)
    })
}
