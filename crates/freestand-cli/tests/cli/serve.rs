//! `freestand serve` as it is called: the line that it prints, the documents of commands, its end.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};

use serde_json::{Value, json};

use crate::program::{PROGRAM, root};

pub(crate) struct Page {
    pub(super) child: Child,
    pub(super) port: u64,
    pub(super) token: String,
}

impl Page {
    pub(crate) fn open() -> Self {
        Self::open_with(|command| command)
    }

    pub(super) fn open_with(prepare: impl FnOnce(&mut Command) -> &mut Command) -> Self {
        let mut command = Command::new(PROGRAM);
        command
            .args(["serve", "--json", "--no-open"])
            .stdout(Stdio::piped());
        let mut child = prepare(&mut command).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap())
            .read_line(&mut line)
            .unwrap();
        let line: Value = serde_json::from_str(&line).unwrap();
        let keys: Vec<&str> = line
            .as_object()
            .unwrap()
            .keys()
            .map(String::as_str)
            .collect();
        assert_eq!(
            keys,
            ["schema", "url", "port", "token", "version", "warnings"]
        );
        assert_eq!(line["schema"], "freestand.serve/1");
        let (port, token) = (
            line["port"].as_u64().unwrap(),
            line["token"].as_str().unwrap().to_owned(),
        );
        assert_eq!(line["url"], format!("http://127.0.0.1:{port}/#{token}"));
        Self { child, port, token }
    }

    pub(super) fn post(&self, path: &str, content_type: &str, body: &[u8]) -> (u16, Value) {
        let (status, answer) = self.bytes(path, content_type, body);
        (status, serde_json::from_slice(&answer).unwrap())
    }

    /// The status and the bytes of an answer.
    pub(super) fn bytes(&self, path: &str, content_type: &str, body: &[u8]) -> (u16, Vec<u8>) {
        let mut stream =
            TcpStream::connect(("127.0.0.1", u16::try_from(self.port).unwrap())).unwrap();
        let head = format!(
            "POST {path} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nAuthorization: Bearer {}\r\nContent-Type: {content_type}\r\n\
             Content-Length: {}\r\nConnection: close\r\n\r\n",
            self.port,
            self.token,
            body.len()
        );
        stream.write_all(&[head.as_bytes(), body].concat()).unwrap();
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).unwrap();
        let end = answer.windows(4).position(|four| four == b"\r\n\r\n");
        let (head, body) = answer.split_at(end.unwrap() + 4);
        let status = String::from_utf8_lossy(head)
            .split(' ')
            .nth(1)
            .unwrap()
            .parse();
        (status.unwrap(), body.to_vec())
    }

    /// The whole response, which may be in pieces.
    pub(super) fn get(&self, path: &str) -> Vec<u8> {
        let mut answer = Vec::new();
        self.ask("GET", path).read_to_end(&mut answer).unwrap();
        answer
    }

    /// What the page shows before anything is asked.
    pub(crate) fn facts(&self) -> Value {
        let facts = self.get("/api/v1/facts");
        let start = facts.iter().position(|byte| *byte == b'{').unwrap();
        serde_json::from_slice(&facts[start..]).unwrap()
    }

    pub(super) fn ask(&self, method: &str, path: &str) -> TcpStream {
        let mut stream =
            TcpStream::connect(("127.0.0.1", u16::try_from(self.port).unwrap())).unwrap();
        let head = format!(
            "{method} {path} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nAuthorization: Bearer {}\r\nConnection: close\r\n\r\n",
            self.port, self.token
        );
        stream.write_all(head.as_bytes()).unwrap();
        stream
    }

    pub(crate) fn run(&self, request: &Value) -> (u16, Value) {
        self.post(
            "/api/v1/run",
            "application/json",
            request.to_string().as_bytes(),
        )
    }

    /// A file of a job when it has ended.
    pub(crate) fn job(&self, request: &Value, file: &str) -> String {
        let (status, job) = self.post(
            "/api/v1/jobs",
            "application/json",
            request.to_string().as_bytes(),
        );
        assert_eq!(status, 202, "{job}");
        let at = format!("/api/v1/jobs/{}", job["id"].as_str().unwrap());
        let events = unchunked(&self.get(&format!("{at}/events")));
        assert!(events.contains("event: done\n"), "{events}");
        let answer = String::from_utf8(self.get(&format!("{at}/files/{file}"))).unwrap();
        answer.split_once("\r\n\r\n").unwrap().1.to_owned()
    }

    /// Uploads a file and returns its id.
    pub(crate) fn upload(&self, path: &Path) -> Value {
        let name = path.file_name().unwrap().to_str().unwrap();
        let head = format!(
            "--XX\r\nContent-Disposition: form-data; name=\"f\"; filename=\"{name}\"\r\n\r\n"
        );
        let body = [
            head.as_bytes(),
            &std::fs::read(path).unwrap(),
            b"\r\n--XX--\r\n",
        ]
        .concat();
        let (status, told) = self.post("/api/v1/files", "multipart/form-data; boundary=XX", &body);
        assert_eq!(status, 200, "{told}");
        told["files"][0]["id"].clone()
    }
}

