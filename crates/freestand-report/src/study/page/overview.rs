//! The top of the report: title, summary, first table and warnings.

use crate::doubts::study_doubts;
use crate::ground::{earthquake, simulated_earthquakes};
use freestand_input::file::file_name;
use freestand_input::keys::KeyStyle;
use freestand_input::words::{counted, fixed, number, percent};
use freestand_output::html::escape;
use freestand_study::cushion::cushion_words;
use freestand_study::result::{ObjectResponse, StudyResult};
use freestand_study::study::{Ground, Study};
use freestand_study::summary::{LevelSummary, level_summaries};

use super::or_dash;
use freestand_output::html::{classed_table, figure, list, markup, paragraph, table, words};
use freestand_study::provenance::Provenance;

/// Title of the report.
pub(super) fn title(study: &Study) -> String {
    match &study.ground {
        Ground::Synthetic(synthetic) => {
            format!("Free-standing objects in {}", earthquake(&synthetic.target))
        }
        Ground::Simulated(simulated) => {
            format!(
                "Free-standing objects in {}",
                simulated_earthquakes(simulated)
            )
        }
        Ground::Recorded(records) if records.len() == 1 => {
            format!("Free-standing objects under the motion {}", records[0].name)
        }
        Ground::Recorded(records) => {
            let matched = match (study.ground.target(), study.ground.suite()) {
                (Some(_), _) => ", matched to a spectrum",
                (None, Some(_)) => ", selected for a spectrum",
                (None, None) => "",
            };
            format!(
                "Free-standing objects under {} recorded motions{matched}",
                records.len()
            )
        }
        Ground::OnFloors => match &study.levels[..] {
            [level] => format!(
                "Free-standing objects on a floor with a given motion: {}",
                level.name
            ),
            levels => format!(
                "Free-standing objects on {} floors with given motions",
                levels.len()
            ),
        },
    }
}

/// The line under the title.
pub(super) fn subtitle(study: &Study, provenance: &Provenance) -> String {
    let source = study.source.as_deref().and_then(file_name);
    let source = source.unwrap_or_else(|| "the built-in study".to_owned());
    format!(
        "Shock and overturning by rocking · {source} · freestand {}",
        provenance.version
    )
}

/// Summary, first table and warnings.
pub(super) fn overview(study: &Study, result: &StudyResult) -> String {
    let levels: Vec<LevelSummary> = level_summaries(study, result);
    let mut html = paragraph(&job_words(study, result, &levels));
    html += "<ul>\n";
    for level in &levels {
        html += &format!(
            "<li><strong>{}</strong>: {}</li>\n",
            escape(&level.level),
            escape(&level_words(level))
        );
    }
    html += "</ul>\n";
    html += &first_table(&levels);
    html += &tolerance_words(study, &levels);
    html += &failures(result);
    html += "<div class=\"warn\">\n<h2>Validity warnings</h2>\n";
    if result.doubts.is_empty() {
        html += "<p>None.</p>\n";
    } else {
        let doubts = study_doubts(&result.doubts).into_iter();
        let shown = doubts.map(|one| KeyStyle::Flag.shown(&one));
        html += &list(&shown.collect::<Vec<_>>());
    }
    html += "</div>\n";
    html
}

fn job_words(study: &Study, result: &StudyResult, levels: &[LevelSummary]) -> String {
    let objects = &study.objects;
    let histories: usize = levels.iter().map(|level| level.histories).sum();
    let failed: usize = levels.iter().map(|level| level.failed).sum();
    let thicknesses = match objects.thicknesses_m.len() {
        1 => "1 thickness".to_owned(),
        n => format!("{n} thicknesses"),
    };
    let (kind, chosen) = match &study.ground {
        Ground::Synthetic(_) => ("synthetic ground", ""),
        Ground::Simulated(_) => ("simulated ground", ""),
        Ground::Recorded(_) if study.ground.target().is_some() => {
            ("recorded ground", ", matched to a spectrum")
        }
        Ground::Recorded(_) if study.ground.suite().is_some() && result.motions.len() != 1 => {
            ("recorded ground", ", selected for a spectrum")
        }
        Ground::Recorded(_) => ("recorded ground", ""),
        Ground::OnFloors if result.motions.len() != 1 => ("given floor", " each"),
        Ground::OnFloors => ("given floor", ""),
    };
    let kind = match result.motions.len() {
        1 => format!("one {kind} motion{chosen}"),
        n => format!("{n} {kind} motions{chosen}"),
    };
    let failed = match failed {
        0 => "none failed".to_owned(),
        n => format!("{n} failed (left out of the statistics)"),
    };
    format!(
        "{} ({} × {thicknesses}, {} kg, {} under an edge) on {}{}, calculated for {kind}{}: {}, of which {failed}.",
        counted(objects.blocks.len(), "object"),
        counted(objects.heights_m.len(), "height"),
        number(objects.mass_kg, 6),
        cushion_words(&objects.cushion.cushion),
        if levels.len() == 1 {
            "one floor".to_owned()
        } else {
            format!("{} floors", levels.len())
        },
        study
            .building
            .as_ref()
            .map_or_else(String::new, |b| format!(
                " of a {}-storey building",
                b.storeys
            )),
        match study.directions_deg.len() {
            1 => String::new(),
            n => format!(", each in {n} directions, of which the worst counts"),
        },
        counted(histories, "rocking history"),
    )
}

