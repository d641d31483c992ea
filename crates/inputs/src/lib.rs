//! The known data of a collision: numbers in the units in which they were measured, their ranges, and the
//! requirements of each analysis.
//!
//! ```
//! use inputs::{Case, Dimension, GivenVehicle, Mass, Quantity};
//!
//! let pound = Dimension::Weight.unit("lb").ok_or("a weight is given in pounds")?;
//! let jimmy = GivenVehicle { mass: Some(Mass::Weight(Quantity::new(3696.0, pound)?)), ..GivenVehicle::default() };
//! let barrier = GivenVehicle { fixed: true, ..GivenVehicle::default() };
//! let case = Case { vehicles: [jimmy, barrier], ..Case::default() };
//! let mass = case.vehicles[0].mass.as_ref().map(Mass::kg);
//! assert!(mass.is_some_and(|kg| (kg - 1676.48).abs() < 0.01)); // 3696 × 0.453 592 37
//!
//! // A fault names the key that is missing for a purpose.
//! let faults = case.damage().unwrap_err();
//! assert!(faults.list().iter().any(|fault| fault.key == "vehicle1.crush"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The types: a [`Case`] holds two [`GivenVehicle`]s and a [`GivenImpact`]. Its numbers are [`Quantity`]s,
//! which keep the unit in which they were given, because reports and errors quote them in that unit;
//! [`Quantity::si`] converts them. [`Case::inputs`] lists the numbers, each under its key, and
//! [`Case::values`] lists every value. A [`Range`] gives the uncertainty of a number. An [`EstimatedInput`]
//! is a value from a table or a formula in place of a number, or a contact point placed at the damage; its
//! factor, 1, or its displacement, 0, is one of [`Case::variables`] besides the numbers. [`Case::map`]
//! replaces all of these.
//!
//! [`Case::impact_form`] returns the inputs of an impact, on any numbers: the meaning of each key for it is
//! defined there alone. [`Case::reconstruction`], [`Case::collision`] and [`Case::damage`] turn a case into
//! the types of the engines, for three [`Purpose`]s. A value that is missing, or that an engine refuses, is a
//! [`Fault`] of its key; a crate that knows the places of the keys in a text can show it there.
//!
//! # What it does not do
//!
//! It reads and writes no files; the crate `case` does. It has no equations except unit conversions, and no
//! arithmetic with units.
//!
//! # References
//!
//! A. Thompson and B. N. Taylor, *Guide for the Use of the International System of Units (SI)*, NIST Special
//! Publication 811 (2008), appendix B.8: the factors.

mod after;
mod avoid;
mod axes;
mod basis;
mod case;
mod crush;
mod data;
mod demands;
mod dimensions;
mod estimate;
mod fault;
mod form;
mod impact;
mod inertia;
mod motion;
mod purpose;
mod quantity;
mod range;
mod recorded;
mod recorder;
mod scene;
mod shared;
mod text;
mod uncertain;
mod units;
mod vehicle;
mod walk;
mod way_out;
mod words;

pub use self::recorder::{
    CertainSpeed, GivenEstimate, OtherImpact, Recorder, RecordersDeltaV, RecordersSpeed, SeverityPrior,
    StoredRecord,
};
pub use after::{
    After, Before, Drag, GivenPhase, GivenRest, GivenSteer, MarkedWheel, PathPoint, PhaseForm, RestHeading,
    Skid, SkidBegin, SteerPoint, WheelDrag,
};
pub use avoid::{
    Along, Avoid, AvoidBasis, AvoidForm, BrakingForm, Clear, DemandForm, GivenDemand, GivenSight,
    GivenWayOut, Obstacle, OffLine, OtherApproach, OtherForm, OtherMotionForm, OtherParty, PartyApproach,
    PathForm, PlaceForm, ReactionDemand, RecordedError, SUBJECTS, SWELLS, SameLineForm, SightForm, Sourced,
    SpeedForm,
};
pub use axes::Axes;
pub use basis::{Basis, ENERGY_BASES};
pub use case::{Case, Find, LeftOut, Reconstruct, ReportHead, is_of_avoid};
pub use crush::{Crush, Fit, GivenEes, GivenTest, KnownEnergy, Pdof, StiffnessForm, StiffnessLine};
pub use data::{
    CollisionData, CrushEvidence, CrushOnly, DamageData, EnergyData, ForceData, ImpactInput, InertiaData,
    InferredWidth, ReconstructionInput, StiffnessSource, VehicleData,
};
pub use demands::{contradictions, table, uncertain_speeds};
pub use dimensions::Dimensions;
pub use estimate::{
    ContactSpread, DAMAGE_LENGTH_SD, DEPTH_SD, Departures, EstimatedInput, FaceAxis, OFFSET_SD,
    TypicalStiffness, YAW_RADIUS_CONFIDENCE, YawSource,
};
pub use fault::{Fault, FaultKind, Faults};
pub use form::{
    ContactForm, CourseForm, CrushForm, DamageForm, ImpactForm, PlacedContact, VehicleForm, WidthsForm,
    YawForm,
};
pub use impact::{BrachTangential, GivenImpact, ImpactLaw, LawName, Restitution};
pub use inertia::{Mass, YawInertia};
pub use motion::{
    Geometry, MotionInput, PointData, RegionData, RestData, RestHeadingData, SkidData, Sought, SteerData,
    SurfaceData, TwoSpeedInput, VehicleMotion, ZoneData,
};
pub use purpose::Purpose;
pub use quantity::{InvalidQuantity, Quantity, format_number};
pub use range::{Amount, Bounds, Range, Spread};
pub use recorded::{
    GivenPreCrash, GivenPulse, GivenSeries, GivenSpeedErrors, OfTables, SeriesRefusal, SeriesSource,
};
pub use scene::{EdgeSide, GivenSitePlan, Grade, Place, Surface, SurfaceRegion, SurfaceZone};
pub use shared::SharedEffects;
pub use text::{Text, acts, shown, shown_lines, sign};
pub use uncertain::{GivenUncertainty, SharedError, list_of};
pub use units::{Dimension, STANDARD_GRAVITY, Unit, UnitSystem};
pub use vehicle::{ContactPoint, GivenVehicle, Outline, VehicleKind, Velocity};
pub use walk::{GivenValue, Input, Origin, Variable};
pub use way_out::{ClearForm, ClearSpeedForm, OutlinesForm, PlacesForm, WayOutForm};
pub use words::{FLEET_STIFFNESS, OBLIQUE_CORRECTIONS, SIDES, UNDAMAGED, UNKNOWNS, word, words_of};
