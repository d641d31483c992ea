//! Follows many motions to rest at once, in vector lanes.

use fearless_simd::{Level, Simd};
use pim_core::{InvalidInput, Motion};

use crate::chassis::Chassis;
use crate::error::NoRest;
use crate::field::{Acceleration, FIELD_NUMBERS, Field};
use crate::footing::{Crossing, Footing, Pose, farthest};
use crate::forward::{Moment, Run, SHORTEST, to_rest};
use crate::ground::Ground;
use crate::lanes::{LANES, Lanes, Mask};
use crate::number::{Direction, Number};
use crate::progress::{Outlook, Pace, Progress, error_squared};
use crate::state::{Control, Rest, State};
use crate::steer::Steer;
use crate::step::{Phase, Start, Steering};

/// Number of motions whose state is kept at once, so that it fits into the cache.
const CHUNK: usize = 256;

/// The inputs of one motion to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outset<'a> {
    /// The vehicle.
    pub chassis: Chassis,
    /// (rad) angle of its front wheels.
    pub steer: Steer<'a>,
    /// The ground it moves on.
    pub ground: Ground<'a>,
    /// Its position and motion at the start.
    pub start: State,
}

impl Outset<'_> {
    fn alone(&self, control: &Control) -> Result<Rest, NoRest> {
        to_rest(&self.chassis, self.steer, &self.ground, &self.start, control, |_| {})
    }

    /// Whether a lane can follow the motion.
    fn fits(&self) -> bool {
        matches!(self.steer, Steer::Held(_))
    }
}

