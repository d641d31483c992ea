//! How the vehicles move before and after the impact.

use case::{Axes, Velocity};
use pim_core::{Contact, Motion, VehicleId};

use super::super::{Step, angle, course, heading, n, p, step};
use super::Collision;

impl Collision<'_> {
    pub(super) fn approach(&self) -> Vec<Step> {
        let outcome = &self.impact.outcome;
        let u = outcome.approach;
        let mut steps: Vec<Step> = self.moving().flat_map(|(k, ..)| self.before(k)).collect();
        for (axis, value) in [("n", u.normal), ("t", u.tangential)] {
            let (formula, numbers) = self.relative(axis, &outcome.before);
            let name = format!("relative velocity at C along {axis}");
            steps.push(step(name, format!("u_{axis}")).equals(formula, numbers).is(value, "m/s", "theory 1"));
        }
        steps
    }

    /// The motion of a vehicle before the impact.
    fn before(&self, k: VehicleId) -> Vec<Step> {
        let before = self.impact.outcome.before[k.index()];
        let both = self.analysis.both.as_ref().map(|both| both.speeds[k.index()]);
        let speed = match (self.analysis.found.as_ref(), &self.case.vehicles[k.index()].motion) {
            _ if both.is_some() => both,
            (Some(found), _) if found.unknown == k => Some(found.speed),
            (_, Some(Velocity::Speed(speed))) => Some(speed.si()),
            _ => None,
        };
        let (theta, symbol_of_course) = course(self.case, k);
        let theta = angle(theta);
        let mut steps = Vec::new();
        for (axis, function, value) in [("x", "cos", before.velocity.x), ("y", "sin", before.velocity.y)] {
            let (name, symbol) = (format!("velocity of vehicle {k} along {axis}"), format!("v_{k}{axis}"));
            steps.push(match speed {
                Some(s) => step(name, symbol)
                    .equals(
                        format!("s_{k} {function} {symbol_of_course}"),
                        format!("{} · {function}{theta}", n(s, "m/s")),
                    )
                    .is(value, "m/s", "theory 1"),
                None => step(name, symbol).is(value, "m/s", "input"),
            });
        }
        if before.yaw_rate != 0.0 {
            let name = format!("yaw rate of vehicle {k}");
            steps.push(step(name, format!("ω_{k}")).is(before.yaw_rate, "rad/s", "input"));
        }
        steps
    }

    /// The velocity of vehicle 1 relative to vehicle 2 at C along n or t, in symbols and in numbers.
    pub(super) fn relative(&self, axis: &str, motions: &[Motion; 2]) -> (String, String) {
        let moving: Vec<VehicleId> = self.moving().map(|(k, ..)| k).collect();
        relative(axis, ["v", "ω"], &self.impact.contact, &moving, motions)
    }

    /// The motion of a vehicle after the impact, its ΔV and PDOF; empty for a fixed object.
    pub(super) fn motion(&self, k: VehicleId) -> Vec<Step> {
        let Some((mass, inertia)) = self.inertia[k.index()] else { return Vec::new() };
        let mut steps = self.velocity_after(k, mass).to_vec();
        steps.push(self.yaw_rate_after(k, inertia));
        let vector = self.impact.outcome.impulse_vector;
        steps.push(
            step(format!("velocity change of vehicle {k}"), format!("ΔV_{k}"))
                .equals(
                    format!("√(P_x² + P_y²)/m_{k}"),
                    format!("√({}² + {}²) / {}", p(vector.x, "N·s"), p(vector.y, "N·s"), n(mass, "kg")),
                )
                .is(self.impact.outcome.delta_v_magnitude()[k.index()], "m/s", "theory 2"),
        );
        steps.push(self.pdof(k));
        steps
    }

    /// The sign of the impulse on a vehicle: vehicle 2 takes −P.
    fn sign(k: VehicleId) -> &'static str {
        match k {
            VehicleId::One => "+",
            VehicleId::Two => "−",
        }
    }

    fn velocity_after(&self, k: VehicleId, mass: f64) -> [Step; 2] {
        let (outcome, sign, i) = (&self.impact.outcome, Self::sign(k), k.index());
        let (before, after, impulse) =
            (outcome.before[i].velocity, outcome.after[i].velocity, outcome.impulse_vector);
        [("x", before.x, impulse.x, after.x), ("y", before.y, impulse.y, after.y)].map(
            |(axis, v, impulse, value)| {
                step(format!("velocity of vehicle {k} along {axis}, after"), format!("V_{k}{axis}"))
                    .equals(
                        format!("v_{k}{axis} {sign} P_{axis}/m_{k}"),
                        format!("{} {sign} {} / {}", n(v, "m/s"), n(impulse, "N·s"), n(mass, "kg")),
                    )
                    .is(value, "m/s", "theory 2")
            },
        )
    }

    fn yaw_rate_after(&self, k: VehicleId, inertia: f64) -> Step {
        let (outcome, sign, i) = (&self.impact.outcome, Self::sign(k), k.index());
        let (impulse, arm) = (outcome.impulse, self.impact.contact.arms()[i]);
        let (moment, moment_number) = if outcome.moment_impulse == 0.0 {
            ("", String::new())
        } else {
            (" + M", format!(" + {}", n(outcome.moment_impulse, "N·m·s")))
        };
        step(format!("yaw rate of vehicle {k}, after"), format!("Ω_{k}"))
            .equals(
                format!("ω_{k} {sign} (r_{k}n P_t − r_{k}t P_n{moment})/I_{k}"),
                format!(
                    "{} {sign} ({} · {} − {} · {}{moment_number}) / {}",
                    n(outcome.before[i].yaw_rate, "rad/s"),
                    n(arm.normal, "m"),
                    n(impulse.tangential, "N·s"),
                    n(arm.tangential, "m"),
                    n(impulse.normal, "N·s"),
                    n(inertia, "kg·m²")
                ),
            )
            .is(outcome.after[i].yaw_rate, "rad/s", "theory 2")
    }

    fn pdof(&self, k: VehicleId) -> Step {
        let vector = self.impact.outcome.impulse_vector;
        let (theta, x, y) = (angle(heading(self.case, k)), n(vector.x, "N·s"), n(vector.y, "N·s"));
        // The force on vehicle 2 is −P. A PDOF is clockwise in any axes: the relevant component is the one to
        // the left, which in z-down axes is −y.
        let (left, left_numbers) = if (k == VehicleId::One) == (self.case.axes == Axes::ZUp) {
            (format!("P_y cos θ_{k} − P_x sin θ_{k}"), format!("{y} · cos{theta} − {x} · sin{theta}"))
        } else {
            (format!("P_x sin θ_{k} − P_y cos θ_{k}"), format!("{x} · sin{theta} − {y} · cos{theta}"))
        };
        let (behind, behind_numbers) = if k == VehicleId::One {
            (format!("−P_x cos θ_{k} − P_y sin θ_{k}"), format!("(−1) · {x} · cos{theta} − {y} · sin{theta}"))
        } else {
            (format!("P_x cos θ_{k} + P_y sin θ_{k}"), format!("{x} · cos{theta} + {y} · sin{theta}"))
        };
        step(
            format!("principal direction of force on vehicle {k}, clockwise from its heading"),
            format!("PDOF_{k}"),
        )
        .equals(format!("atan2({left}, {behind})"), format!("atan2({left_numbers}, {behind_numbers})"))
        .is(self.impact.pdof[k.index()].to_degrees(), "°", "theory 4")
    }
}

