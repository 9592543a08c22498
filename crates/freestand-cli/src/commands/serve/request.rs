//! How the page asks for commands: a request is the line that a person would type, read by the same
//! parser, with files by the numbers of uploads instead of paths.

use std::any::TypeId;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock};

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, Command, CommandFactory, FromArgMatches};
use freestand_app::check_list::CheckList;
use freestand_app::code_spectrum::CodeSpectrum;
use freestand_app::drop_test::DropTests;
use freestand_app::files::{Content, Files, Sent};
use freestand_app::floor::Floor;
use freestand_app::motion::{MotionConvert, MotionInfo, MotionSpectrum};
use freestand_app::object::Object;
use freestand_app::request::from_entries;
use freestand_app::restrain::Restrain;
use freestand_app::rock::Rock;
use freestand_app::shock::Shock;
use freestand_app::shock_spectrum::ShockSpectrum;
use freestand_app::spectrum::Spectrum;
use freestand_app::static_test::StaticTests;
use freestand_app::tolerance::ToleranceSearch;
use freestand_app::validate::Validate;
use freestand_assess::inventory::{COLUMNS, Edit, ReadOptions, inspect_inventory, template_csv};
use freestand_assess::library::{Libraries, ToleranceLibrary};
use freestand_assess::one_object::{Follow, Memory};
use freestand_input::file::as_named;
use freestand_input::keys::{KeyStyle, Words};
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::word_reader::WordReader;
use freestand_page::{
    Cancel, Events, History, Kind, MAX_BODY_BYTES, MAX_FILE_BYTES, MAX_RUNNING, MAX_TOTAL_BYTES,
    Program, Refusal, Reply, Request, Shape, Status, columns,
};
use freestand_study::places::places;
use freestand_study::recorded::{MotionFiles, Upward, read_all};
use freestand_study::resolve::{Overrides, load};
use serde_json::{Map, Value, json};
use tempfile::TempDir;

use crate::args::GlobalArgs;
use crate::commands::{Cli, Done, Tell};
use crate::failure::{self, Failure};
use crate::printer::{Printer, hint_of};
use crate::session::{Kept, MAX_HISTORIES, RowsWanted, Session, Told};
use crate::stop::Stop;
use crate::values::finished;

/// What the page's server knows of this program.
pub(super) const PROGRAM: Program = Program {
    facts,
    kind,
    check,
    answer,
};

/// The commands that the page may ask for.
const COMMANDS: [&str; 17] = [
    "object",
    "shock",
    "rock",
    "spectrum",
    "shock-spectrum",
    "motion info",
    "motion spectrum",
    "motion convert",
    "motion code-spectrum",
    "floor",
    "cushion drop",
    "cushion static",
    "inventory check",
    "assess",
    "restrain",
    "tolerance search",
    "validate",
];

/// Options that belong to the shell: they say how it prints, writes and works.
const OF_THE_SHELL: [&str; 8] = [
    "json", "out", "quiet", "verbose", "threads", "force", "help", "version",
];

/// Motions of the last grounds and buildings that were asked for.
static MEMORY: LazyLock<Arc<Memory>> = LazyLock::new(Arc::default);

/// What the page shows before anything is asked.
fn facts() -> Value {
    let place = |place: &freestand_study::places::Place| {
        serde_json::to_value(place.facts()).unwrap_or(Value::Null)
    };
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "commands": COMMANDS,
        "places": places().iter().map(place).collect::<Vec<_>>(),
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
    let is_list = Libraries::with_files(None, None)
        .and_then(|libraries| {
            libraries.looked_up(|lookup| inspect_inventory(path, &ReadOptions::new(lookup)))
        })
        .is_ok();
    if is_list {
        return Kind::Inventory;
    }
    let head: String = std::fs::read(path)
        .map(|bytes| String::from_utf8_lossy(bytes.get(..2048).unwrap_or(&bytes)).to_lowercase())
        .unwrap_or_default();
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
    let read = || -> Result<(), Wrong> {
        if let Some(command) = by_struct(request) {
            return (command.check)(request);
        }
        parsed(request)?;
        let studies = request
            .files
            .iter()
            .filter(|(flag, _)| flag == "study")
            .flat_map(|(_, paths)| paths);
        for study in studies {
            load(study, &Overrides::default())?;
        }
        Ok(())
    };
    read().map_err(|wrong| seen.refusal(&wrong))
}

