//! Finished runs on disk, with which a command that was stopped or killed can be continued.

use freestand::fragility::OutcomeClass;
use freestand_input::file::sha256_hex;
use freestand_input::problem::Problem;
use freestand_output::folder::announce;
use serde::{Deserialize, Serialize};
use serde_json::json;

use super::super::hazard::MeasuredHazard;
use super::super::{FRAGILITY_SCHEMA, FitMethod};
use super::follow::Followed;
use super::levels::ROUNDS;
use super::shaking::Asked;
use super::{Change, METHODS, ObjectRuns, RunObjects, RunsRequest};
use freestand_assess::key::resume_key;
use freestand_assess::portfolio::progress_names;
use freestand_assess::store::{PROGRESS, Part, Store};
use freestand_assess::verdict::NominalRun;
use freestand_input::words::name_of;

/// Number of objects in a part: some seconds of work, which is what is lost if the program is
/// killed.
const PART: usize = 16;

/// Version of the text that is hashed. Raise it whenever that text, the content of a part or the
/// choice of scales changes.
const FORMAT: u32 = 7;

/// The runs of one object.
#[derive(Debug, Serialize, Deserialize)]
struct KeptObject {
    id: String,
    spans: Vec<Option<(f64, f64)>>,
    motions: Vec<Vec<KeptRun>>,
    uplifts_ratio: Vec<Option<f64>>,
}

/// The scale, and the class, the rotation and the shock, or why it could not be followed.
type KeptRun = (f64, Result<(usize, Option<f64>, Option<f64>), String>);

/// Opens the store of finished runs; `None` if runs are not kept.
///
/// # Errors
/// A folder that cannot be written, or that has files that freestand did not write.
pub(super) fn open(
    request: &RunsRequest,
    measures: &[Asked],
    hazard: Option<&MeasuredHazard>,
    objects: usize,
) -> Result<Option<Store>, Problem> {
    let (
        Some(keep),
        RunObjects::Listed {
            study,
            inventory,
            worlds,
            changed,
            ..
        },
    ) = (&request.keep, &request.objects)
    else {
        return Ok(None);
    };
    let changed: Vec<_> = changed
        .iter()
        .map(|one| {
            let Change {
                stiffness_n_m,
                base_thickness_m,
                mass_kg,
            } = one.change;
            (
                &one.id,
                &one.curve_id,
                stiffness_n_m,
                base_thickness_m,
                mass_kg,
            )
        })
        .collect();
    let text = json!({
        "format": FORMAT,
        "list": resume_key(study, inventory, PART),
        "worlds": worlds,
        "changed": changed,
        "method": name_of(METHODS, request.method),
        "scales": request.scales,
        "hazard": hazard,
        "max_scale": request.max_scale_ratio,
        "rotation": request.rotation_ratio,
        "with_pads": request.fit != FitMethod::TwoStage,
        "measures": measures.iter().map(|one| (one.measure.name(), one.at.name())).collect::<Vec<_>>(),
    });
    let rounds = hazard.map_or(0, |_| ROUNDS);
    let parts: Vec<Part> = (0..=rounds)
        .flat_map(|round| parts(objects, round))
        .collect();
    announce(
        &keep.folder,
        keep.force,
        FRAGILITY_SCHEMA,
        &progress_names(&parts),
    )?;
    let key = sha256_hex(text.to_string().as_bytes());
    Store::open(&keep.folder.join(PROGRESS), &key, keep.resume).map(Some)
}

/// The parts of a round: the first runs, or those at added intensities.
pub(super) fn parts(objects: usize, round: usize) -> Vec<Part> {
    let mut parts = Part::of_run(objects, PART);
    if round > 0 {
        parts
            .iter_mut()
            .for_each(|part| part.name = format!("{round:02}{:0>8}", part.name));
    }
    parts
}

/// Reads a part into its objects; `false` if the part is absent or belongs to other objects.
pub(super) fn read(
    store: &Store,
    part: &Part,
    objects: &mut [ObjectRuns],
    motions: &[usize],
) -> bool {
    let Some(found) = store.rows::<KeptObject>(part) else {
        return false;
    };
    let is_same = found.len() == objects.len()
        && found.iter().zip(&*objects).all(|(kept, one)| {
            kept.id == one.id
                && motions.get(one.floor) == Some(&kept.motions.len())
                && kept.uplifts_ratio.len() == kept.motions.len()
        });
    let runs: Option<Vec<Vec<Vec<Followed>>>> = found.iter().map(followed).collect();
    let (true, Some(runs)) = (is_same, runs) else {
        return false;
    };
    for ((one, runs), kept) in objects.iter_mut().zip(runs).zip(found) {
        (one.motions, one.uplifts_ratio, one.spans) = (runs, kept.uplifts_ratio, kept.spans);
    }
    true
}

/// The runs of an object, by motion; `None` if one has a class that does not exist.
fn followed(kept: &KeptObject) -> Option<Vec<Vec<Followed>>> {
    let run = |(scale_ratio, run): &KeptRun| -> Option<Followed> {
        let found = match run {
            Err(why) => Err(why.clone()),
            Ok((class, rotation_ratio, edge_acceleration_g)) => {
                let class = *OutcomeClass::ALL.get(*class)?;
                let (rotation_ratio, edge_acceleration_g) = (*rotation_ratio, *edge_acceleration_g);
                Ok(NominalRun {
                    class,
                    rotation_ratio,
                    edge_acceleration_g,
                })
            }
        };
        Some(Followed {
            scale_ratio: *scale_ratio,
            found,
        })
    };
    kept.motions
        .iter()
        .map(|runs| runs.iter().map(run).collect())
        .collect()
}

/// Stores a part.
///
/// # Errors
/// A disk that is full.
pub(super) fn write(store: &Store, part: &Part, objects: &[ObjectRuns]) -> Result<(), Problem> {
    let run = |run: &Followed| -> KeptRun {
        let kept = |run: &NominalRun| {
            (
                run.class.index(),
                run.rotation_ratio,
                run.edge_acceleration_g,
            )
        };
        (
            run.scale_ratio,
            run.found.as_ref().map(kept).map_err(Clone::clone),
        )
    };
    let kept = objects.iter().map(|one| KeptObject {
        id: one.id.clone(),
        spans: one.spans.clone(),
        motions: one
            .motions
            .iter()
            .map(|runs| runs.iter().map(run).collect())
            .collect(),
        uplifts_ratio: one.uplifts_ratio.clone(),
    });
    store.write(part, &kept.collect::<Vec<KeptObject>>())
}
