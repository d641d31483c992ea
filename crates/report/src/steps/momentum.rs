//! Both speeds from momentum, the closed forms of the paths to rest, and skid marks.

use analysis::{BothFound, BothMethod, ClosedForm, Exchange, Seen, Travel};
use case::{Basis, Case};
use pim_core::{Real, VehicleId};

use super::collision::{kinetic, pdof, relative, works};
use super::damage::share;
use super::{Draft, DraftGroup, angle, course, group, n, step};

/// Both speeds.
pub(super) fn both(case: &Case, analysis: &Seen) -> Vec<DraftGroup> {
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
    /// The symbol of the direction of travel before the impact.
    fn course(&self, k: VehicleId) -> String {
        course(self.case, k).1
    }

    fn moving(&self) -> Vec<VehicleId> {
        VehicleId::ALL.into_iter().filter(|k| self.analysis.moves(*k)).collect()
    }

    /// How the vehicles left the impact: a result of a simulation has no equation to put numbers into.
    fn departures(&self) -> Vec<Draft> {
        let mut steps = Vec::new();
        for k in self.moving() {
            let velocity = self.both.momentum.after[k.index()].velocity;
            let travel = self.analysis.travel[k.index()].as_ref();
            let is_found = travel.is_some_and(|travel| travel.origin.is_by_rest());
            let after = self.case.vehicles[k.index()].after.as_ref();
            let told = after.and_then(|after| after.speed.zip(after.direction)).filter(|_| !is_found);
            for (axis, function, value) in [("x", "cos", velocity.x), ("y", "sin", velocity.y)] {
                let of = |source: &'static str| {
                    let name = format!("velocity of vehicle {k} after impact along {axis}");
                    step(name, format!("V_{k}{axis}"), (value, "m/s"), source)
                };
                steps.push(match told {
                    Some((speed, direction)) => {
                        of("theory 10").equals(format!("V_{k} {function} φ_{k}")).with([
                            (format!("V_{k}"), n(speed.si(), "m/s")),
                            (format!("φ_{k}"), angle(direction.si())),
                        ])
                    }
                    None => of("theory 11"),
                });
            }
        }
        steps
    }

    fn speeds(&self) -> Vec<Draft> {
        let total = self.both.momentum.total();
        let mut steps = Vec::new();
        for (axis, value) in [("x", total.x), ("y", total.y)] {
            let terms: Vec<String> = self.moving().iter().map(|k| format!("m_{k} V_{k}{axis}")).collect();
            let name = format!("momentum along {axis}");
            steps
                .push(step(name, format!("p_{axis}"), (value, "N·s"), "theory 10").equals(terms.join(" + ")));
        }
        match self.both.method {
            BothMethod::Momentum => {
                let [a1, a2] = VehicleId::ALL.map(|k| self.course(k));
                let across = format!("sin({a2} − {a1})");
                steps.extend([
                    self.speed(VehicleId::One, "")
                        .equals(format!("(p_x sin {a2} − p_y cos {a2})/(m_1 {across})")),
                    self.speed(VehicleId::Two, "")
                        .equals(format!("(p_y cos {a1} − p_x sin {a1})/(m_2 {across})")),
                ]);
            }
            // The speed of one vehicle along its course, if that of the other is known.
            BothMethod::MomentumAndSpeed { given: other } => {
                let k = other.other();
                let [a, b] = [k, other].map(|k| self.course(k));
                let known = self.speed(other, "");
                steps.push(Draft { source: "input", ..known });
                steps.push(self.speed(k, "").equals(format!(
                    "(p_x cos {a} + p_y sin {a} − m_{other} v_{other} cos({b} − {a}))/m_{k}"
                )));
            }
            BothMethod::Wall { vehicle, restitution } => return self.wall(vehicle, restitution),
            BothMethod::MomentumAndCrush { .. } => steps.extend(self.collinear()),
        }
        steps
    }

    fn speed(&self, k: VehicleId, how: &str) -> Draft {
        let speed = (self.both.speeds[k.index()], "m/s");
        step(format!("speed of vehicle {k}{how}"), format!("v_{k}"), speed, "theory 10")
    }

    /// The speed into a fixed object is the root of a linear equation; it is checked by the restitution.
    fn wall(&self, k: VehicleId, restitution: f64) -> Vec<Draft> {
        let [before, after] = [self.both.implied.approach, self.both.implied.separation]
            .map(|velocity| (velocity.normal, "m/s"));
        vec![
            self.speed(k, ", found with U_n = −e u_n"),
            step("restitution", "e", (restitution, ""), "input"),
            step("relative velocity at C along n, before", "u_n", before, "theory 10"),
            step("relative velocity at C along n, after", "U_n", after, "theory 10").equals("−e u_n"),
        ]
    }

    /// ΔV and PDOF of both vehicles, and the impulse on vehicle 1.
    fn changes(&self, effect: &Exchange) -> Vec<Draft> {
        let mut steps = Vec::new();
        for k in self.moving() {
            let i = k.index();
            let course = self.course(k);
            let (before, change) = (effect.before[i].velocity, effect.delta_v[i]);
            for (axis, function, before, change) in
                [("x", "cos", before.x, change.x), ("y", "sin", before.y, change.y)]
            {
                let name = format!("velocity of vehicle {k} before impact along {axis}");
                steps.push(
                    step(name, format!("v_{k}{axis}"), (before, "m/s"), "theory 1")
                        .equals(format!("v_{k} {function} {course}"))
                        .with([(format!("v_{k}"), n(self.both.speeds[i], "m/s"))]),
                );
                let name = format!("velocity change of vehicle {k} along {axis}");
                steps.push(
                    step(name, format!("ΔV_{k}{axis}"), (change, "m/s"), "theory 10")
                        .equals(format!("V_{k}{axis} − v_{k}{axis}")),
                );
            }
            let name = format!("ΔV of vehicle {k} by momentum");
            steps.push(
                step(name, format!("ΔV_{k}"), (change.norm(), "m/s"), "theory 10")
                    .equals(format!("√(ΔV_{k}x² + ΔV_{k}y²)")),
            );
            // The vehicle's own velocity change is along the force on it.
            steps.push(pdof(k, &format!("ΔV_{k}"), true, self.case.axes, effect.pdof[i]));
        }
        for (axis, value) in [("x", effect.impulse_vector.x), ("y", effect.impulse_vector.y)] {
            let formula = match self.moving().as_slice() {
                [VehicleId::One] => format!("m_1 ΔV_1{axis}"),
                [VehicleId::Two] => format!("−m_2 ΔV_2{axis}"),
                _ => format!("(m_1 ΔV_1{axis} − m_2 ΔV_2{axis})/2"),
            };
            let name = format!("impulse on vehicle 1 along {axis}, the mean by both vehicles");
            steps.push(step(name, format!("P_{axis}"), (value, "N·s"), "theory 10").equals(formula));
        }
        steps
    }

    /// Relative velocities, restitution, impulse ratio and works; empty for point masses.
    fn at_contact(&self, effect: &Exchange) -> Vec<Draft> {
        let Some(at) = &effect.at_contact else { return Vec::new() };
        let contact = &self.both.momentum.contact;
        let moving = self.moving();
        let [u, v] = at.velocities;
        let mut steps = Vec::new();
        for (axis, before, after) in [("n", u.normal, v.normal), ("t", u.tangential, v.tangential)] {
            for (when, symbol, of, motions, value, source) in [
                ("before", "u", ["v", "ω"], &effect.before, before, "theory 1"),
                ("after", "U", ["V", "Ω"], &self.both.implied.after, after, "theory 10"),
            ] {
                let (formula, own) = relative(axis, of, contact, &moving, motions);
                let name = format!("relative velocity at C along {axis}, {when}");
                let relative = step(name, format!("{symbol}_{axis}"), (value, "m/s"), source);
                steps.push(relative.equals(formula).with(own));
            }
        }
        for (axis, formula, value) in [
            ("n", "P_x cos Γ + P_y sin Γ", at.impulse.normal),
            ("t", "P_y cos Γ − P_x sin Γ", at.impulse.tangential),
        ] {
            steps.push(
                step(format!("impulse along {axis}"), format!("P_{axis}"), (value, "N·s"), "theory 3")
                    .equals(formula)
                    .with([("Γ", angle(contact.normal_angle()))]),
            );
        }
        if let Some(restitution) = effect.restitution {
            let by_momentum = step("restitution by momentum", "e", (restitution, ""), "theory 10");
            steps.push(by_momentum.equals("−U_n/u_n"));
        }
        if let Some(ratio) = at.impulse_ratio {
            steps.push(step("impulse ratio by momentum", "μ", (ratio, ""), "theory 3").equals("P_t/P_n"));
        }
        steps.extend(works(effect.energy));
        steps
    }

    /// The kinetic energies, their difference, and the part of it that neither work explains.
    fn energy(&self, effect: &Exchange) -> Vec<Draft> {
        let energy = effect.energy;
        let motions = [&effect.before, &self.both.implied.after];
        let mut steps: Vec<Draft> =
            kinetic(&self.moving(), motions, energy, effect.at_contact.is_some()).into();
        let loss = step("energy loss by momentum", "E_L", (energy.loss, "J"), "theory 10");
        steps.push(loss.equals("T − T'"));
        if energy.moment_work != 0.0 {
            let name = "moment work, what the impulse at C leaves of the loss";
            let moment_work = step(name, "W_m", (energy.moment_work, "J"), "theory 4");
            steps.push(moment_work.equals("E_L − W_n − W_t"));
        }
        steps
    }

    /// The pair of speeds is found by a search; the momentum along the shared line follows from it.
    fn collinear(&self) -> Vec<Draft> {
        let axis = self.both.momentum.common_axis();
        let total = self.both.momentum.total();
        let along = (total.x * axis.x + total.y * axis.y, "N·s");
        let direction = [("a", angle(Real::atan2(axis.y, axis.x)))];
        let [a1, a2] = VehicleId::ALL.map(|k| self.course(k));
        let condition = match self.analysis.basis {
            Basis::Dissipated => "W_n = E",
            Basis::Absorbed => "W_n = (1 − e²) E",
            Basis::TangentialShare(_) => "W_n + λ W_t = E",
        };
        let found = |k: VehicleId| self.speed(k, &format!(", found with {condition}"));
        let mut steps: Vec<Draft> = share(self.analysis).into_iter().collect();
        steps.extend([
            step("momentum along the shared line, at the angle a", "p_a", along, "theory 10")
                .equals("p_x cos a + p_y sin a")
                .with(direction),
            found(VehicleId::One),
            found(VehicleId::Two),
            step("momentum of these speeds along the line", "p_a", along, "theory 10")
                .equals(format!("m_1 v_1 cos({a1} − a) + m_2 v_2 cos({a2} − a)"))
                .with(direction),
        ]);
        steps
    }
}

