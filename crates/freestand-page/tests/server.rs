//! The server over raw sockets, with a made-up program: every refusal, slots, jobs, files.

#![expect(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test may stop at what it cannot set up"
)]

#[path = "server/jobs.rs"]
mod jobs;

use std::io::{Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use freestand_page::{
    Cancel, Events, Kind, Program, Refusal, Reply, Request, Server, Settings, Status,
};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

/// What requests with the option `name` have told: that they have begun, and that they were stopped.
static TOLD: Mutex<Vec<String>> = Mutex::new(Vec::new());

fn tell(request: &Request, what: &str) {
    if let Some(name) = request.options.get("name") {
        TOLD.lock().unwrap().push(format!("{name} {what}"));
    }
}

/// Waits until the request of a name has told something.
fn await_told(name: &str, what: &str) {
    let (began, told) = (Instant::now(), format!("\"{name}\" {what}"));
    while !TOLD.lock().unwrap().contains(&told) {
        assert!(began.elapsed() < Duration::from_secs(60), "never: {told}");
        std::thread::sleep(Duration::from_millis(1));
    }
}

const FAKE: Program = Program {
    facts,
    kind,
    check,
    typed,
    read: Ok,
    surface: |request| match request.command.as_str() {
        "object" => Ok(b"\x01\x02".to_vec()),
        _ => Err(Refusal::new(Status::BadInput, "value", "it is flat", "")),
    },
    answer: fake,
};

/// What cannot be begun.
fn check(request: &Request) -> Result<(), Refusal> {
    match request.command.as_str() {
        "never" => Err(Refusal::new(
            Status::BadInput,
            "value",
            "no such command",
            "try echo",
        )),
        _ => Ok(()),
    }
}

/// The names of the files are those of the user.
fn typed(request: &Request) -> Result<Value, Refusal> {
    check(request)?;
    let paths = request.files.iter().flat_map(|(_, paths)| paths);
    let names: Vec<_> = paths
        .filter_map(|path| path.file_name()?.to_str())
        .collect();
    Ok(json!({"line": format!("{} {}", request.command, names.join(" "))}))
}

fn facts() -> Value {
    json!({"version": "fake"})
}

fn kind(path: &Path) -> Kind {
    if path.extension().is_some_and(|end| end == "csv") {
        Kind::Inventory
    } else {
        Kind::Unknown
    }
}

/// `echo` gives the request back, `wait` works until it is cancelled or for `steps` of 10 ms, `fail`
/// fails, `panic` panics.
fn fake(request: &Request, cancel: &Cancel, events: &Events) -> Result<Reply, Refusal> {
    let steps = request
        .options
        .get("steps")
        .and_then(Value::as_u64)
        .unwrap_or(0) as usize;
    match request.command.as_str() {
        "echo" => {
            let sizes: Vec<u64> = request
                .files
                .iter()
                .flat_map(|(_, paths)| paths)
                .map(|path| std::fs::metadata(path).map_or(0, |file| file.len()))
                .collect();
            // What a file says that names others: the sizes of those beside it.
            let first = request.files.iter().flat_map(|(_, paths)| paths).next();
            let beside: Option<u64> = first
                .filter(|_| request.options.contains_key("beside"))
                .and_then(|path| {
                    let named = std::fs::read_to_string(path).ok()?;
                    Some(std::fs::metadata(path.with_file_name(named)).ok()?.len())
                });
            let document =
                json!({"options": request.options, "sizes": sizes, "beside": beside}).to_string();
            Ok(Reply {
                document,
                ..Reply::default()
            })
        }
        "wait" => {
            tell(request, "has begun");
            for step in 0..steps {
                if cancel.is_cancelled() {
                    tell(request, "is stopped");
                    return Ok(Reply {
                        document: "{}".to_owned(),
                        is_stopped: true,
                        ..Reply::default()
                    });
                }
                events.progress("waiting", step, steps, step as f64 / steps as f64);
                std::thread::sleep(Duration::from_millis(10));
            }
            events.object(&json!({"id": "one"}));
            let mut files = Vec::new();
            if let Some(folder) = &request.folder {
                std::fs::create_dir_all(folder).unwrap();
                std::fs::write(folder.join("objects.csv"), "id\none\n").unwrap();
                std::fs::write(folder.join("secret.csv"), "not listed").unwrap();
                files.push("objects.csv".to_owned());
            }
            Ok(Reply {
                document: json!({"steps": steps}).to_string(),
                files,
                ..Reply::default()
            })
        }
        "panic" => panic!("on purpose"),
        _ => Err(Refusal::new(
            Status::BadInput,
            "value",
            "no such command",
            "try echo",
        )),
    }
}

struct Site {
    port: u16,
    token: String,
    stop: Arc<AtomicBool>,
    thread: Option<std::thread::JoinHandle<()>>,
}

impl Site {
    fn new() -> Self {
        let server = Server::bind(&Settings::default(), FAKE).unwrap();
        let (port, token) = (server.port(), server.token().to_owned());
        let stop = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&stop);
        let thread = std::thread::spawn(move || server.serve(|| flag.load(Ordering::Relaxed)));
        Self {
            port,
            token,
            stop,
            thread: Some(thread),
        }
    }

    fn send(&self, bytes: &[u8]) -> TcpStream {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream
            .set_read_timeout(Some(Duration::from_secs(20)))
            .unwrap();
        // A server that refuses early closes while the rest is still being written.
        let _ = stream.write_all(bytes);
        stream
    }

    /// A request with `Host` and `Connection: close`, and these headers.
    fn ask(&self, line: &str, headers: &[&str], body: &[u8]) -> Told {
        let mut head = format!(
            "{line} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\n",
            self.port
        );
        headers
            .iter()
            .for_each(|header| head.push_str(&format!("{header}\r\n")));
        if !body.is_empty() {
            head.push_str(&format!("Content-Length: {}\r\n", body.len()));
        }
        head.push_str("\r\n");
        told(self.send(&[head.as_bytes(), body].concat()))
    }

    fn bearer(&self) -> String {
        format!("Authorization: Bearer {}", self.token)
    }

    fn get(&self, path: &str) -> Told {
        self.ask(&format!("GET {path}"), &[&self.bearer()], b"")
    }

    fn post(&self, path: &str, body: &Value) -> Told {
        let headers = [self.bearer(), "Content-Type: application/json".to_owned()];
        self.ask(
            &format!("POST {path}"),
            &headers.each_ref().map(String::as_str),
            body.to_string().as_bytes(),
        )
    }

    fn upload(&self, files: &[(&str, &[u8])]) -> Told {
        let mut body = Vec::new();
        for (name, bytes) in files {
            let head = format!(
                "--XX\r\nContent-Disposition: form-data; name=\"file\"; filename=\"{name}\"\r\n\r\n"
            );
            body.extend([head.as_bytes(), bytes, b"\r\n"].concat());
        }
        body.extend(b"--XX--\r\n");
        let headers = [
            self.bearer(),
            "Content-Type: multipart/form-data; boundary=XX".to_owned(),
        ];
        self.ask(
            "POST /api/v1/files",
            &headers.each_ref().map(String::as_str),
            &body,
        )
    }
}

