//! The tolerance library: what objects withstand.

use freestand::G0_M_S2;
use freestand::shock_response::{Pulse, PulseShape};
use schemars::JsonSchema;
use serde::{Serialize, Serializer};
use strum::{IntoStaticStr, VariantArray};

use freestand_input::problem::Problems;
use freestand_input::quantity::{Dimension, format_si};
use freestand_input::words::{name_of, number};
use freestand_study::shock_spectrum::SHAPES;

use super::collection::{Library, Shelf};
use super::reader::RowReader;
use super::table::{Column, Row, Table};
use super::{Confidence, Tolerance};

/// The columns of a tolerance library; numbers have their unit in brackets, such as `peak [g]`.
const TOLERANCE_COLUMNS: [Column; 23] = [
    Column::text("id").needed(),
    Column::text("class").needed(),
    Column::text("kind").needed(),
    Column::text("state").needed(),
    Column::text("axis"),
    Column::number("peak", Dimension::Acceleration),
    Column::number("peak_high", Dimension::Acceleration),
    Column::number("duration", Dimension::Time),
    Column::text("shape"),
    Column::number("velocity_change", Dimension::Velocity),
    Column::number("edge_lift", Dimension::Length),
    Column::number("pfa_median", Dimension::Acceleration),
    Column::number("pfv_median", Dimension::Velocity),
    Column::number("beta", Dimension::Ratio),
    Column::text("n_shocks"),
    Column::text("source").needed(),
    Column::text("edition"),
    Column::text("clause"),
    Column::text("page"),
    Column::text("licence"),
    Column::text("notice"),
    Column::text("confidence").needed(),
    Column::text("note"),
];

/// The library of tolerances.
pub type ToleranceLibrary = Library<ToleranceEntry>;

static SHELF: Shelf<ToleranceEntry> = Shelf {
    name: "tolerance",
    columns: &TOLERANCE_COLUMNS,
    builtin: include_bytes!("tolerance.csv"),
    read: ToleranceEntry::read,
    id: |entry| &entry.id,
    texts: |entry| {
        let ToleranceEntry {
            id,
            class,
            kind,
            state,
            source,
            clause,
            note,
            ..
        } = entry;
        vec![id, class, kind.into(), state.into(), source, clause, note]
    },
};

impl ToleranceLibrary {
    /// The built-in library.
    ///
    /// # Example
    /// ```
    /// use freestand_inventory::library::{ToleranceLibrary, to_tolerance};
    /// let library = ToleranceLibrary::builtin();
    /// let card = library.find("expansion-card-operating").and_then(to_tolerance).unwrap();
    /// assert!((card.peak_m_s2.unwrap() - 5.0 * 9.80665).abs() < 1e-12 && card.duration_s == Some(0.011));
    /// assert!(library.find("p58-bookcase-5-shelves").and_then(to_tolerance).is_none(), "a median is not a tolerance");
    /// ```
    pub fn builtin() -> Self {
        Self::new(&SHELF)
    }
}

/// What the numbers of an entry are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema, IntoStaticStr, VariantArray)]
#[strum(serialize_all = "kebab-case")]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// The maker states that it withstands this; not a median.
    VendorLimit,
    /// It passed, or must pass, a test of this severity.
    TestSeverity,
    /// A range for a class of objects; the low end is the tolerance.
    Class,
    /// Median and dispersion of the floor motion at which such objects fail or overturn: for
    /// comparison only, never a tolerance.
    Fragility,
}

/// The state of the object to which the tolerance applies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema, IntoStaticStr, VariantArray)]
#[strum(serialize_all = "kebab-case")]
#[serde(rename_all = "kebab-case")]
pub enum State {
    /// Operating, and continues to operate.
    Operating,
    /// Switched off.
    NonOperating,
    /// In its packaging.
    Packaged,
    /// The source does not state it, or leaves it to the product.
    Any,
}

