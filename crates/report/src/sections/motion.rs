//! The motion after the impact in words and tables.

use analysis::quantities as rows;
use analysis::{BothFound, BothMethod, ClosedForm, Seen, Travel, TravelOrigin};
use case::{Basis, Geometry, RestHeadingData};
use pim_core::VehicleId;
use reconcile::COLLINEAR;

use super::chosen::Chosen;
use super::uncertainty::counted;
use crate::basis;
use crate::document::{Column, NONE, Table, Width};
use crate::units::{Measure, Units, number};
use crate::{warnings, words};

/// How both speeds were found.
pub(crate) fn how(both: &BothFound, analysis: &Seen, units: Units) -> String {
    let mut how = found_by(both, analysis, units);
    let all = both.combinations.len();
    if all > 1 {
        how.push_str(&format!(
            " The rests allow {all} combinations of motions of the two vehicles; this one agrees best with the \
             impulse."
        ));
    }
    let rivals: Vec<String> =
        both.rivals().map(|other| other.speeds.map(|speed| units.speed(speed)).join(" and ")).collect();
    if !rivals.is_empty() {
        how.push_str(&format!(
            " The evidence does not distinguish it from another: {} would agree about as well. Do not rely \
             on these speeds until a mark or a witness shows which way the vehicles turned.",
            rivals.join(", or ")
        ));
    }
    how
}

/// The evidence from which both speeds follow.
fn found_by(both: &BothFound, analysis: &Seen, units: Units) -> String {
    let evidence = match origins(analysis)[..] {
        [one, two] if one.is_by_rest() && two.is_by_rest() => {
            "is known from the rest positions of both vehicles"
        }
        [TravelOrigin::Given, TravelOrigin::Given] | [] => "the case gives",
        _ => "the case gives or which is known from the rest position",
    };
    let left = format!("how the vehicles left the impact, which {evidence}");
    let angle = units.format(Measure::Angle, both.momentum.angle().abs());
    match &both.method {
        BothMethod::Momentum => {
            let has_crush = analysis.vehicles.iter().any(|vehicle| vehicle.crush_energy().is_some());
            let check = if has_crush { " The crush energy is a check." } else { "" };
            format!(
                "The speeds follow from momentum alone and {left}; the headings differ by {angle} (theory 10).{check}{}",
                point_masses(both)
            )
        }
        BothMethod::MomentumAndSpeed { given } => format!(
            "The speed follows from momentum along the heading of vehicle {}, from the speed of vehicle {given}, \
             which the case gives ({}), and from {left}; the headings differ by {angle} (theory 10).{}",
            given.other(),
            units.speed(both.speeds[given.index()]),
            point_masses(both)
        ),
        BothMethod::Wall { vehicle, restitution } => format!(
            "The object that vehicle {vehicle} hit is fixed and takes momentum, so the speed follows from \
             {left}, and from the restitution of {} that the case gives: along the normal the vehicle rebounds \
             with that share of its speed (theory 10).",
            number(*restitution, 4)
        ),
        BothMethod::MomentumAndCrush { crush_energy, admissible, .. } => {
            let pairs = match admissible.len() {
                1 => "One admissible pair of speeds".to_owned(),
                several => format!("{several} admissible pairs of speeds"),
            };
            let energy = units.format(Measure::Energy, *crush_energy);
            let stands_for = match analysis.basis {
                Basis::Dissipated => String::new(),
                Basis::Absorbed => ", which the vehicles absorb up to maximum engagement".to_owned(),
                Basis::TangentialShare(_) => format!(", which equals {}", basis::work(analysis.basis)),
            };
            format!(
                "The headings differ by {angle}, within {}° of one line, so momentum alone does not give both \
                 speeds. They follow from momentum along that line and {left}, and from the crush energy, \
                 {energy} (theory 10){stands_for}. {pairs}.",
                number(COLLINEAR.to_degrees(), 0)
            )
        }
    }
}

/// A note on what is unknown if only masses and headings are given.
fn point_masses(both: &BothFound) -> &'static str {
    match both.geometry {
        Geometry::PointMasses => {
            " The case lacks a contact point, a yaw inertia or [impact], which do not affect the speeds: \
             the vehicles count as point masses, the energy is that of their translation, and \
             restitution and closing speed are those along the impulse."
        }
        Geometry::Given | Geometry::Plane => "",
    }
}

