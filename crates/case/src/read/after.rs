//! `[vehicleN.before]` and `[vehicleN.after]`: the motion before and after the impact.

use super::tree::{Reader, Table};
use super::values::Place as Position;
use crate::node::Node;
use crate::schema::{MOST_ZONES, WHEELS};
use inputs::{
    After, Before, Drag, GivenPhase, GivenRest, GivenSteer, MarkedWheel, PathPoint, PhaseForm, Place,
    RestHeading, Skid, SkidBegin, SteerPoint, WheelDrag,
};

const DRAGS: &str = "drag = 0.02, drag = \"locked\" or, front left, front right, rear left, rear right, \
                     drag = [0.02, \"locked\", 0.02, 0.02]";

impl<'t> Reader<'t> {
    pub(super) fn before(&mut self, vehicle: &Table<'t>) -> Option<Before> {
        let table = self.child(vehicle, "before")?;
        let phases = self.phases(&table);
        if !table.has("phase") {
            self.require(&table, &["skid"]);
        }
        let speed = self.quantity(&table, "speed");
        let skid = self.skid(&table);
        self.not_both(&table, "skid", "phase");
        if table.has("speed") && !table.has("skid") && table.has("phase") {
            let message = format!("{} gives \"speed\" without \"skid\"", table.label());
            let help = "`speed` of this table is that where a skid begins; a phase has a `speed` of its own";
            self.refuse::<()>(&table.path_of("speed"), message, help);
        }
        (skid.is_some() || !phases.is_empty()).then_some(Before { skid, speed, phases })
    }

