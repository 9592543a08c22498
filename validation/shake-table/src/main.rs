//! Two granite rocks on a shake table: what each model says of every test, and what happened.
//!
//! `cargo xtask shake-table [--data DIR]` runs it. Nothing is fitted to the tests but the model that says so,
//! and it says of each motion what the others have taught. What the body in space was given was
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
use scores::{Scores, clustered_interval, mean, squares};

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
        "model,rock,tests,right_ratio,false_alarms,misses,brier,brier_low,brier_high,less_than_pgv,less_low,less_high,mean_probability,shifted,unresolved\n",
    );
    println!(
        "| model | rock 1 right (false alarms, misses) | Brier | rock 2 right | Brier |\n|---|---|---|---|---|"
    );
    let mut ensembles = Vec::new();
    // Of each rock, the squares of the errors of the curve that knows the peak velocity alone.
    let mut by_pgv: [Vec<f64>; 2] = [Vec::new(), Vec::new()];
    for model in Model::ALL {
        let mut line = format!("| {}", model.words());
        for (at, rock) in rocks.iter().enumerate() {
            let fell: Vec<bool> = tests.iter().map(|test| test.fell[at]).collect();
            let said = model.says(rock, &tests, &fell)?;
            let scores = Scores::of(&said.probabilities, &fell);
            let squares = squares(&said.probabilities, &fell);
            if model == Model::Logistic {
                by_pgv[at] = squares.clone();
            }
            let less: Vec<f64> = by_pgv[at]
                .iter()
                .zip(&squares)
                .map(|(a, b)| a - b)
                .collect();
            let of_less = match less.is_empty() {
                true => ",,".to_owned(),
                false => {
                    let (low, high) = clustered_interval(&tests, &less);
                    format!("{:.4},{low:.4},{high:.4}", mean(&less))
                }
            };
            let (brier, interval) = (mean(&squares), clustered_interval(&tests, &squares));
            line.push_str(&format!(
                " | {:.1} % ({}, {}) | {brier:.4}",
                100.0 * scores.right_ratio,
                scores.false_alarms,
                scores.misses,
            ));
            table.push_str(&format!(
                "{},{},{},{:.4},{},{},{brier:.4},{:.4},{:.4},{of_less},{:.4},{},{}\n",
                model.name(),
                at + 1,
                tests.len(),
                scores.right_ratio,
                scores.false_alarms,
                scores.misses,
                interval.0,
                interval.1,
                mean(&said.probabilities),
                said.shifted,
                said.unresolved,
            ));
            if model == Model::HullPrior {
                ensembles.push((said.probabilities, fell));
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
