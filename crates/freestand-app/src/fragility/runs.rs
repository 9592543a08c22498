//! What is run.

use std::path::Path;
use std::sync::Arc;

use freestand::rocking::Base;
use freestand_input::file::{InputFile, load};
use freestand_input::problem::Problems;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_input::words::counted;
use freestand_records::notes::grouped;
use freestand_risk::fragility::{
    At, DEFAULT_MAX_SCALE, FloorMotion, GivenObject, Limits, METHODS, Measure, Method, RunObjects,
    measures, scales,
};
use freestand_risk::load_changed;
use freestand_study::recorded::ReadMotion;
use freestand_study::unsolved::rocking_problem;

use super::OneObject;
use crate::block::{block, restitution, sizes};
use crate::files::Files;
use crate::list::ListMeant;
use crate::records::{NamedRecords, Records, VerticalRecords};
use crate::request::{Request as _, keys};

/// How runs are chosen.
pub(super) struct Chosen {
    pub(super) measures: Vec<Measure>,
    pub(super) method: Method,
    pub(super) scales: Option<Vec<f64>>,
    pub(super) max_scale_ratio: f64,
    pub(super) rotation_ratio: Option<f64>,
}

impl Chosen {
    /// What is asked; `first` is the measure where none is named.
    pub(super) fn judged(read: &mut WordReader<'_>, first: Measure) -> Option<Self> {
        let asked = read.text("im").map(measures);
        let asked = read.keep("im", asked.transpose());
        let method = read.choice("method", METHODS);
        let is_known = method.is_some() || !read.has("method");
        let method = method.unwrap_or(Method::Incremental);
        // What scales are depends on both.
        let grid = match (&asked, read.text("scales")) {
            (Some(asked), Some(text)) if is_known => {
                let first = asked.iter().flatten().next().copied().unwrap_or(first);
                read.keep("scales", scales(text, method, first))?
            }
            _ => None,
        };
        let max_scale = read.positive("max_scale", Dimension::Ratio);
        if method == Method::Cloud {
            read.idle(&["max_scale"], "a cloud uses every motion unscaled");
        }
        Some(Self {
            measures: asked?.unwrap_or_default(),
            method,
            scales: grid,
            max_scale_ratio: max_scale.unwrap_or(DEFAULT_MAX_SCALE),
            rotation_ratio: read.positive("tolerance_rotation", Dimension::Ratio),
        })
    }
}

impl OneObject {
    /// The object without its motions.
    pub(super) fn judged(
        &self,
        read: &mut WordReader<'_>,
        at: Option<At>,
        files: &Files,
    ) -> Option<GivenObject> {
        let size = sizes(read);
        let mass = read.positive("mass", Dimension::Mass);
        let cushion = self.pad.resolve(read, mass, files);
        if !read.has("mass") && !self.pad.words().is_empty() {
            let message = "the shock needs both the mass and the cushion of the object";
            let hint = "give `mass`, or leave the cushion out";
            read.missing(&["mass"], message, hint);
        }
        let block = block(read, size, mass);
        let restitution = restitution(read, block.as_slice());
        let limits = Limits {
            peak_m_s2: read.positive("tolerance", Dimension::Acceleration),
            duration_s: read.positive("tolerance_duration", Dimension::Time),
            velocity_change_m_s: read.positive("tolerance_velocity_change", Dimension::Velocity),
            edge_lift_m: read.positive("tolerance_edge_lift", Dimension::Length),
        };
        if read.has("tolerance_duration") && !read.has("tolerance") {
            let message = "`tolerance_duration` needs `tolerance`, the peak of that pulse";
            read.missing(&["tolerance"], message, "give both, or leave it out");
        }
        Some(GivenObject {
            block: block?,
            restitution,
            body: mass.zip(cushion),
            limits,
            motions: Vec::new(),
            is_on_ground: at == Some(At::Ground),
        })
    }

