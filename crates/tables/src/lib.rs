//! Tables of collisions in Arrow's columns: a row in, a row out.
//!
//! ```
//! use std::sync::Arc;
//!
//! use arrow_array::cast::AsArray as _;
//! use arrow_array::types::Float64Type;
//! use arrow_array::{ArrayRef, Float64Array, RecordBatch};
//! use tables::{RowOptions, RowTemplate, reconstruct};
//!
//! // What all rows share, and a column for what they do not.
//! let template = RowTemplate::parse("sae-980025.toml", case::EXAMPLE)?;
//! let speeds: ArrayRef = Arc::new(Float64Array::from(vec![Some(10.0), Some(1e9), None]));
//! let batch = RecordBatch::try_from_iter([("vehicle2.speed [mph]", speeds)])?;
//!
//! let results = reconstruct(&batch, &template, &RowOptions::default())?;
//! let found = results.column_by_name("found_value").ok_or("a column")?.as_primitive::<Float64Type>();
//! assert!((found.value(0) - 22.9).abs() < 0.05); // the paper: 22.9 m/s
//! assert_eq!(found.value(2), found.value(0)); // null: as in the template
//! let error = results.column_by_name("error").ok_or("a column")?.as_string::<i32>();
//! assert_eq!(error.value(1), "vehicle2.speed: \"1000000000 mph\" is implausibly large for a speed");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Each row goes through the reader of case files and the functions of `analysis`: its results have the same
//! bits as those of the program on the same case, and its faults are reported in the same sentences, with
//! their keys. [`run`] does any [`Job`]; [`reconstruct`] is short for one.
//! [`result_schema`] gives the columns of results without data.
//!
//! # Columns of cases
//!
//! A column gives a key of the case file. Null means that the row does not give it.
//!
//! - **Nested**: structs and lists as in the file, [`case_schema`]: `vehicle1: struct<mass: double, crush:
//!   struct<side: string, depths: list<double>>>`. Each row can have its own law, side and number of
//!   stations. A column may have only part of the schema.
//! - **Flat**: the path of the key is the name of the column, as the file and all messages write it, with the
//!   unit in brackets: `vehicle1.mass [lb]`, `vehicle1.crush.depths[1] [in]`, `vehicle2.speed.sd [mph]`.
//!   Where dots and brackets are in the way (SQL, Spark), the same with two underscores:
//!   `vehicle1__mass__lb`, `vehicle1__crush__depths__1__in`, `vehicle1__crush__stiffness__B__N_per_cm2`.
//!   Two, because keys have single ones in them: `vehicle1_yaw_rate_sd` could be split in several ways, and
//!   is refused.
//!
//! A number without a unit is in SI units and radians. A unit is part of the name of the column, or of the
//! field of a struct, or is in the metadata `unit` of its field. A text can be a quantity as in the file,
//! `"10 mph"`, or a number, which is then in the unit of the column; a blank text is null.
//!
//! | the key has | its column is |
//! |---|---|
//! | a number, with a unit or without | a number or a text; or, for a range, a struct with fields of `value`, `sd`, `low`, `mode`, `high`, `within` (in per cent) and `confidence`; one with `value` alone is a plain number |
//! | a list of numbers | a list of these, which ends at its first null; a text, `"0.54 0.52 0.35"`; or a column for each, `depths[1]`, `depths[2]`, … |
//! | a word or a text, true or false | a text; a Boolean |
//! | a word or a table, such as `tangential` | a text, or a struct with the keys of the table and `word` |
//! | a number or a table, such as `restitution` | a number, or a struct with the keys of the table and `value` |
//! | a number or a word or a list of four, `drag` | a number, a text, or a struct of `value`, `word` and `wheels` |
//! | an angle or the hour of a clock, `pdof` | a number, a text, or a struct of `value` and `word` |
//! | one word or all, `find` | a text or a list of texts |
//! | a table, a list of tables | a struct, a list of structs |
//!
//! Integers of any width, floats, texts in their three encodings, dictionaries of these and nulls are read. A
//! column whose name begins with that of a table but is not a key makes the table invalid: otherwise, a slip
//! there would silently become a default. All other columns are the table's own ([`columns_kept`]), and can
//! be added to the results ([`Carried`]).
//!
//! # What all rows share
//!
//! A [`RowTemplate`] is a part of a case file. The values of a row replace or complete it: tables key by key,
//! and any other value as a whole, a number with its range. A range without a central value, such as `sd`
//! alone, applies to the value in the template.
//!
//! # Results
//!
//! Columns are named after the keys of the JSON, with underscores for dots: `vehicle1_delta_v`. They are in
//! SI units and radians, and in the axes of the case. With [`RowOptions::samples`], the results that vary
//! have `vehicle1_delta_v_p025`, `_median` and `_p975`, the 95 % interval, `_mean` and `_sd`; they are null
//! in a row without uncertain numbers. No type is unsigned, and no name has a dot. `warnings` are codes that
//! the glossary explains; `help` states what to write instead. The metadata of the schema has the version of
//! the program and the options.
//!
//! The seed is that of the options, or of the column `seed`: the same row has the same result at any
//! position, in any batch and on any number of threads.
//!
//! # What it does not do
//!
//! It reads and writes no files: for that there are `deltav table` and the Python package. It computes
//! nothing that a case file would not give.

mod carried;
mod column;
mod error;
mod job;
mod layout;
mod name;
mod plan;
mod results;
mod shape;
mod solve;

pub use carried::Carried;
pub use error::TableError;
pub use job::{Job, RowOptions};
pub use layout::{Numbers, case_schema};
pub use plan::read_number;
pub use solve::{
    RowFaults, RowProgress, RowTemplate, assumed_units, check_columns, columns_kept, reconstruct,
    result_schema, run, run_with_faults,
};
