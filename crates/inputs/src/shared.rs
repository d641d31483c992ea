//! The errors that several numbers of a case share, applied to these numbers.

use pim_core::Real;

use crate::case::Case;
use crate::range::Spread;
use crate::uncertain::list_of;
use crate::walk::Origin;

/// The effects of shared errors on the numbers of a case.
#[derive(Clone, Debug, Default)]
pub struct SharedEffects {
    effects: Vec<Effect>,
}

/// The effect of one error on one number, by their indices among [`Case::variables`].
#[derive(Clone, Copy, Debug)]
struct Effect {
    error: usize,
    number: usize,
    /// (1/unit) one unit of an added error, in the unit of the number; `None` for an error that multiplies.
    added: Option<f64>,
    /// Whether the number is a depth, which is zero or more.
    is_depth: bool,
}

impl SharedEffects {
    /// The effects of the errors of a case.
    #[must_use]
    pub fn of(case: &Case) -> Self {
        if case.uncertainty.shared.is_empty() {
            return Self::default();
        }
        let variables = case.variables();
        let mut effects = Vec::new();
        for (place, variable) in variables.iter().enumerate() {
            let Origin::Shared(index) = variable.origin else { continue };
            let Some(error) = case.uncertainty.shared.get(index) else { continue };
            let is_added = matches!(error.size, Spread::Normal { .. });
            for (number, input) in variables.iter().enumerate().filter(|(_, input)| error.covers(input)) {
                effects.push(Effect {
                    error: place,
                    number,
                    added: is_added.then(|| variable.factor() / input.factor()),
                    is_depth: list_of(&input.path).is_some_and(|list| list.ends_with(".crush.depths")),
                });
            }
        }
        Self { effects }
    }

    /// Whether no number shares an error with another.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.effects.is_empty()
    }

    /// Whether an error covers the number at an index of [`Case::variables`].
    #[must_use]
    pub fn cover(&self, place: usize) -> bool {
        self.effects.iter().any(|effect| effect.number == place)
    }

    /// Applies the errors to the numbers, which are in the order of [`Case::variables`]. A depth that an
    /// error takes below zero is zero.
    pub fn apply<T: Real>(&self, numbers: &mut [T]) {
        for effect in &self.effects {
            let (Some(error), Some(number)) = (numbers.get(effect.error), numbers.get(effect.number)) else {
                continue;
            };
            let changed = match effect.added {
                // C = C₀ + δ
                Some(scale) => *number + *error * scale,
                // C = f C₀
                None => *number * *error,
            };
            let is_below = effect.is_depth && changed.value() < 0.0;
            numbers[effect.number] = if is_below { T::ZERO } else { changed };
        }
    }
}

impl Case {
    /// Whether the case gives an error for a number, or for one of a list: a range, or an error that it
    /// shares with others.
    pub(crate) fn has_error(&self, key: &str) -> bool {
        let is_of = |path: &str| path == key || list_of(path) == Some(key);
        let mut shared = self.uncertainty.shared.iter().flat_map(|error| &error.of);
        self.ranges.iter().any(|range| is_of(&range.path)) || shared.any(|path| is_of(path))
    }

    /// The case with other numbers, in the order of [`variables`](Self::variables), to which the shared
    /// errors are applied.
    #[must_use]
    pub fn with_numbers<T: Real>(&self, mut numbers: Vec<T>) -> Case<T> {
        SharedEffects::of(self).apply(&mut numbers);
        let mut numbers = numbers.into_iter();
        self.map_numbers(|number| numbers.next().unwrap_or(T::from(number)))
    }
}
