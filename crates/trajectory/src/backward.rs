//! The motion after the impact, from the rest position.

use core::f64::consts::{PI, TAU};

use pim_core::{Body, InvalidInput, Motion, Vector2};
use real::{Bundle, Duals, Real, elementary, principal_angle};

use crate::chassis::Chassis;
use crate::closed::Spin;
use crate::error::NoRest;
use crate::field::root;
use crate::forward::{follow, to_rest};
use crate::ground::Ground;
use crate::state::{Control, Rest, State};
use crate::steer::Steer;
use pim_core::check;

/// Maximum number of distinct starts.
pub const MOST_STARTS: usize = 8;

/// Number of step tolerances within which a rest counts as reached, in position and by the turn of the
/// wheelbase: the integration is no more accurate, and jumps by as much when it chooses other steps.
pub const REACHED: f64 = 10.0;

/// (m) miss at which Newton's method stops, far below the required accuracy, so that starts do not depend on
/// where it stopped.
const FINE: f64 = 1e-9;

/// (m) miss down to which the search uses a coarse integration.
const COARSE: f64 = 0.05;

/// Two starts that differ by less than this fraction of their speed are the same.
const SAME: f64 = 1e-4;

/// (rad) turns that differ by less count as equal: no rest is reached more exactly.
const SAME_TURN: f64 = 1e-3;

/// Maximum number of rounds of Newton's method; a good seed needs five to ten.
const MOST_ROUNDS: usize = 15;

/// Maximum number of full steps near the rest that may end beyond a jump.
const MOST_JUMPS: usize = 12;

/// Numbers of jumps after which the slopes are recomputed.
const RENEWED: [usize; 2] = [2, 5];

/// Steps cycle if one ends within this fraction of its length from the start of one of the last.
const BACK: f64 = 0.2;

/// Number of tolerances within which a rest is accepted once the steps have met a jump.
const SETTLED: f64 = 5.0;

/// Number of last steps examined for a cycle.
const LONGEST_ROUND: usize = 6;

/// Maximum number of motions tried with Marquard's closed form to approach the rest; five are usual.
const MOST_APPROACHES: usize = 10;

/// (m) miss from which Newton's method can continue.
const LED: f64 = 1.0;

/// (m) miss that the closed form need not reduce further.
const APPROACHED: f64 = 0.1;

/// Maximum change per step of the inputs of the closed form: ln of the distance, angle and turn (rad).
const LONGEST_CHANGE: f64 = 0.7;

/// Relative distance of the motions whose differences give the slopes. With it, the median relative error of
/// 108 slopes is 1e-6, the greatest 6e-5. Smaller distances suffer from rounding, greater ones from the
/// curvature where a wheel almost stops.
const NEAR: f64 = 1e-10;

/// Full steps have gone astray if they miss by this many times [`COARSE`].
const FAR: f64 = 20.0;

/// Steps after which a coarse integration is given up: it takes some fifty.
const MOST_COARSE_STEPS: u32 = 2000;

/// Seeds of the search: factors on Marquard's speed and yaw rate, and an angle (rad) from the direct path.
///
/// A vehicle that rolls out was slower than in his two phases, and went off to the side when its wheels
/// gripped.
const SEEDS: [[f64; 3]; 7] = [
    [1.0, 1.0, 0.0],
    [0.8, 1.4, 0.0],
    [0.6, 0.8, 0.0],
    [0.9, 1.0, 0.4],
    [0.9, 1.0, -0.4],
    [0.6, 2.0, 0.8],
    [0.6, 2.0, -0.8],
];

/// Angles (rad) of the wider search, and its factors on Marquard's speed and yaw rate.
const WIDER: [f64; 7] = [0.0, 0.25, -0.25, 0.6, -0.6, 1.2, -1.2];
const WIDER_SHARES: [[f64; 2]; 6] = [[1.0, 1.5], [0.8, 0.5], [1.2, 1.0], [0.5, 1.0], [0.5, 3.0], [1.4, 2.0]];