fn origins(analysis: &Seen) -> Vec<TravelOrigin> {
    analysis.travel.iter().flatten().map(|travel| travel.origin).collect()
}

/// The headline of a motion alone.
pub(crate) fn answer(id: VehicleId, travel: &Travel, units: Units) -> String {
    let length = |si: f64| units.format(Measure::Length, si);
    let turn = units.format(Measure::Angle, travel.rest.heading - travel.start.heading);
    let time = units.format(Measure::Time, travel.rest.time);
    let speed = units.speed(travel.start.motion.velocity.norm());
    match travel.origin {
        TravelOrigin::Rest | TravelOrigin::StraightRest => format!(
            "Vehicle {id} left the impact at {speed}, turning at {}",
            units.yaw_rate(travel.start.motion.yaw_rate)
        ),
        TravelOrigin::Given | TravelOrigin::Impact => format!(
            "Vehicle {id} comes to rest after {} and {time}, turned by {turn}",
            length(travel.rest.distance)
        ),
    }
}

/// The method of a motion alone.
pub(crate) fn method(analysis: &Seen, units: Units) -> String {
    let mut how = "Each vehicle is one rigid body on four wheels, which roll, skid or slide on the ground \
                   (theory 11)."
        .to_owned();
    for (id, travel) in VehicleId::ALL.into_iter().zip(&analysis.travel) {
        let Some(travel) = travel else { continue };
        let apart = |si: f64| units.format(Measure::Length, si);
        match travel.origin {
            TravelOrigin::Impact | TravelOrigin::Given => {}
            TravelOrigin::Rest => {
                let turn = format!("with a turn of less than {:.0}°", analysis::UNLIKELY_TURN.to_degrees());
                let others = match travel.likely_others().count() {
                    0 => format!("No other motion {turn} was found that reaches it"),
                    1 => format!("One other motion {turn} reaches it as well"),
                    several => format!("{several} other motions {turn} reach it as well"),
                };
                let miss = travel.miss().map_or(0.0, |(miss, _)| miss);
                how.push_str(&format!(
                    " The motion of vehicle {id} after the impact brings it to its rest, within {}. {others}.",
                    apart(miss)
                ));
            }
            TravelOrigin::StraightRest => {
                let measured = travel.measured.map(|rest| rest.position - travel.start.position);
                let length = measured.map_or(travel.rest.distance, |way| way.norm());
                how.push_str(&format!(
                    " By EDCRASH's rule, vehicle {id} did not spin: it is taken to have left straight towards \
                     its rest, without yaw, at the speed that carries it {}, the distance to where it was found.",
                    apart(length)
                ));
            }
        }
    }
    how
}

/// What both speeds and the velocities after the impact imply.
pub(crate) fn momentum(analysis: &Seen, units: Units) -> Vec<Table> {
    let Some(both) = &analysis.both else { return Vec::new() };
    let chosen = Chosen { analysis, units };
    let mut whole = Table::of_two("Momentum", ["", "", "source"]);
    for row in [
        &rows::MOMENTUM_APPROACH_ANGLE,
        &rows::MOMENTUM_CG_CLOSING_SPEED,
        &rows::MOMENTUM_CG_RESTITUTION,
        &rows::MOMENTUM_RESTITUTION,
        &rows::MOMENTUM_IMPULSE_RATIO,
    ] {
        chosen.shared(&mut whole, row);
    }
    chosen.shared(&mut whole, &rows::MOMENTUM_CRITICAL_IMPULSE_RATIO);
    chosen.shared_vector(&mut whole, [&rows::MOMENTUM_IMPULSE_X, &rows::MOMENTUM_IMPULSE_Y]);
    if matches!(both.method, BothMethod::MomentumAndCrush { .. } | BothMethod::MomentumAndSpeed { .. }) {
        chosen.shared(&mut whole, &rows::MOMENTUM_DISAGREEMENT);
    }
    for row in [&rows::MOMENTUM_ENERGY_LOSS, &rows::MOMENTUM_NORMAL_WORK, &rows::MOMENTUM_TANGENTIAL_WORK] {
        chosen.shared(&mut whole, row);
    }
    let mut of_vehicles = Table::of_vehicles("Momentum by vehicle");
    for row in [&rows::MOMENTUM_DELTA_V, &rows::MOMENTUM_PDOF, &rows::MOMENTUM_FINAL_YAW_RATE] {
        chosen.pair(&mut of_vehicles, row);
    }
    let mut note =
        "These figures follow only from the speeds found and the velocities after the impact.".to_owned();
    if both.geometry == Geometry::Given {
        note.push_str(if both.one_velocity {
            " The case gives one velocity for both vehicles and no yaw rate: they left as one body that did not turn."
        } else if both.implied.is_yaw_known {
            " The restitution is that of the motions at C, from the velocities and the known yaw rates."
        } else {
            " No yaw rate after the impact is known, so the restitution is that after the impulse at C, under which both \
             vehicles are free to turn."
        });
    }
    if both.is_by_crush() {
        note.push_str(" The tables of the impact follow from the same speeds by the impact law of the case.");
    }
    of_vehicles.note(note);
    [whole, of_vehicles].into_iter().chain(combinations(both, units)).collect()
}

