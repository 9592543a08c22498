//! How the page asks for commands: a request is the line that a person would type, read by the same
//! parser, with files by the numbers of uploads instead of paths.

use std::any::TypeId;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock};

use clap::{Arg, Command, CommandFactory, FromArgMatches};
use freestand_assess::inventory::{Edit, ReadOptions, inspect_inventory};
use freestand_assess::library::Libraries;
use freestand_assess::one_object::{Follow, Memory};
use freestand_input::keys::{KeyStyle, Words};
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::word_reader::WordReader;
use freestand_page::{Cancel, Events, History, Kind, Program, Refusal, Reply, Request, Shape, Status};
use freestand_study::places::places;
use freestand_study::recorded::{MotionFiles, read_all};
use freestand_study::resolve::{Overrides, load};
use serde_json::{Map, Value, json};

use crate::commands::Cli;
use crate::failure::{self, Failure};
use crate::printer::{Printer, hint_of};
use crate::session::{Kept, Session, Told};
use crate::stop::Stop;
use crate::values::finished;

/// What the page's server knows of this program.
pub(super) const PROGRAM: Program = Program { facts, kind, check, answer };

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
const OF_THE_SHELL: [&str; 8] = ["json", "out", "quiet", "verbose", "threads", "force", "help", "version"];

/// Motions of the last grounds and buildings that were asked for.
static MEMORY: LazyLock<Arc<Memory>> = LazyLock::new(Arc::default);

/// What the page shows before anything is asked.
fn facts() -> Value {
    let place = |place: &freestand_study::places::Place| serde_json::to_value(place.facts()).unwrap_or(Value::Null);
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "commands": COMMANDS,
        "places": places().iter().map(place).collect::<Vec<_>>(),
        "sites": sites(),
        "pictures": PICTURES.iter().map(Picture::value).collect::<Vec<_>>(),
        "limits": {
            "file_bytes": 64 << 20, "files_bytes": 256 << 20, "request_bytes": 1 << 20, "jobs": 4,
            "histories": 1_000_000,
        },
        "examples": [
            {"command": "object", "options": {
                "place": "Melbourne", "floor": "roof", "storeys": 30, "height": "1.8 m", "thickness": "400 mm",
                "mass": "150 kg", "on": "4380 N/mm"}},
        ],
    })
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
    Picture { id, height_m, thickness_m }
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
    let end = path.extension().map(|end| end.to_string_lossy().to_lowercase()).unwrap_or_default();
    if end == "toml" {
        return Kind::Study;
    }
    let is_list = Libraries::with_files(None, None)
        .and_then(|libraries| libraries.looked_up(|lookup| inspect_inventory(path, &ReadOptions::new(lookup))))
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
        ..MotionFiles::read(&mut WordReader::new(&words), Path::new(""))
    };
    if read_all(&files).is_ok() { Kind::Record } else { Kind::Unknown }
}

/// What is wrong with a request, as far as that is known before any work: with its words, and with
/// its study.
fn check(request: &Request) -> Result<(), Refusal> {
    let seen = Seen::new(request);
    let read = || -> Result<(), Failure> {
        parsed(request)?;
        let studies = request.files.iter().filter(|(flag, _)| flag == "study").flat_map(|(_, paths)| paths);
        for study in studies {
            load(study, &Overrides::default())?;
        }
        Ok(())
    };
    read().map_err(|failure| seen.refusal(&failure))
}

fn answer(request: &Request, cancel: &Cancel, events: &Events) -> Result<Reply, Refusal> {
    let seen = Seen::new(request);
    let run = || -> Result<Reply, Failure> {
        let cli = parsed(request)?;
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
        let session = Arc::new(session.in_columns(request.shape == Shape::Columns));
        let done = cli.command.run(&cli.global, &Printer::keeping(Arc::clone(&session)));
        let kept = session.take();
        match done {
            Ok(_) | Err(Failure::StoppedAfterWriting) => written(request, kept, &seen),
            Err(failure) => Err(failure),
        }
    };
    run().map_err(|failure| seen.refusal(&failure))
}

