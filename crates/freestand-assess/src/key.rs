//! The key of a run: one hash of everything that the finished parts depend on. Parts with another
//! key are not used.

use serde_json::{Value, json};

use freestand::motion::Motion;
use freestand_input::file::{InputFile, sha256_hex};
use freestand_inventory::Inventory;
use freestand_study::study::assessment::{
    Accepted, Bracket, Questions, RestraintSettings, Settings, Spread, WorldSettings,
};
use freestand_study::study::{Ground, Study};

/// Version of the text that is hashed; raise it with every change of that text or of the content of
/// a part.
const FORMAT: u32 = 21;

/// Tables of a study that do not change a part: the settings are hashed as they are used, and the
/// others have no effect.
const TABLES_WITHOUT_EFFECT: [&str; 5] =
    ["assessment", "objects", "outputs", "worlds", "restraint"];

/// The key of a run in parts of `part` objects.
pub fn resume_key(study: &Study, inventory: &Inventory, part: usize) -> String {
    sha256_hex(hashed(study, inventory, part).to_string().as_bytes())
}

/// What the key is the hash of.
fn hashed(study: &Study, inventory: &Inventory, part: usize) -> Value {
    let hashes = |files: &[InputFile]| -> Vec<String> {
        files.iter().map(|file| file.sha256.clone()).collect()
    };
    json!({
        "format": FORMAT,
        "version": env!("CARGO_PKG_VERSION"),
        "part": part,
        "rows": inventory.items.len(),
        "study": study_text(&study.toml),
        "unstated": [study.place_is_assumed, study.building_is_assumed],
        "seed": study.ground.seed(),
        "motions": study.ground.names(&study.levels),
        "recorded": recorded(study),
        "target": target(study).map(|file| &file.sha256),
        "building": study.building.iter().flat_map(|building| &building.tables).map(|table| {
            json!({"key": table.key, "across": table.is_across, "sha256": table.file.sha256})
        }).collect::<Vec<_>>(),
        "directions_deg": study.directions_deg,
        "settings": settings(&study.assessment),
        "inventory": {"sha256": inventory.sha256, "sheet": inventory.sheet, "reading": inventory.read_with},
        "libraries": hashes(&inventory.libraries),
        "scans": hashes(&inventory.scans),
    })
}

/// The study without the tables that have no effect.
fn study_text(toml: &str) -> String {
    let Ok(mut study) = toml.parse::<toml_edit::DocumentMut>() else {
        return toml.to_owned();
    };
    for table in TABLES_WITHOUT_EFFECT {
        study.remove(table);
    }
    study.to_string()
}

/// The motions that were read from files, by their samples: flags of the caller may have changed
/// how a file is read.
fn recorded(study: &Study) -> Vec<Value> {
    let other = study
        .other_ground
        .iter()
        .flat_map(|ground| ground.recorded(&[]));
    let recorded = study.ground.recorded(&study.levels).chain(other);
    let one = |motion: &freestand_study::study::RecordedMotion| {
        let inputs: Vec<&str> = motion
            .other_inputs()
            .map(|file| file.sha256.as_str())
            .collect();
        json!({
            "name": motion.name,
            "along": samples(&motion.motion),
            "across": motion.across.as_ref().map(|second| samples(&second.motion)),
            "vertical": motion.vertical.as_ref().map(|vertical| samples(&vertical.motion)),
            "inputs": inputs,
        })
    };
    recorded.map(one).collect()
}

fn samples(motion: &Motion) -> String {
    let values = std::iter::once(motion.dt_s()).chain(motion.accel_m_s2().iter().copied());
    let bytes: Vec<u8> = values.flat_map(f64::to_le_bytes).collect();
    sha256_hex(&bytes)
}

/// The file of the spectrum that motions are generated for.
fn target(study: &Study) -> Option<&InputFile> {
    match &study.ground {
        Ground::Synthetic(synthetic) => synthetic.target.file.as_ref(),
        Ground::Simulated(simulated) => simulated.hazard.as_ref()?.file.as_ref(),
        Ground::Recorded(_) | Ground::OnFloors => None,
    }
}

