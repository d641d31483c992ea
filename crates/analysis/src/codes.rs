//! The codes by which JSON, text and `explain` name the variants of an enum.

/// One row for each variant of an enum, with `{ vehicle }` where it concerns one vehicle alone: `CODES`, all
/// codes in the order of the rows, `code`, that of a value, and `vehicle`, which it concerns. A variant
/// without a row does not compile.
macro_rules! codes {
    ($($variant:ident $({ $vehicle:ident })? => $code:literal,)*) => {
        /// All codes.
        pub const CODES: [&'static str; [$($code),*].len()] = [$($code),*];

        /// The code that names it in JSON and text.
        #[must_use]
        pub fn code(&self) -> &'static str {
            match self {
                $(Self::$variant { .. } => $code,)*
            }
        }

        /// The vehicle, if it concerns only one.
        #[must_use]
        pub fn vehicle(&self) -> Option<VehicleId> {
            match self {
                $(Self::$variant { $($vehicle,)? .. } => codes!(@ $($vehicle)?),)*
            }
        }
    };
    (@) => { None };
    (@ $vehicle:ident) => { Some(*$vehicle) };
}

pub(crate) use codes;
