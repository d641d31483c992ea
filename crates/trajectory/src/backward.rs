//! From rest back to the motion after the impact.

use core::f64::consts::TAU;

use pim_core::{InvalidInput, Motion, Vector2};
use real::{Duals, Real, elementary, principal_angle};

use crate::chassis::Chassis;
use crate::check;
use crate::closed::Spin;
use crate::error::NoRest;
use crate::field::root;
use crate::forward::{follow, to_rest};
use crate::ground::Ground;
use crate::state::{Control, Rest, State};
use crate::steer::Steer;

/// Most starts that are told apart.
pub const MOST_STARTS: usize = 8;

/// A rest within as many tolerances of a step, in place and by the turn of the wheelbase, counts as reached:
/// the integration knows it no better, and jumps by as much where it chooses another step.
pub const REACHED: f64 = 10.0;

/// (m) where Newton's method stops, far below what counts, so that starts do not differ by where it stopped.
const FINE: f64 = 1e-9;

/// (m) down to here the search contents itself with a coarse integration.
const COARSE: f64 = 0.05;

/// Two starts nearer to each other than this share of their speed are one.
const SAME: f64 = 1e-4;

/// Rounds of Newton's method, of which a good seed needs five to ten.
const MOST_ROUNDS: usize = 15;

/// Full steps near the rest that may end beyond a jump.
const MOST_JUMPS: usize = 8;

/// Jumps after which the derivatives are computed anew.
const RENEWED: [usize; 2] = [1, 5];

/// Full steps lead astray where they miss by this many times [`COARSE`].
const FAR: f64 = 20.0;

/// Steps after which a coarse integration is given up: it takes some fifty.
const MOST_COARSE_STEPS: u32 = 2000;

/// Where the search begins: shares of Marquard's speed and yaw rate, and an angle (rad) from the direct way.
///
/// A vehicle that rolls out was slower than in his two phases, and went off to the side where its wheels
/// caught.
const SEEDS: [[f64; 3]; 7] = [
    [1.0, 1.0, 0.0],
    [0.8, 1.4, 0.0],
    [0.6, 0.8, 0.0],
    [0.9, 1.0, 0.4],
    [0.9, 1.0, -0.4],
    [0.6, 2.0, 0.8],
    [0.6, 2.0, -0.8],
];

/// Angles (rad) of the wider search, and its shares of Marquard's speed and yaw rate.
const WIDER: [f64; 7] = [0.0, 0.25, -0.25, 0.6, -0.6, 1.2, -1.2];
const WIDER_SHARES: [[f64; 2]; 6] = [[1.0, 1.5], [0.8, 0.5], [1.2, 1.0], [0.5, 1.0], [0.5, 3.0], [1.4, 2.0]];

/// Where the vehicle came to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Target {
    /// (m) place of the CG in the scene.
    pub position: Vector2<f64>,
    /// (rad) heading in the scene.
    pub heading: f64,
    /// Whether full turns on the way are known, and `heading` counts them on from the heading at separation.
    /// Without, all starts whose headings at rest differ from it by full turns are sought, up to one and a
    /// half revolutions.
    pub turns_known: bool,
    /// (m) a point that the CG passed on its way, such as the end of a mark; it orders the starts.
    pub via: Option<Vector2<f64>>,
}

/// One motion after the impact that leads to the rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departure {
    /// Velocity and yaw rate at separation.
    pub motion: Motion<f64>,
    /// (rad) how far the vehicle turns on its way.
    pub turn: f64,
    /// (m) what its rest misses the target by: in place, and by the turn of the wheelbase.
    pub miss: f64,
    /// (m) how far its path passes from the point of the target.
    pub via_miss: Option<f64>,
    /// Its rest.
    pub rest: Rest<f64>,
}

/// The starts that lead to a rest, the likeliest first: nearest to the point on the path where one is given,
/// then with the least turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Starts {
    found: [Option<Departure>; MOST_STARTS],
}