/// The rest position and heading of the vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Target {
    /// (m) position of the CG in the scene.
    pub position: Vector2<f64>,
    /// (rad) heading in the scene.
    pub heading: f64,
    /// Whether the number of full turns is known and included in `heading`, counted from the heading at
    /// separation. If not, all starts are sought whose headings at rest differ from it by full turns, up to
    /// one and a half revolutions.
    pub turns_known: bool,
    /// (m) a point on the path of the CG, such as the end of a mark; it orders the starts.
    pub via: Option<Vector2<f64>>,
}

/// One motion after the impact that leads to the rest.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct StartMotion {
    /// Velocity and yaw rate at separation.
    pub motion: Motion<f64>,
    /// (rad) turn of the vehicle on its path.
    pub turn: f64,
    /// (m) miss of its rest from the target, in position and by the turn of the wheelbase.
    pub miss: f64,
    /// (m) distance of its path from the point `via` of the target.
    pub via_miss: Option<f64>,
    /// Its rest.
    pub rest: Rest<f64>,
}

/// The starts that lead to a rest, the most likely first: nearest to the point on the path if one is given,
/// then with the smallest turn; of equal turns to either side, the one with less energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Starts {
    found: [Option<StartMotion>; MOST_STARTS],
}

impl Starts {
    /// The most likely start.
    #[must_use]
    pub fn first(&self) -> Option<&StartMotion> {
        self.iter().next()
    }

    /// All starts.
    pub fn iter(&self) -> impl Iterator<Item = &StartMotion> {
        self.found.iter().flatten()
    }

    /// Inserts a start of a body in order, unless it is already there or the list is full of more likely
    /// ones.
    fn insert(&mut self, departure: StartMotion, body: &Body<f64>) {
        if self.iter().any(|other| same(&other.motion, &departure.motion)) {
            return;
        }
        let rank = |start: &StartMotion| [start.via_miss.unwrap_or(0.0), start.turn.abs()];
        // Without this, rounding would choose between half a turn to the left and one to the right.
        let are_as_far = |[via, turn]: [f64; 2], [other_via, other]: [f64; 2]| {
            via == other_via && (turn - other).abs() < SAME_TURN
        };
        let is_likelier = |new: &StartMotion, old: &StartMotion| {
            if !are_as_far(rank(new), rank(old)) {
                return rank(new) < rank(old);
            }
            let [energy, other] = [new, old].map(|start| body.kinetic_energy(&start.motion));
            let is_mirrored = (energy - other).abs() <= SAME * other;
            if is_mirrored { new.turn > old.turn } else { energy < other }
        };
        let mut carried = Some(departure);
        for place in &mut self.found {
            let later = match (&carried, &*place) {
                (Some(new), Some(old)) => is_likelier(new, old),
                (new, None) => new.is_some(),
                (None, _) => false,
            };
            if later {
                core::mem::swap(place, &mut carried);
            }
        }
    }
}

/// Whether two motions are the same to the accuracy of the search.
fn same(a: &Motion, b: &Motion) -> bool {
    let (dv, speed) = (a.velocity - b.velocity, a.velocity.x.abs() + a.velocity.y.abs() + a.yaw_rate.abs());
    dv.x.abs() + dv.y.abs() + (a.yaw_rate - b.yaw_rate).abs() <= SAME * speed
}

/// The reason why no motion leads to the rest.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Unreached {
    /// An input is impossible.
    #[error(transparent)]
    Invalid(#[from] InvalidInput),
    /// The vehicle did not move.
    #[error("the vehicle rests where it was at separation, so that it has no motion to find")]
    NoWay,
    /// None of the motions tried comes to rest at all.
    #[error("no motion tried comes to rest: {0}")]
    NeverRests(NoRest),
    /// Even the nearest motion misses the rest.
    #[error(
        "no motion after the impact leads to this rest: the nearest, at {:.3} m/s and {:.3} rad/s, comes to rest \
         {:.3} m from it; check the rest, the drag of the wheels, the friction and the steer",
        speed(.motion), .motion.yaw_rate, .miss
    )]
    Missed {
        /// The motion that comes nearest.
        motion: Motion<f64>,
        /// (m) its rest position.
        position: Vector2<f64>,
        /// (rad) its heading at rest.
        heading: f64,
        /// (m) its miss, in position and by the turn of the wheelbase.
        miss: f64,
    },
}

