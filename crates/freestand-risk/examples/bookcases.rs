//! The furniture of FEMA P-58 under computed floor motions: the table of `validation/furniture`.
//!
//! `cargo run --release -p freestand-risk --example bookcases [SEED]`

#![expect(clippy::print_stdout, reason = "the result is what it prints")]

use std::error::Error;

use freestand::block::Block;
use freestand::building::{Building, floor_motion};
use freestand::code_spectrum::{As1170_4, Edition, SiteClass};
use freestand::fragility::{
    CurveKind, FitKind, LimitState, OutcomeClass, Outcomes, OutcomesError, Run, fit_curves,
    kaneko_hayashi_velocity_m_s,
};
use freestand::measures::measures;
use freestand::motion::Motion;
use freestand::rocking::{Base, Outcome, RockingOptions, Until, rock_many};
use freestand::synthesis::{SynthesisOptions, synthesize};
use freestand_inventory::library::ToleranceLibrary;
use freestand_inventory::validate::FURNITURE;
use rayon::prelude::*;

const MOTIONS: u64 = 20;

/// Peak floor velocities: 0.1 to 5 m/s, eight to a doubling.
fn levels_m_s() -> Vec<f64> {
    (0..=45)
        .map(|i| 0.1 * 2.0_f64.powf(f64::from(i) / 8.0))
        .collect()
}

/// The motions of one place, each scaled to a peak velocity of 1 m/s.
fn floor(
    ground: &[Motion],
    place: Option<(&Building, f64)>,
) -> Result<Vec<Motion>, Box<dyn Error>> {
    let mut floors = Vec::new();
    for motion in ground {
        let floor = match place {
            Some((building, level)) => {
                floor_motion(&motion.with_zero_tail(building.tail_s())?, building, level)?
            }
            None => motion.clone(),
        };
        let pgv_m_s = measures(&floor).pgv_m_s;
        floors.push(floor.scaled(1.0 / pgv_m_s)?);
    }
    Ok(floors)
}

/// How many of the [`MOTIONS`] overturn each piece of furniture, at each level.
fn overturned(
    floors: &[Motion],
    blocks: &[Block],
) -> Result<Vec<Vec<u32>>, Box<dyn Error + Send + Sync>> {
    let options = RockingOptions {
        until: Until::Settled { at_most_s: 120.0 },
        ..RockingOptions::default()
    };
    let at = |pfv_m_s: f64| {
        let mut counts = vec![0; blocks.len()];
        for floor in floors {
            let motion = floor.scaled(pfv_m_s)?;
            let base = Base {
                horizontal: Some(&motion),
                vertical: None,
            };
            for (count, found) in counts.iter_mut().zip(rock_many(blocks, base, &options)) {
                *count += u32::from(found?.outcome == Outcome::Overturned);
            }
        }
        Ok(counts)
    };
    levels_m_s().into_par_iter().map(at).collect()
}

/// Median and β where a lognormal curve fits the counts, and what fits them where none does.
fn fit(counts: &[Vec<u32>], block: usize) -> Result<String, OutcomesError> {
    let run = |(pfv_m_s, counts): (f64, &Vec<u32>)| {
        let run = |class, count| Run {
            motion: None,
            intensity: pfv_m_s,
            class,
            weight: f64::from(count),
        };
        let overturned = counts[block];
        [
            run(OutcomeClass::NoUplift, MOTIONS as u32 - overturned),
            run(OutcomeClass::Overturned, overturned),
        ]
    };
    let runs: Vec<Run> = levels_m_s().into_iter().zip(counts).flat_map(run).collect();
    let outcomes = Outcomes::new(&runs)?;
    let fit = fit_curves(&outcomes, &[LimitState::Overturns], FitKind::Separate);
    Ok(match fit.curve(LimitState::Overturns) {
        Some(CurveKind::Lognormal { median, beta }) => format!("{median:.2} ({beta:.2})"),
        other => format!("{other:?}"),
    })
}

fn main() -> Result<(), Box<dyn Error + Send + Sync>> {
    let seed = std::env::args().nth(1).map_or(Ok(1), |text| text.parse())?;
    let code = As1170_4::new(Edition::default(), SiteClass::De, 0.08, 500)?;
    let options = SynthesisOptions::default();
    let ground: Vec<Motion> = (0..MOTIONS)
        .into_par_iter()
        .map(|index| {
            synthesize(|t| code.sa_g(t), seed, index, &options).map(|matched| matched.motion)
        })
        .collect::<Result<_, _>>()?;
    // The tower of the built-in study; a stiff building; the periods in between.
    let building = |period_s| Building::beam(period_s, 0.05, 5.0, 10);
    let (tower, stiff, middle) = (building(1.92)?, building(0.3)?, building(0.8)?);
    let places: [(&str, Option<(&Building, f64)>); 5] = [
        ("ground", None),
        ("roof, 0.3 s", Some((&stiff, 1.0))),
        ("roof, 0.8 s", Some((&middle, 1.0))),
        ("mid-height, 1.92 s", Some((&tower, 0.5))),
        ("roof, 1.92 s", Some((&tower, 1.0))),
    ];
    let blocks: Vec<Block> = FURNITURE
        .iter()
        .map(|(_, h, t)| Block::uniform(h * 0.0254, t * 0.0254))
        .collect::<Result<_, _>>()?;
    let mut fits = Vec::new();
    for (_, place) in places {
        let floors = floor(&ground, place).map_err(|error| error.to_string())?;
        let counts = overturned(&floors, &blocks)?;
        fits.push(
            (0..blocks.len())
                .map(|block| fit(&counts, block))
                .collect::<Vec<_>>(),
        );
    }
    let names: Vec<&str> = places.iter().map(|(name, _)| *name).collect();
    println!(
        "| height × depth | P-58 median (β) | 0.8 V_R50 | {} |",
        names.join(" | ")
    );
    println!("|---|---|---|{}", "---|".repeat(names.len()));
    let library = ToleranceLibrary::builtin();
    for (i, ((id, height_in, depth_in), block)) in FURNITURE.iter().zip(&blocks).enumerate() {
        let entry = library.get(id)?;
        let median = entry
            .pfv_median_m_s
            .zip(entry.beta)
            .map(|(m, b)| format!("{m:.2} ({b:.1})"))
            .unwrap_or_default();
        let own = fits.iter().map(|fits| match &fits[i] {
            Ok(fit) => fit.clone(),
            Err(error) => error.to_string(),
        });
        println!(
            "| {height_in}″ × {depth_in}″ | {median} | {:.2} | {} |",
            0.8 * kaneko_hayashi_velocity_m_s(block),
            own.collect::<Vec<_>>().join(" | ")
        );
    }
    Ok(())
}
