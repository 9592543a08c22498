#![allow(clippy::unwrap_used, clippy::print_stdout)]
use freestand::hull::{
    HullBody,
    barrier::barrier,
    contact::contact_points,
    shake::{Contact, shake},
};
use parry3d_f64::mass_properties::MassProperties;
use parry3d_f64::math::Vector;
use parry3d_f64::transformation::try_convex_hull;
use rayon::prelude::*;

fn main() {
    let dir = std::env::args().nth(1).unwrap();
    let mut bodies = Vec::new();
    for rock in ["rock1", "rock2"] {
        let text = std::fs::read_to_string(format!("{dir}/{rock}.obj")).unwrap();
        let (mut v, mut f) = (Vec::new(), Vec::new());
        for line in text.lines() {
            let mut w = line.split_whitespace();
            match w.next() {
                Some("v") => {
                    let c: Vec<f64> = w.map(|x| x.parse().unwrap()).collect();
                    v.push(Vector::new(c[0], c[1], c[2]));
                }
                Some("f") => {
                    let c: Vec<u32> = w
                        .map(|x| x.split('/').next().unwrap().parse::<u32>().unwrap() - 1)
                        .collect();
                    f.push([c[0], c[1], c[2]]);
                }
                _ => {}
            }
        }
        let mp = MassProperties::from_trimesh(1.0, &v, &f);
        let mass = if rock == "rock1" { 353.8 } else { 353.5 };
        let com = mp.local_com;
        println!(
            "{rock}: {} vertices {} faces, volume {}, com {:?}",
            v.len(),
            f.len(),
            mp.mass(),
            com
        );
        let (hull, faces) = try_convex_hull(&v).unwrap();
        for f in &faces {
            let [a, b, c] = f.map(|i| hull[i as usize] - com);
            let n = (b - a).cross(c - a).normalize();
            let d = n.dot(a);
            let p = n * d;
            let inside = [(a, b), (b, c), (c, a)]
                .iter()
                .all(|(u, w)| (*w - *u).cross(p - *u).dot(n) >= 0.0);
            if inside && n.z < -0.7 {
                println!(
                    "stable: Z {:.5} tilt {:.2}° towards {:.1}°",
                    d,
                    (-n.z).acos().to_degrees(),
                    n.y.atan2(n.x).to_degrees()
                );
            }
        }
        let hull: Vec<[f64; 3]> = hull
            .iter()
            .map(|p| [p.x - com.x, p.y - com.y, p.z - com.z])
            .collect();
        let i = mp.reconstruct_inertia_matrix();
        let s = mass / mp.mass();
        let c = i.to_cols_array();
        let inertia = [
            [c[0] * s, c[1] * s, c[2] * s],
            [c[3] * s, c[4] * s, c[5] * s],
            [c[6] * s, c[7] * s, c[8] * s],
        ];
        let start = std::time::Instant::now();
        let points = contact_points(&hull);
        println!(
            "hull {} contact points {} in {:?}",
            hull.len(),
            points.len(),
            start.elapsed()
        );
        let start = std::time::Instant::now();
        let b = barrier(&hull);
        println!(
            "barrier {:?} angle {:.2}° at {:.2}° towards {:.1}° in {:?}",
            b,
            b.angle_rad().to_degrees(),
            b.tilt_rad.to_degrees(),
            b.toward_rad.to_degrees(),
            start.elapsed()
        );
        println!("inertia {inertia:?}");
        bodies.push(HullBody {
            mass_kg: mass,
            inertia_kg_m2: inertia,
            points_m: points,
        });
    }
    let tests: Vec<Vec<String>> = std::fs::read_to_string(format!("{dir}/tests.csv"))
        .unwrap()
        .lines()
        .skip(1)
        .map(|l| l.split(',').map(str::to_owned).collect())
        .collect();
    if std::env::args().nth(2).is_some() {
        return;
    }
    let contact = Contact {
        friction_ratio: 0.6,
        damping_ratio: 0.2,
        sinking_m: 1e-4,
    };
    let start = std::time::Instant::now();
    let results: Vec<[bool; 4]> = tests
        .par_iter()
        .map(|t| {
            let number: u32 = t[0].parse().unwrap();
            let text =
                std::fs::read_to_string(format!("{dir}/motions/test{number:03}.csv")).unwrap();
            let a: Vec<f64> = text
                .lines()
                .skip(1)
                .map(|x| x.parse::<f64>().unwrap() * 9.80665)
                .collect();
            let fell =
                [0, 1].map(|i| shake(&bodies[i], &contact, 0.005, [&a, &[]], 9.80665).overturned);
            [fell[0], fell[1], t[4] == "1", t[5] == "1"]
        })
        .collect();
    println!("{} tests in {:?}", tests.len(), start.elapsed());
    for i in 0..2 {
        let right = results.iter().filter(|r| r[i] == r[2 + i]).count();
        let false_alarms = results.iter().filter(|r| r[i] && !r[2 + i]).count();
        let misses = results.iter().filter(|r| !r[i] && r[2 + i]).count();
        println!(
            "rock {}: right {:.1} %, false alarms {false_alarms}, misses {misses}",
            i + 1,
            100.0 * right as f64 / results.len() as f64
        );
    }
}