/// Follows many vehicles to rest, and passes the index and the rest of each to `take`, in any order. A rest
/// has the same bits as from [`to_rest`], whatever the other motions are.
///
/// Eight motions at a time are followed with the processor's vector instructions, each with its own steps;
/// when one is at rest, the next takes its lane. A step in which a wheel enters another zone of the ground, a
/// motion with a varying steer angle, and one without a rest are computed one by one.
pub fn to_rests(
    outsets: &[Outset<'_>],
    control: &Control,
    mut take: impl FnMut(usize, Result<Rest, NoRest>),
) {
    let mut parked = Vec::with_capacity(outsets.len().min(CHUNK));
    for (number, chunk) in outsets.chunks(CHUNK).enumerate() {
        parked.clear();
        parked.extend(chunk.iter().map(|outset| Parked::new(outset, control).unwrap_or(Parked::ALONE)));
        follow_all(control, chunk, &mut parked);
        for (i, (outset, parked)) in chunk.iter().zip(&parked).enumerate() {
            take(number * CHUNK + i, parked.rest(outset, control));
        }
    }
}

/// Follows the motions of a chunk with the processor's vector instructions.
///
/// Separate from [`to_rests`], which is compiled in every crate that calls it, because this takes long to
/// compile. For the same reason x86-64 without AVX2 has no code of its own: there, the motions are followed
/// one by one.
fn follow_all(control: &Control, outsets: &[Outset<'_>], parked: &mut [Parked]) {
    let level = Level::new();
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    {
        if let Some(simd) = level.as_avx512() {
            follow_with(simd, control, outsets, parked);
        } else if let Some(simd) = level.as_avx2() {
            follow_with(simd, control, outsets, parked);
        }
    }
    #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
    fearless_simd::dispatch!(level, simd => follow_with(simd, control, outsets, parked));
}

fn follow_with<S: Simd>(simd: S, control: &Control, outsets: &[Outset<'_>], parked: &mut [Parked]) {
    simd.vectorize(
        #[inline(always)]
        || follow(simd, control, outsets, parked, false),
    );
    simd.vectorize(
        #[inline(always)]
        || follow(simd, control, outsets, parked, true),
    );
}

/// The next task for a motion.
#[derive(Clone, Copy, PartialEq)]
enum Task {
    /// Steps of the explicit or of the implicit method.
    Step { implicit: bool },
    /// The final phase, in closed form.
    Fade,
    /// A separate run.
    Alone,
}

/// A motion under way, or one in each lane.
#[derive(Clone, Copy)]
struct Course<T: Number> {
    now: Progress<T>,
    direction: Direction<T>,
    acceleration: Acceleration<T>,
    pace: Pace<T>,
    /// (s) time to rest according to the outlook.
    to_rest: T,
    /// (s) length of the step to try.
    length: T,
    /// 1 if a longer step was rejected, else 0.
    again: T,
    /// Steps tried.
    steps: T,
}

/// Number of values in a [`Course`].
const NUMBERS: usize = 25;

impl<T: Number<Plain = T>> Course<T> {
    #[inline(always)]
    fn numbers(&self) -> [T; NUMBERS] {
        let Progress { phase, time, distance, work, speed } = self.now;
        let Phase { q: [x, y, heading], w: [vx, vy, omega] } = phase;
        let Direction { sin, cos } = self.direction;
        let Acceleration { rates: [ax, ay, alpha], power, stiffness, sliding: _, locked } = self.acceleration;
        let [paced, before, stiff] = self.pace.numbers();
        let Self { to_rest, length, again, steps, .. } = *self;
        [
            x, y, heading, vx, vy, omega, time, distance, work, speed, sin, cos, ax, ay, alpha, power,
            stiffness, locked, paced, before, stiff, to_rest, length, again, steps,
        ]
    }

    #[inline(always)]
    fn of(numbers: [T; NUMBERS]) -> Self {
        let [
            x,
            y,
            heading,
            vx,
            vy,
            omega,
            time,
            distance,
            work,
            speed,
            sin,
            cos,
            ax,
            ay,
            alpha,
            power,
            stiffness,
            locked,
            paced,
            before,
            stiff,
            to_rest,
            length,
            again,
            steps,
        ] = numbers;
        let phase = Phase { q: [x, y, heading], w: [vx, vy, omega] };
        // Only a record of the path needs to know which tyres slide, and there is none here.
        let sliding = [x.below(x); 4];
        Self {
            now: Progress { phase, time, distance, work, speed },
            direction: Direction { sin, cos },
            acceleration: Acceleration { rates: [ax, ay, alpha], power, stiffness, sliding, locked },
            pace: Pace::of([paced, before, stiff]),
            to_rest,
            length,
            again,
            steps,
        }
    }
}

/// A motion that no lane follows at present.
#[derive(Clone, Copy)]
struct Parked {
    task: Task,
    given: [f64; GIVEN_NUMBERS],
    course: [f64; NUMBERS],
    /// The zone under each wheel, and (m) the distance from the CG to the farthest wheel.
    zones: [usize; 4],
    radius: f64,
}

impl Parked {
    const ALONE: Self = Self {
        task: Task::Alone,
        given: [0.0; GIVEN_NUMBERS],
        course: [0.0; NUMBERS],
        zones: [0; 4],
        radius: 0.0,
    };

    fn new(outset: &Outset<'_>, control: &Control) -> Result<Self, InvalidInput> {
        if !outset.fits() {
            return Ok(Self::ALONE);
        }
        let run = Run::new(&outset.chassis, outset.steer, &outset.ground, &outset.start, control)?;
        let moment = run.moment(run.direction());
        Ok(Self::of(run, moment, control))
    }

    /// The present state of a motion; if its final phase would cross a border, it takes that step first.
    fn of(mut run: Run<'_, f64, f64>, mut moment: Moment<f64>, control: &Control) -> Self {
        let outlook = loop {
            // A motion that enters one zone after another would never end.
            if run.steps >= control.most_steps || run.now.time >= control.longest_time {
                return Self::ALONE;
            }
            let outlook = run.outlook(&moment.acceleration);
            if !outlook.fades || run.stays(outlook.to_rest) {
                break outlook;
            }
            moment = run.advance(moment, outlook.to_rest);
        };
        let left = control.longest_time - run.now.time;
        let course = Course {
            now: run.now,
            direction: moment.direction,
            acceleration: moment.acceleration,
            pace: run.pace,
            to_rest: outlook.to_rest,
            length: run.pace.next(outlook.to_rest, left, control),
            again: 0.0,
            steps: f64::from(run.steps),
        };
        let task = match outlook.fades {
            true => Task::Fade,
            false => Task::Step { implicit: run.pace.is_implicit() },
        };
        let given = Given { field: run.field, steer: run.steering.at(0.0), lever: run.lever() };
        let Footing { zones, radius, .. } = run.footing;
        Self { task, given: given.numbers(), course: course.numbers(), zones, radius }
    }

    /// A separate run of the motion from this state.
    fn run<'a>(
        &self,
        outset: &'a Outset<'a>,
        course: &Course<f64>,
        control: &'a Control,
    ) -> Run<'a, f64, f64> {
        let Outset { chassis, steer, ground, start } = outset;
        let given = Given::of(self.given);
        let steering = Steering::Held(given.steer);
        let footing = Footing { chassis, ground, radius: self.radius, zones: self.zones };
        let mut run = Run::on(footing, *steer, start, control, steering, given.field);
        run.now = course.now;
        run.pace = course.pace;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it counts steps")]
        let steps = course.steps as u32;
        run.steps = steps;
        run
    }

    fn rest(&self, outset: &Outset<'_>, control: &Control) -> Result<Rest, NoRest> {
        let course = Course::of(self.course);
        let late = course.now.time + course.to_rest > control.longest_time;
        if self.task != Task::Fade || late || course.steps >= f64::from(control.most_steps) {
            return outset.alone(control);
        }
        let mut run = self.run(outset, &course, control);
        let Motion { velocity, yaw_rate } = outset.start.motion;
        let energy = run.field.energy([velocity.x, velocity.y, yaw_rate]);
        run.fade(&course.acceleration);
        run.holds()?;
        Ok(run.rest(&outset.start, energy))
    }
}

/// The constants of a motion.
#[derive(Clone, Copy)]
struct Given<T> {
    field: Field<T>,
    steer: Direction<T>,
    /// (m)
    lever: T,
}

/// Number of values in a [`Given`].
const GIVEN_NUMBERS: usize = FIELD_NUMBERS + 3;

impl<T: Number<Plain = T>> Given<T> {
    #[inline(always)]
    fn of(numbers: [T; GIVEN_NUMBERS]) -> Self {
        let [sin, cos, lever, field @ ..] = numbers;
        Self { field: Field::of(field), steer: Direction { sin, cos }, lever }
    }
}

impl Given<f64> {
    fn numbers(&self) -> [f64; GIVEN_NUMBERS] {
        let mut numbers = [0.0; GIVEN_NUMBERS];
        let (first, field) = numbers.split_at_mut(3);
        first.copy_from_slice(&[self.steer.sin, self.steer.cos, self.lever]);
        field.copy_from_slice(&self.field.numbers());
        numbers
    }
}

impl<S: Simd> Course<Lanes<S>> {
    /// The motion of one lane.
    #[inline(always)]
    fn lane(&self, lane: usize) -> Course<f64> {
        Course::of(self.numbers().each_ref().map(|cells| cells.get(lane)))
    }

    /// Position and motion of one lane.
    #[inline(always)]
    fn pose(&self, lane: usize) -> Pose {
        let Course { now, direction, .. } = self.lane(lane);
        Pose { phase: now.phase, direction }
    }

    /// Tries a step in each lane. Returns the lanes that have only the final phase left after it.
    #[inline(always)]
    fn step(&mut self, given: &Given<Lanes<S>>, control: &Control, implicit: bool) -> Mask<S> {
        let Given { field, steer, lever } = given;
        let Self { now, direction, acceleration, to_rest, length: h, .. } = *self;
        let Progress { phase, time, .. } = now;
        let slope = if implicit { Some(field.slope(direction, phase.w, *steer)) } else { None };
        let start = Start { time, phase, direction, acceleration, slope };
        let trial = start.step(field, |_| *steer, h);
        let error = error_squared(&trial, to_rest, *lever, control);
        let (zero, one, infinity) = (h.constant(0.0), h.constant(1.0), h.constant(f64::INFINITY));
        let forward = field.product(trial.end.w, phase.w).at_least(zero);
        let accepted = Lanes::both(Lanes::both(one.at_least(error), trial.is_finite()), forward);
        // The lanes that accept the step.
        let mut pace = self.pace;
        pace.accept(h, error, self.again.at_least(one));
        let then = now.after(trial.end, trial.work, h);
        let (direction, acceleration) = trial.there;
        pace.count(acceleration.stiffness);
        let outlook = Outlook::new(field, then.phase.w, acceleration.rates, *lever, control);
        let left = h.constant(control.longest_time) - then.time;
        let steps = self.steps + 1.0;
        let taken = Self {
            now: then,
            direction,
            acceleration,
            pace,
            to_rest: outlook.to_rest,
            length: pace.next(outlook.to_rest, left, control),
            again: zero,
            steps,
        };
        // The lanes that try again.
        let shorter = Lanes::select(error.below(infinity), Pace::shorter(h, error), h * 0.1);
        let again = Self { length: shorter, again: one, steps, ..*self };
        let mut numbers = again.numbers();
        for (number, taken) in numbers.iter_mut().zip(taken.numbers()) {
            *number = Lanes::select(accepted, taken, *number);
        }
        *self = Self::of(numbers);
        Lanes::both(accepted, outlook.fades)
    }
}

/// Takes steps of one method in all lanes, until no motion needs another.
#[inline(always)]
fn follow<S: Simd>(
    simd: S,
    control: &Control,
    outsets: &[Outset<'_>],
    parked: &mut [Parked],
    implicit: bool,
) {
    let task = Task::Step { implicit };
    let zero = Lanes::splat(simd, 0.0);
    let mut board = Board {
        outsets,
        control,
        parked,
        task,
        next: 0,
        follows: [None; LANES],
        given: [zero; GIVEN_NUMBERS],
        courses: [zero; NUMBERS],
        clearance: zero,
    };
    let most_steps = f64::from(control.most_steps);
    while board.fill() {
        let mut course = Course::of(board.courses);
        let given = Given::of(board.given);
        let (steps, time) = (course.steps.constant(most_steps), course.steps.constant(control.longest_time));
        let shortest = course.steps.constant(SHORTEST);
        // A lane that continues with values changed outside the vector loop ends this round.
        let mut goes_on = false;
        while !goes_on && !board.wants_more() {
            let (busy, watched) = (board.busy(), board.watched());
            let mut crossings = [const { None }; LANES];
            // The lanes need not be examined one by one until one of them is done.
            let (before, fades, stiff, done) = loop {
                let before = course;
                let fades = course.step(&given, control, implicit);
                let crosses = match watched {
                    0 => 0,
                    watched => {
                        let near = board.approach(&before, &course) & watched;
                        board.crosses(near, &before, &course, &mut crossings)
                    }
                };
                let stiff = course.pace.is_implicit();
                let ended = Lanes::one_of(course.now.time.at_least(time), course.steps.at_least(steps));
                let done = Lanes::one_of(Lanes::one_of(ended, course.length.below(shortest)), fades);
                let done = if implicit { done } else { Lanes::one_of(done, stiff) };
                let done = done.bits() & busy;
                if done | crosses != 0 {
                    break (before, fades.bits(), stiff.bits(), done);
                }
            };
            board.courses = course.numbers();
            for (lane, crossing) in crossings.iter().enumerate() {
                let has = |bits: u64| bits >> lane & 1 == 1;
                if let Some(crossing) = crossing {
                    goes_on |= board.cross(lane, crossing, &before, &course);
                } else if has(done) {
                    let task = match (has(fades), has(stiff)) {
                        (true, _) => Task::Fade,
                        (false, true) if !implicit => Task::Step { implicit: true },
                        _ => Task::Alone,
                    };
                    if task == Task::Fade && has(watched) {
                        goes_on |= board.look_ahead(lane);
                    } else {
                        board.park(lane, task);
                    }
                }
            }
        }
    }
}

/// The motion that each lane follows, and its values.
struct Board<'a, S: Simd> {
    outsets: &'a [Outset<'a>],
    control: &'a Control,
    parked: &'a mut [Parked],
    /// The task of the lanes.
    task: Task,
    /// The next motion to examine.
    next: usize,
    follows: [Option<usize>; LANES],
    given: [Lanes<S>; GIVEN_NUMBERS],
    courses: [Lanes<S>; NUMBERS],
    /// (m) distance that each can at least go before a wheel meets a border.
    clearance: Lanes<S>,
}

