//! Which address answers what. There is no logic here besides HTTP.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use bytes::Bytes;
use http_body_util::{BodyExt, Limited};
use hyper::body::Incoming;
use hyper::header::{CONTENT_DISPOSITION, CONTENT_TYPE, HeaderValue, LOCATION};
use hyper::{Method, StatusCode};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::assets::asset;
use crate::guard::Guard;
use crate::jobs::Jobs;
use crate::reply::{
    Answered, Content, Refusal, Status, document, not_allowed, nothing, refused, response, value,
};
use crate::slots::{Slot, Slots};
use crate::uploads::Uploads;
use crate::{Cancel, Edit, Events, History, Program, Request, Shape};

/// Largest JSON body: 1 MiB.
pub const MAX_BODY_BYTES: usize = 1 << 20;

/// How long a JSON body may take to arrive.
const BODY_TIME: Duration = Duration::from_secs(30);

/// Requests that are answered at the same time, besides jobs.
const MAX_LIVE: usize = 32;

/// What every request needs.
pub(crate) struct Site {
    pub(crate) program: Program,
    pub(crate) guard: Guard,
    pub(crate) uploads: Uploads,
    pub(crate) slots: Slots,
    pub(crate) jobs: Jobs,
    /// Where the results of jobs are kept; `None`: beside the uploads.
    pub(crate) folder: Option<PathBuf>,
    pub(crate) room: tokio::sync::Semaphore,
}

impl Site {
    pub(crate) fn new(
        program: Program,
        guard: Guard,
        folder: Option<PathBuf>,
    ) -> std::io::Result<Self> {
        Ok(Self {
            program,
            guard,
            uploads: Uploads::new()?,
            slots: Slots::default(),
            jobs: Jobs::default(),
            folder,
            room: tokio::sync::Semaphore::new(MAX_LIVE),
        })
    }
}

/// A body of `POST /api/v1/run`, `/asked` and `/jobs`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Asked {
    command: String,
    #[serde(default)]
    options: Map<String, Value>,
    #[serde(default)]
    files: BTreeMap<String, Ids>,
    #[serde(default)]
    history: History,
    #[serde(default)]
    shape: Shape,
    #[serde(default)]
    slot: Option<String>,
    /// The tab that asks: the newest request of a slot counts within it.
    #[serde(default)]
    tab: String,
    #[serde(default)]
    edits: Vec<Edit>,
    /// The job that this one continues.
    #[serde(default)]
    continues: Option<String>,
}

/// One file or several.
#[derive(Deserialize, Serialize)]
#[serde(untagged)]
enum Ids {
    One(String),
    Several(Vec<String>),
}

/// The answer to one request.
pub(crate) async fn answer(site: Arc<Site>, request: hyper::Request<Incoming>) -> Answered {
    match routed(site, request).await {
        Ok(answer) => answer,
        Err(refusal) => refused(&refusal),
    }
}

