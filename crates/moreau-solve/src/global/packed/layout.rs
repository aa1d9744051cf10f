//! Which contact goes into which lane: blocks, their waves, and the groups within them.

use super::Members;
use crate::operator::colouring::first_free;
use crate::operator::{Balls, NONE};
use crate::wide::LANES;
use std::ops::Range;

/// Contacts of a block: enough for their colours to fill groups, few enough to stay in a cache with their bodies.
const BLOCK: usize = if cfg!(miri) { 32 } else { 1024 };

/// Waves and colours are the bits of a word.
const COLOURS: usize = 64;

/// The order of visits.
#[derive(Clone, Debug, Default)]
pub(super) struct Layout {
    /// The contacts of each group.
    pub(super) members: Vec<Members>,
    /// Where each contact is: the number of its group, times the lanes, plus its lane.
    pub(super) slots: Vec<u32>,
    /// The groups of each block.
    pub(super) blocks: Vec<Range<usize>>,
    /// The blocks of each wave, which share no body.
    pub(super) waves: Vec<Range<usize>>,
    /// Where each body is in the state, in the order in which blocks first touch them; [`NONE`] where no contact does.
    pub(super) rows: Vec<u32>,
    /// The bodies that have rows, in their order.
    pub(super) touched: Vec<u32>,
    /// Contacts by place, then by colour within a block.
    sorted: Vec<u32>,
    spare: Vec<u32>,
    counts: Vec<u32>,
    /// Colours that a body has.
    taken: Vec<u64>,
    colours: Vec<u32>,
    waves_of_blocks: Vec<(u32, u32)>,
}

impl Layout {
    /// Makes it anew.
    pub(super) fn arrange<const D: usize>(&mut self, balls: &Balls<D>) {
        self.members.clear();
        self.slots.clear();
        self.slots.resize(balls.len(), NONE);
        self.blocks.clear();
        self.waves.clear();
        self.sort(balls);
        self.taken.clear();
        self.taken.resize(balls.bodies.len(), 0);
        self.find_waves(balls);
        self.taken.fill(0);
        self.touched.clear();
        self.rows.clear();
        self.rows.resize(balls.bodies.len(), NONE);
        let blocks = std::mem::take(&mut self.waves_of_blocks);
        let mut wave = u32::MAX;
        for &(of, block) in &blocks {
            // A wave beyond those that can be told apart shares bodies within itself.
            if of != wave || of as usize >= COLOURS {
                self.waves.push(self.blocks.len()..self.blocks.len());
                wave = of;
            }
            let begin = block as usize * BLOCK;
            let end = (begin + BLOCK).min(balls.len());
            self.group(balls, begin..end);
            if let Some(last) = self.waves.last_mut() {
                last.end += 1;
            }
        }
        self.waves_of_blocks = blocks;
    }

    /// Sorts the contacts by the place of their first body, where there is more than one block.
    fn sort<const D: usize>(&mut self, balls: &Balls<D>) {
        let contacts = 0..balls.len() as u32;
        self.sorted.clear();
        if balls.len() <= BLOCK {
            self.sorted.extend(contacts);
            return;
        }
        let place = |body: u32| balls.places.get(body as usize).copied().unwrap_or(body);
        let key = |c: u32| balls.contacts[c as usize].pair.map(place).into_iter().min().unwrap_or(0) as usize;
        self.counts.clear();
        self.counts.resize(balls.bodies.len() + 2, 0);
        let last = balls.bodies.len();
        for c in contacts.clone() {
            self.counts[key(c).min(last) + 1] += 1;
        }
        for k in 1..self.counts.len() {
            self.counts[k] += self.counts[k - 1];
        }
        self.sorted.resize(balls.len(), 0);
        for c in contacts {
            let next = &mut self.counts[key(c).min(last)];
            self.sorted[*next as usize] = c;
            *next += 1;
        }
    }

    /// Colours the blocks, and sorts them by colour.
    fn find_waves<const D: usize>(&mut self, balls: &Balls<D>) {
        self.waves_of_blocks.clear();
        for (block, contacts) in (0..).zip(self.sorted.chunks(BLOCK)) {
            let bodies = || {
                let pairs = contacts.iter().flat_map(|&c| balls.contacts[c as usize].pair);
                pairs.filter(|&body| body != NONE).map(|body| body as usize)
            };
            let used = bodies().fold(0, |used, body| used | self.taken[body]);
            let wave = used.trailing_ones();
            bodies().for_each(|body| self.taken[body] |= 1_u64.checked_shl(wave).unwrap_or(0));
            self.waves_of_blocks.push((wave, block));
        }
        self.waves_of_blocks.sort_unstable();
    }

    /// Puts the contacts of one block into groups, colour by colour.
    fn group<const D: usize>(&mut self, balls: &Balls<D>, block: Range<usize>) {
        let contacts = &mut self.sorted[block];
        let pair = |c: u32| balls.contacts[c as usize].pair;
        let mut counts = [0; COLOURS + 2];
        self.colours.clear();
        for &c in &*contacts {
            let colour = first_free(&mut self.taken, pair(c));
            counts[colour as usize + 1] += 1;
            self.colours.push(colour);
        }
        for body in contacts.iter().flat_map(|&c| pair(c)).filter(|&body| body != NONE) {
            self.taken[body as usize] = 0;
            if self.rows[body as usize] == NONE {
                self.rows[body as usize] = self.touched.len() as u32;
                self.touched.push(body);
            }
        }
        for k in 1..counts.len() {
            counts[k] += counts[k - 1];
        }
        let starts = counts;
        self.spare.resize(contacts.len(), 0);
        for (&c, &colour) in contacts.iter().zip(&self.colours) {
            let next = &mut counts[colour as usize];
            self.spare[*next] = c;
            *next += 1;
        }
        let first = self.members.len();
        for colour in 0..=COLOURS {
            // What no colour was left for stands alone.
            let size = if colour < COLOURS { LANES } else { 1 };
            for chunk in self.spare[starts[colour]..starts[colour + 1]].chunks(size) {
                let (mut members, slot) = ([NONE; LANES], (self.members.len() * LANES) as u32);
                members[..chunk.len()].copy_from_slice(chunk);
                chunk.iter().zip(slot..).for_each(|(&c, slot)| self.slots[c as usize] = slot);
                self.members.push(members);
            }
        }
        self.blocks.push(first..self.members.len());
    }
}
