//! Motions, their measures and spectra.

use freestand_input::words::significant;
use freestand_output::answer::Answer;
use freestand_output::facts::Facts;
use freestand_study::floor::{FloorReport, LevelProfile};
use freestand_study::inspect::{InfoReport, RotdReport, SpectrumReport};
use freestand_study::matched::{FitReport, FittedMotion};
use freestand_study::shock_spectrum::ShockSpectrumReport;
use freestand_study::simulated::{Earthquake, SimulatedReport};
use freestand_study::target::CodeSpectrumReport;

use crate::table::{Column, cells, facts_table, failed_lines, headings, lines, table};

const MODES: [Column; 5] = [
    ("mode", "mode", 0),
    ("period_s", "period [s]", 4),
    ("damping_ratio", "damping [%]", 3),
    ("participation_ratio", "participation", 4),
    ("effective_mass_ratio", "share of the mass", 4),
];

/// The floors of a building and its modes.
pub fn floor_text(report: &FloorReport) -> String {
    let several = report.motions.len() > 1;
    let has =
        |has: fn(&LevelProfile) -> bool| report.levels.iter().any(|level| has(&level.profile));
    let mut columns = vec![("level_ratio", "level", 4), ("height_m", "height [m]", 4)];
    columns.push((
        "pfa_g",
        if several { "median PFA [g]" } else { "PFA [g]" },
        4,
    ));
    if several {
        columns.extend([("pfa_g_p16", "16 % [g]", 4), ("pfa_g_p84", "84 % [g]", 4)]);
    }
    columns.extend([("pfv_m_s", "PFV [m/s]", 4), ("pfd_m", "PFD [m]", 4)]);
    let has_drift = has(|level| level.drift_ratio.is_some());
    columns.extend(has_drift.then_some(("drift_ratio", "drift [%]", 4)));
    let is_vertical = has(|level| level.vertical.is_some());
    columns.extend(is_vertical.then_some(("pfa_vertical_g", "vertical PFA [g]", 4)));
    columns.extend(
        report
            .code_clause
            .map(|_| ("code_part_g", "code part [g]", 4)),
    );
    columns.extend((!several).then_some(("path", "file", 0)));
    let modes = report.modes.iter().enumerate();
    let modes = modes.map(|(i, mode)| Facts::default().key("mode", i + 1).and(mode.facts()));
    let levels = report.levels.iter().map(Answer::facts);
    facts_table(modes, &MODES) + "\n" + &facts_table(levels, &columns)
}

/// Shock response spectra.
pub fn shock_spectrum_text(report: &ShockSpectrumReport) -> String {
    let mut headings = vec!["f [Hz]".to_owned()];
    headings.extend(
        report
            .spectra
            .iter()
            .map(|one| format!("{} [{}]", one.name, one.unit)),
    );
    let frequencies = report
        .spectra
        .first()
        .map_or(&[][..], |one| &one.frequencies_hz);
    let rows: Vec<Vec<String>> = frequencies
        .iter()
        .enumerate()
        .map(|(i, &f)| {
            let values = report.spectra.iter().filter_map(|one| one.values.get(i));
            std::iter::once(significant(f, 5))
                .chain(values.map(|&value| significant(value, 5)))
                .collect()
        })
        .collect();
    let headings: Vec<&str> = headings.iter().map(String::as_str).collect();
    let mut text = table(&headings, &rows);
    for one in &report.spectra {
        if let Some(pulse) = &one.enveloping_half_sine {
            let pulse = pulse.facts();
            let words = |name, unit| format!("{} {unit}", pulse.cell(name, unit, 4));
            text += &format!(
                "{}: enveloped by a half-sine of {} and {}, with a velocity change of {}\n",
                one.name,
                words("peak_acceleration_g", "g"),
                words("duration_s", "ms"),
                words("velocity_change_m_s", "m/s"),
            );
        }
    }
    text
}

/// The measures of motions.
pub fn measures_text(report: &InfoReport, has_block: bool) -> String {
    let columns = if has_block {
        &MEASURES[..]
    } else {
        &MEASURES[..MEASURES.len() - 3]
    };
    let text = if let [one] = report.motions.as_slice() {
        lines(&one.facts())
    } else {
        facts_table(report.motions.iter().map(Answer::facts), columns)
    };
    text + &failed_lines(&report.failed)
}

/// The table of several motions; the last three columns need a block.
const MEASURES: [Column; 17] = [
    ("path", "file", 0),
    ("format", "format", 0),
    ("component", "component", 0),
    ("unit", "unit", 0),
    ("dt_s", "dt [s]", 0),
    ("npts", "npts", 0),
    ("pga_g", "PGA [g]", 4),
    ("pgv_m_s", "PGV [m/s]", 4),
    ("pgd_m", "PGD [m]", 4),
    ("arias_m_s", "Arias [m/s]", 4),
    ("cav_m_s", "CAV [m/s]", 4),
    ("d5_95_s", "D5-95 [s]", 4),
    ("housner_m", "Housner [m]", 4),
    ("mean_period_s", "mean period [s]", 4),
    ("pga_over_threshold_ratio", "PGA/(g tan α)", 4),
    ("pgv_over_threshold_ratio", "p PGV/(g tan α)", 4),
    ("time_above_threshold_s", "above [s]", 4),
];

const EARTHQUAKES: [Column; 3] = [
    ("pga_g", "PGA [g]", 3),
    ("pgv_m_s", "PGV [m/s]", 3),
    ("d5_95_s", "D5-95 [s]", 3),
];

