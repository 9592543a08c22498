//! Work that takes long: started by one request, followed by another, stopped by a third.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use bytes::Bytes;
use serde_json::{Value, json};
use tokio::sync::mpsc::Receiver;
use tokio::sync::watch;

use crate::reply::{Refusal, Status};
use crate::{Cancel, Reply};

/// Jobs that run at the same time.
pub const MAX_RUNNING: usize = 4;

/// Progress is told ten times a second at most.
const BETWEEN_PROGRESS: Duration = Duration::from_millis(100);

/// How long a job waits between looks at whether a live request is being answered.
const YIELD: Duration = Duration::from_millis(2);

/// A line is sent in this time even where nothing happens, so that both sides notice a lost
/// connection.
const ALIVE: Duration = Duration::from_secs(15);

/// What work tells while it runs. Work of a live request tells nobody.
#[derive(Clone, Default)]
pub struct Events {
    job: Option<Arc<Job>>,
}

impl Events {
    /// How much is done of a phase, and which share of the effort.
    pub fn progress(&self, phase: &str, done: usize, total: usize, share: f64) {
        let Some(job) = &self.job else { return };
        let mut told = job.told.lock().unwrap_or_else(PoisonError::into_inner);
        let is_new = told.phase != phase || done >= total;
        if !is_new && told.at.is_some_and(|at| at.elapsed() < BETWEEN_PROGRESS) {
            return;
        }
        // A thousandth is less than a pixel of the bar.
        let done_and_share = (done, (1e3 * share) as u64);
        if told.phase == phase && told.done == Some(done_and_share) {
            return;
        }
        *told = Told {
            phase: phase.to_owned(),
            at: Some(Instant::now()),
            done: Some(done_and_share),
        };
        drop(told);
        job.push(
            "progress",
            &json!({"done": done, "total": total, "phase": phase, "share": share}),
        );
    }

    /// What is known of an object that is not finished.
    pub fn estimate(&self, row: &Value) {
        if let Some(job) = &self.job {
            job.push("estimate", row);
        }
    }

    /// A finished object.
    pub fn object(&self, row: &Value) {
        if let Some(job) = &self.job {
            job.push("object", row);
        }
    }

    /// A problem that does not end the work.
    pub fn problem(&self, problem: &Value) {
        if let Some(job) = &self.job {
            job.push("problem", problem);
        }
    }

    /// Called between objects: waits until no live request is being answered.
    pub fn give_way(&self) {
        let Some(job) = &self.job else { return };
        while job.live.0.load(Ordering::Acquire) > 0 && !job.cancel.is_cancelled() {
            std::thread::sleep(YIELD);
        }
    }
}

/// The live requests that are being answered.
#[derive(Clone, Default)]
pub(crate) struct Live(Arc<AtomicUsize>);

impl Live {
    /// Counts one until it is dropped.
    pub(crate) fn enter(&self) -> Entered {
        self.0.fetch_add(1, Ordering::AcqRel);
        Entered(self.clone())
    }
}

pub(crate) struct Entered(Live);

impl Drop for Entered {
    fn drop(&mut self) {
        self.0.0.fetch_sub(1, Ordering::AcqRel);
    }
}

#[derive(Default)]
struct Told {
    phase: String,
    at: Option<Instant>,
    /// The number, and the thousandths of the effort.
    done: Option<(usize, u64)>,
}

/// One job with everything that it has told.
pub(crate) struct Job {
    pub(crate) id: String,
    number: usize,
    pub(crate) cancel: Cancel,
    pub(crate) folder: PathBuf,
    /// Which work it does; only the same work continues it.
    work: Value,
    live: Live,
    told: Mutex<Told>,
    record: Mutex<Record>,
    /// How many events there are; watched by those who follow.
    count: watch::Sender<usize>,
}

#[derive(Default)]
struct Record {
    events: Vec<Bytes>,
    is_ended: bool,
    /// Whether it ended by itself, with its whole result.
    is_finished: bool,
    files: Vec<String>,
}

