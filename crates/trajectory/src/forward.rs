//! From the impact to rest.

use pim_core::{InvalidInput, Motion, Vector2};
use real::{Real, elementary};

use crate::chassis::Chassis;
use crate::check;
use crate::error::NoRest;
use crate::field::{Acceleration, Field, GRAVITY, root};
use crate::ground::{Edge, Ground};
use crate::state::{Control, EnergyBalance, Rest, Sample, State, cubic};
use crate::steer::Steer;
use crate::step::{Phase, Start, Steering, Step, step};

/// (m) wheels are asked for their zone at least as often on their way.
const LOOKOUT: f64 = 0.25;

/// Share of the time to rest, if the forces stayed as they are, that a step may take.
const SHARE_OF_THE_REST: f64 = 0.8;

/// Follows a vehicle from its `start` to rest, and hands a [`Sample`] at the start, after each step and at
/// rest to `record`.
///
/// The last part, in which the motion only fades without changing its direction, is one step with the closed
/// form: a straight slide on one ground takes no other, and is exact.
///
/// # Errors
/// [`NoRest::Invalid`] where a number is impossible; the others where the vehicle does not come to rest.
pub fn to_rest<T: Real>(
    chassis: &Chassis<T>,
    steer: Steer<'_, T>,
    ground: &Ground<'_, T>,
    start: &State<T>,
    control: &Control,
    record: impl FnMut(&Sample<T>),
) -> Result<Rest<T>, NoRest> {
    follow::<T, T>(chassis, steer, ground, start, control, record)
}

/// [`to_rest`] over a ground and with a steering whose numbers may carry less than those of the motion.
pub(crate) fn follow<T: Real + From<G>, G: Real>(
    chassis: &Chassis<T>,
    steer: Steer<'_, G>,
    ground: &Ground<'_, G>,
    start: &State<T>,
    control: &Control,
    mut record: impl FnMut(&Sample<T>),
) -> Result<Rest<T>, NoRest> {
    check_start(start, control)?;
    steer.check()?;
    ground.check()?;
    let Motion { velocity, yaw_rate } = start.motion;
    let mut run = Run {
        chassis,
        ground,
        steer,
        steering: Steering::new(steer),
        control,
        field: Field::new(chassis, ground),
        zones: [0; 4],
        phase: Phase {
            q: [start.position.x, start.position.y, start.heading],
            w: [velocity.x, velocity.y, yaw_rate],
        },
        time: T::ZERO,
        distance: T::ZERO,
        work: T::ZERO,
        steps: 0,
    };
    run.find_zones();
    let energy = run.field.energy(run.phase.w);
    // A first guess, which the first error corrects.
    let mut h = 0.05;
    while run.steps < control.most_steps {
        let acceleration = run.acceleration();
        record(&run.sample(acceleration.sliding));
        // A vehicle that hardly anything holds back fades for hours.
        let fading = run.fading(&acceleration);
        if fading.is_some_and(|time| (run.time + time).value() > control.longest_time) {
            return Err(NoRest::StillMoving { time: run.time.value(), state: run.state().values() });
        }
        if let Some(time) = fading {
            run.fade(&acceleration, time);
            run.holds()?;
            record(&run.sample([false; 4]));
            return Ok(run.rest(start, energy));
        }
        if run.time.value() >= control.longest_time {
            return Err(NoRest::StillMoving { time: run.time.value(), state: run.state().values() });
        }
        h = run.advance(acceleration, h);
    }
    Err(NoRest::TooManySteps { steps: run.steps, time: run.time.value(), state: run.state().values() })
}

fn check_start<T: Real>(start: &State<T>, control: &Control) -> Result<(), InvalidInput> {
    check::finite("position along x at the start", start.position.x.value())?;
    check::finite("position along y at the start", start.position.y.value())?;
    check::angle("heading at the start", start.heading.value())?;
    check::finite("velocity along x at the start", start.motion.velocity.x.value())?;
    check::finite("velocity along y at the start", start.motion.velocity.y.value())?;
    check::finite("yaw rate at the start", start.motion.yaw_rate.value())?;
    check::positive("tolerance", control.tolerance)?;
    check::positive("longest time", control.longest_time)?;
    check::positive("longest step", control.longest_step)
}

