//! How the page asks for commands: a request is the values of a struct by their keys, with files by the
//! numbers of uploads instead of paths.

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock};

use freestand_app::assess::Assess;
use freestand_app::check_list::CheckList;
use freestand_app::code_spectrum::CodeSpectrum;
use freestand_app::drop_test::DropTests;
use freestand_app::entered::Entered;
use freestand_app::files::{Content, Files, Sent, is_mesh};
use freestand_app::floor::Floor;
use freestand_app::library::{Search, Tolerances};
use freestand_app::motion::{MotionConvert, MotionInfo, MotionSpectrum};
use freestand_app::object::Object;
use freestand_app::places::{PlaceList, PlaceShow};
use freestand_app::request::from_entries;
use freestand_app::restrain::Restrain;
use freestand_app::rock::Rock;
use freestand_app::shock::Shock;
use freestand_app::shock_spectrum::ShockSpectrum;
use freestand_app::spectrum::Spectrum;
use freestand_app::static_test::StaticTests;
use freestand_app::typed::{self, Typed};
use freestand_app::validate::Validate;
use freestand_assess::one_object::{Follow, Memory};
use freestand_input::file::as_named;
use freestand_input::keys::{KeyStyle, Words};
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::word_reader::WordReader;
use freestand_inventory::library::{Libraries, ToleranceLibrary};
use freestand_inventory::{COLUMNS, ReadOptions, inspect_inventory, template_csv};
use freestand_page::{
    Cancel, Events, History, Kind, MAX_BODY_BYTES, MAX_FILE_BYTES, MAX_RUNNING, MAX_TOTAL_BYTES,
    Program, Refusal, Reply, Request, Shape, Status, columns,
};
use freestand_records::tables::hazard;
use freestand_study::hull::Surface;
use freestand_study::places::{Place, places};
use freestand_study::recorded::{MotionFiles, Upward, read_all};
use serde_json::{Map, Value, json};
use tempfile::TempDir;

use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::{Failure, Left};
use crate::printer::{Printer, hint_of};
use crate::session::{Kept, MAX_HISTORIES, RowsWanted, Session, Told};
use crate::stop::Stop;

/// What the page's server knows of this program.
pub(super) const PROGRAM: Program = Program {
    facts,
    kind,
    check,
    typed,
    read,
    surface,
    answer,
};

/// Motions of the last grounds and buildings that were asked for.
static MEMORY: LazyLock<Arc<Memory>> = LazyLock::new(Arc::default);

/// Each place under a name that finds it and no other.
fn named_places() -> Vec<Value> {
    let mut told = HashSet::new();
    let named = |place: &Place| {
        let is_found = Place::find(&place.name).is_some_and(|found| found == *place);
        let name = if is_found {
            place.name.to_string()
        } else {
            place.full_name()
        };
        let finds_it = is_found || Place::find(&name).is_some_and(|found| found == *place);
        (finds_it && told.insert(name.clone())).then(|| {
            json!({
                "name": name, "region": Some(place.region).filter(|region| !region.is_empty()), "country": place.country,
                "code": place.hazard.code(), "confidence": place.confidence.name(),
            })
        })
    };
    places().iter().filter_map(named).collect()
}

/// What the page shows before anything is asked.
fn facts() -> Value {
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "commands": COMMANDS.map(|command| command.name),
        "places": named_places(),
        "sites": sites(),
        "withstands": withstands(),
        "columns": COLUMNS.iter().map(|column| column.name).collect::<Vec<_>>(),
        "template": template_csv().map(|text| String::from_utf8_lossy(&text).into_owned()).unwrap_or_default(),
        "pictures": PICTURES.iter().map(Picture::value).collect::<Vec<_>>(),
        "limits": {
            "file_bytes": MAX_FILE_BYTES, "files_bytes": MAX_TOTAL_BYTES, "request_bytes": MAX_BODY_BYTES,
            "jobs": MAX_RUNNING, "histories": MAX_HISTORIES,
        },
        "examples": [
            {"command": "object", "options": {
                "place": "Melbourne", "floor": "roof", "storeys": 30, "height": "1.8 m", "thickness": "400 mm"}},
        ],
    })
}

