//! Reads a table of pairs of vehicles.

use std::collections::{BTreeSet, HashMap};

use crate::crossed;
use crate::error::FieldError;
use crate::lines::Lines;
use crate::object::{ObjectCrash, kind_of_object};
use crate::pair::{Pair, PairVehicle, Plane};

/// Reads pairs of vehicles, one per line, with the columns of CISS. If `VEHNO` identifies the vehicles of a
/// crash, records that may belong to another event are [doubted](PairVehicle::is_record_doubted).
///
/// # Errors
/// If the file is not a table of this form, with the line and the column.
pub fn read(text: &str) -> Result<Vec<Pair>, FieldError> {
    let mut pairs = Vec::new();
    for (case, cells) in crashes(text)? {
        let vehicle = |vehicle| {
            let vehicle = Some(vehicle);
            cells.damaged(vehicle, true)
        };
        pairs.push(Pair { case, vehicles: [vehicle(1)?, vehicle(2)?] });
    }
    crossed::mark(&mut pairs);
    if pairs.is_empty() { Err(FieldError::NoPairs) } else { Ok(pairs) }
}

/// Reads vehicles that struck a fixed object, one per line, with the columns of CISS; `None` if the table has
/// no column OBJCONT and so is not such a table. Only damage to the front is read: a vehicle that met an
/// object with its side or its rear did not travel along its heading, and its direction of travel is unknown.
///
/// # Errors
/// If the file is not a table of this form, with the line and the column.
pub fn read_objects(text: &str) -> Result<Option<Vec<ObjectCrash>>, FieldError> {
    if !csv::Reader::from_reader(text.as_bytes()).headers()?.iter().any(|column| column == OBJECT) {
        return Ok(None);
    }
    let mut found = Vec::new();
    for (case, cells) in crashes(text)? {
        let code = cells.text(OBJECT, None)?;
        if cells.text("CDCPLANE", None)? != "F" {
            continue;
        }
        let code = whole(code).ok_or_else(|| cells.refusal(OBJECT, None, code, "a whole number"))?;
        let has_pdof = cells.at_most(MOST_ANGLE, "PDOF", None)?.is_some();
        found.push(ObjectCrash {
            case,
            vehicle: cells.damaged(None, has_pdof)?,
            has_pdof,
            kind: kind_of_object(code),
        });
    }
    if found.is_empty() { Err(FieldError::NoObjects) } else { Ok(Some(found)) }
}

/// The column for the object that a vehicle struck.
const OBJECT: &str = "OBJCONT";

/// A whole number. Tables whose columns have gaps tend to write 1 as 1.0.
fn whole(text: &str) -> Option<u32> {
    let text = text.trim();
    text.strip_suffix(".0").unwrap_or(text).parse().ok()
}

/// (kg) largest mass, (cm) length on a vehicle, (°) angle and (km/h) speed.
const MOST_MASS: f64 = 100_000.0;
const MOST_LENGTH: f64 = 3_000.0;
const MOST_ANGLE: f64 = 720.0;
pub(crate) const MOST_SPEED: f64 = 500.0;

/// The lines of a table, by the names of their columns.
pub(crate) fn cells(text: &str) -> Result<Vec<Cells>, FieldError> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader.headers()?.clone();
    let mut columns = BTreeSet::new();
    if let Some(column) = header.iter().find(|column| !columns.insert(*column)) {
        return Err(FieldError::ColumnTwice { column: column.to_owned() });
    }
    let mut lines = Lines::of(text);
    let record = |record: csv::Result<csv::StringRecord>| {
        let record = record?;
        let columns = record.deserialize(Some(&header))?;
        Ok(Cells { line: lines.place(&record), columns })
    };
    reader.records().map(record).collect()
}

/// The lines of a table, each with the name of its crash: the number, with the year if another year has the
/// same number.
fn crashes(text: &str) -> Result<Vec<(String, Cells)>, FieldError> {
    let cells = cells(text)?;
    let year = |cells: &Cells| cells.text("YEAR", None).unwrap_or_default().to_owned();
    let mut years: HashMap<String, BTreeSet<String>> = HashMap::new();
    for cells in &cells {
        years.entry(cells.case()?.to_owned()).or_default().insert(year(cells));
    }
    let named = cells.into_iter().map(|cells| {
        let case = cells.case()?;
        let is_of_one_year = years.get(case).is_none_or(|years| years.len() == 1);
        let name = if is_of_one_year { case.to_owned() } else { format!("{case} of {}", year(&cells)) };
        Ok((name, cells))
    });
    named.collect()
}

/// The column of a vehicle of a pair, or of the one vehicle.
fn named(column: &str, vehicle: Option<u8>) -> String {
    vehicle.map_or_else(|| column.to_owned(), |vehicle| format!("{column}_{vehicle}"))
}

pub(crate) struct Cells {
    line: u64,
    columns: HashMap<String, String>,
}

impl Cells {
    /// The number of the crash.
    pub(crate) fn case(&self) -> Result<&str, FieldError> {
        let case = self.columns.get("CASEID").map(String::as_str);
        case.ok_or(FieldError::NoColumn { column: "CASEID".to_owned() })
    }

    pub(crate) fn text(&self, column: &str, vehicle: Option<u8>) -> Result<&str, FieldError> {
        let column = named(column, vehicle);
        match self.columns.get(&column) {
            Some(text) => Ok(text.trim()),
            None => Err(FieldError::NoColumn { column }),
        }
    }