/// (m/s) speed of the CG.
fn speed(motion: &Motion) -> f64 {
    let v = motion.velocity;
    root(v.x * v.x + v.y * v.y)
}

/// Finds every motion after the impact that brings a vehicle from separation, at `position` (m) with
/// `heading` (rad), to the rest of `target`.
///
/// It solves [`to_rest`] for velocity and yaw rate: first by correcting the errors of Marquard's closed form,
/// then by Newton's method, with slopes from nearby motions that take the same steps; if that fails, from
/// seeds around the closed form. Several motions lead to most rests: with the shorter turn, the longer one
/// the other way round, and one full turn more.
///
/// # Errors
/// [`Unreached::Missed`] if none is found, with the nearest.
pub fn to_start(
    chassis: &Chassis,
    steer: Steer<'_, f64>,
    ground: &Ground<'_, f64>,
    position: Vector2<f64>,
    heading: f64,
    target: &Target,
    control: &Control,
) -> Result<Starts, Unreached> {
    Search::new(chassis, steer, ground, position, heading, target, control)?.run()
}

/// Finds the motion near a `guess` that leads to the rest of `target`: for a rest that differs little from
/// one with a known start, as in samples of uncertain inputs. It runs Newton's method once from the guess;
/// only if that fails, it searches as [`to_start`] does, and takes the most likely.
///
/// The heading of the target should include full turns, so that the motion turns as far as the guess.
///
/// # Errors
/// [`Unreached::Missed`] if none is found, with the nearest.
#[expect(clippy::too_many_arguments, reason = "those of `to_start`, and the guess")]
pub fn to_start_near(
    chassis: &Chassis,
    steer: Steer<'_, f64>,
    ground: &Ground<'_, f64>,
    position: Vector2<f64>,
    heading: f64,
    target: &Target,
    control: &Control,
    guess: &Motion<f64>,
) -> Result<StartMotion, Unreached> {
    let search = Search::new(chassis, steer, ground, position, heading, target, control)?;
    check::finite("velocity along x of the guess", guess.velocity.x)?;
    check::finite("velocity along y of the guess", guess.velocity.y)?;
    check::finite("yaw rate of the guess", guess.yaw_rate)?;
    let turn = target.heading - heading;
    let turn = if target.turns_known { turn } else { principal_angle(turn) };
    match search.newton([guess.velocity.x, guess.velocity.y, guess.yaw_rate], turn) {
        Ok(found) if found.size() <= REACHED * control.tolerance => Ok(search.departure(&found)),
        _ => search.run()?.first().copied().ok_or(Unreached::NoWay),
    }
}

struct Search<'a> {
    chassis: &'a Chassis,
    bundled: Chassis<Bundle<4>>,
    steer: Steer<'a, f64>,
    ground: &'a Ground<'a, f64>,
    position: Vector2<f64>,
    heading: f64,
    target: &'a Target,
    control: &'a Control,
    coarse: Control,
    /// Whether slopes are exact, and cycling steps are not cut short.
    patient: bool,
}

/// Derivatives of the miss with respect to v_x, v_y and ω: a column for each.
type Columns = [[f64; 3]; 3];

/// A motion tried.
#[derive(Clone, Copy)]
struct Try {
    /// (m/s, m/s, rad/s)
    w: [f64; 3],
    /// (m, m, m) miss of the rest along x, along y, and by the turn of the wheelbase.
    miss: [f64; 3],
    rest: Rest<f64>,
}

impl Try {
    fn size(&self) -> f64 {
        norm(self.miss)
    }
}

