//! What the pictures of avoidability show.

use ::drawing::{Axis, ChancePicture, Drawing, PathTimeCourse, PathTimePicture, SightPicture, ValueMark};
use analysis::{AvoidRun, Avoidance, obstacle_name};
use case::{AvoidBasis, Case, DemandForm, OtherParty, choices};

use super::{axis, scale_unit};
use crate::units::{Measure, Units, number};
use crate::words::{run_words, title};

/// Points of a run.
const POINTS: u32 = 240;
/// Points of the curve of the probability.
const SPEEDS: u32 = 160;
/// How far the plot goes beyond what it shows, as a share of it.
const BEYOND: f64 = 0.08;
/// (m) and beyond the place of the impact, at least.
const LEAST_BEYOND: f64 = 3.0;

choices! {
    /// A picture of whether a collision was avoidable.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum AvoidPicture {
        /// Distance against time: what happened and what would have, with the other party, the reaction
        /// demand and the place of the impact.
        PathTime = "path-time",
        /// The probability that the collision is avoided, against the speed.
        Chance = "chance",
        /// The paths of both to the impact, the obstacles and the line of sight.
        Sight = "sight",
    }
}

impl AvoidPicture {
    /// Those that a case with an answer has enough for, unless only the answer shows it.
    pub(crate) fn of_case(case: &Case) -> Vec<Self> {
        let plan = case.avoid_plan().is_some().then_some(Self::Sight);
        [Self::PathTime].into_iter().chain(plan).collect()
    }

    /// Draws it.
    ///
    /// # Errors
    /// Why there is nothing to draw, in a sentence.
    pub fn draw(self, case: &Case, found: &Avoidance, units: Units) -> Result<Drawing, &'static str> {
        match self {
            Self::PathTime => Ok(path_time_picture(case, found, units).draw()),
            Self::Chance => chance_picture(case, found, units).map(|picture| picture.draw()).ok_or(
                "there is no probability to draw: no number of the case is a range, and no evidence gives the speed",
            ),
            Self::Sight => sight_picture(case, found, units).map(|picture| picture.draw()).ok_or(
                "there is no plan to draw: the case has no [[avoid.obstacle]], and no [avoid.sight] that says \
                 how both approached",
            ),
        }
    }
}

/// The name of a run in the legend.
fn legend(run: &AvoidRun, units: Units) -> String {
    format!("{}: {}", units.road_speed(run.course.speed), run_words(run.hypothesis).legend)
}

/// The word for the other party.
pub(crate) fn party(case: &Case) -> &'static str {
    match case.avoid.as_ref().and_then(|avoid| avoid.other_party) {
        Some(OtherParty::Pedestrian) => "pedestrian",
        Some(OtherParty::Cyclist) => "cyclist",
        Some(OtherParty::Vehicle) => "other vehicle",
        None => "other party",
    }
}

