//! A finished analysis as text for the terminal and the file.

use analysis::quantities as rows;
use analysis::{Analysis, BothFound, Crash3, Damage, Exchange, Found, Inferred, Seen, Weighed, is_uncertain};
use case::{Axes, Basis, Case, Pdof, Text, Velocity, YawSource};
use crash3::{SideStiffness, Stiffness, UniformCrush};
use pim_core::{Energy, Regime, VehicleId};

use super::chosen::Chosen;
use super::headline::{DETAIL, Headline};
use super::motion;
use crate::document::{Block, Document, Table};
use crate::units::{Measure, Units};
use crate::{axes, basis, checks, law, warnings, words};

/// A crush that was not measured: its depth if the width is known, otherwise its bounds.
fn inferred_crush(inferred: &Inferred, units: Units) -> String {
    let length = |si: f64| units.format(Measure::Crush, si);
    let of = |crush: &UniformCrush| format!("{} deep, {} wide", length(crush.depth), length(crush.width));
    let bounds = inferred.range.as_ref().map_or_else(String::new, |range| {
        format!("; possible: {} to {}", of(&range.lowest), of(&range.highest))
    });
    format!("{}, inferred from the force on the other vehicle{bounds}", of(&inferred.crush))
}

/// The analysis for the terminal and the file: what was found, all inputs and results with their equations,
/// and the warnings.
#[must_use]
pub fn results(case: &Case, analysis: &Analysis, units: Units) -> Document {
    match analysis.why_not_exact() {
        Some(why) => headed(case, analysis, Headline::Unweighed(&why), units),
        None => headed(case, analysis, Headline::Exact, units),
    }
}

/// The same for a case with more evidence than its exact solution uses: the answer of all the evidence first,
/// with the objections to each exact solution.
#[must_use]
pub fn weighed(case: &Case, analysis: &Analysis, weighed: &Weighed, units: Units) -> Document {
    headed(case, analysis, Headline::Weighed(weighed), units)
}

fn headed(case: &Case, analysis: &Analysis, headline: Headline<'_>, units: Units) -> Document {
    let analysis = &analysis.seen(case.axes);
    // Values need 88 columns, and the eye follows no more than 120.
    let mut page =
        Page { units, axes: case.axes, headline, document: Document::new().with_columns([88, 120]) };
    page.document.title(case);
    page.document.blocks.extend(headline.lead(analysis, units));
    let [of_case, of_solution] = warnings::of_answer(analysis, headline.weighed(), headline.is_exact());
    if !headline.is_exact() {
        page.document.blocks.extend(warnings::notice(&of_case, None));
        page.document.heading(DETAIL);
    }
    if let Some(found) = &analysis.found {
        page.found(found, analysis);
    }
    if let Some(both) = &analysis.both {
        page.both(both, analysis);
    }
    if !analysis.is_reconstruction() && analysis.impact.is_none() {
        page.rests(analysis);
    }
    if headline.is_exact() {
        // Many read no further than the first screen.
        if analysis.is_reconstruction() {
            page.document.paragraph(taken_as_exact(case));
        }
        page.document.blocks.extend(warnings::notice(&of_case, None));
        // Any other headline names the evidence that the figures do not use.
        page.document.blocks.extend(warnings::left_aside(&analysis.left_aside, analysis.can_be_weighed));
    }
    page.inputs(case, analysis);
    page.document.tables(motion::momentum(analysis, units));
    if let Some(exchange) = analysis.exchange() {
        page.impact(analysis, &exchange);
        page.motion(analysis);
        page.energy(analysis, &exchange.energy);
    }
    page.document.tables(motion::law_check(analysis, units).into_iter().flatten());
    page.document.tables(motion::tables(analysis, units));
    page.damage(analysis);
    if let Some(crash3) = &analysis.crash3 {
        page.crash3(case, analysis, crash3);
    }
    page.document.tables(checks::table(analysis, units));
    if !of_solution.is_empty() {
        page.document.heading("Objections to the exact solution");
        page.document.push(warnings::block(&of_solution, units));
    }
    if headline.is_exact() || !of_case.is_empty() {
        page.document.push(warnings::block(&of_case, units));
    }
    page.document.paragraph(format!(
        "Sources: Eq n is equation n of Brach & Brach, SAE 980025 (1998), with its misprints corrected; \
         theory n is section n of docs/theory.md. {}; n points from vehicle 2 to vehicle 1.",
        axes::conventions(case.axes)
    ));
    page.document
}