/// A request for a command with these options.
pub(super) fn with_options(command: &str, options: &Value) -> Value {
    json!({"command": command, "options": options})
}

pub(super) fn message(error: &Value) -> &str {
    error["message"].as_str().unwrap()
}

/// A document without what depends on where files are and on the clock.
pub(super) fn comparable(mut value: Value) -> Value {
    pub(super) fn strip(value: &mut Value) {
        match value {
            Value::Object(keys) => {
                for name in ["path", "out", "files", "timing", "source"] {
                    keys.remove(name);
                }
                keys.values_mut().for_each(strip);
            }
            Value::Array(all) => all.iter_mut().for_each(strip),
            _ => {}
        }
    }
    strip(&mut value);
    value
}

/// The same document as the command line, for each kind of command.
#[test]
#[ignore = "ten seconds: every command, twice"]
fn documents_are_those_of_the_command_line() {
    let page = Page::open();
    let root = root();
    let record = root.join("validation/rocking/records/synthfloor.csv");
    let list = root.join("examples/hospital/inventory.csv");
    let drop = root.join("validation/cushion/drop-001.csv");
    let (record_id, list_id, drop_id) =
        (page.upload(&record), page.upload(&list), page.upload(&drop));
    let size = json!({"height": "1.8 m", "thickness": "0.4 m"});
    let with = |more: Value| {
        let mut all = size.as_object().unwrap().clone();
        all.extend(more.as_object().unwrap().clone());
        Value::Object(all)
    };
    let (record, list, drop) = (
        record.to_str().unwrap(),
        list.to_str().unwrap(),
        drop.to_str().unwrap(),
    );
    let motion = (json!({"motion": [record_id]}), vec!["--motion", record]);
    let file = (json!({"file": [record_id]}), vec![record]);
    let none = (json!({}), vec![]);
    let floor = motion.clone();
    let shock = (json!({"file": [drop_id]}), vec![drop]);
    let inventory = (json!({"inventory": [list_id]}), vec!["--inventory", list]);
    let folder = tempfile::tempdir().unwrap();
    let press = folder.path().join("press.csv");
    let rows = (0..=20)
        .map(|i| format!("{},{}\n", i, 4380 * i))
        .collect::<String>();
    std::fs::write(&press, format!("displacement [mm],force [N]\n{rows}")).unwrap();
    let (press_id, press) = (page.upload(&press), press.to_str().unwrap());
    let press = (json!({"file": [press_id]}), vec![press]);
    let wrong = press.clone();
    let cases = [
        (
            "shock",
            with(json!({"mass": "150 kg", "stiffness": "4380 N/mm", "uplift": "30 mm"})),
            none.clone(),
        ),
        (
            "rock",
            with(json!({"scale": 3.5, "mass": "150 kg", "stiffness": "4380 N/mm"})),
            motion.clone(),
        ),
        ("object", with(json!({"scale": 3.5})), motion.clone()),
        (
            "object",
            with(json!({"place": "Wellington", "worlds": 4})),
            none.clone(),
        ),
        (
            "spectrum",
            json!({"heights": "1 m:2 m:4", "thicknesses": "0.2 m, 0.3 m"}),
            motion,
        ),
        ("motion info", json!({}), file.clone()),
        ("motion spectrum", json!({"scale": 2}), file.clone()),
        ("motion convert", json!({"to": "csv"}), file),
        (
            "cushion drop",
            json!({"mass": "0.365 kg", "impact-velocity": "1.40 m/s"}),
            (json!({"files": [drop_id]}), vec![drop]),
        ),
        (
            "inventory check",
            json!({"storeys": 8}),
            (json!({"file": [list_id]}), vec![list]),
        ),
        (
            "restrain",
            with(json!({"mass": "150 kg", "place": "Wellington"})),
            none.clone(),
        ),
        (
            "tolerance search",
            json!({"word": ["cabinet"]}),
            none.clone(),
        ),
        (
            "place list",
            json!({"country": "Türkiye", "near": "41.01, 28.97"}),
            none.clone(),
        ),
        ("place show", json!({"name": "Istanbuul"}), none.clone()),
        ("place show", json!({"name": "41.01, 28.97"}), none.clone()),
        ("validate", json!({}), none.clone()),
        (
            "motion code-spectrum",
            json!({"site": "De", "hazard-factor": 0.08, "periods": "0 s, 0.5 s, 1 s"}),
            none.clone(),
        ),
        (
            "motion code-spectrum",
            json!({"site": "De", "hazard-factor": -1}),
            none.clone(),
        ),
        (
            "shock-spectrum",
            json!({"frequencies": "20 Hz, 45 Hz", "unit": "g"}),
            shock,
        ),
        (
            "shock-spectrum",
            json!({"pulse": "half-sine", "peak-acceleration": "30 g", "duration": "11 ms",
                "frequencies": "20 Hz, 45 Hz"}),
            none.clone(),
        ),
        ("floor", json!({"storeys": 3, "levels": "0.5, 1.0"}), floor),
        ("cushion static", json!({}), press),
        ("cushion static", json!({"load": "three"}), wrong),
        // It answers as a job does; here is what it refuses.
        (
            "assess",
            json!({"storeys": 8, "place": "Atlantis"}),
            inventory,
        ),
    ];
    for command in page.facts()["commands"].as_array().unwrap() {
        assert!(
            cases.iter().any(|(name, ..)| command == name),
            "{command} is compared"
        );
    }
    for (command, options, (files, paths)) in cases {
        let mut line = Command::new(PROGRAM);
        line.args(command.split(' '))
            .args(["--json", "--quiet"])
            .args(&paths);
        for (name, value) in options.as_object().unwrap() {
            match value {
                Value::Array(all) => _ = line.args(all.iter().map(|one| one.as_str().unwrap())),
                // It has no flag.
                Value::String(one) if name == "name" => _ = line.arg(one),
                value => _ = line.arg(format!("--{name}={}", value.to_string().trim_matches('"'))),
            }
        }
        let output = line.output().unwrap();
        let request = json!({"command": command, "options": options, "files": files});
        let (status, answer) = page.run(&request);
        // The page knows files by their names, not by their paths.
        let named = |text: &[u8]| {
            let named =
                |text: String, path: &&str| text.replace(path, path.rsplit('/').next().unwrap());
            paths
                .iter()
                .fold(String::from_utf8_lossy(text).into_owned(), named)
        };
        match serde_json::from_str::<Value>(&named(&output.stdout)) {
            Ok(printed) => {
                assert_eq!(status, 200, "{command}: {answer}");
                assert_eq!(comparable(answer), comparable(printed), "{command}");
            }
            Err(_) => {
                // What the command line refuses is refused with the same words after the name of the
                // field, which is not that of a flag.
                let told = named(&output.stderr);
                let message = answer["error"]["message"].as_str().unwrap_or_default();
                let words = message.rsplit('”').next().unwrap_or_default();
                assert!(
                    status == 400 && !words.is_empty() && told.contains(words),
                    "{command}: {told} / {answer}"
                );
            }
        }
    }
    let (status, answer) =
        page.run(&json!({"command": "shock", "options": {"height": "2 apples"}}));
    assert_eq!(status, 400, "{answer}");
}