fn answer(request: &Request, cancel: &Cancel, events: &Events) -> Result<Reply, Refusal> {
    let seen = Seen::new(request);
    let run = || -> Result<Reply, Wrong> {
        let follow = match &request.history {
            History::Of { motion } => Some(Follow::Named(motion.clone())),
            other => other.is_wanted().then_some(Follow::Telling),
        };
        let events = events.clone();
        let tell = move |told| match told {
            Told::Progress { phase, done, total } => {
                events.progress(phase, done, total);
                events.give_way();
            }
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
        let global = GlobalArgs::of_request(request.folder.clone());
        let done = match by_struct(request) {
            Some(command) => (command.tell)(request, &global, &printer),
            None => {
                let mut cli = parsed(request)?;
                let scratch = scratch(request, &mut cli)?;
                let done = cli.command.run(&cli.global, &printer);
                drop(scratch);
                done.map_err(Wrong::from)
            }
        };
        let kept = session.take();
        match done {
            Ok(_)
            | Err(Wrong {
                failure: Failure::StoppedAfterWriting,
                ..
            }) => Ok(reply(request, kept, &seen)?),
            Err(wrong) => Err(wrong),
        }
    };
    run().map_err(|wrong| seen.refusal(&wrong))
}

/// A command that is asked by a struct.
struct ByStruct {
    name: &'static str,
    check: fn(&Request) -> Result<(), Wrong>,
    tell: fn(&Request, &GlobalArgs, &Printer) -> Result<Done, Wrong>,
}

/// The commands that are asked by structs; the others by the line that a person would type.
const BY_STRUCTS: [ByStruct; 16] = [
    ByStruct::of::<Floor>("floor"),
    ByStruct::of::<CodeSpectrum>("motion code-spectrum"),
    ByStruct::of::<MotionConvert>("motion convert"),
    ByStruct::of::<MotionInfo>("motion info"),
    ByStruct::of::<MotionSpectrum>("motion spectrum"),
    ByStruct::of::<CheckList>("inventory check"),
    ByStruct::of::<ToleranceSearch>("tolerance search"),
    ByStruct::of::<Validate>("validate"),
    ByStruct::of::<Object>("object"),
    ByStruct::of::<Restrain>("restrain"),
    ByStruct::of::<DropTests>("cushion drop"),
    ByStruct::of::<StaticTests>("cushion static"),
    ByStruct::of::<Rock>("rock"),
    ByStruct::of::<Shock>("shock"),
    ByStruct::of::<ShockSpectrum>("shock-spectrum"),
    ByStruct::of::<Spectrum>("spectrum"),
];

impl ByStruct {
    const fn of<Q: Tell>(name: &'static str) -> Self {
        Self {
            name,
            check: |request| {
                let (entries, files) = written(request)?;
                Ok(from_entries::<Q>(&entries)?.check(&files)?)
            },
            tell: |request, global, printer| {
                let (entries, files) = written(request)?;
                let meant = from_entries::<Q>(&entries)?.resolve(&files)?;
                Ok(Q::tell(meant, &Q::Output::default(), global, printer)?)
            },
        }
    }
}

fn by_struct(request: &Request) -> Option<&'static ByStruct> {
    BY_STRUCTS.iter().find(|one| one.name == request.command)
}

/// What was written, and the files that were sent with it: it names no others.
fn written(request: &Request) -> Result<(Map<String, Value>, Files), Wrong> {
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
            let failure = Failure::usage(message, "keep one of them");
            return Err(Wrong::option(key, failure));
        }
    }
    if !request.edits.is_empty() {
        // In one text with its value, a wrong name of a cell could pass for another cell.
        let edits = request.edits.iter();
        let edits = edits.map(|edit| json!([edit.cell, edit.value]));
        entries.insert("edit".into(), edits.collect());
    }
    Ok((entries, Files::Sent(sent)))
}