fn level_words(level: &LevelSummary) -> String {
    let shock = match (
        level.edge_acceleration_g_median,
        level.edge_acceleration_g_max,
    ) {
        (Some(median), Some(most)) if most > 0.0 => format!(
            "the largest median shock of an object is {} g, the largest of any history without overturning {} g",
            number(median, 3),
            number(most, 3)
        ),
        (_, Some(most)) if most > 0.0 => format!(
            "half or more of the motions overturn every object; the largest shock of any history without \
             overturning is {} g",
            number(most, 3)
        ),
        (_, Some(_)) => "no object lifts an edge without overturning".to_owned(),
        (_, None) => "every history overturns".to_owned(),
    };
    format!(
        "the median PFA is {} g. The objects lift an edge in {} of the histories and overturn in {}; {shock}.",
        level
            .pfa_g_median
            .map_or_else(|| "–".to_owned(), |pfa_g| number(pfa_g, 3)),
        percent(level.uplift_share, 1),
        percent(level.overturned_share, 1)
    )
}

fn first_table(levels: &[LevelSummary]) -> String {
    let headings = vec![
        vec![
            words("").over(8),
            markup("Shock, uplift (g)".into(), "group").over(2),
            markup("Shock, velocity (g)".into(), "group").over(2),
        ],
        vec![
            words("Level"),
            figure("z/H"),
            figure("median PFA (g)"),
            figure("histories"),
            figure("failed"),
            figure("uplift"),
            figure("overturned"),
            figure("overturned by half of the motions"),
            markup("largest median".into(), "n first"),
            figure("largest"),
            markup("largest median".into(), "n first"),
            figure("largest"),
        ],
    ];
    let shock = |value: Option<f64>, class| {
        markup(value.map_or_else(|| "–".to_owned(), |v| fixed(v, 2)), class)
    };
    let rows: Vec<_> = levels
        .iter()
        .map(|level| {
            vec![
                words(&level.level),
                or_dash(level.level_ratio, |ratio| number(ratio, 3)),
                or_dash(level.pfa_g_median, |pfa_g| fixed(pfa_g, 3)),
                figure(level.histories.to_string()),
                figure(level.failed.to_string()),
                figure(percent(level.uplift_share, 1)),
                figure(percent(level.overturned_share, 1)),
                figure(level.overturned_objects.to_string()),
                shock(level.edge_acceleration_g_median, "n first"),
                shock(level.edge_acceleration_g_max, "n"),
                shock(level.edge_acceleration_impact_velocity_g_median, "n first"),
                shock(level.edge_acceleration_impact_velocity_g_max, "n"),
            ]
        })
        .collect();
    let mut html = classed_table("glance", "Summary of each level", &headings, &rows);
    html += &paragraph(
        "Shares refer to all histories (object × motion) except those that failed. Overturned by half of \
         the motions: objects that half or more of them overturn. Largest median: the largest median over the motions \
         of any other object. Largest: the largest value of any history without overturning. Uplift and velocity are \
         the two sources of the energy at impact; the paper uses the uplift.",
    );
    html
}

fn tolerance_words(study: &Study, levels: &[LevelSummary]) -> String {
    let Some(tolerance_m_s2) = study.objects.tolerance_m_s2 else {
        return String::new();
    };
    let tolerance_g = tolerance_m_s2 / freestand::G0_M_S2;
    let objects = study.objects.blocks.len();
    let counts: Vec<String> = levels
        .iter()
        .filter_map(|level| {
            Some(format!(
                "{}: {} of {objects}",
                level.level, level.exceeded_objects?
            ))
        })
        .collect();
    paragraph(&format!(
        "Objects whose median shock (the larger of the two sources) exceeds the tolerance of {} g, or that half or \
         more of the motions overturn: {}. The tables mark them with ▲.",
        number(tolerance_g, 3),
        counts.join("; ")
    ))
}

/// Reasons for failed histories, with their counts.
fn failures(result: &StudyResult) -> String {
    let mut reasons: Vec<(&str, usize)> = Vec::new();
    for response in result
        .levels
        .iter()
        .flat_map(|level| level.responses.iter().flatten())
    {
        if let ObjectResponse::FreeFlight(reason) | ObjectResponse::Failed(reason) = response {
            match reasons.iter_mut().find(|(known, _)| known == reason) {
                Some((_, count)) => *count += 1,
                None => reasons.push((reason, 1)),
            }
        }
    }
    if reasons.is_empty() {
        return String::new();
    }
    reasons.sort_by_key(|&(_, count)| std::cmp::Reverse(count));
    let more = reasons.len().saturating_sub(MAX_REASONS);
    let rows: Vec<_> = reasons
        .iter()
        .take(MAX_REASONS)
        .map(|(reason, count)| vec![words(reason), figure(count.to_string())])
        .collect();
    let mut html = table(
        "Histories that failed",
        &[vec![words("Reason"), figure("Histories")]],
        &rows,
    );
    if more > 0 {
        html += &paragraph(&format!("Other reasons: {more}. srs.csv lists all."));
    }
    html
}

const MAX_REASONS: usize = 12;
