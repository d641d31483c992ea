//! Selects the crashes of a year that can be judged.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;

use super::cell::CissCell;
use super::error::CissError;
use super::found::{CissCrashes, CissLeftOut, CissTable, OBJECT, of_vehicle};
use super::table::{CDC, CRASH, CissFiles, EDREVENT, EVENT, GV, Row, Rows};

/// CASEID and EVENTNO.
type Event = [i64; 2];
/// VEHNO.
type Vehicle = i64;

/// The tables of a year.
struct Tables {
    crash: Rows,
    gv: Rows,
    cdc: Rows,
    edrevent: Rows,
    /// Only used if CDC does not give what each vehicle struck.
    event: Option<Rows>,
}

/// The pairs of vehicles of a year, in the order of crash, event and vehicle.
///
/// A pair is two vehicles with damage by one event; each names the other as the object that it struck
/// (OBJCONT of CDC, or of EVENT if CDC has no such column). It is kept if the damage of both is on front,
/// back, left or right with all of C1 to C6, a length and a PDOF; if both have a curb weight; if a recorder
/// of one has a ΔV of this event (CDCEVENT), where the largest of several records counts; and if no number is
/// implausible.
///
/// # Errors
/// If a table or a column is missing, or a cell is not a number, with file, line and column.
pub fn pairs<F: CissFiles>(files: &mut F) -> Result<CissCrashes, F::Error> {
    Ok(found(&Tables::read(files)?, false)?)
}

/// The vehicles of a year that struck a fixed object (OBJCONT 31 to 97), by the rules of [`pairs`]; a PDOF is
/// not needed.
///
/// # Errors
/// Those of [`pairs`].
pub fn objects<F: CissFiles>(files: &mut F) -> Result<CissCrashes, F::Error> {
    Ok(found(&Tables::read(files)?, true)?)
}

impl Tables {
    fn read<F: CissFiles>(files: &mut F) -> Result<Self, F::Error> {
        let crash = Rows::read(files, &CRASH, |_| true)?;
        let gv = Rows::read(files, &GV, |_| true)?;
        let cdc = Rows::read(files, &CDC, |_| true)?;
        let edrevent = Rows::read(files, &EDREVENT, |_| true)?;
        let event = if cdc.has(OBJECT) { None } else { Some(Rows::read(files, &EVENT, |_| true)?) };
        Ok(Self { crash, gv, cdc, edrevent, event })
    }

    fn counts(&self) -> Vec<CissTable> {
        let of = |name, rows: &Rows| CissTable { name, file: rows.file.clone(), rows: rows.count };
        let event = self.event.as_ref().map(|rows| of(EVENT.name, rows));
        let always = [(&CRASH, &self.crash), (&GV, &self.gv), (&CDC, &self.cdc), (&EDREVENT, &self.edrevent)];
        always.into_iter().map(|(table, rows)| of(table.name, rows)).chain(event).collect()
    }

    /// The damages to each vehicle by each event.
    fn damages(&self) -> BTreeMap<Event, BTreeMap<Vehicle, Vec<Row<'_>>>> {
        let mut damages: BTreeMap<Event, BTreeMap<_, Vec<_>>> = BTreeMap::new();
        for row in self.cdc.iter() {
            if let Some([crash, event, vehicle]) = row.key(["CASEID", "EVENTNO", "VEHNO"]) {
                damages.entry([crash, event]).or_default().entry(vehicle).or_default().push(row);
            }
        }
        damages
    }

    /// What each vehicle struck in each event.
    fn contacts(&self) -> BTreeSet<(Event, Vehicle, i64)> {
        let of = |row: Row<'_>, vehicle| {
            row.key(["CASEID", "EVENTNO", vehicle, OBJECT])
                .map(|[crash, event, vehicle, struck]| ([crash, event], vehicle, struck))
        };
        match &self.event {
            None => self.cdc.iter().filter_map(|row| of(row, "VEHNO")).collect(),
            // A row of EVENT is the contact of both.
            Some(events) => events
                .iter()
                .filter_map(|row| of(row, "VEHNUM"))
                .flat_map(|(event, one, other)| [(event, one, other), (event, other, one)])
                .collect(),
        }
    }

    /// The record of a vehicle's recorder for an event: if there are several, the one with the largest ΔV.
    fn recorders(&self) -> BTreeMap<(Event, Vehicle), Row<'_>> {
        let mut recorders: BTreeMap<(Event, Vehicle), Row<'_>> = BTreeMap::new();
        for row in self.edrevent.iter() {
            let Some([crash, event, vehicle]) = row.key(["CASEID", "CDCEVENT", "VEHNO"]) else { continue };
            let Some(size) = size(row) else { continue };
            let stored = recorders.entry(([crash, event], vehicle)).or_insert(row);
            if Some(size) > self::size(*stored) {
                *stored = row;
            }
        }
        recorders
    }
}

