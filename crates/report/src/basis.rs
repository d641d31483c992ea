//! The energy basis in words: what is held equal to the crush energy.

use case::Basis;

use crate::units::number;

/// `50 %`, of the work of the tangential impulse; `None` where that has no part in the crush.
fn percent(basis: Basis) -> Option<String> {
    let Basis::TangentialShare(share) = basis else { return None };
    Some(format!("{} %", short(100.0 * share, 2)))
}

/// Rounded, without the zeros at its end.
fn short(value: f64, decimals: usize) -> String {
    number(value, decimals).trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The basis and, of a share of the tangential work, how large that is: `tangential-share, 50 %`.
pub(crate) fn named(basis: Basis) -> String {
    match percent(basis) {
        Some(percent) => format!("{}, {percent}", basis.name()),
        None => basis.name().to_owned(),
    }
}

/// The work that is held against the crush energy, as the subject of a sentence.
pub(crate) fn work(basis: Basis) -> String {
    match percent(basis) {
        Some(percent) => {
            format!("the work of the normal impulse, with {percent} of that of the tangential impulse,")
        }
        None => "the work of the normal impulse".to_owned(),
    }
}

/// What the crush takes of the tangential work: `50 % of the tangential work`.
pub(crate) fn share(basis: Basis) -> Option<String> {
    percent(basis).map(|percent| format!("{percent} of the tangential work"))
}

/// The symbol of that work, as `W_n + λ W_t` with the number of λ, and subscripts as the caller writes them.
pub(crate) fn symbol(basis: Basis, [normal, tangential]: [&str; 2]) -> String {
    match basis {
        Basis::Dissipated | Basis::Absorbed => normal.to_owned(),
        Basis::TangentialShare(share) => format!("{normal} + {} {tangential}", short(share, 4)),
    }
}
