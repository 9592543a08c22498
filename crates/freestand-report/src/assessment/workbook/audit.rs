//! The sheet for a reviewer: Eqs. (5)–(8) as live formulas next to the values of the assessment.

use freestand::G0_M_S2;
use rust_xlsxwriter::{ColNum, RowNum, Workbook, Worksheet, XlsxError};

use strum::VariantArray;

use crate::assessment::table::Line;
use freestand_assess::result::{Chain, Criterion};
use freestand_input::words::number;
use freestand_inventory::{Inventory, Item};

use super::cells::{Styles, put_formula, put_number, put_text};
use super::sheet;

/// Number of objects in the sheet, the most urgent ones: with more, a spreadsheet takes minutes to
/// open.
const MAX_OBJECTS: usize = 50_000;

/// Row of the headers, counted from 0; the objects follow.
const HEADER_ROW: RowNum = 7;

/// The cell with the acceleration of gravity.
const GRAVITY: &str = "$B$4";

/// What a column shows. A `Check` has three: formula, value of the assessment, difference.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Text,
    Input,
    Step,
    Check,
}

use Kind::{Check, Input, Step, Text};

/// Columns of the sheet, in order.
#[derive(Clone, Copy, VariantArray)]
enum Part {
    Rank,
    Id,
    Motion,
    Axis,
    HowSolved,
    Height,
    Thickness,
    Base,
    CgHeight,
    Mass,
    Stiffness,
    CgRise,
    Uplift,
    ImpactShock,
    TolerancePeak,
    ToleranceChange,
    ToleranceLift,
    HalfDiagonal,
    SideRatio,
    Inertia,
    LandingRatio,
    DropShock,
    EffectiveMass,
    EdgeVelocity,
    EdgeShock,
    VelocityChange,
    Duration,
    LargerShock,
    DemandCapacity,
}

impl Part {
    /// What it shows, and its heading.
    const fn shows(self) -> (Kind, &'static str) {
        match self {
            Self::Rank => (Text, "rank"),
            Self::Id => (Text, "id"),
            Self::Motion => (Text, "motion"),
            Self::Axis => (Text, "axis"),
            Self::HowSolved => (Text, "form"),
            Self::Height => (Input, "h height_m"),
            Self::Thickness => (Input, "t thickness_m"),
            Self::Base => (Input, "B base_m"),
            Self::CgHeight => (Input, "z cg_height_m"),
            Self::Mass => (Input, "m mass_kg"),
            Self::Stiffness => (Input, "k stiffness_n_m"),
            Self::CgRise => (Input, "Δh cg_rise_m"),
            Self::Uplift => (Input, "uplift_m"),
            Self::ImpactShock => (Input, "edge_acceleration_impact_velocity_g"),
            Self::TolerancePeak => (Input, "tolerance_g"),
            Self::ToleranceChange => (Input, "tolerance_velocity_change_m_s"),
            Self::ToleranceLift => (Input, "tolerance_edge_lift_m"),
            Self::HalfDiagonal => (Check, "R half_diagonal_m"),
            Self::SideRatio => (Step, "x = (d/R)²"),
            Self::Inertia => (Step, "I₀/m [m²]"),
            Self::LandingRatio => (Check, "R_D landing_ratio, Eq. (6)"),
            Self::DropShock => (Check, "a drop_acceleration_g, Eq. (7)"),
            Self::EffectiveMass => (Check, "m_eff effective_mass_kg"),
            Self::EdgeVelocity => (Step, "v edge_velocity_m_s"),
            Self::EdgeShock => (Check, "a_edge edge_acceleration_g, Eq. (5) or (8)"),
            Self::VelocityChange => (Check, "Δv velocity_change_m_s"),
            Self::Duration => (Check, "T pulse_duration_s"),
            Self::LargerShock => (Step, "larger shock_g"),
            Self::DemandCapacity => (Check, "demand_capacity_ratio"),
        }
    }

    /// Its first column.
    fn column(self) -> ColNum {
        FIRST[self as usize]
    }

    const fn width(self) -> ColNum {
        match self.shows().0 {
            Check => 3,
            Text | Input | Step => 1,
        }
    }
}

/// The first column of every part, and the number of columns.
const FIRST: [ColNum; Part::VARIANTS.len() + 1] = {
    let mut first = [0; Part::VARIANTS.len() + 1];
    let mut part = 0;
    while part < Part::VARIANTS.len() {
        first[part + 1] = first[part] + Part::VARIANTS[part].width();
        part += 1;
    }
    first
};

