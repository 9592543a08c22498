//! Studies as text. None that could name a file elsewhere: the fuzzer must not read what it happens
//! to name.
#![no_main]
use freestand_study::resolve::resolve;
use std::path::Path;

libfuzzer_sys::fuzz_target!(|text: &str| {
    // Slashes belong to units, but not in front; an escape can write them too.
    let names_a_place = ["\"/", "'/", "..", "\\"]
        .iter()
        .any(|part| text.contains(part));
    if names_a_place {
        return;
    }
    if let Err(error) = resolve(text, Some(Path::new("study.toml")), Path::new("/nowhere")) {
        assert!(!error.problems.is_empty());
        assert!(
            error
                .problems
                .iter()
                .all(|problem| !problem.message.is_empty())
        );
    }
});