/// An entry of the tolerance library; `None` where its source gives no value. The keys are those of
/// the JSON document.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ToleranceEntry {
    /// Unique, in lower case.
    pub id: String,
    /// What it is.
    pub class: String,
    /// What the numbers are.
    pub kind: Kind,
    /// The state to which they apply.
    pub state: State,
    /// Along which axis: `any`, or in words.
    pub axis: String,
    /// Peak acceleration \[m/s²\]; the low end of a range.
    pub peak_m_s2: Option<f64>,
    /// \[g\].
    pub peak_g: Option<f64>,
    /// High end of the range \[m/s²\].
    pub peak_high_m_s2: Option<f64>,
    /// \[g\].
    pub peak_high_g: Option<f64>,
    /// Duration of the pulse of that peak \[s\].
    pub duration_s: Option<f64>,
    /// Its shape; `None` without a duration.
    #[serde(serialize_with = "name_of_shape")]
    #[schemars(with = "Option<String>")]
    pub shape: Option<PulseShape>,
    /// Velocity change of that pulse itself, 2AT/π for a half-sine \[m/s\]; not a tolerance by
    /// itself.
    pub pulse_velocity_change_m_s: Option<f64>,
    /// Critical velocity change: below it no peak causes damage \[m/s\].
    pub velocity_change_m_s: Option<f64>,
    /// Uplift, or drop height, from which it may fall without damage \[m\].
    pub edge_lift_m: Option<f64>,
    /// Peak floor acceleration at which half of the objects fail \[m/s²\].
    pub pfa_median_m_s2: Option<f64>,
    /// \[g\].
    pub pfa_median_g: Option<f64>,
    /// Peak floor velocity at which half of the objects fail \[m/s\].
    pub pfv_median_m_s: Option<f64>,
    /// Dispersion: the standard deviation of the logarithm of the demand.
    pub beta: Option<f64>,
    /// Number of shocks of the test.
    pub n_shocks: Option<u32>,
    /// Document.
    pub source: String,
    /// Its edition.
    pub edition: String,
    /// Clause, table or entry in it.
    pub clause: String,
    /// Page.
    pub page: String,
    /// Licence of the numbers.
    pub licence: String,
    /// The notice that the licence requires.
    pub notice: String,
    /// The confidence in its source.
    pub confidence: Confidence,
    /// Whether a verdict may depend on it.
    pub decides: bool,
    /// Notes.
    pub note: String,
    /// `built-in`, or the user's file.
    pub origin: String,
}

impl ToleranceEntry {
    fn read(table: &Table, row: &Row, origin: &str) -> Result<Self, Problems> {
        let mut reader = RowReader::new(table, row);
        let id = reader.id();
        let class = reader.needed("class");
        let kind = reader.word("kind", Kind::VARIANTS);
        let state = reader.word("state", State::VARIANTS);
        let peak_m_s2 = reader.positive("peak", Dimension::Acceleration);
        let peak_high_m_s2 = reader.positive("peak_high", Dimension::Acceleration);
        let duration_s = reader.positive("duration", Dimension::Time);
        let shape = shape(&mut reader, duration_s);
        let in_g = |value: Option<f64>| value.map(|value| value / G0_M_S2);
        let pfa_median_m_s2 = reader.positive("pfa_median", Dimension::Acceleration);
        let axis = Some(reader.text("axis"))
            .filter(|axis| !axis.is_empty())
            .unwrap_or_else(|| "any".to_owned());
        let pulse = shape.zip(peak_m_s2).zip(duration_s);
        let confidence = reader.confidence();
        let entry = Self {
            id,
            class,
            kind: kind.unwrap_or(Kind::Class),
            state: state.unwrap_or(State::Any),
            axis,
            peak_m_s2,
            peak_g: in_g(peak_m_s2),
            peak_high_m_s2,
            peak_high_g: in_g(peak_high_m_s2),
            duration_s,
            shape,
            pulse_velocity_change_m_s: pulse
                .and_then(|((shape, peak), duration)| Pulse::new(shape, peak, duration).ok())
                .map(|pulse| pulse.velocity_change_m_s()),
            velocity_change_m_s: reader.positive("velocity_change", Dimension::Velocity),
            edge_lift_m: reader.positive("edge_lift", Dimension::Length),
            pfa_median_m_s2,
            pfa_median_g: in_g(pfa_median_m_s2),
            pfv_median_m_s: reader.positive("pfv_median", Dimension::Velocity),
            beta: reader.beta("beta"),
            n_shocks: reader.count("n_shocks"),
            source: reader.text("source"),
            edition: reader.text("edition"),
            clause: reader.text("clause"),
            page: reader.text("page"),
            licence: reader.text("licence"),
            notice: notice(reader.text("notice")),
            confidence,
            decides: confidence.decides() && kind != Some(Kind::Fragility),
            note: reader.text("note"),
            origin: origin.to_owned(),
        };
        // A cell that cannot be read would be reported again as missing.
        if reader.problems.is_empty() {
            entry.check(&mut reader);
        }
        reader.problems.finish(Some(entry))
    }

    /// Reports numbers that contradict each other.
    fn check(&self, reader: &mut RowReader<'_>) {
        let count = |values: &[Option<f64>]| values.iter().flatten().count();
        let medians = count(&[self.pfa_median_m_s2, self.pfv_median_m_s]);
        let limits = count(&[self.peak_m_s2, self.velocity_change_m_s, self.edge_lift_m]);
        let mut note = |column, message, hint| reader.note(column, message, hint);
        if self.kind == Kind::Fragility {
            if medians != 1 || self.beta.is_none() || limits > 0 {
                note(
                    "kind",
                    "a fragility has one median and its dispersion",
                    "give pfa_median or pfv_median, with beta, and no peak, velocity_change or edge_lift",
                );
            }
        } else {
            if medians > 0 || self.beta.is_some() {
                note(
                    "kind",
                    "medians and beta belong to a fragility",
                    "use the kind fragility, or leave them empty",
                );
            }
            if limits == 0 {
                note(
                    "peak",
                    "the entry has no tolerance",
                    "give peak, velocity_change or edge_lift",
                );
            }
        }
        if self.duration_s.is_some() && self.peak_m_s2.is_none() {
            note(
                "duration",
                "a duration needs a peak",
                "give the peak of the pulse",
            );
        }
        if self
            .peak_high_m_s2
            .is_some_and(|high| self.peak_m_s2.is_none_or(|low| high < low))
        {
            note(
                "peak_high",
                "a range goes from peak to peak_high",
                "give the low end in peak",
            );
        }
    }