impl Drop for Site {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

struct Told {
    status: u16,
    head: String,
    body: Vec<u8>,
}

impl Told {
    fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap_or(Value::Null)
    }

    fn text(&self) -> String {
        String::from_utf8_lossy(&self.body).into_owned()
    }

    fn header(&self, name: &str) -> Option<&str> {
        let named = |line: &&str| {
            line.split_once(':')
                .is_some_and(|(own, _)| own.eq_ignore_ascii_case(name))
        };
        self.head
            .lines()
            .find(named)
            .and_then(|line| line.split_once(": "))
            .map(|(_, value)| value.trim())
    }
}

fn told(mut stream: TcpStream) -> Told {
    let mut bytes = Vec::new();
    let _ = stream.read_to_end(&mut bytes);
    let at = bytes
        .windows(4)
        .position(|four| four == b"\r\n\r\n")
        .unwrap_or(bytes.len());
    let head = String::from_utf8_lossy(&bytes[..at]).into_owned();
    let mut body = bytes.get(at + 4..).unwrap_or_default().to_vec();
    let status = head
        .split(' ')
        .nth(1)
        .and_then(|text| text.parse().ok())
        .unwrap_or(0);
    let mut told = Told {
        status,
        head,
        body: Vec::new(),
    };
    if told
        .header("transfer-encoding")
        .is_some_and(|text| text.eq_ignore_ascii_case("chunked"))
    {
        body = unchunked(&body);
    }
    told.body = body;
    told
}

