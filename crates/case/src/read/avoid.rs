//! `[avoid]`.

use super::scene::OF_OBSTACLE;
use super::tree::{Reader, Table};
use crate::schema::MOST_ZONES;
use inputs::{
    Avoid, Clear, GivenDemand, GivenSight, GivenWayOut, Obstacle, OtherApproach, OtherParty, SUBJECTS,
    SWELLS, Text,
};

impl<'t> Reader<'t> {
    pub(super) fn avoid(&mut self, table: &Table<'t>) -> Avoid {
        let (demand, demand_reason) = self.demand(table);
        Avoid {
            vehicle: self.choice(table, "vehicle", &SUBJECTS),
            speed: self.sourced(table, "speed"),
            limit: self.sourced(table, "limit"),
            reaction_time: self.sourced(table, "reaction_time"),
            swell: self.sourced(table, "swell"),
            swell_form: self.choice(table, "swell_form", &SWELLS),
            deceleration: self.sourced(table, "deceleration"),
            demand,
            demand_reason,
            clear: self.clear(table),
            other_party: self.choice(table, "other_party", &OtherParty::WORDS),
            unbraked: self.flag(table, "unbraked"),
            sight: self.sight(table),
            obstacles: self.obstacles(table),
        }
    }

    fn sight(&mut self, avoid: &Table<'t>) -> GivenSight {
        const PATH: &str =
            "[{ x = \"-30 m\", y = \"0 m\" }, { x = \"-8 m\", y = \"0 m\" }, { x = \"-3 m\", y = \"3 m\" }]";
        let Some(table) = self.child(avoid, "sight") else { return GivenSight::default() };
        self.not_both(&table, "heading", "path");
        self.not_both(&table, "other_heading", "other_path");
        GivenSight {
            eye: self.place_of(&table, "eye"),
            heading: self.sourced(&table, "heading"),
            point: self.place_of(&table, "point"),
            other_heading: self.sourced(&table, "other_heading"),
            other_speed: self.sourced(&table, "other_speed"),
            path: self.places(&table, "path", PATH).unwrap_or_default(),
            other_path: self.places(&table, "other_path", PATH).unwrap_or_default(),
        }
    }

    fn obstacles(&mut self, avoid: &Table<'t>) -> Vec<Obstacle> {
        const FORMS: &str = "a table [[avoid.obstacle]] with polygon";
        let tables = self.tables(avoid, "obstacle", FORMS, MOST_ZONES).unwrap_or_default();
        tables.iter().filter_map(|table| self.obstacle(table)).collect()
    }

    fn obstacle(&mut self, table: &Table<'t>) -> Option<Obstacle> {
        self.require(table, &["polygon"]);
        let [name, source] = ["name", "source"].map(|key| self.text(table, key));
        Some(Obstacle { name, source, polygon: self.polygon(table, OF_OBSTACLE)? })
    }

    fn demand(&mut self, avoid: &Table<'t>) -> (Option<GivenDemand>, Option<Text>) {
        const FORMS: &str = "demand = { distance = \"30 m\" }, { time = \"2.1 s\" }, { other = { distance = \"4 m\", speed = \"1.5 m/s\" } } or { sight = true }";
        const OTHER: &str = "other = { distance = \"4 m\", speed = { low = \"1.2 m/s\", high = \"2.0 m/s\" } } or, from a stop, other = { distance = \"8 m\", acceleration = \"1.5 m/s^2\" }";
        let Some(table) = self.inline(avoid, "demand", FORMS) else {
            return (None, None);
        };
        let reason = self.text(&table, "reason");
        let [distance, time] = ["distance", "time"].map(|key| self.sourced(&table, key));
        let is_sight = self.flag(&table, "sight");
        let demand = match table.given(&["distance", "time", "other", "sight"])[..] {
            ["sight"] if is_sight => Some(GivenDemand::Sight),
            ["sight"] => self.not_false(&table, "sight", "write sight = true, or where or when the danger could be recognized, as in demand = { distance = \"30 m\" }"),
            ["distance"] => distance.map(GivenDemand::Distance),
            ["time"] => time.map(GivenDemand::Time),
            ["other"] => {
                self.inline(&table, "other", OTHER).and_then(|other| {
                    self.require(&other, &["distance"]);
                    let [distance, speed, acceleration] =
                        ["distance", "speed", "acceleration"].map(|key| self.sourced(&other, key));
                    if other.given(&["speed", "acceleration"]).is_empty() {
                        return self.no_form(&other, OTHER);
                    }
                    Some(GivenDemand::Other(OtherApproach { distance: distance?, speed, acceleration }))
                })
            }
            _ => self.no_form(&table, FORMS),
        };
        (demand, reason)
    }

    fn clear(&mut self, avoid: &Table<'t>) -> Option<Clear> {
        const FORMS: &str = "clear = { distance = \"2.4 m\", speed = \"1.4 m/s\" } or, of two vehicles, clear = { outlines = true }";
        let table = self.inline(avoid, "clear", FORMS)?;
        let [distance, speed] = ["distance", "speed"].map(|key| self.sourced(&table, key));
        let is_by_outlines = self.flag(&table, "outlines");
        let way = match table.given(&["distance", "outlines"])[..] {
            ["distance"] => GivenWayOut::Distance(distance?),
            ["outlines"] if is_by_outlines => GivenWayOut::Outlines,
            ["outlines"] => return self.not_false(&table, "outlines", "write outlines = true, or how far the other party still had to go, as in clear = { distance = \"2.4 m\" }"),
            _ => return self.no_form(&table, FORMS),
        };
        Some(Clear { way, speed })
    }
}