/// The velocity of vehicle 1 relative to vehicle 2 at C along n or t, in the given symbols of the velocities
/// and yaw rates, and in numbers.
pub(in super::super) fn relative(
    axis: &str,
    [v, w]: [&str; 2],
    contact: &Contact,
    moving: &[VehicleId],
    motions: &[Motion; 2],
) -> (String, String) {
    let (gamma, arms) = (angle(contact.normal_angle()), contact.arms());
    let (mut formula, mut numbers) = (String::new(), String::new());
    for &k in moving {
        let (Motion { velocity, yaw_rate, .. }, arm) = (motions[k.index()], arms[k.index()]);
        let (x, y) = (n(velocity.x, "m/s"), n(velocity.y, "m/s"));
        let (symbols, along, turning) = match axis {
            "n" => (
                format!("({v}_{k}x cos Γ + {v}_{k}y sin Γ − {w}_{k} r_{k}t)"),
                format!("{x} · cos{gamma} + {y} · sin{gamma}"),
                format!(" − {} · {}", n(yaw_rate, "rad/s"), n(arm.tangential, "m")),
            ),
            _ => (
                format!("({v}_{k}y cos Γ − {v}_{k}x sin Γ + {w}_{k} r_{k}n)"),
                format!("{y} · cos{gamma} − {x} · sin{gamma}"),
                format!(" + {} · {}", n(yaw_rate, "rad/s"), n(arm.normal, "m")),
            ),
        };
        let turning = if yaw_rate == 0.0 { "" } else { &turning };
        // Vehicle 1 relative to vehicle 2.
        let lead = match (k, numbers.is_empty()) {
            (VehicleId::One, _) => "",
            (_, true) => "−",
            (_, false) => " − ",
        };
        formula.push_str(&format!("{lead}{symbols}"));
        numbers.push_str(&format!("{lead}({along}{turning})"));
    }
    (formula, numbers)
}
