#![doc = include_str!("../README.md")]
//!
//! # Example
//!
//! A made-up pair, the front of vehicle 1 against the left side of vehicle 2. The recorder of vehicle 1
//! stored that it lost 24 km/h along its heading and gained 7 km/h to its right.
//!
//! ```
//! use field::Crash as _;
//!
//! let columns = [
//!     ("CASEID", "17"), ("CURBWT_1", "1500"), ("CARGOWT_1", ""), ("CDCPLANE_1", "F"), ("PDOF_1", "20"),
//!     ("HEADINGANG_1", "0"), ("FIELDL_1", "120"), ("DIRECTL_1", "150"), ("DIRECTD_1", "10"),
//!     ("C1_1", "20"), ("C2_1", "22"), ("C3_1", "24"), ("C4_1", "26"), ("C5_1", "28"), ("C6_1", "30"),
//!     ("DVTOTAL_1", ""), ("DVLONG_1", ""), ("MAXDVLONG_1", "-24"), ("MAXDVLAT_1", "7"),
//!     ("CURBWT_2", "1400"), ("CARGOWT_2", "0"), ("CDCPLANE_2", "L"), ("PDOF_2", "290"),
//!     ("HEADINGANG_2", "270"), ("FIELDL_2", "200"), ("DIRECTL_2", "180"), ("DIRECTD_2", "30"),
//!     ("C1_2", "10"), ("C2_2", "20"), ("C3_2", "30"), ("C4_2", "30"), ("C5_2", "20"), ("C6_2", "10"),
//!     ("DVTOTAL_2", ""), ("DVLONG_2", ""), ("MAXDVLONG_2", ""), ("MAXDVLAT_2", ""),
//! ];
//! let line = |of: fn(&(&str, &str)) -> String| columns.iter().map(of).collect::<Vec<_>>().join(",");
//! let pairs = field::read(&format!("{}\n{}\n", line(|c| c.0.to_owned()), line(|c| c.1.to_owned())))?;
//!
//! let [(vehicle, stored)] = pairs[0].truths()[..] else { return Err("one recorder".into()) };
//! assert_eq!(vehicle, pim_core::VehicleId::One);
//! // By hand: √(24² + 7²) = 25 km/h, and the force came from atan(7/24) = 16.26° left of ahead.
//! assert!((3.6 * stored.delta_v - 25.0).abs() < 1e-9);
//! let direction = stored.direction.ok_or("both parts were stored")?;
//! assert!((direction.to_degrees() + 16.26).abs() < 0.005);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod by_category;
mod case_text;
pub mod ciss;
mod claim;
mod collision;
mod crash;
mod crossed;
mod direction;
mod error;
mod figure;
mod fit;
mod judge;
mod lines;
mod object;
mod pair;
mod read;
mod recorded;
mod recorders;
mod share;

pub use by_category::PairByCategory;
pub use claim::{ClaimColumns, ClaimGroup, Claims, JudgedClaim, ProgramClaim, judge_claims};
pub use crash::{Crash, KnownCrush, PairKind};
pub use direction::{DirectionFit, fit_direction};
pub use error::FieldError;
pub use figure::Figure;
pub use fit::{FigureFit, FitOptions, Folds, fit, fit_folds};
pub use judge::{Field, Figures, Group, Judged, LEVELS, Options, judge, judge_by};
pub use object::ObjectCrash;
pub use pair::{Pair, PairVehicle, Plane, Truth, usual_category};
pub use read::{read, read_objects};
pub use recorded::{LastSpeed, RecordedPair, RecorderRow, read_recorders};
pub use recorders::{
    DeltaVFigures, DoubtedRecord, JudgedDeltaV, JudgedRecord, Recorders, SpeedFigures, WidthPart,
    judge_recorders,
};
pub use share::{ShareFit, fit_share};