/// An uploaded file names files of its own request, and none of this machine; it is not told whether
/// there is one.
#[test]
#[ignore = "seconds: studies from the page"]
fn uploaded_files_name_uploaded_files() {
    let page = Page::open();
    let folder = tempfile::tempdir().unwrap();
    let secret = folder.path().join("secret.csv");
    std::fs::write(
        &secret,
        "id,item,height,thickness\nsecret-1,cabinet,1 m,0.3 m\n",
    )
    .unwrap();
    let list = folder.path().join("list.csv");
    std::fs::write(
        &list,
        "id,item,floor,height,thickness\nopen-1,cabinet,1,1.8 m,0.4 m\n",
    )
    .unwrap();
    let list_id = page.upload(&list);
    let secret_id = page.upload(&secret);
    let study = |text: String| {
        let path = folder.path().join("study.toml");
        std::fs::write(&path, text).unwrap();
        page.upload(&path)
    };
    let job = |request: &Value| {
        page.post(
            "/api/v1/jobs",
            "application/json",
            request.to_string().as_bytes(),
        )
    };
    let refused = |answer: (u16, Value), what: &str| {
        let error = answer.1["error"].clone();
        let told = error.to_string();
        assert_eq!(answer.0, 400, "{what}: {}", answer.1);
        assert!(
            told.contains("is not a file of this request"),
            "{what}: {told}"
        );
        assert!(error["hint"].is_string(), "{what}: {told}");
        assert!(
            !told.contains("secret-1") && !told.contains("freestand-page-"),
            "{what}: {told}"
        );
    };
    let own = secret.to_str().unwrap();
    let in_upload = format!("../{}/list.csv", list_id.as_str().unwrap());
    for named in [
        own,
        "/etc/passwd",
        "/no/such/file",
        "../../../../../etc/passwd",
        "gone.csv",
        &in_upload,
    ] {
        for text in [
            format!("[assessment]\ninventory = \"{named}\"\n"),
            format!("[assessment]\nlibrary = \"{named}\"\n"),
            format!("[assessment]\ncushion_library = \"{named}\"\n"),
            format!("[ground]\nmotions = [\"{named}\"]\n"),
            format!("[ground]\ncode = \"table\"\nspectrum = \"{named}\"\n"),
            format!("[building]\nstorey_table = \"{named}\"\n"),
            format!("[building]\nmode_table = \"{named}\"\n"),
            format!("[objects]\ncushion = \"{named}\"\n"),
            format!("[ground]\nplace = \"Wellington\"\nsuite = \"{named}\"\n"),
        ] {
            let id = study(text.clone());
            // Where a list is given too, that of the study is not read: it is refused all the same.
            for files in [
                json!({"study": [id]}),
                json!({"study": [id], "inventory": [list_id]}),
            ] {
                let request = json!({"command": "assess", "files": files});
                let answer = job(&request);
                // A key that a study does not have in this place is refused before its value is looked at.
                assert!(
                    !answer.1.to_string().contains("unknown key"),
                    "{text}: {}",
                    answer.1
                );
                refused(answer, &text);
            }
            refused(page.run(&json!({"command": "inventory check", "files": {"study": id, "file": [list_id]}})), &text);
        }
    }
    // What was uploaded with it may be named.
    let id = study("[assessment]\ninventory = \"list.csv\"\n".to_owned());
    let beside = json!({"command": "inventory check", "files": {"study": id, "file": [list_id], "beside": [secret_id]}});
    let (status, answer) = page.run(&beside);
    assert_eq!(
        (status, &answer["objects"][0]["id"]),
        (200, &json!("open-1")),
        "{answer}"
    );
    let (status, answer) =
        job(&json!({"command": "assess", "files": {"study": id, "beside": [list_id]}}));
    assert_eq!(status, 202, "{answer}");
    // Words in place of files, and commands that are not for the page.
    for request in [
        json!({"command": "inventory check", "options": {"file": own}}),
        json!({"command": "assess", "options": {"inventory": own}}),
        json!({"command": "assess", "options": {"study": own}}),
        json!({"command": "object", "options": {"motion": own, "height": "1 m", "thickness": "0.3 m"}}),
        json!({"command": "run", "files": {"study": [id]}}),
        json!({"command": "check", "files": {"study": [id]}}),
        json!({"command": "assess", "files": {"study": [own]}}),
    ] {
        let (status, answer) = job(&request);
        assert_eq!(status, 400, "{request}: {answer}");
        assert!(!answer.to_string().contains("secret-1"), "{answer}");
    }
}

