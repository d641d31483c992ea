//! The impact: the content of the table `[impact]`.

use pim_core::{InvalidInput, Law, Real, RestitutionCurve, Tangential, VaryingLaw};

use crate::axes::Axes;
use crate::choices;
use crate::quantity::Quantity;
use crate::walk::Walk;

/// How the two vehicles met.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenImpact<T = f64> {
    /// (rad) Γ, scene angle of the normal of the crush plane.
    pub crush_plane: Quantity<T>,
    /// `law` and its keys.
    pub law: ImpactLaw<T>,
}

/// The impact law that `law` names; [`pim_core::Law`] describes the condition and the assumptions of each.
#[derive(Clone, Debug, PartialEq)]
pub enum ImpactLaw<T = f64> {
    /// `law = "brach"`, or no `law`.
    Brach {
        /// Normal to the crush plane.
        restitution: Restitution<T>,
        /// Along the crush plane.
        tangential: BrachTangential<T>,
        /// (–) moment coefficient of restitution, −1 to 1; −1 (no moment impulse) where absent.
        moment_restitution: Option<T>,
    },
    /// `law = "woolley"`.
    Woolley {
        /// (m/s) U_t − u_t of a sideswipe; where absent, a common velocity at C.
        tangential_velocity_change: Option<Quantity<T>>,
    },
    /// `law = "ishikawa"`.
    Ishikawa {
        /// Normal to the crush plane.
        restitution: Restitution<T>,
        /// (–) coefficient of restitution along the crush plane, −1 to 1.
        tangential_restitution: T,
    },
    /// `law = "kudlich-slibar"`.
    KudlichSlibar {
        /// In both directions while friction suffices.
        restitution: Restitution<T>,
        /// (–) largest coefficient of friction, zero or more.
        friction: T,
    },
}

choices! {
    /// An impact law without its coefficients.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub enum LawName {
        /// Brach's law, the default.
        #[default]
        Brach = "brach",
        /// Woolley's.
        Woolley = "woolley",
        /// Ishikawa's.
        Ishikawa = "ishikawa",
        /// Kudlich's and Slibar's.
        KudlichSlibar = "kudlich-slibar",
    }
}

/// What happens along the crush plane under Brach's law. The other laws set their own conditions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BrachTangential<T = f64> {
    /// Sliding ends by separation: the critical impulse ratio.
    Critical,
    /// (–) the impulse ratio μ = P_t/P_n, with its sign.
    Ratio(T),
    /// (–) the fraction of the critical impulse ratio, 0 to 1.
    FractionOfCritical(T),
    /// (–) friction that ends the sliding, or limits the impulse where it cannot; zero or more.
    Friction(T),
}

impl BrachTangential {
    /// The word of each condition that has no number.
    pub const WORDS: [(&str, Self); 1] = [("critical", Self::Critical)];
}

impl<T> From<BrachTangential<T>> for Tangential<T> {
    fn from(tangential: BrachTangential<T>) -> Self {
        match tangential {
            BrachTangential::Critical => Self::Critical,
            BrachTangential::Ratio(mu) => Self::Ratio(mu),
            BrachTangential::FractionOfCritical(share) => Self::FractionOfCritical(share),
            BrachTangential::Friction(mu) => Self::Friction(mu),
        }
    }
}

impl<T: Copy> ImpactLaw<T> {
    /// Which one it is.
    #[must_use]
    pub fn law(&self) -> LawName {
        match self {
            Self::Brach { .. } => LawName::Brach,
            Self::Woolley { .. } => LawName::Woolley,
            Self::Ishikawa { .. } => LawName::Ishikawa,
            Self::KudlichSlibar { .. } => LawName::KudlichSlibar,
        }
    }