/// Entries of the tolerance library that say to everybody what a shock of so many g is.
const KNOWN: [&str; 8] = [
    "rack-server-operating",
    "network-ups-tape-operating",
    "expansion-card-operating",
    "museum-fragile",
    "accelerator-module-operating",
    "hdd-35-operating",
    "rack-server-non-operating",
    "hdd-35-non-operating",
];

/// What some objects withstand.
fn withstands() -> Value {
    let library = ToleranceLibrary::builtin();
    let known = KNOWN.iter().filter_map(|id| library.find(id));
    let facts = known.map(|entry| {
        json!({
            "class": entry.class, "state": <&str>::from(entry.state), "peak_g": entry.peak_g,
            "confidence": entry.confidence.name(),
        })
    });
    facts.collect()
}

/// The site classes of each code, as its option --site takes them.
fn sites() -> Value {
    json!({
        "as1170.4": ["Ae", "Be", "Ce", "De", "Ee"],
        "nzs1170.5": ["A", "B", "C", "D", "E"],
        "eurocode8": ["A", "B", "C", "D", "E"],
        "asce7": ["A", "B", "C", "D", "E"],
        "ntc2018": ["A", "B", "C", "D", "E"],
        "tbdy2018": ["ZA", "ZB", "ZC", "ZD", "ZE"],
        "ts1170.5": ["I", "II", "III", "IV", "V", "VI"],
    })
}

/// An object to start from: usual sizes, to be replaced by measured ones.
struct Picture {
    id: &'static str,
    height_m: f64,
    thickness_m: f64,
}

impl Picture {
    fn value(&self) -> Value {
        json!({"id": self.id, "height_m": self.height_m, "thickness_m": self.thickness_m})
    }
}

const fn picture(id: &'static str, height_m: f64, thickness_m: f64) -> Picture {
    Picture {
        id,
        height_m,
        thickness_m,
    }
}

const PICTURES: [Picture; 10] = [
    picture("cabinet", 1.8, 0.4),
    picture("rack", 2.0, 0.6),
    picture("refrigerator", 1.9, 0.7),
    picture("shelving", 2.1, 0.3),
    picture("gas-bottle", 1.5, 0.225),
    picture("display-case", 1.2, 0.5),
    picture("vase", 0.6, 0.25),
    picture("control-panel", 1.7, 0.5),
    picture("bookcase", 2.0, 0.3),
    picture("statue", 2.2, 0.55),
];

/// What an uploaded file seems to be, by its content.
fn kind(path: &Path) -> Kind {
    let end = path
        .extension()
        .map(|end| end.to_string_lossy().to_lowercase())
        .unwrap_or_default();
    if end == "toml" {
        return Kind::Study;
    }
    let content = std::fs::read(path).unwrap_or_default();
    if is_mesh(&content) {
        return Kind::Scan;
    }
    if hazard::recognised(&content).is_some() {
        return Kind::Hazard;
    }
    let is_list = Libraries::with_files(None, None)
        .and_then(|libraries| {
            libraries.looked_up(|lookup| inspect_inventory(path, &ReadOptions::new(lookup)))
        })
        .is_ok();
    if is_list {
        return Kind::Inventory;
    }
    let head = content.get(..2048).unwrap_or(&content);
    let head = String::from_utf8_lossy(head).to_lowercase();
    if ["csv", "txt", "tsv"].contains(&end.as_str()) && head.contains("force") {
        return Kind::DropTest;
    }
    let words = Words::default();
    let files = MotionFiles {
        paths: vec![path.to_path_buf()],
        vertical: Upward::Itself("component"),
        ..MotionFiles::read(&mut WordReader::new(&words), as_named)
    };
    if read_all(&files).is_ok() {
        Kind::Record
    } else {
        Kind::Unknown
    }
}

/// What is wrong with a request, as far as that is known before any work: with its words, and with
/// its study.
fn check(request: &Request) -> Result<(), Refusal> {
    let seen = Seen::new(request);
    let check = || (asked(request)?.check)(request);
    check().map_err(|failure| seen.refusal(&failure))
}