/// The closed forms of the paths to rest, and the skid marks before the impact.
pub(super) fn ways(analysis: &Seen) -> Vec<DraftGroup> {
    let mut groups = Vec::new();
    for k in VehicleId::ALL {
        if let Some(travel) = &analysis.travel[k.index()] {
            groups.push(group(format!("Path of vehicle {k} to rest, by a closed form"), closed(travel, k)));
        }
        if let Some(skid) = analysis.skids[k.index()] {
            let name = format!("speed of vehicle {k} where its skid begins");
            let steps = vec![
                step(name, format!("v_b{k}"), (skid.speed, "m/s"), "theory 11")
                    .equals(format!("√(v_{k}² + 2 μ g S)"))
                    .with([(format!("v_{k}"), n(analysis.speed(k).abs(), "m/s"))])
                    .with([("μ", n(skid.friction, "")), ("S", n(skid.length, "m"))]),
            ];
            let is_graded = analysis.surface.as_ref().is_some_and(|ground| ground.grade.norm() > 0.0);
            let ground = if is_graded { ", on level ground, without the grade" } else { "" };
            groups.push(group(format!("Skid of vehicle {k} before impact{ground}"), steps));
        }
    }
    groups
}

fn closed(travel: &Travel, k: VehicleId) -> Vec<Draft> {
    let of = |[what, way]: [&str; 2], symbol: &str, value: (f64, &'static str), formula: &str| {
        step(format!("{what} of vehicle {k} {way}"), format!("{symbol}_{k}"), value, "theory 11")
            .equals(formula)
            .with([("S", n(travel.rest.distance, "m")), ("μ", n(travel.friction, ""))])
    };
    match travel.closed {
        None => Vec::new(),
        Some(ClosedForm::Straight { drag_share, speed }) => {
            let name = ["speed", "after impact, straight to rest"];
            vec![of(name, "V", (speed, "m/s"), "√(2 μ g f S)").with([("f", n(drag_share, ""))])]
        }
        Some(ClosedForm::Spin(start)) => {
            let body = travel.chassis.body();
            let own = [
                ("Δψ", n(travel.rest.heading - travel.start.heading, "")),
                ("k²", n(body.yaw_inertia() / body.mass(), "m²")),
                ("a + b", n(travel.chassis.wheelbase(), "m")),
                ("T", n(start.time, "s")),
            ];
            [
                (["time", "to rest, spinning"], "T", (start.time, "s"), "√((2 S + 4 k² |Δψ|/(a + b))/(μ g))"),
                (["speed", "after impact, spinning"], "V", (start.speed, "m/s"), "2 S/T"),
                (["yaw rate", "after impact, spinning"], "Ω", (start.yaw_rate, "rad/s"), "2 Δψ/T"),
            ]
            .map(|(name, symbol, value, formula)| of(name, symbol, value, formula).with(own))
            .into()
        }
    }
}
