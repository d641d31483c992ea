//! Writing a case back: the layout of the documentation's example, the user's own units and numbers.

use std::collections::BTreeMap;

use crash3::EnergyBasis;
use crash3::ObliqueCorrection;
use inputs::{
    Amount, Axes, BarrierTest, BrachTangential, Case, ContactPoint, Crush, ENERGY_BASES, Fit, Impact,
    ImpactLaw, LawName, Mass, OBLIQUE_CORRECTIONS, Outline, Pdof, Quantity, Reconstruct, Restitution, SIDES,
    Spread, StiffnessForm, StiffnessLine, UNKNOWNS, Vehicle, Velocity, YawInertia, format_number, word,
};

/// A number, and what is said of it where it is uncertain.
#[derive(Clone, Copy)]
struct Written<'a> {
    number: f64,
    spread: Option<&'a Spread>,
}

/// The case as a file. Reading that file gives the same case: the same numbers, in the same units.
///
/// ```
/// use case::{CaseFile, EXAMPLE, to_toml};
///
/// let case = CaseFile::parse("sae-980025.toml", EXAMPLE)?.case;
/// assert_eq!(CaseFile::parse("again.toml", &to_toml(&case))?.case, case);
/// # Ok::<(), case::Diagnostics>(())
/// ```
#[must_use]
pub fn to_toml(case: &Case) -> String {
    let ranges: BTreeMap<&str, &Spread> =
        case.ranges.iter().map(|range| (range.path.as_str(), &range.spread)).collect();
    let left_out = case.left_out;
    let case = case.map(|input| {
        let spread = ranges.get(input.path.as_str()).copied();
        Written { number: input.number, spread }
    });
    let mut top = Lines::new(None);
    top.optional("title", case.title.as_deref().map(quoted));
    top.optional("source", case.source.as_deref().map(quoted));
    let mut tables = vec![top];
    // What is left out has the default.
    if !(left_out.axes && case.axes == Axes::default()) {
        let mut scene = Lines::new(Some("scene".to_owned()));
        scene.line("axes", quoted(case.axes.name()));
        tables.push(scene);
    }
    for ((vehicle, name), fit_left_out) in
        case.vehicles.iter().zip(["vehicle1", "vehicle2"]).zip(left_out.fit)
    {
        tables.push(vehicle_lines(vehicle, name));
        tables.extend(vehicle.crush.as_ref().map(|crush| crush_lines(crush, name, fit_left_out)));
    }
    tables.extend(case.impact.as_ref().map(|impact| impact_lines(impact, left_out.law)));
    tables.extend(case.reconstruct.as_ref().map(|table| reconstruct_lines(table, left_out.energy_basis)));
    let texts: Vec<String> = tables.iter().map(Lines::to_text).filter(|text| !text.is_empty()).collect();
    texts.join("\n")
}

/// One table: its header, and keys whose equals signs stand below each other.
struct Lines {
    header: Option<String>,
    lines: Vec<(&'static str, String)>,
}

impl Lines {
    fn new(header: Option<String>) -> Self {
        Self { header, lines: Vec::new() }
    }

    fn line(&mut self, key: &'static str, value: String) {
        self.lines.push((key, value));
    }

    fn optional(&mut self, key: &'static str, value: Option<String>) {
        self.lines.extend(value.map(|value| (key, value)));
    }