    /// Its numbers in words: `5 g, 11 ms half-sine`, `median PFV 0.29 m/s, β 0.5`.
    pub fn words(&self) -> String {
        let mut parts = Vec::new();
        if let Some(peak) = self.peak_m_s2 {
            let words = match self.peak_high_m_s2 {
                Some(high) => range_words(peak, high, Dimension::Acceleration),
                None => format_si(peak, Dimension::Acceleration),
            };
            parts.push(words);
        }
        if let (Some(duration), Some(shape)) = (self.duration_s, self.shape) {
            let duration = format_si(duration, Dimension::Time);
            parts.push(format!("{duration} {}", name_of(SHAPES, shape)));
        }
        for (name, value, dimension) in [
            ("Δv", self.velocity_change_m_s, Dimension::Velocity),
            ("uplift", self.edge_lift_m, Dimension::Length),
            ("median PFA", self.pfa_median_m_s2, Dimension::Acceleration),
            ("median PFV", self.pfv_median_m_s, Dimension::Velocity),
        ] {
            parts.extend(value.map(|value| format!("{name} {}", format_si(value, dimension))));
        }
        parts.extend(self.beta.map(|beta| format!("β {}", number(beta, 3))));
        parts.join(", ")
    }

    /// Its source, ready to print: document, edition, clause, page.
    pub fn source_words(&self) -> String {
        source_words(&self.source, &self.edition, &self.clause, &self.page)
    }
}

/// `803–3196 N/mm`.
pub(super) fn range_words(low: f64, high: f64, dimension: Dimension) -> String {
    let (low, high) = (format_si(low, dimension), format_si(high, dimension));
    format!("{}–{high}", low.split(' ').next().unwrap_or(&low))
}

/// `document, edition, clause, p. 7`, without empty parts.
pub(super) fn source_words(source: &str, edition: &str, clause: &str, page: &str) -> String {
    let page = if page.is_empty() {
        String::new()
    } else {
        format!("p. {page}")
    };
    let parts = [source, edition, clause, &page]
        .into_iter()
        .filter(|part| !part.is_empty());
    let words = parts.collect::<Vec<_>>().join(", ");
    if words.is_empty() {
        "no source".to_owned()
    } else {
        words
    }
}

fn name_of_shape<S: Serializer>(
    shape: &Option<PulseShape>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    shape
        .map(|shape| name_of(SHAPES, shape))
        .serialize(serializer)
}

/// The shape of a pulse; without one, a pulse with a duration is a half-sine.
fn shape(reader: &mut RowReader<'_>, duration_s: Option<f64>) -> Option<PulseShape> {
    let text = reader.text("shape");
    match (text.is_empty(), duration_s) {
        (true, _) => duration_s.map(|_| PulseShape::HalfSine),
        (false, None) => {
            let hint = "give the duration, or leave the shape empty";
            reader.note("shape", "a shape needs a duration", hint);
            None
        }
        (false, Some(_)) => {
            reader.one_of("shape", &PulseShape::ALL, |shape| name_of(SHAPES, shape))
        }
    }
}

/// The notice; one that many entries share has a short name.
fn notice(text: String) -> String {
    if text == "dlml" {
        include_str!("dlml-notice.txt").trim().to_owned()
    } else {
        text
    }
}

/// The tolerance of an object with this entry; `None`: the entry is a fragility, or its pulse is
/// not a half-sine, the only shape with which demands are compared.
///
/// A range gives its low end. The velocity change of the pulse does not become a critical velocity
/// change.
pub fn to_tolerance(entry: &ToleranceEntry) -> Option<Tolerance> {
    let is_comparable = entry
        .shape
        .is_none_or(|shape| shape == PulseShape::HalfSine);
    (entry.kind != Kind::Fragility && is_comparable).then(|| Tolerance {
        peak_m_s2: entry.peak_m_s2,
        duration_s: entry.duration_s,
        velocity_change_m_s: entry.velocity_change_m_s,
        edge_lift_m: entry.edge_lift_m,
        source: format!(
            "{}: {} ({})",
            entry.id,
            entry.source_words(),
            entry.confidence.name()
        ),
        confidence: entry.confidence,
    })
}
