//! `report.html` of an assessment: a summary and a page for each of the most urgent objects, in one
//! file that loads nothing else.

mod drawing;
mod equations;
mod page;
mod summary;

use std::collections::{BTreeMap, HashMap};

use freestand_input::problem::Problem;
use freestand_inventory::Inventory;
use freestand_output::folder::OutputFolder;
use freestand_output::html::{CLOSING, opening, without_forbidden};
use freestand_risk::budget::{BudgetPlan, PlanRow};
use maud::{Markup, html};

use super::overview::Overview;
use super::table::Line;
use super::{Head, Wanted};
use crate::signature::SIGNATURE_CSS;

/// The file's name.
pub(super) const REPORT_NAME: &str = "report.html";

/// The report as it is written: the pages of the most urgent objects so far.
pub(super) struct Report<'p> {
    max_pages: usize,
    /// The options of the plan for each object, by its id.
    options: HashMap<&'p str, Vec<&'p PlanRow>>,
    pages: BTreeMap<usize, Markup>,
}

impl<'p> Report<'p> {
    /// Without a page yet; at most `max_pages` objects get one.
    pub(super) fn new(max_pages: usize, plan: Option<&'p BudgetPlan>) -> Self {
        let mut options: HashMap<&str, Vec<&PlanRow>> = HashMap::new();
        for row in plan.into_iter().flat_map(|plan| &plan.rows) {
            options.entry(&row.id).or_default().push(row);
        }
        Self {
            max_pages,
            options,
            pages: BTreeMap::new(),
        }
    }

    /// Writes the page of an object, if it is urgent enough to have one.
    pub(super) fn add(&mut self, inventory: &Inventory, line: &Line) {
        if let Some((rank, found)) = line.found
            && rank <= self.max_pages
        {
            let options = self.options.get(line.item.id.as_str());
            let options = options.map_or(&[][..], Vec::as_slice);
            self.pages
                .insert(rank, page::page(inventory, line.item, rank, found, options));
        }
    }

    /// Writes the file.
    pub(super) fn write(
        self,
        folder: &OutputFolder,
        head: &Head,
        overview: &Overview,
        wanted: Wanted,
    ) -> Result<(), Problem> {
        let mut file = folder.begin(REPORT_NAME)?;
        let subtitle = format!(
            "Assessment of an inventory under an earthquake · freestand {}",
            env!("CARGO_PKG_VERSION")
        );
        let css = format!("{SIGNATURE_CSS}{CSS}");
        let before = [
            opening(TITLE, &subtitle, &css),
            summary::summary(head, overview, self.max_pages, wanted),
        ];
        for piece in before.into_iter().chain(self.pages.into_values()) {
            file.write(without_forbidden(piece).as_bytes())?;
        }
        file.write(CLOSING.0.as_bytes())?;
        file.finish()
    }
}

const CSS: &str = include_str!("style.css");

const TITLE: &str = "Which objects must be restrained";

/// Longest name, place or reason on a page, in characters.
const MAX_NAME_CHARS: usize = 160;

/// Longest paragraph of a user's text on a page, in characters.
const MAX_TEXT_CHARS: usize = 1_500;

/// A text for a heading or a cell, cut where it would fill the page.
fn name(text: &str) -> Markup {
    cut(text, MAX_NAME_CHARS)
}

/// A text for a paragraph, cut where it would fill pages.
fn words(text: &str) -> Markup {
    cut(text, MAX_TEXT_CHARS)
}

fn cut(text: &str, longest: usize) -> Markup {
    let shown = match text.char_indices().nth(longest) {
        None => html! { (text) },
        Some((end, _)) => html! { (text[..end]) " … " i { "(truncated)" } },
    };
    // Characters that change the direction of writing would change it for our own words after them
    // too.
    let turns = |c: char| matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    if text.contains(turns) {
        html! { bdi { (shown) } }
    } else {
        shown
    }
}

/// The anchor of an object's page.
fn anchor(rank: usize) -> String {
    format!("object-{rank}")
}

#[cfg(test)]
mod tests;