async fn routed(site: Arc<Site>, request: hyper::Request<Incoming>) -> Result<Answered, Refusal> {
    site.guard.check_origin(&request)?;
    let path = request.uri().path().to_owned();
    if let Some(once) = path.strip_prefix("/open/") {
        return opened(&site.guard, once);
    }
    if path != "/api" && !path.starts_with("/api/") {
        return match (request.method(), asset(&path, request.headers())) {
            (&Method::GET | &Method::HEAD, Some(answer)) => Ok(answer),
            (_, Some(_)) => Ok(not_allowed("GET, HEAD")),
            (_, None) => Err(unknown()),
        };
    }
    site.guard.check_token(&request)?;
    let parts: Vec<&str> = path.trim_start_matches("/api/").split('/').collect();
    match (request.method(), parts.as_slice()) {
        (&Method::GET, ["v1", "facts"]) => Ok(value(StatusCode::OK, &(site.program.facts)())),
        (_, ["v1", "facts"]) => Ok(not_allowed("GET")),
        (&Method::POST, ["v1", "files"]) => {
            let files = site.uploads.receive(request, &site.program).await?;
            Ok(value(StatusCode::OK, &json!({ "files": files })))
        }
        (&Method::POST, ["v1", "run"]) => live(site, body(request).await?).await,
        (&Method::POST, ["v1", "asked"]) => {
            let mut asked: Asked = body(request).await?;
            asked.files.remove(BESIDE);
            let typed = (site.program.typed)(&understood(&site, asked, None)?)?;
            Ok(value(StatusCode::OK, &typed))
        }
        (&Method::POST, ["v1", "surface"]) => surface(&site, body(request).await?).await,
        (&Method::POST, ["v1", "quantities"]) => {
            let read = (site.program.read)(body(request).await?)?;
            Ok(value(StatusCode::OK, &read))
        }
        (&Method::POST, ["v1", "jobs"]) => job(&site, body(request).await?).await,
        (
            _,
            [
                "v1",
                "files" | "run" | "asked" | "surface" | "quantities" | "jobs",
            ],
        ) => Ok(not_allowed("POST")),
        (&Method::DELETE, ["v1", "jobs", id]) => {
            site.jobs.find(id)?.cancel.cancel();
            Ok(nothing())
        }
        (_, ["v1", "jobs", _]) => Ok(not_allowed("DELETE")),
        (&Method::GET, ["v1", "jobs", id, "events"]) => {
            let last = request
                .headers()
                .get("last-event-id")
                .and_then(|text| text.to_str().ok()?.parse().ok());
            let events = site.jobs.find(id)?.follow(last.unwrap_or(0));
            Ok(response(
                StatusCode::OK,
                "text/event-stream",
                Content::Stream(events),
            ))
        }
        (_, ["v1", "jobs", _, "events"]) => Ok(not_allowed("GET")),
        // A file may be in a folder of the results.
        (&Method::GET, ["v1", "jobs", id, "files", name @ ..]) => {
            download(&site, id, &name.join("/")).await
        }
        (_, ["v1", "jobs", _, "files", ..]) => Ok(not_allowed("GET")),
        _ => Err(unknown()),
    }
}

/// Sends whoever opens the page for the first time on to it, with the token behind the `#`.
fn opened(guard: &Guard, once: &str) -> Result<Answered, Refusal> {
    let used = || {
        let hint = "open the address that freestand serve printed";
        Refusal::new(
            Status::NotFound,
            "token",
            "this address opens the page only once",
            hint,
        )
    };
    let token = guard.open(once).ok_or_else(used)?;
    let place = HeaderValue::from_str(&format!("/#{}", token.text())).map_err(|_| used())?;
    let mut answer = response(
        StatusCode::SEE_OTHER,
        "text/plain; charset=utf-8",
        Content::Whole(None),
    );
    answer.headers_mut().insert(LOCATION, place);
    Ok(answer)
}

fn unknown() -> Refusal {
    Refusal::new(
        Status::NotFound,
        "missing",
        "there is nothing at this address",
        "open the page at /",
    )
}

/// The JSON body of a request.
async fn body<T: DeserializeOwned>(request: hyper::Request<Incoming>) -> Result<T, Refusal> {
    let of_type = request
        .headers()
        .get(CONTENT_TYPE)
        .and_then(|text| text.to_str().ok())
        .unwrap_or_default();
    let is_json = of_type
        .split(';')
        .next()
        .is_some_and(|one| one.trim().eq_ignore_ascii_case("application/json"));
    if !is_json {
        let hint = "send the request as application/json";
        return Err(Refusal::new(
            Status::UnsupportedType,
            "type",
            "the request is not JSON",
            hint,
        ));
    }
    let too_large = || {
        let hint = "upload large data as files";
        Refusal::new(
            Status::TooLarge,
            "size",
            "the request is larger than 1 MiB",
            hint,
        )
    };
    let length = request
        .headers()
        .get(hyper::header::CONTENT_LENGTH)
        .and_then(|text| text.to_str().ok());
    if length
        .and_then(|text| text.parse::<u64>().ok())
        .is_some_and(|bytes| bytes > MAX_BODY_BYTES as u64)
    {
        return Err(too_large());
    }
    let whole = Limited::new(request.into_body(), MAX_BODY_BYTES).collect();
    let bytes: Bytes = match tokio::time::timeout(BODY_TIME, whole).await {
        Ok(Ok(whole)) => whole.to_bytes(),
        Ok(Err(error)) if error.is::<http_body_util::LengthLimitError>() => return Err(too_large()),
        Ok(Err(error)) => return Err(wrong(format!("the request cannot be read: {error}"))),
        Err(_) => return Err(wrong("the request did not arrive in 30 s".to_owned())),
    };
    // The reader would take a list for the fields in their order, and count them.
    if !bytes.trim_ascii_start().starts_with(b"{") {
        return Err(wrong("the request is not a JSON object".to_owned()));
    }
    serde_json::from_slice(&bytes)
        .map_err(|error| wrong(format!("the request cannot be understood: {error}")))
}