/// A server with a folder for results begins after what is already there, and what an answer at once
/// writes goes nowhere: not into the folder of an earlier server, not where the server was started.
#[test]
fn results_of_an_earlier_server_stay() {
    let folder = tempfile::tempdir().unwrap();
    let (start, results) = (folder.path().join("start"), folder.path().join("results"));
    std::fs::create_dir_all(&start).unwrap();
    let list = folder.path().join("list.csv");
    std::fs::write(&list, "id,floor,height,thickness\nA,1,1800 mm,400 mm\n").unwrap();
    let study = folder.path().join("study.toml");
    let text = "[ground]\nplace = \"Wellington\"\n[building]\nstoreys = 3\n[worlds]\nfirst = 2\nmost = 2\n";
    std::fs::write(&study, text).unwrap();
    let mut written = Vec::new();
    for earlier in 0..2 {
        let page =
            Page::open_with(|command| command.current_dir(&start).arg("--folder").arg(&results));
        let files = json!({"study": page.upload(&study), "inventory": [page.upload(&list)]});
        let request = json!({"command": "assess", "files": files, "options": {"seed": earlier}});
        let (status, answer) = page.run(&request);
        assert_eq!(status, 200, "{answer}");
        let (status, job) = page.post(
            "/api/v1/jobs",
            "application/json",
            request.to_string().as_bytes(),
        );
        assert_eq!(
            (status, &job["id"]),
            (202, &json!(format!("job-{}", earlier + 1)))
        );
        page.get(&format!(
            "/api/v1/jobs/{}/events",
            job["id"].as_str().unwrap()
        ));
        written.push(std::fs::read(results.join("job-1/objects.csv")).unwrap());
    }
    assert_eq!(written[0], written[1]);
    assert!(results.join("job-2/objects.csv").exists());
    assert_eq!(std::fs::read_dir(&start).unwrap().count(), 0);
}

