//! `[vehicle1]`, `[vehicle2]` and their damage.

use super::tree::{Reader, Table};
use super::values::{Place, hour_of, named};
use crate::case_problem::{CLASS_FORMS, CaseProblem, counted};
use crate::node::Node;
use crate::quantity::{Limit, format_limit, shorten};
use crate::schema::{MOST_ZONES, NEVER_BESIDE_EES, NEVER_FIXED};
use crash3::{CrushError, ObliqueCorrection};
use inputs::{
    ContactPoint, Crush, Dimension, FLEET_STIFFNESS, Fit, GivenEes, GivenTest, GivenVehicle, KnownEnergy,
    Mass, OBLIQUE_CORRECTIONS, Outline, Pdof, Quantity, SIDES, StiffnessForm, StiffnessLine,
    TypicalStiffness, UNDAMAGED, VehicleKind, Velocity, YawInertia, format_number,
};

/// Why a crush from the force balance lacks a key, and what to remove if that is wrong.
const INFERRED: [&str; 2] =
    ["takes its crush from the force balance", "from_force_balance = true if the damage was measured"];

fn cannot_give(table: &Table<'_>, key: &'static str, [because, instead]: [&'static str; 2]) -> CaseProblem {
    CaseProblem::CannotGive { table: table.label(), key, because, instead }
}

/// (–) maximum relative difference between width and sum of the spacing: both are read from a tape.
const WIDTH_TOLERANCE: f64 = 1e-3;

impl<'t> Reader<'t> {
    pub(super) fn vehicle(&mut self, top: &Table<'t>, key: &'static str) -> Option<GivenVehicle> {
        if !top.has(key) {
            // The damage of one vehicle is enough for a case; each purpose reports if it needs the other.
            // A case may also consist of `[avoid]` alone.
            if key == "vehicle2" && top.has("vehicle1") || top.has("avoid") {
                return Some(GivenVehicle::default());
            }
            self.missing(top, key);
            return None;
        }
        let table = self.child(top, key)?;
        let fixed = self.flag(&table, "fixed");
        if fixed {
            self.excluded(&table, &NEVER_FIXED, ["is fixed", "fixed = true if this vehicle can move"]);
        }
        let (crush, energy) = self.damage(&table);
        let mut vehicle = GivenVehicle {
            name: self.text(&table, "name"),
            fixed,
            kind: self.choice(&table, "kind", &VehicleKind::WORDS),
            mass: self.mass(&table),
            yaw: self.yaw(&table),
            class: self.class(&table),
            model_year: Place::of_key(&table, "model_year")
                .and_then(|place| self.counted(&place, &table, "model_year")),
            wheelbase: self.quantity(&table, "wheelbase"),
            track: self.quantity(&table, "track"),
            cg_to_front_axle: self.quantity(&table, "cg_to_front_axle"),
            length: None,
            heading: self.quantity(&table, "heading"),
            sideslip: self.sideslip(&table),
            position: self.place_of(&table, "position"),
            contact: self.contact(&table),
            motion: self.motion(&table),
            yaw_rate: self.quantity(&table, "yaw_rate"),
            outline: self.outline(&table, fixed),
            diameter: self.diameter(&table, fixed),
            deformation_energy: self.of_object(&table, "deformation_energy", fixed),
            crush,
            energy,
            before: self.before(&table),
            after: self.after(&table),
            recorder: self.recorder(&table),
            certain_speed: self.certain_speed(&table),
        };
        if vehicle.outline.is_none() && length_alone(&table) {
            vehicle.length = self.quantity(&table, "length");
        }
        Some(vehicle)
    }

    fn class(&mut self, table: &Table<'t>) -> Option<u8> {
        let place = Place { example: CLASS_FORMS, ..Place::of_key(table, "class")? };
        self.counted(&place, table, "class")
    }

    fn mass(&mut self, table: &Table<'t>) -> Option<Mass> {
        self.not_both(table, "mass", "weight");
        let mass = self.quantity(table, "mass").map(Mass::Mass);
        let weight = self.quantity(table, "weight").map(Mass::Weight);
        mass.or(weight)
    }

    fn yaw(&mut self, table: &Table<'t>) -> Option<YawInertia> {
        self.not_both(table, "yaw_inertia", "yaw_radius");
        let inertia = self.quantity(table, "yaw_inertia");
        let radius = self.quantity(table, "yaw_radius");
        inertia.map(YawInertia::Inertia).or(radius.map(YawInertia::Radius))
    }

    fn contact(&mut self, vehicle: &Table<'t>) -> Option<ContactPoint> {
        const FORMS: &str = "contact = { distance = \"6.3 ft\", angle = \"-22.4 deg\" } or contact = { x = \"1.78 m\", y = \"-0.73 m\" }";
        let table = self.inline(vehicle, "contact", FORMS)?;
        let keys = ["distance", "angle", "x", "y"];
        let [distance, angle, x, y] = keys.map(|key| self.quantity(&table, key));
        match table.given(&keys)[..] {
            ["distance", "angle"] => Some(ContactPoint::Polar { distance: distance?, angle: angle? }),
            ["x", "y"] => Some(ContactPoint::Cartesian { x: x?, y: y? }),
            _ => self.no_form(&table, FORMS),
        }
    }

    fn sideslip(&mut self, vehicle: &Table<'t>) -> Option<Quantity> {
        // A velocity vector already has a direction.
        self.not_both(vehicle, "velocity", "sideslip");
        self.quantity(vehicle, "sideslip")
    }

    fn motion(&mut self, vehicle: &Table<'t>) -> Option<Velocity> {
        const FORMS: &str =
            "velocity = { x = \"-75 ft/s\", y = \"0 ft/s\" } or, along the heading, speed = \"75 ft/s\"";
        self.not_both(vehicle, "speed", "velocity");
        let speed = self.quantity(vehicle, "speed").map(Velocity::Speed);
        let Some(table) = self.inline(vehicle, "velocity", FORMS) else {
            return speed;
        };
        let [x, y] = ["x", "y"].map(|key| self.quantity(&table, key));
        match table.given(&["x", "y"])[..] {
            ["x", "y"] => Some(Velocity::Vector { x: x?, y: y? }),
            _ => self.no_form(&table, FORMS),
        }
    }

    fn outline(&mut self, table: &Table<'t>, fixed: bool) -> Option<Outline> {
        if length_alone(table) {
            return None;
        }
        let keys = ["length", "width", "cg_to_front"];
        let given = table.given(&keys);
        let missing: Vec<_> = keys.into_iter().filter(|key| !given.contains(key)).collect();
        if let ([first, ..], [_, ..]) = (&given[..], &missing[..]) {
            let path = table.path_of(first);
            self.report_path(&path, CaseProblem::HalfOutline { table: table.label(), given, missing });
        }
        let [length, width, cg_to_front] = keys.map(|key| self.quantity(table, key));
        let outline = Outline { length: length?, width: width?, cg_to_front: cg_to_front? };
        let Outline { length, cg_to_front, .. } = &outline;
        if !fixed && cg_to_front.si() >= length.si() {
            let message = format!(
                "the centre of gravity, {cg_to_front} behind the front, lies behind the rear of a vehicle {length} long"
            );
            let help = "check both: `cg_to_front` is less than `length`";
            self.refuse::<()>(&table.path_of("cg_to_front"), message, help);
        }
        Some(outline)
    }

    fn diameter(&mut self, table: &Table<'t>, fixed: bool) -> Option<Quantity> {
        if let [key, ..] = table.given(&["length", "width", "cg_to_front"])[..] {
            self.not_both(table, "diameter", key);
        }
        self.of_object(table, "diameter", fixed)
    }

    /// A quantity that only a fixed object has.
    fn of_object(&mut self, table: &Table<'t>, key: &'static str, fixed: bool) -> Option<Quantity> {
        if table.has(key) && !fixed {
            let message = format!("{} gives \"{key}\", which only a fixed object has", table.label());
            let instead = match key {
                "diameter" => "give length, width and cg_to_front instead",
                _ => "give its crush instead",
            };
            let help = format!("for a tree, a pole or a barrier, add fixed = true; for a vehicle, {instead}");
            self.refuse::<()>(&table.path_of(key), message, &help);
        }
        self.quantity(table, key)
    }

    /// The crush, or only its energy.
    fn damage(&mut self, vehicle: &Table<'t>) -> (Option<Crush>, Option<KnownEnergy>) {
        const FORMS: &str =
            "a table [vehicle1.crush], or crush = \"none\" for a vehicle without damage that counts";
        if vehicle.get("crush").is_some_and(|value| !value.get_ref().is_table()) {
            let undamaged =
                self.choice_among(vehicle, "crush", &[(UNDAMAGED, KnownEnergy::Undamaged)], FORMS);
            return (None, undamaged);
        }
        let Some(table) = self.child(vehicle, "crush") else { return (None, None) };
        if !table.has("ees") {
            return (self.crush(&table), None);
        }
        let why = ["gives \"ees\"", "ees if the energy is to follow from the crush depths"];
        self.excluded(&table, &NEVER_BESIDE_EES, why);
        let ees = self.quantity(&table, "ees");
        let side = self.choice(&table, "side", &SIDES);
        let pdof = self.pdof(&table);
        let moment_arm = self.quantity(&table, "moment_arm");
        (None, ees.map(|ees| KnownEnergy::Ees(GivenEes { ees, side, pdof, moment_arm })))
    }

    fn crush(&mut self, table: &Table<'t>) -> Option<Crush> {
        let from_force_balance = self.flag(table, "from_force_balance");
        if from_force_balance {
            self.require(table, &["side", "stiffness"]);
            self.excluded(table, &["depths", "spacing"], INFERRED);
        } else {
            self.require(table, &["side", "depths", "stiffness"]);
            if !table.has("spacing") {
                self.require(table, &["width"]);
            }
        }
        let side = self.choice(table, "side", &SIDES);
        let width = self.quantity(table, "width");
        let depths = self.quantities(table, "depths");
        let spacing = self.quantities(table, "spacing");
        self.profile(table, width, depths.as_deref(), spacing.as_deref());
        let stiffness = self.stiffness(table);
        if let Some(StiffnessForm::Zones(zones)) = &stiffness {
            let path = format!("{}.zones", table.path_of("stiffness"));
            match depths.as_ref().map(Vec::len) {
                _ if from_force_balance => {
                    self.report_path(&path, cannot_give(table, "zones", INFERRED));
                }
                Some(stations) if stations >= 2 && zones.len() != stations - 1 => {
                    let (zones, needed) = (counted(zones.len(), "zone"), stations - 1);
                    let message =
                        format!("\"{path}\" has {zones} for {stations} depths, but {needed} are needed");
                    let help = "each zone lies between two neighbouring stations, so give one fewer than there are depths, in the same order";
                    self.refuse::<()>(&path, message, help);
                }
                _ => {}
            }
        }
        let [offset, oblique_angle, moment_arm] =
            ["offset", "oblique_angle", "moment_arm"].map(|key| self.quantity(table, key));
        let pdof = self.pdof(table);
        let oblique = self.oblique(table);
        let depths = if from_force_balance { Vec::new() } else { depths? };
        Some(Crush {
            side: side?,
            from_force_balance,
            width,
            depths,
            spacing,
            stiffness: stiffness?,
            offset,
            pdof,
            oblique_angle,
            moment_arm,
            oblique,
        })
    }

    /// Checks that depths and widths match, in number and in size.
    fn profile(
        &mut self,
        table: &Table<'t>,
        width: Option<Quantity>,
        depths: Option<&[Quantity]>,
        spacing: Option<&[Quantity]>,
    ) {
        let stations = depths.map(<[Quantity]>::len);
        if let Some(count @ 0..2) = stations {
            let path = table.path_of("depths");
            let message =
                format!("\"{path}\" has {}, but a profile needs at least two", counted(count, "station"));
            self.refuse::<()>(&path, message, "give at least the depths at both ends of the damage");
            return;
        }
        let Some(spacing) = spacing else { return };
        if let Some(stations) = stations
            && spacing.len() + 1 != stations
        {
            let path = table.path_of("spacing");
            let (widths, needed) = (spacing.len(), stations - 1);
            let message =
                format!("\"{path}\" has {widths} widths for {stations} depths, but {needed} are needed");
            let help = "give the widths between neighbouring stations, one fewer than there are depths; leave spacing out if the stations \
                        are equally spaced";
            self.refuse::<()>(&path, message, help);
            return;
        }
        let sum: f64 = spacing.iter().map(Quantity::si).sum();
        if let Some(width) = width
            && differ(&width, sum, WIDTH_TOLERANCE)
        {
            // Six digits show any difference beyond the tolerance, and hide the sum's rounding.
            let in_unit = format!("{:.5e}", sum / width.unit().factor());
            let digits = in_unit.parse::<f64>().map_or(in_unit, format_number);
            let path = table.path_of("width");
            let message =
                format!("\"{path}\" is {width}, but the spacing adds up to {digits} {}", width.unit());
            self.refuse::<()>(&path, message, "make the two agree to within 0.1 %, or leave the width out");
        }
    }

    /// An angle, or the hour of a clock.
    fn pdof(&mut self, crush: &Table<'t>) -> Option<Pdof> {
        let value = crush.get("pdof")?;
        let hour = match value.get_ref() {
            Node::String(text) => {
                text.trim_end().strip_suffix("o'clock").or_else(|| text.trim_end().strip_suffix("o’clock"))
            }
            _ => None,
        };
        let Some(hour) = hour else {
            if let Some(text) = value.get_ref().as_str().filter(|text| is_like_a_clock(text)) {
                let digits = text.trim_start().trim_start_matches('0');
                let end = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
                let hour = hour_of(&digits[..end]);
                let text = shorten(text);
                let path = crush.path_of("pdof");
                return self.unread(value, CaseProblem::HourForm { path, text, hour });
            }
            return self.quantity(crush, "pdof").map(Pdof::Angle);
        };
        match hour.trim().parse::<u8>() {
            Ok(hour @ 1..=12) => Some(Pdof::Clock(hour)),
            _ => {
                let text = shorten(&format!("{hour}o'clock"));
                self.unread(value, CaseProblem::NotAnHour { path: crush.path_of("pdof"), text })
            }
        }
    }

    fn oblique(&mut self, crush: &Table<'t>) -> Option<ObliqueCorrection> {
        const FORMS: &str = "oblique = \"capped\", \"uncapped\", \"none\", \"secant\" or { friction = 0.5 }";
        if crush.get("oblique").is_some_and(|value| value.get_ref().is_table()) {
            let table = self.inline_or(crush, "oblique", "a word or a table in braces", FORMS)?;
            return match table.given(&["friction"])[..] {
                ["friction"] => self.number(&table, "friction").map(ObliqueCorrection::Friction),
                _ => self.no_form(&table, FORMS),
            };
        }
        self.choice_among(crush, "oblique", &OBLIQUE_CORRECTIONS, FORMS)
    }

    fn stiffness(&mut self, crush: &Table<'t>) -> Option<StiffnessForm> {
        const FORMS: &str = "stiffness = { d0 = \"35 lb^0.5\", d1 = \"115 lb^0.5/ft\" } or stiffness = { A = \"587 N/cm\", \
                             B = \"63.3 N/cm^2\" }, each with G = \"612 lb\" if it is known; or \"fleet\", { category = 4 }, \
                             { test = { … } } or { zones = [{ … }, …] }";
        const TEST_FORMS: &str = "test = { mass = \"1500 kg\", speed = \"56 km/h\", width = \"1.6 m\", \
                                  depths = \"42 50 54 54 50 42 cm\", no_damage_speed = \"8 km/h\" }";
        const ZONE_FORMS: &str =
            "zones = [{ A = \"587 N/cm\", B = \"63.3 N/cm^2\" }, { A = \"400 N/cm\", B = \"50 N/cm^2\" }]";
        const BESIDE_FORMS: &str = "limit and G with A and B or with d0 and d1, as in stiffness = { A = \"587 N/cm\", B = \"63.3 N/cm^2\", \
                                    limit = \"1500 N/cm\" }; a category and a test allow no other key";
        const IN_ZONE_FORMS: &str = "limit and G in the zone they belong to, as in \
                                     zones = [{ A = \"587 N/cm\", B = \"63.3 N/cm^2\", limit = \"1500 N/cm\" }, …]";
        if crush.get("stiffness").is_some_and(|value| value.get_ref().as_str().is_some()) {
            let fleet = [(FLEET_STIFFNESS, TypicalStiffness::Fleet)];
            return self.choice_among(crush, "stiffness", &fleet, FORMS).map(StiffnessForm::Typical);
        }
        let table = self.inline_or(crush, "stiffness", "\"fleet\" or a table in braces", FORMS)?;
        match table.given(&["category", "test", "zones", "A", "B", "d0", "d1", "G", "limit"])[..] {
            ["category"] => {
                let place = Place {
                    example: "stiffness = { category = 4 }; the table covers only passenger cars of the 1970s; for newer cars, write \
                              stiffness = \"fleet\"; for a van, a pickup or a truck, give A and B or a test",
                    ..Place::of_key(&table, "category")?
                };
                let category = self.counted(&place, &table, "category");
                category.map(TypicalStiffness::Category).map(StiffnessForm::Typical)
            }
            ["test"] => {
                let test = self.inline(&table, "test", TEST_FORMS)?;
                self.barrier_test(&test).map(StiffnessForm::Test)
            }
            ["zones"] => {
                let zones = self.tables(&table, "zones", ZONE_FORMS, MOST_ZONES)?;
                // Every zone is read before the first fault ends it.
                let lines: Vec<Option<StiffnessLine>> =
                    zones.iter().map(|zone| self.stiffness_line(zone, ZONE_FORMS)).collect();
                lines.into_iter().collect::<Option<_>>().map(StiffnessForm::Zones)
            }
            ["category" | "test", "G" | "limit"] | ["category" | "test", "G", "limit"] => {
                self.no_form(&table, BESIDE_FORMS)
            }
            ["zones", "G" | "limit"] | ["zones", "G", "limit"] => self.no_form(&table, IN_ZONE_FORMS),
            ["category" | "test" | "zones", ..] => self.no_form(&table, FORMS),
            _ => self.stiffness_line(&table, FORMS).map(StiffnessForm::Line),
        }
    }

    fn stiffness_line(&mut self, table: &Table<'t>, forms: &'static str) -> Option<StiffnessLine> {
        let slope = table.measure("B").map(|slope| {
            if table.has("G") {
                slope
            } else {
                slope.positive("B may be zero only if G is given, because otherwise G = A²/2B")
            }
        });
        let a = self.quantity(table, "A");
        let mut b = slope.and_then(|slope| self.quantity_as(table, "B", slope));
        // B is exactly zero or a stiffness; a tiny number is neither.
        if let Some(value) = b
            && value.number() != 0.0
            && value.si() < Dimension::StiffnessB.least_positive()
        {
            let path = table.path_of("B");
            self.report_path(&path, CaseProblem::TooSmall { path: named(&path), value });
            b = None;
        }
        let [d0, d1, g, limit] = ["d0", "d1", "G", "limit"].map(|key| self.quantity(table, key));
        let line = match table.given(&["A", "B", "d0", "d1"])[..] {
            ["A", "B"] => StiffnessLine::Crush { a: a?, b: b?, g, limit },
            ["d0", "d1"] => StiffnessLine::Root { d0: d0?, d1: d1?, g, limit },
            _ => return self.no_form(table, forms),
        };
        if let Err(error) = line.stiffness() {
            let path = table.path_of("limit");
            let (message, help) = match (error, limit) {
                (CrushError::LimitBelowStart { a, .. }, Some(limit)) => {
                    let start = match &line {
                        StiffnessLine::Crush { a, .. } => format!("A = {a}"),
                        StiffnessLine::Root { .. } => {
                            format!("A = d0·d1 = {}", format_limit(a, limit.unit(), Limit::Least))
                        }
                    };
                    let message =
                        format!("\"{path}\" is {limit}, but must be at least {start}, where crush begins");
                    (message, "raise the limit, or leave it out if none is known")
                }
                _ => (error.to_string(), "check the numbers and their units"),
            };
            return self.refuse(&path, message, help);
        }
        Some(line)
    }

    fn barrier_test(&mut self, table: &Table<'t>) -> Option<GivenTest> {
        self.require(table, &["speed", "width", "depths", "no_damage_speed"]);
        if !table.has("weight") {
            self.require(table, &["mass"]);
        }
        let mass = self.mass(table);
        let [speed, width, no_damage_speed] =
            ["speed", "width", "no_damage_speed"].map(|key| self.quantity(table, key));
        let depths = self.quantities(table, "depths");
        self.profile(table, width, depths.as_deref(), None);
        let fit = self.choice(table, "fit", &Fit::WORDS);
        let depths = depths.filter(|depths| depths.len() >= 2)?;
        let test = GivenTest {
            mass: mass?,
            speed: speed?,
            width: width?,
            depths,
            no_damage_speed: no_damage_speed?,
            fit: fit.unwrap_or_default(),
        };
        if let Err(error) = test.stiffness() {
            let (key, message, help) = match error {
                CrushError::NoDamageSpeed { .. } => (
                    "no_damage_speed",
                    format!(
                        "\"{}\" is {}, but must be less than the test speed of {}, because the test left crush",
                        table.path_of("no_damage_speed"),
                        test.no_damage_speed,
                        test.speed
                    ),
                    "give the highest speed that leaves no crush, which is below the test speed",
                ),
                CrushError::NoCrushInTest => {
                    ("depths", error.to_string(), "give the residual crush measured after the test")
                }
                _ => ("speed", error.to_string(), "check the numbers and their units"),
            };
            return self.refuse(&table.path_of(key), message, help);
        }
        Some(test)
    }

    /// Reports the keys that the table has, but cannot have.
    fn excluded(&mut self, table: &Table<'t>, keys: &[&'static str], why: [&'static str; 2]) {
        for key in table.given(keys) {
            self.report_path(&table.path_of(key), cannot_give(table, key, why));
        }
    }

    pub(super) fn not_both(&mut self, table: &Table<'t>, first: &'static str, second: &'static str) {
        let (Some(one), Some(other)) = (table.get(first), table.get(second)) else { return };
        // The later of the two is the one that surprises.
        let later = if one.span().start > other.span().start { one } else { other };
        self.report(later.span(), CaseProblem::Both { table: table.label(), first, second });
    }
}

/// Whether a text is a time of day, names the clock or the hour, or is a Collision Deformation Classification
/// (SAE J224), which begins with the hour: "11FDEW2".
fn is_like_a_clock(text: &str) -> bool {
    let is_cdc = matches!(text.trim().as_bytes(), [d1, d2, letters @ .., extent]
        if [d1, d2, extent].iter().all(|byte| byte.is_ascii_digit())
            && letters.len() == 4
            && letters.iter().all(u8::is_ascii_alphabetic));
    let is_time = text.trim().split_once(':').is_some_and(|(hours, minutes)| {
        [hours, minutes].iter().all(|part| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit()))
    });
    let lower = text.trim().to_lowercase();
    let is_hour =
        ["uhr", "hour", "hours", "h"].contains(&lower.trim_start_matches(|c: char| !c.is_alphabetic()));
    is_cdc || is_time || is_hour || lower.contains("clock")
}

/// Whether the length is given without the rest of the outline, for the yaw inertia.
fn length_alone(table: &Table<'_>) -> bool {
    table.has("wheelbase") && table.given(&["length", "width", "cg_to_front"]) == ["length"]
}

/// Whether two quantities of one dimension differ by more than the share `tolerance` of the first.
fn differ(first: &Quantity, second_si: f64, tolerance: f64) -> bool {
    (first.si() - second_si).abs() > tolerance * first.si()
}
