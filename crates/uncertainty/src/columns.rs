//! Memory for the samples of all outputs.

#[cfg(target_os = "linux")]
use memmap2::{Advice, MmapMut};

/// Columns of one length, in one piece of memory.
#[derive(Clone, Debug)]
pub(crate) struct Columns {
    numbers: Numbers,
    count: usize,
    /// From the beginning of one to that of the next.
    stride: usize,
    /// How many of these places are used.
    len: usize,
}

impl Columns {
    /// So many columns of zeros.
    pub(crate) fn new(count: usize, len: usize) -> Self {
        Self { numbers: Numbers::zeros(count * len), count, stride: len, len }
    }

    /// How many columns there are.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Leaves so many numbers of each column, at most.
    pub(crate) fn truncate(&mut self, len: usize) {
        self.len = self.len.min(len);
    }

    pub(crate) fn get(&self, column: usize) -> Option<&[f64]> {
        let begin = column * self.stride;
        (column < self.count).then(|| &self.numbers.get()[begin..begin + self.len])
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &[f64]> {
        (0..self.count).filter_map(|column| self.get(column))
    }

    pub(crate) fn iter_mut(&mut self) -> impl Iterator<Item = &mut [f64]> {
        let (stride, len) = (self.stride, self.len);
        let columns = self.numbers.get_mut()[..self.count * stride].chunks_mut(stride.max(1));
        columns.map(move |column| &mut column[..len])
    }
}

/// Many numbers.
#[derive(Debug)]
enum Numbers {
    Heap(Vec<f64>),
    /// In large pages where the system has some: a hundred megabytes in small ones take a fifth of the time
    /// of a run, as each page is made when it is first touched.
    #[cfg(target_os = "linux")]
    Pages(MmapMut),
}

impl Numbers {
    fn zeros(count: usize) -> Self {
        #[cfg(target_os = "linux")]
        if let Some(pages) = pages(count) {
            return Self::Pages(pages);
        }
        Self::Heap(vec![0.0; count])
    }

    fn get(&self) -> &[f64] {
        match self {
            Self::Heap(numbers) => numbers,
            #[cfg(target_os = "linux")]
            Self::Pages(pages) => bytemuck::cast_slice(pages),
        }
    }

    fn get_mut(&mut self) -> &mut [f64] {
        match self {
            Self::Heap(numbers) => numbers,
            #[cfg(target_os = "linux")]
            Self::Pages(pages) => bytemuck::cast_slice_mut(pages),
        }
    }
}

impl Clone for Numbers {
    fn clone(&self) -> Self {
        let mut other = Self::zeros(self.get().len());
        other.get_mut().copy_from_slice(self.get());
        other
    }
}

/// Memory of its own for so many numbers, and for more where these do not fill the last large page; `None`
/// where they would not fill one, or there is none.
#[cfg(target_os = "linux")]
fn pages(count: usize) -> Option<MmapMut> {
    /// (byte)
    const LARGE: usize = 1 << 21;
    let bytes = count.checked_mul(size_of::<f64>()).filter(|bytes| *bytes >= LARGE)?;
    let pages = MmapMut::map_anon(bytes.checked_next_multiple_of(LARGE)?).ok()?;
    // Where the system has no large pages, small ones do.
    let _ = pages.advise(Advice::HugePage);
    Some(pages)
}

#[cfg(test)]
mod tests {
    use super::Columns;

    /// On the heap and in pages.
    #[test]
    fn columns_lie_apart_and_can_be_shortened() {
        for len in [5, 1 << 20] {
            let mut columns = Columns::new(3, len);
            for (number, column) in (0_u8..).zip(columns.iter_mut()) {
                assert_eq!(column.len(), len);
                assert!(column.iter().all(|value| *value == 0.0));
                column.fill(f64::from(number));
            }
            columns.truncate(4);
            let copy = columns.clone();
            for columns in [&columns, &copy] {
                assert_eq!(columns.iter().collect::<Vec<_>>(), [[0.0; 4], [1.0; 4], [2.0; 4]]);
                assert_eq!((columns.get(2), columns.get(3)), (Some(&[2.0; 4][..]), None));
            }
        }
        assert_eq!(Columns::new(0, 5).iter().count() + Columns::new(0, 5).iter_mut().count(), 0);
    }
}
