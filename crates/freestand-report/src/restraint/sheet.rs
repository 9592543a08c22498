//! `restraint.html`: a sheet to print for each object.

use freestand_input::keys::KeyStyle;
use freestand_input::words::number;
use freestand_output::html::{
    self, CLOSING, Cell, ONE_PAGE_CSS, escape, figure, heading, list, markup, opening, paragraph,
    properties, words,
};

use super::force::{ToConfirm, deduction_words, equation, numbers, remarks, to_confirm};
use super::list::{RestrainListReport, name};
use super::report::RestrainReport;
use super::sketch::sketch;
use super::words::{
    DESIGN_CAPACITY, NO_TENSION, assumptions, capacity_words, clause_words, factor_words,
    floor_words, limits_words, provenance, tension_formula, tension_words, utilisation_words,
};
use freestand_assess::restrain::{Case, HeldItem, RestraintDoubt};
use freestand_assess::restraint::force::RestraintForce;
use freestand_study::target::Target;

use crate::doubts::place_doubt;
use crate::signature::{ON_A_SHEET, SIGNATURE_CSS, Signing, signature};

/// The style of this report, added to that of a one-page report.
const CSS: &str = "\
.sheet { display: flex; gap: 1.5rem; flex-wrap: wrap; align-items: flex-start; }
.sheet > div { flex: 1 1 22rem; min-width: 0; }
.sheet svg { width: 100%; max-width: 27rem; height: auto; display: block; }
.formula { font: 1.02em Cambria, Georgia, \"Times New Roman\", serif; margin: .3rem 0 .2rem 1rem; }
.sign { display: flex; gap: 1.5rem; margin-top: 1.6rem; }
.sign span { flex: 1; border-top: 1px solid #1a1a1a; padding-top: .2rem; font-size: .85rem; color: #444; }
.confirm { border: 2px solid #b00020; padding: .1rem .8rem .6rem; margin: .8rem 0; break-inside: avoid; }
.confirm h2 { margin-top: .4rem; }
.blanks td:nth-child(3), .blanks td:nth-child(4) { min-width: 7rem; border-bottom: 1px solid #1a1a1a; }
sub { font-size: .72em; line-height: 0; }
.object { border-top: 2px solid #1a1a1a; margin-top: 2rem; }
@media print {
  .object { break-before: page; border-top: none; margin-top: 0; }
  .object > h2 { font-size: 15pt; margin: 0; border: none; padding: 0; }
  h1 { font-size: 15pt; }
  .sub { margin-bottom: .5rem; }
  .sheet { flex-wrap: nowrap; gap: .9rem; }
  .sheet > div { flex-basis: 0; }
  .sheet svg { max-height: 42mm; }
  h2, .confirm h2, h3 { margin: .35rem 0 .1rem; }
  .formula { margin: .1rem 0 .1rem 1rem; }
  ul { margin: .1rem 0; }
  .confirm { padding: 0 .6rem .3rem; margin: .4rem 0; }
  .sign { margin-top: 1.1rem; break-inside: avoid; }
}
";

/// `restraint.html` of one object.
pub fn restraint_sheet(report: &RestrainReport, signing: Signing) -> String {
    let case = &report.case;
    let html = opening(
        "Restraint of an object",
        &subtitle(case),
        &format!("{ONE_PAGE_CSS}{SIGNATURE_CSS}{CSS}"),
    );
    html + &sheet(case, "", signing) + CLOSING
}

/// `restraint.html` of a list: a table of all objects, and a sheet for each that has a force.
pub fn restraint_sheets(report: &RestrainListReport, signing: Signing) -> String {
    let held = &report.held;
    let hazard = held
        .target
        .as_ref()
        .map_or_else(String::new, Target::parts_words);
    let mut html = opening(
        "Restraints of a list",
        &hazard,
        &format!("{ONE_PAGE_CSS}{SIGNATURE_CSS}{CSS}"),
    );
    let said = format!(
        "{} of {} objects have a force; a sheet for each follows.",
        report.held(),
        held.objects.len()
    );
    html.push_str(&paragraph(&said));
    let heading_of = |(i, heading): (usize, &'static str)| match i {
        0 | 1 => words(heading),
        _ => figure(heading),
    };
    let headings = report.headings().into_iter().enumerate();
    let rows: Vec<Vec<Cell>> = report
        .lines()
        .zip(&held.objects)
        .map(|(line, one)| cells(line, one))
        .collect();
    html.push_str(&html::table(
        "",
        &[headings.map(heading_of).collect()],
        &rows,
    ));
    let source = report
        .provenance()
        .map(|source| format!("Hazard: {source}."));
    let mut notes: Vec<String> = source.into_iter().chain(report.assumptions()).collect();
    notes.extend(report.warnings.iter().map(|warning| sentence(warning)));
    notes.extend(
        report
            .problems()
            .into_iter()
            .map(|problem| format!("In the list: {problem}")),
    );
    html.push_str(&heading("Assumptions and warnings"));
    html.push_str(&bullets(&notes));
    for one in &held.objects {
        let Ok(case) = &one.found else {
            continue;
        };
        let many = (one.quantity > 1).then(|| format!("{} of them", one.quantity));
        let names = [&one.floor, &one.room].map(|name| Some(name.clone()));
        let mut about = vec![format!("Row {} of the list", one.row)];
        about.extend(
            many.into_iter()
                .chain(names.into_iter().flatten())
                .filter(|text| !text.is_empty()),
        );
        let below = format!("{}. {}", about.join(", "), subtitle(case));
        html.push_str(&format!(
            "<section class=\"object\">\n<h2>{}</h2>\n<p class=\"sub\">{}</p>\n{}</section>\n",
            escape(&name(one)),
            escape(&below),
            sheet(case, &one.id, signing)
        ));
    }
    html + CLOSING
}

/// A line of the table of all objects; a reason takes the place of the numbers.
fn cells(line: Vec<String>, one: &HeldItem) -> Vec<Cell> {
    let columns = line.len();
    let mut cells: Vec<Cell> = Vec::with_capacity(columns);
    for (i, text) in line.iter().enumerate() {
        match (i, one.found.is_err()) {
            (0 | 1, _) => cells.push(words(text)),
            (2, true) => {
                cells.push(words(text).over(columns - 2));
                break;
            }
            _ => cells.push(figure(text)),
        }
    }
    cells
}

/// The clause, the hazard and the floor.
fn subtitle(case: &Case) -> String {
    let hazard = case
        .target
        .as_ref()
        .map_or_else(String::new, |target| format!("{}. ", target.parts_words()));
    let floor = match floor_words(&case.floor) {
        floor if floor.is_empty() => floor,
        floor => format!("Floor: {floor}."),
    };
    format!("{}: {hazard}{floor}", clause_words(&case.own.source))
        .trim_end()
        .to_owned()
}

/// The sheet of one object below its title.
fn sheet(case: &Case, id: &str, signing: Signing) -> String {
    let own = &case.own;
    let units = case.request.units;
    let mut html = String::from("<div class=\"sheet\">\n<div>\n");
    html.push_str(&sketch(case));
    html.push_str("</div>\n<div>\n");
    html.push_str(&object_and_results(case));
    html.push_str("</div>\n</div>\n");
    html.push_str("<div class=\"sheet\">\n<div>\n");
    html.push_str(&heading("The force"));
    let ratio = number(own.source.part.formula_ratio, 4);
    html.push_str(&format!(
        "<p class=\"formula\">{}</p>\n<p class=\"formula\">= {} = {ratio} W</p>\n",
        symbols(&equation(&own.source)),
        escape(&numbers(&own.source))
    ));
    if let Some(limits) = limits_words(&own.source) {
        html.push_str(&format!(
            "<p>Limits: {}: F = {} W.</p>\n",
            escape(&limits),
            number(own.force_ratio(), 4)
        ));
    }
    let row = |factor| {
        let [symbol, value, source] = factor_words(&own.source, factor);
        vec![markup(symbols(&symbol), ""), words(&value), words(&source)]
    };
    let rows: Vec<Vec<Cell>> = own.source.factors.iter().map(row).collect();
    html.push_str(&html::table(
        "",
        &[vec![words("factor"), words("value"), words("who says so")]],
        &rows,
    ));
    html.push_str("</div>\n<div>\n");
    html.push_str(&heading("The anchors"));
    html.push_str(&anchors(case));
    html.push_str("</div>\n</div>\n");
    if !case.others.is_empty() {
        html.push_str(&heading("For comparison, on the same spectrum"));
        let mut titles = vec![words("clause")];
        titles.extend(
            [
                "force",
                "force/weight",
                "tension along one edge",
                "in concrete",
            ]
            .map(figure),
        );
        let row = |force: &RestraintForce| {
            vec![
                words(&clause_words(&force.source)),
                figure(units.force(force.force_n)),
                figure(number(force.force_ratio(), 3)),
                figure(units.force(force.anchor_tension_n)),
                figure(units.force(force.anchor_tension_concrete_n)),
            ]
        };
        let rows: Vec<Vec<Cell>> = case.others.iter().map(row).collect();
        html.push_str(&html::table("", &[titles], &rows));
    }
    html.push_str(&confirmations(case));
    html.push_str(&heading("Assumed"));
    let source = provenance(case.target.as_ref()).map(|source| format!("Hazard: {source}."));
    let doubt = case
        .target
        .as_ref()
        .and_then(|target| target.place.as_ref())
        .and_then(|place| place.doubt());
    let mut notes: Vec<String> = source
        .into_iter()
        .chain(doubt.map(|doubt| sentence(&place_doubt(&doubt))))
        .collect();
    notes.extend(assumptions(case));
    let lifts_nothing = case.doubts.contains(&RestraintDoubt::NoTension);
    notes.extend(lifts_nothing.then(|| sentence(NO_TENSION)));
    notes.extend(remarks(&own.source));
    notes.push(
        "The sheet gives what the restraint must carry. Anchors, base plates, and the floor or wall that they are in \
         need a design of their own, and so does the part of the object that is held."
            .to_owned(),
    );
    html.push_str(&bullets(&notes));
    let asset = if id.is_empty() {
        "Object or asset no."
    } else {
        id
    };
    let lines = format!(
        "<div class=\"sign\"><span>{}</span><span>Name</span><span>Date and signature</span></div>\n",
        escape(asset)
    );
    html + &signature(&lines, &recalled(case), ON_A_SHEET, signing)
}

/// What of a sheet is quoted from memory.
fn recalled(case: &Case) -> Vec<String> {
    let clause = clause_words(&case.own.source);
    let unread = to_confirm(&case.own.source).into_iter();
    let place = case.target.as_ref().and_then(Target::approximate_place);
    unread
        .map(|one| format!("{clause}: {}", one.what))
        .chain(place.map(|place| format!("hazard of {}", place.short_name())))
        .collect()
}

/// The box of what nobody has read in the code: an engineer writes the value of the edition beside it.
fn confirmations(case: &Case) -> String {
    let open = to_confirm(&case.own.source);
    if open.is_empty() {
        return String::new();
    }
    let titles = [
        "not read in the code",
        "value used",
        "value in your edition",
        "initials",
    ]
    .map(words);
    let row = |one: &ToConfirm| {
        vec![
            markup(symbols(&one.what), ""),
            words(&one.value),
            words(""),
            words(""),
        ]
    };
    let rows: Vec<Vec<Cell>> = open.iter().map(row).collect();
    let table = html::classed_table("blanks", "", &[titles.to_vec()], &rows);
    format!(
        "<section class=\"confirm\">\n{}{table}</section>\n",
        heading("To be confirmed by the engineer (confidence: recalled)")
    )
}

/// A list of sentences, in which keys are the flags of the command.
fn bullets(notes: &[String]) -> String {
    let shown = notes.iter().map(|note| KeyStyle::Flag.shown(note));
    list(&shown.collect::<Vec<_>>())
}

/// A warning as a sentence.
fn sentence(warning: &str) -> String {
    let mut letters = warning.chars();
    letters.next().map_or_else(String::new, |first| {
        format!("{}{}.", first.to_uppercase(), letters.as_str())
    })
}

fn object_and_results(case: &Case) -> String {
    let (force, object) = (&case.own, &case.question.object);
    let units = case.request.units;
    let length = |length_m: f64| units.length(length_m);
    let sides: Vec<String> = [
        Some(case.request.height_m),
        Some(case.request.thickness_m),
        case.request.width_m,
    ]
    .into_iter()
    .flatten()
    .map(length)
    .collect();
    let weight = format!(
        "{}, weight W = {}",
        units.mass(object.mass_kg),
        units.force_in_both(case.weight_n())
    );
    let object_rows = [
        ("Height × thickness × width", sides.join(" × ")),
        ("Mass", weight),
        (
            "Height of the centre of gravity",
            length(object.cg_height_m),
        ),
    ];
    let bracket = format!(
        "{} at {}",
        units.force_in_both(force.bracket_force_n),
        length(force.bracket_height_m)
    );
    let results = [
        ("Design force F", units.force_in_both(force.force_n)),
        (
            "Overturning moment",
            units.moment(force.overturning_moment_n_m()),
        ),
        (
            "Resisting moment of the weight",
            units.moment(force.resisting_moment_n_m()),
        ),
        (
            "Tension T along one edge",
            tension_words(units, force.anchor_tension_n),
        ),
        (
            "The same in concrete",
            tension_words(units, force.anchor_tension_concrete_n),
        ),
        ("Or a bracket, P", bracket),
        (
            "with, at the feet",
            units.force_in_both(force.bracket_base_shear_n),
        ),
    ];
    properties("The object", &object_rows) + &properties("The restraint", &results)
}

fn anchors(case: &Case) -> String {
    let units = case.request.units;
    let force = &case.own;
    let count = case.request.anchors.per_edge;
    let mut titles = vec![words("")];
    titles.extend(["tension", "tension in concrete", "shear"].map(figure));
    let row = |name: &str, forces: [f64; 3]| {
        let mut row = vec![words(name)];
        row.extend(forces.map(|force_n| figure(units.force_in_both(force_n))));
        row
    };
    let of_each = case.each_anchor();
    let all = [
        force.anchor_tension_n,
        force.anchor_tension_concrete_n,
        of_each.shear_n * count as f64,
    ];
    let each = [
        of_each.tension_n,
        of_each.tension_concrete_n,
        of_each.shear_n,
    ];
    let table = html::table(
        "",
        &[titles],
        &[
            row("all along one edge", all),
            row(&format!("each of {count}"), each),
        ],
    );
    let Some(axis) = &force.axis else {
        return table;
    };
    let length = |length_m: f64| units.length(length_m);
    let stated = if case.question.settings.anchor_inset_m.is_some() {
        ""
    } else {
        ", assumed"
    };
    let chosen = case.request.anchors.chosen.as_ref().map(|anchor| {
        let ratio = utilisation_words(case).unwrap_or_default();
        let rows = [
            (
                "Design capacity of one anchor",
                capacity_words(anchor, units),
            ),
            ("Demand over capacity", ratio),
        ];
        properties("", &rows) + &paragraph(DESIGN_CAPACITY)
    });
    let tension = format!(
        "{}, at least 0, with c = {}, e = {}, B = {} (the {}), a = {} (the distance of the anchors \
         from the edge that they hold down{stated}) and H = {} W, the weight that holds it down{}. In concrete, Ω_0 F takes the place of F, with Ω_0 = {}.",
        tension_formula(case.question.pivot),
        length(case.question.object.cg_height_m),
        length(axis.least_lever_m()),
        length(axis.base_m),
        axis.axis.name(),
        length(force.inset_m()),
        number(force.held_weight_ratio, 4),
        deduction_words(&force.source),
        number(force.source.overstrength_ratio(), 4)
    );
    format!(
        "{table}{}<p>{}</p>\n",
        chosen.unwrap_or_default(),
        symbols(&tension)
    )
}

/// A text with its symbols as in print: `a_p` has an index.
fn symbols(text: &str) -> String {
    let (mut html, mut rest) = (String::new(), text);
    while let Some((before, after)) = rest.split_once('_') {
        let index = after
            .find(|c: char| !c.is_alphanumeric())
            .unwrap_or(after.len());
        let (index, tail) = after.split_at(index);
        html.push_str(&format!("{}<sub>{}</sub>", escape(before), escape(index)));
        rest = tail;
    }
    html + &escape(rest)
}
