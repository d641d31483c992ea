//! A finished analysis as text for the terminal and the file.

use analysis::{Analysis, Crash3, Damage, Found, Impact};
use case::{Axes, Case, Pdof, Velocity, YawSource};
use crash3::{EnergyBasis, SideStiffness, Stiffness};
use pim_core::{Outcome, Regime};

use crate::axes;
use crate::checks;
use crate::energy;
use crate::law;
use crate::units::{Quantity, Units, number};
use crate::warnings;
use crate::words;
use crate::wrap::{LINE, first_cell, hanging_within, wrapped_within};

const LABEL: usize = 32;
/// Of the last column of a table, the source.
const SOURCE: usize = 12;

/// The analysis as text of 98 columns.
#[must_use]
pub fn text(case: &Case, analysis: &Analysis, units: Units) -> String {
    text_within(case, analysis, units, LINE)
}

/// The same for a terminal of so many columns: no narrower than 88, which the values need, and no wider than 120, which the eye can follow.
#[must_use]
pub fn text_within(case: &Case, analysis: &Analysis, units: Units, columns: usize) -> String {
    let width = columns.clamp(88, 120);
    let analysis = &analysis.in_axes(case.axes);
    let mut page = Page { units, axes: case.axes, width, text: String::new() };
    page.title(case);
    if let Some(found) = &analysis.found {
        page.found(found, analysis.basis);
    }
    page.notice(analysis);
    page.inputs(case, analysis);
    if let Some(impact) = &analysis.impact {
        page.impact(impact);
        page.motion(case, analysis, impact);
        page.energy(analysis, &impact.outcome);
    }
    page.damage(analysis);
    if let Some(crash3) = &analysis.crash3 {
        page.crash3(case, crash3, analysis.basis);
    }
    page.checks(analysis);
    page.warnings(analysis);
    page.sources();
    page.text
}

/// A text of at most so many columns, its end replaced by … where it is longer.
fn cut(text: &str, columns: usize) -> String {
    if text.chars().count() <= columns {
        return text.to_owned();
    }
    let kept: String = text.chars().take(columns.saturating_sub(1)).collect();
    format!("{}…", kept.trim_end())
}

struct Page {
    units: Units,
    axes: Axes,
    /// Of a line.
    width: usize,
    text: String,
}

/// A part in which each row has one value: only here can one stand that belongs to neither vehicle, so that none stands in the column of one.
struct Shared<'a>(&'a mut Page);

impl Shared<'_> {
    /// A row, which has no source where its value may be longer than a line.
    fn value(&mut self, label: &str, value: &str, source: &str) {
        let page = &mut *self.0;
        if LABEL + value.chars().count() > page.width {
            page.text.push_str(&hanging_within(&format!("{label:<LABEL$}"), value, page.width));
            return;
        }
        let label = first_cell(label, LABEL);
        page.line(&format!("{label}{value:<width$}  {source}", width = 2 * page.column() - 2));
    }
}

impl Page {
    fn line(&mut self, line: &str) {
        self.text.push_str(line.trim_end());
        self.text.push('\n');
    }

    /// Columns of each of the two values of a row.
    fn column(&self) -> usize {
        (self.width - LABEL - SOURCE) / 2
    }

    fn heading(&mut self, heading: &str, columns: [&str; 3]) {
        self.line("");
        let [first, second, source] = columns;
        self.row(heading, first, second, source);
        self.line(&"─".repeat(self.width));
    }

    fn row(&mut self, label: &str, first: &str, second: &str, source: &str) {
        // A value that is too long for its column moves the rest of the row: with less than two blanks between, two values read as one.
        let cell = |text: &str, width: usize| format!("{text:<width$}  ", width = width - 2);
        self.line(&format!(
            "{}{}{}{source}",
            first_cell(label, LABEL),
            cell(first, self.column()),
            cell(second, self.column())
        ));
    }