/// A request as a person types it, with the names of files in place of their paths.
fn typed(request: &Request) -> Result<Value, Refusal> {
    let seen = Seen::new(request);
    let mut entries = request.options.clone();
    for (key, paths) in &request.files {
        let names = paths.iter().filter_map(|path| path.file_name());
        entries.insert(
            key.clone(),
            names.map(|name| name.to_string_lossy()).collect(),
        );
    }
    if !request.edits.is_empty() {
        let edits = request.edits.iter();
        let edits = edits.map(|edit| format!("{}={}", edit.cell, edit.value));
        entries.insert("edit".into(), edits.collect());
    }
    let typed = asked(request).and_then(|command| (command.typed)(command.name, &entries));
    typed
        .map(|typed| json!(typed))
        .map_err(|failure| seen.refusal(&failure))
}

/// The triangles of an object as bytes: the numbers of vertices and of triangles, the coordinates of each vertex \[m\],
/// the numbers of the vertices of each triangle; whole numbers and coordinates have 4 bytes, the lowest first.
fn surface(request: &Request) -> Result<Vec<u8>, Refusal> {
    let seen = Seen::new(request);
    let found = || -> Result<Surface, Failure> {
        if request.command != "object" {
            let hint = "ask for the surface of an object";
            return Err(Failure::usage("only `object` has a surface", hint));
        }
        let (entries, files) = written(request)?;
        let surface = from_entries::<Object>(&entries)?.surface(&files)?;
        Ok(surface.ok_or_else(|| {
            let hint = "name a scan or a shape in three dimensions";
            Problem::value("the object is drawn in a plane", hint)
        })?)
    };
    let Surface { vertices_m, faces } = found().map_err(|failure| seen.refusal(&failure))?;
    let counts = [vertices_m.len() as u32, faces.len() as u32];
    let whole = counts.iter().chain(faces.as_flattened());
    let mut whole = whole.map(|one| one.to_le_bytes());
    let counts: Vec<[u8; 4]> = whole.by_ref().take(2).collect();
    let places = vertices_m.as_flattened().iter().map(|x| x.to_le_bytes());
    Ok(counts
        .into_iter()
        .chain(places)
        .chain(whole)
        .flatten()
        .collect())
}

/// The texts of a form, `{"texts": [{"text", "quantity", "units"}]}`, as the program reads them.
fn read(mut body: Value) -> Result<Value, Refusal> {
    let texts = body.get_mut("texts").map(Value::take).unwrap_or_default();
    let texts: Vec<Entered> = serde_json::from_value(texts).map_err(|error| {
        let hint = "send {\"texts\": [{\"text\": …, \"quantity\": …, \"units\": …}]}";
        Refusal::new(Status::BadInput, "value", error.to_string(), hint)
    })?;
    let read: Vec<_> = texts.iter().map(Entered::read).collect();
    Ok(json!({ "read": read }))
}

fn answer(request: &Request, cancel: &Cancel, events: &Events) -> Result<Reply, Refusal> {
    let seen = Seen::new(request);
    let run = || -> Result<Reply, Failure> {
        let command = asked(request)?;
        let follow = match &request.history {
            History::Of { motion } => Some(Follow::Named(motion.clone())),
            other => other.is_wanted().then_some(Follow::Telling),
        };
        let events = events.clone();
        let tell = move |told| match told {
            Told::Progress {
                phase,
                done,
                total,
                share,
            } => {
                events.progress(phase, done, total, share);
                events.give_way();
            }
            Told::Estimate(row) => events.estimate(&row),
            Told::Object(row) => events.object(&row),
            Told::Problem(problem) => events.problem(&problem),
        };
        let session = Session::new(
            Stop::on(cancel.flag()),
            (follow, request.folder.is_none()),
            Arc::clone(&MEMORY),
            Box::new(tell),
        );
        let rows = match request.shape {
            Shape::Rows => RowsWanted::InDocument,
            Shape::Columns => RowsWanted::InColumns,
            Shape::Events => RowsWanted::Told,
        };
        let session = Arc::new(session.with_rows(rows));
        let printer = Printer::keeping(Arc::clone(&session));
        let is_unnamed = command.writes_a_folder && request.folder.is_none();
        let scratch = is_unnamed.then(scratch).transpose()?;
        let unnamed = scratch.as_ref().map(|folder| folder.path().join("results"));
        let global = GlobalArgs::of_request(request.folder.clone().or(unnamed));
        match (command.tell)(request, &global, &printer) {
            Ok(_) | Err(Failure::Stopped(Left::Written)) => reply(request, session.take(), &seen),
            Err(failure) => Err(failure),
        }
    };
    run().map_err(|failure| seen.refusal(&failure))
}