    /// The value of `law`, such as `"brach"`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.law().name()
    }

    /// `restitution`; `None` for Woolley's law, which has no such key because e = 0.
    #[must_use]
    pub fn restitution(&self) -> Option<&Restitution<T>> {
        match self {
            Self::Brach { restitution, .. }
            | Self::Ishikawa { restitution, .. }
            | Self::KudlichSlibar { restitution, .. } => Some(restitution),
            Self::Woolley { .. } => None,
        }
    }

    /// (–) the friction limit, if the law has one.
    #[must_use]
    pub fn friction(&self) -> Option<T> {
        match self {
            Self::Brach { tangential: BrachTangential::Friction(friction), .. }
            | Self::KudlichSlibar { friction, .. } => Some(*friction),
            _ => None,
        }
    }
}

impl<T: Copy> ImpactLaw<T> {
    /// The same law with other numbers; `number` is called once for each.
    #[must_use]
    pub fn map<U>(&self, mut number: impl FnMut(T) -> U) -> ImpactLaw<U> {
        match self {
            Self::Brach { restitution, tangential, moment_restitution } => ImpactLaw::Brach {
                restitution: restitution.map(&mut number),
                tangential: match *tangential {
                    BrachTangential::Critical => BrachTangential::Critical,
                    BrachTangential::Ratio(mu) => BrachTangential::Ratio(number(mu)),
                    BrachTangential::FractionOfCritical(f) => BrachTangential::FractionOfCritical(number(f)),
                    BrachTangential::Friction(mu) => BrachTangential::Friction(number(mu)),
                },
                moment_restitution: moment_restitution.map(number),
            },
            Self::Woolley { tangential_velocity_change } => ImpactLaw::Woolley {
                tangential_velocity_change: tangential_velocity_change.map(|change| change.map(number)),
            },
            Self::Ishikawa { restitution, tangential_restitution } => ImpactLaw::Ishikawa {
                restitution: restitution.map(&mut number),
                tangential_restitution: number(*tangential_restitution),
            },
            Self::KudlichSlibar { restitution, friction } => ImpactLaw::KudlichSlibar {
                restitution: restitution.map(&mut number),
                friction: number(*friction),
            },
        }
    }
}

impl<T: Real> ImpactLaw<T> {
    /// The law of the engine, in its axes.
    ///
    /// # Errors
    /// The key of the value that the engine refuses, and the reason.
    pub fn of_engine(&self, axes: Axes) -> Result<VaryingLaw<T>, (&'static str, InvalidInput)> {
        let curve = match self.restitution().and_then(Restitution::points) {
            Some(points) => Some(RestitutionCurve::new(points).map_err(|why| ("impact.restitution", why))?),
            None => None,
        };
        let e = |restitution: &Restitution<T>| match restitution {
            Restitution::Constant(e) => *e,
            Restitution::OfClosingSpeed { values, .. } => values.first().copied().unwrap_or(T::ZERO),
        };
        let law = match self {
            Self::Brach { restitution, tangential, moment_restitution } => {
                let tangential = match *tangential {
                    // P_t changes its sign with t; a share of μ_c and a friction limit have none.
                    BrachTangential::Ratio(mu) => Tangential::Ratio(axes.lateral(mu)),
                    other => other.into(),
                };
                Law::new(e(restitution), tangential).and_then(|law| match moment_restitution {
                    Some(e_m) => law.with_moment_restitution(*e_m),
                    None => Ok(law),
                })
            }
            Self::Woolley { tangential_velocity_change: None } => Ok(Law::woolley()),
            Self::Woolley { tangential_velocity_change: Some(change) } => {
                Law::woolley_sideswipe(axes.lateral(change.si()))
            }
            Self::Ishikawa { restitution, tangential_restitution } => {
                Law::ishikawa(e(restitution), *tangential_restitution)
            }
            Self::KudlichSlibar { restitution, friction } => Law::kudlich_slibar(e(restitution), *friction),
        };
        let law = law.map_err(|why| ("impact", why))?;
        Ok(match curve {
            Some(curve) => law.with_restitution_curve(curve),
            None => law.into(),
        })
    }
}

