//! The worlds of objects that are not settled, for a run that goes on later. They are kept as CBOR (RFC 8949): JSON has
//! no infinite numbers, which belong to objects that fall.

use freestand_input::problem::{Problem, ProblemKind};
use serde::{Deserialize, Serialize};

use super::Context;
use super::response::Lived;
use super::trial::Trial;

#[derive(Serialize)]
struct Keeps<'a> {
    id: &'a str,
    lived: &'a [Lived],
}

#[derive(Deserialize)]
struct Kept {
    id: String,
    lived: Vec<Lived>,
}

/// The worlds of these objects.
pub(super) fn worlds(trials: &[Trial]) -> Result<Vec<u8>, Problem> {
    let keeps: Vec<Keeps> = trials
        .iter()
        .map(|trial| Keeps {
            id: &trial.member.item.id,
            lived: &trial.lived,
        })
        .collect();
    let mut bytes = Vec::new();
    ciborium::into_writer(&keeps, &mut bytes).map_err(|error| {
        Problem::new(
            ProblemKind::Computation,
            format!("worlds cannot be kept: {error}"),
        )
    })?;
    Ok(bytes)
}

/// Gives objects the worlds that were kept; worlds that cannot be read are lived again.
pub(super) fn resume(context: &Context, trials: &mut [Trial], bytes: &[u8]) {
    let Ok(kept) = ciborium::from_reader::<Vec<Kept>, _>(bytes) else {
        return;
    };
    let ids = trials.iter().map(|trial| trial.member.item.id.as_str());
    if !ids.eq(kept.iter().map(|one| one.id.as_str())) {
        return;
    }
    for (trial, kept) in trials.iter_mut().zip(kept) {
        trial.resume(context, kept.lived);
    }
}