impl Starts {
    /// The likeliest.
    #[must_use]
    pub fn first(&self) -> Option<&Departure> {
        self.iter().next()
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &Departure> {
        self.found.iter().flatten()
    }

    /// Puts one in its place, unless it is there already or the list is full of likelier ones.
    fn insert(&mut self, departure: Departure) {
        if self.iter().any(|other| same(&other.motion, &departure.motion)) {
            return;
        }
        let rank = |departure: &Departure| [departure.via_miss.unwrap_or(0.0), departure.turn.abs()];
        let mut carried = Some(departure);
        for place in &mut self.found {
            let later = match (&carried, &*place) {
                (Some(new), Some(old)) => rank(new) < rank(old),
                (new, None) => new.is_some(),
                (None, _) => false,
            };
            if later {
                core::mem::swap(place, &mut carried);
            }
        }
    }
}

/// Whether two motions are the same but for where the search stopped.
fn same(a: &Motion, b: &Motion) -> bool {
    let (dv, speed) = (a.velocity - b.velocity, a.velocity.x.abs() + a.velocity.y.abs() + a.yaw_rate.abs());
    dv.x.abs() + dv.y.abs() + (a.yaw_rate - b.yaw_rate).abs() <= SAME * speed
}

/// Why no motion leads to the rest.
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
    /// The nearest motion misses.
    #[error(
        "no motion after the impact leads to this rest: the nearest, at {:.3} m/s and {:.3} rad/s, comes to rest \
         {:.3} m from it; check the rest, the drag of the wheels, the friction and the steer",
        speed(.motion), .motion.yaw_rate, .miss
    )]
    Missed {
        /// What comes nearest.
        motion: Motion<f64>,
        /// (m) where it comes to rest.
        position: Vector2<f64>,
        /// (rad) and with which heading.
        heading: f64,
        /// (m) what that misses by, in place and by the turn of the wheelbase.
        miss: f64,
    },
}

/// (m/s) speed of the CG.
fn speed(motion: &Motion) -> f64 {
    let v = motion.velocity;
    root(v.x * v.x + v.y * v.y)
}

/// Finds every motion after the impact that brings a vehicle from where the vehicles separated, at `position`
/// (m) with `heading` (rad), to the rest of `target`.
///
/// It solves [`to_rest`] for velocity and yaw rate by Newton's method, with the derivatives that dual numbers
/// carry through the integration, from Marquard's closed form and around it. Several motions lead to most
/// rests: with a turn the short way and the long way round, and once more.
///
/// # Errors
/// [`Unreached::Missed`] where none is found, with the nearest.
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

/// Finds one motion that leads to the rest of `target`, the one near to a `guess`: for a rest that differs
/// little from one whose start is known, as in samples of uncertain inputs. It takes one run of Newton's
/// method from the guess; only where that fails it searches as [`to_start`] does, and takes the likeliest.
///
/// The heading of the target should count full turns, so that the motion turns by as much as the guess does.
///
/// # Errors
/// [`Unreached::Missed`] where none is found, with the nearest.
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
) -> Result<Departure, Unreached> {
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
    dual: Chassis<Duals<3>>,
    steer: Steer<'a, f64>,
    ground: &'a Ground<'a, f64>,
    position: Vector2<f64>,
    heading: f64,
    target: &'a Target,
    control: &'a Control,
    coarse: Control,
}

