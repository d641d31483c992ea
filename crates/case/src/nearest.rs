//! Finds the known word that a misspelt one was meant to be.

use std::borrow::Borrow;

/// (bytes) longer words cannot be misspellings of known ones, and are not compared.
pub(crate) const LONGEST: usize = 64;

/// Maximum number of slips with which a word of this length is still recognised; a single letter resembles
/// everything.
pub(crate) fn allowance(word: &str) -> usize {
    match word.chars().count() {
        0 | 1 => 0,
        2..=4 => 1,
        5..=8 => 2,
        _ => 3,
    }
}

/// The text as compared: capitals, spaces and hyphens do not count as slips.
fn plain(text: &str) -> String {
    text.to_lowercase().replace(['-', ' '], "_")
}

/// The candidate nearest to `word`, the first of equals, if it is near enough to be suggested.
pub(crate) fn nearest<'a>(word: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    if word.len() > LONGEST {
        return None;
    }
    let wanted = plain(word);
    let (distance, candidate) = candidates
        .map(|candidate| (strsim::damerau_levenshtein(&wanted, &plain(candidate)), candidate))
        .min_by_key(|(distance, _)| *distance)?;
    (distance <= allowance(&wanted)).then_some(candidate)
}

/// All candidates that are near enough to be suggested, the nearest first.
///
/// ```
/// assert_eq!(case::nearest_names("restituton", ["restitution", "ratio"]), ["restitution"]);
/// ```
#[must_use]
pub fn nearest_names<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let mut near: Vec<(usize, &str)> = candidates
        .into_iter()
        .filter_map(|candidate| {
            nearest(word, std::iter::once(candidate))?;
            Some((strsim::damerau_levenshtein(&plain(word), &plain(candidate)), candidate))
        })
        .collect();
    near.sort_by_key(|(distance, _)| *distance);
    near.into_iter().map(|(_, candidate)| candidate).collect()
}

/// A list within a sentence: "a", "a and b", "a, b and c".
pub(crate) fn join<S: Borrow<str>>(words: &[S], last: &str) -> String {
    match words {
        [] => String::new(),
        [only] => only.borrow().to_owned(),
        [head @ .., tail] => format!("{} {last} {}", head.join(", "), tail.borrow()),
    }
}
