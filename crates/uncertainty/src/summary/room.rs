//! Memory for the values that are taken out of columns.

use std::slice::ChunksExactMut;
use std::sync::{Mutex, PoisonError};

use crate::columns::Columns;
use crate::limits::REPLICATES;

/// Memory of which the watches of all threads take pieces. To touch memory for the first time costs more
/// than what is done with it, so all pieces lie together, in large pages where the system has some.
#[derive(Debug)]
pub(crate) struct Room<'m> {
    /// Values that a piece holds.
    values: usize,
    free: Mutex<ChunksExactMut<'m, f64>>,
}

/// The most values of a piece.
pub(super) const PIECE: usize = 1 << 12;

impl<'m> Room<'m> {
    /// Memory for what is usually taken out of so many columns, each of so many values. Where it does not
    /// suffice, pieces have their own.
    pub(crate) fn memory(columns: usize, planned: usize) -> Columns {
        /// 16 MiB.
        const MOST: usize = 1 << 21;
        let of_piece = values_of_piece(planned);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a positive number")]
        let usual = (64.0 * (planned as f64).sqrt()) as usize;
        let pieces = usual.min(planned).div_ceil(of_piece).saturating_mul(columns);
        Columns::new(1, pieces.saturating_mul(numbers(of_piece)).min(MOST))
    }

    pub(crate) fn new(memory: &'m mut Columns, planned: usize) -> Self {
        let values = values_of_piece(planned);
        let memory = memory.iter_mut().next().unwrap_or_default();
        Self { values, free: Mutex::new(memory.chunks_exact_mut(numbers(values))) }
    }

    fn take(&self) -> Memory<'m> {
        let next = self.free.lock().unwrap_or_else(PoisonError::into_inner).next();
        next.map_or_else(|| Memory::Own(vec![0.0; numbers(self.values)]), Memory::Lent)
    }
}

/// Few where few are to come.
fn values_of_piece(planned: usize) -> usize {
    planned.clamp(1, PIECE).next_multiple_of(CELLS)
}

/// Cells that take as much memory as a value.
const CELLS: usize = size_of::<f64>() / size_of::<i16>();

/// As many as so many values and their cells take, a multiple of [`CELLS`].
fn numbers(values: usize) -> usize {
    values + values / CELLS
}

#[derive(Debug)]
enum Memory<'m> {
    Lent(&'m mut [f64]),
    Own(Vec<f64>),
}

impl Memory<'_> {
    /// The first numbers are values, and the others their cells.
    #[inline]
    fn split(&self, values: usize) -> (&[f64], &[i16]) {
        let numbers: &[f64] = match self {
            Self::Lent(numbers) => numbers,
            Self::Own(numbers) => numbers,
        };
        let (values, cells) = numbers.split_at(values);
        (values, bytemuck::cast_slice(cells))
    }

    #[inline]
    fn split_mut(&mut self, values: usize) -> (&mut [f64], &mut [i16]) {
        let numbers: &mut [f64] = match self {
            Self::Lent(numbers) => numbers,
            Self::Own(numbers) => numbers,
        };
        let (values, cells) = numbers.split_at_mut(values);
        (values, bytemuck::cast_slice_mut(cells))
    }
}

/// Some values with their cells.
#[derive(Debug)]
pub(super) struct Piece<'m> {
    memory: Memory<'m>,
    most: usize,
    len: usize,
    /// That of each value, where there are replicates: by Monte Carlo all have one.
    replicates: Vec<u8>,
}

impl<'m> Piece<'m> {
    pub(super) fn new(room: &Room<'m>, is_replicated: bool) -> Self {
        let replicates = Vec::with_capacity(if is_replicated { room.values } else { 0 });
        Self { memory: room.take(), most: room.values, len: 0, replicates }
    }

    pub(super) fn len(&self) -> usize {
        self.len
    }

    pub(super) fn is_full(&self) -> bool {
        self.len == self.most
    }

    pub(super) fn values(&self) -> &[f64] {
        &self.memory.split(self.most).0[..self.len]
    }

    /// That of each value.
    pub(super) fn cells(&self) -> &[i16] {
        &self.memory.split(self.most).1[..self.len]
    }

    pub(super) fn replicate(&self, place: usize) -> usize {
        replicate(&self.replicates, place)
    }

    /// There must be a place.
    #[inline]
    pub(super) fn push(&mut self, value: f64, cell: i16, of_replicate: Option<usize>) {
        let place = self.len;
        let (values, cells) = self.memory.split_mut(self.most);
        (values[place], cells[place]) = (value, cell);
        #[expect(clippy::cast_possible_truncation, reason = "below 16")]
        self.replicates.extend(of_replicate.map(|replicate| replicate as u8));
        self.len += 1;
    }

    /// Leaves those values of which it is told that they stay, by their place, cell and replicate.
    #[inline]
    pub(super) fn retain(&mut self, mut stays: impl FnMut(usize, (f64, i16, usize)) -> bool) {
        let (values, cells) = self.memory.split_mut(self.most);
        let mut left = 0;
        for place in 0..self.len {
            let (value, cell) = (values[place], cells[place]);
            let of_replicate = replicate(&self.replicates, place);
            // Moved in any case, as which of them stay cannot be predicted.
            (values[left], cells[left]) = (value, cell);
            if let Some(of_value) = self.replicates.get(place).copied() {
                self.replicates[left] = of_value;
            }
            left += usize::from(stays(place, (value, cell, of_replicate)));
        }
        self.len = left;
        self.replicates.truncate(left);
    }
}

fn replicate(replicates: &[u8], place: usize) -> usize {
    replicates.get(place).map_or(0, |replicate| usize::from(*replicate) % REPLICATES)
}

#[cfg(test)]
mod tests {
    use super::{PIECE, Piece, Room};

    /// More pieces than there is memory for.
    #[test]
    fn pieces_lie_apart_wherever_they_are() {
        for planned in [1, 70, PIECE, 10 * PIECE] {
            for is_replicated in [false, true] {
                let mut memory = Room::memory(2, planned);
                let room = Room::new(&mut memory, planned);
                let mut pieces: Vec<Piece<'_>> =
                    (0..3 * planned.div_ceil(PIECE)).map(|_| Piece::new(&room, is_replicated)).collect();
                let marks = || (0_i16..).map(|mark| (f64::from(mark), mark, usize::from(is_replicated) * 5));
                for (piece, first) in pieces.iter_mut().zip(marks()) {
                    while !piece.is_full() {
                        let (value, cell, replicate) = first;
                        piece.push(value + piece.len() as f64, cell, is_replicated.then_some(replicate));
                    }
                    assert!(piece.len() >= planned.min(PIECE));
                }
                for (piece, (value, cell, replicate)) in pieces.iter_mut().zip(marks()) {
                    assert!((0_u16..).zip(piece.values()).all(|(n, other)| value + f64::from(n) == *other));
                    assert!(piece.cells().iter().all(|other| *other == cell));
                    assert_eq!(piece.replicate(0), replicate);
                    piece.retain(|place, noted| {
                        place % 2 == 1 && noted == (value + place as f64, cell, replicate)
                    });
                    assert_eq!(piece.len(), piece.most / 2);
                    assert_eq!(piece.values()[0], value + 1.0);
                }
            }
        }
    }
}