impl<'a> Search<'a> {
    fn new(
        chassis: &'a Chassis,
        steer: Steer<'a, f64>,
        ground: &'a Ground<'a, f64>,
        position: Vector2<f64>,
        heading: f64,
        target: &'a Target,
        control: &'a Control,
    ) -> Result<Self, InvalidInput> {
        check::finite("position along x at separation", position.x)?;
        check::finite("position along y at separation", position.y)?;
        check::angle("heading at separation", heading)?;
        check::finite("rest position along x", target.position.x)?;
        check::finite("rest position along y", target.position.y)?;
        check::angle("heading at rest", target.heading)?;
        steer.check()?;
        ground.check()?;
        let coarse = Control {
            tolerance: Real::max(control.tolerance, 3e-3),
            most_steps: control.most_steps.min(MOST_COARSE_STEPS),
            ..*control
        };
        Ok(Self {
            chassis,
            bundled: chassis.constant(),
            steer,
            ground,
            position,
            heading,
            target,
            control,
            coarse,
            patient: false,
        })
    }

    /// Finds all starts. If the rest is missed, the search is repeated with exact slopes: misses are rare,
    /// and it is chance where Newton's method ends among the jumps.
    fn run(mut self) -> Result<Starts, Unreached> {
        let first = self.search();
        let Err(Unreached::Missed { miss: least, .. }) = first else { return first };
        self.patient = true;
        match self.search() {
            Ok(starts) => Ok(starts),
            nearer @ Err(Unreached::Missed { miss, .. }) if miss < least => nearer,
            Err(_) => first,
        }
    }

    fn search(&self) -> Result<Starts, Unreached> {
        let turn = self.target.heading - self.heading;
        let least = principal_angle(turn);
        let turns = if self.target.turns_known {
            [Some(turn), None, None, None]
        } else {
            // The turn the other way round, and one full turn more; of half a turn, which is the same either
            // way, one full turn more to both sides.
            let full = TAU.copysign(least);
            let is_half = PI - least.abs() < SAME_TURN;
            [Some(least), Some(least - full), Some(least + full), is_half.then_some(least - 2.0 * full)]
        };
        let way = self.target.position - self.position;
        if norm([way.x, way.y, least]) == 0.0 && !self.target.turns_known {
            return Err(Unreached::NoWay);
        }
        let mut starts = Starts { found: [None; MOST_STARTS] };
        let mut nearest: Option<Try> = None;
        let mut refusal = None;
        // The wider search is for rests without any start in the first.
        let wider = WIDER.into_iter().flat_map(|angle| WIDER_SHARES.map(|[v, omega]| [v, omega, angle]));
        let seeds = SEEDS.into_iter().map(|seed| (false, Some(seed)));
        // The approach by the closed form comes first.
        let all = [(false, None)].into_iter().chain(seeds).chain(wider.map(|seed| (true, Some(seed))));
        for turn in turns.into_iter().flatten() {
            for (wide, seed) in all.clone() {
                if wide && starts.first().is_some() {
                    break;
                }
                let tried = match seed {
                    Some(seed) => self.seed(way, turn, seed).map(|w| self.newton(w, turn)),
                    None if self.patient => None,
                    None => self.approach(way, turn).map(|near| self.newton_from(near, turn, APPROACHED)),
                };
                let Some(tried) = tried else { continue };
                match tried {
                    Ok(found) if found.size() <= REACHED * self.control.tolerance => {
                        starts.insert(self.departure(&found), self.chassis.body());
                        break;
                    }
                    Ok(missed) => {
                        if nearest.is_none_or(|nearest| missed.size() < nearest.size()) {
                            nearest = Some(missed);
                        }
                    }
                    Err(no_rest) => refusal = Some(no_rest),
                }
            }
        }
        if starts.first().is_some() {
            return Ok(starts);
        }
        match (nearest, refusal) {
            (Some(nearest), _) => {
                let StartMotion { motion, miss, rest, .. } = self.departure(&nearest);
                Err(Unreached::Missed { motion, position: rest.position, heading: rest.heading, miss })
            }
            (None, Some(no_rest)) => Err(Unreached::NeverRests(no_rest)),
            (None, None) => Err(Unreached::NoWay),
        }
    }

