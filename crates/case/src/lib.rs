//! The case file: a collision in TOML, with units, and with errors that point at the value.
//!
//! ```
//! use case::CaseFile;
//! use inputs::Mass;
//!
//! let text = r#"
//!     [vehicle1]
//!     name   = "1994 GMC Jimmy"
//!     weight = "3696 lb"
//!     speed  = "75 ft/s"
//!
//!     [vehicle2]
//!     name   = "1995 Nissan Altima"
//!     mass   = "1548 kg"
//!     speed  = "10 mph"
//! "#;
//! let file = CaseFile::parse("collision.toml", text)?;
//! let mass = file.case.vehicles[0].mass.as_ref().map(Mass::kg);
//! assert!(mass.is_some_and(|kg| (kg - 1676.48).abs() < 0.01)); // 3696 × 0.453 592 37
//!
//! // Every problem of a file is reported at once, each with its line, its column and what to write instead.
//! let wrong = text.replace("75 ft/s", "75 feets/s").replace("weight", "wieght");
//! let errors = CaseFile::parse("collision.toml", &wrong).unwrap_err().to_string();
//! assert!(errors.contains(r#"did you mean "weight"?"#));
//! assert!(errors.contains(r#""75 feets/s" has an unknown unit "feets/s""#));
//! assert!(errors.contains("collision.toml:5:14"));
//! # Ok::<(), case::Diagnostics>(())
//! ```
//!
//! The types: [`CaseFile::parse`] gives a [`CaseFile`], which is a [`Case`] and the [`Source`] it came from,
//! or [`Diagnostics`]. The case itself is a type of the crate [`inputs`], which knows nothing of files;
//! [`to_toml`] writes it back. An analysis reports [`Faults`] by their keys, and [`CaseFile::diagnostics`]
//! places them in the file. A [`Template`] is a case to start from, and editors complete and check a case
//! with [`json_schema`].
//!
//! # The file
//!
//! A dimensioned value is a string with its unit; a plain number is dimensionless. Unknown keys are errors.
//! A file may have [`CaseFile::LARGEST_FILE`] bytes, a list 10,000 values, a list of zones 1,000, and the
//! whole file 500 ranges.
//!
//! [`keys`] lists every key, and [`key_tree`] gives its form; `docs/guide/case-file.md`, which is made from
//! the same tables, explains each.
//!
//! # Axes
//!
//! [`Axes`]: by default, y points to the left, and angles and yaw rates are positive counter-clockwise. A
//! file with
//!
//! ```toml
//! [scene]
//! axes = "z-down"
//! ```
//!
//! uses the axes of SAE J670, with y to the right and clockwise positive. For the same collision, these
//! numbers then have the opposite sign: `heading`, `sideslip`, `yaw_rate`, `uphill`, `steer`, `turned`,
//! `direction`, the `y` of every place, the `angle` or `y` of `contact`, the `y` of `velocity`,
//! `crush_plane`, the `ratio` of `tangential` and `tangential_velocity_change`, which are measured along t,
//! that is n rotated by +90° in the sense of the axes, and the `offset` of a damaged front or rear. All
//! others are the same in both: a `pdof` is the face of a clock, and sides and the order of depths (from left
//! to right, from rear to front) are words.
//!
//! Which of the optional keys are needed depends on the analysis, which checks them.
//!
//! # Ranges
//!
//! Any number can be given as a range instead of a single value. The case then holds the central value, which
//! every analysis uses, and [`Case::ranges`] holds its uncertainty.
//!
//! | written | means | central value |
//! |---|---|---|
//! | `{ value = "10 mph", sd = "1 mph" }` | normal, with that standard deviation | `value` |
//! | `{ value = "10 mph", within = "10 %", confidence = 0.95 }` | normal, and within 10 % of the value with a probability of 0.95 | `value` |
//! | `{ low = "8 mph", high = "12 mph" }` | uniform | the middle |
//! | `{ low = "8 mph", mode = "9 mph", high = "12 mph" }` | triangular | `mode` |
//! | `{ values = "21.3 20.3 in", sd = "0.5 in" }`, or with `within` and `confidence` | for a list: each normal, independent of the others | `values` |
//!
//! A list can also hold ranges one by one: `["21.3 in", { low = "19 in", high = "21 in" }]`. A number without
//! unit has ranges without units: `restitution = { value = 0.3, sd = 0.05 }`. The ends of a range must be
//! values that the key accepts; a normal distribution that reaches beyond is truncated at the [`Bounds`].
//!
//! ```
//! let file = case::CaseFile::parse("case.toml", r#"
//!     [vehicle1]
//!     speed = { low = "8 mph", high = "12 mph" }
//!     [vehicle2]
//!     fixed = true
//! "#)?;
//! assert_eq!(file.case.inputs()[0].number, 10.0);
//! assert_eq!(file.case.ranges[0].path, "vehicle1.speed");
//! # Ok::<(), case::Diagnostics>(())
//! ```
//!
//! # Units
//!
//! Between the units of a product, a space, `·`, `*` and `-` mean the same, and so do `^2`, `²` and a bare
//! `2`, and `√lb`, `sqrt(lb)`, `lb^½` and `lb^0.5`. Upper and lower case differ. `lbf` is `lb` wherever that
//! is a force: in `lb ft s^2` it is one, in `lb ft^2` a mass.
//!
#![doc = include_str!("units.md")]
//!
//! The tables above are what the program accepts:
//!
//! ```
//! use case::{Dimension, read_quantity, read_unit};
//!
//! let tables = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/units.md"));
//! let mut accepted = 0;
//! for row in tables.lines().filter(|row| row.contains('`')) {
//!     let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
//!     let ticked = |cell: &str| -> Vec<String> { cell.split('`').skip(1).step_by(2).map(str::to_owned).collect() };
//!     if let [name, spellings, value] = cells[..] {
//!         let dimension = Dimension::ALL.into_iter().find(|known| known.name() == name).ok_or(name)?;
//!         for spelling in ticked(spellings) {
//!             let one = read_quantity(&format!("1 {spelling}"), dimension).map_err(|error| error.help())?;
//!             let si = value.split(' ').next().and_then(|number| number.parse().ok());
//!             assert_eq!(Some(one.si()), si, "{spelling}");
//!             accepted += 1;
//!         }
//!     } else {
//!         let words = [ticked(cells[0]), ticked(cells[1])].concat();
//!         // Some words are units only as a part of one: "mi" of "mi/h", "s" of "m/s".
//!         let meaning = |word: &String| {
//!             let parts = [word.clone(), format!("{word}/h"), format!("km/{word}"), format!("m/{word}")];
//!             Dimension::ALL.into_iter().find_map(|d| parts.iter().find_map(|part| read_unit(part, d)))
//!         };
//!         let units: Vec<_> = words.iter().map(meaning).collect();
//!         assert!(units.iter().all(|unit| unit.is_some() && *unit == units[0]), "{words:?}");
//!         accepted += words.len();
//!     }
//! }
//! assert!(accepted > 80);
//! # Ok::<(), String>(())
//! ```
//!
//! `examples/convert.rs` reads a case, turns its numbers into SI, changes one and writes the case again;
//! [`edit`] changes one key in the text itself.
//!
//! # What it does not do
//!
//! It has no equations and no defaults beyond those named above; [`inputs`] states what each analysis needs.
//! It does no arithmetic with units: a unit that is not in the table is refused. A case that [`to_toml`]
//! writes has no comments.

mod case_problem;
mod diagnostic;
pub mod edit;
mod json_schema;
mod keys;
mod nearest;
mod node;
mod number;
mod number_slips;
mod other_files;
mod parser_error;
mod program;
mod quantity;
mod read;
mod schema;
mod source;
mod template;
mod to_toml;
mod toml_slips;
mod units;
mod units_in_use;
mod value;

/// The example of SAE 980025, appendix, as a case file: what is the speed of the GMC Jimmy?
pub const EXAMPLE: &str = include_str!("../sae-980025.toml");

pub use case_problem::CaseProblem;
pub use diagnostic::{Diagnostic, Diagnostics, PlainDiagnostic};
pub use json_schema::json_schema;
pub use keys::{key_tree, list_range_keys, range_keys, sourced_range_keys};
pub use nearest::nearest_names;
pub use program::Program;
pub use quantity::{QuantityError, read_quantity};
pub use read::CaseFile;
pub use schema::{Form, KeyInfo, Schema, keys, number_keys};
pub use source::Source;
pub use template::Template;
pub use to_toml::to_toml;
pub use units::read_unit;
pub use value::{Value, ValueTable};

// The contents of a case file are types of the crate `inputs`, re-exported here for those who read files.
pub use inputs::*;
