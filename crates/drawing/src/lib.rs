//! Pictures of a collision and of its numbers, as SVG, PNG and PDF.
//!
//! ```
//! use drawing::{Axis, ValueMark, HistogramPicture};
//!
//! let mark = |value: f64, lead: &str| ValueMark { value, lead: lead.to_owned() };
//! let drawing = HistogramPicture {
//!     title: "Speed of vehicle 1, km/h".to_owned(),
//!     subtitle: "Histogram: 200 samples".to_owned(),
//!     description: "How the speed of vehicle 1 is distributed, in km/h.".to_owned(),
//!     // The data are in m/s, and 1 km/h is 1/3.6 m/s.
//!     across: Axis { title: "speed of vehicle 1, km/h".to_owned(), unit: 1.0 / 3.6 },
//!     decimals: 1,
//!     upward: "% of the samples".to_owned(),
//!     low: 20.0,
//!     width: 1.0,
//!     shares: vec![5.0, 15.0, 45.0, 25.0, 10.0],
//!     interval: [mark(20.4, "2.5 %:"), mark(24.8, "97.5 %:")],
//!     central: mark(22.5, "central:"),
//!     legend: ["samples by class", "95 % interval", "central value"].map(str::to_owned),
//! }
//! .draw();
//! assert!(drawing.svg().contains(">central: 81.0</text>"));
//! assert!(drawing.description().ends_with("2.5 %: 73.4; central: 81.0; 97.5 %: 89.3."));
//! ```
//!
//! Each picture is a struct of plain figures and of the words next to them; its `draw` returns a [`Drawing`],
//! which can be written as SVG, PNG or PDF:
//!
//! | picture | shows |
//! |---|---|
//! | [`ScenePicture`] | both vehicles at impact, seen from above |
//! | [`MotionPicture`] | the motion from approach through impact to rest, on a site plan if there is one |
//! | [`CurvesPicture`] | numbers of that motion, or what a recorder stored, against time or distance |
//! | [`MomentumPicture`] | the momenta before and after the impact, tip to tail |
//! | [`DamagePicture`] | each damaged vehicle with its crush profile in place |
//! | [`EnergyPicture`] | where the initial kinetic energy went |
//! | [`ReconciliationPicture`] | work of the normal impulse against the unknown speed |
//! | [`HistogramPicture`] | how a result is distributed, with its interval and its central value |
//! | [`PathTimePicture`] | distance against time before a collision, of what happened and what would have |
//! | [`ChancePicture`] | a probability against a number, with its band |
//! | [`DensityPicture`] | the probability density of a result, before and after evidence |
//! | [`JointPicture`] | draws of two results at once, with the regions that hold most of them |
//! | [`RestsPicture`] | where vehicles would have come to rest, compared with where they were found |
//! | [`TornadoPicture`] | the effect of each single input on a result |
//! | [`ScatterPicture`] | points of one number against another, with the line where both are equal |
//! | [`RanksPicture`] | the counts of classes that are expected to hold equally many |
//!
//! # Conventions of all pictures
//!
//! Colours are those of Okabe and Ito, which people with any kind of colour vision can distinguish. Dashes,
//! shapes and hatching repeat what colours show, so that the pictures can be read in grey. Labels cover
//! neither each other nor, as far as there is room, a line. Coordinates are written with two decimals of a
//! pixel, so that the bytes are the same on every machine. Each picture has a title and a description.
//!
//! Widths of texts are those of DejaVu Sans, which the crate contains. It is among the widest fonts, so that
//! what fits in it also fits in the reader's font. PNG and PDF contain the letters themselves, and a question
//! mark for each character missing from the font ([`Drawing::missing_letters`]).
//!
//! Arrows carry an `id` such as `scene-velocity-before-1`, and `data-from` and `data-to`; a scale bar such as
//! `scene-scale` also has `data-si`, the length that it represents in SI units.
//!
//! A program that lets its user move parts of the drawing asks a plan view for [`PlanView`], which gives the
//! position of everything in the scene, and draws it again in the same [`Viewport`].
//!
//! # What it does not do
//!
//! It knows no cases, files or units: the caller decides what a number means and how it reads. All numbers
//! have to be finite.

mod body;
mod canvas;
mod chance;
mod chart;
mod curves;
mod damage;
mod density;
mod energy;
mod finished;
mod font;
mod footprint;
mod ground;
mod histogram;
mod joint;
mod labels;
mod legend;
mod marks;
mod momentum;
mod motion;
mod number;
mod outline;
mod path_time;
mod pdf;
mod pens;
mod plan;
mod plan_view;
mod ranks;
mod raster;
mod reconciliation;
mod rests;
mod scatter;
mod scene;
mod sight;
mod site_plan;
mod symbol;
mod thin;
mod ticks;
mod tornado;
mod vector;

pub use body::SceneBody;
pub use chance::ChancePicture;
pub use chart::Axis;
pub use curves::{CurveKind, Curves, CurvesPicture};
pub use damage::{DamagePicture, DamagedVehicle};
pub use density::DensityPicture;
pub use energy::{EnergyBar, EnergyPicture, Loss};
pub use finished::{Drawing, PictureFormat};
pub use footprint::{BodyShape, CrushProfile, Footprint};
pub use ground::{GroundShape, GroundZone};
pub use histogram::HistogramPicture;
pub use joint::JointPicture;
pub use legend::ScaleUnit;
pub use marks::ValueMark;
pub use momentum::MomentumPicture;
pub use motion::{MeasuredPoint, MotionPicture, MotionPoint, MotionRest, MotionVehicle};
pub use number::{number, significant};
pub use path_time::{PathTimeCourse, PathTimePicture};
pub use plan_view::{PlanBody, PlanStation, PlanView, Viewport};
pub use ranks::RanksPicture;
pub use raster::RenderError;
pub use reconciliation::{CurvePoint, ReconciliationPicture};
pub use rests::{FoundAtRest, RestsPicture};
pub use scatter::{ScatterPanel, ScatterPicture, ScatterPoint};
pub use scene::{SceneArrow, SceneMotion, ScenePicture, SceneVehicle};
pub use sight::SightPicture;
pub use site_plan::{PlanPlace, SitePlan, SitePlanError};
pub use symbol::{Marker, Symbol};
pub use tornado::{TornadoBar, TornadoPicture};
