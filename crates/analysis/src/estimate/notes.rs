//! Notes on how the evidence was used.

/// Data of the case that the estimate does not use.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unused {
    /// Its key.
    pub key: String,
    /// The reason.
    pub reason: UnusedReason,
}

/// Why a value is not used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum UnusedReason {
    /// The speed is to be found.
    Sought,
    /// A crush that was not measured.
    Inferred,
    /// A crush of both vehicles that absorbed no energy.
    NoEnergy,
    /// The energy that an object absorbed, if the crush of the vehicle that struck it is unknown.
    NoCrush,
    /// A PDOF that follows from that of the other vehicle: both are one observation.
    OtherPdof,
    /// One of two PDOFs that cannot be of one force.
    PdofsDiffer,
    /// A rest or points of a vehicle that cannot be followed there: friction or drag is missing.
    NotFollowed,
    /// A rest or points of vehicles that left as one wreck: each is followed alone.
    Wreck,
    /// The direction of a vehicle that stood after the impact.
    NoDirection,
    /// A coefficient of the impact of vehicles that left as one wreck.
    OneWreck,
    /// That the vehicles left as one wreck, if the law is not Brach's.
    OtherLaw,
    /// That the vehicles left as one wreck, if the law has a moment.
    WithMoment,
    /// A pulse without an impact.
    NoImpact,
    /// A recorder's ΔV of which only the lateral part is known.
    OnlyLateral,
    /// One of several records, which is probably not of this impact.
    OtherImpact,
    /// The table of a vehicle that stood or crawled.
    StoodByRecord,
    /// Phases that lead from a known speed to one at the impact.
    Phases,
    /// How a vehicle rolls, or the error of a rest or point, if no vehicle is followed to one.
    NoPlace,
    /// The error of a heading at rest, if no vehicle is followed to its rest.
    NoRest,
    /// The error of crush energies, of which none is evidence.
    NoCrushEnergy,
    /// The errors of a table of speeds that the recorder does not give.
    NoSpeeds,
    /// The probability that a vehicle stood, if none may have.
    NoneStood,
    /// The median severity of a prior that has none.
    FlatPrior,
}

/// Notes on the evidence.
#[derive(Debug, Default)]
pub(super) struct Notes {
    /// The keys of evidence with a default error, because the case gives none; each once.
    pub(super) default_errors: Vec<String>,
    pub(super) unused: Vec<Unused>,
}

impl Notes {
    /// Notes that this has its default error, unless the case gives one.
    pub(super) fn default_error(&mut self, is_default: bool, key: String) {
        if is_default && !self.default_errors.contains(&key) {
            self.default_errors.push(key);
        }
    }
}