impl Job {
    fn push(&self, name: &str, data: &Value) {
        let mut record = self.record.lock().unwrap_or_else(PoisonError::into_inner);
        if !record.is_ended {
            let number = record.events.len() + 1;
            record
                .events
                .push(format!("id: {number}\nevent: {name}\ndata: {data}\n\n").into());
            record.is_ended = ["done", "failed", "cancelled"].contains(&name);
            record.is_finished = name == "done";
            self.count.send_replace(number);
        }
    }

    pub(crate) fn events(self: &Arc<Self>) -> Events {
        Events {
            job: Some(Arc::clone(self)),
        }
    }

    pub(crate) fn is_ended(&self) -> bool {
        self.record
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .is_ended
    }

    fn is_finished(&self) -> bool {
        self.record
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .is_finished
    }

    /// The last event of the job.
    pub(crate) fn end(&self, outcome: Result<Reply, Refusal>) {
        match outcome {
            Ok(reply) => {
                let mut record = self.record.lock().unwrap_or_else(PoisonError::into_inner);
                record.files.clone_from(&reply.files);
                drop(record);
                let result: Value = serde_json::from_str(&reply.document).unwrap_or(Value::Null);
                if reply.is_stopped {
                    self.push("cancelled", &json!({"done": self.done(), "result": result}));
                } else {
                    self.push("done", &json!({"result": result}));
                }
            }
            Err(_) if self.cancel.is_cancelled() => {
                self.push("cancelled", &json!({"done": self.done()}))
            }
            Err(refusal) => self.push("failed", &refusal.document()),
        }
    }

    fn done(&self) -> usize {
        self.told
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .done
            .map_or(0, |(done, _)| done)
    }

    /// Whether a file may be downloaded, by its name as it stands in an address.
    pub(crate) fn file(&self, name: &str) -> Option<PathBuf> {
        let record = self.record.lock().unwrap_or_else(PoisonError::into_inner);
        record
            .files
            .iter()
            .find(|own| in_address(own) == name)
            .map(|own| self.folder.join(own))
    }

    /// All events after a number, and those that come.
    pub(crate) fn follow(self: &Arc<Self>, after: usize) -> Receiver<Bytes> {
        let (sender, receiver) = tokio::sync::mpsc::channel(16);
        let (job, mut count) = (Arc::clone(self), self.count.subscribe());
        tokio::spawn(async move {
            let mut next = after;
            loop {
                count.borrow_and_update();
                let (pending, is_ended) = {
                    let record = job.record.lock().unwrap_or_else(PoisonError::into_inner);
                    (
                        record.events.get(next..).unwrap_or_default().to_vec(),
                        record.is_ended,
                    )
                };
                next += pending.len();
                for event in pending {
                    if sender.send(event).await.is_err() {
                        return;
                    }
                }
                if is_ended {
                    return;
                }
                match tokio::time::timeout(ALIVE, count.changed()).await {
                    Ok(Ok(())) => {}
                    Ok(Err(_)) => return,
                    Err(_)
                        if sender
                            .send(Bytes::from_static(b": working\n\n"))
                            .await
                            .is_err() =>
                    {
                        return;
                    }
                    Err(_) => {}
                }
            }
        });
        receiver
    }
}

/// All jobs of this server.
#[derive(Default)]
pub(crate) struct Jobs {
    all: Mutex<Vec<Arc<Job>>>,
    pub(crate) live: Live,
}