/// Motions from a magnitude and a distance.
pub fn earthquakes_text(report: &SimulatedReport) -> String {
    let mut rows = Vec::new();
    for Earthquake { found, motions, .. } in &report.earthquakes {
        for one in motions {
            let source = vec![
                one.path.clone().unwrap_or_else(|| one.name.clone()),
                significant(found.source.magnitude, 3),
                significant(found.source.distance_m / 1000.0, 3),
                found
                    .corner_frequencies_hz()
                    .first()
                    .map_or(String::new(), |&corner| significant(corner, 3)),
                significant(found.source.duration_s(), 3),
            ];
            rows.push([source, cells(&one.facts(), &EARTHQUAKES)].concat());
        }
    }
    let of_source = ["motion", "M", "R [km]", "f0 [Hz]", "Td [s]"];
    let mut text = table(&[&of_source, &headings(&EARTHQUAKES)[..]].concat(), &rows);
    for one in &report.earthquakes {
        if let (Some(searched), Some(motions), Some(written)) = (
            one.found.mean_ratio_to_rock_spectrum,
            one.searched_motions,
            one.written_mean_ratio_to_site_spectrum,
        ) {
            text.push_str(&format!(
                "\nM {} at {} km: mean spectrum divided by the code spectrum, T = 0.5 to 1 s: {} for the \
                 {motions} motions of the search (rock), {} for those written (site {})",
                significant(one.found.source.magnitude, 3),
                significant(one.found.source.distance_m / 1000.0, 3),
                significant(searched, 3),
                significant(written, 3),
                report.request.site.name(),
            ));
        }
    }
    text
}

const FITS: [Column; 7] = [
    ("rms_misfit_ratio", "rms [%]", 3),
    ("worst_misfit_ratio", "worst [%]", 3),
    ("worst_misfit_period_s", "at T [s]", 3),
    ("pga_g", "PGA [g]", 3),
    ("target_zpa_g", "Sa(0) [g]", 3),
    ("pgv_m_s", "PGV [m/s]", 3),
    ("d5_95_s", "D5-95 [s]", 3),
];

/// How well motions match their target.
pub fn fits_text(report: &FitReport) -> String {
    let row = |one: &FittedMotion| {
        let name = one.path.clone().unwrap_or_else(|| one.name.clone());
        [vec![name], cells(&one.facts(), &FITS)].concat()
    };
    table(
        &[&["motion"], &headings(&FITS)[..]].concat(),
        &report.motions.iter().map(row).collect::<Vec<_>>(),
    )
}

/// The spectrum of a code.
pub fn code_spectrum_text(report: &CodeSpectrumReport) -> String {
    let mut headings = vec!["T [s]", "Sa [g]"];
    headings.extend(report.vertical_sa_g.as_ref().map(|_| "vertical [g]"));
    let row = |i: usize| {
        let vertical = report
            .vertical_sa_g
            .as_ref()
            .and_then(|values| values.get(i));
        let values = report.sa_g.get(i).into_iter().chain(vertical);
        let period = report
            .periods_s
            .get(i)
            .map(|&period| significant(period, 4));
        period
            .into_iter()
            .chain(values.map(|&sa| significant(sa, 5)))
            .collect()
    };
    let rows: Vec<Vec<String>> = (0..report.periods_s.len()).map(row).collect();
    let mut text = format!("{}\n{}", report.target.one_line(), table(&headings, &rows));
    if let Some(parts) = &report.parts {
        let rows: Vec<Vec<String>> = parts
            .levels
            .iter()
            .map(|level| {
                let height = level
                    .height_m
                    .map_or_else(|| "–".to_owned(), |height| significant(height, 4));
                vec![
                    significant(level.level_ratio, 2),
                    height,
                    significant(level.floor_acceleration_g, 4),
                ]
            })
            .collect();
        text.push_str(&format!(
            "\n{}\n{}",
            parts.clause,
            table(&["z/h", "z [m]", "floor [g]"], &rows)
        ));
    }
    text
}

/// Response spectra.
pub fn response_text(report: &SpectrumReport) -> String {
    let several = !report.more.is_empty();
    let mut headings = vec!["T [s]", "SD [m]", "PSV [m/s]", "PSA [g]", "SA [g]"];
    headings.extend(several.then_some("damping"));
    let mut rows = Vec::new();
    for one in report.all() {
        for (i, &period_s) in report.periods_s.iter().enumerate() {
            let mut row: Vec<String> = [one.sd_m[i], one.psv_m_s[i], one.psa_g[i], one.sa_g[i]]
                .iter()
                .map(|&value| significant(value, 5))
                .collect();
            row.insert(0, significant(period_s, 4));
            row.extend(several.then(|| one.damping_ratio.to_string()));
            rows.push(row);
        }
    }
    table(&headings, &rows)
}

/// Spectra over all directions.
pub fn rotd_text(report: &RotdReport) -> String {
    let columns = report.columns();
    let headings: Vec<String> = columns.iter().map(|(name, _)| heading(name)).collect();
    let headings: Vec<&str> = headings.iter().map(String::as_str).collect();
    let rows: Vec<Vec<String>> = (0..report.periods_s.len())
        .map(|row| {
            columns
                .iter()
                .filter_map(|(_, values)| values.get(row))
                .map(|v| significant(*v, 4))
                .collect()
        })
        .collect();
    table(&headings, &rows)
}

/// The heading of a column: `rotd50 [g]` for `rotd50_g`.
fn heading(name: &str) -> String {
    name.rsplit_once('_').map_or_else(
        || name.to_owned(),
        |(name, unit)| format!("{} [{unit}]", name.replace('_', " ")),
    )
}
