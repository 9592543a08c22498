//! Where the numbers come from.

use freestand_input::file::file_name;
use freestand_output::html::{escape, figure, markup, paragraph, properties, table, words};
use freestand_study::provenance::Provenance;
use freestand_study::study::Study;

pub(super) fn provenance_section(study: &Study, provenance: &Provenance) -> String {
    let source = study.source.as_deref().and_then(file_name);
    let mut html = properties(
        "",
        &[
            ("Version", format!("freestand {}", provenance.version)),
            ("Study", source.unwrap_or_else(|| "built-in".to_owned())),
            ("SHA-256 of the study", provenance.study_sha256.clone()),
            (
                "Seed",
                provenance
                    .seed
                    .map(|seed| seed.to_string())
                    .unwrap_or_default(),
            ),
            (
                "Random numbers",
                provenance.generator.clone().unwrap_or_default(),
            ),
        ],
    );
    if !provenance.inputs.is_empty() {
        let rows: Vec<_> = provenance
            .inputs
            .iter()
            .map(|(name, sha256)| {
                vec![
                    words(name),
                    markup(format!("<code>{}</code>", escape(sha256)), ""),
                ]
            })
            .collect();
        html += &table(
            "Files that were read",
            &[vec![words("File"), figure("SHA-256")]],
            &rows,
        );
    }
    html += &paragraph(
        "The same version with the same study and files gives the same numbers on any number of threads. urs.csv \
         and srs.csv list every object and motion; summary.json contains the key figures and all inputs.",
    );
    html += &format!(
        "<details>\n<summary>The study as TOML, ready to run again</summary>\n<pre>{}</pre>\n</details>\n",
        escape(&study.toml)
    );
    html
}