    /// Marquard's start, modified by the seed.
    fn seed(&self, way: Vector2<f64>, turn: f64, [speed, yaw_rate, angle]: [f64; 3]) -> Option<[f64; 3]> {
        let distance = root(way.x * way.x + way.y * way.y);
        let body = self.chassis.body();
        let spin = Spin {
            friction: self.ground.friction,
            distance,
            turn,
            yaw_radius: root(body.yaw_inertia() * body.inverse_mass()),
            wheelbase: self.chassis.wheelbase(),
        };
        let start = spin.start().ok()?;
        let scale = if distance > 0.0 { start.speed * speed / distance } else { 0.0 };
        let [x, y] = turned([way.x * scale, way.y * scale], angle);
        Some([x, y, start.yaw_rate * yaw_rate])
    }

    fn state<T: Real>(&self, w: [T; 3]) -> State<T> {
        State {
            position: Vector2::new(T::from(self.position.x), T::from(self.position.y)),
            heading: T::from(self.heading),
            motion: Motion { velocity: Vector2::new(w[0], w[1]), yaw_rate: w[2] },
        }
    }

    /// (m) miss of a rest from the target.
    fn miss<T: Real>(&self, rest: &Rest<T>, turn: f64) -> [T; 3] {
        let target = self.target.position;
        let turned = rest.heading - (self.heading + turn);
        [rest.position.x - target.x, rest.position.y - target.y, turned * self.chassis.wheelbase()]
    }

    fn attempt(&self, w: [f64; 3], turn: f64, control: &Control) -> Result<Try, NoRest> {
        let rest = to_rest(self.chassis, self.steer, self.ground, &self.state(w), control, |_| {})?;
        Ok(Try { w, miss: self.miss(&rest, turn), rest })
    }

    /// Tries a motion, with the derivatives of the miss with respect to it.
    fn with_slopes(&self, w: [f64; 3], turn: f64, control: &Control) -> Result<(Try, Columns), NoRest> {
        if self.patient { self.derived(w, turn, control) } else { self.differenced(w, turn, control) }
    }

    /// Exact slopes, by derivatives.
    fn derived(&self, w: [f64; 3], turn: f64, control: &Control) -> Result<(Try, Columns), NoRest> {
        let dual: Chassis<Duals<3>> = self.chassis.constant();
        let [x, y, omega] = [0, 1, 2].map(|i| Duals::variable(w[i], i));
        let rest = follow(&dual, self.steer, self.ground, &self.state([x, y, omega]), control, |_| {})?;
        let miss = self.miss(&rest, turn);
        let columns = [0, 1, 2].map(|i| miss.map(|miss| miss.derivatives[i]));
        Ok((Try { w, miss: miss.map(Real::value), rest: rest.values() }, columns))
    }

    /// Slopes by differences from motions so near that they take the same steps, in a third of the time.
    fn differenced(&self, w: [f64; 3], turn: f64, control: &Control) -> Result<(Try, Columns), NoRest> {
        let apart = NEAR * norm(w);
        let [x, y, omega] = [0, 1, 2].map(|i| {
            let mut lanes = [w[i]; 4];
            lanes[i + 1] += apart;
            Bundle { lanes }
        });
        let rest =
            follow(&self.bundled, self.steer, self.ground, &self.state([x, y, omega]), control, |_| {})?;
        let miss = self.miss(&rest, turn);
        let columns = [1, 2, 3].map(|lane| miss.map(|Bundle { lanes }| (lanes[lane] - lanes[0]) / apart));
        Ok((Try { w, miss: miss.map(Real::value), rest: rest.values() }, columns))
    }