/// A command that the page may ask for.
struct Asked {
    name: &'static str,
    check: fn(&Request) -> Result<(), Failure>,
    typed: fn(&str, &Map<String, Value>) -> Result<Typed, Failure>,
    tell: fn(&Request, &GlobalArgs, &Printer) -> Result<Done, Failure>,
    /// Whether it writes a folder even if none is named.
    writes_a_folder: bool,
}

const COMMANDS: [Asked; 19] = [
    Asked::by::<Object>("object"),
    Asked::by::<Shock>("shock"),
    Asked::by::<Rock>("rock"),
    Asked::by::<Spectrum>("spectrum"),
    Asked::by::<ShockSpectrum>("shock-spectrum"),
    Asked::by::<MotionInfo>("motion info"),
    Asked::by::<MotionSpectrum>("motion spectrum"),
    Asked::by::<MotionConvert>("motion convert"),
    Asked::by::<CodeSpectrum>("motion code-spectrum"),
    Asked::by::<Floor>("floor"),
    Asked::by::<DropTests>("cushion drop"),
    Asked::by::<StaticTests>("cushion static"),
    Asked::by::<CheckList>("inventory check"),
    Asked::by::<Assess>("assess"),
    Asked::by::<Restrain>("restrain"),
    Asked::by::<Search<Tolerances>>("tolerance search"),
    Asked::by::<PlaceList>("place list"),
    Asked::by::<PlaceShow>("place show"),
    Asked::by::<Validate>("validate"),
];

impl Asked {
    const fn by<Q: Tell>(name: &'static str) -> Self {
        Self {
            name,
            check: |request| {
                let (entries, files) = written(request)?;
                Ok(from_entries::<Q>(&entries)?.check(&files)?)
            },
            typed: |name, entries| Ok(typed::typed::<Q>(name, &from_entries(entries)?)),
            tell: |request, global, printer| {
                let (entries, files) = written(request)?;
                let meant = from_entries::<Q>(&entries)?.resolve(&files)?;
                Q::tell(meant, &Q::Output::default(), global, printer)
            },
            writes_a_folder: Q::WRITES_A_FOLDER,
        }
    }
}

fn asked(request: &Request) -> Result<&'static Asked, Failure> {
    let found = COMMANDS.iter().find(|one| one.name == request.command);
    found.ok_or_else(|| {
        let message = format!("the page cannot ask for {:?}", request.command);
        let names = COMMANDS.map(|command| command.name);
        Failure::usage(message, format!("commands: {}", names.join(", ")))
    })
}

/// What was written, and the files that were sent with it: it names no others.
fn written(request: &Request) -> Result<(Map<String, Value>, Files), Problem> {
    let mut entries = request.options.clone();
    let mut sent: Vec<Sent> = Vec::new();
    for (key, paths) in request.files.iter().filter(|(_, paths)| !paths.is_empty()) {
        let mut names: Vec<Value> = Vec::new();
        for path in paths {
            let mut name = path
                .file_name()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned();
            if sent.iter().any(|other| other.name == name) {
                name = format!("{}: {name}", sent.len() + 1);
            }
            names.push(name.clone().into());
            sent.push(Sent {
                name,
                content: Content::At(path.clone()),
            });
        }
        let named = match names.as_slice() {
            [one] => one.clone(),
            _ => names.into(),
        };
        if entries.insert(key.clone(), named).is_some() {
            let message = format!("{key} is given as a value and as a file");
            return Err(Problem::value(message, "keep one of them").of_key(key.clone()));
        }
    }
    if !request.edits.is_empty() {
        // In one text with its value, a wrong name of a cell could pass for another cell.
        let edits = request.edits.iter();
        let edits = edits.map(|edit| json!([edit.cell, edit.value]));
        if entries.insert("edit".into(), edits.collect()).is_some() {
            let message = "`edit` is given as an option and as `edits`";
            return Err(Problem::value(message, "keep one of them").of(&["edit"]));
        }
    }
    Ok((entries, Files::Sent(sent)))
}

