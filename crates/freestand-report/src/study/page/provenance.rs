//! Where the numbers come from.

use freestand_input::file::file_name;
use freestand_output::html::{figure, properties, table, words};
use freestand_study::provenance::Provenance;
use freestand_study::study::Study;
use maud::{Markup, html};

pub(super) fn provenance_section(study: &Study, provenance: &Provenance) -> Markup {
    let source = study.source.as_deref().and_then(file_name);
    let seed = provenance.seed.map(|seed| seed.to_string());
    let facts = [
        ("Version", format!("freestand {}", provenance.version)),
        ("Study", source.unwrap_or_else(|| "built-in".to_owned())),
        ("SHA-256 of the study", provenance.study_sha256.clone()),
        ("Seed", seed.unwrap_or_default()),
        (
            "Random numbers",
            provenance.generator.clone().unwrap_or_default(),
        ),
    ];
    let files = provenance
        .inputs
        .iter()
        .map(|(name, sha256)| [words(name), words(html! { code { (sha256) } })]);
    html! {
        (properties("", &facts))
        @if !provenance.inputs.is_empty() {
            (table("Files that were read", &[words("File"), figure("SHA-256")], files))
        }
        p {
            "The same version with the same study and files gives the same numbers on any number of threads. urs.csv \
             and srs.csv list every object and motion; summary.json contains the key figures and all inputs."
        }
        details {
            summary { "The study as TOML, ready to run again" }
            pre { (study.toml) }
        }
    }
}