/// The document of a job is that of the command line; its objects come one by one, by their rank so
/// far.
#[test]
#[ignore = "ten seconds: an assessment, twice"]
fn an_assessment_is_that_of_the_command_line() {
    let page = Page::open();
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    };
    let rows = (0..40).map(|i| {
        format!(
            "O-{i},cabinet,{},{} mm,400 mm\n",
            i % 3,
            1200 + 30 * (i * 7 % 40)
        )
    });
    let text = format!(
        "id,item,floor,height,thickness\n{}",
        rows.collect::<String>()
    )
    .replacen("400 mm", "4 apples", 1);
    let list = write("list.csv", &text);
    let study = write(
        "study.toml",
        "[ground]\nplace = \"Wellington\"\n[building]\nstoreys = 3\n[worlds]\nfirst = 2\nmost = 2\nshares = false\n",
    );
    let mut request = json!({"command": "assess", "files": {"study": page.upload(&study), "inventory": [page.upload(&list)]}});
    let follow = |request: &Value| {
        let (status, job) = page.post(
            "/api/v1/jobs",
            "application/json",
            request.to_string().as_bytes(),
        );
        assert_eq!(status, 202, "{job}");
        unchunked(&page.get(&format!(
            "/api/v1/jobs/{}/events",
            job["id"].as_str().unwrap()
        )))
    };
    let data = |stream: &str, name: &str| -> Vec<Value> {
        let blocks = stream
            .split("\n\n")
            .filter(|block| block.contains(&format!("event: {name}\n")));
        let data =
            blocks.filter_map(|block| block.lines().find_map(|line| line.strip_prefix("data: ")));
        data.map(|text| serde_json::from_str(text).unwrap())
            .collect()
    };
    let stream = follow(&request);
    let done = data(&stream, "done")[0]["result"].clone();
    let problems: Vec<Value> = data(&stream, "problem")
        .iter()
        .map(|problem| problem["cells"][0].clone())
        .collect();
    assert_eq!(problems, ["E2"]);
    let out = folder.path().join("out");
    let mut line = Command::new(PROGRAM);
    line.arg("assess")
        .arg(&study)
        .arg("--inventory")
        .arg(&list)
        .arg("--out")
        .arg(&out)
        .args(["--json", "--quiet"]);
    let printed = line.output().unwrap();
    assert_eq!(
        comparable(done.clone()),
        comparable(serde_json::from_slice(&printed.stdout).unwrap())
    );
    // Each came once, as it is in the table but for its rank, which counts those before it.
    let (told, rows) = (data(&stream, "object"), done["rows"].as_array().unwrap());
    assert_eq!(told.len(), 40);
    let mut ranked: Vec<Value> = Vec::new();
    for row in told {
        let rank = usize::try_from(row["rank"].as_u64().unwrap()).unwrap();
        ranked.insert(rank - 1, row);
    }
    for (place, row) in ranked.iter_mut().enumerate() {
        row["rank"] = json!(place + 1);
        let last = rows.iter().find(|last| last["id"] == row["id"]).unwrap();
        assert_eq!(row, last);
    }
    // A client that has read the rows as events does not need them again.
    request["shape"] = json!("events");
    let stream = follow(&request);
    let mut short = data(&stream, "done")[0]["result"].clone();
    assert!(
        short["rows"].is_null() && data(&stream, "object").len() == 40,
        "{short}"
    );
    short["rows"] = done["rows"].clone();
    assert_eq!(comparable(short), comparable(done));
}