/// What the impact law of the case predicts from the speeds that momentum gave, next to the evidence; `None`
/// if momentum did not give them, or the case has no law.
pub(crate) fn law_check(analysis: &Seen, units: Units) -> Option<[Table; 2]> {
    let (law, told) = (analysis.law_check()?, analysis.exchange()?);
    let outcome = &law.outcome;
    let chosen = Chosen { analysis, units };
    let mut whole = Table::of_two("Check: the impact law", ["", "", "source"]);
    for row in [&rows::LAW_CHECK_RESTITUTION, &rows::LAW_CHECK_ENERGY_LOSS] {
        chosen.shared(&mut whole, row);
    }
    let mut of_vehicles = Table::of_vehicles("Check: the law by vehicle");
    for row in [
        &rows::LAW_CHECK_DELTA_V,
        &rows::LAW_CHECK_DELTA_V_DIFFERENCE,
        &rows::LAW_CHECK_FINAL_SPEED,
        &rows::LAW_CHECK_FINAL_YAW_RATE,
        &rows::LAW_CHECK_PDOF,
    ] {
        chosen.pair(&mut of_vehicles, row);
    }
    of_vehicles.note(format!(
        "The impact law of the case, applied to the speeds found. By the law the impact loses {}, by \
         momentum {}. No result depends on this check: the more the two differ, the less the law or its \
         coefficients fit this collision.",
        units.format(Measure::Energy, outcome.energy.loss),
        units.format(Measure::Energy, told.energy.loss),
    ));
    Some([whole, of_vehicles])
}

/// The most likely combinations of starts that reach the rest positions, and the objections to each; `None`
/// unless there are several.
fn combinations(both: &BothFound, units: Units) -> Option<Table> {
    if both.combinations.len() < 2 {
        return None;
    }
    let speed = units.name(Measure::Speed);
    let mut table = Table::new("Motions that reach the rest positions").columns([
        Column::words("turned on the path", Width::Fit(20)),
        Column::numbers("speed 1", Width::Fit(10)).unit(speed),
        Column::numbers("speed 2", Width::Fit(10)).unit(speed),
        Column::numbers("weight", Width::Fit(8)),
        Column::words("objections", Width::Share),
    ]);
    for combination in both.combinations.iter().take(LISTED) {
        let turn =
            |turn: Option<f64>| turn.map_or_else(|| NONE.to_owned(), |si| units.format(Measure::Angle, si));
        let [one, two] = combination.speeds.map(|si| units.plain(Measure::Speed, si));
        let against: Vec<String> =
            combination.against.iter().map(|check| warnings::momentum_differs(check, units)).collect();
        table.row([
            combination.turns.map(turn).join(" and "),
            one,
            two,
            number(combination.weight, 3),
            if against.is_empty() { "none".to_owned() } else { against.join("; ") },
        ]);
    }
    let others = match both.combinations.len().saturating_sub(LISTED) {
        0 => String::new(),
        others => format!(" {} more weigh less.", counted(others, "combination")),
    };
    table.note(format!(
        "The weight follows from how well yaw rates, restitution, impulse ratio and crush energy together agree \
         with the impulse, within usual errors (theory 10); an objection names one that alone does not.{others}"
    ));
    Some(table)
}

/// Maximum number of listed combinations: further ones have almost no weight.
const LISTED: usize = 6;