    /// A motion that comes near the rest, if Marquard's closed form leads to one.
    ///
    /// Its error is much the same for similar motions. So its inputs, path and turn, are corrected by the
    /// miss of the rest: at first as if the miss followed the inputs one to one, then by the effect of
    /// earlier corrections (Broyden). No derivatives are needed.
    fn approach(&self, way: Vector2<f64>, turn: f64) -> Option<Try> {
        let square = way.x * way.x + way.y * way.y;
        // ln of the distance relative to that of the rest, angle (rad) from the direct path, turn (rad).
        let mut told = [0.0, 0.0, turn];
        let mut columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let mut before: Option<([f64; 3], [f64; 3])> = None;
        let mut nearest: Option<Try> = None;
        for _ in 0..MOST_APPROACHES {
            let scale = elementary::exp(told[0]);
            let [x, y] = turned([way.x * scale, way.y * scale], told[1]);
            let Some(w) = self.seed(Vector2::new(x, y), told[2], SEEDS[0]) else { break };
            let Ok(here) = self.attempt(w, turn, &self.coarse) else { break };
            if nearest.is_none_or(|nearest| here.size() < nearest.size()) {
                nearest = Some(here);
            }
            if here.size() <= APPROACHED {
                break;
            }
            let gone = Vector2::new(way.x + here.miss[0], way.y + here.miss[1]);
            let (along, across) = (way.x * gone.x + way.y * gone.y, way.x * gone.y - way.y * gone.x);
            let distance = 0.5 * elementary::ln((gone.x * gone.x + gone.y * gone.y) / square);
            let angle = elementary::atan2(across, along);
            let off = [distance, angle, here.miss[2] / self.chassis.wheelbase()];
            if let Some((step, off_before)) = before {
                columns = updated(columns, step, [0, 1, 2].map(|i| off[i] - off_before[i]));
            }
            let Some(step) = solve(columns, off) else { break };
            let most = step.iter().fold(0.0, |most, step| Real::max(most, step.abs()));
            let step = step.map(|step| step * Real::min(1.0, LONGEST_CHANGE / most));
            told = [0, 1, 2].map(|i| told[i] + step[i]);
            before = Some((step, off));
        }
        nearest.filter(|nearest| nearest.size() <= LED)
    }

    /// Newton's method from a motion; returns the motion that comes nearest.
    fn newton(&self, w: [f64; 3], turn: f64) -> Result<Try, NoRest> {
        self.newton_from(self.attempt(w, turn, &self.coarse)?, turn, COARSE)
    }

    /// The same from a motion already tried coarsely, with coarse steps until its rest misses by `enough`
    /// (m).
    fn newton_from(&self, from: Try, turn: f64, enough: f64) -> Result<Try, NoRest> {
        let near = self.damped(from, turn, &self.coarse, enough)?;
        let (here, columns) = self.with_slopes(near.w, turn, self.control)?;
        let here = self.settled(here, columns, turn);
        if here.size() <= REACHED * self.control.tolerance {
            return Ok(here);
        }
        let here = self.damped(here, turn, self.control, FINE)?;
        if here.size() <= FINE {
            return Ok(here);
        }
        let (here, columns) = self.with_slopes(here.w, turn, self.control)?;
        Ok(self.settled(here, columns, turn))
    }

    /// Newton's method with damped steps that reduce the miss, until it is at most `enough` (m).
    fn damped(&self, from: Try, turn: f64, control: &Control, enough: f64) -> Result<Try, NoRest> {
        let mut here = from;
        let mut known: Option<Columns> = None;
        for _ in 0..MOST_ROUNDS {
            if here.size() <= enough {
                break;
            }
            let (columns, fresh) = match known {
                Some(columns) => (columns, false),
                None => (self.with_slopes(here.w, turn, control)?.1, true),
            };
            let step = solve(columns, here.miss).map(|step| self.bounded(step, here.w));
            known = match step.and_then(|step| self.descend(&here, step, turn, control)) {
                Some((next, factor)) => {
                    let step = [0, 1, 2].map(|i| next.w[i] - here.w[i]);
                    let shrunk = next.size() <= 0.2 * here.size() && factor >= 1.0;
                    let change = [0, 1, 2].map(|i| next.miss[i] - here.miss[i]);
                    here = next;
                    shrunk.then(|| updated(columns, step, change))
                }
                None if fresh => break,
                None => None,
            };
        }
        Ok(here)
    }

