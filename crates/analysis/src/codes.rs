//! The codes by which JSON, text and `explain` name the variants of an enum.

/// One row for each variant of an enum: `CODES`, all codes in the order of the rows, and `code`, that of a
/// value. A variant without a row does not compile.
macro_rules! codes {
    ($($variant:pat => $code:literal,)*) => {
        /// All codes.
        pub const CODES: [&'static str; [$($code),*].len()] = [$($code),*];

        /// The code that names it in JSON and text.
        #[must_use]
        pub fn code(&self) -> &'static str {
            match self {
                $($variant => $code,)*
            }
        }
    };
}

pub(crate) use codes;