/// The sheet as it is written.
pub(super) struct Audit {
    sheet: Worksheet,
    row: RowNum,
    /// Objects without a landing.
    without: usize,
    /// Objects that are not among the most urgent.
    beyond: usize,
}

impl Audit {
    pub(super) fn begin(
        workbook: &mut Workbook,
        is_large: bool,
        styles: &Styles,
        inventory: &Inventory,
    ) -> Result<Self, XlsxError> {
        let mut sheet = sheet(workbook, is_large, "Audit")?;
        let listed = inventory.items.len().min(MAX_OBJECTS);
        put_text(
            &mut sheet,
            (0, 0),
            "Audit: Eqs. (5)–(8) for each object, at the world that decides",
            &styles.title,
        )?;
        let words = [
            "Blue: inputs. Green: live formulas, calculated by this spreadsheet. Next to each are the value of the \
             assessment and their difference, relative to that value. R_D = 1 − ⅜(d/R)² (6); a = √(2kgΔh/m) (7); \
             a_edge = ¾(1−R_D²)^(−½)(d/R)²a (5), halted ¾(d/R)²a (8); Δv = 2v, T = π√(m_eff/k).",
            "Blocks that are not uniform or have inset feet: I₀/m = (h²+t²)/12 + R², R_D = 1 − B²/(2I₀/m), v = \
             B√(2gΔh/(I₀/m)), a_edge = v√(k/m_eff). Contact laws other than a spring are solved numerically: their \
             shock has a value but no formula.",
        ];
        for (text, row) in words.iter().zip(1..) {
            put_text(&mut sheet, (row, 0), text, &styles.text)?;
        }
        put_text(&mut sheet, (3, 0), "g [m/s²]", &styles.header)?;
        put_number(&mut sheet, (3, 1), Some(G0_M_S2), &styles.input)?;
        put_text(&mut sheet, (4, 0), "largest difference", &styles.header)?;
        let ranges: Vec<String> = Part::VARIANTS
            .iter()
            .filter(|part| part.shows().0 == Check)
            .map(|part| {
                let column = letters(part.column() + 2);
                let last = HEADER_ROW + 1 + listed.max(1) as RowNum;
                format!("{column}{}:{column}{last}", HEADER_ROW + 2)
            })
            .collect();
        let ranges = ranges.join(",");
        let largest = format!("MAX(MAX({ranges}),-MIN({ranges}))");
        put_formula(&mut sheet, (4, 1), &largest, Some(0.0), &styles.difference)?;
        if inventory.items.len() > MAX_OBJECTS {
            let text = format!(
                "This sheet has only the {} most urgent objects.",
                number(MAX_OBJECTS as f64, 9)
            );
            put_text(&mut sheet, (5, 0), &text, &styles.warning)?;
        }
        headers(&mut sheet, styles)?;
        Ok(Self {
            sheet,
            row: HEADER_ROW + 1,
            without: 0,
            beyond: 0,
        })
    }

    pub(super) fn row(&mut self, styles: &Styles, line: &Line) -> Result<(), XlsxError> {
        let Some((rank, found)) = line.found else {
            return Ok(());
        };
        let Some(chain) = &found.chain else {
            self.without += 1;
            return Ok(());
        };
        if rank > MAX_OBJECTS {
            self.beyond += 1;
            return Ok(());
        }
        let governing = found.capacity.as_ref().map(|capacity| capacity.governing);
        let mut writer = Writer {
            sheet: &mut self.sheet,
            styles,
            row: self.row,
        };
        writer.names(rank, line.item, chain)?;
        writer.inputs(line.item, chain)?;
        writer.geometry(line.item, chain)?;
        writer.shock(chain)?;
        writer.capacity(line.item, chain, governing)?;
        self.row += 1;
        Ok(())
    }

    pub(super) fn finish(mut self, styles: &Styles) -> Result<Worksheet, XlsxError> {
        let last = self.row.saturating_sub(1).max(HEADER_ROW + 1);
        let notes = [
            (
                self.without,
                "without a landing: no uplift, overturned in the world that decides, or data missing",
            ),
            (
                self.beyond,
                "not among the most urgent: only in the sheet Objects",
            ),
        ];
        for ((count, note), row) in notes
            .into_iter()
            .filter(|(count, _)| *count > 0)
            .zip(last + 2..)
        {
            put_text(
                &mut self.sheet,
                (row, 0),
                &format!("Further objects, {note}: {count}"),
                &styles.text,
            )?;
        }
        self.sheet.autofilter(HEADER_ROW, 0, last, last_column())?;
        Ok(self.sheet)
    }
}

