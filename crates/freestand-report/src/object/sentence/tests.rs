//! The sentence of one object: tests.

use super::*;

fn place(name: &str, code: &str, years: Option<u32>, site: Option<&str>) -> NamedEarthquake {
    let (name, code, site) = (name.to_owned(), code.to_owned(), site.map(str::to_owned));
    NamedEarthquake::Place {
        name,
        is_point: false,
        code,
        years,
        site,
        is_approximate: false,
    }
}

fn counts(motions: u32, lifted: u32, overturned: u32) -> Counts {
    Counts {
        motions,
        lifted,
        asked: motions,
        overturned,
        lift_g: 0.21,
        floor_g_max: 0.3,
        ..Counts::default()
    }
}

fn answer(earthquake: NamedEarthquake, counts: Counts) -> Answer {
    let kind = AnswerKind::of(&counts, 0.1, None);
    Answer {
        kind,
        earthquake,
        floor: ToldFloor::Ground,
        counts,
        probability: None,
        withstands: None,
        units: UnitSystem::Si,
    }
}

fn p(value: f64, low: f64, high: f64) -> Option<Probability> {
    Some(Probability { value, low, high })
}

const ROLLED: Rolled = Rolled {
    travel_m_median: 0.2,
    travel_m_p84: 0.31,
    is_at_least: false,
    clearance_m: None,
    stop_share: 0.0,
    stop_speed_m_s_p84: None,
    clearance_needed_m: 0.45,
    room_m: [0.18, 0.29, 0.4],
    trip_speed_m_s: 1.92,
};

/// What rolls is told by its travel, against its clearance and the speed that trips it.
#[test]
fn travel_against_clearance() {
    let tell = |rolled: Rolled, counts: Counts| {
        let counts = Counts {
            rolled: Some(rolled),
            exceeded: Some(2),
            ..counts
        };
        Answer {
            withstands: TEN_G,
            ..answer(NamedEarthquake::GroundAcceleration { peak_g: 0.5 }, counts)
        }
        .sentence()
    };
    // By hand: 310 mm is 12.2 in, 1.92 m/s 6.3 ft/s; distances are rounded up.
    let in_us = Answer {
        units: UnitSystem::Us,
        ..answer(
            NamedEarthquake::Motions,
            Counts {
                rolled: Some(Rolled {
                    clearance_m: Some(0.2),
                    stop_share: 0.45,
                    stop_speed_m_s_p84: Some(1.1),
                    ..ROLLED
                }),
                ..counts(20, 0, 0)
            },
        )
    };
    let said = in_us.sentence();
    assert!(
        said.contains("the stop at 7.9 in")
            && said.contains("3.6 ft/s")
            && said.ends_with("from 6.3 ft/s."),
        "{said}"
    );
    assert!(!said.contains(" mm") && !said.contains(" m/s"), "{said}");
    let still = Counts {
        exceeded: Some(0),
        ..counts(20, 0, 0)
    };
    let room = Rolled {
        clearance_m: Some(0.4),
        ..ROLLED
    };
    let said = tell(room, still);
    assert!(said.contains(
        "stays standing: by up to 310 mm in 84 % of 20 simulated earthquakes, less than its clearance of 400 mm"
    ));
    let stops = Rolled {
        clearance_m: Some(0.2),
        stop_share: 0.45,
        stop_speed_m_s_p84: Some(1.1),
        ..ROLLED
    };
    assert_eq!(
        tell(stops, counts(20, 0, 0)),
        "At a ground acceleration of 0.5 g this object rolls and stays standing: by up to 200 mm in 84 % of 20 \
         simulated earthquakes; it meets the stop at 200 mm in 9 of 20 at up to 1.1 m/s in 84 % of them, and a stop \
         overturns it from 1.9 m/s; the shock of the stop exceeds the 10 g that it withstands, in 2 of 20."
    );
    let trips = tell(stops, counts(20, 3, 3));
    assert!(
        trips.contains(
            "may fall over: 3 of 20 simulated earthquakes overturn it; it rolls by up to 200 mm"
        ),
        "{trips}"
    );
    let one = Counts {
        rolled: Some(Rolled {
            stop_share: 1.0,
            ..stops
        }),
        ..counts(1, 0, 0)
    };
    assert_eq!(
        answer(NamedEarthquake::Motions, one).sentence(),
        "Under this motion this object rolls and stays standing: by up to 200 mm; it meets the stop at 200 mm at up to \
         1.1 m/s, and a stop overturns it from 1.9 m/s."
    );
}