/// The path to rest of both vehicles; empty if none is followed.
pub(crate) fn tables(analysis: &Seen, units: Units) -> Vec<Table> {
    if analysis.travel.iter().all(Option::is_none) {
        return Vec::new();
    }
    let chosen = Chosen { analysis, units };
    let each = |f: &dyn Fn(&Travel) -> Option<String>| [0, 1].map(|i| f(analysis.travel[i].as_ref()?));
    let mut way = Table::of_vehicles("From the impact to rest");
    let origin = |travel: &Travel| {
        Some(match travel.origin {
            TravelOrigin::Impact => "the impact".to_owned(),
            TravelOrigin::Given => "the case".to_owned(),
            TravelOrigin::Rest => "the rest".to_owned(),
            TravelOrigin::StraightRest => "the rest, straight".to_owned(),
        })
    };
    way.pair("start from", each(&origin), "");
    for row in [
        &rows::START_SPEED,
        &rows::START_DIRECTION,
        &rows::START_YAW_RATE,
        &rows::REST_DISTANCE,
        &rows::REST_TIME,
    ] {
        chosen.pair(&mut way, row);
    }
    let turn =
        |travel: &Travel| Some(units.format(Measure::Angle, travel.rest.heading - travel.start.heading));
    way.pair("turn on the path", each(&turn), "theory 11");
    chosen.vectors(&mut way, [&rows::REST_X, &rows::REST_Y]);
    chosen.pair(&mut way, &rows::REST_HEADING);
    let measured = |travel: &Travel| {
        let position = travel.measured.as_ref()?.position;
        Some(units.format_vector(Measure::Length, position.into()))
    };
    way.pair("rest position as measured", each(&measured), "");
    let heading = |travel: &Travel| {
        Some(match travel.measured.as_ref()?.heading {
            RestHeadingData::Heading(heading) => units.format(Measure::Angle, heading),
            RestHeadingData::Turned(turn) => format!("turned by {}", units.format(Measure::Angle, turn)),
        })
    };
    way.pair("heading at rest as measured", each(&heading), "");
    let miss = |travel: &Travel| {
        // A start that was solved for reaches the rest by construction.
        if travel.origin == TravelOrigin::Rest {
            return Some("none: solved for".to_owned());
        }
        let (apart, turn) = travel.miss()?;
        Some(format!("{}, {}", units.format(Measure::Length, apart), units.format(Measure::Angle, turn)))
    };
    way.pair("found and measured apart", each(&miss), "");
    let most = analysis.travel.iter().flatten().map(|travel| travel.passes.len()).max().unwrap_or(0);
    for i in 0..most {
        let pass = |travel: &Travel| Some(words::pass(travel.passes.get(i)?, units));
        way.pair(&format!("path and point {} apart", i + 1), each(&pass), "");
    }
    let form = |travel: &Travel| {
        Some(match travel.closed? {
            ClosedForm::Straight { .. } => "straight".to_owned(),
            ClosedForm::Spin(_) => "spin, by Marquard".to_owned(),
        })
    };
    way.pair("closed form that applies", each(&form), "theory 11");
    let speed = |travel: &Travel| {
        Some(match travel.closed? {
            ClosedForm::Straight { speed, .. } => units.speed(speed),
            ClosedForm::Spin(start) => units.speed(start.speed),
        })
    };
    way.pair("  speed at the start by it", each(&speed), "theory 11");
    let yaw_rate = |travel: &Travel| match travel.closed? {
        ClosedForm::Straight { .. } => None,
        ClosedForm::Spin(start) => Some(units.yaw_rate(start.yaw_rate)),
    };
    way.pair("  yaw rate at the start by it", each(&yaw_rate), "theory 11");

    let mut energy = Table::of_vehicles("Energy on the path to rest");
    let joules =
        |f: fn(&Travel) -> f64| move |travel: &Travel| Some(units.format(Measure::Energy, f(travel)));
    energy.pair("kinetic energy at the start", each(&joules(|t| t.rest.energy.start)), "theory 11");
    energy.pair("taken by the tyres", each(&joules(|t| t.rest.energy.friction)), "theory 11");
    if analysis.travel.iter().flatten().any(|travel| travel.rest.energy.grade != 0.0) {
        energy.pair("given by the grade", each(&joules(|t| t.rest.energy.grade)), "theory 11");
    }
    let remainder = |travel: &Travel| {
        let share = travel.rest.energy.remainder / travel.rest.energy.start;
        share.is_finite().then(|| format!("{} %", number(100.0 * share, 4)))
    };
    energy.pair("error of the integration", each(&remainder), "theory 11");
    vec![way, energy]
}
