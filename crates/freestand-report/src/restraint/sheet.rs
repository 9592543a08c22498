//! `restraint.html`: a sheet to print for each object.

use freestand_input::keys::KeyStyle;
use freestand_input::words::number;
use freestand_output::html::{
    Cell, ONE_PAGE_CSS, classed_table, document, figure, list, properties, table, words,
};
use maud::{Markup, html};

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
    page(
        "Restraint of an object",
        &subtitle(case),
        &sheet(case, "", signing),
    )
}

fn page(title: &str, subtitle: &str, content: &Markup) -> String {
    let css = format!("{ONE_PAGE_CSS}{SIGNATURE_CSS}{CSS}");
    document(title, subtitle, &css, content)
}

/// `restraint.html` of a list: a table of all objects, and a sheet for each that has a force.
pub fn restraint_sheets(report: &RestrainListReport, signing: Signing) -> String {
    let held = &report.held;
    let hazard = held
        .target
        .as_ref()
        .map_or_else(String::new, Target::parts_words);
    let heading_of = |(i, heading): (usize, &'static str)| match i {
        0 | 1 => words(heading),
        _ => figure(heading),
    };
    let headings = report.headings().into_iter().enumerate();
    let headings: Vec<Cell> = headings.map(heading_of).collect();
    let rows = report.lines().zip(&held.objects);
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
    let found = held.objects.iter();
    let found = found.filter_map(|one| Some((one, one.found.as_ref().ok()?)));
    let content = html! {
        p {
            (report.held()) " of " (held.objects.len()) " objects have a force; a sheet for each follows."
        }
        (table("", &headings, rows.map(|(line, one)| cells(line, one))))
        h3 { "Assumptions and warnings" }
        (bullets(&notes))
        @for (one, case) in found {
            section.object {
                h2 { (name(one)) }
                p.sub { (about(one)) ". " (subtitle(case)) }
                (sheet(case, &one.id, signing))
            }
        }
    };
    page("Restraints of a list", &hazard, &content)
}

/// Where an object is, and how many there are of it.
fn about(one: &HeldItem) -> String {
    let many = (one.quantity > 1).then(|| format!("{} of them", one.quantity));
    let about = [
        format!("Row {} of the list", one.row),
        many.unwrap_or_default(),
        one.floor.clone(),
        one.room.clone(),
    ];
    let known: Vec<String> = about.into_iter().filter(|text| !text.is_empty()).collect();
    known.join(", ")
}

