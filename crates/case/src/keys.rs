//! The keys of a case and their contents, for programs that present them in another form than text.

use crate::schema::{KeyInfo, RANGE, RANGE_OF_LIST, SOURCED_RANGE, Schema, TOP};

/// The keys of a case, tables within tables.
///
/// ```
/// let vehicle = case::key_tree().keys.iter().find(|key| key.name == "vehicle1").ok_or("a case has vehicles")?;
/// assert!(vehicle.form.keys().iter().any(|key| key.name == "mass"));
/// # Ok::<(), &str>(())
/// ```
#[must_use]
pub fn key_tree() -> &'static Schema {
    &TOP
}

/// The keys of a range, in place of a number: `value`, `sd`, `low`, …
#[must_use]
pub fn range_keys() -> &'static [KeyInfo] {
    RANGE.keys
}

/// The keys of a range with its source: those of [`range_keys`] and `source`.
#[must_use]
pub fn sourced_range_keys() -> &'static [KeyInfo] {
    SOURCED_RANGE.keys
}

/// The keys of a range of several numbers: `values`, `sd`, `within` and `confidence`.
#[must_use]
pub fn list_range_keys() -> &'static [KeyInfo] {
    RANGE_OF_LIST.keys
}

/// A step of the path to a key, through the tables of a case.
#[derive(Clone, Debug)]
pub(crate) struct Way {
    /// `None` for an element.
    pub(crate) name: Option<&'static str>,
    /// The index of an element, from 0.
    pub(crate) element: usize,
    /// The position among the keys of its table or the elements of its list.
    pub(crate) rank: usize,
    /// Whether it is a table that has a header.
    pub(crate) has_header: bool,
}

/// The steps to a key such as `vehicle1.crush.depths[2]`; `None` if no case has it.
pub(crate) fn way(key: &str) -> Option<Vec<Way>> {
    let mut way = Vec::new();
    let mut tables: Vec<&'static Schema> = vec![&TOP];
    // An empty key is the file.
    for part in key.split('.').filter(|_| !key.is_empty()) {
        let (name, elements) = part.split_at(part.find('[').unwrap_or(part.len()));
        let (rank, key) =
            tables.iter().flat_map(|table| table.keys).enumerate().find(|(_, key)| key.name == name)?;
        way.push(Way { name: Some(key.name), element: 0, rank, has_header: key.has_header() });
        for element in elements.split_terminator(']') {
            let number: usize = element.strip_prefix('[')?.parse().ok()?;
            let element = number.checked_sub(1)?;
            way.push(Way { name: None, element, rank: element, has_header: false });
        }
        tables = key.form.ranges().iter().copied().chain(key.form.table()).collect();
    }
    Some(way)
}