/// The document, with what goes beside it.
fn written(request: &Request, kept: Kept, seen: &Seen) -> Result<Reply, Failure> {
    let Kept { document, beside, files, is_interrupted, is_in_columns } = kept;
    let is_turned = request.shape == Shape::Columns && !is_in_columns;
    let text = String::from_utf8(document).map_err(|_| Failure::computation("the document is not UTF-8"))?;
    let mut text = seen.named(&text);
    if !beside.is_empty() || is_turned {
        let unread = |error: serde_json::Error| Failure::computation(format!("the document is not JSON: {error}"));
        let mut document: Map<String, Value> = serde_json::from_str(&text).map_err(unread)?;
        if is_turned && let Some(rows) = document.get_mut("rows") {
            *rows = columns(rows);
        }
        document.extend(beside);
        text = Value::Object(document).to_string();
    }
    Ok(Reply { document: text, files, is_stopped: is_interrupted })
}

/// Rows as one array for each column.
fn columns(rows: &Value) -> Value {
    let Some(list) = rows.as_array() else { return rows.clone() };
    let mut columns: Map<String, Value> = Map::new();
    for (place, row) in list.iter().enumerate() {
        for (name, value) in row.as_object().into_iter().flatten() {
            let column = columns.entry(name.clone()).or_insert_with(|| Value::Array(vec![Value::Null; place]));
            if let Some(column) = column.as_array_mut() {
                column.resize(place, Value::Null);
                column.push(value.clone());
            }
        }
    }
    for column in columns.values_mut() {
        if let Some(column) = column.as_array_mut() {
            column.resize(list.len(), Value::Null);
        }
    }
    Value::Object(columns)
}

/// The arguments that a person would type.
fn parsed(request: &Request) -> Result<Cli, Failure> {
    if !COMMANDS.contains(&request.command.as_str()) {
        let message = format!("the page cannot ask for {:?}", request.command);
        return Err(Failure::usage(message, format!("commands: {}", COMMANDS.join(", "))));
    }
    let mut whole = finished(Cli::command());
    whole.build();
    let command = request.command.split(' ').try_fold(&whole, |command, name| command.find_subcommand(name));
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
            return Err(Failure::usage(message, "leave it out; files are uploaded and named by their ids in `files`"));
        }
        for text in texts(name, value)? {
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
            return Err(Failure::usage(format!("--{name} names no file that is read"), "put its value into `options`"));
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
            Edit::new(&edit.cell, &edit.value).map_err(|problem| problem.named("edit"))?;
        }
        let edits = request.edits.iter().map(|edit| format!("--edit={}={}", edit.cell, edit.value).into());
        arguments.extend(edits);
    }
    if !positional.is_empty() {
        arguments.push("--".into());
        arguments.extend(positional);
    }
    let matches = whole.try_get_matches_from(arguments).map_err(|error| failure::usage(&error))?;
    Cli::from_arg_matches(&matches).map_err(|error| failure::usage(&error))
}

/// What people call the files of a command that takes them without a flag.
const FILES: [&str; 7] = ["file", "files", "motion", "motions", "record", "records", "inventory"];

/// An option by its long flag, or an argument without a flag by its name in the usage line: `word`,
/// `files`.
fn option<'a>(command: &'a Command, request: &Request, name: &str) -> Result<&'a Arg, Failure> {
    let is_flag = |arg: &&Arg| arg.get_long() == Some(name);
    let is_argument = |arg: &&Arg| {
        let shown = arg.get_value_names().unwrap_or_default();
        let is_named = arg.get_id() == name || shown.iter().any(|shown| shown.eq_ignore_ascii_case(name));
        arg.is_positional() && (is_named || names_a_file(arg) && FILES.contains(&name))
    };
    let found = command.get_arguments().find(is_flag).or_else(|| command.get_arguments().find(is_argument));
    found.ok_or_else(|| {
        let message = format!("{} has no option --{name}", request.command);
        Failure::usage(message, format!("see freestand {} --help", request.command))
    })
}

