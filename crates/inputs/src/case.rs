//! What is known of a collision, in the units in which it is given.

mod estimates;
mod values;

use pim_core::{Real, VehicleId};
use reconcile::Unknown;

use crate::axes::Axes;
use crate::basis::Basis;
use crate::estimate::Departures;
use crate::impact::GivenImpact;
use crate::quantity::Quantity;
use crate::range::Range;
use crate::recorder::GivenEstimate;
use crate::scene::{GivenSitePlan, Place, Surface};
use crate::text::Text;
use crate::uncertain::GivenUncertainty;
use crate::vehicle::GivenVehicle;

/// A whole case: two vehicles, and what is known of the impact. The crate `case` reads it from a file and
/// writes it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Case<T = f64> {
    /// The title, which heads every report.
    pub title: Option<Text>,
    /// Where the data come from.
    pub source: Option<Text>,
    /// `[report]`.
    pub report: ReportHead,
    /// `axes` of `[scene]`: the axes in which all numbers of this case are given.
    pub axes: Axes,
    /// `contact` of `[scene]`: where the impulse of the impact acted, in the coordinates of the survey.
    pub scene_contact: Option<Place<T>>,
    /// `site_plan` of `[scene]`: what lies behind the motion in drawings.
    pub site_plan: Option<GivenSitePlan>,
    /// `locked_together` of `[scene]`: whether the vehicles left the impact as one.
    pub locked_together: bool,
    /// `[surface]`.
    pub surface: Option<Surface<T>>,
    /// `[vehicle1]` and `[vehicle2]`.
    pub vehicles: [GivenVehicle<T>; 2],
    /// `[impact]`.
    pub impact: Option<GivenImpact<T>>,
    /// `[reconstruct]`.
    pub reconstruct: Option<Reconstruct<T>>,
    /// `[estimate]`.
    pub estimate: Option<GivenEstimate>,
    /// Which of the numbers are not known exactly, in the order of [`inputs`](Case::inputs). The numbers
    /// themselves are the central values.
    pub ranges: Vec<Range>,
    /// `[uncertainty]`.
    pub uncertainty: GivenUncertainty,
    /// How far estimates are varied: nothing that the case says, and not at all in the case itself.
    pub departures: Departures<T>,
    /// Which optional words the case leaves out.
    pub left_out: LeftOut,
}

/// What the head of a report says of its making.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReportHead {
    /// Who made the analysis.
    pub analyst: Option<Text>,
    /// Of the report.
    pub date: Option<Text>,
    /// The number under which the matter is kept.
    pub file_number: Option<Text>,
    /// The number of the report as an exhibit.
    pub exhibit: Option<Text>,
}

/// Which optional words a case leaves out. The case then holds their defaults, so no result depends on these
/// flags: they only serve to report what is assumed. A flag is false if the whole table is absent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LeftOut {
    /// `scene.axes`.
    pub axes: bool,
    /// `impact.law`.
    pub law: bool,
    /// `reconstruct.energy_basis`.
    pub energy_basis: bool,
    /// `crush.stiffness.test.fit` of each vehicle.
    pub fit: [bool; 2],
}

/// Which speed to find.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reconstruct<T = f64> {
    /// What is unknown.
    pub find: Find,
    /// What the crush energy is held equal to.
    pub energy_basis: Basis<T>,
}

/// The speeds that a reconstruction is to find.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Find {
    /// One; the other is known.
    One(Unknown),
    /// Those of both vehicles.
    Both,
}

impl Find {
    /// The one that is unknown; `None` where both are.
    #[must_use]
    pub fn unknown(self) -> Option<Unknown> {
        match self {
            Self::One(unknown) => Some(unknown),
            Self::Both => None,
        }
    }

    /// Whether the speed of a vehicle is sought.
    #[must_use]
    pub fn seeks(self, vehicle: VehicleId) -> bool {
        self.unknown().is_none_or(|unknown| unknown.vehicle() == vehicle)
    }
}

impl<T: Real> Case<T> {
    /// (rad) of both vehicles, in the axes of the engine.
    #[must_use]
    pub fn headings(&self) -> [Option<T>; 2] {
        let heading = |vehicle: &GivenVehicle<T>| vehicle.heading.as_ref().map(Quantity::si);
        self.vehicles.each_ref().map(|vehicle| heading(vehicle).map(|heading| self.axes.lateral(heading)))
    }

    /// (rad) the direction in which a vehicle travels before the impact and along which its speed counts, in
    /// the axes of the engine; `None` where it is that of the heading.
    #[must_use]
    pub fn course(&self, vehicle: VehicleId) -> Option<T> {
        let heading = self.headings()[vehicle.index()]?;
        self.course_form(vehicle)?.rad(self.axes, heading)
    }
}