fn headers(sheet: &mut Worksheet, styles: &Styles) -> Result<(), XlsxError> {
    sheet.set_row_height(HEADER_ROW, 62)?;
    sheet.set_freeze_panes(HEADER_ROW + 1, 2)?;
    sheet.set_column_width(0, 18)?;
    for part in Part::VARIANTS {
        let ((kind, name), first) = (part.shows(), part.column());
        put_text(sheet, (HEADER_ROW, first), name, &styles.header)?;
        if first > 0 {
            let width = if kind == Text { 20.0 } else { 13.0 };
            sheet.set_column_width(first, width)?;
        }
        if kind == Check {
            let short = name.split(' ').next().unwrap_or(name);
            put_text(
                sheet,
                (HEADER_ROW, first + 1),
                &format!("{short}: value of the assessment"),
                &styles.header,
            )?;
            put_text(
                sheet,
                (HEADER_ROW, first + 2),
                &format!("{short}: difference"),
                &styles.header,
            )?;
        }
    }
    Ok(())
}

/// How the shock of an object is computed.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    /// Eqs. (5)–(8) as printed.
    Printed,
    /// The general block on a spring.
    General,
    /// Any block on a contact law that is not a spring.
    Law,
}

impl Form {
    fn of(chain: &Chain) -> Self {
        match (chain.stiffness_n_m.is_some(), chain.is_uniform) {
            (false, _) => Self::Law,
            (true, true) => Self::Printed,
            (true, false) => Self::General,
        }
    }

    fn words(self, is_halted: bool) -> &'static str {
        match (self, is_halted) {
            (Self::Printed, false) => "Eqs. (5)–(7)",
            (Self::Printed, true) => "Eqs. (7), (8): halted",
            (Self::General, false) => "general block",
            (Self::General, true) => "general block, halted",
            (Self::Law, _) => "contact law, solved numerically",
        }
    }
}

/// One row.
struct Writer<'w> {
    sheet: &'w mut Worksheet,
    styles: &'w Styles,
    row: RowNum,
}