fn wrong(message: String) -> Refusal {
    let hint = "a request is {\"command\": …, \"options\": {…}, \"files\": {…}}";
    Refusal::new(Status::BadInput, "value", message, hint)
}

/// Under this name a request has the files that others of its files name, such as the records of a
/// study.
const BESIDE: &str = "beside";

/// The request of a body, with the paths of its files. A file can name those of the same request
/// alone: together they have a folder where there is something beside, and otherwise each has its own.
fn understood(site: &Site, asked: Asked, folder: Option<PathBuf>) -> Result<Request, Refusal> {
    let listed = asked.files.into_iter().map(|(flag, ids)| match ids {
        Ids::One(id) => (flag, vec![id]),
        Ids::Several(ids) => (flag, ids),
    });
    let listed: Vec<(String, Vec<String>)> = listed.collect();
    let mut all: Vec<&str> = listed
        .iter()
        .flat_map(|(_, ids)| ids)
        .map(String::as_str)
        .collect();
    all.sort_unstable();
    all.dedup();
    let together = match listed.iter().any(|(flag, _)| flag == BESIDE) {
        true => site.uploads.together(&all)?,
        false => Vec::new(),
    };
    let path = |id: &String| match all
        .iter()
        .position(|own| own == id)
        .and_then(|at| together.get(at))
    {
        Some(path) => Ok(path.clone()),
        None => site.uploads.path(id),
    };
    let named = listed.iter().filter(|(flag, _)| flag != BESIDE);
    let paths = named.map(|(flag, ids)| {
        Ok((
            flag.clone(),
            ids.iter().map(path).collect::<Result<_, Refusal>>()?,
        ))
    });
    let files = paths.collect::<Result<_, Refusal>>()?;
    let Asked {
        command,
        options,
        history,
        shape,
        edits,
        ..
    } = asked;
    Ok(Request {
        command,
        options,
        files,
        history,
        shape,
        edits,
        folder,
    })
}

/// Cancels the work of a request when the request is left: this future is dropped as soon as its
/// client has gone.
#[derive(Default)]
struct Left {
    cancel: Cancel,
}

impl Drop for Left {
    fn drop(&mut self) {
        self.cancel.cancel();
    }
}

/// An answer at once.
async fn live(site: Arc<Site>, asked: Asked) -> Result<Answered, Refusal> {
    if asked.continues.is_some() {
        return Err(wrong("only a job continues another".to_owned()));
    }
    let Ok(room) = site.room.try_acquire() else {
        let message = format!("{MAX_LIVE} requests are being answered already");
        return Err(Refusal::new(
            Status::TooMany,
            "busy",
            message,
            "wait for one of them",
        ));
    };
    let slot = asked.slot.as_ref().map(|name| Slot {
        tab: asked.tab.clone(),
        name: name.clone(),
    });
    let request = understood(&site, asked, None)?;
    let entered = site.jobs.live.enter();
    let program = site.program;
    let mut left = Left::default();
    let run = |cancel: Cancel| {
        left.cancel = cancel.clone();
        tokio::task::spawn_blocking(move || {
            let answer = (program.answer)(&request, &cancel, &Events::default());
            drop(entered);
            answer
        })
    };
    let answered = match slot {
        None => run(Cancel::default()).await,
        Some(slot) => {
            let taken = site.slots.take(&slot);
            let (number, mut superseded) = (taken.number(), taken.superseded);
            let mut work = run(taken.cancel);
            // Both are polled: whichever is first.
            let first = std::future::poll_fn(|context| {
                use std::future::Future;
                use std::pin::Pin;
                use std::task::Poll;
                if Pin::new(&mut superseded).poll(context).is_ready_ok() {
                    return Poll::Ready(None);
                }
                Pin::new(&mut work).poll(context).map(Some)
            })
            .await;
            site.slots.leave(&slot, number);
            match first {
                None => return Err(Refusal::superseded()),
                Some(answered) => answered,
            }
        }
    };
    drop((room, left));
    match answered {
        Ok(answer) => Ok(document(StatusCode::OK, answer?.document)),
        Err(_) => Err(defect()),
    }
}

