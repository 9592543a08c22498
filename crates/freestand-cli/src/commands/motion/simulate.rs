//! `freestand motion simulate`: motions from a magnitude and a distance, or from a city and a
//! return period.

use clap::Args;
use freestand::code_spectrum::SiteClass;
use freestand::motion::Motion;
use freestand::synthesis::matched_periods_s;
use freestand_input::keys;
use freestand_input::problem::Problem;
use freestand_output::answer::Answer;
use freestand_records::formats::write_csv;
use freestand_study::inspect::{Words, record_figure};
use freestand_study::matched::{MatchedPicture, matched_figure};
use freestand_study::simulated::{
    DEFAULT_SITE, Earthquake, Earthquakes, SimulatedReport, SimulatedRequest, SourceInput,
    city_rock, read_source, simulate,
};
use freestand_study::study::DEFAULT_MOTIONS;
use freestand_study::target::{DEFAULT_YEARS, Target};

use super::motions;
use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::keys::{Key, KeySet, Keys, key, switch};
use crate::printer::{Column, Printer, cells, headings, significant, table};

/// Simulate ground motions with a stochastic point source
///
/// For a magnitude at a distance, or for earthquakes that agree with the code spectrum of a city.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand motion simulate --magnitude 6 --distance \"30 km\" --count 10 --seed 1 --out motions
  freestand motion simulate --magnitude 6.5 --distance \"45 km\" \\
    --preset se-australia --stress-drop \"50 MPa\" --json
  freestand motion simulate --city Melbourne --return-period 500 --site De --count 20 \\
    --out motions")]
pub(crate) struct SimulateArgs {
    /// Moment magnitude [default with --city: 5.5, 6, 6.5 and 7]
    #[arg(long, value_name = "M", required_unless_present = "city")]
    magnitude: Option<String>,
    /// Distance from the source to the site
    #[arg(long, value_name = "LENGTH", required_unless_present = "city")]
    distance: Option<String>,
    /// Find the distances at which the mean spectrum agrees with the rock spectrum of this city
    /// (AS 1170.4)
    #[arg(
        long,
        visible_alias = "place",
        value_name = "NAME",
        conflicts_with = "distance"
    )]
    city: Option<String>,
    /// Return period in years; needs --city [default: 500]
    #[arg(long, value_name = "YEARS")]
    return_period: Option<u32>,
    /// Site class of AS 1170.4; for other classes than Be, amplitudes are multiplied by the ratio
    /// of the code spectra
    #[arg(long, value_name = "CLASS", default_value = DEFAULT_SITE.name())]
    site: String,
    /// Number of motions of each earthquake
    #[arg(long, value_name = "N", default_value_t = DEFAULT_MOTIONS, value_parser = motions())]
    count: u64,
    #[command(flatten)]
    tables: TableArgs,
    #[command(flatten)]
    source: Keys<SourceKeys>,
}

#[derive(Debug, Clone)]
struct SourceKeys;

impl KeySet for SourceKeys {
    const KEYS: &'static [(&'static str, &'static [Key])] = &[
        (
            "The source and the crust",
            &[
                key(
                    "preset",
                    "NAME",
                    "Set of parameters: victoria (or melbourne), intraplate, se-australia [default: victoria]",
                ),
                key(
                    "stress_drop",
                    "PRESSURE",
                    "Stress drop, such as \"200 bar\" or \"23 MPa\" [default: the preset's]",
                ),
                key(
                    "kappa",
                    "TIME",
                    "κ0, the attenuation near the surface [default: the preset's]",
                ),
                key(
                    "source_spectrum",
                    "SHAPE",
                    "Shape of the source spectrum: single-corner (Brune), two-corner (Atkinson and Boore 1995) \
                     [default: the preset's]",
                ),
                key(
                    "path_duration",
                    "NAME",
                    "Duration along the path: boore (0.05 s per km), atkinson-boore (1995) [default: the preset's]",
                ),
                key(
                    "window",
                    "NAME",
                    "Window of the shaking: lam (Lam, Wilson and Hutchinson 2000), saragoni-hart (1974) \
                     [default: the preset's]",
                ),
                switch("hard_rock", "No amplification by the crust"),
            ],
        ),
        (
            "The motion",
            &[
                key("time_step", "TIME", "Time step [default: 0.005 s]"),
                key(
                    "low_cut",
                    "FREQUENCY",
                    "Corner frequency of the acausal high-pass filter [default: 0.05 Hz]",
                ),
            ],
        ),
    ];
}

const SCHEMA: &str = "freestand.motion-simulate/1";