/// Why an exact solution has no interval, and what gives one.
fn taken_as_exact(case: &Case) -> &'static str {
    if is_uncertain(case) {
        "Each input is taken at its central value, and the method as exact, so these figures have no interval. \
         `deltav uncertainty` gives intervals from the ranges of the inputs; those of `deltav estimate` also \
         include the errors of the method."
    } else {
        "The inputs and the method are taken as exact, so these figures have no interval. `deltav estimate` gives \
         intervals that include the errors of both."
    }
}

struct Page<'a> {
    units: Units,
    axes: Axes,
    headline: Headline<'a>,
    document: Document,
}

/// The headings of the columns of the vehicles.
const VEHICLES: [&str; 3] = ["vehicle 1", "vehicle 2", ""];

impl Page<'_> {
    /// The findings of the exact solution: as the answer, or as a paragraph if it is not the answer.
    fn answer(&mut self, found: Vec<String>, how: String) {
        if self.headline.is_exact() {
            self.document.push(Block::Answer { found, how });
        } else {
            self.document.paragraph(format!("{}. {how}", found.join("; ")));
        }
    }

    fn found(&mut self, found: &Found, analysis: &Seen) {
        let vehicle = found.unknown;
        let units = self.units;
        let energy = |si: f64| units.format(Measure::Energy, si);
        let work = match analysis.basis {
            Basis::TangentialShare(_) => format!("equals the crush energy, {}", energy(found.crush_energy)),
            Basis::Dissipated => format!(
                "equals the crush energy, {}, which the normal impulse dissipates",
                energy(found.crush_energy)
            ),
            Basis::Absorbed => format!(
                "is W_n = {} = (1 − e²) E, where the crush energy E = {} is what the vehicles absorb up to \
                 maximum engagement, and restitution returns the share e²",
                energy(found.normal_work),
                energy(found.crush_energy)
            ),
        };
        let roots = match found.admissible.len() {
            1 => "One admissible speed".to_owned(),
            several => format!("{several} admissible speeds"),
        };
        let method = search(found);
        let delta_v = analysis.impact.iter().flat_map(|impact| {
            let magnitudes = impact.outcome.delta_v_magnitude();
            let of = |id: &VehicleId| format!("ΔV of vehicle {id}: {}", units.speed(magnitudes[id.index()]));
            VehicleId::ALL.iter().filter(|id| analysis.moves(**id)).map(of).collect::<Vec<_>>()
        });
        let said = std::iter::once(format!("Speed of vehicle {vehicle}: {}", units.speed_along(found.speed)))
            .chain(other_speeds(found, units))
            .chain(delta_v)
            .collect();
        let how = format!(
            "At this speed {} {work}. {roots}, found {method} (theory 6).",
            basis::work(analysis.basis)
        );
        self.answer(said, how);
    }

    /// Both speeds, and how they were found.
    fn both(&mut self, both: &BothFound, analysis: &Seen) {
        let units = self.units;
        let of =
            |id: VehicleId| format!("Speed of vehicle {id}: {}", units.speed_along(both.speeds[id.index()]));
        let change = |id: VehicleId| format!("ΔV of vehicle {id}: {}", units.speed(both.delta_v[id.index()]));
        let moving = VehicleId::ALL.into_iter().filter(|id| analysis.moves(*id));
        let found = both.vehicles().map(of).chain(moving.map(change));
        self.answer(found.collect(), motion::how(both, analysis, units));
    }

    /// The rest positions of the vehicles, or how they left the impact: the answer of a motion alone.
    fn rests(&mut self, analysis: &Seen) {
        let units = self.units;
        let of = |id: VehicleId| {
            let travel = analysis.travel[id.index()].as_ref()?;
            Some(motion::answer(id, travel, units))
        };
        let found: Vec<String> = VehicleId::ALL.into_iter().filter_map(of).collect();
        if !found.is_empty() {
            self.document.push(Block::Answer { found, how: motion::method(analysis, units) });
        }
    }

    fn inputs(&mut self, case: &Case, analysis: &Seen) {
        let units = self.units;
        let mut table = Table::of_two("Inputs as understood", VEHICLES);
        let vehicles = &case.vehicles;
        let mut row =
            |label: &str, of: &dyn Fn(usize) -> Option<String>| table.pair(label, [of(0), of(1)], "");
        row("name", &|i| vehicles[i].name.as_ref().map(Text::to_string));
        row("vehicle", &|i| vehicles[i].is_absent().then(|| "not in the case".to_owned()));
        row("fixed object", &|i| vehicles[i].fixed.then(|| "yes".to_owned()));
        let inertia = |i: usize| analysis.vehicles[i].subject.inertia;
        row("mass", &|i| inertia(i).map(|v| units.format(Measure::Mass, v.mass)));
        row("yaw inertia", &|i| Some(units.format(Measure::YawInertia, inertia(i)?.yaw_inertia?)));
        row("yaw inertia from", &|i| match inertia(i).map(|v| v.yaw_source) {
            Some(YawSource::Class(class)) => Some(format!("CRASH3's class {class}")),
            Some(YawSource::Burg) => Some("Burg's estimate".to_owned()),
            Some(YawSource::Given | YawSource::Unknown) | None => None,
        });
        let angle = |q: &case::Quantity| units.format(Measure::Angle, q.si());
        row("heading θ", &|i| vehicles[i].heading.as_ref().map(angle));
        row("contact point C, forward", &|i| {
            analysis.vehicles[i].subject.contact.map(|c| units.format(Measure::Length, c[0]))
        });
        row(&format!("contact point C, {}", axes::side_of_y(self.axes)), &|i| {
            analysis.vehicles[i].subject.contact.map(|c| units.format(Measure::Length, c[1]))
        });
        let is_placed = |i: usize| analysis.vehicles[i].subject.contact_is_placed;
        row("contact point from", &|i| is_placed(i).then(|| "centroid of the damage".to_owned()));
        let sought = |i: usize| {
            let by_momentum = analysis.both.as_ref().and_then(|both| both.sought());
            analysis.found.as_ref().is_some_and(|found| found.unknown.index() == i)
                || by_momentum.is_some_and(|vehicle| vehicle.index() == i)
        };
        row("speed", &|i| match &vehicles[i].motion {
            _ if sought(i) => Some("sought".to_owned()),
            Some(Velocity::Speed(speed)) => Some(units.speed(speed.si())),
            Some(Velocity::Vector { x, y }) => Some(units.format_vector(Measure::Speed, [x.si(), y.si()])),
            None => None,
        });
        row("yaw rate", &|i| vehicles[i].yaw_rate.as_ref().map(|q| units.yaw_rate(q.si())));
        let damage = |i: usize| vehicles[i].crush.as_ref().zip(analysis.vehicles[i].damage.as_ref());
        row("damaged side, width", &|i| {
            damage(i).map(|(crush, damage)| {
                format!("{}, {}", words::side_name(crush.side), units.format(Measure::Crush, damage.width))
            })
        });
        let known_energy = |i: usize| analysis.vehicles[i].subject.energy;
        row("damage", &|i| {
            let energy = known_energy(i)?;
            Some(match (energy.ees, energy.side) {
                (None, _) => "none that counts".to_owned(),
                (Some(_), None) => "by its EES".to_owned(),
                (Some(_), Some(side)) => format!("{}, by its EES", words::side_name(side)),
            })
        });
        let deformation_energy = |i: usize| analysis.vehicles[i].subject.deformation_energy;
        row("deformation energy, as given", &|i| Some(units.format(Measure::Energy, deformation_energy(i)?)));
        row("EES as given", &|i| Some(units.speed(known_energy(i)?.ees?)));
        let crush = |i: usize| vehicles[i].crush.as_ref();
        let crush_length = |q: case::Quantity| units.format(Measure::Crush, q.si());
        // The offset of a front or rear is from the vehicle's axis, that of a side from its CG.
        let side_of_y = axes::side_of_y(self.axes);
        for (label, is_end) in [
            (format!("damage offset {side_of_y} of axis"), true),
            ("damage offset ahead of the CG".to_owned(), false),
        ] {
            row(&label, &|i| {
                let crush = crush(i).filter(|crush| words::is_end(crush.side) == is_end)?;
                crush.offset.map(crush_length)
            });
        }
        row("PDOF as given", &|i| {
            let follows = || {
                let subject = &analysis.vehicles[i].subject;
                let pdof = subject.force.pdof.filter(|_| subject.force.pdof_follows)?;
                Some(format!("opposite: {}", units.format(Measure::Angle, pdof)))
            };
            let of_ees = vehicles[i].energy.as_ref().and_then(|known| known.ees()?.pdof);
            let given = crush(i).map_or(of_ees, |crush| crush.pdof).map(|pdof| match pdof {
                Pdof::Angle(given) => angle(&given),
                Pdof::Clock(hour) => format!("{hour} o'clock"),
            });
            given.or_else(follows)
        });
        row("angle α as given", &|i| crush(i).and_then(|crush| crush.oblique_angle).map(|q| angle(&q)));
        row("moment arm h as given", &|i| {
            let of_ees = vehicles[i].energy.as_ref().and_then(|known| known.ees()?.moment_arm);
            crush(i).map_or(of_ees, |crush| crush.moment_arm).map(|q| units.format(Measure::Length, q.si()))
        });
        let dimensions = |i: usize| analysis.vehicles[i].subject.dimensions;
        let length = |si: f64| units.format(Measure::Length, si);
        row("outline, length by width", &|i| {
            dimensions(i).map(|d| format!("{} by {}", length(d.length), length(d.width)))
        });
        row("CG to the front", &|i| dimensions(i).map(|d| length(d.cg_to_front)));
        self.stiffness(analysis, &mut table);
        Chosen { analysis, units }.pair(&mut table, &rows::NO_DAMAGE_SPEED);
        self.document.push(table);
        self.shared_inputs(case, analysis);
    }

    /// Inputs without a column for each vehicle: profiles, which need the whole line, and inputs of the
    /// collision.
    fn shared_inputs(&mut self, case: &Case, analysis: &Seen) {
        let units = self.units;
        let mut profiles = Vec::new();
        for (id, vehicle) in VehicleId::ALL.into_iter().zip(&analysis.vehicles) {
            let Some(damage) = &vehicle.damage else { continue };
            let depths = match &damage.inferred {
                None => units.format_all(Measure::Crush, &damage.depths),
                Some(inferred) => inferred_crush(inferred, units),
            };
            profiles.push((format!("crush depths, vehicle {id}"), depths));
        }
        let heading = match (profiles.is_empty(), case.impact.is_some()) {
            (false, true) => "Crush depths and impact law",
            (false, false) => "Crush depths",
            (true, true) => "Impact law",
            (true, false) => return,
        };
        let mut table = Table::of_two(heading, [""; 3]);
        for (label, depths) in &profiles {
            table.shared(label, depths, "");
        }
        if let Some(impact) = &case.impact {
            table.shared("crush plane Γ", &units.format(Measure::Angle, impact.crush_plane.si()), "");
            table.shared("impact law", law::name(&impact.law), "");
            table.shared("coefficients", &law::coefficients(&impact.law, units), "");
        }
        self.document.push(table);
    }

    /// Coefficients in one row if they are the same all along the side, else in one row for each vehicle and
    /// coefficient.
    fn stiffness(&self, analysis: &Seen, table: &mut Table) {
        let units = self.units;
        let damage = [0, 1].map(|i| analysis.vehicles[i].damage.as_ref());
        let source = [0, 1].map(|i| {
            analysis.vehicles[i]
                .subject
                .damage
                .as_ref()
                .map(|d| words::stiffness_source(d.stiffness_source, d.side))
        });
        table.pair("stiffness from", source, "");
        type Coefficient = (&'static str, Measure, fn(&Stiffness) -> Option<f64>);
        let coefficients: [Coefficient; 4] = [
            ("stiffness A", Measure::StiffnessA, |s| Some(s.a())),
            ("stiffness B", Measure::StiffnessB, |s| Some(s.b())),
            ("stiffness G", Measure::StiffnessG, |s| Some(s.g())),
            ("limit of the force per width", Measure::StiffnessA, Stiffness::saturation_force),
        ];
        for (label, quantity, of) in coefficients {
            let uniform = damage.map(|damage| match damage.map(|damage| &damage.structure) {
                Some(SideStiffness::Uniform(stiffness)) => of(stiffness).map(|si| units.format(quantity, si)),
                Some(SideStiffness::Zones(_)) | None => None,
            });
            table.pair(label, uniform, "");
        }
        for (id, damage) in VehicleId::ALL.into_iter().zip(damage) {
            let Some(SideStiffness::Zones(zones)) = damage.map(|damage| &damage.structure) else { continue };
            for (label, quantity, of) in coefficients {
                if zones.iter().any(|zone| of(zone).is_some()) {
                    let values: Vec<String> = zones
                        .iter()
                        .map(|zone| of(zone).map_or_else(|| "–".to_owned(), |si| units.format(quantity, si)))
                        .collect();
                    table.note(format!("{label} by zone, vehicle {id}: {}", values.join(", ")));
                }
            }
        }
    }

    fn impact(&mut self, analysis: &Seen, exchange: &Exchange) {
        let chosen = Chosen { analysis, units: self.units };
        // Momentum reveals neither a moment nor whether friction sufficed.
        let impact = analysis.impact.as_ref().filter(|_| analysis.law_check().is_none());
        let mut table = Table::of_two("Impact", ["along n", "along t", "source"]);
        for pair in [
            [&rows::IMPACT_NORMAL_VELOCITY_BEFORE, &rows::IMPACT_TANGENTIAL_VELOCITY_BEFORE],
            [&rows::IMPACT_NORMAL_VELOCITY_AFTER, &rows::IMPACT_TANGENTIAL_VELOCITY_AFTER],
            [&rows::IMPACT_NORMAL_IMPULSE, &rows::IMPACT_TANGENTIAL_IMPULSE],
        ] {
            if exchange.at_contact.is_some() {
                chosen.along(&mut table, pair);
            }
        }
        if exchange.at_contact.is_some() {
            self.document.push(table);
        }
        let mut table = Table::of_two("Impact as a whole", ["", "", "source"]);
        chosen.shared(&mut table, &rows::IMPACT_MOMENT_IMPULSE);
        // As many digits as the case gives for the coefficient, but at most four decimals, because that of a
        // curve has no end.
        if let Some(e) = exchange.restitution {
            let e = (e * 1e4).round() / 1e4 + 0.0;
            chosen.shared_with(&mut table, &rows::IMPACT_RESTITUTION, |_| e.to_string());
        }
        if let Some(regime) = impact.and_then(|impact| impact.outcome.regime) {
            let regime = match regime {
                Regime::Full => "sufficient for the tangential condition",
                Regime::Sliding => "insufficient: sliding continues until separation",
            };
            table.shared("friction", regime, "theory 3");
        }
        chosen.shared(&mut table, &rows::IMPACT_IMPULSE_RATIO);
        chosen.shared(&mut table, &rows::IMPACT_CRITICAL_IMPULSE_RATIO);
        if impact.is_some_and(|impact| impact.outcome.critical_impulse_ratio.is_none()) {
            let label = rows::IMPACT_CRITICAL_IMPULSE_RATIO.label;
            table.shared(label, "none: no push can end the sliding", "theory 3");
        }
        chosen.shared(&mut table, &rows::IMPACT_CLOSING_SPEED);
        chosen.shared_with(&mut table, &rows::IMPACT_IMPULSE_DIRECTION, |angle| {
            format!("{angle} in the scene")
        });
        chosen.shared_vector(&mut table, [&rows::IMPACT_IMPULSE_X, &rows::IMPACT_IMPULSE_Y]);
        chosen.shared_vector(&mut table, [&rows::IMPACT_NORMAL_X, &rows::IMPACT_NORMAL_Y]);
        self.document.push(table);
    }

    fn motion(&mut self, analysis: &Seen) {
        let chosen = Chosen { analysis, units: self.units };
        let mut table = Table::of_vehicles("Motion");
        chosen.pair(&mut table, &rows::SKID_SPEED);
        chosen.pair(&mut table, &rows::SPEED);
        chosen.vectors(&mut table, [&rows::VELOCITY_X, &rows::VELOCITY_Y]);
        chosen.pair(&mut table, &rows::FINAL_SPEED);
        chosen.vectors(&mut table, [&rows::FINAL_VELOCITY_X, &rows::FINAL_VELOCITY_Y]);
        for row in [
            &rows::YAW_RATE,
            &rows::FINAL_YAW_RATE,
            &rows::DELTA_V,
            &rows::DELTA_V_LONGITUDINAL,
            &rows::DELTA_V_LATERAL,
        ] {
            chosen.pair(&mut table, row);
        }
        chosen.vectors(&mut table, [&rows::DELTA_V_X, &rows::DELTA_V_Y]);
        chosen.pair(&mut table, &rows::PDOF);
        self.document.push(table);
    }

    fn energy(&mut self, analysis: &Seen, energy: &Energy) {
        let chosen = Chosen { analysis, units: self.units };
        let mut table = Table::of_two("Energy", ["", "share of initial", "source"]);
        let share = |si: f64| crate::energy::share(si, energy);
        for (row, indent) in [
            (&rows::IMPACT_INITIAL_ENERGY, ""),
            (&rows::IMPACT_FINAL_ENERGY, ""),
            (&rows::IMPACT_ENERGY_LOSS, ""),
            (&rows::IMPACT_NORMAL_WORK, "  "),
            (&rows::IMPACT_TANGENTIAL_WORK, "  "),
            (&rows::IMPACT_MOMENT_WORK, "  "),
        ] {
            chosen.energy(&mut table, row, indent, share);
        }
        table.notes = crate::energy::notes(analysis, self.units);
        self.document.push(table);
    }

    fn damage(&mut self, analysis: &Seen) {
        let chosen = Chosen { analysis, units: self.units };
        let units = self.units;
        let damage = [0, 1].map(|i| analysis.vehicles[i].damage.as_ref());
        if analysis.vehicles.iter().all(|vehicle| vehicle.crush_energy().is_none()) {
            return;
        }
        let mut table = Table::of_vehicles("Damage");
        let each = |f: &dyn Fn(&Damage) -> Option<String>| damage.map(|damage| damage.and_then(f));
        let energy = |si: f64| units.format(Measure::Energy, si);
        if damage.iter().flatten().any(|damage| damage.inferred.is_some()) {
            let evidence =
                |d: &Damage| if d.inferred.is_some() { "inferred from the force" } else { "measured" };
            table.pair("the crush was", each(&|d| Some(evidence(d).to_owned())), "theory 5");
            let bounds = |d: &Damage| {
                let range = d.inferred?.range?;
                Some(format!("{} to {}", energy(range.lowest.energy), energy(range.highest.energy)))
            };
            table.pair(rows::CRUSH_ENERGY_BOUNDS_LOW.label, each(&bounds), "theory 5");
        }
        chosen.pair(&mut table, &rows::CRUSH_ENERGY);
        // The PDOF of the impulse is above; this is the one that the file gives instead.
        let is_given = |i: usize| analysis.vehicles[i].subject.force.pdof.is_some();
        let is_alone = analysis.exchange().is_none();
        if is_alone || [0, 1].into_iter().any(is_given) {
            let label = if is_alone { rows::PDOF.label } else { "PDOF that CRASH3 uses" };
            let pdof = |i: usize| Some(units.format(Measure::Angle, analysis.vehicles[i].crash3_pdof()?));
            table.pair(label, [0, 1].map(pdof), "theory 5");
        }
        chosen.pair(&mut table, &rows::EES);
        chosen.pair(&mut table, &rows::OBLIQUE_ANGLE);
        chosen.pair_with(&mut table, &rows::OBLIQUE_FACTOR, |i, factor| {
            let is_capped = damage[i].and_then(|d| d.oblique).is_some_and(|oblique| oblique.factor.capped);
            if is_capped { format!("{factor} (capped)") } else { factor }
        });
        chosen.pair(&mut table, &rows::CORRECTED_CRUSH_ENERGY);
        chosen.pair(&mut table, &rows::PEAK_FORCE);
        self.document.push(table);
    }

    fn crash3(&mut self, case: &Case, analysis: &Seen, crash3: &Crash3) {
        let basis = analysis.basis;
        let units = self.units;
        let chosen = Chosen { analysis, units };
        let mut table = Table::of_two("CRASH3's own answer", ["", "", "source"]);
        chosen.shared(&mut table, &rows::CRASH3_CRUSH_ENERGY);
        chosen.shared(&mut table, &rows::CRASH3_CORRECTED_CRUSH_ENERGY);
        chosen.shared_with(&mut table, &rows::CRASH3_RESTITUTION_FACTOR, |factor| {
            let assumed = if case.reconstruct.is_none() { ", assumed" } else { "" };
            format!("{factor} (energy basis: {}{assumed})", basis::named(basis))
        });
        self.document.push(table);
        let mut table = Table::of_vehicles("CRASH3 by vehicle");
        if analysis.exchange().is_some() {
            let of = match &analysis.both {
                Some(both) if !both.is_by_crush() => "that of momentum",
                _ => "that of the impact",
            };
            table.note(format!(
                "The ΔV of this reconstruction is {of}, above. CRASH3's formulas are for comparison."
            ));
        }
        // A fixed object has no arm and no ΔV.
        let pair = |values: [String; 2]| {
            let [first, second] = values;
            let known = |i: usize, value: String| (!case.vehicles[i].fixed).then_some(value);
            [known(0, first), known(1, second)]
        };
        let speeds = |delta_v: [f64; 2], factor: f64| pair(delta_v.map(|dv| units.speed(dv * factor)));
        chosen.pair(&mut table, &rows::CRASH3_MOMENT_ARM);
        chosen.pair(&mut table, &rows::CRASH3_EFFECTIVE_MASS_RATIO);
        chosen.pair(&mut table, &rows::CRASH3_DELTA_V);
        if let Some(factor) = crash3.restitution_factor {
            table.pair("ΔV uncorrected, restitution", speeds(crash3.delta_v, factor), "theory 5");
        }
        if let Some(corrected) = crash3.corrected {
            chosen.pair(&mut table, &rows::CRASH3_CORRECTED_DELTA_V);
            if let Some(factor) = crash3.restitution_factor {
                table.pair("ΔV corrected, restitution", speeds(corrected.delta_v, factor), "theory 5");
            }
        }
        self.document.push(table);
        let mut table = Table::of_two(
            "CRASH3 by oblique correction",
            ["ΔV 1, without restitution", "ΔV 2, without restitution", "source"],
        );
        for row in &crash3.corrections {
            // With the number, the label would be too long for its column.
            let factor =
                law::friction_limits(row).map_or_else(|| law::factor(row), |_| law::friction_factor(&"μ"));
            let label = format!("{:<9}{factor}", law::row_name(row));
            table.pair(&label, speeds(row.delta_v, 1.0), "theory 5");
        }
        for [first, second] in crash3.corrections.iter().filter_map(law::friction_limits) {
            table.note(if first == second {
                format!("The friction limit μ is {first}.")
            } else {
                format!("The friction limit μ is {first} for vehicle 1 and {second} for vehicle 2.")
            });
        }
        self.document.push(table);
    }
}

/// How the speed was found.
pub(crate) fn search(found: &Found) -> String {
    match found.iterations.as_ref().map(Vec::len) {
        None => "in closed form".to_owned(),
        // An end of the bracket was already the root.
        Some(0) => "by root-finding".to_owned(),
        Some(1) => "by root-finding in 1 step".to_owned(),
        Some(steps) => format!("by root-finding in {steps} steps"),
    }
}

/// The other speeds that give the crush energy; `None` if there are none.
pub(super) fn other_speeds(found: &Found, units: Units) -> Option<String> {
    let all: Vec<String> = found.others().map(|speed| units.road_speed(speed)).collect();
    (!all.is_empty()).then(|| format!("Also admissible: {}", all.join(", ")))
}