/// Leaning counts as a fall, and is told apart.
#[test]
fn leaning_is_told() {
    let tell = |leaning, counts: Counts| {
        answer(
            NamedEarthquake::GroundAcceleration { peak_g: 0.5 },
            Counts { leaning, ..counts },
        )
        .sentence()
    };
    assert!(
        tell(3, counts(20, 18, 9))
            .ends_with("overturn it; in 3 of these it ends leaning on its wall.")
    );
    assert!(
        tell(9, counts(20, 18, 9))
            .ends_with("overturn it; in all of these it ends leaning on its wall.")
    );
    assert!(tell(1, counts(20, 18, 1)).ends_with("overturns it; it then leans on its wall."));
    let one = answer(
        NamedEarthquake::Motions,
        Counts {
            leaning: 1,
            ..counts(1, 1, 1)
        },
    )
    .sentence();
    assert_eq!(
        one,
        "Under this motion this object falls over; it ends leaning on its wall."
    );
}

#[test]
fn the_body_of_a_stack_that_falls_first_is_told() {
    let tell = |upper: u32, counts: Counts| {
        answer(
            NamedEarthquake::GroundAcceleration { peak_g: 0.5 },
            Counts {
                upper_falls: Some(upper),
                ..counts
            },
        )
        .sentence()
    };
    let mixed = "; in 3 of these what stands on it falls first, in the others the object itself.";
    assert!(tell(3, counts(20, 18, 9)).ends_with(mixed));
    assert!(
        tell(9, counts(20, 18, 9)).ends_with("; in all of these what stands on it falls first.")
    );
    assert!(
        tell(0, counts(20, 18, 9)).ends_with("; in all of these the object itself falls first.")
    );
    assert!(!tell(0, counts(20, 18, 0)).contains("first"));
    let one = answer(
        NamedEarthquake::Motions,
        Counts {
            upper_falls: Some(1),
            ..counts(1, 1, 1)
        },
    )
    .sentence();
    assert_eq!(
        one,
        "Under this motion this object falls over; what stands on it falls first."
    );
}

const TEN_G: Option<Withstands> = Some(Withstands {
    peak_g: 10.0,
    duration_s: None,
});

/// The six sentences of the specification, word for word.
#[test]
fn the_sentences_that_were_asked_for() {
    let melbourne = place("Melbourne", "AS 1170.4", Some(500), Some("site De"));
    let one = answer(
        melbourne,
        Counts {
            floor_g_max: 0.13,
            ..counts(20, 0, 0)
        },
    );
    let two = answer(
        NamedEarthquake::Motions,
        Counts {
            uplift_m_max: Some(0.0312),
            ..counts(6, 4, 0)
        },
    );
    let wellington = place("Wellington", "NZS 1170.5", Some(500), Some("site C"));
    let three = Answer {
        floor: ToldFloor::Number {
            floor: 1,
            storeys: 7,
        },
        probability: p(9.0 / 320.0, 0.0109, 0.0577),
        ..answer(wellington, counts(320, 200, 9))
    };
    let los_angeles = place("Los Angeles", "ASCE 7-16", None, Some("site D"));
    let four = Answer {
        floor: ToldFloor::Number {
            floor: 3,
            storeys: 6,
        },
        probability: p(0.45, 0.2, 0.72),
        ..answer(los_angeles, counts(20, 20, 9))
    };
    let five = Answer {
        probability: p(1.0, 0.79, 1.0),
        ..answer(
            NamedEarthquake::GroundAcceleration { peak_g: 0.8 },
            counts(20, 20, 20),
        )
    };
    let athens = NamedEarthquake::Place {
        name: "Athens".to_owned(),
        is_point: false,
        code: "Eurocode 8".to_owned(),
        years: None,
        site: None,
        is_approximate: true,
    };
    let lands = Counts {
        uplift_m_max: Some(0.009),
        shock_g_max: Some(6.41),
        exceeded: Some(0),
        ..counts(160, 31, 0)
    };
    let six = Answer {
        withstands: TEN_G,
        ..answer(athens, lands)
    };
    let expected = [
        (
            one,
            "does-not-rock",
            "In Melbourne (AS 1170.4, 500 years, site De) on the ground, this object rocks in none of 20 simulated \
             earthquakes: the floor reaches 0.13 g at most and it takes 0.21 g to lift an edge.",
        ),
        (
            two,
            "rocks",
            "Under these 6 motions this object stays standing: 4 lift an edge, by 31 mm at most, and none \
             overturns it.",
        ),
        (
            three,
            "probably-stands",
            "In Wellington (NZS 1170.5, 500 years, site C) on floor 1 of 7 this object will probably stay \
             standing: 9 of 320 simulated earthquakes overturn it (2.8 %, between 1.1 and 5.8 %).",
        ),
        (
            four,
            "may-fall",
            "In Los Angeles (ASCE 7-16, site D) on floor 3 of 6 this object may fall over: 9 of 20 simulated \
             earthquakes overturn it (45 %, between 20 and 72 %).",
        ),
        (
            five,
            "falls",
            "At a ground acceleration of 0.8 g this object falls over: all 20 simulated earthquakes overturn it.",
        ),
        (
            six,
            "rocks",
            "In Athens (Eurocode 8, approximate hazard, confirm) on the ground this object stays standing: 31 of \
             160 simulated earthquakes lift an edge, by 9 mm at most; its landings reach 6.4 g, under the 10 g \
             that it withstands.",
        ),
    ];
    for (answer, kind, sentence) in expected {
        assert_eq!(
            (answer.kind.into(), answer.sentence().as_str()),
            (kind, sentence)
        );
    }
}