fn unchunked(response: &[u8]) -> String {
    let start = response
        .windows(4)
        .position(|four| four == b"\r\n\r\n")
        .unwrap()
        + 4;
    let (mut rest, mut whole) = (&response[start..], Vec::new());
    while let Some(at) = rest.windows(2).position(|two| two == b"\r\n") {
        let size = usize::from_str_radix(std::str::from_utf8(&rest[..at]).unwrap(), 16).unwrap();
        if size == 0 {
            break;
        }
        whole.extend(&rest[at + 2..at + 2 + size]);
        rest = &rest[at + 4 + size..];
    }
    String::from_utf8(whole).unwrap()
}

/// A job ends soon after it is cancelled, and what was finished can be read and continued.
#[test]
#[ignore = "ten seconds: an assessment, twice"]
fn a_cancelled_assessment_keeps_what_is_finished() {
    let page = Page::open();
    let folder = tempfile::tempdir().unwrap();
    let list = folder.path().join("list.csv");
    // Far more work than is done until the request to cancel comes, even on a slow machine.
    let rows = (0..3_000)
        .map(|i| format!("O-{i},rack,3,{} mm,500 mm,800,100\n", 1600 + i % 600))
        .collect::<String>();
    let columns = "id,item,floor,height,thickness,mass [kg],stiffness [N/mm]";
    std::fs::write(&list, format!("{columns}\n{rows}")).unwrap();
    let study = folder.path().join("study.toml");
    std::fs::write(
        &study,
        "[building]\nstoreys = 3\n[worlds]\nfirst = 4\nmost = 4\nshares = false\n",
    )
    .unwrap();
    let request = json!({"command": "assess", "files": {"study": page.upload(&study), "inventory": [page.upload(&list)]}});
    let (_, job) = page.post(
        "/api/v1/jobs",
        "application/json",
        request.to_string().as_bytes(),
    );
    let at = format!("/api/v1/jobs/{}", job["id"].as_str().unwrap());
    let mut followed = page.ask("GET", &format!("{at}/events"));
    let mut seen = String::new();
    let mut piece = [0u8; 65536];
    while !seen.contains("event: object") {
        let count = followed.read(&mut piece).unwrap();
        assert!(count > 0, "{seen}");
        seen.push_str(&String::from_utf8_lossy(&piece[..count]));
    }
    // The reply is read: a server may drop the request of a connection that is closed before it.
    page.ask("DELETE", &at)
        .read_to_end(&mut Vec::new())
        .unwrap();
    let mut rest = Vec::new();
    followed.read_to_end(&mut rest).unwrap();
    seen.push_str(&String::from_utf8_lossy(&rest));
    assert!(seen.contains("event: cancelled"), "it ended by itself");
    let table = String::from_utf8_lossy(&page.get(&format!("{at}/files/objects.csv"))).into_owned();
    assert!(table.contains("O-0,"), "{table}");
}

/// A workbook that unpacks to far more than it is costs a message.
#[test]
fn a_workbook_that_unpacks_to_too_much() {
    let page = Page::open();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bomb.xlsx");
    let mut archive = zip::ZipWriter::new(std::fs::File::create(&path).unwrap());
    for name in [
        "[Content_Types].xml",
        "_rels/.rels",
        "xl/workbook.xml",
        "xl/worksheets/sheet1.xml",
    ] {
        archive
            .start_file(name, zip::write::SimpleFileOptions::default())
            .unwrap();
        let blanks = vec![b' '; 1 << 20];
        (0..if name.contains("sheet1") { 300 } else { 1 })
            .for_each(|_| archive.write_all(&blanks).unwrap());
    }
    archive.finish().unwrap();
    assert!(std::fs::metadata(&path).unwrap().len() < 1 << 20);
    let id = page.upload(&path);
    let (status, answer) =
        page.run(&json!({"command": "inventory check", "files": {"file": [id]}}));
    assert!(
        status == 400 && answer.to_string().contains("unpacks to more than"),
        "{status}: {answer}"
    );
    let request = json!({"command": "assess", "files": {"inventory": [id]}});
    assert_eq!(
        page.post(
            "/api/v1/jobs",
            "application/json",
            request.to_string().as_bytes()
        )
        .0,
        202
    );
    assert_eq!(
        page.run(&json!({"command": "tolerance search", "options": {"word": ["cabinet"]}}))
            .0,
        200
    );
}