/// The triangles of an object, as bytes.
async fn surface(site: &Site, asked: Asked) -> Result<Answered, Refusal> {
    let request = understood(site, asked, None)?;
    let made = site.program.surface;
    let bytes = tokio::task::spawn_blocking(move || made(&request)).await;
    let bytes = bytes.map_err(|_| defect())??;
    let content = Content::Whole(Some(bytes.into()));
    Ok(response(
        StatusCode::OK,
        "application/octet-stream",
        content,
    ))
}

/// Whether a channel has received something, rather than being closed.
trait ReadyOk {
    fn is_ready_ok(&self) -> bool;
}

impl<T, E> ReadyOk for std::task::Poll<Result<T, E>> {
    fn is_ready_ok(&self) -> bool {
        matches!(self, std::task::Poll::Ready(Ok(_)))
    }
}

/// The work has panicked.
fn defect() -> Refusal {
    let hint = "this is a defect of freestand; please report it with what you entered";
    Refusal::new(
        Status::Defect,
        "defect",
        "the calculation ended unexpectedly",
        hint,
    )
}

/// What makes two jobs the same work: everything that decides the content of its files. Whether it
/// goes on where an earlier one stopped does not.
fn work_of(asked: &Asked) -> Value {
    const GOES_ON: &str = "resume";
    let options: Map<String, Value> = asked
        .options
        .iter()
        .filter(|(name, _)| *name != GOES_ON)
        .map(|(name, value)| (name.clone(), value.clone()))
        .collect();
    let edits: Vec<_> = asked
        .edits
        .iter()
        .map(|edit| (&edit.cell, &edit.value))
        .collect();
    json!({"command": asked.command, "options": options, "files": asked.files, "edits": edits})
}

/// Starts a job. One that cannot be begun is refused at once.
async fn job(site: &Arc<Site>, asked: Asked) -> Result<Answered, Refusal> {
    let continues = asked.continues.clone();
    let same = work_of(&asked);
    let mut request = understood(site, asked, None)?;
    let program = site.program;
    let checked =
        tokio::task::spawn_blocking(move || (program.check)(&request).map(|()| request)).await;
    request = checked.map_err(|_| defect())??;
    let results = site.folder.as_deref().unwrap_or(site.uploads.folder());
    let job = site.jobs.begin(continues.as_deref(), same, results)?;
    request.folder = Some(job.folder.clone());
    let id = job.id.clone();
    tokio::spawn(async move {
        let (events, cancel) = (job.events(), job.cancel.clone());
        let work =
            tokio::task::spawn_blocking(move || (program.answer)(&request, &cancel, &events));
        job.end(work.await.unwrap_or_else(|_| Err(defect())));
    });
    Ok(value(StatusCode::ACCEPTED, &json!({ "id": id })))
}

/// A file of a job, by its name in the list of the job.
async fn download(site: &Site, id: &str, name: &str) -> Result<Answered, Refusal> {
    let missing = || {
        Refusal::new(
            Status::NotFound,
            "missing",
            "the job has no such file",
            "see its list of files",
        )
    };
    let path = site.jobs.find(id)?.file(name).ok_or_else(missing)?;
    let read = tokio::task::spawn_blocking(move || std::fs::read(path)).await;
    let bytes = read.ok().and_then(Result::ok).ok_or_else(missing)?;
    let of_type = match name.rsplit_once('.').map(|(_, end)| end) {
        Some("csv") => "text/csv; charset=utf-8",
        Some("html") => "text/html; charset=utf-8",
        Some("json") => "application/json",
        Some("svg") => "image/svg+xml",
        Some("xlsx") => "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet",
        _ => "application/octet-stream",
    };
    let mut answer = response(StatusCode::OK, of_type, Content::Whole(Some(bytes.into())));
    let own = name.rsplit('/').next().unwrap_or(name);
    let disposition =
        HeaderValue::from_str(&format!("attachment; filename=\"{own}\"")).map_err(|_| missing())?;
    answer
        .headers_mut()
        .insert(CONTENT_DISPOSITION, disposition);
    Ok(answer)
}
