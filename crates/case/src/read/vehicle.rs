//! `[vehicle1]`, `[vehicle2]` and their damage.

use std::f64::consts::FRAC_PI_2;

use super::differ;
use super::tree::{Reader, Table};
use super::values::{Sign, named};
use crate::case::{ContactPoint, Crush, Mass, Outline, StiffnessForm, Vehicle, Velocity, YawInertia};
use crate::problem::Problem;
use crate::quantity::{Quantity, format_number};
use crate::schema::{CONTACT, CRUSH, STIFFNESS, VEHICLE, VELOCITY};
use crate::units::Dimension;
use crash3::ObliqueCorrection;
use crash3::Side;

/// (–) by how much the width and the sum of the spacing may differ: both are read from a tape.
const WIDTH_TOLERANCE: f64 = 1e-3;

impl<'t> Reader<'t> {
    pub(super) fn vehicle(&mut self, top: &Table<'t>, key: &'static str) -> Option<Vehicle> {
        if !top.has(key) {
            self.missing(top, key);
            return None;
        }
        let table = self.child(top, key, &VEHICLE)?;
        let fixed = self.flag(&table, "fixed");
        if fixed {
            let never =
                ["mass", "weight", "yaw_inertia", "yaw_radius", "speed", "velocity", "yaw_rate", "crush"];
            for key in table.given(&never) {
                self.report_path(&table.path_of(key), Problem::FixedHas { table: table.label(), key });
            }
        }
        Some(Vehicle {
            name: self.text(&table, "name"),
            fixed,
            mass: self.mass(&table),
            yaw: self.yaw(&table),
            heading: self.quantity(&table, "heading", Dimension::Angle, Sign::Any),
            contact: self.contact(&table),
            motion: self.motion(&table),
            yaw_rate: self.quantity(&table, "yaw_rate", Dimension::YawRate, Sign::Any),
            outline: self.outline(&table),
            crush: self.child(&table, "crush", &CRUSH).and_then(|crush| self.crush(&crush)),
        })
    }

    fn mass(&mut self, table: &Table<'t>) -> Option<Mass> {
        self.not_both(table, "mass", "weight");
        let mass = self.quantity(table, "mass", Dimension::Mass, Sign::Positive).map(Mass::Mass);
        let weight = self.quantity(table, "weight", Dimension::Weight, Sign::Positive).map(Mass::Weight);
        mass.or(weight)
    }

    fn yaw(&mut self, table: &Table<'t>) -> Option<YawInertia> {
        self.not_both(table, "yaw_inertia", "yaw_radius");
        let inertia = self.quantity(table, "yaw_inertia", Dimension::Inertia, Sign::Positive);
        let radius = self.quantity(table, "yaw_radius", Dimension::Length, Sign::Positive);
        inertia.map(YawInertia::Inertia).or(radius.map(YawInertia::Radius))
    }

    fn contact(&mut self, vehicle: &Table<'t>) -> Option<ContactPoint> {
        const FORMS: &str = "contact = { distance = \"6.3 ft\", angle = \"-22.4 deg\" } or contact = { x = \"1.78 m\", y = \"-0.73 m\" }";
        let table = self.inline(vehicle, "contact", &CONTACT, "a table in braces", FORMS)?;
        let distance = self.quantity(&table, "distance", Dimension::Length, Sign::NotNegative);
        let angle = self.quantity(&table, "angle", Dimension::Angle, Sign::Any);
        let x = self.quantity(&table, "x", Dimension::Length, Sign::Any);
        let y = self.quantity(&table, "y", Dimension::Length, Sign::Any);
        match table.given(&["distance", "angle", "x", "y"])[..] {
            ["distance", "angle"] => Some(ContactPoint::Polar { distance: distance?, angle: angle? }),
            ["x", "y"] => Some(ContactPoint::Cartesian { x: x?, y: y? }),
            _ => self.no_form(&table, FORMS),
        }
    }

    fn motion(&mut self, vehicle: &Table<'t>) -> Option<Velocity> {
        const FORMS: &str =
            "velocity = { x = \"-75 ft/s\", y = \"0 ft/s\" } or, along the heading, speed = \"75 ft/s\"";
        self.not_both(vehicle, "speed", "velocity");
        let speed = self.quantity(vehicle, "speed", Dimension::Speed, Sign::Any).map(Velocity::Speed);
        let Some(table) = self.inline(vehicle, "velocity", &VELOCITY, "a table in braces", FORMS) else {
            return speed;
        };
        let x = self.quantity(&table, "x", Dimension::Speed, Sign::Any);
        let y = self.quantity(&table, "y", Dimension::Speed, Sign::Any);
        match table.given(&["x", "y"])[..] {
            ["x", "y"] => Some(Velocity::Vector { x: x?, y: y? }),
            _ => self.no_form(&table, FORMS),
        }
    }

