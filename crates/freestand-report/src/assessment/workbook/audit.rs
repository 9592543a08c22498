//! The sheet for a reviewer: Eqs. (5)–(8) as live formulas next to the values of the assessment.

use freestand::G0_M_S2;
use rust_xlsxwriter::{ColNum, RowNum, Workbook, Worksheet, XlsxError};

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

/// Columns of the sheet, in order. An `Input` is a value; a `Check` has three columns: formula,
/// value of the assessment, difference.
#[derive(Clone, Copy)]
enum Part {
    Text(&'static str),
    Input(&'static str),
    Step(&'static str),
    Check(&'static str),
}

use Part::{Check, Input, Step, Text};

const PARTS: [Part; 29] = [
    Text("rank"),
    Text("id"),
    Text("motion"),
    Text("axis"),
    Text("form"),
    Input("h height_m"),
    Input("t thickness_m"),
    Input("B base_m"),
    Input("z cg_height_m"),
    Input("m mass_kg"),
    Input("k stiffness_n_m"),
    Input("Δh cg_rise_m"),
    Input("uplift_m"),
    Input("edge_acceleration_impact_velocity_g"),
    Input("tolerance_g"),
    Input("tolerance_velocity_change_m_s"),
    Input("tolerance_edge_lift_m"),
    Check("R half_diagonal_m"),
    Step("x = (d/R)²"),
    Step("I₀/m [m²]"),
    Check("R_D landing_ratio, Eq. (6)"),
    Check("a drop_acceleration_g, Eq. (7)"),
    Check("m_eff effective_mass_kg"),
    Step("v edge_velocity_m_s"),
    Check("a_edge edge_acceleration_g, Eq. (5) or (8)"),
    Check("Δv velocity_change_m_s"),
    Check("T pulse_duration_s"),
    Step("larger shock_g"),
    Check("demand_capacity_ratio"),
];

/// The sheet as it is written.
pub(super) struct Audit {
    sheet: Worksheet,
    row: RowNum,
    /// Objects without a landing.
    without: usize,
    /// Objects that are not among the most urgent.
    beyond: usize,
    places: Places,
}

/// Where each part begins.
struct Places {
    first: Vec<ColNum>,
    columns: ColNum,
}

impl Places {
    fn new() -> Self {
        let (mut first, mut columns) = (Vec::new(), 0);
        for part in PARTS {
            first.push(columns);
            columns += if matches!(part, Check(_)) { 3 } else { 1 };
        }
        Self { first, columns }
    }

    /// The first column of the part whose name is `name`, or begins with it.
    fn of(&self, name: &str) -> ColNum {
        let is_it = |part: &Part| {
            let (Text(full) | Input(full) | Step(full) | Check(full)) = part;
            full.split([' ', ',']).next() == Some(name)
        };
        let index = PARTS.iter().position(is_it);
        index
            .and_then(|index| self.first.get(index))
            .copied()
            .unwrap_or_default()
    }
}

impl Audit {
    pub(super) fn begin(
        workbook: &mut Workbook,
        is_large: bool,
        styles: &Styles,
        inventory: &Inventory,
    ) -> Result<Self, XlsxError> {
        let mut sheet = sheet(workbook, is_large, "Audit")?;
        let places = Places::new();
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
        let ranges: Vec<String> = PARTS
            .iter()
            .zip(&places.first)
            .filter(|(part, _)| matches!(part, Check(_)))
            .map(|(_, first)| {
                let column = letters(first + 2);
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
        headers(&mut sheet, &places, styles)?;
        Ok(Self {
            sheet,
            row: HEADER_ROW + 1,
            without: 0,
            beyond: 0,
            places,
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
            places: &self.places,
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
        self.sheet
            .autofilter(HEADER_ROW, 0, last, self.places.columns - 1)?;
        Ok(self.sheet)
    }
}

fn headers(sheet: &mut Worksheet, places: &Places, styles: &Styles) -> Result<(), XlsxError> {
    sheet.set_row_height(HEADER_ROW, 62)?;
    sheet.set_freeze_panes(HEADER_ROW + 1, 2)?;
    sheet.set_column_width(0, 18)?;
    for (part, &first) in PARTS.iter().zip(&places.first) {
        let (Text(name) | Input(name) | Step(name) | Check(name)) = *part;
        put_text(sheet, (HEADER_ROW, first), name, &styles.header)?;
        if first > 0 {
            let width = if matches!(part, Text(_)) { 20.0 } else { 13.0 };
            sheet.set_column_width(first, width)?;
        }
        if let Check(name) = part {
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
    places: &'w Places,
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
        for (name, text) in [
            ("id", item.id.as_str()),
            ("motion", &chain.motion),
            ("axis", chain.axis.name()),
            ("form", form),
        ] {
            put_text(
                self.sheet,
                (self.row, self.places.of(name)),
                text,
                &self.styles.text,
            )?;
        }
        Ok(())
    }

    fn inputs(&mut self, item: &Item, chain: &Chain) -> Result<(), XlsxError> {
        let tolerance = item.tolerance.as_ref();
        let inputs = [
            ("h", Some(chain.height_m)),
            ("t", Some(chain.thickness_m)),
            ("B", Some(chain.base_m)),
            ("z", Some(cg_height_m(item, chain))),
            ("m", Some(chain.mass_kg)),
            ("k", chain.stiffness_n_m),
            ("Δh", Some(chain.cg_rise_m)),
            ("uplift_m", Some(chain.uplift_m)),
            (
                "edge_acceleration_impact_velocity_g",
                Some(chain.edge_acceleration_impact_velocity_g),
            ),
            (
                "tolerance_g",
                tolerance.and_then(|tolerance| Some(tolerance.peak_m_s2? / G0_M_S2)),
            ),
            (
                "tolerance_velocity_change_m_s",
                tolerance.and_then(|tolerance| tolerance.velocity_change_m_s),
            ),
            (
                "tolerance_edge_lift_m",
                tolerance.and_then(|tolerance| tolerance.edge_lift_m),
            ),
        ];
        for (name, value) in inputs {
            put_number(
                self.sheet,
                (self.row, self.places.of(name)),
                value,
                &self.styles.input,
            )?;
        }
        Ok(())
    }

    /// R, x, I₀/m, R_D, m_eff and v, which do not need the stiffness.
    fn geometry(&mut self, item: &Item, chain: &Chain) -> Result<(), XlsxError> {
        let is_printed = Form::of(chain) == Form::Printed;
        let [h, t, b, z, m, rise] = ["h", "t", "B", "z", "m", "Δh"].map(|name| self.at(name));
        let [r, x, i0, r_d] = ["R", "x", "I₀/m", "R_D"].map(|name| self.at(name));
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
        self.check("R", &radius_formula, Some(radius))?;
        self.step("x", &format!("({b}/{r})^2"), x_value)?;
        self.step("I₀/m", &i0_formula, i0_value)?;
        self.check("R_D", &r_d_formula, Some(chain.landing_ratio))?;
        self.check("m_eff", &m_eff, Some(chain.effective_mass_kg))?;
        self.step("v", &velocity, v_value)
    }

    /// a, a_edge, Δv, T.
    fn shock(&mut self, chain: &Chain) -> Result<(), XlsxError> {
        let [m, k, rise, x, r_d, a] = ["m", "k", "Δh", "x", "R_D", "a"].map(|name| self.at(name));
        let [m_eff, v] = ["m_eff", "v"].map(|name| self.at(name));
        let edge = match (Form::of(chain), chain.is_halted) {
            (Form::Law, _) => {
                self.value("a", chain.drop_acceleration_g)?;
                self.value("a_edge", chain.edge_acceleration_g)?;
                self.value("Δv", chain.velocity_change_m_s)?;
                return self.value("T", chain.pulse_duration_s);
            }
            (Form::Printed, false) => format!("3/4/SQRT(1-{r_d}^2)*{x}*{a}"),
            (Form::Printed, true) => format!("3/4*{x}*{a}"),
            (Form::General, _) => format!("{v}*SQRT({k}/{m_eff})/{GRAVITY}"),
        };
        let drop = format!("SQRT(2*{k}*{GRAVITY}*{rise}/{m})/{GRAVITY}");
        self.check("a", &drop, Some(chain.drop_acceleration_g))?;
        self.check("a_edge", &edge, Some(chain.edge_acceleration_g))?;
        self.check("Δv", &format!("2*{v}"), Some(chain.velocity_change_m_s))?;
        self.check(
            "T",
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
        let [edge, change, larger] = ["a_edge", "Δv", "larger"].map(|name| self.at(name));
        let [impact, lift] =
            ["edge_acceleration_impact_velocity_g", "uplift_m"].map(|name| self.at(name));
        let peak = self.at("tolerance_g");
        let [limit, survived] =
            ["tolerance_velocity_change_m_s", "tolerance_edge_lift_m"].map(|name| self.at(name));
        let shock_g = chain
            .edge_acceleration_g
            .max(chain.edge_acceleration_impact_velocity_g);
        let Some(ratio) = chain.demand_capacity_ratio else {
            return Ok(());
        };
        if Form::of(chain) == Form::Law {
            return self.value("demand_capacity_ratio", ratio);
        }
        self.step("larger", &format!("MAX({edge},{impact})"), shock_g)?;
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
            _ => return self.value("demand_capacity_ratio", ratio),
        };
        if chain.edge_acceleration_g > 0.0 {
            self.check("demand_capacity_ratio", &formula, Some(ratio))
        } else {
            self.value("demand_capacity_ratio", ratio)
        }
    }

    /// The cell of a part in this row.
    fn at(&self, name: &str) -> String {
        format!("{}{}", letters(self.places.of(name)), self.row + 1)
    }

    /// A formula, the value of the assessment, and their difference.
    fn check(&mut self, name: &str, formula: &str, value: Option<f64>) -> Result<(), XlsxError> {
        let (row, column) = (self.row, self.places.of(name));
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
    fn value(&mut self, name: &str, value: f64) -> Result<(), XlsxError> {
        put_number(
            self.sheet,
            (self.row, self.places.of(name) + 1),
            Some(value),
            &self.styles.value,
        )
    }

    fn step(&mut self, name: &str, formula: &str, value: f64) -> Result<(), XlsxError> {
        put_formula(
            self.sheet,
            (self.row, self.places.of(name)),
            formula,
            Some(value),
            &self.styles.formula,
        )
    }
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
        let places = Places::new();
        // No two parts share a column, and every short name finds its part.
        let found: Vec<ColNum> = PARTS
            .iter()
            .map(|part| {
                let (Text(name) | Input(name) | Step(name) | Check(name)) = part;
                places.of(name.split([' ', ',']).next().unwrap())
            })
            .collect();
        assert_eq!(found, places.first);
    }
}