/// A motion under way.
struct Run<'a, T, G> {
    chassis: &'a Chassis<T>,
    ground: &'a Ground<'a, G>,
    steer: Steer<'a, G>,
    steering: Steering<'a, T, G>,
    control: &'a Control,
    field: Field<T>,
    /// The zone under each wheel.
    zones: [usize; 4],
    phase: Phase<T>,
    time: T,
    distance: T,
    /// (J/kg) work of the tyres' forces so far, negative.
    work: T,
    steps: u32,
}

impl<T: Real + From<G>, G: Real> Run<'_, T, G> {
    fn acceleration(&self) -> Acceleration<T> {
        self.field.acceleration(self.phase.q[2].sin_cos(), self.phase.w, self.steering.at(self.time))
    }

    fn state(&self) -> State<T> {
        let ([x, y, heading], [vx, vy, yaw_rate]) = (self.phase.q, self.phase.w);
        let motion = Motion { velocity: Vector2::new(vx, vy), yaw_rate };
        State { position: Vector2::new(x, y), heading, motion }
    }

    fn sample(&self, sliding: [bool; 4]) -> Sample<T> {
        Sample {
            time: self.time,
            distance: self.distance,
            state: self.state(),
            sliding,
            friction: self.field.friction(),
        }
    }

    /// (s) how long the vehicle needs to rest, where the forces only shorten its motion from here on.
    fn fading(&self, acceleration: &Acceleration<T>) -> Option<T> {
        let w = self.phase.w;
        let energy = self.field.energy(w);
        if energy.value() == 0.0 {
            return Some(T::ZERO);
        }
        let power = self.field.product(acceleration.rates, w);
        if power.value() >= 0.0 {
            return None;
        }
        // t = 2T/|P|
        let time = -(energy / power);
        let t = time.value();
        // What turns the motion: a⊥ = a − (a·w/w²) w
        let along = (power / energy).value();
        let [ax, ay, alpha] = [0, 1, 2].map(|i| acceleration.rates[i].value() - along * w[i].value());
        let [vx, vy, omega] = w.map(Real::value);
        let lever = self.lever();
        let (across, turning) = (root(ax * ax + ay * ay), alpha.abs() * lever);
        let (way, turn) = (root(vx * vx + vy * vy) * t / 2.0, omega.abs() * t / 2.0);
        let [bx, by, _] = acceleration.rates.map(Real::value);
        let strength = root(bx * bx + by * by);
        // The forces turn with the vehicle, which a pure spin has none to feel.
        let carried = if way == 0.0 { 0.0 } else { strength * turn };
        let miss = Real::max(across + carried, turning) * t * t / 2.0;
        let rounding = 1e-13 * (strength + GRAVITY) * t * t;
        let short = Real::max(way, turn * lever) < 0.3;
        let straight = miss <= rounding || (short && miss <= self.control.tolerance / 4.0);
        let negligible = Real::max(way, turn * lever) < self.control.tolerance / 10.0;
        (((straight && self.control.closed_end) || negligible) && self.stays(time)).then_some(time)
    }

    /// (m) how far from the CG a turn shows.
    fn lever(&self) -> f64 {
        self.chassis.wheelbase().value()
    }

    /// Whether neither the ground nor the steering changes on the last way.
    fn stays(&self, time: T) -> bool {
        let end = self.time + time;
        if self.steer.next_change(self.time.value()).is_some_and(|change| change.value() < end.value()) {
            return false;
        }
        if self.ground.zones.is_empty() {
            return true;
        }
        let rest = Phase { q: self.faded(time), w: [T::ZERO; 3] };
        self.first_crossing(&rest, time.value()).is_none()
    }

    /// Where the vehicle is when its motion has faded.
    fn faded(&self, time: T) -> [T; 3] {
        // q + w t/2
        [0, 1, 2].map(|i| self.phase.q[i] + self.phase.w[i] * time * 0.5)
    }

    /// The last way, in closed form.
    fn fade(&mut self, acceleration: &Acceleration<T>, time: T) {
        let [vx, vy, _] = self.phase.w;
        let speed_squared = vx * vx + vy * vy;
        if speed_squared.value() > 0.0 {
            self.distance += speed_squared.sqrt() * time * 0.5;
        }
        // The forces keep their directions while the motion shortens, so their power falls as it does.
        self.work += acceleration.power * time * 0.5;
        self.phase = Phase { q: self.faded(time), w: [T::ZERO; 3] };
        self.time += time;
        self.steps += 1;
    }

    /// Whether the vehicle, at rest, stays there.
    fn holds(&self) -> Result<(), NoRest> {
        let [gx, gy] = self.field.gravity.map(Real::value);
        let (sin, cos) = elementary::sin_cos(self.phase.q[2].value());
        let [rolling, sliding] = self.field.hold();
        let (along, all) = ((gx * cos + gy * sin).abs(), root(gx * gx + gy * gy));
        let (time, state) = (self.time.value(), self.state().values());
        let share = |acceleration: f64| acceleration / GRAVITY;
        if all > sliding {
            Err(NoRest::SlidesDown { time, state, pull: share(all), hold: share(sliding) })
        } else if along > rolling {
            Err(NoRest::RollsBack { time, state, pull: share(along), hold: share(rolling) })
        } else {
            Ok(())
        }
    }

    fn rest(&self, start: &State<T>, energy: T) -> Rest<T> {
        let mass = self.chassis.body().mass();
        let [gx, gy] = self.field.gravity;
        let [x, y, heading] = self.phase.q;
        let (kinetic, friction) = (mass * energy * 0.5, -(mass * self.work));
        let grade = mass * (gx * (x - start.position.x) + gy * (y - start.position.y));
        Rest {
            position: Vector2::new(x, y),
            heading,
            time: self.time,
            distance: self.distance,
            energy: EnergyBalance { start: kinetic, friction, grade, remainder: kinetic + grade - friction },
            steps: self.steps,
        }
    }

    /// Takes one step, at first of the length `h` (s), and returns the length to try next.
    fn advance(&mut self, acceleration: Acceleration<T>, h: f64) -> f64 {
        let heading = self.phase.q[2].sin_cos();
        let slope = self.field.slope(heading, self.phase.w, self.steering.at(self.time));
        let start = Start { time: self.time, phase: self.phase, acceleration, slope };
        let energy = self.field.energy(self.phase.w).value();
        let power = self.field.product(acceleration.rates, self.phase.w).value();
        let to_rest = if power < 0.0 { -energy / power } else { f64::INFINITY };
        let left = self.control.longest_time - self.time.value();
        let mut h = h.min(self.control.longest_step).min(to_rest * SHARE_OF_THE_REST).min(left);
        // A step ends where the steering changes its rate.
        let change = self.steer.next_change(self.time.value()).map(|change| T::from(change) - self.time);
        loop {
            self.steps += 1;
            let length = match change {
                Some(change) if change.value() <= h => change,
                _ => T::from(h),
            };
            h = length.value();
            let trial = step(&self.field, &self.steering, &start, length);
            let error = self.error(&trial, Real::min(to_rest, 1.0)) / self.control.tolerance;
            let reverses = self.field.product(trial.end.w, self.phase.w).value() < 0.0;
            let finite =
                error.is_finite() && trial.end.q.iter().chain(&trial.end.w).all(|x| x.value().is_finite());
            let last_try = h < SHORTEST || self.steps >= self.control.most_steps;
            if (!finite || reverses || error > 1.0) && !last_try {
                let shrink = if finite { 0.9 / cube_root(error) } else { 0.1 };
                h *= if reverses { shrink.min(0.5) } else { shrink }.clamp(0.1, 0.9);
                continue;
            }
            let (trial, length, crosses) = match self.crossing(&start, &trial, length) {
                Some((trial, length)) => (trial, length, true),
                None => (trial, length, false),
            };
            self.accept(&trial, length);
            if crosses {
                self.find_zones();
            }
            let grow = if error > 0.0 { 0.9 / cube_root(error) } else { 5.0 };
            return h * grow.clamp(0.2, 5.0);
        }
    }

    /// (m) what a step adds to the error at rest, where the vehicle goes on for about `left` (s).
    fn error(&self, step: &Step<T>, left: f64) -> f64 {
        let [x, y, heading] = [0, 1, 2].map(|i| step.error_q[i] + step.error_w[i] * left * 0.5);
        Real::max(root(x * x + y * y), heading * self.lever())
    }

    fn accept(&mut self, step: &Step<T>, h: T) {
        let ([x0, y0, _], [x1, y1, _]) = (self.phase.q, step.end.q);
        let ([u0, v0, _], [u1, v1, _]) = (self.phase.w, step.end.w);
        // Simpson's rule with the velocity in the middle of the cubic: S = (h|v₀| + |6Δ − h(v₀ + v₁)| +
        // h|v₁|)/6
        let middle = [(x1 - x0) * 6.0 - h * (u0 + u1), (y1 - y0) * 6.0 - h * (v0 + v1)];
        self.distance += (h * length([u0, v0]) + length(middle) + h * length([u1, v1])) / 6.0;
        self.work += step.work;
        self.phase = step.end;
        self.time += h;
    }

    /// Asks the ground what lies just ahead of each wheel.
    fn find_zones(&mut self) {
        if self.ground.zones.is_empty() {
            return;
        }
        let now = Phase { q: self.phase.q.map(Real::value), w: self.phase.w.map(Real::value) };
        let energy = self.field.energy(self.phase.w).value();
        let ahead = if energy > 0.0 { AHEAD / root(energy) } else { 0.0 };
        let q = [0, 1, 2].map(|i| now.q[i] + now.w[i] * ahead);
        self.zones = self.zones_at(q);
        self.field.stand(self.ground, self.zones);
    }

    fn places(&self, q: [f64; 3]) -> [[f64; 2]; 4] {
        places(self.chassis, q)
    }

    fn zones_at(&self, q: [f64; 3]) -> [usize; 4] {
        self.places(q).map(|place| self.ground.zone_at(place))
    }

    /// The share of a step, from here to `end` in `h` (s), in which a wheel first stands on another zone:
    /// before and after.
    fn first_crossing(&self, end: &Phase<T>, h: f64) -> Option<[f64; 2]> {
        let (q0, q1) = (self.phase.q.map(Real::value), end.q.map(Real::value));
        let (w0, w1) = (self.phase.w.map(Real::value), end.w.map(Real::value));
        let at = |s: f64| [0, 1, 2].map(|i| cubic(s, h, [q0[i], q1[i]], [w0[i], w1[i]]).0);
        let energy = Real::max(self.field.energy(self.phase.w).value(), self.field.energy(end.w).value());
        // No wheel is much faster than the whole.
        let lookouts = (2.0 * root(energy) * h / LOOKOUT).clamp(1.0, 1000.0);
        let share = 1.0 / elementary::ceil(lookouts);
        let mut before = 0.0;
        while before < 1.0 {
            let after = (before + share).min(1.0);
            if self.zones_at(at(after)) != self.zones {
                return Some(self.narrowed(at, [before, after]));
            }
            before = after;
        }
        None
    }

    /// The bracket of a crossing, halved until it is narrow.
    fn narrowed(&self, at: impl Fn(f64) -> [f64; 3], [mut before, mut after]: [f64; 2]) -> [f64; 2] {
        while after - before > 1e-12 {
            let middle = 0.5 * (before + after);
            if self.zones_at(at(middle)) == self.zones { before = middle } else { after = middle }
        }
        [before, after]
    }

    /// The step that ends where a wheel comes onto another zone, if one does in this step.
    fn crossing(&mut self, start: &Start<T>, trial: &Step<T>, length: T) -> Option<(Step<T>, T)> {
        if self.ground.zones.is_empty() {
            return None;
        }
        let h = length.value();
        let [before, after] = self.first_crossing(&trial.end, h)?;
        let at = |s: f64| {
            [0, 1, 2].map(|i| {
                let (q0, q1) = (self.phase.q[i].value(), trial.end.q[i].value());
                cubic(s, h, [q0, q1], [self.phase.w[i].value(), trial.end.w[i].value()]).0
            })
        };
        let (from, to) = (self.places(at(before)), self.places(at(after)));
        let wheel = (0..4).find(|&i| self.ground.zone_at(to[i]) != self.zones[i])?;
        let border = self.border(from[wheel], to[wheel])?;
        // The cubic is not the step: Newton's method on the step itself, the last time with derivatives.
        let mut length = T::from(after * h);
        for round in 0..MOST_ROUNDS {
            let short = step(&self.field, &self.steering, start, length);
            self.steps += 1;
            let [place, velocity] = wheel_at(self.chassis, &short.end, wheel);
            let distance = border.distance(place);
            let rate = border.rate(velocity).value();
            let next = length - distance / rate;
            // Grazing, where the border is not crossed at all.
            if !(next.value() > 0.0 && next.value() <= h) {
                return Some((short, length));
            }
            length = next;
            if distance.value().abs() <= 1e-12 || round + 1 == MOST_ROUNDS {
                break;
            }
        }
        Some((step(&self.field, &self.steering, start, length), length))
    }

    /// The line between two points near to each other on different zones.
    fn border(&self, from: [f64; 2], to: [f64; 2]) -> Option<Edge> {
        let zone =
            self.ground.zones.iter().rfind(|zone| zone.region.contains(from) != zone.region.contains(to))?;
        zone.region.nearest_edge(to)
    }
}

