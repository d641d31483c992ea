//! The motion from the impact to rest.

use pim_core::{InvalidInput, Motion, Vector2};
use real::{Real, elementary};

use crate::chassis::Chassis;
use crate::error::NoRest;
use crate::field::{Acceleration, Field, GRAVITY, root};
use crate::footing::{Crossing, Footing, Pose};
use crate::ground::Ground;
use crate::number::Direction;
use crate::progress::{Outlook, Pace, Progress, error_squared};
use crate::state::{Control, GREATEST_SPEED, GREATEST_YAW_RATE, MotionEnergy, Rest, Sample, State};
use crate::steer::Steer;
use crate::step::{Phase, Start, Steering, Step};
use pim_core::check;

/// Follows a vehicle from its `start` to rest, and passes a [`Sample`] at the start, after each step and at
/// rest to `record`.
///
/// The final phase, in which the motion only fades without changing its direction, is one step in closed
/// form. A straight slide on uniform ground takes no other step, and is exact.
///
/// # Errors
/// [`NoRest::Invalid`] if a number is impossible; the others if the vehicle does not come to rest.
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

/// [`to_rest`] with ground and steering in a number type that may carry fewer derivatives than that of the
/// motion.
pub(crate) fn follow<T: Real + From<G>, G: Real>(
    chassis: &Chassis<T>,
    steer: Steer<'_, G>,
    ground: &Ground<'_, G>,
    start: &State<T>,
    control: &Control,
    mut record: impl FnMut(&Sample<T>),
) -> Result<Rest<T>, NoRest> {
    let mut run = Run::new(chassis, steer, ground, start, control)?;
    let energy = run.energy();
    let mut moment = run.moment(run.direction());
    let mut foreseen = None;
    while run.steps < control.most_steps {
        record(&run.sample(moment.acceleration.sliding));
        let time = run.now.time.value();
        let outlook = run.outlook(&moment.acceleration);
        let fades = outlook.fades && run.stays(outlook.to_rest);
        // A vehicle with hardly any resistance fades for hours.
        let end = if fades { time + outlook.to_rest } else { time };
        if end > control.longest_time || (end >= control.longest_time && !fades) {
            return Err(NoRest::StillMoving { time, state: run.state().values() });
        }
        if !control.closed_end && outlook.to_rest * run.now.speed.value() * 0.5 < FORESEEN {
            foreseen = foreseen.or_else(|| Some(run.time_at_rest(&moment.acceleration)));
        }
        if fades {
            run.fade(&moment.acceleration);
            if let Some(foreseen) = foreseen {
                run.now.time = T::from(run.now.time.value()) + foreseen;
            }
            run.holds()?;
            record(&run.sample([false; 4]));
            return Ok(run.rest(start, energy));
        }
        moment = run.advance(moment, outlook.to_rest);
    }
    Err(NoRest::TooManySteps { steps: run.steps, time: run.now.time.value(), state: run.state().values() })
}

/// (m) remaining path below which the forces on a vehicle only change their directions.
const FORESEEN: f64 = 0.01;

fn check_start<T: Real>(start: &State<T>, control: &Control) -> Result<(), InvalidInput> {
    check::finite("position along x at the start", start.position.x.value())?;
    check::finite("position along y at the start", start.position.y.value())?;
    check::angle("heading at the start", start.heading.value())?;
    let Motion { velocity, yaw_rate } = &start.motion;
    check::within("velocity along x at the start", velocity.x.value(), -GREATEST_SPEED, GREATEST_SPEED)?;
    check::within("velocity along y at the start", velocity.y.value(), -GREATEST_SPEED, GREATEST_SPEED)?;
    check::within("yaw rate at the start", yaw_rate.value(), -GREATEST_YAW_RATE, GREATEST_YAW_RATE)?;
    check::positive("tolerance", control.tolerance)?;
    check::positive("longest time", control.longest_time)?;
    check::positive("longest step", control.longest_step)
}

/// A motion under way.
pub(crate) struct Run<'a, T, G> {
    chassis: &'a Chassis<T>,
    ground: &'a Ground<'a, G>,
    steer: Steer<'a, G>,
    pub(crate) steering: Steering<'a, T, G>,
    control: &'a Control,
    pub(crate) field: Field<T>,
    pub(crate) footing: Footing<'a, T, G>,
    pub(crate) now: Progress<T>,
    pub(crate) steps: u32,
    pub(crate) pace: Pace<f64>,
}

