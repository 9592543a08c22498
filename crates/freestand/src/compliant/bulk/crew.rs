//! Worlds in lanes: those with both edges on their pads, and those that may lift, in turn.

use std::collections::BTreeMap;

use pulp::Arch;

use super::LANES;
use super::lifted::{self, Lifted};
use super::pressed::{self, Ground, Pressed};
use super::world::{Next, World};

/// Samples that the recursion takes in one go.
const BLOCK: usize = 64;

/// Follows worlds to their ends.
pub(super) fn run(arch: Arch, worlds: &mut [World]) {
    let mut waiting: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (place, world) in worlds.iter().enumerate() {
        waiting.entry(world.parts()).or_default().push(place);
    }
    let mut loose = Loose::default();
    loop {
        while let Some((parts, places)) = waiting.pop_first() {
            press(arch, worlds, places, parts, &mut loose.waiting);
        }
        if loose.is_over() {
            break;
        }
        loose.run(arch, worlds, &mut waiting);
    }
}

/// A world in a lane, and the block in which an edge let go.
#[derive(Debug, Clone, Copy)]
struct Seat {
    world: usize,
    index: usize,
    left_block: Option<usize>,
}

/// Follows worlds of so many steps a sample until an edge lets go, or to the end.
fn press(arch: Arch, worlds: &mut [World], mut places: Vec<usize>, parts: usize, off: &mut Vec<usize>) {
    places.reverse();
    let mut lanes = Box::<Pressed>::default();
    let mut seats: [Option<Seat>; LANES] = [None; LANES];
    let mut ground = Ground::default();
    loop {
        for (lane, seat) in seats.iter_mut().enumerate() {
            if seat.is_none() && let Some(world) = places.pop() {
                worlds[world].press(&mut lanes, lane);
                *seat = Some(Seat { world, index: worlds[world].index(), left_block: None });
            }
        }
        let left = |seat: &Seat| worlds[seat.world].intervals_left() + worlds[seat.world].index() - seat.index;
        let Some(block) = seats.iter().flatten().map(left).min() else { break };
        let block = block.min(BLOCK);
        ground.fill(worlds, &seats, block);
        pressed::follow(arch, &mut lanes, &ground, parts);
        for (lane, seat) in seats.iter_mut().enumerate() {
            let Some(Seat { world: place, index, left_block }) = seat else { continue };
            let world = &mut worlds[*place];
            if lanes.holds[lane] == 0.0 && left_block.is_none() {
                *left_block = Some(*index);
            }
            *index += block;
            let is_over = *index >= world.index() + world.intervals_left();
            if is_over || (left_block.is_some() && world.is_screened) {
                if world.after_pressed(&lanes, lane, *left_block) {
                    off.push(*place);
                }
                lanes.leave(lane);
                *seat = None;
            }
        }
    }
}

impl Ground {
    /// The base acceleration at the samples of a block, lane by lane.
    fn fill(&mut self, worlds: &[World], seats: &[Option<Seat>; LANES], block: usize) {
        let moves_up = seats.iter().flatten().any(|seat| worlds[seat.world].is_vertical());
        self.horizontal.clear();
        self.horizontal.resize(block + 1, Default::default());
        self.vertical.clear();
        self.vertical.resize(if moves_up { block + 1 } else { 0 }, Default::default());
        for (lane, seat) in seats.iter().enumerate() {
            let Some(seat) = seat else { continue };
            let world = &worlds[seat.world];
            for (way, columns) in [&mut self.horizontal, &mut self.vertical].into_iter().enumerate() {
                for (k, column) in columns.iter_mut().enumerate() {
                    column[lane] = world.sample(seat.index + k)[way];
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
        Self { waiting: Vec::new(), lanes, seats: [None; LANES] }
    }
}

impl Loose {
    fn is_over(&self) -> bool {
        self.waiting.is_empty() && self.seats.iter().all(Option::is_none)
    }

    /// Until as many worlds wait to be pressed as are left in the lanes.
    fn run(&mut self, arch: Arch, worlds: &mut [World], calm: &mut BTreeMap<usize, Vec<usize>>) {
        let mut calmed = 0;
        loop {
            for (lane, seat) in self.seats.iter_mut().enumerate() {
                if seat.is_none() && let Some(world) = self.waiting.pop() {
                    worlds[world].lift(&mut self.lanes, lane);
                    *seat = Some(world);
                }
            }
            if self.seats.iter().flatten().count() <= calmed {
                return;
            }
            let mut has_left = false;
            while !has_left {
                lifted::advance(arch, &mut self.lanes);
                for lane in 0..LANES {
                    if self.lanes.flags[lane] == 0.0 {
                        continue;
                    }
                    let Some(place) = self.seats[lane] else { continue };
                    let world = &mut worlds[place];
                    let Some(next) = world.after_step(&mut self.lanes, lane) else { continue };
                    if next == Next::Pressed {
                        calm.entry(world.parts()).or_default().push(place);
                        calmed += 1;
                    }
                    self.lanes.leave(lane);
                    self.seats[lane] = None;
                    has_left = true;
                }
            }
        }
    }
}