    fn outline(&mut self, table: &Table<'t>) -> Option<Outline> {
        let keys = ["length", "width", "cg_to_front"];
        let given = table.given(&keys);
        let missing: Vec<_> = keys.into_iter().filter(|key| !given.contains(key)).collect();
        if let ([first, ..], [_, ..]) = (&given[..], &missing[..]) {
            let path = table.path_of(first);
            self.report_path(&path, Problem::HalfOutline { table: table.label(), given, missing });
        }
        let length = self.quantity(table, "length", Dimension::Length, Sign::Positive);
        let width = self.quantity(table, "width", Dimension::Length, Sign::Positive);
        let cg_to_front = self.quantity(table, "cg_to_front", Dimension::Length, Sign::Positive);
        Some(Outline { length: length?, width: width?, cg_to_front: cg_to_front? })
    }

    fn crush(&mut self, table: &Table<'t>) -> Option<Crush> {
        self.require(table, &["side", "depths", "stiffness"]);
        if !table.has("spacing") {
            self.require(table, &["width"]);
        }
        let sides =
            [("front", Side::Front), ("rear", Side::Rear), ("left", Side::Left), ("right", Side::Right)];
        let side = self.choice(table, "side", &sides);
        let width = self.quantity(table, "width", Dimension::Length, Sign::Positive);
        let depths = self.quantities(table, "depths", Dimension::Length, Sign::NotNegative);
        let spacing = self.quantities(table, "spacing", Dimension::Length, Sign::Positive);
        self.profile(table, width, depths.as_deref(), spacing.as_deref());
        let stiffness = self.stiffness(table);
        let offset = self.quantity(table, "offset", Dimension::Length, Sign::Any);
        let pdof = self.quantity(table, "pdof", Dimension::Angle, Sign::Any);
        let oblique_angle = self.quantity(table, "oblique_angle", Dimension::Angle, Sign::Any);
        if let Some(value) = oblique_angle
            && value.si().abs() >= FRAC_PI_2
        {
            let path = table.path_of("oblique_angle");
            let limit = if value.unit().spelling() == "rad" { "1.5708 rad" } else { "90 deg" };
            self.report_path(&path.clone(), Problem::NotAcute { path, value, limit });
        }
        let moment_arm = self.quantity(table, "moment_arm", Dimension::Length, Sign::NotNegative);
        let corrections = [
            ("capped", ObliqueCorrection::Capped),
            ("uncapped", ObliqueCorrection::Uncapped),
            ("none", ObliqueCorrection::None),
        ];
        let oblique = self.choice(table, "oblique", &corrections);
        Some(Crush {
            side: side?,
            width,
            depths: depths?,
            spacing,
            stiffness: stiffness?,
            offset,
            pdof,
            oblique_angle,
            moment_arm,
            oblique,
        })
    }

    /// Whether depths, widths and their number belong together.
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
            self.report_path(&path.clone(), Problem::TooFewStations { path, count });
            return;
        }
        let Some(spacing) = spacing else { return };
        if let Some(stations) = stations
            && spacing.len() + 1 != stations
        {
            let path = table.path_of("spacing");
            let problem = Problem::SpacingCount { path: path.clone(), spacings: spacing.len(), stations };
            self.report_path(&path, problem);
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
            let problem = Problem::WidthMismatch {
                path: path.clone(),
                width,
                sum: format!("{digits} {}", width.unit()),
            };
            self.report_path(&path, problem);
        }
    }

    fn stiffness(&mut self, crush: &Table<'t>) -> Option<StiffnessForm> {
        const FORMS: &str = "stiffness = { d0 = \"35 lb^0.5\", d1 = \"115 lb^0.5/ft\" } or stiffness = { A = \"587 N/cm\", \
                             B = \"63.3 N/cm^2\" }, each with G = \"612 lb\" if it is known";
        let table = self.inline(crush, "stiffness", &STIFFNESS, "a table in braces", FORMS)?;
        let slope = if table.has("G") {
            Sign::NotNegative
        } else {
            Sign::PositiveBecause("B may be zero only where G is given: without G, G = A²/2B needs it")
        };
        let a = self.quantity(&table, "A", Dimension::StiffnessA, Sign::NotNegative);
        let mut b = self.quantity(&table, "B", Dimension::StiffnessB, slope);
        // B is exactly zero or a stiffness; next to nothing is neither.
        if let Some(value) = b
            && value.number() != 0.0
            && value.si() < Dimension::StiffnessB.least_positive()
        {
            let path = table.path_of("B");
            self.report_path(&path, Problem::TooSmall { path: named(&path), value });
            b = None;
        }
        let d0 = self.quantity(&table, "d0", Dimension::RootForce, Sign::NotNegative);
        let d1 = self.quantity(&table, "d1", Dimension::RootForcePerLength, Sign::Positive);
        let g = self.quantity(&table, "G", Dimension::StiffnessG, Sign::NotNegative);
        match table.given(&["A", "B", "d0", "d1"])[..] {
            ["A", "B"] => Some(StiffnessForm::Crush { a: a?, b: b?, g }),
            ["d0", "d1"] => Some(StiffnessForm::Root { d0: d0?, d1: d1?, g }),
            _ => self.no_form(&table, FORMS),
        }
    }

    fn not_both(&mut self, table: &Table<'t>, first: &'static str, second: &'static str) {
        let (Some(one), Some(other)) = (table.get(first), table.get(second)) else { return };
        // The later of the two is the one that surprises.
        let later = if one.span().start > other.span().start { one } else { other };
        self.report(later.span(), Problem::Both { table: table.label(), first, second });
    }
}
