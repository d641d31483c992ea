//! The data of an event data recorder on a collision: reading and evaluation.
//!
//! ```
//! use recorder::{ImpactSpeed, ImpactSpeedErrors, PreCrash, SpeedLimits, read_tables};
//!
//! let text = "Times (sec)  Speed, Vehicle Indicated MPH [km/h]  Service Brake (On, Off)\n\
//!             -1.0 37 [60] Off\n\
//!             -0.5 37 [59] On\n\
//!             0.0 31 [50] On\n";
//! let tables = read_tables(text)?;
//! let record = PreCrash::from_table(&tables[0])?;
//!
//! // Between −1 s and 0 s it drove 15.8 m if its speed was straight between the samples.
//! let distance = record.distance(-1.0, 0.0, &SpeedLimits::default());
//! assert!((distance.between - 15.83).abs() < 0.01);
//! assert!(distance.at_least < distance.right && distance.left < distance.at_most);
//!
//! // It braked at 5 m/s², so that the wheels slipped: the vehicle was faster than the 50 km/h stored.
//! let speed = ImpactSpeed::of(&record, &ImpactSpeedErrors::default())?;
//! assert!((speed.mean * 3.6 - 51.4).abs() < 0.3);
//! let [slowest, fastest] = speed.interval(0.95).map(|speed| speed * 3.6);
//! assert!(slowest > 46.0 && fastest < 56.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`read_tables`] reads CSV or text copied out of a printed report into [`RecorderTable`]s: it recognises
//! each column by its heading and unit, and reports each cell without a value with its place. [`read_rows`]
//! chooses a record of NHTSA's long tables. [`PreCrash`] holds the samples before the impact, with the
//! distance between them within [`DistanceBounds`]; [`ImpactSpeed`] is the speed at t = 0 as a distribution,
//! with a [`SpeedErrorPart`] for each source of its error; [`CrashPulse`] is ΔV over time, with its beginning
//! and end by a [`PulseRule`]; [`match_records`] matches records with impacts.
//!
//! | code | symbol | meaning | unit |
//! |---|---|---|---|
//! | `step` | | step in which speeds are stored | m/s |
//! | `gap` | g | from the last sample to t = 0 | s |
//! | `latency` | ℓ | age of a stored speed | s |
//! | `slip_low` | | reduction of the stored speed by slip in hard braking | m/s |
//! | `deceleration` | f | greatest fall of the speed between samples | m/s² |
//!
//! # Guarantees
//!
//! - The distance by the speed of the wheels lies within [`DistanceBounds`], whatever that speed does between
//!   samples, as long as it keeps [`SpeedLimits`]. Slip of the wheels makes the distance driven longer.
//! - A table is read or refused with a place; no number is guessed.
//! - The same input gives the same bits on every machine.
//!
//! # What it does not do
//!
//! It reads no proprietary binary file, and knows no case: lateral values and yaw rates keep the sign
//! convention of the recorder until the caller converts them.

mod assumption;
mod channel;
mod impact_speed;
mod pre_crash;
mod pulse;
mod spread;
mod table;
mod text;
mod which;

pub use assumption::AssumptionOutOfRange;
pub use channel::{Channel, ChannelUnit};
pub use impact_speed::{
    BEYOND_TYRES, ImpactSpeed, ImpactSpeedErrors, ImpactSpeedFault, KEPT_WITHIN, SampleSpeed,
    SampledApproach, SpeedErrorPart, SpeedErrorSource, SpeedHump, SteepFall,
};
pub use pre_crash::{
    DistanceBounds, PreCrash, PreCrashFault, PreCrashSample, SpeedLimits, SteepChange, StepSource,
};
pub use pulse::{
    CrashPulse, PulseFault, PulseRule, PulseSample, PulseSpan, delta_v_at_center, force_direction,
};
pub use table::{
    Apart, CellDoubt, LeftTable, NoValue, RecorderTable, TableColumn, TextFault, TextLayout, TextPlace,
    TextRefusal,
};
pub use text::{columns_table, read_rows, read_tables};
pub use which::{EventRecord, KnownImpact, MatchErrors, Mismatch, OneAxis, RecordMatch, match_records};
