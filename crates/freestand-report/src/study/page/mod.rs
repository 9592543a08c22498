//! `report.html`: one file that loads no other, for the screen and for paper.

mod inputs;
mod overview;
mod provenance;
mod reading;
mod results;
mod sensitivity;

use freestand_output::figure::Figure;
use freestand_output::html::{Cell, Section, contents, document, figure, sections, words};
use freestand_study::provenance::Provenance;
use freestand_study::result::StudyResult;
use freestand_study::study::Study;
use maud::html;

/// The report of a run: HTML that is also well-formed XML.
///
/// All texts of the study and of its files are escaped; the figures are inline SVG.
pub(super) fn report(
    study: &Study,
    result: &StudyResult,
    figures: &[Figure],
    provenance: &Provenance,
) -> String {
    let varied = sensitivity::sensitivity(result).map(|content| {
        Section::new(
            "sensitivity",
            "How the result depends on its assumptions",
            content,
        )
    });
    let results = results::results(study, result, figures);
    let mut parts = vec![Section::new("results", "Results", results)];
    parts.extend(varied);
    parts.extend([
        Section::new(
            "paper",
            "Comparison with the paper",
            reading::beside_the_paper(study, result),
        ),
        Section::new("inputs", "Inputs", inputs::inputs(study, result)),
        Section::new("assumptions", "Assumptions", reading::assumptions(study)),
        Section::new("definitions", "Definitions", reading::definitions()),
        Section::new("errata", "Corrections to the paper", reading::errata()),
        Section::new(
            "provenance",
            "Provenance",
            provenance::provenance_section(study, provenance),
        ),
    ]);
    let content = html! {
        (overview::overview(study, result))
        (contents(&parts))
        (sections(&parts))
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