/// How a coefficient of restitution is given.
#[derive(Clone, Debug, PartialEq)]
pub enum Restitution<T = f64> {
    /// (–) one value for every closing speed, 0 to 1.
    Constant(T),
    /// Keys `speeds`, `values`: linear between the points, constant outside of them.
    OfClosingSpeed {
        /// (m/s) closing speeds at C along the normal, ascending from zero or more; at least one.
        speeds: Vec<Quantity<T>>,
        /// (–) coefficients of restitution, 0 to 1, as many as speeds.
        values: Vec<T>,
    },
}

impl<T: Copy> Restitution<T> {
    fn map<U>(&self, mut number: impl FnMut(T) -> U) -> Restitution<U> {
        match self {
            Self::Constant(e) => Restitution::Constant(number(*e)),
            Self::OfClosingSpeed { speeds, values } => Restitution::OfClosingSpeed {
                speeds: speeds.iter().map(|speed| speed.map(&mut number)).collect(),
                values: values.iter().map(|e| number(*e)).collect(),
            },
        }
    }
}

impl<T: Real> Restitution<T> {
    /// The points (closing speed in m/s, coefficient of restitution) of a curve, `None` for a constant.
    fn points(&self) -> Option<Vec<(T, T)>> {
        match self {
            Self::Constant(_) => None,
            Self::OfClosingSpeed { speeds, values } => {
                Some(speeds.iter().map(Quantity::si).zip(values.iter().copied()).collect())
            }
        }
    }
}

impl<U> Walk<'_, U> {
    pub(crate) fn impact(&mut self, impact: &GivenImpact, law_left_out: bool) -> GivenImpact<U> {
        let crush_plane = self.quantity(&"impact.crush_plane", &impact.crush_plane);
        self.default(&"impact.law", &LawName::WORDS, impact.law.law(), law_left_out);
        let law = match &impact.law {
            ImpactLaw::Brach { restitution, tangential, moment_restitution } => ImpactLaw::Brach {
                restitution: self.restitution(restitution),
                tangential: self.tangential(*tangential),
                moment_restitution: moment_restitution
                    .map(|e_m| self.number(&"impact.moment_restitution", e_m)),
            },
            ImpactLaw::Woolley { tangential_velocity_change } => ImpactLaw::Woolley {
                tangential_velocity_change: self
                    .maybe(&"impact.tangential_velocity_change", tangential_velocity_change.as_ref()),
            },
            ImpactLaw::Ishikawa { restitution, tangential_restitution } => ImpactLaw::Ishikawa {
                restitution: self.restitution(restitution),
                tangential_restitution: self
                    .number(&"impact.tangential_restitution", *tangential_restitution),
            },
            ImpactLaw::KudlichSlibar { restitution, friction } => ImpactLaw::KudlichSlibar {
                restitution: self.restitution(restitution),
                friction: self.number(&"impact.friction", *friction),
            },
        };
        GivenImpact { crush_plane, law }
    }

    fn restitution(&mut self, restitution: &Restitution) -> Restitution<U> {
        match restitution {
            Restitution::Constant(e) => Restitution::Constant(self.number(&"impact.restitution", *e)),
            Restitution::OfClosingSpeed { speeds, values } => {
                let speeds = self.list(&"impact.restitution.speeds", speeds);
                let path = "impact.restitution.values";
                let values = self.each(&path, values, |walk, path, e| walk.number(path, *e));
                Restitution::OfClosingSpeed { speeds, values }
            }
        }
    }

    fn tangential(&mut self, tangential: BrachTangential) -> BrachTangential<U> {
        match tangential {
            BrachTangential::Critical => {
                self.choice(&"impact.tangential", &BrachTangential::WORDS, BrachTangential::Critical);
                BrachTangential::Critical
            }
            BrachTangential::Ratio(mu) => BrachTangential::Ratio(self.number(&"impact.tangential.ratio", mu)),
            BrachTangential::FractionOfCritical(f) => {
                BrachTangential::FractionOfCritical(self.number(&"impact.tangential.fraction", f))
            }
            BrachTangential::Friction(mu) => {
                BrachTangential::Friction(self.number(&"impact.tangential.friction", mu))
            }
        }
    }
}
