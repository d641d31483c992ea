//! A finished analysis in the axes of a reader.

use std::ops::Deref;

use inputs::Axes;
use pim_core::{ImpactError, Switch};

use crate::analysis::Analysis;
use crate::failure::Failure;
use crate::impact::Impact;
use crate::warning::{Drive, JumpSide, Warning};

/// A finished analysis as a reader sees it: in the axes of the case, whereas an [`Analysis`] is in those of
/// the engine. Output for people or programs takes this type, so that no number can be written in the wrong
/// axes. Its surface stays in the axes of the engine.
#[derive(Clone, Debug)]
pub struct Seen {
    /// The axes of all its numbers.
    pub axes: Axes,
    answer: Analysis<SeenWarning>,
}

impl Deref for Seen {
    type Target = Analysis<SeenWarning>;

    fn deref(&self) -> &Self::Target {
        &self.answer
    }
}

/// A warning as a reader sees it: its numbers are in the axes of the case.
#[derive(Clone, Debug, PartialEq)]
pub struct SeenWarning {
    warning: Warning,
    axes: Axes,
}

impl SeenWarning {
    /// The warning.
    #[must_use]
    pub fn warning(&self) -> &Warning {
        &self.warning
    }

    /// The axes of its numbers.
    #[must_use]
    pub fn axes(&self) -> Axes {
        self.axes
    }
}

impl Analysis {
    /// The analysis with its impact, approach line, contact points, centroids, paths to rest and warnings in
    /// the axes of a reader. A [`DamagedFace`](crash3::DamagedFace) and a chassis stay as they are.
    #[must_use]
    pub fn seen(&self, axes: Axes) -> Seen {
        // Without `..`: a new field does not compile until somebody has decided how to convert it.
        let Self {
            basis,
            is_of_damage,
            mut found,
            mut both,
            mut impact,
            // It is only drawn, in the axes of the engine.
            geometry,
            mut travel,
            skids,
            surface,
            mut vehicles,
            crash3,
            left_aside,
            can_be_weighed,
            checks,
            warnings,
        } = self.clone();
        let warnings = warnings.iter().map(|warning| warning.seen(axes)).collect();
        let checks = checks.into_iter().map(|check| check.in_axes(axes)).collect();
        if axes == Axes::ZDown {
            impact = impact.map(|impact| impact.mirrored());
            if let Some(found) = &mut found {
                found.line = found.line.mirrored();
                found.affine_impact = found.affine_impact.map(|affine| affine.mirrored());
            }
            both = both.map(|both| both.mirrored());
            travel = travel.map(|travel| travel.map(|travel| travel.mirrored()));
            for vehicle in &mut vehicles {
                let centroid = vehicle.damage.as_mut().and_then(|damage| damage.centroid.as_mut());
                for [_, y] in vehicle.subject.contact.as_mut().into_iter().chain(centroid) {
                    *y = axes.lateral(*y);
                }
            }
        }
        let answer = Analysis {
            basis,
            is_of_damage,
            found,
            both,
            impact,
            geometry,
            travel,
            skids,
            surface,
            vehicles,
            crash3,
            left_aside,
            can_be_weighed,
            checks,
            warnings,
        };
        Seen { axes, answer }
    }
}

impl Warning {
    /// The warning with its numbers in the axes of a reader.
    #[must_use]
    pub fn seen(&self, axes: Axes) -> SeenWarning {
        let mut seen = self.clone();
        if let Self::DamageCentroid { point: [_, lateral], .. }
        | Self::ContactPlaced { point: [_, lateral], .. }
        | Self::RotationOpposes { turned: lateral, .. } = &mut seen
        {
            *lateral = axes.lateral(*lateral);
        }
        if let Self::MomentumDiffers { checks } = &mut seen {
            for check in checks {
                *check = check.in_axes(axes);
            }
        }
        if let Self::SeveralStarts { used, others, .. } = &mut seen {
            for [_, yaw_rate] in std::iter::once(used).chain(others) {
                *yaw_rate = axes.lateral(*yaw_rate);
            }
        }
        if let Self::EvidenceDiffers { evidence, given, found, .. } = &mut seen
            && evidence.is_lateral()
        {
            (*given, *found) = (axes.lateral(*given), axes.lateral(*found));
        }
        if let Self::SkidDirection { skid, course, .. } = &mut seen {
            (*skid, *course) = (axes.lateral(*skid), axes.lateral(*course));
        }
        if let Self::PointMissed { pass, .. } = &mut seen {
            *pass = pass.in_axes(axes);
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
        SeenWarning { warning: seen, axes }
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
    /// The same refusal, its numbers in the given axes.
    pub(crate) fn in_axes(self, axes: Axes) -> Self {
        match (axes, self) {
            (Axes::ZDown, Self::Reconcile(refusal)) => Self::Reconcile(refusal.mirrored()),
            (Axes::ZDown, Self::Momentum(refusal)) => Self::Momentum(refusal.mirrored()),
            (Axes::ZDown, Self::Impact(refusal)) => Self::Impact(refusal.mirrored()),
            (Axes::ZDown, Self::NotReached { vehicle, energy, tangential_share, nearest }) => {
                let nearest = nearest.map_err(ImpactError::mirrored);
                Self::NotReached { vehicle, energy, tangential_share, nearest }
            }
            (_, failure) => failure,
        }
    }
}
