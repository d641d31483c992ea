//! Memory for the values that are taken out of columns.

use std::slice::ChunksExactMut;
use std::sync::{Mutex, PoisonError};

use crate::columns::Columns;
use crate::limits::REPLICATES;
use crate::model::{LANES, Lanes};

/// The memory of a [`Room`]. To touch memory for the first time costs more than what is done with it, so all
/// of it lies together, in large pages where the system has some.
#[derive(Debug)]
pub(crate) struct Store {
    numbers: Columns,
    size: Size,
}

impl Store {
    /// For what is usually taken out of so many columns, each of so many values. Where it does not suffice,
    /// pieces have memory of their own.
    pub(crate) fn new(columns: usize, planned: usize, is_replicated: bool) -> Self {
        /// 16 MiB.
        const MOST: usize = 1 << 21;
        let size = Size::of(planned, is_replicated);
        // Of a million values about forty times the root are out at once.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a positive number")]
        let usual = (64.0 * (planned as f64).sqrt()) as usize;
        let pieces = usual.min(planned).div_ceil(size.values).saturating_mul(columns);
        let numbers = pieces.saturating_mul(size.numbers()).min(MOST);
        Self { numbers: Columns::new(1, numbers), size }
    }

    pub(crate) fn room(&mut self) -> Room<'_> {
        let numbers = self.numbers.iter_mut().next().unwrap_or_default();
        Room { size: self.size, free: Mutex::new(numbers.chunks_exact_mut(self.size.numbers())) }
    }
}

/// Memory from which the watches of all threads take pieces.
#[derive(Debug)]
pub(crate) struct Room<'m> {
    size: Size,
    free: Mutex<ChunksExactMut<'m, f64>>,
}

/// The most values of a piece.
pub(super) const PIECE: usize = 1 << 12;

impl<'m> Room<'m> {
    fn take(&self) -> Memory<'m> {
        let next = self.free.lock().unwrap_or_else(PoisonError::into_inner).next();
        next.map_or_else(|| Memory::Own(vec![0.0; self.size.numbers()]), Memory::Lent)
    }
}

/// What a piece holds.
#[derive(Clone, Copy, Debug)]
struct Size {
    values: usize,
    /// Numbers that take as much memory as the cells of these values, and as their replicates where there
    /// are some.
    beside: [usize; 2],
}

impl Size {
    /// Few values where few are to come.
    fn of(planned: usize, is_replicated: bool) -> Self {
        const BYTES: usize = size_of::<f64>();
        let values = planned.clamp(1, PIECE).next_multiple_of(BYTES);
        let replicates = if is_replicated { values / BYTES } else { 0 };
        Self { values, beside: [values * size_of::<i16>() / BYTES, replicates] }
    }

    fn numbers(&self) -> usize {
        self.values + self.beside[0] + self.beside[1]
    }
}

#[derive(Debug)]
enum Memory<'m> {
    Lent(&'m mut [f64]),
    Own(Vec<f64>),
}

/// Some values, each with its cell and its replicate: by Monte Carlo all have one, of which nothing is noted.
#[derive(Debug)]
pub(super) struct Piece<'m> {
    memory: Memory<'m>,
    size: Size,
    len: usize,
}

impl<'m> Piece<'m> {
    pub(super) fn new(room: &Room<'m>) -> Self {
        Self { memory: room.take(), size: room.size, len: 0 }
    }

    pub(super) fn len(&self) -> usize {
        self.len
    }

    pub(super) fn is_full(&self) -> bool {
        self.len == self.size.values
    }

    #[inline]
    fn parts(&self) -> (&[f64], &[i16], &[u8]) {
        let numbers: &[f64] = match &self.memory {
            Memory::Lent(numbers) => numbers,
            Memory::Own(numbers) => numbers,
        };
        let (values, beside) = numbers.split_at(self.size.values);
        let (cells, replicates) = beside.split_at(self.size.beside[0]);
        (values, bytemuck::cast_slice(cells), bytemuck::cast_slice(replicates))
    }

    #[inline]
    fn parts_mut(&mut self) -> (&mut [f64], &mut [i16], &mut [u8]) {
        let numbers: &mut [f64] = match &mut self.memory {
            Memory::Lent(numbers) => numbers,
            Memory::Own(numbers) => numbers,
        };
        let (values, beside) = numbers.split_at_mut(self.size.values);
        let (cells, replicates) = beside.split_at_mut(self.size.beside[0]);
        (values, bytemuck::cast_slice_mut(cells), bytemuck::cast_slice_mut(replicates))
    }