/// A motion that was tried.
#[derive(Clone, Copy)]
struct Try {
    /// (m/s, m/s, rad/s)
    w: [f64; 3],
    /// (m, m, m) what the rest misses along x, along y, and by the turn of the wheelbase.
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
            dual: chassis.constant(),
            steer,
            ground,
            position,
            heading,
            target,
            control,
            coarse,
        })
    }

    fn run(&self) -> Result<Starts, Unreached> {
        let turn = self.target.heading - self.heading;
        let least = principal_angle(turn);
        let turns = if self.target.turns_known {
            [Some(turn), None, None]
        } else {
            // The other way round, and once more round.
            let other = least - TAU.copysign(least);
            [Some(least), Some(other), Some(least + TAU.copysign(least))]
        };
        let way = self.target.position - self.position;
        if norm([way.x, way.y, least]) == 0.0 && !self.target.turns_known {
            return Err(Unreached::NoWay);
        }
        let mut starts = Starts { found: [None; MOST_STARTS] };
        let mut nearest: Option<Try> = None;
        let mut refusal = None;
        // The wider search is for rests that the first does not find at all.
        let wider = WIDER.into_iter().flat_map(|angle| WIDER_SHARES.map(|[v, omega]| [v, omega, angle]));
        let all = SEEDS.into_iter().map(|seed| (false, seed)).chain(wider.map(|seed| (true, seed)));
        for turn in turns.into_iter().flatten() {
            for (wide, seed) in all.clone() {
                if wide && starts.first().is_some() {
                    break;
                }
                let Some(w) = self.seed(way, turn, seed) else { continue };
                match self.newton(w, turn) {
                    Ok(found) if found.size() <= REACHED * self.control.tolerance => {
                        starts.insert(self.departure(&found));
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
                let Departure { motion, miss, rest, .. } = self.departure(&nearest);
                Err(Unreached::Missed { motion, position: rest.position, heading: rest.heading, miss })
            }
            (None, Some(no_rest)) => Err(Unreached::NeverRests(no_rest)),
            (None, None) => Err(Unreached::NoWay),
        }
    }

    /// Marquard's start, changed as the seed says.
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
        let (sin, cos) = elementary::sin_cos(angle);
        let scale = if distance > 0.0 { start.speed * speed / distance } else { 0.0 };
        let (x, y) = (way.x * scale, way.y * scale);
        Some([x * cos - y * sin, x * sin + y * cos, start.yaw_rate * yaw_rate])
    }

    fn state<T: Real>(&self, w: [T; 3]) -> State<T> {
        State {
            position: Vector2::new(T::from(self.position.x), T::from(self.position.y)),
            heading: T::from(self.heading),
            motion: Motion { velocity: Vector2::new(w[0], w[1]), yaw_rate: w[2] },
        }
    }

    /// (m) by how much a rest misses the target.
    fn miss<T: Real>(&self, rest: &Rest<T>, turn: f64) -> [T; 3] {
        let target = self.target.position;
        let turned = rest.heading - (self.heading + turn);
        [rest.position.x - target.x, rest.position.y - target.y, turned * self.chassis.wheelbase()]
    }

    fn attempt(&self, w: [f64; 3], turn: f64, control: &Control) -> Result<Try, NoRest> {
        let rest = to_rest(self.chassis, self.steer, self.ground, &self.state(w), control, |_| {})?;
        Ok(Try { w, miss: self.miss(&rest, turn), rest })
    }

    /// How the miss changes with the motion: a column for each of v_x, v_y, ω.
    fn derivatives(&self, w: [f64; 3], turn: f64, control: &Control) -> Result<[[f64; 3]; 3], NoRest> {
        let [x, y, omega] = [0, 1, 2].map(|i| Duals::variable(w[i], i));
        let rest = follow(&self.dual, self.steer, self.ground, &self.state([x, y, omega]), control, |_| {})?;
        let [a, b, c] = self.miss(&rest, turn).map(|miss| miss.derivatives);
        Ok([0, 1, 2].map(|i| [a[i], b[i], c[i]]))
    }

    /// Newton's method from a motion. The motion that comes nearest.
    fn newton(&self, w: [f64; 3], turn: f64) -> Result<Try, NoRest> {
        let (near, columns) =
            self.damped(self.attempt(w, turn, &self.coarse)?, turn, &self.coarse, COARSE)?;
        let here = self.attempt(near.w, turn, self.control)?;
        let here = self.settled(here, columns, turn);
        if here.size() <= REACHED * self.control.tolerance {
            return Ok(here);
        }
        let (here, columns) = self.damped(here, turn, self.control, FINE)?;
        Ok(self.settled(here, columns, turn))
    }

    /// Newton's method with steps that miss less and less, until the rest misses by `enough` (m).
    fn damped(
        &self,
        from: Try,
        turn: f64,
        control: &Control,
        enough: f64,
    ) -> Result<(Try, [[f64; 3]; 3]), NoRest> {
        let mut here = from;
        let mut columns = self.derivatives(here.w, turn, control)?;
        let mut fresh = true;
        for _ in 0..MOST_ROUNDS {
            if here.size() <= enough {
                break;
            }
            let step = solve(columns, here.miss).map(|step| self.bounded(step, here.w));
            match step.and_then(|step| self.descend(&here, step, turn, control)) {
                Some((next, factor)) => {
                    let step = [0, 1, 2].map(|i| next.w[i] - here.w[i]);
                    let shrunk = next.size() <= 0.2 * here.size() && factor >= 1.0;
                    columns = updated(columns, step, [0, 1, 2].map(|i| next.miss[i] - here.miss[i]));
                    here = next;
                    fresh = false;
                    if !shrunk && here.size() > enough {
                        columns = self.derivatives(here.w, turn, control)?;
                        fresh = true;
                    }
                }
                None if fresh => break,
                None => {
                    columns = self.derivatives(here.w, turn, control)?;
                    fresh = true;
                }
            }
        }
        Ok((here, columns))
    }

    /// The nearest of some full steps from a motion that is nearly there. Where the integration chooses other
    /// steps, the rest jumps by some tolerances, and the way to the motion sought may lead over a greater
    /// miss.
    fn settled(&self, from: Try, mut columns: [[f64; 3]; 3], turn: f64) -> Try {
        let (mut here, mut best) = (from, from);
        let mut stalls = 0;
        while best.size() > FINE && stalls <= MOST_JUMPS {
            let Some(step) = solve(columns, here.miss).map(|step| self.bounded(step, here.w)) else { break };
            let w = [0, 1, 2].map(|i| here.w[i] + step[i]);
            let Ok(next) = self.attempt(w, turn, self.control) else { break };
            if next.size() > FAR * COARSE {
                break;
            }
            if next.size() <= 0.3 * here.size() {
                columns = updated(columns, step, [0, 1, 2].map(|i| next.miss[i] - here.miss[i]));
            } else {
                stalls += 1;
                if RENEWED.contains(&stalls) {
                    let Ok(fresh) = self.derivatives(next.w, turn, self.control) else { break };
                    columns = fresh;
                }
            }
            here = next;
            if here.size() < best.size() {
                best = here;
            }
        }
        best
    }

    /// A step that changes the motion by half of itself at most.
    fn bounded(&self, step: [f64; 3], w: [f64; 3]) -> [f64; 3] {
        let lever = self.chassis.wheelbase() / 2.0;
        let size = |[x, y, omega]: [f64; 3]| norm([x, y, omega * lever]);
        let most = 0.5 * size(w);
        let factor = Real::min(1.0, most / size(step));
        step.map(|step| step * factor)
    }

    /// The motion on the way of a step that misses less, and its share of the step.
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

    fn departure(&self, found: &Try) -> Departure {
        let [vx, vy, yaw_rate] = found.w;
        Departure {
            motion: Motion { velocity: Vector2::new(vx, vy), yaw_rate },
            turn: found.rest.heading - self.heading,
            miss: found.size(),
            via_miss: self.target.via.map(|point| self.passes(found.w, point)),
            rest: found.rest,
        }
    }

    /// (m) how near a path passes to a point.
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

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Newton's step: columns · step = −miss (Cramer), or nothing where the columns lie in a plane.
fn solve([a, b, c]: [[f64; 3]; 3], miss: [f64; 3]) -> Option<[f64; 3]> {
    let determinant = dot(a, cross(b, c));
    let step =
        [dot(miss, cross(b, c)), dot(a, cross(miss, c)), dot(a, cross(b, miss))].map(|d| -d / determinant);
    step.iter().all(|step| step.is_finite()).then_some(step)
}

/// Broyden's update: the least change of the matrix that maps the step to the change of the miss.
fn updated(columns: [[f64; 3]; 3], step: [f64; 3], change: [f64; 3]) -> [[f64; 3]; 3] {
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
