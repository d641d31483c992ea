//! The law without a limit that acts in a piece.

use pim_core::Law;

/// The law without a limit that holds in a piece.
#[derive(Clone, Copy)]
pub(crate) enum Branch {
    /// The law itself, which has no limit.
    Own,
    /// Friction suffices for the law's condition on U_t.
    Full,
    /// The impulse ratio is the friction limit, against the sliding.
    Ratio(f64),
}

impl Branch {
    #[inline(always)]
    pub(crate) fn law(self, law: &Law) -> Law {
        match self {
            Self::Own => *law,
            Self::Full => law.without_limit(),
            Self::Ratio(mu) => law.with_ratio(mu),
        }
    }
}
