//! Work that takes long, followed and cancelled.

use super::*;

/// The events of a job after a number: their names, numbers and data.
fn events(site: &Site, id: &str, after: usize) -> Vec<(usize, String, Value)> {
    let last = format!("Last-Event-ID: {after}");
    let answer = site.ask(
        &format!("GET /api/v1/jobs/{id}/events"),
        &[&site.bearer(), &last],
        b"",
    );
    assert_eq!(answer.header("content-type"), Some("text/event-stream"));
    let of = |block: &str, field: &str| {
        block
            .lines()
            .find_map(|line| line.strip_prefix(field))
            .map(str::to_owned)
            .unwrap_or_default()
    };
    let text = answer.text();
    let blocks = text
        .split("\n\n")
        .filter(|block| !block.is_empty() && !block.starts_with(':'));
    let event = |block: &str| {
        (
            of(block, "id: ").parse().unwrap(),
            of(block, "event: "),
            serde_json::from_str(&of(block, "data: ")).unwrap(),
        )
    };
    blocks.map(event).collect()
}

#[test]
fn a_job_is_followed_and_taken_up_again() {
    let site = Site::new();
    let answer = site.post(
        "/api/v1/jobs",
        &json!({"command": "wait", "options": {"steps": 60}}),
    );
    assert_eq!(answer.status, 202);
    let id = answer.json()["id"].as_str().unwrap().to_owned();
    let all = events(&site, &id, 0);
    let numbers: Vec<usize> = all.iter().map(|(number, ..)| *number).collect();
    assert_eq!(numbers, (1..=all.len()).collect::<Vec<_>>());
    let names: Vec<&str> = all.iter().map(|(_, name, _)| name.as_str()).collect();
    assert_eq!(names[names.len() - 2..], ["object", "done"]);
    // 600 ms of work, at most ten times a second; slack for a machine that stalls is on the other side.
    let progress = names.iter().filter(|name| **name == "progress").count();
    assert!((2..=8).contains(&progress) || all.len() < 4, "{progress}");
    assert_eq!(all[all.len() - 1].2["result"]["steps"], 60);
    assert_eq!(events(&site, &id, all.len() - 2), all[all.len() - 2..]);
    assert_eq!(site.get("/api/v1/jobs/job-99/events").status, 404);

    let file = site.get(&format!("/api/v1/jobs/{id}/files/objects.csv"));
    assert_eq!((file.status, file.text()), (200, "id\none\n".to_owned()));
    assert_eq!(
        file.header("content-disposition"),
        Some("attachment; filename=\"objects.csv\"")
    );
    for name in [
        "secret.csv",
        "..%2fsecret.csv",
        "../objects.csv",
        "objects.csv%00",
        "",
    ] {
        assert_eq!(
            site.get(&format!("/api/v1/jobs/{id}/files/{name}")).status,
            404,
            "{name}"
        );
    }
}

#[test]
fn a_job_is_cancelled() {
    let site = Site::new();
    let long = json!({"command": "wait", "options": {"steps": 3000}});
    let ids: Vec<String> = (0..4)
        .map(|_| {
            site.post("/api/v1/jobs", &long).json()["id"]
                .as_str()
                .unwrap()
                .to_owned()
        })
        .collect();
    assert_eq!(site.post("/api/v1/jobs", &long).status, 429);
    let bearer = site.bearer();
    for id in &ids {
        assert_eq!(
            site.ask(&format!("DELETE /api/v1/jobs/{id}"), &[&bearer], b"")
                .status,
            204
        );
    }
    for id in &ids {
        let all = events(&site, id, 0);
        assert_eq!(
            all.last().map(|(_, name, _)| name.as_str()),
            Some("cancelled")
        );
    }
    assert_eq!(
        site.ask("DELETE /api/v1/jobs/job-77", &[&bearer], b"")
            .status,
        404
    );
    // The same work goes on in the folder of an earlier one; other work would replace its files.
    let other = json!({"command": "wait", "options": {"steps": 1}, "continues": ids[0]});
    let refused = site.post("/api/v1/jobs", &other);
    assert_eq!(refused.status, 400);
    assert!(
        refused.text().contains("another request"),
        "{}",
        refused.text()
    );
    let same =
        json!({"command": "wait", "options": {"steps": 3000, "resume": true}, "continues": ids[0]});
    assert_eq!(site.post("/api/v1/jobs", &same).status, 202);
    // What is finished is finished.
    let short = json!({"command": "wait", "options": {"steps": 1}});
    let id = site.post("/api/v1/jobs", &short).json()["id"].clone();
    events(&site, id.as_str().unwrap(), 0);
    let again = json!({"command": "wait", "options": {"steps": 1}, "continues": id});
    assert!(
        site.post("/api/v1/jobs", &again)
            .text()
            .contains("is finished")
    );
}

/// The work of a request ends when nobody waits for its answer any more.
#[test]
fn a_client_that_leaves_stops_its_work() {
    let site = Site::new();
    for (name, slot) in [("alone", ""), ("of a slot", ",\"slot\":\"one\"")] {
        let body = format!(
            "{{\"command\":\"wait\",\"options\":{{\"steps\":3000,\"name\":\"{name}\"}}{slot}}}"
        );
        let head = format!(
            "POST /api/v1/run HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n{}\r\nContent-Type: application/json\r\nContent-Length: {}\r\n\r\n",
            site.port,
            site.bearer(),
            body.len()
        );
        let client = site.send(format!("{head}{body}").as_bytes());
        await_told(name, "has begun");
        drop(client);
        // The work would take 30 s, and tells nothing when it ends by itself.
        await_told(name, "is stopped");
    }
}
