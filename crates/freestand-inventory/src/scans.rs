//! The scans that a list names: files beside it, each read once, and the bodies that they are.

use std::collections::HashMap;
use std::path::{Component, Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use freestand_input::file::InputFile;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::shorten;
use freestand_scan::formats::read_mesh;
use freestand_scan::mesh::Mesh;
use freestand_study::hull::body::{Scan, ScanBase};
use freestand_study::hull::{BodyInPose, Surface};

/// What several rows ask for and the first of them makes.
type Once<K, T> = Mutex<HashMap<K, Arc<OnceLock<Result<T, Problem>>>>>;

/// The scans of a list.
#[derive(Default)]
pub(super) struct Scans {
    folder: PathBuf,
    files: Once<String, (InputFile, Mesh)>,
    /// By the file and what is said of it: a large scan is often that of many objects.
    bodies: Once<(String, Said), Arc<BodyInPose>>,
}

impl Scans {
    /// Of a list in this folder.
    pub(super) fn new(folder: &Path) -> Self {
        Self {
            folder: folder.to_path_buf(),
            ..Self::default()
        }
    }

    /// The body of a scan.
    pub(super) fn body(&self, file: &str, scan: &Scan) -> Result<Arc<BodyInPose>, Problem> {
        if let Some(problem) = scan.contradictions().problems.into_iter().next() {
            return Err(problem);
        }
        let once = once(&self.bodies, (file.to_owned(), Said::of(scan)));
        let made = once.get_or_init(|| {
            let mesh = self::once(&self.files, file.to_owned());
            let read = mesh.get_or_init(|| self.read(file));
            let (_, mesh) = read
                .as_ref()
                .map_err(|problem| problem.clone().of(&["scan"]))?;
            // Nobody draws it: its triangles would be kept with every row.
            let surface = Surface::default();
            let body = scan.body(mesh)?;
            Ok(Arc::new(BodyInPose { surface, ..body }))
        });
        made.clone()
    }

    /// A file in the folder of the list: with the list, it can be sent and put elsewhere.
    fn read(&self, file: &str) -> Result<(InputFile, Mesh), Problem> {
        let path = Path::new(file);
        let is_inside =
            |part: Component<'_>| matches!(part, Component::Normal(_) | Component::CurDir);
        if !path.components().all(is_inside) {
            let message = format!("\"{}\" is not in the folder of the list", shorten(file));
            let hint = "put the scan beside the list, and give its name alone";
            return Err(Problem::new(ProblemKind::Io, message).hint(hint));
        }
        read_mesh(&self.folder.join(path))
    }

    /// The files that were read, by name.
    pub(super) fn files(&self) -> Vec<InputFile> {
        let files = self.files.lock().unwrap_or_else(PoisonError::into_inner);
        let mut read: Vec<InputFile> = files
            .values()
            .filter_map(|once| Some(once.get()?.as_ref().ok()?.0.clone()))
            .collect();
        read.sort_by(|a, b| a.path.cmp(&b.path));
        read
    }
}

/// What a row says of a scan, with the bits of its numbers.
#[derive(PartialEq, Eq, Hash)]
struct Said {
    unit_m: u64,
    base: Option<ScanBase>,
    feet_m: Option<Vec<[u64; 2]>>,
    cg_height_m: Option<u64>,
    mass_kg: Option<u64>,
}

impl Said {
    fn of(scan: &Scan) -> Self {
        let bits = |feet: &Vec<[f64; 2]>| feet.iter().map(|foot| foot.map(f64::to_bits)).collect();
        Self {
            unit_m: scan.unit_m.to_bits(),
            base: scan.base,
            feet_m: scan.feet_m.as_ref().map(bits),
            cg_height_m: scan.cg_height_m.map(f64::to_bits),
            mass_kg: scan.mass_kg.map(f64::to_bits),
        }
    }
}

/// The place of what a key stands for.
fn once<K: std::hash::Hash + Eq, T>(all: &Once<K, T>, key: K) -> Arc<OnceLock<Result<T, Problem>>> {
    let mut all = all.lock().unwrap_or_else(PoisonError::into_inner);
    Arc::clone(all.entry(key).or_default())
}
