//! The schemas in docs/schema are those of the structs.

use std::path::PathBuf;

use freestand_app::rock::{Results, Rock, SCHEMA};
use freestand_app::schema::{of_request, of_response};

#[test]
fn the_schemas_are_those_of_the_structs() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/schema");
    let schemas = [
        ("rock.request.json", of_request::<Rock>("rock")),
        (
            "rock.response.json",
            of_response("rock", SCHEMA, &Results::kinds()),
        ),
    ];
    for (name, schema) in schemas {
        let text = serde_json::to_string_pretty(&schema).unwrap() + "\n";
        if std::env::var_os("FREESTAND_WRITE").is_some() {
            std::fs::write(folder.join(name), &text).unwrap();
        }
        let kept = std::fs::read_to_string(folder.join(name)).unwrap();
        assert!(
            kept == text,
            "{name}: `cargo xtask generate` writes it anew"
        );
    }
}