pub(crate) fn run(
    args: &SimulateArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    // `requires` of clap is silent here: --city itself excludes --distance.
    if args.return_period.is_some() && args.city.is_none() {
        return Err(Failure::usage(
            "--return-period needs --city: it selects the spectrum of a code",
            "give --city, or leave --return-period out",
        ));
    }
    let years = args.return_period.unwrap_or(DEFAULT_YEARS);
    let rock = args
        .city
        .as_deref()
        .map(|city| city_rock(city, years))
        .transpose()?;
    let request = request(args, global, rock.as_ref().and_then(Target::kpz_g))?;
    let files = Files::with_tables(global, &[], &args.tables, SCHEMA, Some(global.seed()))?;
    let mut report = simulate(&request)?;
    for earthquake in &mut report.earthquakes {
        for one in &mut earthquake.motions {
            one.path = files.write(&format!("{}.csv", one.name), || write_csv(&one.motion))?;
        }
    }
    if files.wanted() {
        files.table("fourier_amplitude", || report.fourier_table())?;
        draw(&report, &files)?;
    }
    let rock_warnings = rock.map_or_else(Vec::new, |rock| rock.warnings);
    let warnings = [
        rock_warnings,
        report.warnings.clone(),
        request.assumptions(),
    ]
    .concat();
    files.print(printer, SCHEMA, &report, &warnings, || text(&report))?;
    Ok(Done::OK)
}

/// `kpz_g` is that of the city, if one is named.
fn request(
    args: &SimulateArgs,
    global: &GlobalArgs,
    kpz_g: Option<f64>,
) -> Result<SimulatedRequest, Failure> {
    let SourceInput {
        preset,
        changes,
        magnitude,
        distance_m,
        options,
    } = read_source(&words(args))?;
    let site = SiteClass::parse(&args.site).map_err(|error| {
        Problem::value(
            format!("--site: {error}"),
            "give Ae, Be, Ce, De or Ee, as in AS 1170.4",
        )
    })?;
    let earthquakes = match (kpz_g, magnitude, distance_m) {
        (Some(kpz_g), magnitude, _) => Earthquakes::Pairs {
            kpz_g,
            magnitudes: magnitude.into_iter().collect(),
        },
        (None, Some(magnitude), Some(distance_m)) => Earthquakes::One {
            magnitude,
            distance_m,
        },
        (None, ..) => {
            let hint = "give --magnitude and --distance, or --city";
            return Err(Failure::usage(
                "the earthquake is incomplete: a magnitude and a distance are needed",
                hint,
            ));
        }
    };
    Ok(SimulatedRequest {
        preset,
        changes,
        earthquakes,
        site,
        count: args.count,
        seed: global.seed(),
        options,
    })
}

/// The flags as the keys of `point_source` in a study.
fn words(args: &SimulateArgs) -> keys::Words {
    let own = [("magnitude", &args.magnitude), ("distance", &args.distance)];
    let own = own
        .into_iter()
        .filter_map(|(key, text)| Some((key, text.as_deref()?)));
    args.source.words.entries().chain(own).collect()
}

/// Draws the spectra with the code spectrum, if there is one, and the first motion of each
/// earthquake.
fn draw(report: &SimulatedReport, files: &Files) -> Result<(), Failure> {
    if let Some(target) = report.request.code_spectrum() {
        let sa_g: Vec<f64> = matched_periods_s().into_iter().map(target).collect();
        let motions: Vec<&Motion> = report.motions().map(|one| &one.motion).collect();
        let picture = MatchedPicture {
            title: "Simulated motions and the code spectrum",
            target: "AS 1170.4",
            target_sa_g: &sa_g,
            motions: &motions,
        };
        files.drawn("target", &matched_figure(&picture)?)?;
    }
    for one in report
        .earthquakes
        .iter()
        .filter_map(|earthquake| earthquake.motions.first())
    {
        let words = Words {
            name: &one.name,
            description: "simulated",
            processing: &[],
        };
        files.drawn(&one.name, &record_figure(words, &one.motion)?)?;
    }
    Ok(())
}

const COLUMNS: [Column; 3] = [
    ("pga_g", "PGA [g]", 3),
    ("pgv_m_s", "PGV [m/s]", 3),
    ("d5_95_s", "D5-95 [s]", 3),
];

fn text(report: &SimulatedReport) -> String {
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
            rows.push([source, cells(&one.facts(), &COLUMNS)].concat());
        }
    }
    let of_source = ["motion", "M", "R [km]", "f0 [Hz]", "Td [s]"];
    let mut text = table(&[&of_source, &headings(&COLUMNS)[..]].concat(), &rows);
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