fn unchunked(mut rest: &[u8]) -> Vec<u8> {
    let mut whole = Vec::new();
    while let Some(at) = rest.windows(2).position(|two| two == b"\r\n") {
        let size = std::str::from_utf8(&rest[..at])
            .ok()
            .and_then(|text| usize::from_str_radix(text, 16).ok());
        let Some(size) = size.filter(|size| *size > 0) else {
            break;
        };
        whole.extend(&rest[at + 2..(at + 2 + size).min(rest.len())]);
        rest = rest.get(at + 4 + size..).unwrap_or_default();
    }
    whole
}

#[test]
fn only_our_own_host_is_served() {
    let site = Site::new();
    let port = site.port;
    let with = |host: &str| {
        told(site.send(format!("GET / HTTP/1.1\r\n{host}Connection: close\r\n\r\n").as_bytes()))
            .status
    };
    assert_eq!(with(&format!("Host: 127.0.0.1:{port}\r\n")), 200);
    assert_eq!(with(&format!("Host: localhost:{port}\r\n")), 200);
    for host in [
        String::new(),
        "Host: 127.0.0.1\r\n".to_owned(),
        format!("Host: evil.example:{port}\r\n"),
        format!("Host: 127.0.0.1:{}\r\n", port.wrapping_add(1)),
        format!("Host: 127.0.0.1:{port}.evil.example\r\n"),
        format!("Host: 127.0.0.1:{port}\r\nHost: evil.example\r\n"),
        format!("Host: [::1]:{port}\r\n"),
    ] {
        assert_eq!(with(&host), 403, "{host:?}");
    }
    let absolute = format!(
        "GET http://evil.example/ HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: close\r\n\r\n"
    );
    assert_eq!(told(site.send(absolute.as_bytes())).status, 403);
    // Before anything else: an address that does not exist, and one that needs the token.
    for path in ["/nothing", "/api/v1/facts"] {
        let head = format!(
            "GET {path} HTTP/1.1\r\nHost: evil.example\r\n{}\r\nConnection: close\r\n\r\n",
            site.bearer()
        );
        assert_eq!(told(site.send(head.as_bytes())).status, 403);
    }
    assert!(TcpStream::connect(("::1", port)).is_err());
}

#[test]
fn only_our_own_pages_may_ask() {
    let site = Site::new();
    let with = |header: String| site.ask("GET /api/v1/facts", &[&site.bearer(), &header], b"");
    assert_eq!(
        with(format!("Origin: http://127.0.0.1:{}", site.port)).status,
        200
    );
    assert_eq!(
        with(format!("Origin: http://localhost:{}", site.port)).status,
        200
    );
    for origin in [
        "http://evil.example",
        "null",
        "http://127.0.0.1",
        "https://localhost",
    ] {
        let answer = with(format!("Origin: {origin}"));
        assert_eq!(
            (answer.status, answer.header("access-control-allow-origin")),
            (403, None),
            "{origin}"
        );
        assert_eq!(answer.json()["error"]["kind"], "origin");
    }
    assert_eq!(with("Sec-Fetch-Site: same-origin".to_owned()).status, 200);
    assert_eq!(with("Sec-Fetch-Site: cross-site".to_owned()).status, 403);
    assert_eq!(with("Sec-Fetch-Site: same-site".to_owned()).status, 403);
    // A preflight gets no permission.
    let preflight = site.ask("OPTIONS /api/v1/run", &["Origin: http://evil.example"], b"");
    assert_eq!(
        (
            preflight.status,
            preflight.header("access-control-allow-methods")
        ),
        (403, None)
    );
}