/// Every kind under every earthquake: one line, one full stop, and what is named.
#[test]
fn every_kind_under_every_earthquake() {
    let earthquakes = [
        (
            place("Oslo", "a code", None, None),
            "In Oslo (a code) on the ground",
            "simulated earthquakes",
        ),
        (
            NamedEarthquake::GroundAcceleration { peak_g: 0.3 },
            "At a ground acceleration of 0.3 g",
            "simulated earthquakes",
        ),
        (
            NamedEarthquake::Study {
                study: "s.toml".to_owned(),
                code: "EC8".to_owned(),
                years: Some(475),
                site: None,
            },
            "Under the earthquake of s.toml (EC8, 475 years) on the ground",
            "simulated earthquakes",
        ),
        (
            NamedEarthquake::MotionsOfStudy {
                motions: 7,
                study: "s.toml".to_owned(),
            },
            "Under the 7 motions of s.toml on the ground",
            "simulations",
        ),
        (NamedEarthquake::Motions, "Under these 40 motions", ""),
    ];
    let of_kind = [
        (counts(40, 0, 0), "rocks in none of "),
        (
            Counts {
                rolled: Some(ROLLED),
                ..counts(40, 0, 0)
            },
            "rolls and stays standing: by up to 310 mm",
        ),
        (
            Counts {
                rolled: Some(ROLLED),
                slides: true,
                ..counts(40, 0, 0)
            },
            "slides and stays standing: by up to 310 mm",
        ),
        (counts(40, 1, 0), "stays standing: 1"),
        (counts(40, 9, 2), "will probably stay standing: 2"),
        (counts(40, 30, 12), "may fall over: 12"),
        (counts(40, 40, 40), "falls over: all 40"),
    ];
    for (earthquake, under, noun) in earthquakes {
        for ((counts, words), kind) in of_kind
            .into_iter()
            .zip(<AnswerKind as strum::VariantArray>::VARIANTS)
        {
            let told = answer(earthquake.clone(), counts);
            let sentence = told.sentence();
            assert_eq!(told.kind, *kind);
            let comma = if *kind == AnswerKind::DoesNotRock {
                ","
            } else {
                ""
            };
            assert!(
                sentence.starts_with(&format!("{under}{comma} this object {words}")),
                "{sentence}"
            );
            assert!(
                sentence.contains(noun) && sentence.ends_with('.') && !sentence.contains('\n'),
                "{sentence}"
            );
        }
    }
}

