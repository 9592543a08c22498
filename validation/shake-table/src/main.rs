//! Two granite rocks on a shake table: what each model says of every test, and what happened.
//!
//! `cargo xtask shake-table [--data DIR]` runs it. Nothing is fitted to the tests but the two models that
//! say so, and those say of each motion what the others have taught. What the body in space was given was
//! fixed before it was run: see [`models::PRIOR`].

#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a tool for the terminal"
)]

mod data;
mod figure;
mod models;
mod scores;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use freestand_input::problem::Problem;
use freestand_input::words::number;

use data::tests;
use models::{Model, Rock};
use scores::{Scores, brier, clustered_interval};

fn main() -> ExitCode {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let (Some(data), Some(out)) = (arguments.next(), arguments.next()) else {
        eprintln!("usage: freestand-shake-table DATA OUT");
        return ExitCode::from(2);
    };
    match compare(&data, &out) {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("{problem}");
            ExitCode::FAILURE
        }
    }
}

fn compare(data: &Path, out: &Path) -> Result<(), Problem> {
    let tests = tests(data)?;
    let rocks = [1, 2].map(|number| Rock::read(data, number));
    let [first, second] = rocks;
    let rocks = [first?, second?];
    for rock in &rocks {
        println!("{}", rock.words());
    }
    let motions = data::motions(&tests).len();
    println!("{} tests under {motions} motions\n", tests.len());
    let mut table = String::from(
        "model,rock,tests,right_ratio,false_alarms,misses,brier,brier_low,brier_high,mean_probability\n",
    );
    println!(
        "| model | rock 1 right (false alarms, misses) | Brier | rock 2 right | Brier |\n|---|---|---|---|---|"
    );
    let mut ensembles = Vec::new();
    for model in Model::ALL {
        let mut line = format!("| {}", model.words());
        for (at, rock) in rocks.iter().enumerate() {
            let fell: Vec<bool> = tests.iter().map(|test| test.fell[at]).collect();
            let said = model.probabilities(rock, &tests, &fell);
            let scores = Scores::of(&said, &fell);
            let brier = brier(&said, &fell);
            let interval = clustered_interval(&tests, &said, &fell);
            line.push_str(&format!(
                " | {:.1} % ({}, {}) | {:.4}",
                100.0 * scores.right_ratio,
                scores.false_alarms,
                scores.misses,
                brier
            ));
            let mean = said.iter().sum::<f64>() / said.len() as f64;
            table.push_str(&format!(
                "{},{},{},{:.4},{},{},{:.4},{:.4},{:.4},{:.4}\n",
                model.name(),
                at + 1,
                tests.len(),
                scores.right_ratio,
                scores.false_alarms,
                scores.misses,
                brier,
                interval.0,
                interval.1,
                mean
            ));
            if model == Model::HullPrior {
                ensembles.push((said, fell));
            }
        }
        println!("{line} |");
    }
    let share =
        |at: usize| tests.iter().filter(|test| test.fell[at]).count() as f64 / tests.len() as f64;
    println!(
        "\noverturned: {} and {}",
        number(share(0), 3),
        number(share(1), 3)
    );
    let agree = tests
        .iter()
        .filter(|test| test.fell[0] == test.fell[1])
        .count();
    println!("the rocks agree in {} of {}", agree, tests.len());
    let reliability = scores::reliability(&ensembles);
    std::fs::create_dir_all(out)
        .and_then(|()| std::fs::write(out.join("scores.csv"), table))
        .and_then(|()| {
            std::fs::write(
                out.join("reliability.csv"),
                scores::reliability_csv(&reliability),
            )
        })
        .map_err(|error| {
            Problem::format(error.to_string(), "choose another folder").in_file(out)
        })?;
    let picture = figure::reliability(&reliability)
        .map_err(|error| Problem::format(error.to_string(), "report this"))?;
    let svg = out.join("reliability.svg");
    std::fs::write(&svg, picture.svg)
        .map_err(|error| Problem::format(error.to_string(), "choose another folder").in_file(&svg))
}
