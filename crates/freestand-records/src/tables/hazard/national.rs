//! Tables as agencies publish them: AFAD, annex B of NTC, Table 3.1 of TS 1170.5.

use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;

use super::numbers::{PGV_M_S, Value, at_return_periods};
use super::sites::{Chosen, Site, Wanted, chosen};
use super::table::{Head, Row, Table};
use super::{CodeValues, GroundMeasure, HazardFormat, SiteHazard};

pub(super) fn format_of(head: &Head) -> Option<HazardFormat> {
    let has = |name: &str| head.column(name).is_some();
    match () {
        () if has("Ss-DD2") && has("S1-DD2") => Some(HazardFormat::Afad),
        () if has("T475ag") && has("T475F0") => Some(HazardFormat::Ntc),
        () if has("apoe") && has("III-PGA") => Some(HazardFormat::Ts1170_5),
        () => None,
    }
}

/// The number of a row in a column that must be there.
fn value(table: &Table, row: &Row, name: &str) -> Result<Value, Problem> {
    let column = table.head.column(name).ok_or_else(|| {
        let message = format!("there is no column \"{name}\"");
        table.head.problem(message, "download the file again")
    })?;
    table.number(row, column)
}

/// The levels of AFAD with their return periods \[years\]: 68 %, 50 %, 10 % and 2 % in 50 years.
const AFAD_LEVELS: [(&str, f64); 4] = [
    ("DD4", 43.0),
    ("DD3", 72.0),
    ("DD2", 475.0),
    ("DD1", 2475.0),
];

/// `LON,LAT,PGA-DD1,…,Ss-DD1,…,S1-DD1,…,PGV-DD4,…,PGV-DD1`, accelerations in g, PGV in cm/s; the columns of PGV are in
/// reverse order, so all are found by name.
pub(super) fn afad(table: &Table, wanted: &Wanted) -> Result<SiteHazard, Problem> {
    let (mut out, row) = table.site(HazardFormat::Afad, table.place_columns()?, None, wanted)?;
    // Ss is the value at 0.2 s, S1 that at 1 s.
    let sa = |period_s| GroundMeasure::Sa { period_s };
    let measures = [
        ("PGA", GroundMeasure::Pga, 1.0),
        ("Ss", sa(0.2), 1.0),
        ("S1", sa(1.0), 1.0),
        ("PGV", GroundMeasure::Pgv, PGV_M_S),
    ];
    for (name, measure, factor) in measures {
        let levels = AFAD_LEVELS.map(|(level, years)| {
            value(table, row, &format!("{name}-{level}")).map(|value| (years, value))
        });
        let levels = levels.into_iter().collect::<Result<Vec<_>, _>>()?;
        out.curves.push(at_return_periods(measure, factor, levels)?);
    }
    let pair = |name: &str| {
        let [one, two] = ["DD2", "DD1"].map(|level| value(table, row, &format!("{name}-{level}")));
        Ok::<_, Problem>([one?.number, two?.number])
    };
    out.code = Some(CodeValues::Tbdy2018 {
        ss_g: pair("Ss")?,
        s1_g: pair("S1")?,
    });
    Ok(out)
}

/// The return periods of annex B \[years\].
pub const NTC_YEARS: [u32; 9] = [30, 50, 72, 101, 140, 201, 475, 975, 2475];

/// `ID,LON,LAT,T30ag,T30F0,T30Tc,…`: ag in g/10 on rock, at nodes on ED50, which is some 130 m from WGS 84.
pub(super) fn ntc(table: &Table, wanted: &Wanted) -> Result<SiteHazard, Problem> {
    let (mut out, row) = table.site(HazardFormat::Ntc, table.place_columns()?, None, wanted)?;
    let levels = NTC_YEARS.map(|years| {
        value(table, row, &format!("T{years}ag")).map(|value| (f64::from(years), value))
    });
    let levels = levels.into_iter().collect::<Result<Vec<_>, _>>()?;
    out.curves
        .push(at_return_periods(GroundMeasure::Pga, 0.1, levels)?);
    out.code = Some(CodeValues::Ntc2018);
    Ok(out)
}

