//! Worlds in lanes: those with both edges on their pads, and those that may lift. Whichever has more lanes to fill
//! goes on.

use pulp::Arch;

use super::LANES;
use super::lifted::{self, Lifted};
use super::pressed::{self, Ground, Pressed};
use super::stretch::SAMPLES;
use super::world::{Next, World};

/// Samples that the recursion takes in one go.
const BLOCK: usize = 4 * SAMPLES;

/// Follows worlds to their ends.
pub(super) fn run(arch: Arch, worlds: &mut [World]) {
    let mut firm = Firm {
        waiting: (0..worlds.len()).rev().collect(),
        ..Firm::default()
    };
    let mut loose = Loose::default();
    while firm.ready() + loose.ready() > 0 {
        if firm.ready() >= loose.ready() {
            firm.run(arch, worlds, &mut loose.waiting);
        } else {
            loose.run(arch, worlds, &mut firm.waiting);
        }
    }
}

/// A world in a lane, and its sample.
#[derive(Debug, Clone, Copy)]
struct Seat {
    world: usize,
    index: usize,
}

/// Worlds with both edges on their pads.
#[derive(Debug, Default)]
struct Firm {
    waiting: Vec<usize>,
    lanes: Box<Pressed>,
    seats: [Option<Seat>; LANES],
    ground: Ground,
}

impl Firm {
    /// Lanes that are or can be filled.
    fn ready(&self) -> usize {
        (self.seats.iter().flatten().count() + self.waiting.len()).min(LANES)
    }

    /// A block of samples, or to the end of a world. A world ends with a stretch: after its motion the base rests.
    fn run(&mut self, arch: Arch, worlds: &mut [World], off: &mut Vec<usize>) {
        for (lane, seat) in self.seats.iter_mut().enumerate() {
            if seat.is_none()
                && let Some(world) = self.waiting.pop()
            {
                worlds[world].press(&mut self.lanes, lane);
                *seat = Some(Seat {
                    world,
                    index: worlds[world].index(),
                });
            }
        }
        let left = |seat: &Seat| worlds[seat.world].intervals().saturating_sub(seat.index);
        let block = self
            .seats
            .iter()
            .flatten()
            .map(left)
            .min()
            .unwrap_or(0)
            .next_multiple_of(SAMPLES)
            .min(BLOCK);
        self.ground.fill(worlds, &self.seats, block);
        pressed::follow(arch, &mut self.lanes, &self.ground);
        for (lane, seat) in self.seats.iter_mut().enumerate() {
            let Some(Seat {
                world: place,
                index,
            }) = seat
            else {
                continue;
            };
            let world = &mut worlds[*place];
            *index += block;
            let is_over = *index >= world.intervals();
            // Where an edge lets go matters at once to a world that was screened.
            if world.is_screened {
                self.lanes.look(arch, lane, world.look(), &world.of());
            } else if is_over {
                self.lanes
                    .look_at_all(arch, lane, world.look(), &world.of());
            }
            let reached = &self.lanes.reached[lane];
            if is_over || (world.is_screened && reached.left.is_some()) {
                if world.after_pressed(reached) {
                    off.push(*place);
                }
                self.lanes.leave(lane);
                *seat = None;
            }
        }
    }
}

impl Ground {
    /// The base acceleration at the samples of a block, lane by lane.
    fn fill(&mut self, worlds: &[World], seats: &[Option<Seat>; LANES], block: usize) {
        let moves_up = seats
            .iter()
            .flatten()
            .any(|seat| worlds[seat.world].is_vertical());
        self.horizontal.resize(block + 1, Default::default());
        self.vertical
            .resize(if moves_up { block + 1 } else { 0 }, Default::default());
        for (lane, seat) in seats.iter().enumerate() {
            self.first[lane] = seat.map_or(0, |seat| seat.index);
            for (way, columns) in [&mut self.horizontal, &mut self.vertical]
                .into_iter()
                .enumerate()
            {
                let samples =
                    seat.map_or(&[][..], |seat| worlds[seat.world].samples(way, seat.index));
                let count = samples.len().min(columns.len());
                let (moved, still) = columns.split_at_mut(count);
                for (column, sample) in moved.iter_mut().zip(samples) {
                    column[lane] = *sample;
                }
                for column in still {
                    column[lane] = 0.0;
                }
            }
        }
    }
}

/// Worlds that may lift.
#[derive(Debug)]
struct Loose {
    waiting: Vec<usize>,
    lanes: Box<Lifted>,
    seats: [Option<usize>; LANES],
}

impl Default for Loose {
    fn default() -> Self {
        let mut lanes = Box::<Lifted>::default();
        for lane in 0..LANES {
            lanes.leave(lane);
        }
        Self {
            waiting: Vec::new(),
            lanes,
            seats: [None; LANES],
        }
    }
}

impl Loose {
    /// Lanes that are or can be filled.
    fn ready(&self) -> usize {
        (self.seats.iter().flatten().count() + self.waiting.len()).min(LANES)
    }

    /// Until a world leaves its lane.
    fn run(&mut self, arch: Arch, worlds: &mut [World], on: &mut Vec<usize>) {
        for (lane, seat) in self.seats.iter_mut().enumerate() {
            if seat.is_none()
                && let Some(world) = self.waiting.pop()
            {
                worlds[world].lift(&mut self.lanes, lane);
                *seat = Some(world);
            }
        }
        let mut has_left = false;
        while !has_left {
            lifted::advance(arch, &mut self.lanes);
            let flags = self.lanes.flags.iter().enumerate();
            let mut asking = flags.fold(0_u32, |asking, (lane, flags)| {
                asking | u32::from(*flags != 0.0) << lane
            });
            while asking != 0 {
                let lane = asking.trailing_zeros() as usize;
                asking &= asking - 1;
                let Some(place) = self.seats[lane] else {
                    continue;
                };
                let world = &mut worlds[place];
                let Some(next) = world.after_step(&mut self.lanes, lane) else {
                    continue;
                };
                if next == Next::Pressed {
                    on.push(place);
                }
                self.lanes.leave(lane);
                self.seats[lane] = None;
                has_left = true;
            }
        }
    }
}