/// A folder for the files of a live request that writes some, which nobody will read: without it they
/// would land in the folder in which the server was started.
fn scratch() -> Result<TempDir, Problem> {
    TempDir::with_prefix("freestand-live-").map_err(|error| {
        Problem::new(
            ProblemKind::Io,
            format!("a folder for temporary files cannot be made: {error}"),
        )
        .hint("check that the folder for temporary files can be written and has room")
    })
}

/// The document, with what goes beside it.
fn reply(request: &Request, kept: Kept, seen: &Seen) -> Result<Reply, Failure> {
    let Kept {
        document,
        beside,
        files,
        is_interrupted,
        is_in_columns,
    } = kept;
    let is_turned = request.shape == Shape::Columns && !is_in_columns;
    let text = String::from_utf8(document)
        .map_err(|_| Failure::computation("the document is not UTF-8"))?;
    let mut text = seen.named(&text);
    if !beside.is_empty() || is_turned {
        let unread = |error: serde_json::Error| {
            Failure::computation(format!("the document is not JSON: {error}"))
        };
        let mut document: Map<String, Value> = serde_json::from_str(&text).map_err(unread)?;
        if is_turned && let Some(rows) = document.get_mut("rows") {
            *rows = columns(rows);
        }
        document.extend(beside);
        text = Value::Object(document).to_string();
    }
    Ok(Reply {
        document: text,
        files,
        is_stopped: is_interrupted,
    })
}

/// The files of a request: their paths are the server's, their names the user's.
struct Seen(Vec<(String, String)>);

impl Seen {
    fn new(request: &Request) -> Self {
        let files = || request.files.iter().flat_map(|(_, paths)| paths);
        let paths = files().chain(&request.folder);
        let named = |path: &PathBuf| {
            let name = path
                .file_name()
                .map(|name| name.to_string_lossy().into_owned())
                .unwrap_or_default();
            (path.to_string_lossy().into_owned(), name)
        };
        // A file that such a file names, and that is not there.
        let folder = |path: &PathBuf| {
            Some((
                format!("{}/", path.parent()?.to_string_lossy()),
                String::new(),
            ))
        };
        Self(paths.map(named).chain(files().filter_map(folder)).collect())
    }

    /// A text with names in place of paths.
    fn named(&self, text: &str) -> String {
        self.0.iter().fold(text.to_owned(), |text, (path, name)| {
            text.replace(path, name)
        })
    }

    fn refusal(&self, failure: &Failure) -> Refusal {
        let problems = match failure {
            Failure::Problems(problems) => problems.as_slice(),
            Failure::Stopped(_) | Failure::BrokenPipe => &[],
        };
        let mut all = problems.iter().map(|problem| self.of_problem(problem));
        let Some(mut first) = all.next() else {
            return Refusal {
                kind: "stopped",
                ..Refusal::superseded()
            };
        };
        first.others = all.collect();
        first
    }

    fn of_problem(&self, problem: &Problem) -> Refusal {
        let kind = match problem.kind {
            ProblemKind::Io => "io",
            ProblemKind::Format => "format",
            ProblemKind::Value => "value",
            ProblemKind::Missing => "missing",
            ProblemKind::Computation => "computation",
            ProblemKind::Stopped => "stopped",
        };
        let shown = |text: &str| self.named(&KeyStyle::Flag.shown(text));
        let message = shown(&problem.message);
        // A flag is named at the beginning of what is said about its value.
        let flag = message
            .strip_prefix("--")
            .and_then(|rest| rest.split([':', ' ']).next())
            .map(str::to_owned);
        let hint = shown(hint_of(problem));
        let key = problem
            .keys
            .first()
            .map(|key| KeyStyle::Flag.name(key).trim_start_matches('-').to_owned());
        Refusal {
            key: key.or(flag).map(String::into_boxed_str),
            file: problem
                .path
                .as_ref()
                .map(|path| self.named(&path.to_string_lossy()).into_boxed_str()),
            line: problem.line.and_then(|line| u32::try_from(line).ok()),
            ..Refusal::new(Status::BadInput, kind, message, hint)
        }
    }
}