    /// The best of several full steps from a motion that is nearly there. When the integration chooses other
    /// steps, the rest jumps by some tolerances, and the path to the motion sought may pass through a greater
    /// miss. It ends when a step has met a jump and the best rest is accepted, or when the steps return to
    /// where one began and so cycle between jumps.
    fn settled(&self, from: Try, mut columns: Columns, turn: f64) -> Try {
        let (mut here, mut best) = (from, from);
        let mut past = [[f64::INFINITY; 3]; LONGEST_ROUND];
        let (mut stalls, mut renew) = (0, false);
        while best.size() > FINE && stalls <= MOST_JUMPS {
            let Some(step) = solve(columns, here.miss).map(|step| self.bounded(step, here.w)) else { break };
            let w = [0, 1, 2].map(|i| here.w[i] + step[i]);
            let tried = if renew {
                self.with_slopes(w, turn, self.control).map(|(next, fresh)| {
                    columns = fresh;
                    next
                })
            } else {
                self.attempt(w, turn, self.control)
            };
            let Ok(next) = tried else { break };
            if next.size() > FAR * COARSE {
                break;
            }
            // With the same number of integration steps the rest changed smoothly and gives the slope.
            let no_jump = next.size() <= 0.3 * here.size() || next.rest.steps == here.rest.steps;
            if no_jump && !renew {
                columns = updated(columns, step, [0, 1, 2].map(|i| next.miss[i] - here.miss[i]));
            }
            let stalled = next.size() > 0.7 * best.size();
            stalls += usize::from(stalled);
            renew = stalled && RENEWED.contains(&stalls);
            past.rotate_right(1);
            past[0] = here.w;
            here = next;
            if here.size() < best.size() {
                best = here;
            }
            let back = past[1..].iter().any(|w| distance(*w, here.w) < BACK * norm(step));
            let settled = stalls > 0 && best.size() <= SETTLED * self.control.tolerance;
            let round = stalls > 1 && stalled && back;
            if (settled || round) && !self.patient {
                break;
            }
        }
        best
    }

    /// Limits a step to half of the motion.
    fn bounded(&self, step: [f64; 3], w: [f64; 3]) -> [f64; 3] {
        let lever = self.chassis.wheelbase() / 2.0;
        let size = |[x, y, omega]: [f64; 3]| norm([x, y, omega * lever]);
        let most = 0.5 * size(w);
        let factor = Real::min(1.0, most / size(step));
        step.map(|step| step * factor)
    }

    /// A motion along a step that misses by less, and its fraction of the step.
    fn descend(&self, here: &Try, step: [f64; 3], turn: f64, control: &Control) -> Option<(Try, f64)> {
        let mut factor = 1.0;
        for _ in 0..6 {
            let w = [0, 1, 2].map(|i| here.w[i] + step[i] * factor);
            if let Ok(next) = self.attempt(w, turn, control)
                && next.size() < here.size()
            {
                return Some((next, factor));
            }
            factor *= 0.4;
        }
        None
    }

    fn departure(&self, found: &Try) -> StartMotion {
        let [vx, vy, yaw_rate] = found.w;
        StartMotion {
            motion: Motion { velocity: Vector2::new(vx, vy), yaw_rate },
            turn: found.rest.heading - self.heading,
            miss: found.size(),
            via_miss: self.target.via.map(|point| self.passes(found.w, point)),
            rest: found.rest,
        }
    }

    /// (m) distance of a path from a point.
    fn passes(&self, w: [f64; 3], point: Vector2<f64>) -> f64 {
        let mut least = f64::INFINITY;
        let mut before: Option<Vector2<f64>> = None;
        let fine = Control { longest_step: 0.1, ..*self.control };
        let mut look = |place: Vector2<f64>| {
            let from = before.replace(place).unwrap_or(place);
            let side = place - from;
            let square = side.x * side.x + side.y * side.y;
            let along = (point.x - from.x) * side.x + (point.y - from.y) * side.y;
            let share = if square > 0.0 { (along / square).clamp(0.0, 1.0) } else { 0.0 };
            let off = from + side * share - point;
            least = Real::min(least, root(off.x * off.x + off.y * off.y));
        };
        let follows = to_rest(self.chassis, self.steer, self.ground, &self.state(w), &fine, |sample| {
            look(sample.state.position);
        });
        if let Ok(rest) = follows {
            look(rest.position);
        }
        least
    }
}

fn norm([x, y, z]: [f64; 3]) -> f64 {
    root(x * x + y * y + z * z)
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    norm([a[0] - b[0], a[1] - b[1], a[2] - b[2]])
}