/// As often as is accepted is accepted; an object falls where the interval lies above one half.
#[test]
fn kinds_at_their_limits() {
    let kind = |asked, overturned, accepted_ratio| {
        let share = f64::from(overturned) / f64::from(asked);
        // Of 20 worlds, a tenth to a quarter on each side.
        let probability = (asked > 1).then_some(Probability {
            value: share,
            low: share - 0.2,
            high: share + 0.2,
        });
        let counts = Counts {
            asked,
            lifted: asked,
            overturned,
            ..Counts::default()
        };
        <&str>::from(AnswerKind::of(&counts, accepted_ratio, probability))
    };
    assert_eq!(
        [2, 3].map(|overturned| kind(20, overturned, 0.1)),
        ["probably-stands", "may-fall"]
    );
    assert_eq!(
        [4, 5].map(|overturned| kind(20, overturned, 0.2)),
        ["probably-stands", "may-fall"]
    );
    assert_eq!(
        [9, 10, 14].map(|overturned| kind(20, overturned, 0.1)),
        ["may-fall"; 3]
    );
    assert_eq!(
        [15, 20].map(|overturned| kind(20, overturned, 0.1)),
        ["falls"; 2]
    );
    // Given motions are all there is.
    let given = |overturned| Counts {
        asked: 3,
        lifted: 3,
        overturned,
        ..Counts::default()
    };
    assert_eq!(
        [2, 3].map(|n| <&str>::from(AnswerKind::of(&given(n), 0.1, None))),
        ["may-fall", "falls"]
    );
    assert_eq!(kind(1, 1, 0.1), "falls");
    // On pads it can fall where an edge of a rigid floor lifts in no world.
    let fallen = Counts {
        asked: 20,
        lifted: 0,
        overturned: 1,
        ..Counts::default()
    };
    assert_eq!(
        AnswerKind::of(&fallen, 0.1, None),
        AnswerKind::ProbablyStands
    );
}

#[test]
fn one_and_all_are_told_as_people_do() {
    let tell = |earthquake: &NamedEarthquake, counts| answer(earthquake.clone(), counts).sentence();
    let one = Counts {
        uplift_m_max: Some(0.1234),
        ..counts(1, 1, 0)
    };
    assert_eq!(
        tell(&NamedEarthquake::Motions, one),
        "Under this motion this object stays standing: it lifts an edge, by 123 mm."
    );
    for (uplift_m, said) in [
        (0.0, "less than 1 mm"),
        (9.99e-4, "less than 1 mm"),
        (1e-3, "1 mm at most"),
    ] {
        let barely = Counts {
            uplift_m_max: Some(uplift_m),
            ..counts(6, 4, 0)
        };
        let whole = format!(": 4 lift an edge, by {said}, and none overturns it.");
        assert!(
            tell(&NamedEarthquake::Motions, barely).ends_with(&whole),
            "{}",
            tell(&NamedEarthquake::Motions, barely)
        );
    }
    assert_eq!(
        tell(&NamedEarthquake::Motions, counts(1, 1, 1)),
        "Under this motion this object falls over."
    );
    let still = Counts {
        floor_g_max: 0.1,
        ..counts(1, 0, 0)
    };
    let said = "Under this motion, this object does not rock: the floor reaches 0.1 g and it takes 0.21 g to lift an \
                edge.";
    assert_eq!(tell(&NamedEarthquake::Motions, still), said);
    assert!(
        tell(&NamedEarthquake::Motions, counts(6, 6, 0))
            .ends_with(": all 6 lift an edge, and none overturns it.")
    );
    assert!(tell(&NamedEarthquake::Motions, counts(6, 6, 1)).ends_with(": 1 overturns it."));
    assert!(tell(&NamedEarthquake::Motions, counts(6, 6, 6)).ends_with(": all 6 overturn it."));
    let peak = NamedEarthquake::GroundAcceleration { peak_g: 0.5 };
    assert!(
        tell(&peak, counts(1, 1, 1))
            .ends_with("falls over: the one simulated earthquake overturns it.")
    );
    let two = tell(&peak, counts(20, 1, 0));
    assert!(
        two.ends_with(": 1 of 20 simulated earthquakes lifts an edge, and none overturns it."),
        "{two}"
    );
}

