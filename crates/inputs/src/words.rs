//! The words of each choice, in one table shared by readers, writers and lists. Enums of this crate have
//! theirs as `WORDS`.

use crash3::{ObliqueCorrection, Side};
use pim_core::VehicleId;

/// `crush.side`.
pub const SIDES: [(&str, Side); 4] =
    [("front", Side::Front), ("rear", Side::Rear), ("left", Side::Left), ("right", Side::Right)];

/// `crush` of a vehicle without damage.
pub const UNDAMAGED: &str = "none";

/// The key `stiffness` for that of the cars on the road.
pub const FLEET_STIFFNESS: &str = "fleet";

/// `crush.oblique`, except the limit by friction, which has a number.
pub const OBLIQUE_CORRECTIONS: [(&str, ObliqueCorrection); 4] = [
    ("capped", ObliqueCorrection::Capped),
    ("uncapped", ObliqueCorrection::Uncapped),
    ("none", ObliqueCorrection::None),
    ("secant", ObliqueCorrection::Secant),
];

/// `reconstruct.find`.
pub const UNKNOWNS: [(&str, VehicleId); 2] =
    [("vehicle1.speed", VehicleId::One), ("vehicle2.speed", VehicleId::Two)];

/// An enum of choices, each with its word. `ALL` are the choices in their order, `WORDS` are the same with
/// their words, and `name` is the word of a value.
///
/// ```
/// inputs::choices! {
///     /// A way to travel.
///     #[derive(Clone, Copy, Debug, PartialEq)]
///     pub enum Way {
///         /// Along the road.
///         Along = "along",
///         /// Across it.
///         Across = "across",
///     }
/// }
/// assert_eq!((Way::Across.name(), Way::WORDS[0]), ("across", ("along", Way::Along)));
/// ```
#[macro_export]
macro_rules! choices {
    (
        $(#[$of_enum:meta])*
        pub enum $name:ident { $($(#[$of_choice:meta])* $choice:ident = $word:literal),+ $(,)? }
    ) => {
        $(#[$of_enum])*
        pub enum $name { $($(#[$of_choice])* $choice),+ }

        impl $name {
            /// All of them, in their order.
            pub const ALL: [Self; [$($word),+].len()] = [$(Self::$choice),+];

            /// Each with its word.
            pub const WORDS: [(&'static str, Self); [$($word),+].len()] = [$(($word, Self::$choice)),+];

            /// Its word.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$choice => $word),+
                }
            }
        }
    };
}

/// Only the words of a table.
#[must_use]
pub const fn words_of<T, const N: usize>(table: &[(&'static str, T); N]) -> [&'static str; N] {
    let mut words = [""; N];
    let mut i = 0;
    while i < N {
        words[i] = table[i].0;
        i += 1;
    }
    words
}

/// The word of a choice; empty if the table does not have it, as for a condition that has a number.
///
/// ```
/// use crash3::Side;
/// use inputs::{SIDES, word};
///
/// assert_eq!(word(&SIDES, &Side::Rear), "rear");
/// ```
#[must_use]
pub fn word<T: PartialEq>(table: &[(&'static str, T)], choice: &T) -> &'static str {
    table.iter().find(|(_, of_table)| of_table == choice).map_or("", |(word, _)| word)
}

#[cfg(test)]
mod tests {
    use crash3::Side;
    use pim_core::VehicleId;

    use super::{SIDES, UNKNOWNS, word};
    use crate::axes::Axes;
    use crate::basis::{Basis, ENERGY_BASES};
    use crate::crush::Fit;
    use crate::impact::LawName;
    use crate::vehicle::VehicleKind;

    /// The index of a choice among all of its kind: a new one does not compile until it has one here.
    trait Place {
        fn place(self) -> usize;
    }

    macro_rules! places {
        ($type:ty: $($variant:ident),+) => {
            impl Place for $type {
                fn place(self) -> usize {
                    [$(matches!(self, Self::$variant)),+].iter().position(|is| *is).unwrap_or(usize::MAX)
                        + match self { $(Self::$variant => 0),+ }
                }
            }
        };
    }

    places!(Side: Front, Rear, Left, Right);
    places!(VehicleId: One, Two);
    places!(Axes: ZUp, ZDown);
    places!(Fit: Exact, Mean);
    places!(VehicleKind: Car, HeavyTruck, Trailer, Motorcycle);
    places!(LawName: Brach, Woolley, Ishikawa, KudlichSlibar);

    impl Place for Basis {
        fn place(self) -> usize {
            match self {
                Self::Dissipated => 0,
                Self::Absorbed => 1,
                // It has a number and no word.
                Self::TangentialShare(_) => usize::MAX,
            }
        }
    }

    fn assert_complete<T: Place + PartialEq + Copy>(table: &[(&'static str, T)]) {
        for (index, (name, choice)) in table.iter().enumerate() {
            assert_eq!(choice.place(), index, "{name}");
            assert_eq!(word(table, choice), *name);
        }
    }

    /// Every choice has one word, in the order of its table.
    #[test]
    fn every_choice_has_its_word() {
        assert_complete(&SIDES);
        assert_complete(&UNKNOWNS);
        assert_complete(&ENERGY_BASES);
        assert_complete(&Axes::WORDS);
        assert_complete(&Fit::WORDS);
        assert_complete(&VehicleKind::WORDS);
        assert_complete(&LawName::WORDS);
    }
}
