//! The commands as they are called: exit status, standard output and standard error in snapshots.
//!
//! One program, so that it is linked once and its tests fill the processor to the end; one module for each
//! subject. `tests/readme.rs` is a program of its own: its commands run in the folder of the repository.
//!
//! After an intended change: `INSTA_UPDATE=always cargo test -p freestand-cli`, and read the difference.

#![expect(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test may stop at what it cannot set up"
)]

mod bodies;
mod bodies_in_lists;
mod cases;
mod code_spectra;
mod compliant;
mod cushion;
mod directions;
mod examples;
mod floor;
mod folders;
mod fragility_runs;
mod fragility_runs_kept;
mod ground_sources;
mod idle;
mod inventory;
mod library;
mod line_ends;
mod motions;
mod object;
mod processing;
mod program;
mod rates;
mod records;
#[cfg(feature = "page")]
mod requests;
mod restrain;
mod risk;
mod risk_exports;
mod risk_money;
mod rocking_cases;
mod run;
mod same_answer;
#[cfg(feature = "page")]
mod serve;
mod serve_options;
mod serve_signals;
#[cfg(unix)]
mod shards;
mod shock;
mod shock_spectrum;
mod since;
mod sites;
mod sliding;
mod spatial;
mod spectrum;
mod studies;
mod usage;
mod walls;

use program::{folder, freestand, freestand_in};

/// A pulse of 0.5 g in 1 s, then quiet.
const RECORD: &str = "time [s],a [g]\n0,0\n0.25,0.5\n0.5,0\n0.75,-0.5\n1,0\n1.25,0\n";

/// A study of one record, one floor and one object: done in no time.
const SMALL: &str = "[ground]\nmotions = [\"pulse.csv\"]\n[building]\nstoreys = 4\nperiod = \"0.5 s\"\nlevels = [{ name = \"roof\", level_ratio = 1.0 }]\n[objects]\nheights = \"1 m\"\nthicknesses = \"200 mm\"\n[outputs]\nfigures = false\nreport = false\n";

/// Runs freestand in `folder` and expects an exit status.
fn expect(folder: &tempfile::TempDir, args: &[&str], status: i32) -> String {
    let shown = freestand_in(folder.path(), args);
    assert!(
        shown.contains(&format!("\nexit status {status}\n")),
        "{shown}"
    );
    shown
}

/// A wave of 2 Hz that comes and goes within 4 s, 0.3 g north and 0.2 g east, on an offset of 0.01
/// g.
fn two_components(heading: &str) -> String {
    let row = |k: u32| {
        let t = f64::from(k) / 50.0;
        let wave = (-(t - 2.0) * (t - 2.0)).exp() * (std::f64::consts::TAU * 2.0 * t).sin();
        format!(
            "{t},{:.6},{:.6}\n",
            0.01 + 0.3 * wave,
            0.01 + 0.2 * (wave - 0.1 * wave * wave)
        )
    };
    format!("{heading}\n{}", (0..=200).map(row).collect::<String>())
}
