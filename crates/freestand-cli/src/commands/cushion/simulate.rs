//! `freestand cushion simulate`: virtual drop and static tests.

use clap::Args;
use freestand::G0_M_S2;
use freestand::cushion::Cushion;
use freestand::identify::{VirtualDrop, VirtualDropOptions, VirtualStaticOptions};
use freestand_input::quantity::Dimension;
use freestand_output::answer::Answer;
use freestand_study::laboratory::virtual_laboratory::{
    VirtualTest, VirtualTests, assume_damping, drop_file, static_file,
};

use crate::args::{GlobalArgs, refuse_idle};
use crate::commands::Done;
use crate::cushion::CushionArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Column, Printer, facts_table};
use crate::values::{Given, Reads, Values};

/// Simulate drop tests and static tests of a cushion, with the imperfections of real ones
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand cushion simulate --stiffness \"2190 N/mm\" --mass 0.365kg --height 100mm \\
    --noise 0.5% --bias 1g --count 5 --out drops
  freestand cushion simulate --law hertz --stiffness \"2e7 N/m^1.5\" --mass 0.365kg --height 100mm \\
    > drop.csv
  freestand cushion simulate --law kelvin-voigt --stiffness \"2190 N/mm\" --damping 5% \\
    --mass 0.365kg --height 100mm --bounces 1
  freestand cushion simulate --static --stiffness \"1100 N/mm\" --load \"1 kN\" --hysteresis 15% \\
    > press.csv

Without --out, the file is printed. The first touch lies between two samples. Its place and the
noise depend on --seed and on the number of the test.")]
pub(crate) struct SimulateArgs {
    #[command(flatten)]
    cushion: CushionArgs,
    /// Mass of the impactor
    #[arg(long, positive = Dimension::Mass)]
    mass: Option<Given>,
    /// Drop height
    #[arg(long, positive = Dimension::Length)]
    height: Option<Given>,
    /// Samples per second [default: 50 per contact]
    #[arg(long, positive = Dimension::Frequency)]
    sample_rate: Option<Given>,
    /// Standard deviation of white noise, as a share of the peak (in a static test, of the largest
    /// force) [default: 0]
    #[arg(long, non_negative = Dimension::Ratio)]
    noise: Option<Given>,
    /// Bias added to every sample [default: 0 g]
    #[arg(long, any = Dimension::Acceleration)]
    bias: Option<Given>,
    /// Shift of the zero line after the peak, as a share of the peak [default: 0]
    #[arg(long, any = Dimension::Ratio)]
    zero_shift: Option<Given>,
    /// Corner frequency of a two-pole low-pass filter before the A/D converter [default: no filter]
    #[arg(long, positive = Dimension::Frequency)]
    filter_corner: Option<Given>,
    /// Time before the first touch [default: 3 contacts]
    #[arg(long, non_negative = Dimension::Time)]
    pre_trigger: Option<Given>,
    /// Number of bounces after the first contact
    #[arg(long, value_name = "N", default_value = "0", value_parser = clap::value_parser!(u32).range(0..=20))]
    bounces: u32,
    /// Gravity during the contact [default: 1 g]
    #[arg(long, non_negative = Dimension::Acceleration)]
    gravity: Option<Given>,
    /// Number of tests
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u32).range(1..=1000))]
    count: u32,

    /// Simulate static tests instead of drops
    #[arg(long = "static", help_heading = "Static tests")]
    is_static: bool,
    /// Largest force [default: 1 kN]
    #[arg(long, positive = Dimension::Force, requires = "is_static", help_heading = "Static tests")]
    load: Option<Given>,
    /// Energy lost as a share of the energy put in [default: 0]
    #[arg(long, non_negative = Dimension::Ratio, help_heading = "Static tests")]
    hysteresis: Option<Given>,
    /// Slack before the pad is touched [default: 0 mm]
    #[arg(long, non_negative = Dimension::Length, requires = "is_static", help_heading = "Static tests")]
    slack: Option<Given>,
    /// Stiffness of the machine [default: rigid]
    #[arg(long, positive = Dimension::Stiffness, requires = "is_static", help_heading = "Static tests")]
    machine_compliance: Option<Given>,
}

const SCHEMA: &str = "freestand.cushion-simulate/1";

/// The highest drop towers for experiments are about 150 m; the sum of numbers far beyond is no number.
const HIGHEST_M: f64 = 1000.0;

/// The options that all tests share.
enum Plan {
    Drop(VirtualDropOptions),
    Static(VirtualStaticOptions),
}

pub(crate) fn run(
    args: &SimulateArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let (cushion, plan, notes) = plan(args, global)?;
    if global.out.is_none() && args.count > 1 {
        return Err(Failure::usage(
            "several tests need a folder",
            "give --out DIR",
        ));
    }
    let inputs = args.cushion.inputs();
    let files = Files::begin(global, &inputs)?;
    let mut tests = Vec::new();
    let mut first = String::new();
    for index in 0..u64::from(args.count) {
        let (text, one) = simulated(&cushion, &plan, index, &files)?;
        if index == 0 && !files.wanted() {
            first = text;
        }
        tests.push(one);
    }
    let report = VirtualTests {
        law: cushion.law().name(),
        seed: global.seed(),
        tests,
    };
    let is_file = !files.wanted() && !printer.json();
    files.finish(SCHEMA, &report, &notes)?;
    if is_file {
        // Only the file is printed, so that it can be redirected.
        printer.print(&first)?;
        printer.warn(&notes);
        return Ok(Done::OK);
    }
    printer.result(SCHEMA, &report, &notes, || {
        facts_table(report.tests.iter().map(Answer::facts), &COLUMNS)
    })?;
    Ok(Done::OK)
}