impl Writer<'_> {
    fn names(&mut self, rank: usize, item: &Item, chain: &Chain) -> Result<(), XlsxError> {
        put_number(
            self.sheet,
            (self.row, 0),
            Some(rank as f64),
            &self.styles.count,
        )?;
        let form = Form::of(chain).words(chain.is_halted);
        for (part, text) in [
            (Part::Id, item.id.as_str()),
            (Part::Motion, &chain.motion),
            (Part::Axis, chain.axis.name()),
            (Part::HowSolved, form),
        ] {
            put_text(
                self.sheet,
                (self.row, part.column()),
                text,
                &self.styles.text,
            )?;
        }
        Ok(())
    }

    fn inputs(&mut self, item: &Item, chain: &Chain) -> Result<(), XlsxError> {
        let tolerance = item.tolerance.as_ref();
        let inputs = [
            (Part::Height, Some(chain.height_m)),
            (Part::Thickness, Some(chain.thickness_m)),
            (Part::Base, Some(chain.base_m)),
            (Part::CgHeight, Some(cg_height_m(item, chain))),
            (Part::Mass, Some(chain.mass_kg)),
            (Part::Stiffness, chain.stiffness_n_m),
            (Part::CgRise, Some(chain.cg_rise_m)),
            (Part::Uplift, Some(chain.uplift_m)),
            (
                Part::ImpactShock,
                Some(chain.edge_acceleration_impact_velocity_g),
            ),
            (
                Part::TolerancePeak,
                tolerance.and_then(|tolerance| Some(tolerance.peak_m_s2? / G0_M_S2)),
            ),
            (
                Part::ToleranceChange,
                tolerance.and_then(|tolerance| tolerance.velocity_change_m_s),
            ),
            (
                Part::ToleranceLift,
                tolerance.and_then(|tolerance| tolerance.edge_lift_m),
            ),
        ];
        for (part, value) in inputs {
            put_number(
                self.sheet,
                (self.row, part.column()),
                value,
                &self.styles.input,
            )?;
        }
        Ok(())
    }

    /// R, x, I₀/m, R_D, m_eff and v, which do not need the stiffness.
    fn geometry(&mut self, item: &Item, chain: &Chain) -> Result<(), XlsxError> {
        let is_printed = Form::of(chain) == Form::Printed;
        let [h, t, b, z, m, rise] = [
            Part::Height,
            Part::Thickness,
            Part::Base,
            Part::CgHeight,
            Part::Mass,
            Part::CgRise,
        ]
        .map(|part| self.at(part));
        let [r, x, i0, r_d] = [
            Part::HalfDiagonal,
            Part::SideRatio,
            Part::Inertia,
            Part::LandingRatio,
        ]
        .map(|part| self.at(part));
        let radius = chain.half_diagonal_m;
        let x_value = (chain.base_m / radius).powi(2);
        let i0_value = if is_printed {
            4.0 / 3.0 * radius * radius
        } else {
            let corner = cg_height_m(item, chain).hypot(0.5 * chain.base_m);
            (chain.height_m.powi(2) + chain.thickness_m.powi(2)) / 12.0 + corner * corner
        };
        let v_value = chain.base_m * (2.0 * G0_M_S2 * chain.cg_rise_m / i0_value).sqrt();
        let (radius_formula, i0_formula, r_d_formula) = if is_printed {
            (
                format!("SQRT({h}^2+{t}^2)/2"),
                format!("4/3*{r}^2"),
                format!("1-3/8*{x}"),
            )
        } else {
            (
                format!("SQRT(({b}/2)^2+{z}^2)"),
                format!("({h}^2+{t}^2)/12+{r}^2"),
                format!("1-{b}^2/(2*{i0})"),
            )
        };
        let m_eff = match (is_printed, chain.is_halted) {
            (true, false) => format!("{m}*(1-0.1875*{x})"),
            (true, true) => format!("{m}/(0.75*{x})"),
            (false, false) => format!("{m}*{i0}*(1-{r_d}^2)/{b}^2"),
            (false, true) => format!("{m}*{i0}/{b}^2"),
        };
        let velocity = if is_printed {
            format!("SQRT(0.75*{x})*SQRT(2*{GRAVITY}*{rise})")
        } else {
            format!("{b}*SQRT(2*{GRAVITY}*{rise}/{i0})")
        };
        self.check(Part::HalfDiagonal, &radius_formula, Some(radius))?;
        self.step(Part::SideRatio, &format!("({b}/{r})^2"), x_value)?;
        self.step(Part::Inertia, &i0_formula, i0_value)?;
        self.check(Part::LandingRatio, &r_d_formula, Some(chain.landing_ratio))?;
        self.check(Part::EffectiveMass, &m_eff, Some(chain.effective_mass_kg))?;
        self.step(Part::EdgeVelocity, &velocity, v_value)
    }

    /// a, a_edge, Δv, T.
    fn shock(&mut self, chain: &Chain) -> Result<(), XlsxError> {
        let [m, k, rise, x, r_d, a] = [
            Part::Mass,
            Part::Stiffness,
            Part::CgRise,
            Part::SideRatio,
            Part::LandingRatio,
            Part::DropShock,
        ]
        .map(|part| self.at(part));
        let [m_eff, v] = [Part::EffectiveMass, Part::EdgeVelocity].map(|part| self.at(part));
        let edge = match (Form::of(chain), chain.is_halted) {
            (Form::Law, _) => {
                self.value(Part::DropShock, chain.drop_acceleration_g)?;
                self.value(Part::EdgeShock, chain.edge_acceleration_g)?;
                self.value(Part::VelocityChange, chain.velocity_change_m_s)?;
                return self.value(Part::Duration, chain.pulse_duration_s);
            }
            (Form::Printed, false) => format!("3/4/SQRT(1-{r_d}^2)*{x}*{a}"),
            (Form::Printed, true) => format!("3/4*{x}*{a}"),
            (Form::General, _) => format!("{v}*SQRT({k}/{m_eff})/{GRAVITY}"),
        };
        let drop = format!("SQRT(2*{k}*{GRAVITY}*{rise}/{m})/{GRAVITY}");
        self.check(Part::DropShock, &drop, Some(chain.drop_acceleration_g))?;
        self.check(Part::EdgeShock, &edge, Some(chain.edge_acceleration_g))?;
        self.check(
            Part::VelocityChange,
            &format!("2*{v}"),
            Some(chain.velocity_change_m_s),
        )?;
        self.check(
            Part::Duration,
            &format!("PI()*SQRT({m_eff}/{k})"),
            Some(chain.pulse_duration_s),
        )
    }

    /// Demand/capacity by the governing criterion, where there is a formula for it.
    fn capacity(
        &mut self,
        item: &Item,
        chain: &Chain,
        governing: Option<Criterion>,
    ) -> Result<(), XlsxError> {
        let [edge, change, larger] =
            [Part::EdgeShock, Part::VelocityChange, Part::LargerShock].map(|part| self.at(part));
        let [impact, lift] = [Part::ImpactShock, Part::Uplift].map(|part| self.at(part));
        let peak = self.at(Part::TolerancePeak);
        let [limit, survived] =
            [Part::ToleranceChange, Part::ToleranceLift].map(|part| self.at(part));
        let shock_g = chain
            .edge_acceleration_g
            .max(chain.edge_acceleration_impact_velocity_g);
        let Some(ratio) = chain.demand_capacity_ratio else {
            return Ok(());
        };
        if Form::of(chain) == Form::Law {
            return self.value(Part::DemandCapacity, ratio);
        }
        self.step(Part::LargerShock, &format!("MAX({edge},{impact})"), shock_g)?;
        let tolerance = item.tolerance.as_ref();
        let has = |value: fn(&freestand_inventory::library::Tolerance) -> Option<f64>| {
            tolerance.and_then(value).is_some()
        };
        // On a spring the velocity change is proportional to the shock.
        let changed = format!("{change}*{larger}/{edge}/{limit}");
        let (has_peak, has_change) = (has(|t| t.peak_m_s2), has(|t| t.velocity_change_m_s));
        let formula = match governing {
            Some(Criterion::Peak) if has_peak => format!("{larger}/{peak}"),
            Some(Criterion::DamageBoundary) if has_peak && has_change => {
                format!("MIN({larger}/{peak},{changed})")
            }
            Some(Criterion::VelocityChange) if has_change => changed,
            Some(Criterion::EdgeLift) if has(|t| t.edge_lift_m) => format!("{lift}/{survived}"),
            _ => return self.value(Part::DemandCapacity, ratio),
        };
        if chain.edge_acceleration_g > 0.0 {
            self.check(Part::DemandCapacity, &formula, Some(ratio))
        } else {
            self.value(Part::DemandCapacity, ratio)
        }
    }

    /// The cell of a part in this row.
    fn at(&self, part: Part) -> String {
        format!("{}{}", letters(part.column()), self.row + 1)
    }

    /// A formula, the value of the assessment, and their difference.
    fn check(&mut self, part: Part, formula: &str, value: Option<f64>) -> Result<(), XlsxError> {
        let (row, column) = (self.row, part.column());
        put_formula(
            self.sheet,
            (row, column),
            formula,
            value,
            &self.styles.formula,
        )?;
        put_number(self.sheet, (row, column + 1), value, &self.styles.value)?;
        let [computed, ours] =
            [column, column + 1].map(|column| format!("{}{}", letters(column), row + 1));
        let difference = format!("IF({ours}=0,{computed}-{ours},{computed}/{ours}-1)");
        put_formula(
            self.sheet,
            (row, column + 2),
            &difference,
            value.map(|_| 0.0),
            &self.styles.difference,
        )
    }

    /// A value without a formula.
    fn value(&mut self, part: Part, value: f64) -> Result<(), XlsxError> {
        put_number(
            self.sheet,
            (self.row, part.column() + 1),
            Some(value),
            &self.styles.value,
        )
    }

    fn step(&mut self, part: Part, formula: &str, value: f64) -> Result<(), XlsxError> {
        put_formula(
            self.sheet,
            (self.row, part.column()),
            formula,
            Some(value),
            &self.styles.formula,
        )
    }
}

/// The last column of the sheet.
fn last_column() -> ColNum {
    FIRST[Part::VARIANTS.len()] - 1
}

/// Height of the centre of gravity, from the inventory.
fn cg_height_m(item: &Item, chain: &Chain) -> f64 {
    item.cg_height_m.unwrap_or(0.5 * chain.height_m)
}

/// A column as spreadsheets name it: A, …, Z, AA.
fn letters(column: ColNum) -> String {
    let (mut name, mut rest) = (String::new(), u32::from(column) + 1);
    while rest > 0 {
        name.insert(0, char::from(b'A' + ((rest - 1) % 26) as u8));
        rest = (rest - 1) / 26;
    }
    name
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_have_their_names() {
        assert_eq!(
            [0, 25, 26, 701, 702].map(letters),
            ["A", "Z", "AA", "ZZ", "AAA"]
        );
    }
}
