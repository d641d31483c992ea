//! The energy basis in words: the work that equals the crush energy.

use case::Basis;

use crate::units::number;

/// `50 %` for a share of 0.5.
fn percent(share: f64) -> String {
    format!("{} %", short(100.0 * share, 2))
}

/// Rounded, without trailing zeros.
pub(crate) fn short(value: f64, decimals: usize) -> String {
    number(value, decimals).trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The basis and, for a share of the tangential work, its size: `tangential-share, 50 %`.
pub(crate) fn named(basis: Basis) -> String {
    match basis {
        Basis::TangentialShare(share) => format!("{}, {}", basis.name(), percent(share)),
        Basis::Dissipated | Basis::Absorbed => basis.name().to_owned(),
    }
}

/// The work that is compared with the crush energy.
pub(crate) fn work(basis: Basis) -> String {
    match basis {
        Basis::TangentialShare(share) => {
            format!(
                "the work of the normal impulse plus {} of that of the tangential impulse",
                percent(share)
            )
        }
        Basis::Dissipated | Basis::Absorbed => "the work of the normal impulse".to_owned(),
    }
}

/// The same for the share λ alone.
pub(crate) fn work_of_share(share: f64) -> String {
    work(if share == 0.0 { Basis::Dissipated } else { Basis::TangentialShare(share) })
}

/// The part of the tangential work that the crush absorbs: `50 % of the tangential work`.
pub(crate) fn share(basis: Basis) -> Option<String> {
    match basis {
        Basis::TangentialShare(share) => Some(format!("{} of the tangential work", percent(share))),
        Basis::Dissipated | Basis::Absorbed => None,
    }
}

/// The symbol of that work, as `W_n + λ W_t` with the number of λ, and subscripts as the caller writes them.
pub(crate) fn symbol(basis: Basis, [normal, tangential]: [&str; 2]) -> String {
    match basis {
        Basis::Dissipated | Basis::Absorbed => normal.to_owned(),
        Basis::TangentialShare(share) => format!("{normal} + {} {tangential}", short(share, 4)),
    }
}