    fn phases(&mut self, before: &Table<'t>) -> Vec<GivenPhase> {
        const FORMS: &str =
            "a table [[vehicle1.before.phase]] with two of distance, time, speed and acceleration";
        let tables = self.tables(before, "phase", FORMS, MOST_ZONES).unwrap_or_default();
        let phase = |table: &Table<'t>| {
            self.not_empty(table, FORMS);
            let [distance, time, speed, acceleration] =
                ["distance", "time", "speed", "acceleration"].map(|key| self.quantity(table, key));
            GivenPhase {
                form: PhaseForm { distance, time, speed, acceleration },
                source: self.text(table, "source"),
            }
        };
        tables.iter().map(phase).collect()
    }

    fn skid(&mut self, before: &Table<'t>) -> Option<Skid> {
        const FORMS: &str = "skid = { length = \"18 m\", friction = 0.7 } or skid = { from = { x = \"18 m\", y = \"15 m\" }, friction = 0.7 }";
        let skid = self.inline(before, "skid", FORMS)?;
        let length = self.quantity(&skid, "length");
        let from = self.place_of(&skid, "from");
        let friction = self.number(&skid, "friction");
        let begin = match skid.given(&["length", "from"])[..] {
            ["length"] => SkidBegin::Length(length?),
            ["from"] => SkidBegin::From(from?),
            [] => {
                self.require(&skid, &["length"]);
                return None;
            }
            _ => return self.no_form(&skid, FORMS),
        };
        Some(Skid { begin, friction })
    }

    /// Reads the table; one without a key counts as absent.
    pub(super) fn after(&mut self, vehicle: &Table<'t>) -> Option<After> {
        let table = self.child(vehicle, "after")?;
        let after = After {
            friction: self.number(&table, "friction"),
            drag: self.drag(&table),
            steer: self.steer(&table),
            rest: self.rest(&table),
            points: self.points(&table),
            speed: self.quantity(&table, "speed"),
            direction: self.quantity(&table, "direction"),
            yaw_rate: self.quantity(&table, "yaw_rate"),
        };
        if table.has("speed") && !table.has("direction") && !table.means("direction") {
            let message = format!("{} gives \"speed\", but not \"direction\"", table.label());
            let help = "add the direction in which the CG moved after the impact, as in direction = \"35 deg\"; \
                        the speed before the impact belongs in the table of the vehicle";
            self.refuse::<()>(&table.path_of("speed"), message, help);
        }
        (after != After::default()).then_some(after)
    }

    fn drag(&mut self, after: &Table<'t>) -> Option<Drag> {
        let place = Position::of_key(after, "drag")?;
        let Some(list) = place.node().as_array() else {
            return self.wheel_drag(after, &place).map(Drag::Every);
        };
        // Every wheel is read before the first fault ends it.
        let wheel = |(index, value)| self.wheel_drag(after, &place.element(index, value));
        let wheels: Vec<Option<WheelDrag>> = list.iter().enumerate().map(wheel).collect();
        let Ok(wheels) = <[Option<WheelDrag>; WHEELS]>::try_from(wheels) else {
            let message = format!("{} has {} values, but a vehicle has four wheels", place.name, list.len());
            return self.refuse(&place.path, message, &format!("write {DRAGS}"));
        };
        let [Some(front_left), Some(front_right), Some(rear_left), Some(rear_right)] = wheels else {
            return None;
        };
        Some(Drag::Each([front_left, front_right, rear_left, rear_right]))
    }

    fn wheel_drag(&mut self, after: &Table<'t>, place: &Position<'t>) -> Option<WheelDrag> {
        match place.node() {
            Node::String(word) => self.word(place.value, place.path.clone(), word, &WheelDrag::WORDS, DRAGS),
            _ => self.number_at(place, "drag", after.bounds("drag")?).map(WheelDrag::Share),
        }
    }

    fn steer(&mut self, after: &Table<'t>) -> Option<GivenSteer> {
        const FORMS: &str = "steer = \"5 deg\" or steer = [{ time = \"0 s\", angle = \"0 deg\" }, { time = \"0.5 s\", angle = \"5 deg\" }]";
        let value = after.get("steer")?;
        if !value.get_ref().is_array() {
            return self.quantity(after, "steer").map(GivenSteer::Held);
        }
        let tables = self.tables(after, "steer", FORMS, MOST_ZONES)?;
        if tables.is_empty() {
            let path = after.path_of("steer");
            let help = format!("write {FORMS}, or leave it out if the wheels are straight");
            return self.refuse(&path, format!("\"{path}\" is an empty list"), &help);
        }
        let points: Vec<Option<SteerPoint>> = tables
            .iter()
            .map(|table| {
                self.require(table, &["time", "angle"]);
                let [time, angle] = ["time", "angle"].map(|key| self.quantity(table, key));
                Some(SteerPoint { time: time?, angle: angle? })
            })
            .collect();
        let points: Vec<SteerPoint> = points.into_iter().collect::<Option<_>>()?;
        for (pair, table) in points.windows(2).zip(&tables[1..]) {
            if let [before, point] = pair
                && point.time.si() <= before.time.si()
            {
                let path = table.path_of("time");
                let message = format!(
                    "\"{path}\" is {}, but must be later than the {} before it",
                    point.time, before.time
                );
                return self.refuse(
                    &path,
                    message,
                    "list the steer angles in the order of time, each time once",
                );
            }
        }
        Some(GivenSteer::Over(points))
    }

    fn rest(&mut self, after: &Table<'t>) -> Option<GivenRest> {
        const FORMS: &str = "rest = { x = \"31.2 m\", y = \"9.8 m\", heading = \"140 deg\" }, or turned = \"-220 deg\" in place of heading, if it is \
                             known which way and how often it turned";
        let table = self.inline(after, "rest", FORMS)?;
        let [x, y, heading, turned] = ["x", "y", "heading", "turned"].map(|key| self.quantity(&table, key));
        let heading = match table.given(&["x", "y", "heading", "turned"])[..] {
            ["x", "y", "heading"] => RestHeading::Heading(heading?),
            ["x", "y", "turned"] => RestHeading::Turned(turned?),
            _ => return self.no_form(&table, FORMS),
        };
        Some(GivenRest { place: Place { x: x?, y: y? }, heading })
    }

    fn points(&mut self, after: &Table<'t>) -> Vec<PathPoint> {
        const FORMS: &str = "points = [{ x = \"18.0 m\", y = \"5.5 m\" }, { x = \"25.1 m\", y = \"8.3 m\" }]";
        let tables = self.tables(after, "points", FORMS, MOST_ZONES).unwrap_or_default();
        tables
            .iter()
            .filter_map(|table| {
                let (place, heading) = (self.place(table), self.quantity(table, "heading"));
                let wheel = self.choice(table, "wheel", &MarkedWheel::WORDS);
                Some(PathPoint { place: place?, heading, wheel })
            })
            .collect()
    }
}