/// A row of Table 3.1 of TS 1170.5:2025.
#[derive(Debug, Clone, PartialEq)]
pub struct TsRow {
    /// Return period \[years\].
    pub years: u32,
    /// The mean magnitude of the earthquakes behind the values.
    pub magnitude: Option<f64>,
    /// To the nearest fault; 20 stands for more, `None` where the table has none \[km\].
    pub fault_distance_km: Option<f64>,
    /// PGA and Sa,s \[g\], Tc and Td \[s\] for classes I to VI.
    pub values: [[f64; 4]; 6],
}

/// `"location","location_ascii","apoe","M","D","I-PGA","I-Sas","I-Tc","I-Td",…`: one row for a settlement and a probability such
/// as `" 1/500"`; D is `>20`, `n/a` or a number.
pub(super) fn ts1170_5(table: &Table, wanted: &Wanted) -> Result<SiteHazard, Problem> {
    let head = &table.head;
    let column = |name: &str| {
        head.column(name).ok_or_else(|| {
            let message = format!("there is no column \"{name}\"");
            head.problem(message, "download the file again")
        })
    };
    let (location, apoe, distance) = (column("location")?, column("apoe")?, column("D")?);
    let ascii = head.column("location_ascii").unwrap_or(location);
    let mut sites: Vec<Site> = Vec::new();
    for row in &table.rows {
        let name = table.text(row, location);
        if sites.last().and_then(|site| site.name.as_deref()) != Some(name) {
            sites.push(Site {
                line: Some(row.line),
                name: Some(name.to_owned()),
                at: None,
            });
        }
    }
    let Chosen { index, .. } =
        chosen(&sites, wanted).map_err(|problem| problem.at_line(head.line))?;
    let name = sites[index].name.clone().unwrap_or_default();
    let mut levels: Vec<(TsRow, Value)> = Vec::new();
    let rows = table.rows.iter().filter(|row| {
        [location, ascii]
            .iter()
            .any(|&column| table.text(row, column) == name)
    });
    for row in rows {
        let text = table.text(row, apoe);
        let years = text
            .strip_prefix("1/")
            .and_then(|years| years.trim().parse::<u32>().ok())
            .filter(|years| *years > 0);
        let Some(years) = years else {
            let message = format!(
                "the annual probability \"{}\" is not 1/years",
                shorten(text)
            );
            return Err(Problem::value(message, "write it as 1/500").at_line(row.line));
        };
        let fault_distance_km = match table.text(row, distance) {
            ">20" => Some(20.0),
            "n/a" | "" => None,
            _ => Some(table.number(row, distance)?.number),
        };
        let mut values = [[0.0; 4]; 6];
        for (class, of_class) in ["I", "II", "III", "IV", "V", "VI"].iter().zip(&mut values) {
            for (what, cell) in ["PGA", "Sas", "Tc", "Td"].iter().zip(of_class) {
                let found = value(table, row, &format!("{class}-{what}"))?;
                if !(found.number > 0.0 && found.number.is_finite()) {
                    let message = format!("{} is not a number above 0", found.number);
                    return Err(found.problem(message, "download the file again"));
                }
                *cell = found.number;
            }
        }
        levels.push((
            TsRow {
                years,
                magnitude: value(table, row, "M").ok().map(|value| value.number),
                fault_distance_km,
                values,
            },
            value(table, row, "III-PGA")?,
        ));
    }
    levels.sort_by_key(|(level, _)| level.years);
    // The curve is that of class III, near the class C of NZS 1170.5.
    let points = levels
        .iter()
        .map(|(level, value)| (f64::from(level.years), value.clone()));
    // Two digits after the point: neighbours may be equal at the shortest return periods, and the rarer one counts.
    let mut rising: Vec<(f64, Value)> = Vec::new();
    for (years, value) in points {
        if rising
            .last()
            .is_some_and(|(_, last)| last.number == value.number)
        {
            rising.pop();
        }
        rising.push((years, value));
    }
    Ok(SiteHazard {
        sites: sites.len(),
        name: Some(name),
        curves: vec![at_return_periods(GroundMeasure::Pga, 1.0, rising)?],
        code: Some(CodeValues::Ts1170_5(
            levels.into_iter().map(|(level, _)| level).collect(),
        )),
        ..SiteHazard::of(HazardFormat::Ts1170_5)
    })
}
