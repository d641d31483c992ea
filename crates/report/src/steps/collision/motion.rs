//! How the vehicles move before and after the impact.

use case::{Axes, Velocity};
use pim_core::{Contact, Motion, VehicleId};

use super::super::numbers::{Amount, Known};
use super::super::{Draft, angle, course, n, step};
use super::Collision;

impl Collision<'_> {
    pub(super) fn approach(&self) -> Vec<Draft> {
        let outcome = &self.impact.outcome;
        let u = outcome.approach;
        let mut steps: Vec<Draft> = self.moving().flat_map(|k| self.before(k)).collect();
        for (axis, value) in [("n", u.normal), ("t", u.tangential)] {
            let name = format!("relative velocity at C along {axis}");
            let (formula, own) = self.relative(axis, &outcome.before);
            let relative = step(name, format!("u_{axis}"), (value, "m/s"), "theory 1");
            steps.push(relative.equals(formula).with(own));
        }
        steps
    }

    /// The motion of a vehicle before the impact.
    fn before(&self, k: VehicleId) -> Vec<Draft> {
        let before = self.impact.outcome.before[k.index()];
        let both = self.analysis.both.as_ref().map(|both| both.speeds[k.index()]);
        let speed = match (self.analysis.found.as_ref(), &self.case.vehicles[k.index()].motion) {
            _ if both.is_some() => both,
            (Some(found), _) if found.unknown == k => Some(found.speed),
            (_, Some(Velocity::Speed(speed))) => Some(speed.si()),
            _ => None,
        };
        let (_, course) = course(self.case, k);
        let mut steps = Vec::new();
        for (axis, function, value) in [("x", "cos", before.velocity.x), ("y", "sin", before.velocity.y)] {
            let of = |source: &'static str| {
                let name = format!("velocity of vehicle {k} along {axis}");
                step(name, format!("v_{k}{axis}"), (value, "m/s"), source)
            };
            steps.push(match speed {
                Some(speed) => of("theory 1")
                    .equals(format!("s_{k} {function} {course}"))
                    .with([(format!("s_{k}"), n(speed, "m/s"))]),
                None => of("input"),
            });
        }
        if before.yaw_rate != 0.0 {
            let name = format!("yaw rate of vehicle {k}");
            steps.push(step(name, format!("ω_{k}"), (before.yaw_rate, "rad/s"), "input"));
        }
        steps
    }

    /// The velocity of vehicle 1 relative to vehicle 2 at C along n or t.
    pub(super) fn relative(&self, axis: &str, motions: &[Motion; 2]) -> (String, Known) {
        let moving: Vec<VehicleId> = self.moving().collect();
        relative(axis, ["v", "ω"], &self.impact.contact, &moving, motions)
    }

    /// The motion of a vehicle after the impact, its ΔV and PDOF; empty for a fixed object.
    pub(super) fn motion(&self, k: VehicleId) -> Vec<Draft> {
        let (outcome, i) = (&self.impact.outcome, k.index());
        if !self.has_inertia[i] {
            return Vec::new();
        }
        let after = outcome.after[i];
        // Vehicle 2 takes −P.
        let sign = if k == VehicleId::One { "+" } else { "−" };
        let velocity = |axis: &str, value: f64| {
            let name = format!("velocity of vehicle {k} along {axis}, after");
            step(name, format!("V_{k}{axis}"), (value, "m/s"), "theory 2")
                .equals(format!("v_{k}{axis} {sign} P_{axis}/m_{k}"))
        };
        let moment = if outcome.moment_impulse == 0.0 { "" } else { " + M" };
        let change = (outcome.delta_v_magnitude()[i], "m/s");
        vec![
            velocity("x", after.velocity.x),
            velocity("y", after.velocity.y),
            step(
                format!("yaw rate of vehicle {k}, after"),
                format!("Ω_{k}"),
                (after.yaw_rate, "rad/s"),
                "theory 2",
            )
            .equals(format!("ω_{k} {sign} (r_{k}n P_t − r_{k}t P_n{moment})/I_{k}"))
            .with(yaw_rates("ω", &outcome.before)),
            step(format!("velocity change of vehicle {k}"), format!("ΔV_{k}"), change, "theory 2")
                .equals(format!("√(P_x² + P_y²)/m_{k}")),
            pdof(k, "P_", k == VehicleId::One, self.case.axes, self.impact.pdof[i]),
        ]
    }
}

/// The PDOF (rad) of a vehicle, from a vector along the force on it or, unless `is_along`, against it.
pub(in super::super) fn pdof(k: VehicleId, vector: &str, is_along: bool, axes: Axes, value: f64) -> Draft {
    let [x, y] = ["x", "y"].map(|axis| format!("{vector}{axis}"));
    // A PDOF is clockwise in any axes: the relevant component is the one to the left, which in z-down axes is
    // −y.
    let left = if is_along == (axes == Axes::ZUp) {
        format!("{y} cos θ_{k} − {x} sin θ_{k}")
    } else {
        format!("{x} sin θ_{k} − {y} cos θ_{k}")
    };
    let behind = if is_along {
        format!("−{x} cos θ_{k} − {y} sin θ_{k}")
    } else {
        format!("{x} cos θ_{k} + {y} sin θ_{k}")
    };
    let name = format!("principal direction of force on vehicle {k}, clockwise from its heading");
    step(name, format!("PDOF_{k}"), (value.to_degrees(), "°"), "theory 4")
        .equals(format!("atan2({left}, {behind})"))
}

/// The yaw rates in the given symbol; one that is zero has no step.
pub(in super::super) fn yaw_rates(symbol: &str, motions: &[Motion; 2]) -> Known {
    let of = |k: VehicleId| (format!("{symbol}_{k}"), n(motions[k.index()].yaw_rate, "rad/s"));
    VehicleId::ALL.map(of).to_vec()
}

/// The velocity of vehicle 1 relative to vehicle 2 at C along n or t, in the given symbols of the velocities
/// and yaw rates, and what these stand for.
pub(in super::super) fn relative(
    axis: &str,
    [v, w]: [&str; 2],
    contact: &Contact,
    moving: &[VehicleId],
    motions: &[Motion; 2],
) -> (String, Known) {
    let mut formula = String::new();
    let mut own: Vec<(String, Amount)> = vec![("Γ".to_owned(), angle(contact.normal_angle()))];
    own.extend(yaw_rates(w, motions));
    for &k in moving {
        let (velocity, arm) = (motions[k.index()].velocity, contact.arms()[k.index()]);
        own.extend([
            (format!("{v}_{k}x"), n(velocity.x, "m/s")),
            (format!("{v}_{k}y"), n(velocity.y, "m/s")),
            (format!("r_{k}n"), n(arm.normal, "m")),
            (format!("r_{k}t"), n(arm.tangential, "m")),
        ]);
        // Vehicle 1 relative to vehicle 2.
        formula.push_str(match (k, formula.is_empty()) {
            (VehicleId::One, _) => "",
            (VehicleId::Two, true) => "−",
            (VehicleId::Two, false) => " − ",
        });
        formula.push_str(&match axis {
            "n" => format!("({v}_{k}x cos Γ + {v}_{k}y sin Γ − {w}_{k} r_{k}t)"),
            _ => format!("({v}_{k}y cos Γ − {v}_{k}x sin Γ + {w}_{k} r_{k}n)"),
        });
    }
    (formula, own)
}