/// A vector turned by an angle (rad).
fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = elementary::sin_cos(angle);
    [x * cos - y * sin, x * sin + y * cos]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Newton's step: columns · step = −miss (Cramer), or `None` if the columns lie in a plane.
fn solve([a, b, c]: Columns, miss: [f64; 3]) -> Option<[f64; 3]> {
    let determinant = dot(a, cross(b, c));
    let step =
        [dot(miss, cross(b, c)), dot(a, cross(miss, c)), dot(a, cross(b, miss))].map(|d| -d / determinant);
    step.iter().all(|step| step.is_finite()).then_some(step)
}

/// Broyden's update: the least change of the matrix that maps the step to the change of the miss.
fn updated(columns: Columns, step: [f64; 3], change: [f64; 3]) -> Columns {
    let square = dot(step, step);
    if square == 0.0 {
        return columns;
    }
    // J ← J + (Δf − J Δx) Δxᵀ/|Δx|²
    let off = [0, 1, 2].map(|i| {
        let predicted = columns[0][i] * step[0] + columns[1][i] * step[1] + columns[2][i] * step[2];
        (change[i] - predicted) / square
    });
    [0, 1, 2].map(|j| [0, 1, 2].map(|i| columns[j][i] + off[i] * step[j]))
}

#[cfg(test)]
mod tests {
    use super::{APPROACHED, Chassis, Control, Ground, Search, Steer, Target, Vector2, to_rest};
    use crate::{Axles, Body, Motion, State};

    fn chassis(drag: f64) -> Chassis {
        let axles = Axles { cg_to_front: 1.2, cg_to_rear: 1.45, track: 1.5 };
        Chassis::new(Body::new(1500.0, 2500.0).unwrap(), axles, [drag; 4]).unwrap()
    }

    /// Passes on a search back from each of several rests, with its start, and the path and the turn to the
    /// rest.
    fn searches(mut each: impl FnMut(&Search<'_>, [f64; 3], Vector2<f64>, f64)) {
        let (ground, control) = (Ground::level(0.7), Control::default());
        let (position, heading) = (Vector2::new(1.0, -2.0), 0.4);
        for drag in [0.08, 0.2, 0.5] {
            for (vx, vy, yaw_rate) in
                [(9.0, 4.0, 2.5), (-6.0, 7.0, -3.0), (3.0, -8.0, 1.5), (-5.0, -5.0, 4.0)]
            {
                let chassis = chassis(drag);
                let motion = Motion { velocity: Vector2::new(vx, vy), yaw_rate };
                let start = State { position, heading, motion };
                let rest = to_rest(&chassis, Steer::straight(), &ground, &start, &control, |_| {}).unwrap();
                let target =
                    Target { position: rest.position, heading: rest.heading, turns_known: true, via: None };
                let search =
                    Search::new(&chassis, Steer::straight(), &ground, position, heading, &target, &control)
                        .unwrap();
                each(&search, [vx, vy, yaw_rate], rest.position - position, rest.heading - heading);
            }
        }
    }

    /// The motion that led to the rest has no miss, and differences agree with derivatives.
    #[test]
    fn slopes_are_derivatives() {
        searches(|search, w, _, turn| {
            let (here, near) = search.differenced(w, turn, search.control).unwrap();
            let (there, exact) = search.derived(w, turn, search.control).unwrap();
            assert_eq!((here.miss, here.rest), (there.miss, there.rest));
            assert!(here.size() < 1e-12, "{:?}", here.miss);
            for (near, exact) in near.as_flattened().iter().zip(exact.as_flattened()) {
                assert!((near - exact).abs() < 2e-4 * (1.0 + exact.abs()), "{near} {exact}");
            }
        });
    }

    /// The approach comes as near as required for at least four rests in five.
    #[test]
    fn the_closed_form_leads_near() {
        let (mut reached, mut all) = (0, 0);
        searches(|search, _, way, turn| {
            all += 1;
            reached += usize::from(search.approach(way, turn).is_some_and(|near| near.size() <= APPROACHED));
        });
        assert!(reached * 5 >= all * 4, "{reached} of {all}");
    }
}
