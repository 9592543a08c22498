//! Long work without the interpreter's lock, on a pool of its own, which Ctrl-C stops.

use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use freestand_input::problem::{Problem, ProblemKind};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::errors::{Interrupted, raised};

/// How often signals are looked for.
const LOOK: Duration = Duration::from_millis(10);

/// Pools by process and number of threads.
type Pools = HashMap<(u32, usize), Arc<ThreadPool>>;

/// The pools so far. A child process made by `fork` has the memory of a pool
/// without its threads, so that it needs another.
static POOLS: Mutex<Option<Pools>> = Mutex::new(None);

/// The pool of so many threads; `None`: one for each core.
fn pool(threads: Option<usize>) -> PyResult<Arc<ThreadPool>> {
    let count = threads.unwrap_or_else(|| thread::available_parallelism().map_or(1, usize::from));
    let mut pools = POOLS.lock().unwrap_or_else(PoisonError::into_inner);
    let pools = pools.get_or_insert_default();
    if let Some(pool) = pools.get(&(std::process::id(), count)) {
        return Ok(Arc::clone(pool));
    }
    let made = ThreadPoolBuilder::new()
        .num_threads(count)
        .thread_name(|index| format!("freestand-{index}"))
        .build();
    let no_threads = |error: rayon::ThreadPoolBuildError| {
        let message = format!("{count} threads cannot be started: {error}");
        raised(Problem::new(ProblemKind::Computation, message).hint("give a smaller `threads`"))
    };
    let pool = Arc::new(made.map_err(no_threads)?);
    pools.insert((std::process::id(), count), Arc::clone(&pool));
    Ok(pool)
}

/// The number of threads that work gets where none is given.
#[pyfunction]
pub(crate) fn threads() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}

/// The version of the program, which is that of the package.
#[pyfunction]
pub(crate) fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}

/// Does the work on the pool while this thread looks for signals. Ctrl-C sets the flag that the work
/// gets; the exception is raised when the work has ended.
pub(crate) fn watched<T: Send>(
    py: Python<'_>,
    threads: Option<usize>,
    work: impl FnOnce(&AtomicBool) -> T + Send,
) -> PyResult<T> {
    watched_with(py, threads, work, |_| Ok(()))
}

/// As [`watched`]; `look` is called between, with the interpreter's lock, for progress. Its exception
/// stops the work too.
pub(crate) fn watched_with<T: Send>(
    py: Python<'_>,
    threads: Option<usize>,
    work: impl FnOnce(&AtomicBool) -> T + Send,
    mut look: impl FnMut(Python<'_>) -> PyResult<()>,
) -> PyResult<T> {
    let pool = pool(threads)?;
    let stop = AtomicBool::new(false);
    let (done, ended) = channel::<()>();
    let mut signalled = None;
    let result = thread::scope(|scope| {
        let (pool, stop) = (&pool, &stop);
        let worker = scope.spawn(move || {
            // Dropped at the end, also by a panic, which closes the channel.
            let _done = done;
            pool.install(|| work(stop))
        });
        // A receiver cannot be used by two threads, and this one waits in another closure.
        let ended = Mutex::new(ended);
        while py.detach(|| wait(&ended)) {
            if let Err(error) = py.check_signals().and_then(|()| look(py)) {
                signalled.get_or_insert(error);
                stop.store(true, Ordering::Relaxed);
            }
        }
        worker.join()
    });
    if let Some(error) = signalled {
        return Err(interrupted(py, error));
    }
    result.map_err(|_| defect())
}

/// Does work that cannot be stopped in a thread of its own, while this one looks for signals: Ctrl-C
/// raises at once, and the result of the work is discarded.
pub(crate) fn abandoned_on_signal<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> T + Send + 'static,
) -> PyResult<T> {
    let (done, ended) = channel();
    thread::spawn(move || {
        // Nobody listens where a signal came first.
        let _ = done.send(work());
    });
    let ended = Mutex::new(ended);
    loop {
        let look = || {
            ended
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .recv_timeout(LOOK)
        };
        match py.detach(look) {
            Ok(result) => return Ok(result),
            Err(RecvTimeoutError::Timeout) => {
                py.check_signals().map_err(|error| interrupted(py, error))?
            }
            Err(RecvTimeoutError::Disconnected) => return Err(defect()),
        }
    }
}

/// A calculation that ended by a panic.
fn defect() -> PyErr {
    let message = "the calculation ended unexpectedly";
    let hint = "this is a defect of freestand; please report it";
    raised(Problem::new(ProblemKind::Computation, message).hint(hint))
}

/// Waits for a moment; whether the work goes on.
fn wait(ended: &Mutex<std::sync::mpsc::Receiver<()>>) -> bool {
    let ended = ended.lock().unwrap_or_else(PoisonError::into_inner);
    matches!(ended.recv_timeout(LOOK), Err(RecvTimeoutError::Timeout))
}

/// Ctrl-C as an exception of ours, which is a `KeyboardInterrupt` too.
fn interrupted(py: Python<'_>, error: PyErr) -> PyErr {
    if !error.is_instance_of::<PyKeyboardInterrupt>(py) {
        return error;
    }
    let ours = Interrupted::new_err("the calculation was stopped before its end");
    ours.set_cause(py, Some(error));
    ours
}
