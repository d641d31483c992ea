//! Where the vehicles touch, and the inverse mass that C feels.

use case::{ContactPoint, Quantity};
use pim_core::VehicleId;

use super::super::{Step, angle, digits, given, n, p, step};
use super::Collision;
use crate::axes;

/// How K is built up: a symbol, its sum over the vehicles in symbols and in numbers, its value and unit.
type Entry = (&'static str, (String, String), f64, &'static str);

impl Collision<'_> {
    pub(super) fn geometry(&self) -> Vec<Step> {
        let mut direction = given(
            "direction of n, from vehicle 2 to vehicle 1",
            "Γ",
            self.gamma.to_degrees(),
            "°",
            "theory 1",
        );
        if self.impact.contact.is_turned() {
            direction.name.push_str(" (the file's crush plane, turned by 180°)");
        }
        let mut steps = vec![direction];
        for (k, vehicle) in VehicleId::ALL.into_iter().zip(&self.case.vehicles) {
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
            step(
                format!("contact point forward of CG {k}"),
                format!("x_{k}"),
                format!("d_{k} cos φ_{k}"),
                format!("{d} · cos{phi}"),
                forward,
                "m",
                "theory 1",
            ),
            step(
                format!("contact point {} of CG {k}", axes::side_of_y(self.case.axes)),
                format!("y_{k}"),
                format!("d_{k} sin φ_{k}"),
                format!("{d} · sin{phi}"),
                aside,
                "m",
                "theory 1",
            ),
        ]
    }

    /// The arm of a vehicle along n and t, from its contact point in its own axes.
    fn arm(&self, k: VehicleId, [forward, aside]: [f64; 2]) -> [Step; 2] {
        let arm = self.impact.contact.arms()[k.index()];
        let (x, y) = (n(forward, "m"), n(aside, "m"));
        let turn = format!("({}\u{a0}° − {})", digits(self.heading(k).to_degrees()), angle(self.gamma));
        [
            step(
                format!("arm of vehicle {k} along n"),
                format!("r_{k}n"),
                format!("x_{k} cos(θ_{k} − Γ) − y_{k} sin(θ_{k} − Γ)"),
                format!("{x} · cos{turn} − {y} · sin{turn}"),
                arm.normal,
                "m",
                "Eq 2",
            ),
            step(
                format!("arm of vehicle {k} along t"),
                format!("r_{k}t"),
                format!("x_{k} sin(θ_{k} − Γ) + y_{k} cos(θ_{k} − Γ)"),
                format!("{x} · sin{turn} + {y} · cos{turn}"),
                arm.tangential,
                "m",
                "Eq 2",
            ),
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
                step("inverse mass at C", symbol, formula, substitution, value, unit, "theory 2")
            })
            .collect();
        steps.push(step(
            "determinant of K",
            "det K",
            "k_nn k_tt − k_nt²",
            format!("{} · {} − {}²", n(k.nn, "1/kg"), n(k.tt, "1/kg"), p(k.nt, "1/kg")),
            k.determinant(),
            "1/kg²",
            "theory 2",
        ));
        steps
    }

    /// What an impulse does to the velocity at C.
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

    /// What a moment impulse does to it.
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