/// Whether the value of an argument is the path of a file or a folder, or contains one.
fn names_a_file(arg: &Arg) -> bool {
    let is_path = arg.get_value_parser().type_id() == TypeId::of::<PathBuf>();
    let names = arg.get_value_names().unwrap_or_default();
    is_path || names.iter().any(|name| ["FILE", "DIR", "PATH", ".toml", ".csv"].iter().any(|end| name.contains(end)))
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
            let all: Vec<Vec<Option<String>>> = all.iter().map(|one| texts(name, one)).collect::<Result<_, _>>()?;
            all.concat()
        }
        Value::Object(_) => {
            return Err(Failure::usage(format!("--{name} is a table"), "give a text, a number, true, or a list"));
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
            let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            (path.to_string_lossy().into_owned(), name)
        };
        // A file that such a file names, and that is not there.
        let folder = |path: &PathBuf| Some((format!("{}/", path.parent()?.to_string_lossy()), String::new()));
        Self(paths.map(named).chain(files().filter_map(folder)).collect())
    }

    /// A text with names in place of paths.
    fn named(&self, text: &str) -> String {
        self.0.iter().fold(text.to_owned(), |text, (path, name)| text.replace(path, name))
    }

    fn refusal(&self, failure: &Failure) -> Refusal {
        let problems = match failure {
            Failure::Problems(problems) => problems.as_slice(),
            Failure::Stopped { .. }
            | Failure::StoppedAfterWriting
            | Failure::StoppedKeepingRuns
            | Failure::StoppedInShard
            | Failure::BrokenPipe => &[],
        };
        let mut all = problems.iter().map(|problem| self.of_problem(problem));
        let Some(mut first) = all.next() else {
            return Refusal { kind: "stopped", ..Refusal::superseded() };
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
        let flag = message.strip_prefix("--").and_then(|rest| rest.split([':', ' ']).next()).map(str::to_owned);
        let key = problem.keys.first().map(|key| KeyStyle::Flag.name(key).trim_start_matches('-').to_owned());
        Refusal {
            key: key.or(flag).map(String::into_boxed_str),
            file: problem.path.as_ref().map(|path| self.named(&path.to_string_lossy()).into_boxed_str()),
            line: problem.line.and_then(|line| u32::try_from(line).ok()),
            ..Refusal::new(Status::BadInput, kind, message, shown(hint_of(problem)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn request(command: &str, options: Value) -> Request {
        let options = options.as_object().cloned().unwrap_or_default();
        Request { command: command.to_owned(), options, ..Request::default() }
    }

    fn asked(request: &Request) -> Result<Value, Refusal> {
        answer(request, &Cancel::default(), &Events::default())
            .map(|reply| serde_json::from_str(&reply.document).unwrap())
    }

    #[test]
    fn options_that_name_files_are_refused() {
        let mut refused = 0;
        let mut whole = finished(Cli::command());
        whole.build();
        for name in COMMANDS {
            let command = name.split(' ').try_fold(&whole, |command, name| command.find_subcommand(name)).unwrap();
            for flag in command.get_arguments().filter_map(Arg::get_long) {
                let is_path = ["out", "csv", "history", "plot", "cushion", "study", "library", "spectrum"];
                if is_path.contains(&flag) {
                    let error = asked(&request(name, json!({flag: "/etc/passwd"}))).unwrap_err();
                    assert!(error.message.contains("names a file"), "{name} --{flag}: {}", error.message);
                    refused += 1;
                }
            }
        }
        assert!(refused > 20);
        for name in ["run", "serve", "check", "motion simulate", "inventory template", "", "object --out=x", "motion"] {
            assert!(asked(&request(name, json!({}))).unwrap_err().message.contains("cannot ask"), "{name}");
        }
        for option in ["json", "threads", "quiet", "force", "help", "out"] {
            assert!(asked(&request("validate", json!({option: true}))).is_err(), "{option}");
        }
        // A value is never taken for a flag: it is looked for as a word.
        let found = asked(&request("tolerance search", json!({"words": ["--library=/etc/passwd"]}))).unwrap();
        assert_eq!(found["entries"], json!([]));
    }

    #[test]
    fn the_messages_are_those_of_the_command_line() {
        let error = asked(&request("shock", json!({"height": "2 apples", "thickness": "0.5 m", "mass": "100 kg"})));
        let error = error.unwrap_err();
        assert_eq!((error.key.as_deref(), error.status), (Some("height"), Status::BadInput));
        assert!(error.message.starts_with("--height: "), "{}", error.message);
        let error = asked(&request("shock", json!({"depth": 1}))).unwrap_err();
        assert!(error.message.contains("no option --depth"), "{}", error.message);
    }

    #[test]
    fn an_edit_changes_the_cell_that_it_names_only() {
        for (cell, value) in [("C2=5\nD2", "1"), ("C2=5", "1"), ("C2", "5\nD2=1")] {
            let edits = vec![freestand_page::Edit { cell: cell.to_owned(), value: value.to_owned() }];
            let error = asked(&Request { edits, ..request("inventory check", json!({})) }).unwrap_err();
            assert_eq!(error.key.as_deref(), Some("edit"), "{cell:?}: {}", error.message);
        }
    }

    /// Nobody waits so long for a live answer, and a job may take its time.
    #[test]
    fn a_live_shock_spectrum_has_a_bound() {
        let pulse = |frequencies: &str| json!({"pulse": "half-sine", "peak-acceleration": "30 g", "duration": "11 ms", "frequencies": frequencies});
        let error = asked(&request("shock-spectrum", pulse("1 Hz:1e6 Hz:1000000"))).unwrap_err();
        assert!(error.message.contains("frequencies") && error.status == Status::BadInput, "{}", error.message);
        assert!(asked(&request("shock-spectrum", pulse("20 Hz, 45 Hz"))).is_ok());
    }

    #[test]
    fn a_history_is_thinned_and_rises() {
        let options = json!({"height": "1.5 m", "thickness": "0.3 m", "initial-rotation": "5 deg", "duration": "5 s",
            "mass": "100 kg", "stiffness": "4000 N/mm"});
        let mut one = request("rock", options);
        let plain = asked(&one).unwrap();
        one.history = History::Any(true);
        let mut drawn = asked(&one).unwrap();
        let history = drawn.as_object_mut().unwrap().shift_remove("history").unwrap();
        assert_eq!(plain, drawn);
        let numbers = |name: &str| -> Vec<f64> {
            history[name].as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect()
        };
        let (times, angles) = (numbers("time_s"), numbers("theta_rad"));
        assert_eq!(times.len(), angles.len());
        assert!(times.windows(2).all(|two| two[0] < two[1]));
        let impacts = history["impacts"].as_array().unwrap();
        assert_eq!(impacts.len(), plain["impact_count"].as_u64().unwrap() as usize);
        assert!(impacts[0]["edge_acceleration_g"].as_f64().unwrap() > 0.0);
        // It is released leaning to the right, so its left edge lands first.
        assert_eq!(impacts[0]["edge"], "left");
        assert!(impacts.iter().all(|impact| times.contains(&impact["time_s"].as_f64().unwrap())));
    }

    /// What a command writes in columns is what its rows become.
    #[test]
    fn columns_have_the_numbers_of_the_rows() {
        let options = json!({"place": "Melbourne", "count": 2, "storeys": 3, "level-ratio": 1, "heights": "1 m, 2 m",
            "thicknesses": "300 mm, 400 mm, 500 mm", "mass": "100 kg", "stiffness": "4000 N/mm"});
        let mut one = request("spectrum", options);
        let rows = asked(&one).unwrap();
        one.shape = Shape::Columns;
        let turned = asked(&one).unwrap();
        assert_eq!(turned["rows"]["outcome"].as_array().unwrap().len(), 12);
        assert_eq!(columns(&rows["rows"]), turned["rows"]);
        assert_eq!(rows["processing"], turned["processing"]);
        one.history = History::Of { motion: "synthetic-02".to_owned() };
        assert!(asked(&one).unwrap_err().message.contains("one object"));
        one.options.insert("heights".to_owned(), json!("2 m"));
        one.options.insert("thicknesses".to_owned(), json!("300 mm"));
        let cell = asked(&one).unwrap();
        assert_eq!((&cell["followed"], &cell["history"]["height_m"]), (&json!("synthetic-02"), &json!(2.0)));
        assert_eq!(cell["rows"]["uplift_m"][1], turned["rows"]["uplift_m"][9]);
    }

    #[test]
    fn rows_become_columns() {
        let rows = json!([{"a": 1, "b": 2}, {"a": 3}, {"a": 4, "c": 5}]);
        assert_eq!(columns(&rows), json!({"a": [1, 3, 4], "b": [2, null, null], "c": [null, null, 5]}));
    }
}
