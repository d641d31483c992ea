//! A finished analysis in the axes of its case.

use inputs::Axes;
use pim_core::{ImpactError, Switch};

use crate::{Analysis, Drive, Failure, Impact, JumpSide, Warning};

impl Analysis {
    /// Converts the impact, approach line, contact points, centroids and warnings to the given axes, for
    /// display. The analysis itself is always in the axes of the engine, regardless of the axes of the case.
    /// A [`DamagedFace`](crash3::DamagedFace) is not converted.
    #[must_use]
    pub fn in_axes(&self, axes: Axes) -> Self {
        let mut seen = self.clone();
        if axes == Axes::ZUp {
            return seen;
        }
        if let Some(impact) = &mut seen.impact {
            *impact = impact.mirrored();
        }
        if let Some(found) = &mut seen.found {
            found.line = found.line.mirrored();
        }
        for vehicle in &mut seen.vehicles {
            let centroid = vehicle.damage.as_mut().and_then(|damage| damage.centroid.as_mut());
            for [_, y] in vehicle.subject.contact.as_mut().into_iter().chain(centroid) {
                *y = axes.lateral(*y);
            }
        }
        for warning in &mut seen.warnings {
            *warning = warning.in_axes(axes);
        }
        seen
    }
}

impl Warning {
    /// Returns the warning with its numbers in the given axes.
    #[must_use]
    pub fn in_axes(&self, axes: Axes) -> Self {
        let mut seen = self.clone();
        if let Self::DamageCentroid { point: [_, lateral], .. }
        | Self::RotationOpposes { turned: lateral, .. } = &mut seen
        {
            *lateral = axes.lateral(*lateral);
        }
        if let Self::LargeImpulseRatio { impulse_ratio, .. } = &mut seen {
            *impulse_ratio = axes.lateral(*impulse_ratio);
        }
        if let Self::SlidingDriven { sliding, cause, .. } = &mut seen {
            *sliding = axes.lateral(*sliding);
            *cause = cause.in_axes(axes);
        }
        if let Self::NearJump { border, given, sides } = &mut seen {
            // A friction limit has no direction.
            if let Switch::Direction(sliding) = border {
                *sliding = axes.lateral(*sliding);
                *given = axes.lateral(*given);
            }
            *sides = sides.map(|side| side.in_axes(axes));
        }
        seen
    }
}

impl Drive {
    fn in_axes(self, axes: Axes) -> Self {
        let turned = |value: f64| axes.lateral(value);
        match self {
            Self::RatioAlong { impulse_ratio } => Self::RatioAlong { impulse_ratio: turned(impulse_ratio) },
            Self::RatioWithoutSliding { impulse_ratio } => {
                Self::RatioWithoutSliding { impulse_ratio: turned(impulse_ratio) }
            }
            Self::RatioBeyond { impulse_ratio, critical } => {
                Self::RatioBeyond { impulse_ratio: turned(impulse_ratio), critical: critical.map(turned) }
            }
            Self::Change { change } => Self::Change { change: turned(change) },
            Self::Coupling => Self::Coupling,
        }
    }
}

impl JumpSide {
    fn in_axes(self, axes: Axes) -> Self {
        let turned = |value: Option<f64>| value.map(|value| axes.lateral(value));
        Self { moment: turned(self.moment), yaw_rates: self.yaw_rates.map(turned), ..self }
    }
}

impl Impact {
    fn mirrored(&self) -> Self {
        Self {
            contact: self.contact.mirrored(),
            given_law: self.given_law.mirrored(),
            law: self.law.mirrored(),
            outcome: self.outcome.mirrored(),
            pdof: self.pdof,
        }
    }
}

impl Failure {
    /// Returns the refusal with its numbers in the given axes.
    pub(crate) fn in_axes(self, axes: Axes) -> Self {
        match (axes, self) {
            (Axes::ZDown, Self::Reconcile(refusal)) => Self::Reconcile(refusal.mirrored()),
            (Axes::ZDown, Self::Impact(refusal)) => Self::Impact(refusal.mirrored()),
            (Axes::ZDown, Self::NotReached { vehicle, energy, nearest }) => {
                Self::NotReached { vehicle, energy, nearest: nearest.map_err(ImpactError::mirrored) }
            }
            (_, failure) => failure,
        }
    }
}
