//! Both speeds from momentum, the closed forms of the paths to rest, and skid marks.

use analysis::{BothFound, BothMethod, ClosedForm, Exchange, Seen, Travel};
use case::{Axes, Basis, Case, STANDARD_GRAVITY};
use pim_core::{Real, Vector2, VehicleId};

use super::collision::{kinetic, relative, work};
use super::damage::share;
use super::{Step, StepGroup, angle, course, group, heading, n, p, step};

/// Both speeds.
pub(super) fn both(case: &Case, analysis: &Seen) -> Vec<StepGroup> {
    let Some(both) = &analysis.both else { return Vec::new() };
    let momentum = Momentum { case, analysis, both };
    let title = if both.sought().is_some() { "Speed" } else { "Both speeds" };
    let mut groups = vec![
        group("Velocities after impact, by the evidence", momentum.departures()),
        group(title, momentum.speeds()),
    ];
    // By the crush energy, the impact by the law is the result.
    if let Some(effect) = analysis.exchange().filter(|_| !both.is_by_crush()) {
        groups.push(group("Velocity changes and impulse, by momentum", momentum.changes(&effect)));
        groups.push(group("At the contact point, by momentum", momentum.at_contact(&effect)));
        groups.push(group("Energy balance, by momentum", momentum.energy(&effect)));
    }
    groups
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

    /// (rad) the direction of travel before the impact, and its symbol.
    fn course(&self, k: VehicleId) -> (f64, String) {
        course(self.case, k)
    }

    fn moving(&self) -> Vec<VehicleId> {
        VehicleId::ALL.into_iter().filter(|k| self.analysis.moves(*k)).collect()
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
                    Some((speed, direction)) => step(name, symbol)
                        .equals(
                            format!("V_{k} {function} φ_{k}"),
                            format!("{} · {function}{}", n(speed.si(), "m/s"), angle(direction.si())),
                        )
                        .is(value, "m/s", "theory 10"),
                    None => step(name, symbol).is(value, "m/s", "theory 11"),
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
            steps.push(
                step(format!("momentum along {axis}"), format!("p_{axis}"))
                    .equals(
                        format!("m_1 V_1{axis} + m_2 V_2{axis}"),
                        format!(
                            "{} · {} + {} · {}",
                            n(m1, "kg"),
                            n(parts[0], "m/s"),
                            n(m2, "kg"),
                            n(parts[1], "m/s")
                        ),
                    )
                    .is(value, "N·s", "theory 10"),
            );
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
        let [(one, a1), (two, a2)] = VehicleId::ALL.map(|k| self.course(k));
        let [h1, h2, between] = [one, two, two - one].map(angle);
        let [v1, v2] = self.both.speeds;
        vec![
            step("speed of vehicle 1", "v_1")
                .equals(
                    format!("(p_x sin {a2} − p_y cos {a2})/(m_1 sin({a2} − {a1}))"),
                    format!(
                        "({x} · sin{h2} − {y} · cos{h2}) / ({} · sin{between})",
                        n(self.mass(VehicleId::One), "kg")
                    ),
                )
                .is(v1, "m/s", "theory 10"),
            step("speed of vehicle 2", "v_2")
                .equals(
                    format!("(p_y cos {a1} − p_x sin {a1})/(m_2 sin({a2} − {a1}))"),
                    format!(
                        "({y} · cos{h1} − {x} · sin{h1}) / ({} · sin{between})",
                        n(self.mass(VehicleId::Two), "kg")
                    ),
                )
                .is(v2, "m/s", "theory 10"),
        ]
    }

    /// The speed of one vehicle along its course, if that of the other is known.
    fn beside(&self, other: VehicleId) -> Vec<Step> {
        let k = other.other();
        let total = self.both.momentum.total();
        let (x, y) = (n(total.x, "N·s"), n(total.y, "N·s"));
        let [(own, a), (others, b)] = [k, other].map(|k| self.course(k));
        let [own, between] = [own, others - own].map(angle);
        let known = self.both.speeds[other.index()];
        vec![
            step(format!("speed of vehicle {other}"), format!("v_{other}")).is(known, "m/s", "input"),
            step(format!("speed of vehicle {k}"), format!("v_{k}"))
                .equals(
                    format!("(p_x cos {a} + p_y sin {a} − m_{other} v_{other} cos({b} − {a}))/m_{k}"),
                    format!(
                        "({x} · cos{own} + {y} · sin{own} − {} · {} · cos{between}) / {}",
                        n(self.mass(other), "kg"),
                        n(known, "m/s"),
                        n(self.mass(k), "kg")
                    ),
                )
                .is(self.both.speeds[k.index()], "m/s", "theory 10"),
        ]
    }

    /// The speed into a fixed object is the root of a linear equation; it is checked by the restitution.
    fn wall(&self, k: VehicleId, restitution: f64) -> Vec<Step> {
        let [before, after] =
            [self.both.implied.approach, self.both.implied.separation].map(|velocity| velocity.normal);
        let found = step(format!("speed of vehicle {k}, found with U_n = −e u_n"), format!("v_{k}"));
        vec![
            found.is(self.both.speeds[k.index()], "m/s", "theory 10"),
            step("restitution", "e").is(restitution, "", "input"),
            step("relative velocity at C along n, before", "u_n").is(before, "m/s", "theory 10"),
            step("relative velocity at C along n, after", "U_n")
                .equals("−e u_n", format!("−{} · {}", n(restitution, ""), n(before, "m/s")))
                .is(after, "m/s", "theory 10"),
        ]
    }

    /// ΔV and PDOF of both vehicles, and the impulse on vehicle 1.
    fn changes(&self, effect: &Exchange) -> Vec<Step> {
        let mut steps = Vec::new();
        for k in self.moving() {
            let i = k.index();
            let (course, symbol) = self.course(k);
            let (before, after, change) =
                (effect.before[i].velocity, effect.velocities[i], effect.delta_v[i]);
            for (axis, function, before, after, change) in
                [("x", "cos", before.x, after.x, change.x), ("y", "sin", before.y, after.y, change.y)]
            {
                steps.push(
                    step(
                        format!("velocity of vehicle {k} before impact along {axis}"),
                        format!("v_{k}{axis}"),
                    )
                    .equals(
                        format!("v_{k} {function} {symbol}"),
                        format!("{} · {function}{}", n(self.both.speeds[i], "m/s"), angle(course)),
                    )
                    .is(before, "m/s", "theory 1"),
                );
                steps.push(
                    step(format!("velocity change of vehicle {k} along {axis}"), format!("ΔV_{k}{axis}"))
                        .equals(
                            format!("V_{k}{axis} − v_{k}{axis}"),
                            format!("{} − {}", n(after, "m/s"), n(before, "m/s")),
                        )
                        .is(change, "m/s", "theory 10"),
                );
            }
            steps.push(
                step(format!("ΔV of vehicle {k} by momentum"), format!("ΔV_{k}"))
                    .equals(
                        format!("√(ΔV_{k}x² + ΔV_{k}y²)"),
                        format!("√({}² + {}²)", p(change.x, "m/s"), p(change.y, "m/s")),
                    )
                    .is(change.norm(), "m/s", "theory 10"),
            );
            steps.push(self.pdof(k, effect));
        }
        let impulse = effect.impulse_vector;
        let changes = |axis: fn(&Vector2<f64>) -> f64| effect.delta_v.each_ref().map(axis);
        for (axis, value, [one, two]) in
            [("x", impulse.x, changes(|v| v.x)), ("y", impulse.y, changes(|v| v.y))]
        {
            let part =
                |k: VehicleId, change: f64| format!("{} · {}", n(self.mass(k), "kg"), n(change, "m/s"));
            let (formula, numbers) = match self.moving().as_slice() {
                [VehicleId::One] => (format!("m_1 ΔV_1{axis}"), part(VehicleId::One, one)),
                [VehicleId::Two] => {
                    (format!("−m_2 ΔV_2{axis}"), format!("(−1) · {}", part(VehicleId::Two, two)))
                }
                _ => (
                    format!("(m_1 ΔV_1{axis} − m_2 ΔV_2{axis})/2"),
                    format!("({} − {}) / 2", part(VehicleId::One, one), part(VehicleId::Two, two)),
                ),
            };
            let name = format!("impulse on vehicle 1 along {axis}, the mean by both vehicles");
            let impulse = step(name, format!("P_{axis}")).equals(formula, numbers);
            steps.push(impulse.is(value, "N·s", "theory 10"));
        }
        steps
    }

    /// From the velocity change of the vehicle itself.
    fn pdof(&self, k: VehicleId, effect: &Exchange) -> Step {
        let theta = angle(heading(self.case, k));
        let change = effect.delta_v[k.index()];
        let (x, y) = (n(change.x, "m/s"), n(change.y, "m/s"));
        // A PDOF is clockwise in any axes: the relevant component is the one to the left, −y in z-down axes.
        let (left, left_numbers) = match self.case.axes {
            Axes::ZUp => (
                format!("ΔV_{k}y cos θ_{k} − ΔV_{k}x sin θ_{k}"),
                format!("{y} · cos{theta} − {x} · sin{theta}"),
            ),
            Axes::ZDown => (
                format!("ΔV_{k}x sin θ_{k} − ΔV_{k}y cos θ_{k}"),
                format!("{x} · sin{theta} − {y} · cos{theta}"),
            ),
        };
        step(
            format!("principal direction of force on vehicle {k}, clockwise from its heading"),
            format!("PDOF_{k}"),
        )
        .equals(
            format!("atan2({left}, −ΔV_{k}x cos θ_{k} − ΔV_{k}y sin θ_{k})"),
            format!("atan2({left_numbers}, (−1) · {x} · cos{theta} − {y} · sin{theta})"),
        )
        .is(effect.pdof[k.index()].to_degrees(), "°", "theory 4")
    }

    /// Relative velocities, restitution, impulse ratio and works; empty for point masses.
    fn at_contact(&self, effect: &Exchange) -> Vec<Step> {
        let Some(at) = &effect.at_contact else { return Vec::new() };
        let contact = &self.both.momentum.contact;
        let gamma = angle(self.gamma());
        let moving = self.moving();
        let [u, v] = at.velocities;
        let mut steps = Vec::new();
        for (axis, before, after) in [("n", u.normal, v.normal), ("t", u.tangential, v.tangential)] {
            let (formula, numbers) = relative(axis, ["v", "ω"], contact, &moving, &effect.before);
            let name = format!("relative velocity at C along {axis}, before");
            let approach = step(name, format!("u_{axis}")).equals(formula, numbers);
            steps.push(approach.is(before, "m/s", "theory 1"));
            let (formula, numbers) = relative(axis, ["V", "Ω"], contact, &moving, &self.both.implied.after);
            let name = format!("relative velocity at C along {axis}, after");
            let separation = step(name, format!("U_{axis}")).equals(formula, numbers);
            steps.push(separation.is(after, "m/s", "theory 10"));
        }
        let (x, y) = (n(effect.impulse_vector.x, "N·s"), n(effect.impulse_vector.y, "N·s"));
        for (axis, formula, numbers, value) in [
            ("n", "P_x cos Γ + P_y sin Γ", format!("{x} · cos{gamma} + {y} · sin{gamma}"), at.impulse.normal),
            (
                "t",
                "P_y cos Γ − P_x sin Γ",
                format!("{y} · cos{gamma} − {x} · sin{gamma}"),
                at.impulse.tangential,
            ),
        ] {
            let name = format!("impulse along {axis}");
            steps.push(step(name, format!("P_{axis}")).equals(formula, numbers).is(value, "N·s", "theory 3"));
        }
        if let Some(restitution) = effect.restitution {
            let numbers = format!("−{} / {}", p(v.normal, "m/s"), n(u.normal, "m/s"));
            let by_momentum = step("restitution by momentum", "e").equals("−U_n/u_n", numbers);
            steps.push(by_momentum.is(restitution, "", "theory 10"));
        }
        if let Some(ratio) = at.impulse_ratio {
            let numbers = format!("{} / {}", n(at.impulse.tangential, "N·s"), n(at.impulse.normal, "N·s"));
            steps.push(
                step("impulse ratio by momentum", "μ").equals("P_t/P_n", numbers).is(ratio, "", "theory 3"),
            );
        }
        let energy = effect.energy;
        steps.push(work("normal work", "n", [at.impulse.normal, u.normal, v.normal], energy.normal_work));
        let along = [at.impulse.tangential, u.tangential, v.tangential];
        steps.push(work("tangential work", "t", along, energy.tangential_work));
        steps
    }

    /// (rad) scene angle of n, in the axes of the case.
    fn gamma(&self) -> f64 {
        self.both.momentum.contact.normal_angle()
    }

    /// The kinetic energies, their difference, and the part of it that neither work explains.
    fn energy(&self, effect: &Exchange) -> Vec<Step> {
        let has_yaw = effect.at_contact.is_some();
        let of = |k: VehicleId| {
            let body = self.both.momentum.contact.participants()[k.index()].body();
            (k, body.mass(), has_yaw.then(|| body.yaw_inertia()))
        };
        let moving: Vec<_> = self.moving().into_iter().map(of).collect();
        let energy = effect.energy;
        let motions = [&effect.before, &self.both.implied.after];
        let [before, after] = kinetic(&moving, motions, [energy.before, energy.after]);
        let mut steps = vec![
            before,
            after,
            step("energy loss by momentum", "E_L")
                .equals("T − T'", format!("{} − {}", n(energy.before, "J"), n(energy.after, "J")))
                .is(energy.loss, "J", "theory 10"),
        ];
        if energy.moment_work != 0.0 {
            let [loss, normal, tangential] =
                [energy.loss, energy.normal_work, energy.tangential_work].map(|work| n(work, "J"));
            steps.push(
                step("moment work, what the impulse at C leaves of the loss", "W_m")
                    .equals("E_L − W_n − W_t", format!("{loss} − {normal} − {tangential}"))
                    .is(energy.moment_work, "J", "theory 4"),
            );
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
        let [(one, a1), (two, a2)] = VehicleId::ALL.map(|k| self.course(k));
        let [c1, c2] = [one, two].map(|course| angle(course - direction));
        let condition = match self.analysis.basis {
            Basis::Dissipated => "W_n = E",
            Basis::Absorbed => "W_n = (1 − e²) E",
            Basis::TangentialShare(_) => "W_n + λ W_t = E",
        };
        let found = |k: VehicleId, speed: f64| {
            let name = format!("speed of vehicle {k}, found with {condition}");
            step(name, format!("v_{k}")).is(speed, "m/s", "theory 10")
        };
        let mut steps = share(self.analysis);
        steps.extend([
            step("momentum along the shared line, at the angle a", "p_a")
                .equals(
                    "p_x cos a + p_y sin a",
                    format!(
                        "{} · cos{} + {} · sin{}",
                        n(total.x, "N·s"),
                        angle(direction),
                        n(total.y, "N·s"),
                        angle(direction)
                    ),
                )
                .is(along, "N·s", "theory 10"),
            found(VehicleId::One, v1),
            found(VehicleId::Two, v2),
            step("momentum of these speeds along the line", "p_a")
                .equals(
                    format!("m_1 v_1 cos({a1} − a) + m_2 v_2 cos({a2} − a)"),
                    format!(
                        "{} · {} · cos{c1} + {} · {} · cos{c2}",
                        n(self.mass(VehicleId::One), "kg"),
                        n(v1, "m/s"),
                        n(self.mass(VehicleId::Two), "kg"),
                        n(v2, "m/s")
                    ),
                )
                .is(along, "N·s", "theory 10"),
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
            let steps = vec![
                step(format!("speed of vehicle {k} where its skid begins"), format!("v_b{k}"))
                    .equals(
                        format!("√(v_{k}² + 2 μ g S)"),
                        format!(
                            "√({}² + 2 · {} · {} · {})",
                            p(speed, "m/s"),
                            n(skid.friction, ""),
                            n(STANDARD_GRAVITY, "m/s²"),
                            n(skid.length, "m")
                        ),
                    )
                    .is(skid.speed, "m/s", "theory 11"),
            ];
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
        Some(ClosedForm::Straight { drag_share, speed }) => vec![
            step(format!("speed of vehicle {k} after impact, straight to rest"), format!("V_{k}"))
                .equals(
                    "√(2 μ g f S)",
                    format!("√(2 · {mu} · {g} · {} · {})", n(drag_share, ""), n(distance, "m")),
                )
                .is(speed, "m/s", "theory 11"),
        ],
        Some(ClosedForm::Spin(start)) => {
            let turn = travel.rest.heading - travel.start.heading;
            let body = travel.chassis.body();
            let square = body.yaw_inertia() / body.mass();
            vec![
                step(format!("time of vehicle {k} to rest, spinning"), format!("T_{k}"))
                    .equals(
                        "√((2 S + 4 k² |Δψ|/(a + b))/(μ g))",
                        format!(
                            "√((2 · {} + 4 · {} · {} / {}) / ({mu} · {g}))",
                            n(distance, "m"),
                            n(square, "m²"),
                            n(turn.abs(), ""),
                            n(travel.chassis.wheelbase(), "m")
                        ),
                    )
                    .is(start.time, "s", "theory 11"),
                step(format!("speed of vehicle {k} after impact, spinning"), format!("V_{k}"))
                    .equals("2 S/T", format!("2 · {} / {}", n(distance, "m"), n(start.time, "s")))
                    .is(start.speed, "m/s", "theory 11"),
                step(format!("yaw rate of vehicle {k} after impact, spinning"), format!("Ω_{k}"))
                    .equals("2 Δψ/T", format!("2 · {} / {}", n(turn, ""), n(start.time, "s")))
                    .is(start.yaw_rate, "rad/s", "theory 11"),
            ]
        }
    }
}