    /// A heading without columns for the vehicles, above numbers that both share.
    fn shared(&mut self, heading: &str, source: &str) -> Shared<'_> {
        self.heading(heading, ["", "", source]);
        Shared(self)
    }

    /// A row of which each vehicle has a value or a dash.
    fn pair(&mut self, label: &str, values: [Option<String>; 2], source: &str) {
        if values.iter().any(Option::is_some) {
            let [first, second] = values.map(|value| value.unwrap_or_else(|| "–".to_owned()));
            self.row(label, &first, &second, source);
        }
    }

    fn paragraph(&mut self, text: &str) {
        self.text.push_str(&wrapped_within(text, self.width));
    }

    fn title(&mut self, case: &Case) {
        self.line(case.title.as_deref().unwrap_or("Untitled case"));
        if let Some(source) = &case.source {
            self.line(&format!("Source: {source}"));
        }
    }

    fn found(&mut self, found: &Found, basis: EnergyBasis) {
        let vehicle = found.unknown.index() + 1;
        let units = self.units;
        self.line("");
        self.line(&format!("Speed of vehicle {vehicle}: {}", both_speeds(units, found.speed)));
        let energy = |si: f64| units.format(Quantity::Energy, si);
        let work = match basis {
            EnergyBasis::Dissipated => format!(
                "equals the crush energy, {}, which the normal impulse dissipates",
                energy(found.crush_energy)
            ),
            EnergyBasis::Absorbed => format!(
                "is W_n = {} = (1 − e²) E, where the crush energy E = {} is what the vehicles absorb up to maximum engagement, and restitution gives \
                 the share e² back",
                energy(found.normal_work),
                energy(found.crush_energy)
            ),
        };
        let roots = match found.admissible.len() {
            1 => "One admissible speed".to_owned(),
            several => format!("{several} admissible speeds"),
        };
        let method = search(found);
        self.paragraph(&format!(
            "At this speed the work of the normal impulse {work}. {roots}, found {method} (theory 6)."
        ));
    }

    /// Many read no further than the first screen.
    fn notice(&mut self, analysis: &Analysis) {
        if let Some(count) = warnings::count(&analysis.warnings) {
            self.line(&format!("{count}, at the end."));
        }
    }

    fn inputs(&mut self, case: &Case, analysis: &Analysis) {
        let units = self.units;
        self.heading("Inputs as understood", ["vehicle 1", "vehicle 2", ""]);
        let vehicles = &case.vehicles;
        let known = |f: &dyn Fn(usize) -> Option<String>| [f(0), f(1)];
        let most = self.column() - 2;
        self.pair("name", known(&|i| vehicles[i].name.as_deref().map(|name| cut(name, most))), "");
        self.pair("fixed object", known(&|i| vehicles[i].fixed.then(|| "yes".to_owned())), "");
        let inertia = |i: usize| analysis.vehicles[i].subject.inertia;
        self.pair("mass", known(&|i| inertia(i).map(|v| units.format(Quantity::Mass, v.mass))), "");
        self.pair(
            "yaw inertia",
            known(&|i| inertia(i).map(|v| units.format(Quantity::YawInertia, v.yaw_inertia))),
            "",
        );
        self.pair(
            "yaw inertia from",
            known(&|i| match inertia(i).map(|v| v.yaw_source) {
                Some(YawSource::Class(class)) => Some(format!("CRASH3's class {class}")),
                Some(YawSource::Burg) => Some("Burg's estimate".to_owned()),
                Some(YawSource::Given) | None => None,
            }),
            "",
        );
        let angle = |q: &case::Quantity| units.format(Quantity::Angle, q.si());
        self.pair("heading θ", known(&|i| vehicles[i].heading.as_ref().map(angle)), "");
        self.pair(
            "contact point C, forward",
            known(&|i| analysis.vehicles[i].subject.contact.map(|c| units.format(Quantity::Length, c[0]))),
            "",
        );
        self.pair(
            &format!("contact point C, {}", axes::side_of_y(self.axes)),
            known(&|i| analysis.vehicles[i].subject.contact.map(|c| units.format(Quantity::Length, c[1]))),
            "",
        );
        let sought = |i: usize| analysis.found.as_ref().is_some_and(|found| found.unknown.index() == i);
        self.pair(
            "speed",
            known(&|i| match &vehicles[i].motion {
                _ if sought(i) => Some("sought".to_owned()),
                Some(Velocity::Speed(speed)) => Some(both_speeds(units, speed.si())),
                Some(Velocity::Vector { x, y }) => {
                    Some(units.format_vector(Quantity::Speed, [x.si(), y.si()]))
                }
                None => None,
            }),
            "",
        );
        self.pair("yaw rate", known(&|i| vehicles[i].yaw_rate.as_ref().map(|q| units.yaw_rate(q.si()))), "");
        let damage = |i: usize| vehicles[i].crush.as_ref().zip(analysis.vehicles[i].damage.as_ref());
        self.pair(
            "damaged side, width",
            known(&|i| {
                damage(i).map(|(crush, damage)| {
                    format!(
                        "{}, {}",
                        words::side_name(crush.side),
                        units.format(Quantity::Crush, damage.width)
                    )
                })
            }),
            "",
        );
        let crush = |i: usize| vehicles[i].crush.as_ref();
        let crush_length = |q: case::Quantity| units.format(Quantity::Crush, q.si());
        // Of a front or rear the offset is from the vehicle's axis, of a side from its CG.
        let side_of_y = axes::side_of_y(self.axes);
        for (label, is_end) in [
            (format!("damage offset {side_of_y} of axis"), true),
            ("damage offset ahead of the CG".to_owned(), false),
        ] {
            let offset = known(&|i| {
                let crush = crush(i).filter(|crush| words::is_end(crush.side) == is_end)?;
                crush.offset.map(crush_length)
            });
            self.pair(&label, offset, "");
        }
        self.pair(
            "PDOF as given",
            known(&|i| {
                let follows = || {
                    let damage = analysis.vehicles[i].subject.damage.as_ref()?;
                    let pdof = damage.pdof.filter(|_| damage.pdof_follows)?;
                    Some(format!("opposite: {}", units.format(Quantity::Angle, pdof)))
                };
                let given = crush(i)?.pdof.map(|pdof| match pdof {
                    Pdof::Angle(given) => angle(&given),
                    Pdof::Clock(hour) => format!("{hour} o'clock"),
                });
                given.or_else(follows)
            }),
            "",
        );
        self.pair(
            "angle α as given",
            known(&|i| crush(i).and_then(|crush| crush.oblique_angle).map(|q| angle(&q))),
            "",
        );
        self.pair(
            "moment arm h as given",
            known(&|i| {
                crush(i).and_then(|crush| crush.moment_arm).map(|q| units.format(Quantity::Length, q.si()))
            }),
            "",
        );
        let dimensions = |i: usize| analysis.vehicles[i].subject.dimensions;
        let length = |si: f64| units.format(Quantity::Length, si);
        self.pair(
            "outline, length by width",
            known(&|i| dimensions(i).map(|d| format!("{} by {}", length(d.length), length(d.width)))),
            "",
        );
        self.pair("CG to the front", known(&|i| dimensions(i).map(|d| length(d.cg_to_front))), "");
        self.stiffness(analysis);
        let no_damage = |i: usize| {
            let vehicle = &analysis.vehicles[i];
            vehicle.no_damage_speed().map(|si| both_speeds(units, si))
        };
        self.pair("no-damage speed b_0", known(&no_damage), "theory 5");
        self.shared_inputs(case, analysis);
    }

    /// What is no column of a vehicle: profiles, which need the whole line, and what belongs to the collision.
    fn shared_inputs(&mut self, case: &Case, analysis: &Analysis) {
        let units = self.units;
        let mut profiles = Vec::new();
        for (i, vehicle) in analysis.vehicles.iter().enumerate() {
            if let Some(damage) = &vehicle.damage
                && damage.inferred.is_none()
            {
                let depths = units.format_all(Quantity::Crush, &damage.depths);
                profiles.push((format!("crush depths, vehicle {}", i + 1), depths));
            }
        }
        let heading = match (profiles.is_empty(), case.impact.is_some()) {
            (false, true) => "Crush depths and impact law",
            (false, false) => "Crush depths",
            (true, true) => "Impact law",
            (true, false) => return,
        };
        let mut rows = self.shared(heading, "");
        for (label, depths) in &profiles {
            rows.value(label, depths, "");
        }
        if let Some(impact) = &case.impact {
            rows.value("crush plane Γ", &units.format(Quantity::Angle, impact.crush_plane.si()), "");
            rows.value("impact law", law::name(&impact.law), "");
            rows.value("coefficients", &law::coefficients(&impact.law, units), "");
        }
    }

    /// Coefficients in one row where they are the same all along the side, else in one row for each vehicle and coefficient.
    fn stiffness(&mut self, analysis: &Analysis) {
        let units = self.units;
        let damage = [0, 1].map(|i| analysis.vehicles[i].damage.as_ref());
        let source = [0, 1].map(|i| {
            analysis.vehicles[i]
                .subject
                .damage
                .as_ref()
                .map(|d| words::stiffness_source(d.stiffness_source, d.side))
        });
        self.pair("stiffness from", source, "");
        type Coefficient = (&'static str, Quantity, fn(&Stiffness) -> Option<f64>);
        let coefficients: [Coefficient; 4] = [
            ("stiffness A", Quantity::StiffnessA, |s| Some(s.a())),
            ("stiffness B", Quantity::StiffnessB, |s| Some(s.b())),
            ("stiffness G", Quantity::StiffnessG, |s| Some(s.g())),
            ("limit of the force per width", Quantity::StiffnessA, Stiffness::saturation_force),
        ];
        for (label, quantity, of) in coefficients {
            let uniform = damage.map(|damage| match damage.map(|damage| &damage.structure) {
                Some(SideStiffness::Uniform(stiffness)) => of(stiffness).map(|si| units.format(quantity, si)),
                Some(SideStiffness::Zones(_)) | None => None,
            });
            self.pair(label, uniform, "");
        }
        let doubt = analysis.vehicles.iter().find_map(|vehicle| {
            let damage = vehicle.subject.damage.as_ref()?;
            words::stiffness_doubt(damage.stiffness_source, damage.side)
        });
        if let Some(doubt) = doubt {
            self.paragraph(&format!("{doubt}."));
        }
        for (i, damage) in damage.into_iter().enumerate() {
            let Some(SideStiffness::Zones(zones)) = damage.map(|damage| &damage.structure) else { continue };
            for (label, quantity, of) in coefficients {
                if zones.iter().any(|zone| of(zone).is_some()) {
                    let values: Vec<String> = zones
                        .iter()
                        .map(|zone| of(zone).map_or_else(|| "–".to_owned(), |si| units.format(quantity, si)))
                        .collect();
                    self.paragraph(&format!("{label} by zone, vehicle {}: {}", i + 1, values.join(", ")));
                }
            }
        }
    }

    fn impact(&mut self, impact: &Impact) {
        let units = self.units;
        let outcome = &impact.outcome;
        self.heading("Impact", ["along n", "along t", "source"]);
        let speed = |si: f64| units.format(Quantity::Speed, si);
        let [u, v] = [outcome.approach, outcome.separation];
        self.row("relative velocity before, u", &speed(u.normal), &speed(u.tangential), "theory 1");
        self.row("relative velocity after, U", &speed(v.normal), &speed(v.tangential), "theory 2");
        let impulse = |si: f64| units.format(Quantity::Impulse, si);
        let p = outcome.impulse;
        self.row("impulse on vehicle 1, P", &impulse(p.normal), &impulse(p.tangential), "theory 3");
        let mut rows = self.shared("Impact as a whole", "source");
        if impact.law.has_moment() {
            let moment = units.format(Quantity::MomentImpulse, outcome.moment_impulse);
            rows.value("moment impulse on vehicle 1, M", &moment, "theory 3");
        }
        let e = (impact.law.restitution() * 1e4).round() / 1e4;
        rows.value("restitution e", &e.to_string(), "");
        if let Some(regime) = outcome.regime {
            let regime = match regime {
                Regime::Full => "sufficient for the tangential condition",
                Regime::Sliding => "insufficient: the surfaces slide to the end",
            };
            rows.value("friction", regime, "theory 3");
        }
        rows.value("impulse ratio μ = P_t/P_n", &number(outcome.impulse_ratio, 4), "theory 3");
        let critical = outcome
            .critical_impulse_ratio
            .map_or_else(|| "none: no push ends the sliding".to_owned(), |critical| number(critical, 4));
        rows.value("critical impulse ratio μ_c", &critical, "theory 3");
        rows.value(
            "direction of the impulse",
            &format!("{} in the scene", units.format(Quantity::Angle, outcome.impulse_direction())),
            "theory 2",
        );
    }

    fn motion(&mut self, case: &Case, analysis: &Analysis, impact: &Impact) {
        let (units, outcome) = (self.units, &impact.outcome);
        self.heading("Motion", ["vehicle 1", "vehicle 2", "source"]);
        let each = |f: &dyn Fn(usize) -> String| [0, 1].map(|i| (!case.vehicles[i].fixed).then(|| f(i)));
        let vector = |v: pim_core::Vector2<f64>| units.format_vector(Quantity::Speed, v.into());
        self.pair("speed before", each(&|i| both_speeds(units, analysis.speed(i))), "");
        self.pair("velocity before, v", each(&|i| vector(outcome.before[i].velocity)), "");
        self.pair("velocity after, V", each(&|i| vector(outcome.after[i].velocity)), "theory 2");
        self.pair("yaw rate before, ω", each(&|i| units.yaw_rate(outcome.before[i].yaw_rate)), "");
        self.pair("yaw rate after, Ω", each(&|i| units.yaw_rate(outcome.after[i].yaw_rate)), "theory 2");
        self.pair("ΔV", each(&|i| both_speeds(units, outcome.delta_v_magnitude()[i])), "theory 2");
        self.pair(
            "PDOF, clockwise from heading",
            each(&|i| units.format(Quantity::Angle, impact.pdof[i])),
            "theory 4",
        );
    }

    fn energy(&mut self, analysis: &Analysis, outcome: &Outcome) {
        let works = outcome.energy;
        self.heading("Energy", ["", "share of initial", "source"]);
        let mut rows = vec![
            ("initial kinetic energy", works.before, "theory 4"),
            ("final kinetic energy", works.after, "theory 4"),
            ("energy loss E_L", works.loss, "theory 4"),
            ("  normal work W_n", works.normal_work, "Eq 4"),
            ("  tangential work W_t", works.tangential_work, "Eq 4"),
        ];
        if outcome.moment_impulse != 0.0 {
            rows.push(("  moment work W_m", works.moment_work, "theory 4"));
        }
        for (label, value, source) in rows {
            let share = energy::share(value, &works);
            self.row(label, &self.units.format(Quantity::Energy, value), &share, source);
        }
        for note in energy::notes(analysis, self.units) {
            self.paragraph(&note);
        }
    }

    fn damage(&mut self, analysis: &Analysis) {
        let units = self.units;
        let damage = [0, 1].map(|i| analysis.vehicles[i].damage.as_ref());
        if damage.iter().all(Option::is_none) {
            return;
        }
        self.heading("Damage", ["vehicle 1", "vehicle 2", "source"]);
        let each = |f: &dyn Fn(&Damage) -> Option<String>| damage.map(|damage| damage.and_then(f));
        let energy = |si: f64| units.format(Quantity::Energy, si);
        if damage.iter().flatten().any(|damage| damage.inferred.is_some()) {
            let evidence =
                |d: &Damage| if d.inferred.is_some() { "inferred from the force" } else { "measured" };
            self.pair("the crush was", each(&|d| Some(evidence(d).to_owned())), "theory 5");
            let bounds = |d: &Damage| {
                let range = d.inferred?.range?;
                Some(format!("{} to {}", energy(range.lowest.energy), energy(range.highest.energy)))
            };
            self.pair("crush energy, bounds", each(&bounds), "theory 5");
        }
        self.pair("crush energy E", each(&|d| Some(energy(d.crush_energy))), "Eq 5");
        // That of the impulse stands above; here is the one that the file puts in its place.
        let is_given =
            |i: usize| analysis.vehicles[i].subject.damage.as_ref().is_some_and(|d| d.pdof.is_some());
        if analysis.impact.is_none() || [0, 1].into_iter().any(is_given) {
            let label = if analysis.impact.is_none() {
                "PDOF, clockwise from heading"
            } else {
                "PDOF that CRASH3 uses"
            };
            let pdof = |d: &Damage| d.pdof.map(|pdof| units.format(Quantity::Angle, pdof));
            self.pair(label, each(&pdof), "theory 5");
        }
        self.pair("energy equivalent speed EES", each(&|d| Some(both_speeds(units, d.ees))), "theory 5");
        self.pair(
            "angle to the normal α",
            each(&|d| Some(units.format(Quantity::Angle, d.oblique_angle))),
            "theory 5",
        );
        self.pair(
            "oblique correction factor",
            each(&|d| {
                d.oblique.map(|oblique| {
                    let capped = if oblique.factor.capped { " (capped)" } else { "" };
                    format!("{}{capped}", number(oblique.factor.factor, 4))
                })
            }),
            "Eq 8",
        );
        self.pair(
            "corrected crush energy",
            each(&|d| d.oblique.map(|oblique| energy(oblique.corrected_crush_energy))),
            "Eq 8",
        );
        self.pair(
            "peak force",
            each(&|d| d.oblique.map(|oblique| units.format(Quantity::Force, oblique.peak_force))),
            "theory 5",
        );
    }

    fn crash3(&mut self, case: &Case, crash3: &Crash3, basis: EnergyBasis) {
        let units = self.units;
        let mut rows = self.shared("CRASH3's own answer", "source");
        let energy = |si: f64| units.format(Quantity::Energy, si);
        rows.value("crush energy, total", &energy(crash3.crush_energy), "Eq 5");
        if let Some(corrected) = crash3.corrected {
            rows.value("corrected crush energy, total", &energy(corrected.crush_energy), "Eq 8");
        }
        if let Some(factor) = crash3.restitution_factor {
            let assumed = if case.reconstruct.is_none() { ", assumed" } else { "" };
            let factor = number(factor, 4);
            rows.value(
                "restitution factor f_e",
                &format!("{factor} (energy basis: {}{assumed})", words::basis_name(basis)),
                "theory 5",
            );
        }
        self.heading("CRASH3 by vehicle", ["vehicle 1", "vehicle 2", "source"]);
        // A fixed object has no arm and no ΔV.
        let pair = |values: [String; 2]| {
            let [first, second] = values;
            let known = |i: usize, value: String| (!case.vehicles[i].fixed).then_some(value);
            [known(0, first), known(1, second)]
        };
        let speeds = |delta_v: [f64; 2], factor: f64| pair(delta_v.map(|dv| both_speeds(units, dv * factor)));
        self.pair(
            "moment arm h",
            pair(crash3.moment_arm.map(|h| units.format(Quantity::Length, h))),
            "theory 5",
        );
        self.pair(
            "effective mass ratio γ",
            pair(crash3.effective_mass_ratio.map(|ratio| number(ratio, 4))),
            "theory 5",
        );
        self.pair("ΔV uncorrected", speeds(crash3.delta_v, 1.0), "Eq 6, 7");
        if let Some(factor) = crash3.restitution_factor {
            self.pair("ΔV uncorrected, restitution", speeds(crash3.delta_v, factor), "theory 5");
        }
        if let Some(corrected) = crash3.corrected {
            self.pair("ΔV corrected", speeds(corrected.delta_v, 1.0), "Eq 6, 7, 8");
            if let Some(factor) = crash3.restitution_factor {
                self.pair("ΔV corrected, restitution", speeds(corrected.delta_v, factor), "theory 5");
            }
        }
        self.heading(
            "CRASH3 by oblique correction",
            ["ΔV 1, without restitution", "ΔV 2, without restitution", "source"],
        );
        for row in &crash3.corrections {
            // A number would take the label over its columns.
            let factor =
                law::friction_limits(row).map_or_else(|| law::factor(row), |_| law::friction_factor(&"μ"));
            let label = format!("{:<9}{factor}", law::row_name(row));
            self.pair(&label, speeds(row.delta_v, 1.0), "theory 5");
        }
        for [first, second] in crash3.corrections.iter().filter_map(law::friction_limits) {
            self.line(&if first == second {
                format!("The friction limit μ is {first}.")
            } else {
                format!("The friction limit μ is {first} for vehicle 1 and {second} for vehicle 2.")
            });
        }
    }

    fn checks(&mut self, analysis: &Analysis) {
        let rows = checks::rows(analysis, self.units);
        if rows.is_empty() {
            return;
        }
        self.heading(checks::TITLE, checks::COLUMNS);
        for checks::Row { label, cells: [found, limit, verdict] } in &rows {
            self.row(label, found, limit, verdict);
        }
    }

    fn warnings(&mut self, analysis: &Analysis) {
        self.line("");
        if analysis.warnings.is_empty() {
            self.line("No warnings.");
        }
        self.text.push_str(&warnings::lines(&analysis.warnings, self.units, self.axes, self.width));
    }

    fn sources(&mut self) {
        self.line("");
        self.paragraph(&format!(
            "Sources: Eq n is equation n of Brach & Brach, SAE 980025 (1998), its misprints mended; theory n is section n of \
             docs/theory.md. {}; n points from vehicle 2 to vehicle 1.",
            axes::conventions(self.axes)
        ));
    }
}

/// How the speed was found.
pub(crate) fn search(found: &Found) -> String {
    match found.iterations.as_ref().map(Vec::len) {
        None => "in closed form".to_owned(),
        // An end of the bracket was the root already.
        Some(0) => "by root-finding".to_owned(),
        Some(1) => "by root-finding in 1 step".to_owned(),
        Some(steps) => format!("by root-finding in {steps} steps"),
    }
}

/// A speed as the equations have it and as drivers know it, like `75.03 ft/s = 51.16 mph`.
fn both_speeds(units: Units, si: f64) -> String {
    format!("{} = {}", units.format(Quantity::Speed, si), units.road_speed(si))
}
