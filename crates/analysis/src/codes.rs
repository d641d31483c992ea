//! The codes by which JSON, text and `explain` name the variants of an enum.

/// Takes one row for each variant of an enum, with `{ vehicle }` if it concerns only one vehicle, and makes
/// `CODES` (all codes in the order of the rows), `code` (the code of a value) and `vehicle` (the vehicle that
/// it concerns). A variant without a row does not compile.
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