/// Edits are the command line's, and the file stays as it is.
#[test]
fn edits_are_read_in_place_of_cells() {
    let page = Page::open();
    let folder = tempfile::tempdir().unwrap();
    let list = folder.path().join("list.csv");
    std::fs::write(
        &list,
        "id,item,floor,height,thickness\nA,cabinet,ground,60 apples,0.4 m\n",
    )
    .unwrap();
    let id = page.upload(&list);
    let ask = |edits: Value| {
        let options = json!({"cells": true, "storeys": 3});
        page.run(&json!({"command": "inventory check", "options": options, "files": {"file": [id]}, "edits": edits}))
    };
    let (_, plain) = ask(json!([]));
    assert_eq!(plain["problems"][0]["cells"], json!(["D2"]));
    assert_eq!(
        plain["cells"]["texts"][0],
        json!(["A", "cabinet", "ground", "60 apples", "0.4 m"])
    );
    let (status, mended) = ask(json!([{"cell": "D2", "value": "600 mm"}]));
    assert_eq!(
        (
            status,
            &mended["objects"][0]["height_m"],
            &mended["problems"]
        ),
        (200, &json!(0.6), &json!([]))
    );
    assert_eq!(mended["sha256"], plain["sha256"]);
    let line = [
        "inventory",
        "check",
        list.to_str().unwrap(),
        "--edit",
        "D2=600 mm",
        "--storeys",
        "3",
    ];
    let printed: Value = serde_json::from_slice(
        &Command::new(PROGRAM)
            .args(line)
            .args(["--cells", "--json", "--quiet"])
            .output()
            .unwrap()
            .stdout,
    )
    .unwrap();
    assert_eq!(comparable(mended), comparable(printed));
    // The copy with notes has the corrected cell, and can be downloaded.
    let request = json!({"command": "inventory check", "files": {"file": [id]}, "edits": [{"cell": "D2", "value": "600 mm"}]});
    let (status, job) = page.post(
        "/api/v1/jobs",
        "application/json",
        request.to_string().as_bytes(),
    );
    assert_eq!(status, 202, "{job}");
    let at = format!("/api/v1/jobs/{}", job["id"].as_str().unwrap());
    let events = page.get(&format!("{at}/events"));
    assert!(String::from_utf8_lossy(&events).contains("event: done"));
    let copy = page.get(&format!("{at}/files/checked.xlsx"));
    let start = copy
        .windows(4)
        .position(|four| four == b"PK\x03\x04")
        .unwrap();
    let path = folder.path().join("checked.xlsx");
    std::fs::write(&path, &copy[start..]).unwrap();
    let line = [
        "inventory",
        "check",
        path.to_str().unwrap(),
        "--json",
        "--quiet",
        "--storeys",
        "3",
    ];
    let read: Value =
        serde_json::from_slice(&Command::new(PROGRAM).args(line).output().unwrap().stdout).unwrap();
    assert_eq!(
        (&read["objects"][0]["height_m"], &read["problems"]),
        (&json!(0.6), &json!([]))
    );
    let (status, refused) = ask(json!([{"cell": "D1", "value": "x"}]));
    assert_eq!(status, 400);
    assert!(
        refused["error"]["message"]
            .as_str()
            .unwrap()
            .contains("D1 cannot be changed"),
        "{refused}"
    );
    let (status, refused) =
        page.run(&json!({"command": "validate", "edits": [{"cell": "D1", "value": "x"}]}));
    assert_eq!(
        (status, &refused["error"]["message"]),
        (400, &json!("--edit is not known"))
    );
}

impl Drop for Page {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Page {
    pub(super) fn answered(&self, request: &Value) -> Value {
        let (status, answer) = self.run(request);
        assert_eq!(status, 200, "{request}: {answer}");
        answer
    }

    /// The error of a request that is allowed but cannot be answered.
    pub(super) fn refused(&self, request: &Value) -> Value {
        let (status, mut answer) = self.run(request);
        assert_eq!(status, 400, "{request}: {answer}");
        answer["error"].take()
    }
}