#[test]
fn nothing_without_the_token() {
    let site = Site::new();
    let with = |headers: &[&str]| site.ask("GET /api/v1/facts", headers, b"").status;
    assert_eq!(with(&[&site.bearer()]), 200);
    let (short, long) = (&site.token[..63], format!("{}0", site.token));
    for header in [
        format!("Authorization: Bearer {short}"),
        format!("Authorization: Bearer {long}"),
        format!("Authorization: Bearer {}", "0".repeat(64)),
        format!("Authorization: Basic {}", site.token),
        format!("Cookie: token={}", site.token),
    ] {
        assert_eq!(with(&[&header]), 401, "{header}");
    }
    assert_eq!(with(&[]), 401);
    assert_eq!(
        site.ask(&format!("GET /api/v1/facts?token={}", site.token), &[], b"")
            .status,
        401
    );
    assert_eq!(
        with(&[
            &site.bearer(),
            &format!("Authorization: Bearer {}", "0".repeat(64))
        ]),
        401
    );
    for line in [
        "POST /api/v1/run",
        "POST /api/v1/files",
        "POST /api/v1/jobs",
        "DELETE /api/v1/jobs/job-1",
        "GET /api/x",
    ] {
        assert_eq!(site.ask(line, &[], b"").status, 401, "{line}");
    }
    // The page itself needs none, and holds none.
    let page = site.ask("GET /", &[], b"");
    assert_eq!(page.status, 200);
    assert!(!page.text().contains(&site.token) && !page.head.contains(&site.token));
}

#[test]
fn every_response_has_the_headers() {
    let site = Site::new();
    for answer in [
        site.ask("GET /", &[], b""),
        site.get("/api/v1/facts"),
        site.get("/nothing"),
        site.ask("GET /api", &[], b""),
    ] {
        let policy = answer.header("content-security-policy").unwrap();
        assert!(
            policy.starts_with("default-src 'none'; script-src 'self'; style-src 'self';"),
            "{policy}"
        );
        assert!(
            policy.ends_with("base-uri 'none'; frame-ancestors 'none'")
                && !policy.contains("unsafe"),
            "{policy}"
        );
        assert_eq!(answer.header("x-content-type-options"), Some("nosniff"));
        assert_eq!(answer.header("referrer-policy"), Some("no-referrer"));
        assert_eq!(
            answer.header("cross-origin-opener-policy"),
            Some("same-origin")
        );
        assert_eq!(
            answer.header("cross-origin-resource-policy"),
            Some("same-origin")
        );
        assert_eq!(answer.header("access-control-allow-origin"), None);
        assert_eq!(answer.header("set-cookie"), None);
    }
    assert_eq!(
        site.get("/api/v1/facts").header("cache-control"),
        Some("no-store")
    );
}

#[test]
fn the_page_is_packed_and_known_again() {
    let site = Site::new();
    let plain = site.ask("GET /", &[], b"");
    let packed = site.ask("GET /", &["Accept-Encoding: br, gzip"], b"");
    assert_eq!(
        (
            plain.header("content-encoding"),
            packed.header("content-encoding")
        ),
        (None, Some("gzip"))
    );
    assert!(plain.body.starts_with(b"<!doctype html>"));
    let tag = packed.header("etag").unwrap().to_owned();
    assert_ne!(Some(tag.as_str()), plain.header("etag"));
    let again = site.ask(
        "GET /",
        &["Accept-Encoding: gzip", &format!("If-None-Match: {tag}")],
        b"",
    );
    assert_eq!((again.status, again.body.len()), (304, 0));
    assert_eq!(site.ask("HEAD /", &[], b"").body.len(), 0);
}

#[test]
fn paths_are_looked_up_in_tables() {
    let site = Site::new();
    for path in [
        "/../Cargo.toml",
        "/assets/../../Cargo.toml",
        "/assets/%2e%2e/x",
        "/assets/",
        "/etc/passwd",
        "//",
    ] {
        assert_eq!(
            site.ask(&format!("GET {path}"), &[], b"").status,
            404,
            "{path}"
        );
    }
    assert_eq!(site.get("/api/v1/nothing").status, 404);
    assert_eq!(site.get("/api/v1/jobs/../../x").status, 404);
    let unknown = site.post(
        "/api/v1/run",
        &json!({"command": "echo", "files": {"motion": ["../../etc/passwd"]}}),
    );
    assert_eq!(unknown.status, 400);
}