/// (km²/h²) square of the ΔV that a recorder stored; `None` if it stored none.
fn size(row: Row<'_>) -> Option<f64> {
    match ["MAXDVLONG", "MAXDVLAT"].map(|part| row.number(part)) {
        [None, None] => None,
        parts => Some(parts.into_iter().flatten().map(|part| part * part).sum()),
    }
}

/// The rows of a table by their keys.
fn by_key<'a, const N: usize>(
    rows: &'a Rows,
    table: &'static str,
    key: [&str; N],
) -> Result<BTreeMap<[i64; N], Row<'a>>, CissError> {
    let mut found = BTreeMap::new();
    for row in rows.iter() {
        let Some(of_row) = row.key(key) else { continue };
        if found.insert(of_row, row).is_some() {
            let parts = key.iter().zip(of_row).map(|(name, part)| format!("{name} {part}"));
            return Err(CissError::Rows { table, key: parts.collect::<Vec<_>>().join(", ") });
        }
    }
    Ok(found)
}

/// A vehicle that was hit, with all its data in the tables.
struct Hit<'a> {
    damages: &'a [Row<'a>],
    general: Option<Row<'a>>,
    recorder: Option<Row<'a>>,
}

impl Hit<'_> {
    fn is_any_damage(&self, is_so: impl Fn(Row<'_>) -> bool) -> bool {
        self.damages.iter().any(|damage| is_so(*damage))
    }

    fn cell(&self, column: &str) -> CissCell {
        let rows = [self.recorder, self.damages.first().copied(), self.general];
        let cell = rows.into_iter().flatten().find_map(|row| row.cell(column));
        cell.cloned().unwrap_or(CissCell::Nothing)
    }
}

/// Why a crash of these vehicles is left out, if it is.
fn why_not(vehicles: &[Hit<'_>], is_of_object: bool) -> Option<CissLeftOut> {
    let is_any = |is_so: &dyn Fn(&Hit<'_>) -> bool| vehicles.iter().any(is_so);
    let lacks = |damage: Row<'_>, column| damage.number(column).is_none();
    let is_plane = |damage: Row<'_>| matches!(damage.cell("CDCPLANE"), Some(CissCell::Text(plane)) if matches!(plane.as_str(), "F" | "B" | "L" | "R"));
    let lacks_crush = |damage: Row<'_>| {
        ["C1", "C2", "C3", "C4", "C5", "C6"].into_iter().any(|column| lacks(damage, column))
            || !["FIELDL", "DIRECTL"]
                .into_iter()
                .any(|column| damage.number(column).is_some_and(|length| length > 0.0))
    };
    let has_mass = |vehicle: &Hit<'_>| {
        vehicle.general.and_then(|row| row.number("CURBWT")).is_some_and(|mass| mass > 0.0)
    };
    let reasons: [(CissLeftOut, &dyn Fn() -> bool); 6] = [
        (CissLeftOut::SeveralDamages, &|| is_any(&|vehicle| vehicle.damages.len() > 1)),
        (CissLeftOut::Plane, &|| is_any(&|vehicle| vehicle.is_any_damage(|damage| !is_plane(damage)))),
        (CissLeftOut::Crush, &|| is_any(&|vehicle| vehicle.is_any_damage(lacks_crush))),
        (CissLeftOut::Pdof, &|| {
            !is_of_object && is_any(&|vehicle| vehicle.is_any_damage(|damage| lacks(damage, "PDOF")))
        }),
        (CissLeftOut::Mass, &|| is_any(&|vehicle| !has_mass(vehicle))),
        (CissLeftOut::Recorder, &|| !is_any(&|vehicle| vehicle.recorder.is_some())),
    ];
    reasons.into_iter().find(|(_, is_so)| is_so()).map(|(reason, _)| reason)
}

/// The rows of the tables by their keys.
struct Year<'a> {
    years: BTreeMap<[i64; 1], Row<'a>>,
    general: BTreeMap<[i64; 2], Row<'a>>,
    damages: BTreeMap<Event, BTreeMap<Vehicle, Vec<Row<'a>>>>,
    contacts: BTreeSet<(Event, Vehicle, i64)>,
    recorders: BTreeMap<(Event, Vehicle), Row<'a>>,
}

