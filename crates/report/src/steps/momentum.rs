//! Both speeds from momentum, the closed forms of the paths to rest, and skid marks.

use analysis::{BothFound, BothMethod, ClosedForm, Seen, Travel};
use case::{Basis, Case, STANDARD_GRAVITY};
use pim_core::{Real, VehicleId};

use super::damage::share;
use super::{Step, StepGroup, angle, given, group, n, p, step};

/// Both speeds.
pub(super) fn both(case: &Case, analysis: &Seen) -> Vec<StepGroup> {
    let Some(both) = &analysis.both else { return Vec::new() };
    let momentum = Momentum { case, analysis, both };
    let title = if both.sought().is_some() { "Speed" } else { "Both speeds" };
    vec![
        group("Velocities after impact, by the evidence", momentum.departures()),
        group(title, momentum.speeds()),
    ]
}

struct Momentum<'a> {
    case: &'a Case,
    analysis: &'a Seen,
    both: &'a BothFound,
}

impl Momentum<'_> {
    fn mass(&self, k: VehicleId) -> f64 {
        self.both.momentum.contact.participants()[k.index()].body().mass()
    }

    /// (rad)
    fn heading(&self, k: VehicleId) -> f64 {
        self.case.vehicles[k.index()].heading.as_ref().map_or(0.0, case::Quantity::si)
    }

    /// How the vehicles left the impact: a result of a simulation has no equation to put numbers into.
    fn departures(&self) -> Vec<Step> {
        let mut steps = Vec::new();
        for k in VehicleId::ALL.into_iter().filter(|k| self.analysis.moves(*k)) {
            let velocity = self.both.momentum.after[k.index()].velocity;
            let travel = self.analysis.travel[k.index()].as_ref();
            let is_found = travel.is_some_and(|travel| travel.origin.is_by_rest());
            let after = self.case.vehicles[k.index()].after.as_ref();
            let told = after.and_then(|after| after.speed.zip(after.direction)).filter(|_| !is_found);
            for (axis, function, value) in [("x", "cos", velocity.x), ("y", "sin", velocity.y)] {
                let name = format!("velocity of vehicle {k} after impact along {axis}");
                let symbol = format!("V_{k}{axis}");
                steps.push(match told {
                    Some((speed, direction)) => step(
                        name,
                        symbol,
                        format!("V_{k} {function} φ_{k}"),
                        format!("{} · {function}{}", n(speed.si(), "m/s"), angle(direction.si())),
                        value,
                        "m/s",
                        "theory 10",
                    ),
                    None => given(name, symbol, value, "m/s", "theory 11"),
                });
            }
        }
        steps
    }

    fn speeds(&self) -> Vec<Step> {
        let [one, two] = &self.both.momentum.after;
        let [m1, m2] = VehicleId::ALL.map(|k| self.mass(k));
        let total = self.both.momentum.total();
        let mut steps = Vec::new();
        for (axis, value, parts) in [
            ("x", total.x, [one.velocity.x, two.velocity.x]),
            ("y", total.y, [one.velocity.y, two.velocity.y]),
        ] {
            steps.push(step(
                format!("momentum along {axis}"),
                format!("p_{axis}"),
                format!("m_1 V_1{axis} + m_2 V_2{axis}"),
                format!(
                    "{} · {} + {} · {}",
                    n(m1, "kg"),
                    n(parts[0], "m/s"),
                    n(m2, "kg"),
                    n(parts[1], "m/s")
                ),
                value,
                "N·s",
                "theory 10",
            ));
        }
        match self.both.method {
            BothMethod::Momentum => steps.extend(self.crossing()),
            BothMethod::MomentumAndSpeed { given } => steps.extend(self.beside(given)),
            BothMethod::Wall { vehicle, restitution } => return self.wall(vehicle, restitution),
            BothMethod::MomentumAndCrush { .. } => steps.extend(self.collinear()),
        }
        steps
    }

    fn crossing(&self) -> Vec<Step> {
        let total = self.both.momentum.total();
        let (x, y) = (n(total.x, "N·s"), n(total.y, "N·s"));
        let [h1, h2] = VehicleId::ALL.map(|k| angle(self.heading(k)));
        let between = angle(self.heading(VehicleId::Two) - self.heading(VehicleId::One));
        let [v1, v2] = self.both.speeds;
        let mut steps = vec![
            step(
                "speed of vehicle 1",
                "v_1",
                "(p_x sin θ_2 − p_y cos θ_2)/(m_1 sin(θ_2 − θ_1))",
                format!(
                    "({x} · sin{h2} − {y} · cos{h2}) / ({} · sin{between})",
                    n(self.mass(VehicleId::One), "kg")
                ),
                v1,
                "m/s",
                "theory 10",
            ),
            step(
                "speed of vehicle 2",
                "v_2",
                "(p_y cos θ_1 − p_x sin θ_1)/(m_2 sin(θ_2 − θ_1))",
                format!(
                    "({y} · cos{h1} − {x} · sin{h1}) / ({} · sin{between})",
                    n(self.mass(VehicleId::Two), "kg")
                ),
                v2,
                "m/s",
                "theory 10",
            ),
        ];
        steps.extend(self.delta_v());
        steps
    }

    /// The speed along the heading of one vehicle, if that of the other is known.
    fn beside(&self, other: VehicleId) -> Vec<Step> {
        let k = other.other();
        let total = self.both.momentum.total();
        let (x, y) = (n(total.x, "N·s"), n(total.y, "N·s"));
        let heading = angle(self.heading(k));
        let between = angle(self.heading(other) - self.heading(k));
        let known = self.both.speeds[other.index()];
        let mut steps = vec![
            given(format!("speed of vehicle {other}"), format!("v_{other}"), known, "m/s", "input"),
            step(
                format!("speed of vehicle {k}"),
                format!("v_{k}"),
                format!("(p_x cos θ_{k} + p_y sin θ_{k} − m_{other} v_{other} cos(θ_{other} − θ_{k}))/m_{k}"),
                format!(
                    "({x} · cos{heading} + {y} · sin{heading} − {} · {} · cos{between}) / {}",
                    n(self.mass(other), "kg"),
                    n(known, "m/s"),
                    n(self.mass(k), "kg")
                ),
                self.both.speeds[k.index()],
                "m/s",
                "theory 10",
            ),
        ];
        steps.extend(self.delta_v());
        steps
    }

    /// The speed into a fixed object is the root of a linear equation; it is checked by the restitution.
    fn wall(&self, k: VehicleId, restitution: f64) -> Vec<Step> {
        let implied = &self.both.implied;
        vec![
            given(
                format!("speed of vehicle {k}, found with U_n = −e u_n"),
                format!("v_{k}"),
                self.both.speeds[k.index()],
                "m/s",
                "theory 10",
            ),
            given("restitution", "e", restitution, "", "input"),
            given(
                "relative velocity at C along n, before",
                "u_n",
                implied.approach.normal,
                "m/s",
                "theory 10",
            ),
            step(
                "relative velocity at C along n, after",
                "U_n",
                "−e u_n",
                format!("−{} · {}", n(restitution, ""), n(implied.approach.normal, "m/s")),
                implied.separation.normal,
                "m/s",
                "theory 10",
            ),
        ]
    }

    fn delta_v(&self) -> Vec<Step> {
        let mut steps = Vec::new();
        for k in VehicleId::ALL {
            let after = self.both.momentum.after[k.index()].velocity;
            let before = self.both.implied.before[k.index()].velocity;
            steps.push(step(
                format!("ΔV of vehicle {k} by momentum"),
                format!("ΔV_{k}"),
                format!("√((V_{k}x − v_{k}x)² + (V_{k}y − v_{k}y)²)"),
                format!(
                    "√(({} − {})² + ({} − {})²)",
                    n(after.x, "m/s"),
                    n(before.x, "m/s"),
                    n(after.y, "m/s"),
                    n(before.y, "m/s")
                ),
                self.both.implied.delta_v[k.index()].norm(),
                "m/s",
                "theory 10",
            ));
        }
        steps
    }

    /// The pair of speeds is found by a search; the momentum along the shared line follows from it.
    fn collinear(&self) -> Vec<Step> {
        let axis = self.both.momentum.common_axis();
        let total = self.both.momentum.total();
        let direction = Real::atan2(axis.y, axis.x);
        let along = total.x * axis.x + total.y * axis.y;
        let [v1, v2] = self.both.speeds;
        let [c1, c2] = VehicleId::ALL.map(|k| angle(self.heading(k) - direction));
        let condition = match self.analysis.basis {
            Basis::Dissipated => "W_n = E",
            Basis::Absorbed => "W_n = (1 − e²) E",
            Basis::TangentialShare(_) => "W_n + λ W_t = E",
        };
        let found = |k: VehicleId, speed: f64| {
            let name = format!("speed of vehicle {k}, found with {condition}");
            given(name, format!("v_{k}"), speed, "m/s", "theory 10")
        };
        let mut steps = share(self.analysis);
        steps.extend([
            step(
                "momentum along the shared line, at the angle a",
                "p_a",
                "p_x cos a + p_y sin a",
                format!(
                    "{} · cos{} + {} · sin{}",
                    n(total.x, "N·s"),
                    angle(direction),
                    n(total.y, "N·s"),
                    angle(direction)
                ),
                along,
                "N·s",
                "theory 10",
            ),
            found(VehicleId::One, v1),
            found(VehicleId::Two, v2),
            step(
                "momentum of these speeds along the line",
                "p_a",
                "m_1 v_1 cos(θ_1 − a) + m_2 v_2 cos(θ_2 − a)",
                format!(
                    "{} · {} · cos{c1} + {} · {} · cos{c2}",
                    n(self.mass(VehicleId::One), "kg"),
                    n(v1, "m/s"),
                    n(self.mass(VehicleId::Two), "kg"),
                    n(v2, "m/s")
                ),
                along,
                "N·s",
                "theory 10",
            ),
        ]);
        steps
    }
}