#[test]
fn a_surface_comes_as_bytes() {
    let site = Site::new();
    let found = site.post("/api/v1/surface", &json!({"command": "object"}));
    assert_eq!(found.status, 200);
    assert_eq!(
        found.header("content-type"),
        Some("application/octet-stream")
    );
    assert_eq!(found.body, [1, 2]);
    let flat = site.post("/api/v1/surface", &json!({"command": "echo"}));
    assert_eq!(flat.status, 400);
    assert_eq!(flat.json()["error"]["message"], "it is flat");
}

#[test]
fn methods_and_types() {
    let site = Site::new();
    let bearer = site.bearer();
    let ask =
        |line: &str, of_type: &str| site.ask(line, &[&bearer, of_type], b"{\"command\": \"echo\"}");
    let json = "Content-Type: application/json";
    for (line, allowed) in [
        ("POST /", "GET, HEAD"),
        ("POST /api/v1/facts", "GET"),
        ("PUT /api/v1/run", "POST"),
        ("GET /api/v1/asked", "POST"),
        ("GET /api/v1/quantities", "POST"),
        ("GET /api/v1/surface", "POST"),
        ("PUT /api/v1/jobs/job-1", "DELETE"),
        ("POST /api/v1/jobs/job-1/events", "GET"),
    ] {
        let answer = ask(line, json);
        assert_eq!(
            (answer.status, answer.header("allow")),
            (405, Some(allowed)),
            "{line}"
        );
    }
    assert_eq!(ask("POST /api/v1/run", json).status, 200);
    assert_eq!(
        ask(
            "POST /api/v1/run",
            "Content-Type: application/json; charset=utf-8"
        )
        .status,
        200
    );
    // What a form of another page could send.
    assert_eq!(
        ask("POST /api/v1/run", "Content-Type: text/plain").status,
        415
    );
    assert_eq!(ask("POST /api/v1/run", "X-Nothing: 1").status, 415);
    assert_eq!(ask("POST /api/v1/files", json).status, 415);
}

#[test]
fn limits_of_size() {
    let site = Site::new();
    let large = json!({"command": "echo", "options": {"x": "y".repeat(1 << 20)}});
    assert_eq!(site.post("/api/v1/run", &large).status, 413);
    // The same in pieces, whose length nobody has announced.
    let mut pieces = format!(
        "POST /api/v1/run HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n{}\r\nContent-Type: application/json\r\n\
         Transfer-Encoding: chunked\r\nConnection: close\r\n\r\n",
        site.port,
        site.bearer()
    );
    let piece = "z".repeat(1 << 16);
    (0..17).for_each(|_| pieces.push_str(&format!("10000\r\n{piece}\r\n")));
    pieces.push_str("0\r\n\r\n");
    assert_eq!(told(site.send(pieces.as_bytes())).status, 413);
    let (ok, over) = (vec![0u8; 1 << 20], vec![0u8; (64 << 20) + 1]);
    assert_eq!(site.upload(&[("a.csv", &ok)]).status, 200);
    assert_eq!(site.upload(&[("b.csv", &over)]).status, 413);
}

#[test]
fn all_files_together_have_a_limit() {
    let site = Site::new();
    let file = vec![b'x'; 60 << 20];
    for count in 1..=4 {
        assert_eq!(
            site.upload(&[("a.bin", &file)]).status,
            200,
            "{} MiB",
            60 * count
        );
    }
    let over = site.upload(&[("a.bin", &file)]);
    assert_eq!(
        (over.status, over.json()["error"]["kind"].clone()),
        (413, json!("size"))
    );
    // What was refused takes no room.
    assert_eq!(site.upload(&[("a.bin", &file[..(10 << 20)])]).status, 200);
}

