//! Selects the crashes that can be judged from the tables that NHTSA publishes for a year of its Crash
//! Investigation Sampling System (CISS). It reads no file: a [`CissFiles`] supplies names and contents.
//!
//! ```
//! use field::ciss::{CissError, CissFiles, pairs};
//!
//! /// Four tables that only have headers.
//! struct Empty;
//!
//! impl CissFiles for Empty {
//!     type Error = CissError;
//!
//!     fn names(&self) -> Vec<String> {
//!         ["CISS/CRASH.csv", "CISS/GV.csv", "CISS/CDC.csv", "CISS/EDREVENT.csv"].map(str::to_owned).to_vec()
//!     }
//!
//!     fn read(&mut self, place: usize) -> Result<Vec<u8>, CissError> {
//!         let headers = [
//!             "CASEID,CRASHYEAR",
//!             "CASEID,VEHNO,MAKE,MODEL,MODELYR,BODYTYPE,CURBWT,CARGOWT,DVANGTHIS",
//!             "CASEID,EVENTNO,VEHNO,OBJCONT,CDCPLANE,CDC,PDOF,HEADINGANG,FIELDL,FIELDLD,DIRECTL,DIRECTD,\
//!              C1,C2,C3,C4,C5,C6,CMAX,DVTOTAL,DVLONG,DVLAT,DVENERGY",
//!             "CASEID,VEHNO,CDCEVENT,MAXDVLONG,MAXDVLAT",
//!         ];
//!         Ok(headers[place].as_bytes().to_vec())
//!     }
//! }
//!
//! let found = pairs(&mut Empty)?;
//! assert_eq!((found.rows.len(), found.tables.len()), (0, 4));
//! assert!(found.csv().starts_with("YEAR,CASEID,EVENTNO,VEHNO_1,MAKE_1"));
//! # Ok::<(), CissError>(())
//! ```

mod cell;
mod error;
mod found;
mod records;
mod sas;
mod table;
mod year;

pub use cell::CissCell;
pub use error::CissError;
pub use found::{CissColumn, CissCrashes, CissLeftOut, CissTable};
pub use records::{CissRecord, records};
pub use table::{CissFiles, has_tables, read_pairs};
pub use year::{OBJECTS, objects, pairs};
