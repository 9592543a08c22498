//! The local page of freestand: a server on the loopback interface that hands out the embedded page
//! and answers its requests.
//!
//! It knows no command. A [`Program`] says what there is (`facts`), what an uploaded file is
//! (`kind`), how a [`Request`] is typed elsewhere (`typed`), what its answer is (`answer`), what its object
//! looks like (`surface`) and how texts are read (`read`); all of HTTP is here: who may ask
//! (`guard`), files that were uploaded (`uploads`), requests of which only the newest counts
//! (`slots`), work that takes long (`jobs`), and the page itself (`assets`).

mod assets;
mod guard;
mod jobs;
mod reply;
mod routes;
mod server;
mod slots;
mod uploads;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

pub use jobs::{Events, MAX_RUNNING};
pub use reply::{Refusal, Status, columns};
pub use routes::MAX_BODY_BYTES;
pub use server::{BindError, Server, Settings};
pub use uploads::{MAX_FILE_BYTES, MAX_TOTAL_BYTES};

/// What the server knows of the program behind it.
#[derive(Clone, Copy)]
pub struct Program {
    /// The document of `GET /api/v1/facts`.
    pub facts: fn() -> Value,
    /// What an uploaded file seems to be.
    pub kind: fn(&Path) -> Kind,
    /// Refuses a request that cannot be begun; asked before a job is, so that it is refused at once.
    pub check: fn(&Request) -> Result<(), Refusal>,
    /// A request as a person types it elsewhere: the document of `POST /api/v1/asked`.
    pub typed: fn(&Request) -> Result<Value, Refusal>,
    /// Texts of a form as the program reads them: the document of `POST /api/v1/quantities`.
    pub read: fn(Value) -> Result<Value, Refusal>,
    /// The triangles of the object of a request, for `POST /api/v1/surface`. It is called on a thread that may block.
    pub surface: fn(&Request) -> Result<Vec<u8>, Refusal>,
    /// The answer to a request. It is called on a thread that may block.
    pub answer: fn(&Request, &Cancel, &Events) -> Result<Reply, Refusal>,
}

/// What an uploaded file seems to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A list of objects.
    Inventory,
    /// The record of a motion.
    Record,
    /// The record of a drop test.
    DropTest,
    /// A study.
    Study,
    /// A scan of an object.
    Scan,
    /// The hazard of a place: curves, spectra or values of a code.
    Hazard,
    /// None of these.
    Unknown,
}

/// A request, with the paths of the files that it names.
#[derive(Debug, Clone, Default)]
pub struct Request {
    /// The command, such as `rock` or `inventory check`.
    pub command: String,
    /// Its long flags without dashes, and their values.
    pub options: Map<String, Value>,
    /// Files by the flag or the argument that they belong to; their names are the user's.
    pub files: Vec<(String, Vec<PathBuf>)>,
    /// Whose history is wanted besides the answer.
    pub history: History,
    /// How rows are written.
    pub shape: Shape,
    /// Cells of the list that the user has changed.
    pub edits: Vec<Edit>,
    /// Where a job writes its files; `None` for a live request.
    pub folder: Option<PathBuf>,
}

/// Whose history is wanted besides the answer.
#[derive(Debug, Clone, Default, PartialEq, Eq, Deserialize)]
#[serde(untagged)]
pub enum History {
    /// No history.
    #[default]
    None,
    /// `true`: the one that the answer is about, or the strongest of several; `false`: none.
    Any(bool),
    /// That under one motion.
    Of {
        /// Its name.
        motion: String,
    },
}

impl History {
    /// Whether a history is wanted.
    pub fn is_wanted(&self) -> bool {
        !matches!(self, Self::None | Self::Any(false))
    }
}

/// How the rows of a document are written.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shape {
    /// One object a row.
    #[default]
    Rows,
    /// One array a column.
    Columns,
    /// Not in the document of a job that sends its rows as events, because they would then be sent
    /// and kept twice.
    Events,
}

/// A cell of a list with the text that replaces it.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Edit {
    /// Its name, such as `D7`.
    pub cell: String,
    /// The new text.
    pub value: String,
}

/// The answer to a request.
#[derive(Debug, Clone, Default)]
pub struct Reply {
    /// One JSON document.
    pub document: String,
    /// The files in the folder of a job that may be downloaded.
    pub files: Vec<String>,
    /// Whether it was stopped before its end, and the finished part is kept.
    pub is_stopped: bool,
}

/// Whether an answer is still wanted.
#[derive(Debug, Clone, Default)]
pub struct Cancel(Arc<AtomicBool>);

impl Cancel {
    /// Asks the work to stop.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether the work should stop.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// The flag itself, for code that watches one.
    pub fn flag(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.0)
    }
}
