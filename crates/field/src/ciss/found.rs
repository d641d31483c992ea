//! The crashes in the tables, as one table.

use std::collections::BTreeMap;

use super::cell::{self, CissCell, Kind};
use crate::error::FieldError;
use crate::read::{read, read_objects};

/// A table that was read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CissTable {
    /// Its name in CISS.
    pub name: &'static str,
    /// Its file.
    pub file: String,
    /// (–) number of its rows.
    pub rows: usize,
}

/// Why a crash of the tables is not among those that are judged; the first reason counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum CissLeftOut {
    /// The tables do not show which damage belongs to the collision.
    SeveralDamages,
    /// Damage to the top, the underside or an unknown plane.
    Plane,
    /// C1 to C6, or the length of the damage.
    Crush,
    /// The direction of force.
    Pdof,
    /// The curb weight.
    Mass,
    /// The ΔV that a recorder stored of this event.
    Recorder,
    /// A number that [`read`](crate::read) refuses, such as a ΔV of 600 km/h: a download cannot be corrected.
    Implausible,
}

/// Crashes of a year, as a table.
#[derive(Clone, Debug)]
pub struct CissCrashes {
    /// The tables from which they were made.
    pub tables: Vec<CissTable>,
    /// Whether each is a vehicle that struck a fixed object, instead of a pair of vehicles.
    pub is_of_objects: bool,
    /// One row for each crash, with a cell for each of the [columns](CissCrashes::columns).
    pub rows: Vec<Vec<CissCell>>,
    /// (–) numbers of crashes that are left out, by reason.
    pub left_out: BTreeMap<CissLeftOut, usize>,
}

/// A column of a table of crashes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CissColumn {
    /// Its name: NHTSA's, in pairs with _1 and _2.
    pub name: String,
    /// `text`, `integer` or `number`.
    pub kind: &'static str,
    /// Its name at NHTSA.
    pub of: &'static str,
}

/// The columns of every crash, before those of its vehicles.
const KEYS: [&str; 3] = ["YEAR", "CASEID", "EVENTNO"];

/// The columns of every vehicle, with blanks between them.
const OF_VEHICLE: &str = "VEHNO MAKE MODEL MODELYR BODYTYPE CURBWT CARGOWT CDCPLANE CDC PDOF HEADINGANG \
    DVANGTHIS FIELDL FIELDLD DIRECTL DIRECTD C1 C2 C3 C4 C5 C6 CMAX DVTOTAL DVLONG DVLAT DVENERGY MAXDVLONG \
    MAXDVLAT";

/// The columns of every vehicle, in order.
pub(super) fn of_vehicle() -> impl Iterator<Item = &'static str> {
    OF_VEHICLE.split(' ')
}

/// The column of a vehicle that struck an object.
pub(super) const OBJECT: &str = "OBJCONT";

impl CissLeftOut {
    /// The reason, for pairs or for vehicles that struck an object.
    #[must_use]
    pub fn why(self, is_of_objects: bool) -> &'static str {
        match (self, is_of_objects) {
            (Self::SeveralDamages, false) => "with several damaged areas of one vehicle from the event",
            (Self::SeveralDamages, true) => "with several damaged areas from the event",
            (Self::Plane, false) => "without damage to front, back or side of both",
            (Self::Plane, true) => "without damage to front, back or side",
            (Self::Crush, false) => "without crush profiles of both",
            (Self::Crush, true) => "without a crush profile",
            (Self::Pdof, false) => "without PDOF of both",
            (Self::Pdof, true) => "without PDOF",
            (Self::Mass, false) => "without masses of both",
            (Self::Mass, true) => "without a mass",
            (Self::Recorder, _) => "without a recorder's ΔV of this event",
            (Self::Implausible, _) => "with a number that is not plausible",
        }
    }
}

impl CissCrashes {
    /// The columns of a table of crashes.
    #[must_use]
    pub fn columns(is_of_objects: bool) -> Vec<CissColumn> {
        let column = |of: &'static str, name: String| CissColumn {
            name,
            of,
            kind: match cell::kind(of) {
                Kind::Text => "text",
                Kind::Code => "integer",
                Kind::Angle | Kind::Recorded | Kind::Measure => "number",
            },
        };
        let keys = KEYS.into_iter().map(|name| column(name, name.to_owned()));
        if is_of_objects {
            let of_vehicle = of_vehicle().chain([OBJECT]);
            return keys.chain(of_vehicle.map(|name| column(name, name.to_owned()))).collect();
        }
        let of = |vehicle| of_vehicle().map(move |name| column(name, format!("{name}_{vehicle}")));
        keys.chain([1, 2].into_iter().flat_map(of)).collect()
    }

    /// Whether the reader of the table would refuse a cell of a crash.
    pub(super) fn is_refused(row: &[CissCell], is_of_objects: bool) -> bool {
        let text = Self::table(is_of_objects, [row]);
        let read = if is_of_objects { read_objects(&text).map(|_| ()) } else { read(&text).map(|_| ()) };
        matches!(read, Err(FieldError::Cell { .. }))
    }

    /// (–) numbers of crashes that several years leave out.
    pub fn left_out_of<'a>(years: impl IntoIterator<Item = &'a Self>) -> BTreeMap<CissLeftOut, usize> {
        let mut all = BTreeMap::new();
        for (reason, count) in years.into_iter().flat_map(|year| &year.left_out) {
            *all.entry(*reason).or_insert(0) += count;
        }
        all
    }

    /// The table as comma-separated values, for [`read`](crate::read) and
    /// [`read_objects`](crate::read_objects).
    #[must_use]
    pub fn csv(&self) -> String {
        Self::csv_of(self.is_of_objects, [self])
    }

    /// The crashes of several years as one table.
    pub fn csv_of<'a>(is_of_objects: bool, years: impl IntoIterator<Item = &'a Self>) -> String {
        Self::table(is_of_objects, years.into_iter().flat_map(|year| &year.rows).map(Vec::as_slice))
    }

    fn table<'a>(is_of_objects: bool, rows: impl IntoIterator<Item = &'a [CissCell]>) -> String {
        let header: Vec<_> = Self::columns(is_of_objects).into_iter().map(|column| column.name).collect();
        let mut text = header.join(",") + "\n";
        for row in rows {
            let cells: Vec<_> = row.iter().map(CissCell::to_string).collect();
            text.push_str(&cells.join(","));
            text.push('\n');
        }
        text
    }
}
