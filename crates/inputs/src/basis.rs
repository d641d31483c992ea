//! The energy that the crush energy has to equal: `energy_basis` of `[reconstruct]`.

use crash3::EnergyBasis;
use pim_core::Real;

use crate::walk::Walk;
use crate::words::word;

/// `reconstruct.energy_basis`, except a share of the tangential work, which has a number.
pub const ENERGY_BASES: [(&str, Basis); 2] =
    [("dissipated", Basis::Dissipated), ("absorbed", Basis::Absorbed)];

/// The energy that the crush energy of both vehicles has to equal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Basis<T = f64> {
    /// The work of the normal impulse that the impact dissipates, W_n: the method of SAE 980025.
    #[default]
    Dissipated,
    /// The work up to maximum engagement; restitution returns part of it.
    Absorbed,
    /// (–) λ, from 0 to 1: W_n + λ W_t, with a share of the work of the tangential impulse.
    TangentialShare(T),
}

impl<T: Copy> Basis<T> {
    /// The same with another number.
    #[must_use]
    pub fn map<U>(self, number: impl FnOnce(T) -> U) -> Basis<U> {
        match self {
            Self::Dissipated => Basis::Dissipated,
            Self::Absorbed => Basis::Absorbed,
            Self::TangentialShare(share) => Basis::TangentialShare(number(share)),
        }
    }

    /// Its name in one word. That of a share, which a case gives as a number, is `tangential-share`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Dissipated => word(&ENERGY_BASES, &Basis::Dissipated),
            Self::Absorbed => word(&ENERGY_BASES, &Basis::Absorbed),
            Self::TangentialShare(_) => "tangential-share",
        }
    }

    /// Whether the crush energy is the energy dissipated or absorbed by the crush. A share of the tangential
    /// work is dissipated.
    #[must_use]
    pub fn energy(self) -> EnergyBasis {
        match self {
            Self::Absorbed => EnergyBasis::Absorbed,
            Self::Dissipated | Self::TangentialShare(_) => EnergyBasis::Dissipated,
        }
    }
}

impl<T: Real> Basis<T> {
    /// (–) λ, the share of the tangential work in the crush energy.
    #[inline(always)]
    #[must_use]
    pub fn tangential_share(self) -> T {
        match self {
            Self::Dissipated | Self::Absorbed => T::ZERO,
            Self::TangentialShare(share) => share,
        }
    }

    /// (J) the work that is compared with the crush energy, from the works (J) of both impulses.
    #[must_use]
    pub fn taken_by_crush(self, normal_work: T, tangential_work: T) -> T {
        let share = self.tangential_share();
        if share.is_constant_zero() {
            return normal_work;
        }
        // W_n + λ W_t
        normal_work + share * tangential_work
    }
}

impl<U> Walk<'_, U> {
    pub(crate) fn basis(&mut self, basis: Basis, is_left_out: bool) -> Basis<U> {
        let mut word = || self.default(&"reconstruct.energy_basis", &ENERGY_BASES, basis, is_left_out);
        match basis {
            Basis::Dissipated => {
                word();
                Basis::Dissipated
            }
            Basis::Absorbed => {
                word();
                Basis::Absorbed
            }
            Basis::TangentialShare(share) => {
                Basis::TangentialShare(self.number(&"reconstruct.energy_basis.tangential_share", share))
            }
        }
    }
}
