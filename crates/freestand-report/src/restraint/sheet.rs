//! `restraint.html`: one sheet to print.

use freestand_input::words::number;
use freestand_output::html::{
    self, CLOSING, Cell, ONE_PAGE_CSS, escape, figure, heading, list, markup, opening, properties,
    words,
};

use super::report::RestrainReport;
use super::sketch::sketch;
use super::words::{
    NO_TENSION, ToConfirm, assumptions, clause_words, factor_words, floor_words, limits_words,
    tension_words, to_confirm,
};
use freestand_assess::restrain::{Case, Doubt};
use freestand_assess::restraint::Demand;

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
@media print {
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

/// `restraint.html`.
pub fn restraint_sheet(report: &RestrainReport) -> String {
    let case = &report.case;
    let (own, force) = (&case.own, &case.own.force);
    let units = case.request.units;
    let hazard = case
        .target
        .as_ref()
        .map_or_else(String::new, |target| format!("{}. ", target.parts_words()));
    let floor = match floor_words(&case.floor) {
        floor if floor.is_empty() => floor,
        floor => format!("Floor: {floor}."),
    };
    let subtitle = format!("{}: {hazard}{floor}", clause_words(own));
    let mut html = opening(
        "Restraint of an object",
        subtitle.trim_end(),
        &format!("{ONE_PAGE_CSS}{CSS}"),
    );
    html.push_str("<div class=\"sheet\">\n<div>\n");
    html.push_str(&sketch(case));
    html.push_str("</div>\n<div>\n");
    html.push_str(&object_and_results(case));
    html.push_str("</div>\n</div>\n");
    html.push_str(&heading("The force"));
    let ratio = number(own.source.force.formula_ratio, 4);
    html.push_str(&format!(
        "<p class=\"formula\">{}</p>\n<p class=\"formula\">= {} = {ratio} W</p>\n",
        symbols(&own.source.equation),
        escape(&own.source.numbers)
    ));
    if let Some(limits) = limits_words(own) {
        html.push_str(&format!(
            "<p>Limits: {}: F = {} W.</p>\n",
            escape(&limits),
            number(force.force_ratio, 4)
        ));
    }
    let row = |factor| {
        let [symbol, value, source] = factor_words(factor);
        vec![markup(symbols(&symbol), ""), words(&value), words(&source)]
    };
    let rows: Vec<Vec<Cell>> = own.source.factors.iter().map(row).collect();
    html.push_str(&html::table(
        "",
        &[vec![words("factor"), words("value"), words("who says so")]],
        &rows,
    ));
    html.push_str(&heading("The anchors"));
    html.push_str(&anchors(case));
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
        let row = |other: &Demand| {
            let force = &other.force;
            vec![
                words(&clause_words(other)),
                figure(units.force(force.force_n)),
                figure(number(force.force_ratio, 3)),
                figure(units.force(force.anchor_tension_n)),
                figure(units.force(force.anchor_tension_concrete_n)),
            ]
        };
        let rows: Vec<Vec<Cell>> = case.others.iter().map(row).collect();
        html.push_str(&html::table("", &[titles], &rows));
    }
    html.push_str(&confirmations(case));
    html.push_str(&heading("Assumed"));
    let doubt = case
        .target
        .as_ref()
        .and_then(|target| target.place.as_ref())
        .and_then(|place| place.doubt());
    let mut notes: Vec<String> = doubt.map(|doubt| sentence(&doubt)).into_iter().collect();
    notes.extend(assumptions(case));
    let lifts_nothing = case.doubts.contains(&Doubt::NoTension);
    notes.extend(lifts_nothing.then(|| NO_TENSION.to_owned()));
    notes.extend(own.source.remarks.iter().cloned());
    notes.push(
        "The sheet gives what the restraint must carry. Anchors, base plates, and the floor or wall that they are in \
         need a design of their own, and so does the part of the object that is held."
            .to_owned(),
    );
    html.push_str(&list(&notes));
    html.push_str(
        "<div class=\"sign\"><span>Object or asset no.</span><span>Name</span><span>Date and signature</span></div>\n",
    );
    html + CLOSING
}

/// The box of what nobody has read in the code: an engineer writes the value of the edition beside it.
fn confirmations(case: &Case) -> String {
    let open = to_confirm(&case.own);
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
        heading("To be confirmed by the engineer")
    )
}

/// A warning as a sentence.
fn sentence(warning: &str) -> String {
    let mut letters = warning.chars();
    letters.next().map_or_else(String::new, |first| {
        format!("{}{}.", first.to_uppercase(), letters.as_str())
    })
}

fn object_and_results(case: &Case) -> String {
    let (own, force, object) = (&case.own, &case.own.force, &case.question.object);
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
            units.moment(own.overturning_moment_n_m),
        ),
        (
            "Resisting moment of the weight",
            units.moment(own.resisting_moment_n_m),
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
    let force = &case.own.force;
    let count = case.request.anchors_per_edge;
    let mut titles = vec![words("")];
    titles.extend(["tension", "tension in concrete", "shear"].map(figure));
    let row = |name: &str, forces: [f64; 3]| {
        let mut row = vec![words(name)];
        row.extend(forces.map(|force_n| figure(units.force_in_both(force_n))));
        row
    };
    let edge = [force.anchor_tension_n, force.anchor_tension_concrete_n];
    let all = [edge[0], edge[1], case.anchor_shear_n() * count as f64];
    let each = [
        case.anchor_n(edge[0]),
        case.anchor_n(edge[1]),
        case.anchor_shear_n(),
    ];
    let table = html::table(
        "",
        &[titles],
        &[
            row("all along one edge", all),
            row(&format!("each of {count}"), each),
        ],
    );
    let Some(axis) = &case.own.axis else {
        return table;
    };
    let length = |length_m: f64| units.length(length_m);
    let stated = if case.question.settings.anchor_inset_m.is_some() {
        ""
    } else {
        ", assumed"
    };
    let tension = format!(
        "T = (F c − H e)/(B − a), at least 0, with c = {}, e = {}, B = {} (the {}), a = {} (the distance of the anchors \
         from the edge that they hold down{stated}) and H = {} W, the weight that holds it down{}. In concrete, Ω_0 F takes the place of F, with Ω_0 = {}.",
        length(case.question.object.cg_height_m),
        length(axis.least_lever_m()),
        length(axis.base_m),
        axis.axis.name(),
        length(case.own.inset_m),
        number(force.held_weight_ratio, 4),
        case.own.source.deduction_words(),
        number(force.overstrength_ratio, 4)
    );
    format!("{table}<p>{}</p>\n", symbols(&tension))
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