/// The closed forms of the paths to rest, and the skid marks before the impact.
pub(super) fn ways(analysis: &Seen) -> Vec<StepGroup> {
    let mut groups = Vec::new();
    for k in VehicleId::ALL {
        if let Some(travel) = &analysis.travel[k.index()] {
            groups.push(group(format!("Path of vehicle {k} to rest, by a closed form"), closed(travel, k)));
        }
        if let Some(skid) = analysis.skids[k.index()] {
            let speed = analysis.speed(k).abs();
            let steps = vec![step(
                format!("speed of vehicle {k} where its skid begins"),
                format!("v_b{k}"),
                format!("√(v_{k}² + 2 μ g S)"),
                format!(
                    "√({}² + 2 · {} · {} · {})",
                    p(speed, "m/s"),
                    n(skid.friction, ""),
                    n(STANDARD_GRAVITY, "m/s²"),
                    n(skid.length, "m")
                ),
                skid.speed,
                "m/s",
                "theory 11",
            )];
            let is_graded = analysis.surface.as_ref().is_some_and(|ground| ground.grade.norm() > 0.0);
            let ground = if is_graded { ", on level ground, without the grade" } else { "" };
            groups.push(group(format!("Skid of vehicle {k} before impact{ground}"), steps));
        }
    }
    groups
}

