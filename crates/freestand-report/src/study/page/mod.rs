//! `report.html`: one file that loads no other, for the screen and for paper.

mod inputs;
mod overview;
mod provenance;
mod reading;
mod results;
mod sensitivity;

use freestand_output::html;
use std::fmt::Write;

use freestand_output::figure::Figure;
use freestand_output::html::{Cell, escape};
use freestand_study::result::StudyResult;
use freestand_study::study::Study;

use freestand_study::provenance::Provenance;

/// The report of a run: HTML that is also well-formed XML.
///
/// All texts of the study and of its files are escaped; the figures are inline SVG.
pub(super) fn report(
    study: &Study,
    result: &StudyResult,
    figures: &[Figure],
    provenance: &Provenance,
) -> String {
    let sections = [
        (
            "results",
            "Results",
            results::results(study, result, figures),
        ),
        (
            "sensitivity",
            "How the result depends on its assumptions",
            sensitivity::sensitivity(result),
        ),
        (
            "paper",
            "Comparison with the paper",
            reading::beside_the_paper(study, result),
        ),
        ("inputs", "Inputs", inputs::inputs(study, result)),
        ("assumptions", "Assumptions", reading::assumptions(study)),
        ("definitions", "Definitions", reading::definitions()),
        ("errata", "Corrections to the paper", reading::errata()),
        (
            "provenance",
            "Provenance",
            provenance::provenance_section(study, provenance),
        ),
    ];
    let sections = sections
        .into_iter()
        .filter(|(_, _, content)| !content.is_empty())
        .collect::<Vec<_>>();
    let mut document = html::opening(
        &overview::title(study),
        &overview::subtitle(study, provenance),
        "",
    );
    document.push_str(&overview::overview(study, result));
    document.push_str("<nav aria-label=\"Contents\">\n");
    for (id, heading, _) in &sections {
        let _ = writeln!(document, "<a href=\"#{id}\">{}</a>", escape(heading));
    }
    document.push_str("</nav>\n");
    for (id, heading, content) in &sections {
        document.push_str(&html::section(id, heading, content));
    }
    document.push_str(html::CLOSING);
    document
}

/// The headings of a table: of its columns of words, and of its columns of figures.
fn headings<const W: usize, const F: usize>(
    of_words: [&str; W],
    figures: [&str; F],
) -> Vec<Vec<Cell>> {
    let of_words = of_words.into_iter().map(html::words);
    vec![of_words.chain(figures.map(html::figure)).collect()]
}

/// A value in a table, where there is one.
fn or_dash<T>(value: Option<T>, words: impl FnOnce(T) -> String) -> Cell {
    html::figure(value.map_or_else(|| "–".to_owned(), words))
}

#[cfg(test)]
mod tests;
