use freestand_study::resolve::resolve;

use super::*;

/// With two components, and with one: the peaks of floors are those of their histories, whether they are
/// known or not.
#[test]
fn peaks_are_those_of_the_floors_to_the_bit() {
    let ground = "[ground]\ncode = \"nzs1170.5\"\nsite = \"C\"\nhazard_factor = 0.4\n";
    let texts = [
        "[building]\nstoreys = 5\n",
        "[building]\nstoreys = 5\n[worlds]\ncomponents = 1\n",
    ];
    let levels_ratio = [0.0, 0.4, 1.0];
    let peaks_of = |floors: &[HorizontalPeaks]| -> Vec<_> {
        let bits = |peaks: &HorizontalPeaks| {
            (
                peaks.along_m_s2.to_bits(),
                peaks.across_m_s2.map(f64::to_bits),
            )
        };
        floors.iter().map(bits).collect()
    };
    for text in texts {
        let study = resolve(&format!("{ground}{text}"), None, "".as_ref()).unwrap();
        let worlds = Worlds::new(&study, || Ok(())).unwrap();
        let asked = Worlds::new(&study, || Ok(())).unwrap();
        let asked = asked.with_peaks_of(levels_ratio.into());
        for world in 0..3 {
            let floors = worlds
                .floors_of_world(world, &levels_ratio, Again::default(), None)
                .unwrap();
            let expected: Vec<HorizontalPeaks> = floors
                .iter()
                .map(|floor| HorizontalPeaks::of(&floor.motion))
                .collect();
            let unknown = worlds.floor_peaks(world, &levels_ratio).unwrap();
            assert_eq!(peaks_of(&unknown), peaks_of(&expected), "{text} {world}");
            // One of them was made for an object, and is known.
            worlds.floor(world, levels_ratio[1]).unwrap();
            let mixed = worlds.floor_peaks(world, &levels_ratio).unwrap();
            assert_eq!(peaks_of(&mixed), peaks_of(&expected), "{text} {world}");
            // The others were calculated with it.
            asked.floor(world, levels_ratio[1]).unwrap();
            assert!(asked.without_peaks(world, &levels_ratio, &[]).is_empty());
            let beside = asked.floor_peaks(world, &levels_ratio).unwrap();
            assert_eq!(peaks_of(&beside), peaks_of(&expected), "{text} {world}");
        }
    }
}