/// The settings that change a part: not where files are, nor how many objects get a page.
fn settings(settings: &Settings) -> Value {
    let Settings {
        inventory: _,
        sheet: _,
        library: _,
        cushion_library: _,
        pages: _,
        accepted,
        questions,
        is_annual,
        seed,
        worlds,
        spread:
            Spread {
                restitution,
                stiffness,
                mass,
                geometry,
                model,
                compliant: compliant_spread,
            },
        pad_damping_ratio,
        compliant_factor,
        friction_ratio,
        pad_strain_ratio,
        compliant,
        walls,
        dimensions,
        restraint,
        restraint_code,
    } = settings;
    let Accepted {
        other_ratio,
        small_item_ratio,
        life_safety_ratio,
        function_ratio,
        property_ratio,
    } = accepted;
    let WorldSettings {
        spectral_spread,
        intensity_spread,
        component_correlation,
        component_ratio,
        components,
        period_spread,
        damping_spread,
        looks,
        shares,
    } = worlds;
    let RestraintSettings {
        dead_load_ratio,
        overstrength_ratio,
        amplification_ratio,
        response_ratio,
        resonance_ratio,
        strength_ratio,
        building_ductility_ratio,
        importance_ratio,
        bracket_height_m,
        anchor_inset_m,
        bracket,
    } = restraint;
    let name = |questions: Questions| {
        Questions::ALL
            .iter()
            .find(|(_, one)| *one == questions)
            .map(|(name, _)| *name)
    };
    let bracket = Bracket::ALL
        .iter()
        .find(|(_, one)| one == bracket)
        .map(|(name, _)| *name);
    json!({
        "accepted": [other_ratio, small_item_ratio],
        "accepted_by_rating": [life_safety_ratio, function_ratio, property_ratio],
        "questions": questions.and_then(name),
        "annual": is_annual,
        "seed": seed,
        "worlds": [spectral_spread, intensity_spread, component_correlation, period_spread, damping_spread],
        "components": [f64::from(*components), *component_ratio],
        "looks": [looks.first(), looks.most()],
        "confidence": looks.confidence(),
        "shares": shares,
        "spread": [restitution, stiffness, mass, geometry, model, compliant_spread],
        "pad_damping_ratio": pad_damping_ratio,
        "compliant_factor": compliant_factor,
        "friction_ratio": friction_ratio,
        "pad_strain_ratio": pad_strain_ratio,
        "compliant": compliant,
        "walls": <&str>::from(walls),
        "dimensions": dimensions.name(),
        "restraint": [Some(*dead_load_ratio), *overstrength_ratio, *amplification_ratio, *response_ratio, *importance_ratio],
        "restraint_asce7_22": [resonance_ratio, strength_ratio, building_ductility_ratio],
        // What the clauses use of a spectrum.
        "restraint_code": restraint_code.as_ref().map(|target| {
            (target.spectrum.name(), target.place_name(), target.spectrum.sa_g(0.0), target.spectrum.plateau_g())
        }),
        "bracket_height_m": bracket_height_m,
        "anchor_inset_m": anchor_inset_m,
        "bracket": bracket,
    })
}

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};

    use super::*;

    fn key(toml: &str, change: impl FnOnce(&mut Study, &mut Inventory)) -> String {
        let (study, inventory) = inputs(toml, change);
        resume_key(&study, &inventory, 256)
    }

    fn inputs(toml: &str, change: impl FnOnce(&mut Study, &mut Inventory)) -> (Study, Inventory) {
        let mut study = freestand_study::resolve::resolve(toml, None, Path::new("")).unwrap();
        let mut inventory = Inventory {
            path: PathBuf::from("objects.csv"),
            sha256: "00".to_owned(),
            sheet: None,
            carried: Vec::new(),
            items: Vec::new(),
            libraries: Vec::new(),
            scans: Vec::new(),
            read_with: String::new(),
            findings: Vec::new(),
            warnings: Vec::new(),
            units: Default::default(),
        };
        change(&mut study, &mut inventory);
        (study, inventory)
    }

    /// Whoever changes this text raises [`FORMAT`], so that parts of an older program are refused and
    /// not misread.
    #[test]
    fn the_text_of_a_key_changes_with_its_format_alone() {
        let toml = "[building]\nstoreys = 8\n";
        let (study, inventory) = inputs(toml, |_, _| ());
        let mut hashed = hashed(&study, &inventory, 256);
        hashed["version"] = "of the program".into();
        insta::assert_snapshot!(serde_json::to_string_pretty(&hashed).unwrap());
    }

    #[test]
    fn a_key_depends_on_what_changes_results_and_on_nothing_else() {
        let toml = "[building]\nstoreys = 8\n";
        let usual = key(toml, |_, _| ());
        assert_eq!(
            usual,
            key(toml, |study, inventory| {
                study.assessment.pages = 3;
                study.source = Some(PathBuf::from("elsewhere.toml"));
                inventory.path = PathBuf::from("elsewhere.csv");
            })
        );
        assert_eq!(
            usual,
            key(
                "[building]\nstoreys = 8\n[outputs]\nreport = false\n[assessment]\npages = 7\n",
                |_, _| ()
            )
        );
        let changes: [fn(&mut Study, &mut Inventory); 10] = [
            |study, _| {
                study.assessment.dimensions = freestand_study::study::assessment::Dimensions::Three
            },
            |study, _| study.assessment.walls = freestand_study::study::assessment::WallUse::Ignore,
            |study, _| study.assessment.seed = 2,
            |study, _| study.assessment.spread.mass = 0.2,
            |study, _| study.directions_deg.push(90.0),
            |study, _| study.assessment.restraint.strength_ratio = Some(2.0),
            |study, _| {
                let words = [("code", "asce7"), ("sds", "1 g")].into_iter().collect();
                study.assessment.restraint_code =
                    freestand_study::target::Target::for_parts(&words).ok();
            },
            |_, inventory| inventory.sha256 = "01".to_owned(),
            |_, inventory| inventory.sheet = Some("Ward".to_owned()),
            |_, inventory| {
                inventory
                    .libraries
                    .push(InputFile::new(Path::new("ours.csv"), b"id"))
            },
        ];
        let mut keys: Vec<String> = changes
            .into_iter()
            .map(|change| key(toml, change))
            .collect();
        keys.extend([
            usual,
            key("[building]\nstoreys = 9\n", |_, _| ()),
            key("[ground]\nseed = 9\n[building]\nstoreys = 8\n", |_, _| ()),
        ]);
        let count = keys.len();
        keys.sort();
        keys.dedup();
        assert_eq!(keys.len(), count);
    }
}
