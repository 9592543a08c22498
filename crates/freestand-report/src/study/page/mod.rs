//! `report.html`: one file that loads no other, for the screen and for paper.

mod inputs;
mod overview;
mod provenance;
mod reading;
mod results;
mod sensitivity;

use freestand_output::figure::Figure;
use freestand_output::html::{Cell, document, figure, words};
use freestand_study::provenance::Provenance;
use freestand_study::result::StudyResult;
use freestand_study::study::Study;
use maud::{Markup, html};

/// The report of a run: HTML that is also well-formed XML.
///
/// All texts of the study and of its files are escaped; the figures are inline SVG.
pub(super) fn report(
    study: &Study,
    result: &StudyResult,
    figures: &[Figure],
    provenance: &Provenance,
) -> String {
    let sections: [(&str, &str, Markup); 8] = [
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
    let sections: Vec<_> = sections
        .iter()
        .filter(|(_, _, content)| !content.0.is_empty())
        .collect();
    let content = html! {
        (overview::overview(study, result))
        nav aria-label="Contents" {
            @for (id, heading, _) in &sections { a href={ "#" (id) } { (heading) } " " }
        }
        @for (id, heading, content) in &sections {
            section #(id) { h2 { (heading) } (content) }
        }
    };
    document(
        &overview::title(study),
        &overview::subtitle(study, provenance),
        "",
        &content,
    )
}

/// The headings of a table: of its columns of words, and of its columns of figures.
fn headings<const W: usize, const F: usize>(
    of_words: [&str; W],
    of_figures: [&str; F],
) -> Vec<Cell> {
    let of_words = of_words.into_iter().map(words);
    of_words.chain(of_figures.map(figure)).collect()
}

/// A value in a table, where there is one.
fn or_dash<T>(value: Option<T>, words: impl FnOnce(T) -> String) -> Cell {
    figure(value.map_or_else(|| "–".to_owned(), words))
}

#[cfg(test)]
mod tests;