/// Clients that begin a request and never end it keep nobody from being answered, and are cut off.
#[test]
#[ignore = "ten seconds: it waits until they are cut off"]
fn clients_that_hang_are_cut_off() {
    let site = Site::new();
    let head = format!(
        "POST /api/v1/run HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n",
        site.port
    );
    let hanging: Vec<TcpStream> = (0..40).map(|_| site.send(head.as_bytes())).collect();
    let body = format!(
        "{head}{}\r\nContent-Type: application/json\r\nContent-Length: 99\r\n\r\n{{",
        site.bearer()
    );
    let in_body: Vec<TcpStream> = (0..40).map(|_| site.send(body.as_bytes())).collect();
    let form = format!(
        "POST /api/v1/files HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n{}\r\nContent-Type: multipart/form-data; boundary=XX\r\n\
         Content-Length: 999\r\n\r\n--XX\r\nContent-Disposition: form-data; name=\"f\"; filename=\"a.csv\"\r\n\r\nx",
        site.port,
        site.bearer()
    );
    let in_upload: Vec<TcpStream> = (0..10).map(|_| site.send(form.as_bytes())).collect();
    assert_eq!(site.get("/api/v1/facts").status, 200);
    // Nobody waited for them: they are not cut off yet.
    let first = hanging.first().unwrap();
    first.set_nonblocking(true).unwrap();
    assert_eq!(
        first.peek(&mut [0]).unwrap_err().kind(),
        std::io::ErrorKind::WouldBlock
    );
    first.set_nonblocking(false).unwrap();
    // A header may take 10 s, and so may a piece of an upload; reads here give up after 20 s.
    for mut stream in hanging.into_iter().chain(in_upload) {
        let mut rest = Vec::new();
        assert!(stream.read_to_end(&mut rest).is_ok(), "it is still open");
    }
    drop(in_body);
}

#[test]
fn files_are_kept_and_named() {
    let site = Site::new();
    let answer = site.upload(&[("../../list.csv", b"a,b\n1,2\n"), ("x.bin", b"")]);
    let files = answer.json()["files"].clone();
    assert_eq!(
        (answer.status, &files[0]["name"], &files[0]["kind"]),
        (200, &json!("list.csv"), &json!("inventory"))
    );
    assert_eq!(
        (&files[0]["bytes"], &files[1]["kind"]),
        (&json!(8), &json!("unknown"))
    );
    let sha: String = Sha256::digest(b"a,b\n1,2\n")
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect();
    assert_eq!(files[0]["sha256"], json!(sha));
    let echoed = site.post(
        "/api/v1/run",
        &json!({"command": "echo", "files": {"motion": [files[0]["id"]]}}),
    );
    assert_eq!(echoed.json()["sizes"], json!([8]));
    let asked = |command: &str| {
        let asked = json!({"command": command, "files": {"motion": [files[0]["id"]], "beside": [files[1]["id"]]}});
        site.post("/api/v1/asked", &asked)
    };
    assert_eq!(asked("echo").json()["line"], json!("echo list.csv"));
    assert_eq!(asked("never").status, 400);
    assert_eq!(site.upload(&[]).status, 400);
}

/// A file may name others of its request, and none of another.
#[test]
fn files_that_name_files_have_those_of_their_request() {
    let site = Site::new();
    let told = site.upload(&[
        ("study.txt", b"list.csv"),
        ("list.csv", b"a,b\n1,2\n"),
        ("list.csv", b"x"),
    ]);
    let ids: Vec<String> = told.json()["files"]
        .as_array()
        .unwrap()
        .iter()
        .map(|file| file["id"].as_str().unwrap().to_owned())
        .collect();
    let ask = |files: Value| {
        site.post(
            "/api/v1/run",
            &json!({"command": "echo", "options": {"beside": true}, "files": files}),
        )
    };
    let alone = ask(json!({"study": [ids[0]]}));
    assert_eq!((alone.status, &alone.json()["beside"]), (200, &Value::Null));
    // Twice: the folder that they share is there already.
    for _ in 0..2 {
        let both = ask(json!({"study": ids[0], "beside": [ids[1]]}));
        assert_eq!(
            (both.status, &both.json()["beside"], &both.json()["sizes"]),
            (200, &json!(8), &json!([8]))
        );
    }
    assert_eq!(
        ask(json!({"study": ids[0], "beside": [ids[2]]})).json()["beside"],
        1
    );
    let same = ask(json!({"study": ids[0], "beside": [ids[1], ids[2]]}));
    assert_eq!(same.status, 400);
    assert_eq!(
        same.json()["error"]["message"],
        "two files of the request are called list.csv"
    );
    assert_eq!(
        ask(json!({"study": ids[0], "beside": ["../f1"]})).status,
        400
    );
}

