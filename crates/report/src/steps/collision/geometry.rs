//! The contact of the vehicles, and the inverse mass at C.

use case::{Axes, ContactPoint, Quantity};
use crash3::{EnergyMoments, Side, SideStiffness, Stiffness};
use pim_core::VehicleId;

use super::super::damage::measured;
use super::super::{Step, angle, digits, heading, n, p, step};
use super::Collision;
use crate::{axes, words};

/// An entry of K: its symbol, its sum over the vehicles in symbols and in numbers, its value and unit.
type Entry = (&'static str, (String, String), f64, &'static str);

impl Collision<'_> {
    pub(super) fn geometry(&self) -> Vec<Step> {
        let gamma = self.gamma.to_degrees();
        let mut direction =
            step("direction of n, from vehicle 2 to vehicle 1", "Γ").is(gamma, "°", "theory 1");
        if self.impact.contact.is_turned() {
            direction.name.push_str(" (the file's crush plane, turned by 180°)");
        }
        let mut steps = vec![direction];
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
        distance: &Quantity,
        phi: &Quantity,
        [forward, aside]: [f64; 2],
    ) -> [Step; 2] {
        let (d, phi) = (n(distance.si(), "m"), angle(phi.si()));
        [
            step(format!("contact point forward of CG {k}"), format!("x_{k}"))
                .equals(format!("d_{k} cos φ_{k}"), format!("{d} · cos{phi}"))
                .is(forward, "m", "theory 1"),
            step(format!("contact point {} of CG {k}", axes::side_of_y(self.case.axes)), format!("y_{k}"))
                .equals(format!("d_{k} sin φ_{k}"), format!("{d} · sin{phi}"))
                .is(aside, "m", "theory 1"),
        ]
    }

    /// The contact point of a vehicle in its own axes, at the centroid of its damage.
    fn placed_contact(&self, k: VehicleId, [forward, aside]: [f64; 2]) -> Option<Vec<Step>> {
        let vehicle = &self.analysis.vehicles[k.index()];
        let profile = measured(vehicle)?;
        let (given_crush, body) =
            (self.case.vehicles[k.index()].crush.as_ref()?, vehicle.subject.dimensions?);
        let (side, offset) = (given_crush.side, given_crush.offset?.si());
        let structure = &vehicle.damage.as_ref()?.structure;
        let (face, name_of_face) = (body.face(side), words::side_name(side));
        let source = if body.class.is_some() { "theory 5" } else { "input" };
        let mut steps = vec![
            step(format!("{name_of_face} of vehicle {k} from its CG"), format!("f_{k}"))
                .is(face, "m", source),
            step(format!("offset of the damage of vehicle {k}"), format!("offset_{k}"))
                .is(offset, "m", "input"),
        ];
        // From the first station to the centroid, and from the face to it, zone by zone: each counts by its
        // energy. Without energy there is no crush.
        let mut moments = EnergyMoments::none();
        let [mut energies, mut alongs, mut deeps] = [const { Vec::new() }; 3];
        for (j, zone) in profile.zones().enumerate() {
            let (alone, before) = (EnergyMoments::none(), moments.width);
            let stiffness = stiffness_of_zone(structure, j)?;
            let alone = alone.with(zone, stiffness);
            moments = moments.with(zone, stiffness);
            energies.push(n(alone.energy, "J"));
            alongs.push(format!(
                "{} · {}",
                n(alone.energy, "J"),
                n(before + at(alone.moment_along, alone.energy), "m")
            ));
            deeps.push(format!("{} · {}", n(alone.energy, "J"), n(at(alone.moment_deep, alone.energy), "m")));
        }
        let has_energy = moments.energy > 0.0;
        let (along, depth) = if has_energy {
            (moments.moment_along / moments.energy, moments.moment_deep / moments.energy)
        } else {
            (moments.width / 2.0, 0.0)
        };
        let width = moments.width;
        if has_energy {
            let whole = format!("({})", energies.join(" + "));
            steps.push(
                step(
                    format!("centroid of the damage of vehicle {k}, from its first station"),
                    format!("s_{k}"),
                )
                .equals("Σ E_j s_j/Σ E_j", format!("({}) / {whole}", alongs.join(" + ")))
                .is(along, "m", "theory 5"),
            );
            steps.push(
                step(format!("centroid of the damage of vehicle {k}, from the face"), format!("c_{k}"))
                    .equals("Σ E_j c_j/Σ E_j", format!("({}) / {whole}", deeps.join(" + ")))
                    .is(depth, "m", "theory 5"),
            );
        } else {
            let name = "without crush: the middle of the damage of vehicle";
            steps.push(
                step(format!("{name} {k}, from its first station"), format!("s_{k}"))
                    .is(along, "m", "theory 5"),
            );
            steps.push(
                step(format!("{name} {k}, from the face"), format!("c_{k}")).is(depth, "m", "theory 5"),
            );
        }
        let out = format!("{} − {}", n(face, "m"), n(depth, "m"));
        let from_middle = format!("({} − {} / 2)", n(along, "m"), n(width, "m"));
        let across = |sign: &str| match sign {
            "−" => (format!("−(f_{k} − c_{k})"), format!("−({out})")),
            _ => (format!("f_{k} − c_{k}"), out.clone()),
        };
        let beside = |sign: &str| {
            (
                format!("offset_{k} {sign} (s_{k} − L_{k}/2)"),
                format!("{} {sign} {from_middle}", n(offset, "m")),
            )
        };
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
        let point = |axis: &str, name: &str, (formula, substitution): (String, String), value: f64| {
            let name = format!("contact point {name} of CG {k}, at the centroid of the damage");
            step(name, format!("{axis}_{k}")).equals(formula, substitution).is(value, "m", "theory 5")
        };
        steps.push(point("x", "forward", x, forward));
        steps.push(point("y", axes::side_of_y(self.case.axes), y, aside));
        Some(steps)
    }

    /// The arm of a vehicle along n and t, from its contact point in its own axes.
    fn arm(&self, k: VehicleId, [forward, aside]: [f64; 2]) -> [Step; 2] {
        let arm = self.impact.contact.arms()[k.index()];
        let (x, y) = (n(forward, "m"), n(aside, "m"));
        let turn = format!("({}\u{a0}° − {})", digits(heading(self.case, k).to_degrees()), angle(self.gamma));
        [
            step(format!("arm of vehicle {k} along n"), format!("r_{k}n"))
                .equals(
                    format!("x_{k} cos(θ_{k} − Γ) − y_{k} sin(θ_{k} − Γ)"),
                    format!("{x} · cos{turn} − {y} · sin{turn}"),
                )
                .is(arm.normal, "m", "Eq 2"),
            step(format!("arm of vehicle {k} along t"), format!("r_{k}t"))
                .equals(
                    format!("x_{k} sin(θ_{k} − Γ) + y_{k} cos(θ_{k} − Γ)"),
                    format!("{x} · sin{turn} + {y} · cos{turn}"),
                )
                .is(arm.tangential, "m", "Eq 2"),
        ]
    }

    pub(super) fn inverse_mass(&self) -> Vec<Step> {
        let k = self.impact.contact.inverse_mass();
        let mut entries = self.translation().to_vec();
        if self.impact.law.has_moment() {
            entries.extend(self.rotation());
        }
        let mut steps: Vec<Step> = entries
            .into_iter()
            .map(|(symbol, (formula, substitution), value, unit)| {
                step("inverse mass at C", symbol).equals(formula, substitution).is(value, unit, "theory 2")
            })
            .collect();
        steps.push(
            step("determinant of K", "det K")
                .equals(
                    "k_nn k_tt − k_nt²",
                    format!("{} · {} − {}²", n(k.nn, "1/kg"), n(k.tt, "1/kg"), p(k.nt, "1/kg")),
                )
                .is(k.determinant(), "1/kg²", "theory 2"),
        );
        steps
    }

    /// The effect of an impulse on the velocity at C.
    fn translation(&self) -> [Entry; 3] {
        let (k, arms) = (self.impact.contact.inverse_mass(), self.impact.contact.arms());
        let nn = self.sum(&|i| format!("1/m_{i} + r_{i}t²/I_{i}"), &|i, m, inertia| {
            format!("1 / {} + {}² / {}", n(m, "kg"), p(arms[i.index()].tangential, "m"), n(inertia, "kg·m²"))
        });
        let nt = self.sum(&|i| format!("(−r_{i}n r_{i}t)/I_{i}"), &|i, _, inertia| {
            let arm = arms[i.index()];
            format!("(−{} · {}) / {}", p(arm.normal, "m"), n(arm.tangential, "m"), n(inertia, "kg·m²"))
        });
        let tt = self.sum(&|i| format!("1/m_{i} + r_{i}n²/I_{i}"), &|i, m, inertia| {
            format!("1 / {} + {}² / {}", n(m, "kg"), p(arms[i.index()].normal, "m"), n(inertia, "kg·m²"))
        });
        [("k_nn", nn, k.nn, "1/kg"), ("k_nt", nt, k.nt, "1/kg"), ("k_tt", tt, k.tt, "1/kg")]
    }

    /// The effect of a moment impulse on it.
    fn rotation(&self) -> [Entry; 2] {
        let (k, arms) = (self.impact.contact.inverse_mass(), self.impact.contact.arms());
        let nm = self.sum(&|i| format!("(−r_{i}t)/I_{i}"), &|i, _, inertia| {
            format!("(−{}) / {}", p(arms[i.index()].tangential, "m"), n(inertia, "kg·m²"))
        });
        let tm = self.sum(&|i| format!("r_{i}n/I_{i}"), &|i, _, inertia| {
            format!("{} / {}", n(arms[i.index()].normal, "m"), n(inertia, "kg·m²"))
        });
        [("k_nm", nm, k.nm, "1/(kg·m)"), ("k_tm", tm, k.tm, "1/(kg·m)")]
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