/// Direction and acceleration at the present state of a motion.
#[derive(Clone, Copy)]
pub(crate) struct Moment<T: Real> {
    pub(crate) direction: Direction<T>,
    pub(crate) acceleration: Acceleration<T>,
}

impl<'a, T: Real + From<G>, G: Real> Run<'a, T, G> {
    /// A motion at its start.
    pub(crate) fn new(
        chassis: &'a Chassis<T>,
        steer: Steer<'a, G>,
        ground: &'a Ground<'a, G>,
        start: &State<T>,
        control: &'a Control,
    ) -> Result<Self, InvalidInput> {
        check_start(start, control)?;
        steer.check()?;
        ground.check()?;
        let field = Field::new(chassis, ground, [0; 4]);
        let footing = Footing::new(chassis, ground);
        let mut run = Self::on(footing, steer, start, control, Steering::new(steer), field);
        run.find_zones(run.direction());
        Ok(run)
    }

    /// The same for checked inputs, with the data that [`new`](Self::new) derives from them.
    pub(crate) fn on(
        footing: Footing<'a, T, G>,
        steer: Steer<'a, G>,
        start: &State<T>,
        control: &'a Control,
        steering: Steering<'a, T, G>,
        field: Field<T>,
    ) -> Self {
        let Motion { velocity, yaw_rate } = start.motion;
        let phase = Phase {
            q: [start.position.x, start.position.y, start.heading],
            w: [velocity.x, velocity.y, yaw_rate],
        };
        Self {
            chassis: footing.chassis,
            ground: footing.ground,
            steer,
            steering,
            control,
            field,
            footing,
            now: Progress::new(phase),
            steps: 0,
            pace: Pace::new(1.0),
        }
    }

    /// (m²/s²) twice the kinetic energy per unit mass.
    pub(crate) fn energy(&self) -> T {
        self.field.energy(self.now.phase.w)
    }

    /// The direction of the heading.
    pub(crate) fn direction(&self) -> Direction<T> {
        Direction::of(self.now.phase.q[2])
    }

    /// The acceleration, with the direction of the heading.
    pub(crate) fn moment(&self, direction: Direction<T>) -> Moment<T> {
        let steer = self.steering.at(self.now.time);
        Moment { direction, acceleration: self.field.acceleration(direction, self.now.phase.w, steer) }
    }

    pub(crate) fn outlook(&self, acceleration: &Acceleration<T>) -> Outlook<f64> {
        let w = self.now.phase.w.map(Real::value);
        let rates = acceleration.rates.map(Real::value);
        Outlook::new(&self.field.plain(), w, rates, self.lever(), self.control)
    }

    fn state(&self) -> State<T> {
        let ([x, y, heading], [vx, vy, yaw_rate]) = (self.now.phase.q, self.now.phase.w);
        let motion = Motion { velocity: Vector2::new(vx, vy), yaw_rate };
        State { position: Vector2::new(x, y), heading, motion }
    }

    fn sample(&self, sliding: [bool; 4]) -> Sample<T> {
        Sample {
            time: self.now.time,
            distance: self.now.distance,
            state: self.state(),
            sliding,
            friction: self.footing.zones.map(|zone| T::from(self.ground.friction_in(zone))),
        }
    }

    /// (m) length that converts a turn into a distance.
    pub(crate) fn lever(&self) -> f64 {
        self.chassis.wheelbase().value()
    }

    /// Whether neither the ground nor the steering changes in the final phase, which takes `time` (s).
    pub(crate) fn stays(&self, time: f64) -> bool {
        let now = self.now.time.value();
        if self.steer.next_change(now).is_some_and(|change| change.value() < now + time) {
            return false;
        }
        if self.footing.is_even() {
            return true;
        }
        let now = plain(self.now.phase);
        let q = [0, 1, 2].map(|i| now.q[i] + now.w[i] * (time * 0.5));
        let pose = |phase: Phase<f64>| Pose { phase, direction: Direction::of(phase.q[2]) };
        self.footing.crossing(pose(now), pose(Phase { q, w: [0.0; 3] }), time).is_none()
    }