pub(crate) fn path_time_picture(case: &Case, found: &Avoidance, units: Units) -> PathTimePicture {
    let scene = &found.scene;
    let party = party(case);
    let clears = scene.clears.map(|clears| scene.time + clears.after);
    let ends = found.runs.iter().map(|run| run.arrival.or(run.course.stops_after()).unwrap_or(scene.time));
    let last = ends.chain(clears).fold(scene.time, f64::max);
    let until = last * (1.0 + 2.0 * BEYOND);
    let beyond = (scene.distance * BEYOND).max(LEAST_BEYOND);
    let courses = found
        .runs
        .iter()
        .map(|run| {
            let at = |time: f64| [time, run.course.position(time) - scene.distance];
            // A run that ends in the collision ends there.
            let end = run.arrival.filter(|_| !run.is_avoided()).unwrap_or(until);
            let points = (0..=POINTS).map(|k| at(end * f64::from(k) / f64::from(POINTS))).collect();
            let reaction = run.course.response.map(|response| response.reaction());
            let brakes = reaction.filter(|time| *time <= end).map(at);
            PathTimeCourse { legend: legend(run, units), pen: run_words(run.hypothesis).pen, points, brakes }
        })
        .collect();
    let given = case.avoid.as_ref();
    let form = case.avoid_form(&AvoidBasis::default());
    let came = match form.as_ref().map(|form| &form.demand) {
        Some(DemandForm::Other(other)) => Some(other),
        _ => None,
    };
    let out = scene.clears.map(|clears| clears.distance);
    let goes_on = given.and_then(|avoid| avoid.clear.as_ref()).is_some_and(|clear| clear.speed.is_none());
    let crossing = || {
        let mut points = Vec::new();
        if let Some(other) = came {
            let (before, advance) = (other.distance.si(), other.advance());
            let after = out.filter(|_| goes_on && clears.is_some()).unwrap_or(0.0);
            points.extend((0..=POINTS).filter_map(|k| {
                let gone = (before + after) * f64::from(k) / f64::from(POINTS);
                Some([advance.time_over(gone).ok()?, gone - before])
            }));
        }
        if came.is_none() || !goes_on {
            points.push([scene.time, 0.0]);
            points.extend(out.zip(clears).map(|(distance, time)| [time, distance]));
        }
        (points, format!("{party}, along its own path"))
    };
    let highest = out.unwrap_or(0.0).max(beyond) + 0.5 * beyond;
    // The path of the other party, the danger zone, and how far up both reach.
    let (other, zone, highest) = match (&scene.same_line, clears) {
        (Some(line), _) => {
            let at = |k: u32| {
                let time = until * f64::from(k) / f64::from(POINTS);
                [time, line.at(time).position - scene.distance]
            };
            let is_shown = |[_, way]: &[f64; 2]| *way >= -scene.distance - beyond;
            let points: Vec<[f64; 2]> = (0..=POINTS).map(at).take_while(is_shown).collect();
            let highest = points.iter().map(|[_, way]| way + 0.5 * beyond).fold(highest, f64::max);
            (Some((points, format!("vehicle {}, on the same line", found.vehicle.other()))), None, highest)
        }
        (None, clears) => {
            let zone = match clears {
                Some(clears) => {
                    ([scene.time, clears], format!("{party} in the danger zone, until it has cleared it"))
                }
                None => ([scene.time, until], format!("{party} in the danger zone; not known to clear it")),
            };
            ((came.is_some() || out.is_some()).then(crossing), Some(zone), highest)
        }
    };
    let [distance, time] = [(Measure::Way, scene.distance), (Measure::Time, scene.time)]
        .map(|(measure, value)| units.format(measure, value));
    PathTimePicture {
        title: title(case),
        subtitle: format!("Distance and time of vehicle {} before the impact", found.vehicle),
        description: format!(
            "Distance against time. The reaction demand is {distance} and {time} before the impact. {}",
            found.runs.iter().map(|run| outcome(found, run, units)).collect::<Vec<_>>().join(" ")
        ),
        time: axis(units, "time since the reaction demand", Measure::Time),
        way: axis(units, "distance to the place of the impact", Measure::Way),
        until,
        reach: [-scene.distance - beyond, highest],
        courses,
        other,
        zone,
        impact: (scene.time, format!("impact: {time}, {}", units.road_speed(scene.at_impact))),
        demand: format!("reaction demand, {distance} before the impact"),
        brakes: "brakes take effect".to_owned(),
    }
}

/// (s) between two places of the paths.
const APART: f64 = 0.5;
/// How many of them are shown beyond the demand and the free view.
const MORE: f64 = 1.0;