/// Vehicles of an event that may be judged, and the object that the one struck.
struct Candidate {
    event: Event,
    vehicles: Vec<Vehicle>,
    object: Option<i64>,
}

/// NHTSA's codes OBJCONT for objects that are not vehicles of the crash: those struck by the vehicles to
/// which the figures for objects were fitted.
pub const OBJECTS: RangeInclusive<i64> = 31..=97;

impl<'a> Year<'a> {
    fn of(tables: &'a Tables) -> Result<Self, CissError> {
        Ok(Self {
            years: by_key(&tables.crash, CRASH.name, ["CASEID"])?,
            general: by_key(&tables.gv, GV.name, ["CASEID", "VEHNO"])?,
            damages: tables.damages(),
            contacts: tables.contacts(),
            recorders: tables.recorders(),
        })
    }

    /// The vehicles of an event that struck each other.
    fn couples(&self, event: Event) -> Vec<Candidate> {
        let struck = |one, other| self.contacts.contains(&(event, one, other));
        let vehicles: Vec<Vehicle> =
            self.damages.get(&event).into_iter().flat_map(BTreeMap::keys).copied().collect();
        let pairs = vehicles
            .iter()
            .enumerate()
            .flat_map(|(place, one)| vehicles.iter().skip(place + 1).map(move |two| [*one, *two]));
        pairs
            .filter(|[one, two]| struck(*one, *two) && struck(*two, *one))
            .map(|couple| Candidate { event, vehicles: couple.to_vec(), object: None })
            .collect()
    }

    /// The vehicles of an event that struck an object. The lowest code of several objects is taken, which
    /// makes no difference, as a vehicle with several damages is left out.
    fn single(&self, event: Event) -> Vec<Candidate> {
        let vehicles = self.damages.get(&event).into_iter().flat_map(BTreeMap::keys);
        let object =
            |vehicle| OBJECTS.clone().find(|object| self.contacts.contains(&(event, vehicle, *object)));
        vehicles
            .filter_map(|&vehicle| {
                Some(Candidate { event, vehicles: vec![vehicle], object: Some(object(vehicle)?) })
            })
            .collect()
    }

    fn hit(&self, event: Event, vehicle: Vehicle) -> Hit<'_> {
        let damages = self.damages.get(&event).and_then(|of_event| of_event.get(&vehicle));
        Hit {
            damages: damages.map_or(&[], Vec::as_slice),
            general: self.general.get(&[event[0], vehicle]).copied(),
            recorder: self.recorders.get(&(event, vehicle)).copied(),
        }
    }

    /// The row of a candidate, or why it is left out.
    fn row(&self, candidate: &Candidate) -> Result<Result<Vec<CissCell>, CissLeftOut>, CissError> {
        let [crash, event] = candidate.event;
        let hits: Vec<_> =
            candidate.vehicles.iter().map(|vehicle| self.hit(candidate.event, *vehicle)).collect();
        if let Some(reason) = why_not(&hits, candidate.object.is_some()) {
            return Ok(Err(reason));
        }
        let of_crash = self.years.get(&[crash]).ok_or(CissError::NoCrash { crash })?;
        let year = of_crash.cell("CRASHYEAR").cloned().unwrap_or(CissCell::Nothing);
        // In the order of the columns.
        let mut row = vec![year, CissCell::Whole(crash), CissCell::Whole(event)];
        row.extend(hits.iter().flat_map(|hit| of_vehicle().map(|column| hit.cell(column))));
        row.extend(candidate.object.map(CissCell::Whole));
        Ok(Ok(row))
    }
}

fn found(tables: &Tables, is_of_objects: bool) -> Result<CissCrashes, CissError> {
    let year = Year::of(tables)?;
    let (mut rows, mut left_out) = (Vec::new(), BTreeMap::new());
    let mut leave_out = |reason| *left_out.entry(reason).or_insert(0) += 1;
    for &event in year.damages.keys() {
        let candidates = if is_of_objects { year.single(event) } else { year.couples(event) };
        for candidate in &candidates {
            match year.row(candidate)? {
                Ok(row) if CissCrashes::is_refused(&row, is_of_objects) => {
                    leave_out(CissLeftOut::Implausible);
                }
                Ok(row) => rows.push(row),
                Err(reason) => leave_out(reason),
            }
        }
    }
    Ok(CissCrashes { tables: tables.counts(), is_of_objects, rows, left_out })
}