/// A line of the table of all objects; a reason takes the place of the numbers.
fn cells(line: Vec<String>, one: &HeldItem) -> Vec<Cell> {
    let columns = line.len();
    let [row, object, reason, ..] = &line[..] else {
        return line.iter().map(words).collect();
    };
    if one.found.is_err() {
        let reason = words(reason).over(columns - 2);
        return vec![words(row), words(object), reason];
    }
    let figures = line.iter().skip(2).map(figure);
    [words(row), words(object)]
        .into_iter()
        .chain(figures)
        .collect()
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
fn sheet(case: &Case, id: &str, signing: Signing) -> Markup {
    let own = &case.own;
    let factors = own.source.factors.iter().map(|factor| {
        let [symbol, value, source] = factor_words(&own.source, factor);
        [words(symbols(&symbol)), words(value), words(source)]
    });
    let lines = html! {
        div.sign {
            span { @if id.is_empty() { "Object or asset no." } @else { (id) } }
            span { "Name" }
            span { "Date and signature" }
        }
    };
    html! {
        div.sheet {
            div { (sketch(case)) }
            div { (object_and_results(case)) }
        }
        div.sheet {
            div {
                h3 { "The force" }
                p.formula { (symbols(&equation(&own.source))) }
                p.formula { "= " (numbers(&own.source)) " = " (number(own.source.part.formula_ratio, 4)) " W" }
                @if let Some(limits) = limits_words(&own.source) {
                    p { "Limits: " (limits) ": F = " (number(own.force_ratio(), 4)) " W." }
                }
                (table("", &["factor", "value", "who says so"].map(words), factors))
            }
            div {
                h3 { "The anchors" }
                (anchors(case))
            }
        }
        @if !case.others.is_empty() {
            h3 { "For comparison, on the same spectrum" }
            (others(case))
        }
        (confirmations(case))
        h3 { "Assumed" }
        (bullets(&notes(case)))
        (signature(lines, &recalled(case), ON_A_SHEET, signing))
    }
}

/// The forces by other codes.
fn others(case: &Case) -> Markup {
    let units = case.request.units;
    let titles = [
        words("clause"),
        figure("force"),
        figure("force/weight"),
        figure("tension along one edge"),
        figure("in concrete"),
    ];
    let row = |force: &RestraintForce| {
        [
            words(clause_words(&force.source)),
            figure(units.force(force.force_n)),
            figure(number(force.force_ratio(), 3)),
            figure(units.force(force.anchor_tension_n)),
            figure(units.force(force.anchor_tension_concrete_n)),
        ]
    };
    table("", &titles, case.others.iter().map(row))
}

/// Assumptions, doubts, and what the sheet does not cover.
fn notes(case: &Case) -> Vec<String> {
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
    notes.extend(remarks(&case.own.source));
    notes.push(
        "The sheet gives what the restraint must carry. Anchors, base plates, and the floor or wall that they are in \
         need a design of their own, and so does the part of the object that is held."
            .to_owned(),
    );
    notes
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
fn confirmations(case: &Case) -> Markup {
    let open = to_confirm(&case.own.source);
    let titles = [
        "not read in the code",
        "value used",
        "value in your edition",
        "initials",
    ]
    .map(words);
    let row = |one: &ToConfirm| {
        [
            words(symbols(&one.what)),
            words(&one.value),
            words(""),
            words(""),
        ]
    };
    html! {
        @if !open.is_empty() {
            section.confirm {
                h3 { "To be confirmed by the engineer (confidence: recalled)" }
                (classed_table("blanks", "", &[&titles], open.iter().map(row)))
            }
        }
    }
}

/// A list of sentences, in which keys are the flags of the command.
fn bullets(notes: &[String]) -> Markup {
    list(notes.iter().map(|note| KeyStyle::Flag.shown(note)))
}

/// A warning as a sentence.
fn sentence(warning: &str) -> String {
    let mut letters = warning.chars();
    letters.next().map_or_else(String::new, |first| {
        format!("{}{}.", first.to_uppercase(), letters.as_str())
    })
}

fn object_and_results(case: &Case) -> Markup {
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
    html! {
        (properties("The object", &object_rows))
        (properties("The restraint", &results))
    }
}

fn anchors(case: &Case) -> Markup {
    let units = case.request.units;
    let force = &case.own;
    let count = case.request.anchors.per_edge;
    let titles = [
        words(""),
        figure("tension"),
        figure("tension in concrete"),
        figure("shear"),
    ];
    let row = |name: &str, forces: [f64; 3]| {
        let [tension, concrete, shear] = forces.map(|force_n| figure(units.force_in_both(force_n)));
        [words(name), tension, concrete, shear]
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
    let rows = [
        row("all along one edge", all),
        row(&format!("each of {count}"), each),
    ];
    let table = table("", &titles, rows);
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
        [
            (
                "Design capacity of one anchor",
                capacity_words(anchor, units),
            ),
            ("Demand over capacity", ratio),
        ]
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
    html! {
        (table)
        @if let Some(chosen) = chosen {
            (properties("", &chosen))
            p { (DESIGN_CAPACITY) }
        }
        p { (symbols(&tension)) }
    }
}

/// A text with its symbols as in print: `a_p` has an index.
fn symbols(text: &str) -> Markup {
    let mut parts = text.split('_');
    html! {
        (parts.next().unwrap_or_default())
        @for part in parts {
            @let end = part.find(|c: char| !c.is_alphanumeric()).unwrap_or(part.len());
            sub { (part[..end]) } (part[end..])
        }
    }
}
