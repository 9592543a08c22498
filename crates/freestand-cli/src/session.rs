//! A command that was asked for by another program than the command line: its document is kept, and
//! what it tells while it works goes to that program.

#![cfg_attr(
    not(feature = "page"),
    allow(dead_code, reason = "nobody begins a session")
)]

use std::fmt::Debug;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use freestand_assess::one_object::{Follow, Memory};
use freestand_study::run::Step;
use serde::Serialize;
use serde_json::{Map, Value};

use crate::failure::Failure;
use crate::stop::Stop;

/// Histories of one request that is answered at once.
pub(crate) const MAX_HISTORIES: usize = 1_000_000;

/// Most frequencies × samples of one live shock spectrum, before samples are added between those of
/// the records.
const MAX_OSCILLATOR_SAMPLES: usize = 1_000_000_000;

/// Where the caller wants the rows of a document.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) enum RowsWanted {
    /// In the document, one JSON object for each row.
    #[default]
    InDocument,
    /// In the document, one array for each column, if the command can write them in this way.
    InColumns,
    /// Not in the document, if the command sends them while it works.
    Told,
}

/// Who asked for a command.
pub(crate) struct Session {
    pub(crate) stop: Stop,
    /// Whose history is wanted beside the document.
    follow: Option<Follow>,
    memory: Arc<Memory>,
    rows: RowsWanted,
    /// Whether somebody waits for the answer.
    is_live: bool,
    tell: Box<dyn Fn(Told) + Send + Sync>,
    kept: Mutex<Kept>,
}

/// What a command tells while it works.
pub(crate) enum Told {
    /// So much is done of a phase, and this share of the effort.
    Progress {
        phase: &'static str,
        done: usize,
        total: usize,
        share: f64,
    },
    /// What the worlds of an object say so far.
    Estimate(Value),
    /// A finished object.
    Object(Value),
    /// A problem that does not end the work.
    Problem(Value),
}

/// What a command leaves behind.
#[derive(Debug, Default)]
pub(crate) struct Kept {
    /// Its document.
    pub(crate) document: Vec<u8>,
    /// What goes beside it.
    pub(crate) beside: Map<String, Value>,
    /// The files that it wrote.
    pub(crate) files: Vec<String>,
    /// Whether it was stopped before its end.
    pub(crate) is_interrupted: bool,
    /// Whether the rows of its document are columns already.
    pub(crate) is_in_columns: bool,
}

impl Debug for Session {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("Session")
            .field("follow", &self.follow)
            .field("is_live", &self.is_live)
            .finish()
    }
}

impl Session {
    pub(crate) fn new(
        stop: Stop,
        (follow, is_live): (Option<Follow>, bool),
        memory: Arc<Memory>,
        tell: Box<dyn Fn(Told) + Send + Sync>,
    ) -> Self {
        Self {
            stop,
            follow,
            memory,
            rows: RowsWanted::default(),
            is_live,
            tell,
            kept: Mutex::default(),
        }
    }

    /// The session with rows in this place.
    pub(crate) fn with_rows(self, rows: RowsWanted) -> Self {
        Self { rows, ..self }
    }

    /// Whether rows are wanted as one array for each column.
    pub(crate) fn wants_columns(&self) -> bool {
        self.rows == RowsWanted::InColumns
    }

    /// Whether rows that were already sent are wanted in the document, too.
    pub(crate) fn wants_told_rows(&self) -> bool {
        self.rows != RowsWanted::Told
    }

    /// The rows of the document are columns.
    pub(crate) fn told_in_columns(&self) {
        self.kept().is_in_columns = true;
    }

    fn kept(&self) -> MutexGuard<'_, Kept> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What the command has left behind.
    pub(crate) fn take(&self) -> Kept {
        std::mem::take(&mut self.kept())
    }

    /// Keeps a piece of the document.
    pub(crate) fn keep(&self, bytes: &[u8]) {
        self.kept().document.extend(bytes);
    }

    /// Keeps what goes beside the document.
    pub(crate) fn beside<T: Serialize>(&self, body: &T) {
        if let Ok(Value::Object(keys)) = serde_json::to_value(body) {
            self.kept().beside.extend(keys);
        }
    }

    /// Whether a history is wanted.
    pub(crate) fn wants_history(&self) -> bool {
        self.follow.is_some()
    }

    /// Whose history is wanted.
    pub(crate) fn follow(&self) -> Option<Follow> {
        self.follow.clone()
    }

    /// Motions of earlier requests.
    pub(crate) fn memory(&self) -> Arc<Memory> {
        Arc::clone(&self.memory)
    }

    /// Refuses more histories than somebody would wait for.
    pub(crate) fn check_histories(&self, histories: usize) -> Result<(), Failure> {
        if !self.is_live || histories <= MAX_HISTORIES {
            return Ok(());
        }
        let message = format!("these are {histories} histories, more than {MAX_HISTORIES}");
        Err(Failure::usage(
            message,
            "ask for fewer objects or fewer motions, or use the command line",
        ))
    }

    /// Refuses a shock spectrum that takes longer than somebody would wait for.
    pub(crate) fn check_oscillators(
        &self,
        frequencies: usize,
        samples: usize,
    ) -> Result<(), Failure> {
        if !self.is_live || frequencies.saturating_mul(samples) <= MAX_OSCILLATOR_SAMPLES {
            return Ok(());
        }
        let message = format!(
            "--frequencies: {frequencies} frequencies for {samples} samples are more than {MAX_OSCILLATOR_SAMPLES} \
             frequencies × samples"
        );
        Err(Failure::usage(
            message,
            "ask for fewer frequencies or shorter records, or use the command line",
        ))
    }

    /// Tells how much is done, and gives way to others.
    pub(crate) fn progress(&self, phase: &'static str, step: Step) {
        (self.tell)(Told::Progress {
            phase,
            done: step.done,
            total: step.total,
            share: step.share(),
        });
    }

    /// Tells what the worlds of an object say so far.
    pub(crate) fn estimate<T: Serialize>(&self, estimate: &T) {
        if let Ok(estimate) = serde_json::to_value(estimate) {
            (self.tell)(Told::Estimate(estimate));
        }
    }

    /// Tells a finished object.
    pub(crate) fn object(&self, row: &Map<String, Value>) {
        (self.tell)(Told::Object(Value::Object(row.clone())));
    }

    /// Tells a problem that does not end the work.
    pub(crate) fn problem<T: Serialize>(&self, problem: &T) {
        if let Ok(problem) = serde_json::to_value(problem) {
            (self.tell)(Told::Problem(problem));
        }
    }

    /// The files of the command, and whether it was stopped before its end.
    pub(crate) fn files(&self, files: &[String], is_interrupted: bool) {
        let mut kept = self.kept();
        kept.files = files.to_vec();
        kept.is_interrupted = is_interrupted;
    }
}
