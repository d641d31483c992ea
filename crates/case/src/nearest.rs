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

/// The number of slips by which a candidate differs from `word`, if they are few enough.
fn slips(word: &str, candidate: &str) -> Option<usize> {
    let wanted = plain(word);
    let slips = strsim::damerau_levenshtein(&wanted, &plain(candidate));
    (slips <= allowance(&wanted)).then_some(slips)
}

/// The candidate nearest to `word`, the first of equals, if it is near enough to be suggested; else the only
/// one that has all of its words, such as `cg_to_front_axle` for `front_axle`.
pub(crate) fn nearest<'a>(word: &str, candidates: impl Iterator<Item = &'a str> + Clone) -> Option<&'a str> {
    if word.len() > LONGEST {
        return None;
    }
    let misspelt = candidates.clone().filter_map(|candidate| Some((slips(word, candidate)?, candidate)));
    if let Some((_, candidate)) = misspelt.min_by_key(|(slips, _)| *slips) {
        return Some(candidate);
    }
    // Not the other way round: `speed_after` is not `speed`.
    let wanted = plain(word);
    let has_all = |candidate: &&str| {
        let known = plain(candidate);
        wanted.len() > 1 && wanted.split('_').all(|part| known.split('_').any(|of| of == part))
    };
    let mut with_all = candidates.filter(has_all);
    with_all.next().filter(|_| with_all.next().is_none())
}

/// All candidates that are near enough to be suggested, the nearest first.
///
/// ```
/// assert_eq!(case::nearest_names("restituton", ["restitution", "ratio"]), ["restitution"]);
/// ```
#[must_use]
pub fn nearest_names<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    if word.len() > LONGEST {
        return Vec::new();
    }
    let near = candidates.into_iter().filter_map(|candidate| Some((slips(word, candidate)?, candidate)));
    let mut near: Vec<(usize, &str)> = near.collect();
    near.sort_by_key(|(slips, _)| *slips);
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

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn a_key_is_found_by_its_slips_or_by_its_words() {
        let keys = ["speed", "track", "cg_to_front", "cg_to_front_axle", "yaw_rate", "yaw_radius"];
        let of = |word| nearest(word, keys.into_iter());
        assert_eq!(of("trak"), Some("track"));
        assert_eq!(of("Front-Axle"), Some("cg_to_front_axle"));
        assert_eq!(of("rate"), Some("yaw_rate"));
        assert_eq!(of("yaw"), None, "two have it");
        assert_eq!(of("speed_after"), None, "another speed");
    }
}