    pub(super) fn values(&self) -> &[f64] {
        &self.parts().0[..self.len]
    }

    /// That of each value.
    pub(super) fn cells(&self) -> &[i16] {
        &self.parts().1[..self.len]
    }

    /// Each value with its cell and replicate.
    #[inline]
    pub(super) fn iter(&self) -> impl Iterator<Item = (f64, i16, usize)> {
        let (values, cells, replicates) = self.parts();
        let noted = values.iter().zip(cells).take(self.len).enumerate();
        noted.map(|(place, (value, cell))| (*value, *cell, replicate(replicates, place)))
    }

    /// Adds the values of a block for which there is a bit, with their cells, as many as there is place for.
    /// Leaves the bits of the others.
    #[inline]
    pub(super) fn take(&mut self, noted: &mut u64, block: &Lanes, of_block: &Lanes<i16>) {
        let mut len = self.len;
        let (values, cells, replicates) = self.parts_mut();
        for (value, cell) in values.iter_mut().zip(cells).skip(len) {
            if *noted == 0 {
                break;
            }
            let lane = noted.trailing_zeros() as usize % LANES;
            *noted &= *noted - 1;
            (*value, *cell) = (block[lane], of_block[lane]);
            if let Some(replicate) = replicates.get_mut(len) {
                #[expect(clippy::cast_possible_truncation, reason = "below 16")]
                let of_lane = (lane % REPLICATES) as u8;
                *replicate = of_lane;
            }
            len += 1;
        }
        self.len = len;
    }

    /// Leaves those values of which it is told that they stay, by their place, cell and replicate.
    #[inline]
    pub(super) fn retain(&mut self, mut stays: impl FnMut(usize, (f64, i16, usize)) -> bool) {
        let len = self.len;
        let (values, cells, replicates) = self.parts_mut();
        let mut left = 0;
        for place in 0..len {
            let noted = (values[place], cells[place], replicate(replicates, place));
            // Moved in any case, as which of them stay cannot be predicted.
            (values[left], cells[left]) = (noted.0, noted.1);
            if let Some(of_value) = replicates.get(place).copied() {
                replicates[left] = of_value;
            }
            left += usize::from(stays(place, noted));
        }
        self.len = left;
    }
}

#[inline]
fn replicate(replicates: &[u8], place: usize) -> usize {
    replicates.get(place).map_or(0, |replicate| usize::from(*replicate) % REPLICATES)
}

#[cfg(test)]
mod tests {
    use super::{Lanes, PIECE, Piece, Store};

    /// More pieces than there is memory for.
    #[test]
    fn pieces_lie_apart_wherever_they_are() {
        for planned in [1, 70, PIECE, 10 * PIECE] {
            for is_replicated in [false, true] {
                let mut store = Store::new(2, planned, is_replicated);
                let room = store.room();
                let mut pieces: Vec<Piece<'_>> =
                    (0..3 * planned.div_ceil(PIECE)).map(|_| Piece::new(&room)).collect();
                let replicate = if is_replicated { 5 } else { 0 };
                let marks = || (0_i16..).map(|mark| (f64::from(mark), mark, replicate));
                for (piece, (value, cell, replicate)) in pieces.iter_mut().zip(marks()) {
                    for _ in 0..planned.min(PIECE) {
                        let mut block = Lanes::splat(f64::NAN);
                        let lane = 32 + replicate;
                        block[lane] = value + piece.len() as f64;
                        piece.take(&mut (1 << lane), &block, &Lanes::splat(cell));
                    }
                    assert_eq!(piece.len(), planned.min(PIECE));
                }
                for (piece, (value, cell, replicate)) in pieces.iter_mut().zip(marks()) {
                    let noted = (0_u16..).map(|number| (value + f64::from(number), cell, replicate));
                    assert!(piece.iter().eq(noted.take(piece.len())));
                    piece.retain(|place, noted| {
                        place % 2 == 1 && noted == (value + place as f64, cell, replicate)
                    });
                    assert_eq!(piece.len(), planned.min(PIECE) / 2);
                    assert!(planned == 1 || piece.values()[0] == value + 1.0);
                }
            }
        }
    }
}