    fn to_text(&self) -> String {
        let width = self.lines.iter().map(|(key, _)| key.len()).max().unwrap_or(0);
        let header = self.header.iter().map(|header| format!("[{header}]\n"));
        header.chain(self.lines.iter().map(|(key, value)| format!("{key:width$} = {value}\n"))).collect()
    }
}

fn vehicle_lines(vehicle: &Vehicle<Written<'_>>, name: &str) -> Lines {
    let mut table = Lines::new(Some(name.to_owned()));
    table.optional("name", vehicle.name.as_deref().map(quoted));
    table.optional("fixed", vehicle.fixed.then(|| "true".to_owned()));
    match vehicle.mass {
        Some(Mass::Mass(mass)) => table.line("mass", string(mass)),
        Some(Mass::Weight(weight)) => table.line("weight", string(weight)),
        None => {}
    }
    match vehicle.yaw {
        Some(YawInertia::Inertia(inertia)) => table.line("yaw_inertia", string(inertia)),
        Some(YawInertia::Radius(radius)) => table.line("yaw_radius", string(radius)),
        None => {}
    }
    table.optional("class", vehicle.class.map(|class| class.to_string()));
    table.optional("wheelbase", vehicle.wheelbase.map(string));
    table.optional("heading", vehicle.heading.map(string));
    match vehicle.motion {
        Some(Velocity::Speed(speed)) => table.line("speed", string(speed)),
        Some(Velocity::Vector { x, y }) => table.line("velocity", inline(&[("x", Some(x)), ("y", Some(y))])),
        None => {}
    }
    table.optional("yaw_rate", vehicle.yaw_rate.map(string));
    let contact = vehicle.contact.map(|contact| match contact {
        ContactPoint::Polar { distance, angle } => {
            inline(&[("distance", Some(distance)), ("angle", Some(angle))])
        }
        ContactPoint::Cartesian { x, y } => inline(&[("x", Some(x)), ("y", Some(y))]),
    });
    table.optional("contact", contact);
    table.optional("length", vehicle.length.map(string));
    if let Some(Outline { length, width, cg_to_front }) = vehicle.outline {
        table.line("length", string(length));
        table.line("width", string(width));
        table.line("cg_to_front", string(cg_to_front));
    }
    table
}

fn crush_lines(crush: &Crush<Written<'_>>, vehicle: &str, fit_left_out: bool) -> Lines {
    let mut table = Lines::new(Some(format!("{vehicle}.crush")));
    table.line("side", quoted(word(&SIDES, &crush.side)));
    table.optional("width", crush.width.map(string));
    if crush.from_force_balance {
        table.line("from_force_balance", "true".to_owned());
    } else {
        table.line("depths", list(&crush.depths));
    }
    table.optional("spacing", crush.spacing.as_deref().map(list));
    let stiffness = match &crush.stiffness {
        StiffnessForm::Line(line) => stiffness_line(line),
        StiffnessForm::Category(category) => format!("{{ category = {category} }}"),
        StiffnessForm::Test(test) => format!("{{ test = {} }}", barrier_test(test, fit_left_out)),
        StiffnessForm::Zones(zones) => {
            let zones: Vec<String> = zones.iter().map(stiffness_line).collect();
            format!("{{ zones = [{}] }}", zones.join(", "))
        }
    };
    table.line("stiffness", stiffness);
    table.optional("offset", crush.offset.map(string));
    let pdof = crush.pdof.map(|pdof| match pdof {
        Pdof::Angle(angle) => string(angle),
        Pdof::Clock(hour) => quoted(&format!("{hour} o'clock")),
    });
    table.optional("pdof", pdof);
    table.optional("oblique_angle", crush.oblique_angle.map(string));
    table.optional("moment_arm", crush.moment_arm.map(string));
    let of_table = |correction| quoted(word(&OBLIQUE_CORRECTIONS, &correction));
    let oblique = crush.oblique.map(|oblique| match oblique {
        ObliqueCorrection::Capped => of_table(ObliqueCorrection::Capped),
        ObliqueCorrection::Uncapped => of_table(ObliqueCorrection::Uncapped),
        ObliqueCorrection::None => of_table(ObliqueCorrection::None),
        ObliqueCorrection::Secant => of_table(ObliqueCorrection::Secant),
        ObliqueCorrection::Friction(friction) => format!("{{ friction = {} }}", plain(friction)),
    });
    table.optional("oblique", oblique);
    table
}

fn stiffness_line(line: &StiffnessLine<Written<'_>>) -> String {
    match *line {
        StiffnessLine::Crush { a, b, g, limit } => {
            inline(&[("A", Some(a)), ("B", Some(b)), ("G", g), ("limit", limit)])
        }
        StiffnessLine::Root { d0, d1, g, limit } => {
            inline(&[("d0", Some(d0)), ("d1", Some(d1)), ("G", g), ("limit", limit)])
        }
    }
}

fn barrier_test(test: &BarrierTest<Written<'_>>, fit_left_out: bool) -> String {
    let (key, mass) = match test.mass {
        Mass::Mass(mass) => ("mass", mass),
        Mass::Weight(weight) => ("weight", weight),
    };
    let is_default = fit_left_out && test.fit == Fit::default();
    let fit =
        if is_default { String::new() } else { format!(", fit = {}", quoted(word(&Fit::WORDS, &test.fit))) };
    format!(
        "{{ {key} = {}, speed = {}, width = {}, depths = {}, no_damage_speed = {}{fit} }}",
        string(mass),
        string(test.speed),
        string(test.width),
        list(&test.depths),
        string(test.no_damage_speed)
    )
}

fn impact_lines(impact: &Impact<Written<'_>>, law_left_out: bool) -> Lines {
    let mut table = Lines::new(Some("impact".to_owned()));
    table.line("crush_plane", string(impact.crush_plane));
    let law = impact.law.law();
    if !(law_left_out && law == LawName::default()) {
        table.line("law", quoted(law.name()));
    }
    table.optional("restitution", impact.law.restitution().map(restitution));
    match &impact.law {
        ImpactLaw::Brach { tangential: condition, moment_restitution, .. } => {
            table.line("tangential", tangential(*condition));
            table.optional("moment_restitution", moment_restitution.map(plain));
        }
        ImpactLaw::Woolley { tangential_velocity_change } => {
            table.optional("tangential_velocity_change", tangential_velocity_change.map(string));
        }
        ImpactLaw::Ishikawa { tangential_restitution, .. } => {
            table.line("tangential_restitution", plain(*tangential_restitution));
        }
        ImpactLaw::KudlichSlibar { friction, .. } => table.line("friction", plain(*friction)),
    }
    table
}

fn restitution(restitution: &Restitution<Written<'_>>) -> String {
    match restitution {
        Restitution::Constant(e) => plain(*e),
        Restitution::OfClosingSpeed { speeds, values } => {
            let values: Vec<String> = values.iter().copied().map(plain).collect();
            format!("{{ speeds = {}, values = [{}] }}", list(speeds), values.join(", "))
        }
    }
}

fn tangential(tangential: BrachTangential<Written<'_>>) -> String {
    let number = |key: &str, value: Written<'_>| format!("{{ {key} = {} }}", plain(value));
    match tangential {
        BrachTangential::Critical => quoted(word(&BrachTangential::WORDS, &BrachTangential::Critical)),
        BrachTangential::Ratio(ratio) => number("ratio", ratio),
        BrachTangential::FractionOfCritical(fraction) => number("fraction", fraction),
        BrachTangential::Friction(friction) => number("friction", friction),
    }
}

fn reconstruct_lines(reconstruct: &Reconstruct, basis_left_out: bool) -> Lines {
    let mut table = Lines::new(Some("reconstruct".to_owned()));
    table.line("find", quoted(word(&UNKNOWNS, &reconstruct.find)));
    if !(basis_left_out && reconstruct.energy_basis == EnergyBasis::default()) {
        table.line("energy_basis", quoted(word(&ENERGY_BASES, &reconstruct.energy_basis)));
    }
    table
}

/// A quantity with its unit, or a range.
fn string(quantity: Quantity<Written<'_>>) -> String {
    let Written { number, spread } = quantity.number();
    amount(Amount { number, unit: Some(quantity.unit()) }, spread)
}

/// A number without a unit, or a range.
fn plain(Written { number, spread }: Written<'_>) -> String {
    amount(Amount { number, unit: None }, spread)
}

fn amount(value: Amount, spread: Option<&Spread>) -> String {
    let one = single(value);
    match spread {
        None => one,
        Some(Spread::Uniform { low, high }) => {
            format!("{{ low = {}, high = {} }}", single(*low), single(*high))
        }
        Some(Spread::Triangular { low, high }) => {
            format!("{{ low = {}, mode = {one}, high = {} }}", single(*low), single(*high))
        }
        Some(about @ (Spread::Normal { .. } | Spread::Within { .. })) => {
            format!("{{ value = {one}, {} }}", spread_about(about).unwrap_or_default())
        }
    }
}

/// The keys beside `value`; none where the spread has no such key.
fn spread_about(spread: &Spread) -> Option<String> {
    match spread {
        Spread::Normal { sd } => Some(format!("sd = {}", single(*sd))),
        Spread::Within { percent, confidence } => Some(format!(
            "within = \"{} %\", confidence = {}",
            format_number(*percent),
            format_number(*confidence)
        )),
        Spread::Uniform { .. } | Spread::Triangular { .. } => None,
    }
}

fn single(amount: Amount) -> String {
    match amount.unit {
        Some(_) => quoted(&amount.to_string()),
        None => amount.to_string(),
    }
}

/// A table in braces, without the keys that have no value.
fn inline(pairs: &[(&str, Option<Quantity<Written<'_>>>)]) -> String {
    let given: Vec<String> = pairs
        .iter()
        .filter_map(|(key, quantity)| quantity.map(|quantity| format!("{key} = {}", string(quantity))))
        .collect();
    format!("{{ {} }}", given.join(", "))
}

/// One string where all share a unit, else a list of strings; where all share a spread, with that beside it.
fn list(quantities: &[Quantity<Written<'_>>]) -> String {
    let Some((first, rest)) = quantities.split_first() else { return "[]".to_owned() };
    let spread = first.number().spread;
    let shared = match spread {
        None => Some(None),
        Some(spread) => spread_about(spread).map(Some),
    };
    let shared = shared.filter(|_| rest.iter().all(|quantity| quantity.number().spread == spread));
    let Some(shared) = shared else {
        let each: Vec<String> = quantities.iter().copied().map(string).collect();
        return format!("[{}]", each.join(", "));
    };
    let numbers = quantities.iter().map(|quantity| format_number(quantity.number().number));
    let values = if rest.iter().all(|quantity| quantity.unit() == first.unit()) {
        quoted(&format!("{} {}", numbers.collect::<Vec<_>>().join(" "), first.unit()))
    } else {
        let strings: Vec<String> = numbers
            .zip(quantities)
            .map(|(number, quantity)| quoted(&format!("{number} {}", quantity.unit())))
            .collect();
        format!("[{}]", strings.join(", "))
    };
    match shared {
        Some(spread) => format!("{{ values = {values}, {spread} }}"),
        None => values,
    }
}

/// A basic TOML string.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            '\n' => out.push_str("\\n"),
            '\t' => out.push_str("\\t"),
            // TOML forbids the other control characters in a string.
            c if c.is_ascii_control() => out.push_str(&format!("\\u{:04X}", u32::from(c))),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