    /// The derivatives of the time at rest, with a value of zero.
    ///
    /// At the end itself they are lost: a vehicle that hardly moves has large derivatives of its slip angles,
    /// and no more than rounding in them.
    fn time_at_rest(&self, acceleration: &Acceleration<T>) -> T {
        let time = self.now.time + self.fading(acceleration);
        time - T::from(time.value())
    }

    /// (s) how long the motion takes to fade.
    fn fading(&self, acceleration: &Acceleration<T>) -> T {
        let w = self.now.phase.w;
        let energy = self.field.energy(w);
        // t = 2T/|P|
        if energy.value() > 0.0 { -(energy / self.field.product(acceleration.rates, w)) } else { T::ZERO }
    }

    /// The final phase, in closed form.
    pub(crate) fn fade(&mut self, acceleration: &Acceleration<T>) {
        let time = self.fading(acceleration);
        self.now = self.now.faded(acceleration, time);
        self.steps += 1;
    }

    /// Checks that the vehicle stays at rest.
    pub(crate) fn holds(&self) -> Result<(), NoRest> {
        let [gx, gy] = self.field.gravity.map(Real::value);
        if gx == 0.0 && gy == 0.0 {
            return Ok(());
        }
        let (sin, cos) = elementary::sin_cos(self.now.phase.q[2].value());
        let [rolling, sliding] = self.field.hold();
        let (along, all) = ((gx * cos + gy * sin).abs(), root(gx * gx + gy * gy));
        let (time, state) = (self.now.time.value(), self.state().values());
        let share = |acceleration: f64| acceleration / GRAVITY;
        if all > sliding {
            Err(NoRest::SlidesDown { time, state, pull: share(all), hold: share(sliding) })
        } else if along > rolling {
            Err(NoRest::RollsBack { time, state, pull: share(along), hold: share(rolling) })
        } else {
            Ok(())
        }
    }

    pub(crate) fn rest(&self, start: &State<T>, energy: T) -> Rest<T> {
        let mass = self.chassis.body().mass();
        let [gx, gy] = self.field.gravity;
        let [x, y, heading] = self.now.phase.q;
        let (kinetic, friction) = (mass * energy * 0.5, -(mass * self.now.work));
        let grade = mass * (gx * (x - start.position.x) + gy * (y - start.position.y));
        Rest {
            position: Vector2::new(x, y),
            heading,
            time: self.now.time,
            distance: self.now.distance,
            energy: MotionEnergy { start: kinetic, friction, grade, remainder: kinetic + grade - friction },
            steps: self.steps,
        }
    }

    /// Takes one step.
    pub(crate) fn advance(&mut self, moment: Moment<T>, to_rest: f64) -> Moment<T> {
        let start = self.start(moment);
        let Progress { phase, time, .. } = self.now;
        let left = self.control.longest_time - time.value();
        let mut h = self.pace.next(to_rest, left, self.control);
        let mut again = false;
        // A step ends where the steering changes its rate.
        let change = self.steer.next_change(time.value()).map(|change| T::from(change) - time);
        loop {
            self.steps += 1;
            let length = match change {
                Some(change) if change.value() <= h => change,
                _ => T::from(h),
            };
            h = length.value();
            let trial = start.step(&self.field, |time| self.steering.at(time), length);
            let error = error_squared(&trial, to_rest, self.lever(), self.control);
            let reverses = self.field.product(trial.end.w, phase.w).value() < 0.0;
            // The comparison is false for a NaN error, which is not small.
            let close = error <= 1.0 && trial.is_finite();
            let last_try = h < SHORTEST || self.steps >= self.control.most_steps;
            if (reverses || !close) && !last_try {
                h = if error.is_finite() { Pace::shorter(h, error) } else { h * 0.1 };
                again = true;
                continue;
            }
            return self.take(&start, &trial, length, error, again);
        }
    }

    /// Moves to the end of a step, or to the first border before it.
    #[inline(always)]
    fn take(&mut self, start: &Start<T>, trial: &Step<T>, length: T, error: f64, again: bool) -> Moment<T> {
        self.pace.accept(length.value(), error, again);
        if !self.footing.is_even() {
            let from = Pose { phase: plain(start.phase), direction: start.direction.plain() };
            let to = Pose { phase: plain(trial.end), direction: trial.there.0.plain() };
            if let Some(crossing) = self.footing.crossing(from, to, length.value()) {
                return self.cross(start, &crossing, length.value());
            }
        }
        self.now = self.now.after(trial.end, trial.work, length);
        let (direction, acceleration) = trial.there;
        self.pace.count(acceleration.stiffness);
        Moment { direction, acceleration }
    }

