//! The contact of the vehicles, and the inverse mass at C.

use case::{Axes, ContactPoint, Quantity};
use crash3::{EnergyMoments, Side, SideStiffness, Stiffness};
use pim_core::VehicleId;

use super::super::damage::measured;
use super::super::{Draft, angle, n, step};
use super::Collision;
use crate::{axes, words};

impl Collision<'_> {
    pub(super) fn geometry(&self) -> Vec<Draft> {
        let turned =
            if self.impact.contact.is_turned() { " (the file's crush plane, turned by 180°)" } else { "" };
        let name = format!("direction of n, from vehicle 2 to vehicle 1{turned}");
        let mut steps = vec![step(name, "Γ", (self.gamma.to_degrees(), "°"), "theory 1")];
        for (k, vehicle) in VehicleId::ALL.into_iter().zip(&self.case.vehicles) {
            let placed = &self.analysis.vehicles[k.index()].subject;
            if let (true, Some(point)) = (placed.contact_is_placed, placed.contact) {
                steps.extend(self.placed_contact(k, point).into_iter().flatten());
                steps.extend(self.arm(k, point));
            }
            let Some(contact) = &vehicle.contact else { continue };
            if let ContactPoint::Polar { distance, angle } = contact {
                steps.extend(self.contact_point(k, distance, angle, contact.xy()));
            }
            steps.extend(self.arm(k, contact.xy()));
        }
        steps
    }

    /// The contact point of a vehicle in its own axes, from its polar form.
    fn contact_point(
        &self,
        k: VehicleId,
        d: &Quantity,
        phi: &Quantity,
        [forward, aside]: [f64; 2],
    ) -> [Draft; 2] {
        let to_y = axes::side_of_y(self.case.axes);
        [("x", "forward", "cos", forward), ("y", to_y, "sin", aside)].map(|(axis, name, function, value)| {
            let name = format!("contact point {name} of CG {k}");
            step(name, format!("{axis}_{k}"), (value, "m"), "theory 1")
                .equals(format!("d_{k} {function} φ_{k}"))
                .with([(format!("d_{k}"), n(d.si(), "m")), (format!("φ_{k}"), angle(phi.si()))])
        })
    }

    /// The contact point of a vehicle in its own axes, at the centroid of its damage.
    fn placed_contact(&self, k: VehicleId, [forward, aside]: [f64; 2]) -> Option<Vec<Draft>> {
        let vehicle = &self.analysis.vehicles[k.index()];
        let profile = measured(vehicle)?;
        let (given_crush, body) =
            (self.case.vehicles[k.index()].crush.as_ref()?, vehicle.subject.dimensions?);
        let (side, offset) = (given_crush.side, given_crush.offset?.si());
        let structure = &vehicle.damage.as_ref()?.structure;
        let (face, name_of_face) = (body.face(side), words::side_name(side));
        let source = if body.class.is_some() { "theory 5" } else { "input" };
        let mut steps = vec![
            step(format!("{name_of_face} of vehicle {k} from its CG"), format!("f_{k}"), (face, "m"), source),
            step(
                format!("offset of the damage of vehicle {k}"),
                format!("offset_{k}"),
                (offset, "m"),
                "input",
            ),
        ];
        // From the first station to the centroid, and from the face to it, zone by zone: each counts by its
        // energy. Without energy there is no crush.
        let mut moments = EnergyMoments::none();
        let mut own = Vec::new();
        for (j, zone) in profile.zones().enumerate() {
            let (alone, before) = (EnergyMoments::none(), moments.width);
            let stiffness = stiffness_of_zone(structure, j)?;
            let alone = alone.with(zone, stiffness);
            moments = moments.with(zone, stiffness);
            own.extend([
                (format!("E_{j}"), n(alone.energy, "J")),
                (format!("s_{j}"), n(before + at(alone.moment_along, alone.energy), "m")),
                (format!("c_{j}"), n(at(alone.moment_deep, alone.energy), "m")),
            ]);
        }
        let has_energy = moments.energy > 0.0;
        let (along, depth) = if has_energy {
            (moments.moment_along / moments.energy, moments.moment_deep / moments.energy)
        } else {
            (moments.width / 2.0, 0.0)
        };
        for (symbol, from, value) in [("s", "its first station", along), ("c", "the face", depth)] {
            let of = |what: &str| {
                let name = format!("{what} of vehicle {k}, from {from}");
                step(name, format!("{symbol}_{k}"), (value, "m"), "theory 5")
            };
            let sum = |term: &dyn Fn(usize) -> String| {
                (0..profile.zones().count()).map(term).collect::<Vec<_>>().join(" + ")
            };
            let (parts, whole) = (sum(&|j| format!("E_{j} {symbol}_{j}")), sum(&|j| format!("E_{j}")));
            steps.push(if has_energy {
                of("centroid of the damage")
                    .equals(format!("Σ E_j {symbol}_j/Σ E_j"))
                    .written_out(format!("({parts})/({whole})"))
                    .with(own.clone())
            } else {
                of("without crush: the middle of the damage")
            });
        }
        let across = |sign: &str| match sign {
            "−" => format!("−(f_{k} − c_{k})"),
            _ => format!("f_{k} − c_{k}"),
        };
        let beside = |sign: &str| format!("offset_{k} {sign} (s_{k} − L_{k}/2)");
        // Stations run from left to right, or from rear to front; y points to the left, or to the right.
        let (to_right, left, right) = match self.case.axes {
            Axes::ZUp => ("−", "+", "−"),
            Axes::ZDown => ("+", "−", "+"),
        };
        let (x, y) = match side {
            Side::Front => (across("+"), beside(to_right)),
            Side::Rear => (across("−"), beside(to_right)),
            Side::Left => (beside("+"), across(left)),
            Side::Right => (beside("+"), across(right)),
        };
        let to_y = axes::side_of_y(self.case.axes);
        steps.extend([("x", "forward", x, forward), ("y", to_y, y, aside)].map(
            |(axis, name, formula, value)| {
                let name = format!("contact point {name} of CG {k}, at the centroid of the damage");
                step(name, format!("{axis}_{k}"), (value, "m"), "theory 5")
                    .equals(formula)
                    .with([(format!("L_{k}"), n(moments.width, "m"))])
            },
        ));
        Some(steps)
    }

    /// The arm of a vehicle along n and t, from its contact point in its own axes.
    fn arm(&self, k: VehicleId, [forward, aside]: [f64; 2]) -> [Draft; 2] {
        let arm = self.impact.contact.arms()[k.index()];
        [
            ("n", format!("x_{k} cos(θ_{k} − Γ) − y_{k} sin(θ_{k} − Γ)"), arm.normal),
            ("t", format!("x_{k} sin(θ_{k} − Γ) + y_{k} cos(θ_{k} − Γ)"), arm.tangential),
        ]
        .map(|(axis, formula, value)| {
            let name = format!("arm of vehicle {k} along {axis}");
            step(name, format!("r_{k}{axis}"), (value, "m"), "Eq 2")
                .equals(formula)
                .with([(format!("x_{k}"), n(forward, "m")), (format!("y_{k}"), n(aside, "m"))])
        })
    }

    /// The effect of an impulse on the velocity at C and, if a law has one, of a moment impulse.
    pub(super) fn inverse_mass(&self) -> Vec<Draft> {
        let k = self.impact.contact.inverse_mass();
        let entry = |symbol: &str, term: fn(VehicleId) -> String, value: f64, unit: &'static str| {
            step("inverse mass at C", symbol, (value, unit), "theory 2").equals(self.sum(term))
        };
        let mut steps = vec![
            entry("k_nn", |i| format!("1/m_{i} + r_{i}t²/I_{i}"), k.nn, "1/kg"),
            entry("k_nt", |i| format!("(−r_{i}n r_{i}t)/I_{i}"), k.nt, "1/kg"),
            entry("k_tt", |i| format!("1/m_{i} + r_{i}n²/I_{i}"), k.tt, "1/kg"),
        ];
        if self.impact.law.has_moment() {
            steps.push(entry("k_nm", |i| format!("(−r_{i}t)/I_{i}"), k.nm, "1/(kg·m)"));
            steps.push(entry("k_tm", |i| format!("r_{i}n/I_{i}"), k.tm, "1/(kg·m)"));
        }
        let determinant = step("determinant of K", "det K", (k.determinant(), "1/kg²"), "theory 2");
        steps.push(determinant.equals("k_nn k_tt − k_nt²"));
        steps
    }
}

/// The stiffness of the zone after station `index`, from 0.
fn stiffness_of_zone(structure: &SideStiffness, index: usize) -> Option<&Stiffness> {
    match structure {
        SideStiffness::Uniform(stiffness) => Some(stiffness),
        SideStiffness::Zones(stiffnesses) => stiffnesses.get(index),
    }
}

/// (m) the centroid of an energy (J) with this first moment (J·m); 0 without energy.
fn at(moment: f64, energy: f64) -> f64 {
    if energy > 0.0 { moment / energy } else { 0.0 }
}