impl Jobs {
    fn list(&self) -> std::sync::MutexGuard<'_, Vec<Arc<Job>>> {
        self.all.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A new job, in a new folder in `results` with its name, or in that of an earlier job that it
    /// continues: only the same work continues a job, and only one that was stopped or has failed.
    /// The name has the first number for which there is no folder yet: the results of an earlier server
    /// stay as they are.
    pub(crate) fn begin(
        &self,
        continues: Option<&str>,
        work: Value,
        results: &Path,
    ) -> Result<Arc<Job>, Refusal> {
        let mut all = self.list();
        if all.iter().filter(|job| !job.is_ended()).count() >= MAX_RUNNING {
            let message = format!("{MAX_RUNNING} jobs are running already");
            return Err(Refusal::new(
                Status::TooMany,
                "busy",
                message,
                "wait for one of them, or cancel it",
            ));
        }
        let next = all.last().map_or(1, |job| job.number + 1);
        let (number, folder) = match continues {
            None => new_folder(results, next).map_err(|error| {
                let message = format!("no folder for the results can be made: {error}");
                let hint = "check that the folder for results can be written and has room";
                Refusal::new(Status::Defect, "io", message, hint)
            })?,
            Some(earlier) => {
                let earlier = all
                    .iter()
                    .find(|job| job.id == earlier)
                    .ok_or_else(missing)?;
                if !earlier.is_ended() {
                    let hint = "cancel it first, or follow it";
                    return Err(Refusal::new(
                        Status::BadInput,
                        "value",
                        "this job is still running",
                        hint,
                    ));
                }
                if earlier.is_finished() {
                    let hint = "start a new job: leave `continues` out";
                    return Err(Refusal::new(
                        Status::BadInput,
                        "value",
                        "this job is finished",
                        hint,
                    ));
                }
                if earlier.work != work {
                    let message =
                        "another request cannot continue this job: its files would be replaced";
                    let hint =
                        "send the same command, options, files and edits, or leave `continues` out";
                    return Err(Refusal::new(Status::BadInput, "value", message, hint));
                }
                (next, earlier.folder.clone())
            }
        };
        let job = Arc::new(Job {
            id: name(number),
            number,
            cancel: Cancel::default(),
            folder,
            work,
            live: self.live.clone(),
            told: Mutex::default(),
            record: Mutex::default(),
            count: watch::Sender::new(0),
        });
        all.push(Arc::clone(&job));
        Ok(job)
    }

    pub(crate) fn find(&self, id: &str) -> Result<Arc<Job>, Refusal> {
        self.list()
            .iter()
            .find(|job| job.id == id)
            .cloned()
            .ok_or_else(missing)
    }

    /// Asks every job to stop.
    pub(crate) fn cancel_all(&self) {
        self.list().iter().for_each(|job| job.cancel.cancel());
    }

    /// Whether no job is running.
    pub(crate) fn is_idle(&self) -> bool {
        self.list().iter().all(|job| job.is_ended())
    }
}

fn name(number: usize) -> String {
    format!("job-{number}")
}

/// Makes the first folder from this number on that does not exist.
fn new_folder(results: &Path, from: usize) -> std::io::Result<(usize, PathBuf)> {
    std::fs::create_dir_all(results)?;
    let mut number = from;
    loop {
        let folder = results.join(name(number));
        match std::fs::create_dir(&folder) {
            Ok(()) => return Ok((number, folder)),
            Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => number += 1,
            Err(error) => return Err(error),
        }
    }
}

fn missing() -> Refusal {
    Refusal::new(
        Status::NotFound,
        "missing",
        "there is no such job",
        "start it again",
    )
}

/// The name of a file as browsers write it in an address: what is no letter of ASCII by its bytes.
fn in_address(name: &str) -> String {
    let mut text = String::with_capacity(name.len());
    for byte in name.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'-' | b'_' | b'.' => {
                text.push(char::from(byte));
            }
            _ => text.push_str(&format!("%{byte:02X}")),
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::in_address;

    #[test]
    fn a_file_in_a_folder_has_an_address() {
        assert_eq!(in_address("orders/L-3.html"), "orders/L-3.html");
        assert_eq!(in_address("Bogotá 2/x.csv"), "Bogot%C3%A1%202/x.csv");
    }
}