/// A peak of the floor above the threshold does not contradict the sentence.
#[test]
fn no_uplift_above_the_threshold() {
    let told = answer(
        NamedEarthquake::Motions,
        Counts {
            floor_g_max: 0.25,
            ..counts(6, 0, 0)
        },
    );
    assert_eq!(
        told.sentence(),
        "Under these 6 motions, this object rocks in none of them: none lifts an edge."
    );
    let near = answer(
        NamedEarthquake::Motions,
        Counts {
            floor_g_max: 0.2096,
            ..counts(6, 0, 0)
        },
    );
    assert!(
        near.sentence()
            .contains("reaches 0.2096 g at most and it takes 0.21 g"),
        "{}",
        near.sentence()
    );
}

#[test]
fn what_it_withstands() {
    let tell = |counts: Counts, withstands: Option<Withstands>| {
        Answer {
            withstands,
            ..answer(NamedEarthquake::GroundAcceleration { peak_g: 0.3 }, counts)
        }
        .sentence()
    };
    let hard = Counts {
        shock_g_max: Some(14.2),
        exceeded: Some(12),
        ..counts(160, 31, 9)
    };
    assert!(tell(hard, TEN_G).ends_with(
        "; its landings reach 14 g and exceed the 10 g that it withstands, in 12 of 160."
    ),);
    let near = Counts {
        shock_g_max: Some(9.97),
        exceeded: Some(0),
        ..counts(160, 31, 0)
    };
    assert!(
        tell(near, TEN_G)
            .ends_with("; its landings reach 9.97 g, under the 10 g that it withstands.")
    );
    let pulse = Some(Withstands {
        peak_g: 15.0,
        duration_s: Some(0.011),
    });
    let harder = Counts {
        shock_g_max: Some(18.0),
        exceeded: Some(0),
        ..counts(160, 31, 0)
    };
    // The peak is higher, and yet the pulse is survived: the sentence says what is compared.
    let said = "; its landings reach 18 g with shock response spectra that stay below that of the 15 g of 11 ms that it \
                withstands.";
    assert!(
        tell(harder, pulse).ends_with(said),
        "{}",
        tell(harder, pulse)
    );
    let longer = Counts {
        shock_g_max: Some(14.0),
        exceeded: Some(4),
        ..harder
    };
    let said = "; its landings reach 14 g with shock response spectra that exceed that of the 15 g of 11 ms that it \
                withstands, in 4 of 160.";
    assert!(
        tell(longer, pulse).ends_with(said),
        "{}",
        tell(longer, pulse)
    );
    let still = Counts {
        floor_g_max: 0.15,
        exceeded: Some(0),
        ..counts(20, 0, 0)
    };
    assert!(
        tell(still, TEN_G).ends_with("to lift an edge; it withstands 10 g."),
        "{}",
        tell(still, TEN_G)
    );
    let weak = Some(Withstands {
        peak_g: 0.1,
        duration_s: None,
    });
    let shaken = Counts {
        exceeded: Some(20),
        ..still
    };
    assert!(tell(shaken, weak).ends_with(
        "; the floor alone, 0.15 g, exceeds the 0.1 g that it withstands, in 20 of 20."
    ));
    let soft = Counts {
        shock_g_max: Some(0.08),
        exceeded: Some(3),
        ..counts(20, 9, 0)
    };
    assert!(
        tell(soft, weak).ends_with(
            "; the floor alone, 0.3 g, exceeds the 0.1 g that it withstands, in 3 of 20."
        )
    );
    // What falls over does not land on its edges.
    let fallen = Counts {
        exceeded: Some(0),
        ..counts(20, 20, 20)
    };
    assert!(tell(fallen, TEN_G).ends_with("overturn it."));
}

#[test]
fn floors_by_name_and_height() {
    let on = |floor| {
        Answer {
            floor,
            ..answer(place("Oslo", "a code", None, None), counts(20, 20, 20))
        }
        .sentence()
    };
    assert!(on(ToldFloor::Roof).starts_with("In Oslo (a code) on the roof this object"));
    assert!(on(ToldFloor::Name("Lobby".to_owned())).contains(" on \"Lobby\" this object"));
    assert!(
        on(ToldFloor::Share(0.5)).contains(" at 50 % of the height of the building this object")
    );
}