    /// The motions of its floor, which have not been read.
    pub(super) fn records<'f>(
        &self,
        read: &mut WordReader<'_>,
        files: &'f Files,
    ) -> NamedRecords<'f> {
        let (motions, verticals) = (self.motion.len(), self.vertical.len());
        if motions == 0 {
            read.missing(
                &["motion"],
                "there are no motions to run",
                "name with `motion` the motions of the floor under the object, or give an inventory with a study",
            );
        } else if verticals > 0 && verticals != motions {
            let message = format!(
                "`vertical` has {}, `motion` {motions}",
                counted(verticals, "file")
            );
            let hint =
                "give one vertical record for each horizontal one, in the same order, or none";
            read.note(&["vertical"], message, hint);
        }
        let vertical = (self.vertical.as_slice(), &self.upward);
        self.records.named(read, &self.motion, vertical, files)
    }
}

/// The motions of a floor, with what their readers noted, and their files.
pub(super) struct RunMotions {
    pub(super) motions: Vec<FloorMotion>,
    pub(super) notes: Vec<String>,
    pub(super) files: Vec<InputFile>,
}

/// Reads the motions.
pub(super) fn motions(named: &NamedRecords<'_>) -> Result<RunMotions, Problems> {
    let file = |read: &ReadMotion| InputFile {
        path: read.motion.path.clone(),
        sha256: read.motion.sha256.clone(),
    };
    let read = named.read_as(named.how())?;
    let verticals = named.verticals()?;
    let mut notes = grouped(read.iter().flat_map(ReadMotion::named_notes));
    let upward = verticals.iter().flat_map(ReadMotion::named_notes);
    notes.extend(grouped(
        upward.map(|(name, note)| (format!("vertical {name}"), note)),
    ));
    let files = read.iter().chain(&verticals).map(file).collect();
    let mut verticals = verticals.into_iter();
    let floor = |read: ReadMotion| {
        let motion = FloorMotion {
            name: read.motion.name,
            horizontal: read.motion.motion,
            vertical: verticals.next().map(|read| read.motion.motion),
        };
        let base = Base {
            horizontal: Some(&motion.horizontal),
            vertical: motion.vertical.as_ref(),
        };
        base.check().map_err(rocking_problem)?;
        Ok::<_, Problems>(motion)
    };
    Ok(RunMotions {
        motions: read.into_iter().map(floor).collect::<Result<_, _>>()?,
        notes,
        files,
    })
}

/// The objects of a list, and the files that they were read from.
pub(super) fn listed(
    list: &ListMeant,
    worlds: Option<u32>,
    options: Option<&Path>,
) -> Result<(RunObjects, Vec<InputFile>), Problems> {
    let study = list.study(None)?;
    let inventory = list.inventory(&study)?;
    let mut files = Vec::new();
    if let Some(path) = &study.source {
        files.push(InputFile::new(path, &load(path)?));
    }
    files.push(InputFile {
        path: inventory.path.clone(),
        sha256: inventory.sha256.clone(),
    });
    files.extend(inventory.libraries.iter().chain(&inventory.scans).cloned());
    let recorded = study.ground.recorded(&study.levels);
    files.extend(recorded.map(|one| InputFile {
        path: one.path.clone(),
        sha256: one.sha256.clone(),
    }));
    let mut changed = Vec::new();
    if let Some(path) = options {
        let (file, objects) = load_changed(path)?;
        files.push(file);
        changed = objects;
    }
    let objects = RunObjects::Listed {
        study: Arc::new(study),
        inventory: Arc::new(inventory),
        worlds,
        changed,
    };
    Ok((objects, files))
}

/// Whether a key says which records are read, or how.
fn of_records(key: &str) -> bool {
    let known = [keys::<Records>(), keys::<VerticalRecords>()].concat();
    ["motion", "vertical"].contains(&key) || known.iter().any(|known| known == key)
}

/// What is said of a key that nothing reads in these runs.
pub(super) fn refusal(key: &str, is_listed: bool) -> (String, &'static str) {
    match key {
        "ceiling" => (
            "`ceiling` is for `outcomes` only: runs calculate the ceiling".to_owned(),
            "leave it out",
        ),
        _ if !is_listed => (
            format!("`{key}` is for an inventory in the building of a study, and none is run"),
            "leave it out, or give `inventory` or a study in place of one object",
        ),
        _ if of_records(key) => (
            format!("`{key}` is for records of `motion`, but an inventory or a study is given"),
            "leave it out: the motions of an inventory are those of its study",
        ),
        _ => (
            format!("`{key}` is for one object, but an inventory or a study is given"),
            "write it into the inventory, or leave the inventory and the study out",
        ),
    }
}
