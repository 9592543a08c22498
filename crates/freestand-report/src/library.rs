//! The entries of the two libraries.

use freestand_input::quantity::{Dimension, format_si};
use freestand_input::words::{counted, name_of, number};
use freestand_inventory::library::{CushionEntry, ToleranceEntry, to_tolerance};
use freestand_study::shock_spectrum::SHAPES;

use crate::table::{pairs, table};

/// Labels and values.
pub type Fields = Vec<(&'static str, Option<String>)>;

/// How the entries of a library are printed.
#[derive(Debug)]
pub struct Layout<E> {
    /// The headings of a list.
    pub headings: [&'static str; 6],
    /// The cells of an entry.
    pub cells: fn(&E) -> [String; 6],
    /// A remark after the count.
    pub remark: &'static str,
    /// All fields of an entry, of which empty ones are left out.
    pub fields: fn(&E) -> Fields,
    /// The notice that an entry requires.
    pub notice: fn(&E) -> &str,
}

/// Tolerances.
pub const TOLERANCES: Layout<ToleranceEntry> = Layout {
    headings: ["id", "withstands", "state", "confidence", "class", "source"],
    cells: |entry| {
        let (state, confidence) = (
            <&str>::from(entry.state).to_owned(),
            entry.confidence.name().to_owned(),
        );
        [
            entry.id.clone(),
            entry.words(),
            state,
            confidence,
            entry.class.clone(),
            entry.source_words(),
        ]
    },
    remark: "recalled entries do not decide verdicts, and medians are not tolerances",
    fields: tolerance_fields,
    notice: |entry| &entry.notice,
};

/// Cushions.
pub const CUSHIONS: Layout<CushionEntry> = Layout {
    headings: [
        "id",
        "stiffness range",
        "mean",
        "confidence",
        "item",
        "source",
    ],
    cells: |entry| {
        let confidence = entry.confidence.name().to_owned();
        [
            entry.id.clone(),
            entry.range_words(),
            mean(entry),
            confidence,
            entry.item.clone(),
            entry.source_words(),
        ]
    },
    remark: "estimates, not measurements",
    fields: cushion_fields,
    notice: |_| "",
};

/// The entries of a list in rows, with their number.
pub fn entries_text<E>(entries: &[&E], layout: &Layout<E>) -> String {
    if entries.is_empty() {
        return "no entry contains all of these words\n".to_owned();
    }
    let rows: Vec<_> = entries
        .iter()
        .map(|entry| (layout.cells)(entry).to_vec())
        .collect();
    table(&layout.headings, &rows)
        + &format!("{}; {}\n", counted(rows.len(), "entry"), layout.remark)
}

/// All that is known of one entry.
pub fn entry_text<E>(entry: &E, layout: &Layout<E>) -> String {
    let fields = (layout.fields)(entry).into_iter();
    let given =
        fields.filter_map(|(name, value)| Some((name, value.filter(|value| !value.is_empty())?)));
    let notice = (layout.notice)(entry);
    let notice = if notice.is_empty() {
        String::new()
    } else {
        format!("\n{notice}\n")
    };
    pairs(&given.collect::<Vec<_>>()) + &notice
}

fn tolerance_fields(entry: &ToleranceEntry) -> Fields {
    let si = |value: Option<f64>, dimension| value.map(|value| format_si(value, dimension));
    let text = |text: &str| Some(text.to_owned());
    let decides = match (entry.decides, to_tolerance(entry)) {
        (true, Some(_)) => "a verdict may depend on it",
        (false, Some(_)) => "no verdict depends on it",
        (_, None) => "not a tolerance: shown for comparison only",
    };
    vec![
        ("id", text(&entry.id)),
        ("class", text(&entry.class)),
        ("kind", text(entry.kind.into())),
        ("state", text(<&str>::from(entry.state))),
        ("axis", text(&entry.axis)),
        ("peak", si(entry.peak_m_s2, Dimension::Acceleration)),
        (
            "peak, high end",
            si(entry.peak_high_m_s2, Dimension::Acceleration),
        ),
        ("duration", si(entry.duration_s, Dimension::Time)),
        (
            "shape",
            entry.shape.map(|shape| name_of(SHAPES, shape).to_owned()),
        ),
        (
            "velocity change of the pulse",
            entry
                .pulse_velocity_change_m_s
                .map(|v| format!("{} m/s", number(v, 3))),
        ),
        (
            "critical velocity change",
            si(entry.velocity_change_m_s, Dimension::Velocity),
        ),
        ("uplift", si(entry.edge_lift_m, Dimension::Length)),
        (
            "median peak floor acceleration",
            si(entry.pfa_median_m_s2, Dimension::Acceleration),
        ),
        (
            "median peak floor velocity",
            si(entry.pfv_median_m_s, Dimension::Velocity),
        ),
        ("beta", entry.beta.map(|beta| number(beta, 4))),
        ("shocks", entry.n_shocks.map(|count| count.to_string())),
        ("source", text(&entry.source)),
        ("edition", text(&entry.edition)),
        ("clause", text(&entry.clause)),
        ("page", text(&entry.page)),
        ("licence", text(&entry.licence)),
        (
            "confidence",
            Some(format!(
                "{}: {}",
                entry.confidence.name(),
                entry.confidence.description()
            )),
        ),
        ("use", text(decides)),
        ("note", text(&entry.note)),
        ("origin", text(&entry.origin)),
    ]
}

/// The mean stiffness: three digits are enough for so wide a range.
fn mean(entry: &CushionEntry) -> String {
    format!("{} N/mm", number(entry.stiffness_n_m / 1e3, 3))
}

fn cushion_fields(entry: &CushionEntry) -> Fields {
    let text = |text: &str| Some(text.to_owned());
    vec![
        ("id", text(&entry.id)),
        ("item", text(&entry.item)),
        ("stiffness range", Some(entry.range_words())),
        ("geometric mean", Some(mean(entry))),
        (
            "scatter of ln k",
            Some(format!(
                "{} (the range is taken as 16 to 84 %)",
                number(entry.log_sd, 3)
            )),
        ),
        (
            "thickness",
            entry.thickness_m.map(|t| format_si(t, Dimension::Length)),
        ),
        (
            "pads per edge",
            Some(format!(
                "{} unless the inventory gives another number",
                entry.pads_per_edge
            )),
        ),
        ("source", text(&entry.source)),
        ("edition", text(&entry.edition)),
        ("clause", text(&entry.clause)),
        ("page", text(&entry.page)),
        (
            "confidence",
            Some(format!(
                "{}: {}",
                entry.confidence.name(),
                entry.confidence.description()
            )),
        ),
        (
            "use",
            text("an estimate, not a measurement: a drop test is better"),
        ),
        ("note", text(&entry.note)),
        ("origin", text(&entry.origin)),
    ]
}