#[test]
fn what_cannot_be_begun_is_no_job() {
    let site = Site::new();
    let answer = site.post("/api/v1/jobs", &json!({"command": "never"}));
    assert_eq!(
        (answer.status, &answer.json()["error"]["hint"]),
        (400, &json!("try echo"))
    );
    assert_eq!(site.get("/api/v1/jobs/job-1/events").status, 404);
}

#[test]
fn bad_requests_are_told() {
    let site = Site::new();
    for body in [
        json!({}),
        json!([]),
        json!({"command": 1}),
        json!({"command": "echo", "nonsense": 1}),
    ] {
        let answer = site.post("/api/v1/run", &body);
        assert_eq!(answer.status, 400, "{body}");
        let error = answer.json()["error"].clone();
        assert!(
            error["message"].is_string() && error["hint"].is_string(),
            "{error}"
        );
        let keys: Vec<&str> = error
            .as_object()
            .unwrap()
            .keys()
            .map(String::as_str)
            .collect();
        assert_eq!(keys, ["kind", "key", "file", "line", "message", "hint"]);
    }
    assert_eq!(
        site.post("/api/v1/run", &json!({"command": "none"})).json()["error"]["hint"],
        "try echo"
    );
    assert_eq!(
        site.post("/api/v1/run", &json!({"command": "panic"}))
            .status,
        500
    );
    // And it lives on.
    assert_eq!(site.get("/api/v1/facts").status, 200);
}

#[test]
fn the_newer_request_of_a_slot_wins() {
    let site = Site::new();
    let slow =
        json!({"command": "wait", "options": {"steps": 500, "name": "older"}, "slot": "one"});
    std::thread::scope(|scope| {
        let older = scope.spawn(|| site.post("/api/v1/run", &slow));
        await_told("older", "has begun");
        let other = site.post(
            "/api/v1/run",
            &json!({"command": "wait", "options": {"steps": 1}, "slot": "two"}),
        );
        let newer = site.post(
            "/api/v1/run",
            &json!({"command": "wait", "options": {"steps": 1}, "slot": "one"}),
        );
        assert_eq!((other.status, newer.status), (200, 200));
        let older = older.join().unwrap();
        assert_eq!(
            (older.status, older.json()["error"]["kind"].clone()),
            (409, json!("superseded"))
        );
    });
}

/// Two tabs that show two places are two people: neither stops the other.
#[test]
fn the_newer_request_of_another_tab_stops_nothing() {
    let site = Site::new();
    let asked = |tab: &str, steps: u32| {
        site.post(
            "/api/v1/run",
            &json!({"command": "wait", "options": {"steps": steps, "name": tab}, "slot": "one", "tab": tab}),
        )
    };
    std::thread::scope(|scope| {
        let older = scope.spawn(|| asked("a", 40));
        await_told("a", "has begun");
        assert_eq!(asked("b", 1).status, 200);
        assert_eq!(
            older.join().unwrap().status,
            200,
            "the request of another tab has stopped it"
        );
    });
}

/// Its fields in a list, in their order, are no request.
#[test]
fn a_list_is_no_request() {
    let answer = Site::new().post("/api/v1/run", &json!(["echo", {}]));
    let told = "the request is not a JSON object";
    assert_eq!(
        (answer.status, &answer.json()["error"]["message"]),
        (400, &json!(told))
    );
}

/// Ctrl-C: jobs stop, and the files are gone.
#[test]
fn the_server_ends() {
    let site = Site::new();
    site.post(
        "/api/v1/jobs",
        &json!({"command": "wait", "options": {"steps": 3000}}),
    );
    let port = site.port;
    drop(site);
    assert!(TcpStream::connect(("127.0.0.1", port)).is_err());
}