impl<S: Simd> Board<'_, S> {
    /// Bit mask of the lanes that follow a motion.
    #[inline(always)]
    fn busy(&self) -> u64 {
        (0..LANES).fold(0, |bits, lane| bits | u64::from(self.follows[lane].is_some()) << lane)
    }

    /// Whether all lanes are free, or one is and more motions are left.
    #[inline(always)]
    fn wants_more(&self) -> bool {
        let busy = self.busy();
        busy == 0 || (busy != (1 << LANES) - 1 && self.next < self.parked.len())
    }

    /// Loads the next motion with this task into a lane.
    #[inline(always)]
    fn load(&mut self, lane: usize) {
        while let Some(parked) = self.parked.get(self.next) {
            let number = self.next;
            self.next += 1;
            if parked.task != self.task {
                continue;
            }
            self.follows[lane] = Some(number);
            let parked = *parked;
            self.put(lane, &parked);
            return;
        }
    }

    /// Loads the next motions into the free lanes; if none is left, a free lane duplicates a busy one.
    /// Returns whether any lane is busy.
    #[inline(always)]
    fn fill(&mut self) -> bool {
        for lane in 0..LANES {
            if self.follows[lane].is_none() {
                self.load(lane);
            }
        }
        let Some(busy) = self.follows.iter().position(Option::is_some) else { return false };
        for lane in 0..LANES {
            if self.follows[lane].is_none() {
                for cells in self.given.iter_mut().chain(&mut self.courses) {
                    cells.put(lane, cells.get(busy));
                }
            }
        }
        true
    }

    /// Bit mask of the lanes that follow a motion over ground with zones.
    #[inline(always)]
    fn watched(&self) -> u64 {
        let has_zones = |number: usize| !self.outsets[number].ground.zones.is_empty();
        (0..LANES).fold(0, |bits, lane| bits | u64::from(self.follows[lane].is_some_and(has_zones)) << lane)
    }

    /// Takes a step off the clearance, and returns the bit mask of the lanes that have none left.
    #[inline(always)]
    fn approach(&mut self, before: &Course<Lanes<S>>, after: &Course<Lanes<S>>) -> u64 {
        let zero = before.length.constant(0.0);
        self.clearance = self.clearance - farthest(before.now.phase, after.now.phase, before.length);
        zero.at_least(self.clearance).bits()
    }

    /// Finds where a wheel enters another zone in the steps of the lanes that are `near` a border, and
    /// returns the bit mask of those that do.
    #[inline(never)]
    fn crosses(
        &mut self,
        near: u64,
        before: &Course<Lanes<S>>,
        after: &Course<Lanes<S>>,
        crossings: &mut [Option<Crossing>; LANES],
    ) -> u64 {
        let mut crosses = 0;
        for (lane, crossing) in crossings.iter_mut().enumerate() {
            let Some(number) = self.follows[lane].filter(|_| near >> lane & 1 == 1) else { continue };
            // A rejected step leads nowhere yet.
            if after.again.get(lane) != 0.0 {
                continue;
            }
            let Outset { chassis, ground, .. } = &self.outsets[number];
            let Parked { zones, radius, .. } = self.parked[number];
            let footing = Footing { chassis, ground, radius, zones };
            let end = after.pose(lane);
            *crossing = footing.crossing(before.pose(lane), end, before.length.get(lane));
            self.clearance.put(lane, footing.clearance(end.phase));
            crosses |= u64::from(crossing.is_some()) << lane;
        }
        crosses
    }

    /// Takes the step of one lane separately, up to the border. Returns whether the lane goes on.
    #[inline(never)]
    fn cross(
        &mut self,
        lane: usize,
        crossing: &Crossing,
        before: &Course<Lanes<S>>,
        after: &Course<Lanes<S>>,
    ) -> bool {
        let Some(number) = self.follows[lane] else { return false };
        let course = before.lane(lane);
        let mut run = self.parked[number].run(&self.outsets[number], &course, self.control);
        let Course { direction, acceleration, length, .. } = course;
        let start = run.start(Moment { direction, acceleration });
        // The whole step was tried, and determines the length of the next.
        run.steps += 1;
        let [paced, error, _] = after.pace.numbers().each_ref().map(|cells| cells.get(lane));
        let [_, _, stiff] = run.pace.numbers();
        run.pace = Pace::of([paced, error, stiff]);
        let moment = run.cross(&start, crossing, length);
        self.go_on(lane, Parked::of(run, moment, self.control))
    }

    /// Checks whether the final phase of a lane crosses a border. Returns whether the lane goes on.
    #[inline(never)]
    fn look_ahead(&mut self, lane: usize) -> bool {
        let Some(number) = self.follows[lane] else { return false };
        let course = Course::of(self.courses.each_ref().map(|cells| cells.get(lane)));
        let run = self.parked[number].run(&self.outsets[number], &course, self.control);
        let Course { direction, acceleration, .. } = course;
        self.go_on(lane, Parked::of(run, Moment { direction, acceleration }, self.control))
    }

    /// Stores the present state of a lane's motion, and puts it back into the lane if its task is the same.
    fn go_on(&mut self, lane: usize, now: Parked) -> bool {
        let Some(number) = self.follows[lane] else { return false };
        self.parked[number] = now;
        if now.task != self.task {
            self.follows[lane] = None;
            return false;
        }
        self.put(lane, &now);
        true
    }

    #[inline(always)]
    fn put(&mut self, lane: usize, parked: &Parked) {
        self.clearance.put(lane, 0.0);
        for (cells, number) in self.given.iter_mut().zip(parked.given) {
            cells.put(lane, number);
        }
        for (cells, number) in self.courses.iter_mut().zip(parked.course) {
            cells.put(lane, number);
        }
    }

    /// Stores the motion of a lane and frees the lane.
    #[inline(always)]
    fn park(&mut self, lane: usize, task: Task) {
        if let Some(number) = self.follows[lane].take() {
            let parked = &mut self.parked[number];
            parked.task = task;
            for (number, cells) in parked.course.iter_mut().zip(&self.courses) {
                *number = cells.get(lane);
            }
        }
    }
}