fn closed(travel: &Travel, k: VehicleId) -> Vec<Step> {
    let distance = travel.rest.distance;
    let (mu, g) = (n(travel.friction, ""), n(STANDARD_GRAVITY, "m/s²"));
    match travel.closed {
        None => Vec::new(),
        Some(ClosedForm::Straight { drag_share, speed }) => vec![step(
            format!("speed of vehicle {k} after impact, straight to rest"),
            format!("V_{k}"),
            "√(2 μ g f S)",
            format!("√(2 · {mu} · {g} · {} · {})", n(drag_share, ""), n(distance, "m")),
            speed,
            "m/s",
            "theory 11",
        )],
        Some(ClosedForm::Spin(start)) => {
            let turn = travel.rest.heading - travel.start.heading;
            let body = travel.chassis.body();
            let square = body.yaw_inertia() / body.mass();
            vec![
                step(
                    format!("time of vehicle {k} to rest, spinning"),
                    format!("T_{k}"),
                    "√((2 S + 4 k² |Δψ|/(a + b))/(μ g))",
                    format!(
                        "√((2 · {} + 4 · {} · {} / {}) / ({mu} · {g}))",
                        n(distance, "m"),
                        n(square, "m²"),
                        n(turn.abs(), ""),
                        n(travel.chassis.wheelbase(), "m")
                    ),
                    start.time,
                    "s",
                    "theory 11",
                ),
                step(
                    format!("speed of vehicle {k} after impact, spinning"),
                    format!("V_{k}"),
                    "2 S/T",
                    format!("2 · {} / {}", n(distance, "m"), n(start.time, "s")),
                    start.speed,
                    "m/s",
                    "theory 11",
                ),
                step(
                    format!("yaw rate of vehicle {k} after impact, spinning"),
                    format!("Ω_{k}"),
                    "2 Δψ/T",
                    format!("2 · {} / {}", n(turn, ""), n(start.time, "s")),
                    start.yaw_rate,
                    "rad/s",
                    "theory 11",
                ),
            ]
        }
    }
}