/// (m) how far ahead a wheel that stands on a border is asked for its zone.
const AHEAD: f64 = 1e-9;

/// (s) a step as short as this is taken whatever its error.
const SHORTEST: f64 = 1e-9;

/// Rounds of Newton's method to a border; two suffice where the path is smooth.
const MOST_ROUNDS: u32 = 8;

fn places(chassis: &Chassis<impl Real>, [x, y, heading]: [f64; 3]) -> [[f64; 2]; 4] {
    let (sin, cos) = elementary::sin_cos(heading);
    chassis.wheels().map(|wheel| {
        let (forward, left) = (wheel.forward.value(), wheel.left.value());
        [x + forward * cos - left * sin, y + forward * sin + left * cos]
    })
}

/// Place and velocity of a wheel.
fn wheel_at<T: Real>(chassis: &Chassis<T>, phase: &Phase<T>, wheel: usize) -> [[T; 2]; 2] {
    let ([x, y, heading], [vx, vy, omega]) = (phase.q, phase.w);
    let (sin, cos) = heading.sin_cos();
    let wheel = chassis.wheels()[wheel];
    let arm = [wheel.forward * cos - wheel.left * sin, wheel.forward * sin + wheel.left * cos];
    [[x + arm[0], y + arm[1]], [vx - omega * arm[1], vy + omega * arm[0]]]
}

/// Length of a vector, zero with zero derivatives where it vanishes.
fn length<T: Real>([x, y]: [T; 2]) -> T {
    let square = x * x + y * y;
    if square.value() > 0.0 { square.sqrt() } else { T::ZERO }
}

fn cube_root(x: f64) -> f64 {
    x.power(1.0 / 3.0)
}