/// A folder for the files of a live request that writes some, which nobody will read: without it they
/// would land in the folder in which the server was started.
fn scratch(request: &Request, cli: &mut Cli) -> Result<Option<TempDir>, Failure> {
    if request.folder.is_some() || !cli.command.writes_a_folder() {
        return Ok(None);
    }
    let unmade = |error: std::io::Error| {
        Problem::new(
            ProblemKind::Io,
            format!("a folder for temporary files cannot be made: {error}"),
        )
        .hint("check that the folder for temporary files can be written and has room")
    };
    let folder = TempDir::with_prefix("freestand-live-").map_err(unmade)?;
    cli.global.out = Some(folder.path().join("results"));
    Ok(Some(folder))
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

/// The arguments that a person would type.
fn parsed(request: &Request) -> Result<Cli, Wrong> {
    if !COMMANDS.contains(&request.command.as_str()) {
        let message = format!("the page cannot ask for {:?}", request.command);
        return Err(Failure::usage(message, format!("commands: {}", COMMANDS.join(", "))).into());
    }
    let mut whole = finished(Cli::command());
    whole.build();
    let command = request
        .command
        .split(' ')
        .try_fold(&whole, |command, name| command.find_subcommand(name));
    let command = command.ok_or_else(|| Failure::computation("the command is not there"))?;
    let mut arguments: Vec<OsString> = vec!["freestand".into(), "--json".into()];
    if let Some(folder) = &request.folder {
        let mut out = OsString::from("--out=");
        out.push(folder);
        arguments.push(out);
    }
    arguments.extend(request.command.split(' ').map(OsString::from));
    let mut positional: Vec<OsString> = Vec::new();
    for (name, value) in &request.options {
        let arg = option(command, request, name)?;
        if names_a_file(arg) || OF_THE_SHELL.contains(&name.as_str()) {
            let message = format!("--{name} names a file or belongs to the command line");
            let hint = "leave it out; files are uploaded and named by their ids in `files`";
            return Err(Wrong::option(name, Failure::usage(message, hint)));
        }
        for text in texts(name, value).map_err(|failure| Wrong::option(name, failure))? {
            match (arg.is_positional(), text) {
                (true, Some(text)) => positional.push(text.into()),
                (false, Some(text)) => arguments.push(format!("--{name}={text}").into()),
                (_, None) => arguments.push(format!("--{name}").into()),
            }
        }
    }
    for (name, paths) in &request.files {
        let arg = option(command, request, name)?;
        if !names_a_file(arg) || is_written(arg) {
            let failure = Failure::usage(
                format!("--{name} names no file that is read"),
                "put its value into `options`",
            );
            return Err(Wrong::option(name, failure));
        }
        for path in paths {
            match arg.is_positional() {
                true => positional.push(path.into()),
                false => {
                    let mut argument = OsString::from(format!("--{name}="));
                    argument.push(path);
                    arguments.push(argument);
                }
            }
        }
    }
    if !request.edits.is_empty() {
        option(command, request, "edit")?;
        // In one text with its value, a wrong name of a cell could pass for another cell.
        for edit in &request.edits {
            Edit::new(&edit.cell, &edit.value)
                .map_err(|problem| Failure::from(problem.named("edit")))?;
        }
        let edits = request
            .edits
            .iter()
            .map(|edit| format!("--edit={}={}", edit.cell, edit.value).into());
        arguments.extend(edits);
    }
    if !positional.is_empty() {
        arguments.push("--".into());
        arguments.extend(positional);
    }
    let matches = whole.clone().try_get_matches_from(arguments);
    matches
        .and_then(|matches| Cli::from_arg_matches(&matches))
        .map_err(|error| Wrong {
            key: blamed(command, &error),
            failure: refused_by_parser(&error),
        })
}

/// Why a request fails, with the option of the request that is wrong, if it is one.
struct Wrong {
    key: Option<String>,
    failure: Failure,
}

impl Wrong {
    fn option(name: &str, failure: Failure) -> Self {
        Self {
            key: Some(name.to_owned()),
            failure,
        }
    }
}

impl<T: Into<Failure>> From<T> for Wrong {
    fn from(failure: T) -> Self {
        Self {
            key: None,
            failure: failure.into(),
        }
    }
}

/// What the parser refuses, for who has filled in a field: no usage line, and no words of a programmer.
fn refused_by_parser(error: &clap::Error) -> Failure {
    let text = |kind| match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text.as_str()),
        Some(ContextValue::Strings(several)) => several.first().map(String::as_str),
        _ => None,
    };
    let Some(shown) = text(ContextKind::InvalidArg) else {
        return failure::usage(error);
    };
    let name = shown.split([' ', '=']).next().unwrap_or(shown);
    match (error.kind(), text(ContextKind::InvalidValue)) {
        (ErrorKind::MissingRequiredArgument, _) => {
            Failure::usage(format!("{name} is missing"), "enter it")
        }
        (ErrorKind::ValueValidation, Some(value)) => {
            let why = std::error::Error::source(error)
                .map(ToString::to_string)
                .unwrap_or_default();
            let bounds = why
                .split_once(" is not in ")
                .and_then(|(_, range)| range.split_once("..="));
            let (message, hint) = match bounds {
                Some((low, high)) => (
                    format!("{name}: {value:?} is not from {low} to {high}"),
                    format!("enter {low} to {high}"),
                ),
                None => (
                    format!("{name}: {value:?} is not a whole number"),
                    "enter a whole number".to_owned(),
                ),
            };
            Failure::usage(message, hint)
        }
        _ => failure::usage(error),
    }
}