/// The file of a test, and its entry in the document.
fn simulated(
    cushion: &Cushion,
    plan: &Plan,
    index: u64,
    files: &Files,
) -> Result<(String, VirtualTest), Failure> {
    let (kind, text, drop) = match plan {
        Plan::Drop(options) => {
            let (text, drop) = drop_file(cushion, &VirtualDropOptions { index, ..*options })?;
            ("drop", text, Some(drop))
        }
        Plan::Static(options) => (
            "static",
            static_file(cushion, &VirtualStaticOptions { index, ..*options }),
            None,
        ),
    };
    let name = format!("{kind}-{:03}", index + 1);
    let path = files.write(&format!("{name}.csv"), || &text)?;
    let of = |value: fn(&VirtualDrop) -> f64| drop.as_ref().map(value);
    let test = VirtualTest {
        name,
        path,
        peak_acceleration_g: of(|drop| drop.peak_m_s2 / G0_M_S2),
        contact_time_s: of(|drop| drop.contact_s),
        samples_per_contact: of(|drop| drop.contact_s / drop.dt_s),
        restitution_ratio: of(|drop| drop.restitution_ratio),
    };
    Ok((text, test))
}

impl SimulateArgs {
    /// The flags that only drops read, of those that were given.
    fn of_drops(&self) -> impl Iterator<Item = &'static str> {
        let flags = [
            (self.height.is_some(), "height"),
            (self.sample_rate.is_some(), "sample-rate"),
            (self.bias.is_some(), "bias"),
            (self.zero_shift.is_some(), "zero-shift"),
            (self.filter_corner.is_some(), "filter-corner"),
            (self.pre_trigger.is_some(), "pre-trigger"),
            (self.bounces > 0, "bounces"),
            (self.gravity.is_some(), "gravity"),
        ];
        flags
            .into_iter()
            .filter_map(|(is_given, flag)| is_given.then_some(flag))
    }
}

fn plan(args: &SimulateArgs, global: &GlobalArgs) -> Result<(Cushion, Plan, Vec<String>), Failure> {
    let mut values = Values::default();
    let (mass, height) = (values.read(&args.mass), values.read(&args.height));
    let noise = values.read(&args.noise);
    let mut words = args.cushion.words(&mut values)?;
    let assumed = assume_damping(&mut words);
    let Some(edge) = args.cushion.resolved(&words, mass, &mut values) else {
        values.finish()?;
        return Err(Failure::usage(
            "the cushion is missing",
            "give --stiffness, such as \"2190 N/mm\"",
        ));
    };
    let (cushion, notes) = (edge.cushion, [edge.notes, assumed].concat());
    if args.is_static {
        refuse_idle(args.of_drops(), "--static simulates no drops")?;
        let usual = VirtualStaticOptions::default();
        let options = VirtualStaticOptions {
            max_force_n: values.read(&args.load).unwrap_or(usual.max_force_n),
            hysteresis_ratio: values
                .read(&args.hysteresis)
                .unwrap_or(usual.hysteresis_ratio),
            toe_m: values.read(&args.slack).unwrap_or(usual.toe_m),
            machine_stiffness_n_m: values.read(&args.machine_compliance),
            noise_ratio: noise.unwrap_or(usual.noise_ratio),
            seed: global.seed(),
            ..usual
        };
        values.finish()?;
        return Ok((cushion, Plan::Static(options), notes));
    }
    refuse_idle(
        args.hysteresis.is_some().then_some("hysteresis"),
        "it is that of --static tests",
    )?;
    let gravity = values.read(&args.gravity);
    let rate = values.read(&args.sample_rate);
    let bias = values.read(&args.bias);
    let zero_shift = values.read(&args.zero_shift);
    let filter_corner_hz = values.read(&args.filter_corner);
    let pre_trigger = values.read(&args.pre_trigger);
    values.finish()?;
    let (Some(mass_kg), Some(height_m)) = (mass, height) else {
        return Err(Failure::usage(
            "a drop needs a mass and a height",
            "give --mass and --height, or --static",
        ));
    };
    if height_m > HIGHEST_M {
        let hint = "check the unit: the height of a drop test is millimeters to meters";
        return Err(Failure::usage(
            format!("--height: a drop of {height_m} m is more than {HIGHEST_M} m"),
            hint,
        ));
    }
    let usual = VirtualDropOptions::from_height(&cushion, mass_kg, height_m);
    let options = VirtualDropOptions {
        gravity_m_s2: gravity.unwrap_or(usual.gravity_m_s2),
        sample_rate_hz: rate.unwrap_or(usual.sample_rate_hz),
        pre_trigger_s: pre_trigger.unwrap_or(usual.pre_trigger_s),
        noise_ratio: noise.unwrap_or(usual.noise_ratio),
        bias_m_s2: bias.unwrap_or(usual.bias_m_s2),
        zero_shift_ratio: zero_shift.unwrap_or(usual.zero_shift_ratio),
        filter_corner_hz,
        bounces: args.bounces,
        seed: global.seed(),
        ..usual
    };
    Ok((cushion, Plan::Drop(options), notes))
}

const COLUMNS: [Column; 5] = [
    ("path", "test", 0),
    ("peak_acceleration_g", "peak [g]", 5),
    ("contact_time_s", "contact time [ms]", 5),
    ("samples_per_contact", "samples per contact", 4),
    ("restitution_ratio", "restitution", 4),
];