    #[inline(always)]
    pub(crate) fn start(&self, Moment { direction, acceleration }: Moment<T>) -> Start<T> {
        let Progress { phase, time, .. } = self.now;
        let slope = self.pace.is_implicit().then(|| {
            let steer = self.steering.at(time);
            self.field.plain().slope(direction.plain(), phase.w.map(Real::value), steer.plain())
        });
        Start { time, phase, direction, acceleration, slope }
    }

    /// Finds the zone just ahead of each wheel.
    fn find_zones(&mut self, direction: Direction<T>) {
        if self.footing.is_even() {
            return;
        }
        let energy = self.field.energy(self.now.phase.w).value();
        self.footing.find(Pose { phase: plain(self.now.phase), direction: direction.plain() }, energy);
        self.field = Field::new(self.chassis, self.ground, self.footing.zones);
    }

    /// Moves to the point where a wheel enters another zone in a step of `h` (s).
    pub(crate) fn cross(&mut self, start: &Start<T>, crossing: &Crossing, h: f64) -> Moment<T> {
        let (short, length) = self.up_to_border(start, crossing, h);
        self.now = self.now.after(short.end, short.work, length);
        self.find_zones(short.direction);
        self.moment(short.direction)
    }

    /// The step that ends at the border, and its length (s).
    fn up_to_border(&mut self, start: &Start<T>, crossing: &Crossing, h: f64) -> (Short<T>, T) {
        let &Crossing { share, wheel, border } = crossing;
        // The crossing was found on the cubic: Newton's method corrects it on the step itself, the last time
        // with derivatives.
        let mut length = T::from(share * h);
        for round in 0..MOST_ROUNDS {
            let short = self.short(start, length);
            self.steps += 1;
            let [place, velocity] = short.wheel(self.chassis, wheel);
            let left = border.distance(place) / border.rate(velocity).value();
            let next = length - left;
            // The wheel only grazes the border.
            if !(next.value() > 0.0 && next.value() <= h) {
                return (short, length);
            }
            length = next;
            if left.value().abs() <= ON_THE_BORDER || round + 1 == MOST_ROUNDS {
                break;
            }
        }
        (self.short(start, length), length)
    }

    /// A step that ends at a border. Separate from the inlined step of [`advance`](Self::advance), as few
    /// motions need this one.
    #[cold]
    #[inline(never)]
    fn short(&self, start: &Start<T>, length: T) -> Short<T> {
        let step = start.step(&self.field, |time| self.steering.at(time), length);
        Short { end: step.end, direction: step.there.0, work: step.work }
    }
}

/// A step that ends at a border, beyond which the forces are different.
struct Short<T: Real> {
    end: Phase<T>,
    /// The direction of the heading at the end.
    direction: Direction<T>,
    /// (J/kg) work of the tyres' forces, negative.
    work: T,
}

impl<T: Real> Short<T> {
    /// Position and velocity of a wheel at the end.
    fn wheel(&self, chassis: &Chassis<T>, wheel: usize) -> [[T; 2]; 2] {
        let ([x, y, _], [vx, vy, omega]) = (self.end.q, self.end.w);
        let (Direction { sin, cos }, wheel) = (self.direction, chassis.wheels()[wheel]);
        let arm = [wheel.forward * cos - wheel.left * sin, wheel.forward * sin + wheel.left * cos];
        [[x + arm[0], y + arm[1]], [vx - omega * arm[1], vy + omega * arm[0]]]
    }
}

/// (s) a step shorter than this is accepted whatever its error.
pub(crate) const SHORTEST: f64 = 1e-9;

/// Maximum number of rounds of Newton's method to a border; two suffice on a smooth path.
const MOST_ROUNDS: u32 = 8;

/// (s) from this near to the border, one round of Newton's method reaches it to well below a nanometre, even
/// where a wheel is accelerated by 100 m/s² on its circle: its error is ½ a t².
const ON_THE_BORDER: f64 = 1e-6;

fn plain<T: Real>(phase: Phase<T>) -> Phase<f64> {
    Phase { q: phase.q.map(Real::value), w: phase.w.map(Real::value) }
}
