//! The known data of a collision, in the units in which they are given.

mod avoidance;
mod estimates;
mod values;

pub use avoidance::is_of_avoid;

use pim_core::{Real, VehicleId};

use crate::avoid::Avoid;
use crate::axes::Axes;
use crate::basis::Basis;
use crate::crush::{Crush, KnownEnergy};
use crate::estimate::Departures;
use crate::impact::GivenImpact;
use crate::quantity::Quantity;
use crate::range::Range;
use crate::recorder::{GivenEstimate, Recorder};
use crate::scene::{GivenSitePlan, Place, Surface};
use crate::text::Text;
use crate::uncertain::GivenUncertainty;
use crate::vehicle::GivenVehicle;

/// A whole case: two vehicles, and the known data of the impact. The crate `case` reads and writes it as a
/// file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Case<T = f64> {
    /// The title, which heads every report.
    pub title: Option<Text>,
    /// The source of the data.
    pub source: Option<Text>,
    /// `[report]`.
    pub report: ReportHead,
    /// `axes` of `[scene]`: the axes in which all numbers of this case are given.
    pub axes: Axes,
    /// `contact` of `[scene]`: the point where the impulse acted, in survey coordinates.
    pub scene_contact: Option<Place<T>>,
    /// `site_plan` of `[scene]`: the background of drawings of the motion.
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
    /// `[avoid]`.
    pub avoid: Option<Avoid<T>>,
    /// The numbers that are not known exactly, in the order of [`inputs`](Case::inputs). The numbers
    /// themselves are the central values.
    pub ranges: Vec<Range>,
    /// `[uncertainty]`.
    pub uncertainty: GivenUncertainty,
    /// How far estimates are varied: not given by the case, and zero in the case itself.
    pub departures: Departures<T>,
    /// The optional words that the case leaves out.
    pub left_out: LeftOut,
}

/// Data about the report, for its head.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReportHead {
    /// Who made the analysis.
    pub analyst: Option<Text>,
    /// The date of the report.
    pub date: Option<Text>,
    /// The number of the file.
    pub file_number: Option<Text>,
    /// The number of the report as an exhibit.
    pub exhibit: Option<Text>,
}

/// The optional words that a case leaves out. The case then holds their defaults, so no result depends on
/// these flags: they only serve to report assumptions. A flag other than `axes` is
/// false if the whole table is absent.
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

/// The speed to find, and the energy basis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reconstruct<T = f64> {
    /// The unknown speed or speeds.
    pub find: Find,
    /// The energy that the crush energy has to equal.
    pub energy_basis: Basis<T>,
}

/// The speeds that a reconstruction is to find.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Find {
    /// One speed; the other is known.
    One(VehicleId),
    /// The speeds of both vehicles.
    Both,
}

impl Find {
    /// The unknown one; `None` if both are.
    #[must_use]
    pub fn unknown(self) -> Option<VehicleId> {
        match self {
            Self::One(unknown) => Some(unknown),
            Self::Both => None,
        }
    }

    /// Whether the speed of a vehicle is unknown.
    #[must_use]
    pub fn seeks(self, vehicle: VehicleId) -> bool {
        self.unknown().is_none_or(|unknown| unknown == vehicle)
    }
}

impl<T: Copy> Case<T> {
    /// Whether a recorder of the case has a table.
    #[must_use]
    pub fn has_recorder_table(&self) -> bool {
        self.vehicles.iter().filter_map(|vehicle| vehicle.recorder.as_ref()).any(Recorder::has_table)
    }

    /// (–) the friction of the ground, if the case gives it.
    #[must_use]
    pub fn ground_friction(&self) -> Option<T> {
        self.surface.as_ref().map(|surface| surface.friction)
    }
}

impl<T: Real> Case<T> {
    /// (rad) headings of both vehicles, in the axes of the engine.
    #[must_use]
    pub fn headings(&self) -> [Option<T>; 2] {
        let heading = |vehicle: &GivenVehicle<T>| vehicle.heading.as_ref().map(Quantity::si);
        self.vehicles.each_ref().map(|vehicle| heading(vehicle).map(|heading| self.axes.lateral(heading)))
    }

    /// (rad) a vehicle's direction of travel before the impact, along which its speed is measured, in the
    /// axes of the engine; `None` if it is the heading.
    #[must_use]
    pub fn course(&self, vehicle: VehicleId) -> Option<T> {
        let heading = self.headings()[vehicle.index()]?;
        self.course_form(vehicle)?.rad(self.axes, heading)
    }

    /// (rad) the vehicles' directions of travel before the impact, in the axes of the engine: their headings
    /// where there is no sideslip.
    #[must_use]
    pub fn courses(&self) -> [Option<T>; 2] {
        let headings = self.headings();
        VehicleId::ALL.map(|id| self.course(id).or(headings[id.index()]))
    }

    /// Whether the damage is measured, and no vehicle has residual crush: the crush energy is then only an
    /// upper bound.
    #[must_use]
    pub fn has_no_residual_crush(&self) -> bool {
        let has_energy = |vehicle: &&GivenVehicle<T>| {
            let ees = vehicle.energy.as_ref().and_then(KnownEnergy::ees);
            vehicle.crush.is_some() || ees.is_some() || vehicle.deformation_energy.is_some()
        };
        let mut damaged = self.vehicles.iter().filter(has_energy).peekable();
        damaged.peek().is_some()
            && damaged.all(|vehicle| vehicle.crush.as_ref().is_some_and(Crush::has_no_residual))
    }

    /// (rad) the angle between these directions.
    #[must_use]
    pub fn approach_angle(&self) -> Option<f64> {
        let [Some(one), Some(two)] = self.courses() else { return None };
        Some(real::principal_angle(two.value() - one.value()).abs())
    }
}