pub(crate) fn sight_picture(case: &Case, found: &Avoidance, units: Units) -> Option<SightPicture> {
    let obstacles = &case.avoid.as_ref()?.obstacles;
    found.eye_and_point(0.0)?;
    // In axes with y to the left of x.
    let shown = |[x, y]: [f64; 2]| [x, case.axes.lateral(y)];
    let free = found.scene.view.sight();
    let first = ((free.map_or(0.0, |sight| sight.time).max(found.scene.time) / APART).ceil() + MORE) * APART;
    let times = std::iter::successors(Some(first), |time| (*time > 0.0).then(|| time - APART));
    let way = |of: usize| -> Vec<([f64; 2], String)> {
        let at = |time: f64| Some((shown(found.eye_and_point(time)?[of]), units.format(Measure::Time, time)));
        times.clone().filter_map(at).collect()
    };
    let corners = |index: usize| -> Vec<[f64; 2]> {
        let places = obstacles.get(index).map_or(&[][..], |obstacle| &obstacle.polygon);
        places.iter().map(|place| shown([place.x.si(), place.y.si()])).collect()
    };
    let name = |index: usize| {
        let given = obstacles.get(index).and_then(|obstacle| obstacle.name.as_ref());
        given.map_or_else(|| obstacle_name(case, index), ToString::to_string)
    };
    let line = free.and_then(|sight| {
        let ends = found.eye_and_point(sight.time)?.map(shown);
        let time = units.format(Measure::Time, sight.time);
        Some((ends, format!("the view becomes free, {time} before the impact")))
    });
    let says = line.as_ref().map_or("the obstacles hide nothing", |(_, says)| says);
    let party = party(case);
    let is_eye = !obstacles.is_empty() || case.avoid.as_ref()?.sight.eye.is_some();
    let (subtitle, description) = if obstacles.is_empty() {
        ("Before the impact", "The paths of both to the impact, seen from above.".to_owned())
    } else {
        (
            "What the obstacles hide",
            format!("Obstacles and the paths of both to the impact, seen from above: {says}."),
        )
    };
    Some(SightPicture {
        title: title(case),
        subtitle: format!("{subtitle}: places each half second, with the time to the impact"),
        description,
        obstacles: (0..obstacles.len()).map(|index| (corners(index), name(index))).collect(),
        ways: [way(0), way(1)],
        legend: [
            format!("{}vehicle {}", if is_eye { "eye of the driver of " } else { "" }, found.vehicle),
            party.to_owned(),
        ],
        line,
        scale: scale_unit(units, Measure::Way),
    })
}

/// One run in a sentence.
fn outcome(found: &Avoidance, run: &AvoidRun, units: Units) -> String {
    let name = legend(run, units);
    let other = found.on_line();
    if run.stops_before() {
        let stops = other
            .map_or("stops before the place".to_owned(), |other| format!("does not reach vehicle {other}"));
        return format!("{name}: {stops}.");
    }
    let late = if run.is_late_enough == Some(true) { ", after it is clear" } else { "" };
    let place = other.map_or("reaches the place".to_owned(), |other| format!("reaches vehicle {other}"));
    format!("{name}: {place} at {}{late}.", units.road_speed(run.collision_speed))
}

pub(crate) fn chance_picture(case: &Case, found: &Avoidance, units: Units) -> Option<ChancePicture> {
    let chance = found.chance.as_ref()?;
    let [low, high] = chance.avoiding_range();
    let scene = &found.scene;
    let ends = [
        low.min(scene.limit).min(scene.speed) * (1.0 - BEYOND),
        high.max(scene.limit).max(scene.speed) * (1.0 + BEYOND),
    ];
    let at = |k: u32| ends[0] + (ends[1] - ends[0]) * f64::from(k) / f64::from(SPEEDS);
    let points = (0..=SPEEDS).map(at).map(|speed| {
        let [low, probability, high] = chance.avoided_from(speed);
        [speed, low, probability, high]
    });
    let mark = |value: f64, lead: &str| ValueMark { value, lead: lead.to_owned() };
    let [_, at_limit, _] = chance.avoided_from(scene.limit);
    Some(ChancePicture {
        title: title(case),
        subtitle: "Probability that the collision is avoided, against the speed at the reaction demand"
            .to_owned(),
        description: format!(
            "The probability falls with the speed. At {}, the limit, it is {}.",
            units.road_speed(scene.limit),
            number(at_limit, 3)
        ),
        across: axis(units, "speed", Measure::RoadSpeed),
        decimals: 1,
        upward: Axis { title: "probability that it is avoided".to_owned(), unit: 1.0 },
        points: points.collect(),
        marks: vec![mark(scene.limit, "limit:"), mark(scene.speed, "driven:")],
        legend: ["probability", "95 % interval from the sampling"].map(str::to_owned),
    })
}