    fn maybe(&self, column: &str, vehicle: Option<u8>) -> Result<Option<f64>, FieldError> {
        let text = self.text(column, vehicle)?;
        if text.is_empty() {
            return Ok(None);
        }
        match text.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(Some(number)),
            _ => Err(self.refusal(column, vehicle, text, "a number, or nothing where it is missing")),
        }
    }

    /// A number of at most this size, of either sign: no vehicle has more.
    pub(crate) fn at_most(
        &self,
        most: f64,
        column: &str,
        vehicle: Option<u8>,
    ) -> Result<Option<f64>, FieldError> {
        match self.maybe(column, vehicle)? {
            Some(number) if number.abs() > most => {
                let wanted = "a plausible number in this column: correct it, or leave its line out";
                Err(self.refusal(column, vehicle, self.text(column, vehicle)?, wanted))
            }
            number => Ok(number),
        }
    }

    fn number(&self, column: &str, vehicle: Option<u8>) -> Result<f64, FieldError> {
        let wanted = "a number: without it the pair cannot be judged, so leave its line out";
        let most = match column {
            "CURBWT" => MOST_MASS,
            "PDOF" => MOST_ANGLE,
            _ => MOST_LENGTH,
        };
        self.at_most(most, column, vehicle)?.ok_or_else(|| self.refusal(column, vehicle, "", wanted))
    }

    pub(crate) fn refusal(
        &self,
        column: &str,
        vehicle: Option<u8>,
        text: &str,
        wanted: &'static str,
    ) -> FieldError {
        let (line, column, text) = (self.line, named(column, vehicle), text.to_owned());
        FieldError::Cell { line, column, text, wanted }
    }

    /// Its number in the crash; `None` without the column.
    fn vehicle_number(&self, vehicle: Option<u8>) -> Result<Option<u32>, FieldError> {
        match self.text("VEHNO", vehicle) {
            Err(_) | Ok("") => Ok(None),
            Ok(text) => whole(text).map(Some).ok_or_else(|| {
                self.refusal("VEHNO", vehicle, text, "a whole number, or nothing where it is missing")
            }),
        }
    }

    /// (m) the depths of a vehicle.
    pub(crate) fn depths(&self, vehicle: Option<u8>) -> Result<[f64; 6], FieldError> {
        let mut depths = [0.0; 6];
        for (depth, column) in depths.iter_mut().zip(["C1", "C2", "C3", "C4", "C5", "C6"]) {
            // Outward bulges do not count as crush.
            *depth = (self.number(column, vehicle)? / 100.0).max(0.0);
        }
        Ok(depths)
    }

    /// A vehicle with the depths of the table.
    fn damaged(&self, vehicle: Option<u8>, has_pdof: bool) -> Result<PairVehicle, FieldError> {
        let found = self.vehicle_with(vehicle, has_pdof, || self.depths(vehicle))?;
        let has_length =
            [found.field_length, found.direct_length].into_iter().flatten().any(|length| length > 0.0);
        if found.plane.is_side() || has_length {
            return Ok(found);
        }
        let wanted = "a length above 0 cm, and neither is DIRECTL: without the length of the damage it cannot be judged, so \
                      leave its line out";
        Err(self.refusal("FIELDL", vehicle, self.text("FIELDL", vehicle)?, wanted))
    }

    /// A vehicle with these depths (m).
    pub(crate) fn vehicle_with(
        &self,
        vehicle: Option<u8>,
        has_pdof: bool,
        depths: impl FnOnce() -> Result<[f64; 6], FieldError>,
    ) -> Result<PairVehicle, FieldError> {
        let plane = match self.text("CDCPLANE", vehicle)? {
            "F" => Plane::Front,
            "B" => Plane::Rear,
            "L" => Plane::Left,
            "R" => Plane::Right,
            other => {
                let wanted = "F, B, L or R: front, rear, left or right; leave lines of other planes out";
                return Err(self.refusal("CDCPLANE", vehicle, other, wanted));
            }
        };
        let curb_mass = self.number("CURBWT", vehicle)?;
        if curb_mass <= 0.0 {
            return Err(self.refusal("CURBWT", vehicle, &curb_mass.to_string(), "a mass above 0 kg"));
        }
        let centimetres =
            |column| Ok::<_, FieldError>(self.at_most(MOST_LENGTH, column, vehicle)?.map(|cm| cm / 100.0));
        let kmh =
            |column| Ok::<_, FieldError>(self.at_most(MOST_SPEED, column, vehicle)?.map(|kmh| kmh / 3.6));
        let depths = depths()?;
        // Columns that a table may lack.
        let size = |column| match self.text(column, vehicle) {
            Ok(_) => Ok(centimetres(column)?.filter(|metres| *metres > 0.0)),
            Err(_) => Ok::<_, FieldError>(None),
        };
        Ok(PairVehicle {
            number: self.vehicle_number(vehicle)?,
            curb_mass,
            // NHTSA's codes for unknown loads are above any load.
            cargo: self.at_most(MOST_MASS, "CARGOWT", vehicle)?,
            plane,
            length: size("OAL")?,
            width: size("MAXWIDTH")?,
            pdof: if has_pdof { self.number("PDOF", vehicle)?.to_radians() } else { 0.0 },
            // NHTSA's codes for missing headings are above 360.
            heading: self.maybe("HEADINGANG", vehicle)?.filter(|h| h.abs() <= 360.0).map(f64::to_radians),
            field_length: centimetres("FIELDL")?,
            direct_length: centimetres("DIRECTL")?,
            direct_offset: centimetres("DIRECTD")?,
            depths,
            winsmash: [kmh("DVTOTAL")?, kmh("DVLONG")?],
            recorder: [kmh("MAXDVLONG")?, kmh("MAXDVLAT")?],
            is_record_doubted: false,
            category: None,
        })
    }
}
