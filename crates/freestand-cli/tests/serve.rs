//! `freestand serve` as it is called: the line that it prints, the documents of commands, its end.

#![cfg(feature = "page")]
#![expect(clippy::unwrap_used, reason = "a test may stop at what it cannot set up")]

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};

use serde_json::{Value, json};

const PROGRAM: &str = env!("CARGO_BIN_EXE_freestand");

struct Page {
    child: Child,
    port: u64,
    token: String,
}

impl Page {
    fn open() -> Self {
        let mut child =
            Command::new(PROGRAM).args(["serve", "--json", "--no-open"]).stdout(Stdio::piped()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let line: Value = serde_json::from_str(&line).unwrap();
        let keys: Vec<&str> = line.as_object().unwrap().keys().map(String::as_str).collect();
        assert_eq!(keys, ["schema", "url", "port", "token", "version", "warnings"]);
        assert_eq!(line["schema"], "freestand.serve/1");
        let (port, token) = (line["port"].as_u64().unwrap(), line["token"].as_str().unwrap().to_owned());
        assert_eq!(line["url"], format!("http://127.0.0.1:{port}/#{token}"));
        Self { child, port, token }
    }

    fn post(&self, path: &str, content_type: &str, body: &[u8]) -> (u16, Value) {
        let mut stream = TcpStream::connect(("127.0.0.1", u16::try_from(self.port).unwrap())).unwrap();
        let head = format!(
            "POST {path} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nAuthorization: Bearer {}\r\nContent-Type: {content_type}\r\n\
             Content-Length: {}\r\nConnection: close\r\n\r\n",
            self.port,
            self.token,
            body.len()
        );
        stream.write_all(&[head.as_bytes(), body].concat()).unwrap();
        let mut answer = String::new();
        stream.read_to_string(&mut answer).unwrap();
        let (head, body) = answer.split_once("\r\n\r\n").unwrap();
        (head.split(' ').nth(1).unwrap().parse().unwrap(), serde_json::from_str(body).unwrap())
    }

    fn run(&self, request: &Value) -> (u16, Value) {
        self.post("/api/v1/run", "application/json", request.to_string().as_bytes())
    }

    /// Uploads a file and returns its id.
    fn upload(&self, path: &Path) -> Value {
        let name = path.file_name().unwrap().to_str().unwrap();
        let head = format!("--XX\r\nContent-Disposition: form-data; name=\"f\"; filename=\"{name}\"\r\n\r\n");
        let body = [head.as_bytes(), &std::fs::read(path).unwrap(), b"\r\n--XX--\r\n"].concat();
        let (status, told) = self.post("/api/v1/files", "multipart/form-data; boundary=XX", &body);
        assert_eq!(status, 200, "{told}");
        told["files"][0]["id"].clone()
    }
}

/// A document without what depends on where files are and on the clock.
fn comparable(mut value: Value) -> Value {
    fn strip(value: &mut Value) {
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
fn documents_are_those_of_the_command_line() {
    let page = Page::open();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let record = root.join("validation/rocking/records/synthfloor.csv");
    let list = root.join("examples/hospital/inventory.csv");
    let drop = root.join("validation/cushion/drop-001.csv");
    let (record_id, list_id, drop_id) = (page.upload(&record), page.upload(&list), page.upload(&drop));
    let size = json!({"height": "1.8 m", "thickness": "0.4 m"});
    let with = |more: Value| {
        let mut all = size.as_object().unwrap().clone();
        all.extend(more.as_object().unwrap().clone());
        Value::Object(all)
    };
    let (record, list, drop) = (record.to_str().unwrap(), list.to_str().unwrap(), drop.to_str().unwrap());
    let motion = (json!({"motion": [record_id]}), vec!["--motion", record]);
    let file = (json!({"file": [record_id]}), vec![record]);
    let none = (json!({}), vec![]);
    let cases = [
        ("shock", with(json!({"mass": "150 kg", "stiffness": "4380 N/mm", "uplift": "30 mm"})), none.clone()),
        ("rock", with(json!({"scale": 3.5, "mass": "150 kg", "stiffness": "4380 N/mm"})), motion.clone()),
        ("object", with(json!({"scale": 3.5})), motion.clone()),
        ("object", with(json!({"place": "Wellington", "worlds": 4})), none.clone()),
        ("spectrum", json!({"heights": "1 m:2 m:4", "thicknesses": "0.2 m, 0.3 m"}), motion),
        ("motion info", json!({}), file.clone()),
        ("motion spectrum", json!({"scale": 2}), file.clone()),
        ("motion convert", json!({"to": "csv"}), file),
        (
            "cushion drop",
            json!({"mass": "0.365 kg", "impact-velocity": "1.40 m/s"}),
            (json!({"files": [drop_id]}), vec![drop]),
        ),
        ("inventory check", json!({"storeys": 8}), (json!({"file": [list_id]}), vec![list])),
        ("restrain", with(json!({"mass": "150 kg", "place": "Wellington"})), none.clone()),
        ("tolerance search", json!({"word": ["cabinet"]}), none),
    ];
    for (command, options, (files, paths)) in cases {
        let mut line = Command::new(PROGRAM);
        line.args(command.split(' ')).args(["--json", "--quiet"]).args(&paths);
        for (name, value) in options.as_object().unwrap() {
            match value {
                Value::Array(all) => _ = line.args(all.iter().map(|one| one.as_str().unwrap())),
                value => _ = line.arg(format!("--{name}={}", value.to_string().trim_matches('"'))),
            }
        }
        let output = line.output().unwrap();
        let request = json!({"command": command, "options": options, "files": files});
        let (status, answer) = page.run(&request);
        // The page knows files by their names, not by their paths.
        let named = |text: &[u8]| {
            let named = |text: String, path: &&str| text.replace(path, path.rsplit('/').next().unwrap());
            paths.iter().fold(String::from_utf8_lossy(text).into_owned(), named)
        };
        match serde_json::from_str::<Value>(&named(&output.stdout)) {
            Ok(printed) => {
                assert_eq!(status, 200, "{command}: {answer}");
                assert_eq!(comparable(answer), comparable(printed), "{command}");
            }
            Err(_) => {
                // What the command line refuses is refused with the same words.
                let told = named(&output.stderr);
                let message = answer["error"]["message"].as_str().unwrap_or_default();
                assert!(status == 400 && told.contains(message), "{command}: {told} / {answer}");
            }
        }
    }
    let (status, answer) = page.run(&json!({"command": "shock", "options": {"height": "2 apples"}}));
    assert_eq!(status, 400, "{answer}");
}

#[cfg(unix)]
#[test]
fn sigterm_ends_it_with_success() {
    let mut page = Page::open();
    let status = Command::new("kill").arg(page.child.id().to_string()).status().unwrap();
    assert!(status.success());
    assert_eq!(page.child.wait().unwrap().code(), Some(0));
}

impl Drop for Page {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