/// The option that an error of the parser is about: the parser shows each as it does in its usage.
fn blamed(command: &Command, error: &clap::Error) -> Option<String> {
    let shown = match error.get(ContextKind::InvalidArg)? {
        ContextValue::String(shown) => shown,
        ContextValue::Strings(several) => several.first()?,
        _ => return None,
    };
    let arg = command
        .get_arguments()
        .find(|arg| arg.to_string() == *shown)?;
    Some(
        arg.get_long()
            .unwrap_or_else(|| arg.get_id().as_str())
            .to_owned(),
    )
}

/// What people call the files of a command that takes them without a flag.
const FILES: [&str; 7] = [
    "file",
    "files",
    "motion",
    "motions",
    "record",
    "records",
    "inventory",
];

/// An option by its long flag, or an argument without a flag by its name in the usage line: `word`,
/// `files`.
fn option<'a>(command: &'a Command, request: &Request, name: &str) -> Result<&'a Arg, Wrong> {
    let is_flag = |arg: &&Arg| arg.get_long() == Some(name);
    let is_argument = |arg: &&Arg| {
        let shown = arg.get_value_names().unwrap_or_default();
        let is_named =
            arg.get_id() == name || shown.iter().any(|shown| shown.eq_ignore_ascii_case(name));
        arg.is_positional() && (is_named || names_a_file(arg) && FILES.contains(&name))
    };
    let found = command
        .get_arguments()
        .find(is_flag)
        .or_else(|| command.get_arguments().find(is_argument));
    found.ok_or_else(|| {
        let message = format!("{} has no option --{name}", request.command);
        Wrong::option(
            name,
            Failure::usage(message, format!("see freestand {} --help", request.command)),
        )
    })
}

/// Whether the value of an argument is the path of a file or a folder, or contains one.
fn names_a_file(arg: &Arg) -> bool {
    let is_path = arg.get_value_parser().type_id() == TypeId::of::<PathBuf>();
    let names = arg.get_value_names().unwrap_or_default();
    is_path
        || names.iter().any(|name| {
            ["FILE", "DIR", "PATH", ".toml", ".csv"]
                .iter()
                .any(|end| name.contains(end))
        })
}

/// Whether a file of this argument is written, not read.
fn is_written(arg: &Arg) -> bool {
    let flag = arg.get_long().unwrap_or_default();
    ["out", "csv", "history", "plot", "write-columns"].contains(&flag)
}

/// The values of an option; `None`: the flag alone.
fn texts(name: &str, value: &Value) -> Result<Vec<Option<String>>, Failure> {
    Ok(match value {
        Value::Null | Value::Bool(false) => Vec::new(),
        Value::Bool(true) => vec![None],
        Value::String(text) => vec![Some(text.clone())],
        Value::Number(number) => vec![Some(number.to_string())],
        Value::Array(all) => {
            let all: Vec<Vec<Option<String>>> = all
                .iter()
                .map(|one| texts(name, one))
                .collect::<Result<_, _>>()?;
            all.concat()
        }
        Value::Object(_) => {
            return Err(Failure::usage(
                format!("--{name} is a table"),
                "give a text, a number, true, or a list",
            ));
        }
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

    fn refusal(&self, wrong: &Wrong) -> Refusal {
        let problems = match &wrong.failure {
            Failure::Problems(problems) => problems.as_slice(),
            Failure::Stopped { .. }
            | Failure::StoppedAfterWriting
            | Failure::StoppedKeepingRuns
            | Failure::StoppedInShard
            | Failure::BrokenPipe => &[],
        };
        let mut all = problems.iter().map(|problem| self.of_problem(problem));
        let Some(mut first) = all.next() else {
            return Refusal {
                kind: "stopped",
                ..Refusal::superseded()
            };
        };
        first.others = all.collect();
        if let Some(key) = &wrong.key {
            first.key = Some(key.as_str().into());
        }
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
