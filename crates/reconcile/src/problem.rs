//! The speed at which the work of the normal impulse equals the crush energy.

use std::iter::{once, successors};

use crash3::EnergyBasis;
use pim_core::{
    Approach, Contact, ImpactError, Law, Motion, NormalTangential, Outcome, Real, RestitutionCurve,
    Tangential, Vector2, normal_work,
};

use crate::brent::{MAX_STEPS, RootError, brent};
use crate::error::ReconcileError;

/// Where the cosine between heading and crush plane normal is below this, rounding of the angles decides what the speed does.
const LEAST_COSINE: f64 = 1e-9;

/// Relative distance in normal work within which a root counts as one: far above the root-finder's rounding, far below what any
/// measurement of crush resolves.
const ENERGY_MATCH: f64 = 1e-9;

/// (m/s) no vehicle is faster: beyond, a root is one of the equations alone.
pub const FASTEST: f64 = 1000.0;

/// Which vehicle's speed along its heading is sought.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// The speed of vehicle 1.
    Speed1,
    /// The speed of vehicle 2.
    Speed2,
}

impl Unknown {
    /// 0 or 1.
    #[inline(always)]
    #[must_use]
    pub fn index(self) -> usize {
        match self {
            Self::Speed1 => 0,
            Self::Speed2 => 1,
        }
    }

    /// Of both vehicles, what belongs to this one. An index would not be resolved in a loop over samples.
    #[inline(always)]
    fn of<V>(self, [one, two]: [V; 2]) -> V {
        match self {
            Self::Speed1 => one,
            Self::Speed2 => two,
        }
    }

    /// Both motions, this vehicle's velocity replaced.
    #[inline(always)]
    fn with_velocity<T: Real>(self, [one, two]: [Motion<T>; 2], velocity: Vector2<T>) -> [Motion<T>; 2] {
        match self {
            Self::Speed1 => [Motion { velocity, ..one }, two],
            Self::Speed2 => [one, Motion { velocity, ..two }],
        }
    }
}

/// A collision of which one speed is unknown and the crush energy is known.
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a, T = f64> {
    contact: Contact<T>,
    law: Law<T>,
    restitution: Option<&'a RestitutionCurve<T>>,
    motions: [Motion<T>; 2],
    unknown: Unknown,
    crush_energy: T,
    basis: EnergyBasis,
    line: ApproachLine<T>,
}

/// How the relative velocity at C depends on the approach speed x = −u_n: u = (−x, u_t), u_t affine in x.
#[derive(Clone, Copy, Debug)]
struct ApproachLine<T> {
    /// u at the speed s = 0.
    at_rest: NormalTangential<T>,
    /// ω_1 − ω_2, which the speed leaves alone.
    spin: T,
    /// du/ds.
    slope: NormalTangential<T>,
}

impl<T: Real> ApproachLine<T> {
    #[inline(always)]
    fn tangential_slope(&self) -> T {
        // du_t/dx = −w_t/w_n
        -self.slope.tangential / self.slope.normal
    }

    /// u_t at x = 0.
    #[inline(always)]
    fn tangential_at_touch(&self) -> T {
        // u_t(x) = u_t(s=0) − (x + u_n(s=0)) w_t/w_n
        self.at_rest.tangential + self.at_rest.normal * self.tangential_slope()
    }

    /// The approach at the approach speed x.
    #[inline(always)]
    fn at(&self, x: T) -> Approach<T> {
        let velocity = NormalTangential {
            normal: -x,
            tangential: self.tangential_at_touch() + x * self.tangential_slope(),
        };
        Approach { velocity, spin: self.spin }
    }

    /// s for the approach speed x.
    #[inline(always)]
    fn speed(&self, x: T) -> T {
        // s = −(x + u_n(s=0))/w_n
        -(x + self.at_rest.normal) / self.slope.normal
    }
}

/// The answer: the speed, and the impact that it makes.
#[derive(Clone, Copy, Debug)]
pub struct Reconciliation<T = f64> {
    /// (m/s) the speed found, along the vehicle's heading. Of several admissible speeds, the one with the slowest approach.
    pub speed: T,
    /// All admissible speeds.
    pub roots: Roots<T>,
    /// The law at the speed found: the given one, with the restitution of this closing speed where that varies.
    pub law: Law<T>,
    /// The impact at the speed found.
    pub outcome: Outcome<T>,
    /// (J) the normal work that was sought: the crush energy on the basis `dissipated`.
    pub normal_work: T,
    /// How the speed was found.
    pub method: Method,
}

/// (m/s) the admissible speeds, from the slowest approach to the fastest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roots<T = f64> {
    speeds: [T; ROOTS_KEPT],
    count: usize,
}

/// How many speeds [`Roots`] keeps; no law has more admissible ones with one coefficient of restitution.
const ROOTS_KEPT: usize = 4;

impl<T: Real> Roots<T> {
    fn none() -> Self {
        Self { speeds: [T::ZERO; ROOTS_KEPT], count: 0 }
    }

    fn push(&mut self, speed: T) {
        if let Some(place) = self.speeds.get_mut(self.count) {
            *place = speed;
        }
        self.count += 1;
    }

    /// How many there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// (m/s) the speeds; the first four where there are more.
    #[must_use]
    pub fn speeds(&self) -> &[T] {
        &self.speeds[..self.count.min(ROOTS_KEPT)]
    }
}

/// How a speed was found.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::large_enum_variant, reason = "a box would be an allocation")]
pub enum Method {
    /// W_n is quadratic in the speed.
    ClosedForm,
    /// Brent's method.
    RootFinder(Iterations),
}

/// One step of the root-finder.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Iteration {
    /// (m/s) speed tried.
    pub speed: f64,
    /// (J) W_n at that speed.
    pub normal_work: f64,
}

/// The steps that led to the speed found.
#[derive(Clone, Copy)]
pub struct Iterations {
    steps: [Iteration; MAX_STEPS],
    count: usize,
}

impl std::fmt::Debug for Iterations {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(self.as_slice()).finish()
    }
}

impl Iterations {
    fn none() -> Self {
        Self { steps: [Iteration::default(); MAX_STEPS], count: 0 }
    }

    fn push(&mut self, step: Iteration) {
        if let Some(place) = self.steps.get_mut(self.count) {
            *place = step;
            self.count += 1;
        }
    }

    /// The steps in the order in which they were made.
    #[must_use]
    pub fn as_slice(&self) -> &[Iteration] {
        &self.steps[..self.count]
    }
}

impl<'a, T: Real> Problem<'a, T> {
    /// The speed of `unknown` along its heading is to make W_n equal `crush_energy` (J, of both vehicles) on `basis`.
    /// The velocity that `motions` gives for that vehicle is not used; its yaw rate is.
    ///
    /// # Errors
    /// Where the crush energy is not positive, e = 1, or the speed has no effect on u_n.
    #[inline(always)]
    pub fn new(
        contact: Contact<T>,
        law: Law<T>,
        motions: [Motion<T>; 2],
        unknown: Unknown,
        crush_energy: T,
        basis: EnergyBasis,
    ) -> Result<Self, ReconcileError> {
        match Self::pose(contact, law, motions, unknown, crush_energy, basis) {
            (problem, true) => Ok(problem),
            (problem, false) => Err(problem.refusal()),
        }
    }

    /// The same without a reason, for loops over many samples: the problem, and whether it makes sense.
    #[inline(always)]
    #[must_use]
    pub fn pose(
        contact: Contact<T>,
        law: Law<T>,
        motions: [Motion<T>; 2],
        unknown: Unknown,
        crush_energy: T,
        basis: EnergyBasis,
    ) -> (Self, bool) {
        let motions = unknown.with_velocity(motions, Vector2::new(T::ZERO, T::ZERO));
        let Approach { velocity: at_rest, spin } = contact.approach(&motions);
        let participant = unknown.of(*contact.participants());
        // u is vehicle 1 relative to vehicle 2, so that vehicle 2's speed counts against it.
        let forward = contact.resolve(participant.forward());
        let slope = match unknown {
            Unknown::Speed1 => forward,
            Unknown::Speed2 => NormalTangential { normal: -forward.normal, tangential: -forward.tangential },
        };
        let line = ApproachLine { at_rest, spin, slope };
        let problem = Self { contact, law, restitution: None, motions, unknown, crush_energy, basis, line };
        let makes_sense = !participant.body().is_fixed()
            & (crush_energy > T::ZERO)
            & crush_energy.is_finite()
            & (law.restitution() != T::ONE)
            & (slope.normal.abs() >= T::from(LEAST_COSINE));
        (problem, makes_sense)
    }

    /// Why a problem makes no sense.
    #[cold]
    fn refusal(&self) -> ReconcileError {
        let vehicle = self.vehicle();
        let e = self.law.restitution();
        if self.unknown.of(*self.contact.participants()).body().is_fixed() {
            ReconcileError::Fixed { vehicle }
        } else if !(self.crush_energy > T::ZERO && self.crush_energy.is_finite()) {
            ReconcileError::NoCrushEnergy { energy: self.crush_energy.value() }
        } else if e == T::ONE {
            ReconcileError::NoRestitutionLoss { restitution: e.value() }
        } else {
            let forward = self.unknown.of(*self.contact.participants()).forward();
            let cosine = self.contact.resolve(forward).normal.value();
            ReconcileError::SpeedWithoutEffect { vehicle, cosine }
        }
    }

    /// The same problem with a restitution that depends on the closing speed, in place of the law's own; `None` leaves that. Only the root-finder
    /// solves a problem with a curve.
    #[must_use]
    pub fn with_restitution_curve(self, curve: impl Into<Option<&'a RestitutionCurve<T>>>) -> Self {
        Self { restitution: curve.into(), ..self }
    }

    /// (m/s) the speed at which the vehicles just touch: u_n = 0.
    #[must_use]
    pub fn touching_speed(&self) -> T {
        self.line.speed(T::ZERO)
    }

    /// (J) the normal work sought; under a curve of restitution, that for the law's own.
    #[must_use]
    pub fn normal_work_sought(&self) -> T {
        self.sought(&self.law)
    }

    /// The law at the approach speed x (m/s).
    #[inline(always)]
    fn law(&self, x: T) -> Law<T> {
        match self.restitution {
            None => self.law,
            Some(curve) => curve.law(self.law, x),
        }
    }

    /// (J) the normal work sought under a law.
    #[inline(always)]
    fn sought(&self, law: &Law<T>) -> T {
        self.basis.dissipated(self.crush_energy, law.restitution())
    }

    /// The motions before impact at the given speed (m/s) of the unknown.
    #[inline(always)]
    #[must_use]
    pub fn motions(&self, speed: T) -> [Motion<T>; 2] {
        let forward = self.unknown.of(*self.contact.participants()).forward();
        self.unknown.with_velocity(self.motions, forward * speed)
    }

    /// (J) W_n at the given speed (m/s), by the law's conditions alone: negative or not a number where no impact can
    /// happen.
    #[inline(always)]
    #[must_use]
    pub fn normal_work(&self, speed: T) -> T {
        let approach = self.contact.approach(&self.motions(speed));
        self.work_at(&self.law(-approach.velocity.normal), approach)
    }

    /// (J) what the normal work at the given speed (m/s) is above the one sought there: zero at every root. Its derivatives by an
    /// input p and by the speed are those of the root, ds/dp = −(∂/∂p)/(∂/∂s), whatever method found it.
    #[inline(always)]
    #[must_use]
    pub fn residual(&self, speed: T) -> T {
        let approach = self.contact.approach(&self.motions(speed));
        let law = self.law(-approach.velocity.normal);
        self.work_at(&law, approach) - self.sought(&law)
    }

    /// The impact at the given speed (m/s), and the law there.
    ///
    /// # Errors
    /// [`ImpactError`].
    #[inline(always)]
    pub fn impact(&self, speed: T) -> Result<(Law<T>, Outcome<T>), ImpactError> {
        let motions = self.motions(speed);
        let law = self.law(-self.contact.approach(&motions).velocity.normal);
        self.contact.impact(motions, &law).map(|outcome| (law, outcome))
    }

    #[inline(always)]
    fn work_at(&self, law: &Law<T>, approach: Approach<T>) -> T {
        let u = approach.velocity;
        let impulse = law.impulse(&self.contact.inverse_mass(), approach).linear;
        // The law's own condition: in a glancing contact u + K P would lose U_n in the rounding of K P.
        // U_n = −e u_n
        let separation = NormalTangential { normal: -(u.normal * law.restitution()), ..u };
        normal_work(u, impulse, separation)
    }

    /// The answer in closed form, or `None` where W_n is not quadratic in the speed: a friction limit may switch, and a fraction of μ_c makes
    /// it cubic.
    ///
    /// # Errors
    /// [`ReconcileError`].
    #[must_use]
    pub fn closed_form(&self) -> Option<Result<Reconciliation<T>, ReconcileError>> {
        if self.restitution.is_some() || !self.law.is_affine() {
            return None;
        }
        let approaches = self.approaches();
        let mut search = Search::new(self);
        for x in approaches.ascending() {
            search.consider(self.line.speed(x), Method::ClosedForm);
        }
        // A jam leaves no root at all: say so rather than that none was found.
        if approaches.ascending().next().is_none()
            && let Tangential::Ratio(_) = self.law.tangential()
        {
            let speed = self.line.speed(T::ONE);
            if let Err(jam @ ImpactError::Jam { .. }) = self.contact.impact(self.motions(speed), &self.law) {
                return Some(Err(jam.into()));
            }
        }
        Some(search.finish())
    }

    /// The speed with the slowest approach that the closed form gives, its impact, and whether a collision can be so: [`solve`](Problem::solve) without
    /// a reason, without a second speed and without a branch, for loops over many samples. Where it says yes, the answer has the same bits. It says no
    /// wherever `solve` may still find one: under a law that has no closed form, or at a faster approach.
    #[inline(always)]
    #[must_use]
    pub fn attempt(&self) -> (T, Outcome<T>, bool) {
        let x = self.approaches().slowest();
        let speed = self.line.speed(x);
        let (outcome, possible) = self.contact.attempt(self.motions(speed), &self.law);
        let has_closed_form = self.restitution.is_none() & self.law.is_affine();
        (speed, outcome, possible & has_closed_form & is_root(x) & !is_too_fast(speed))
    }

    /// Where W_n has the value sought, under a law without a limit.
    #[inline(always)]
    fn approaches(&self) -> Approaches<T> {
        // P_n(x) = α x + β
        let k = self.contact.inverse_mass();
        let push = |x: T| self.law.impulse(&k, self.line.at(x)).linear.normal;
        let beta = push(T::ZERO);
        let alpha = push(T::ONE) - beta;
        Approaches::new(alpha, beta, self.sought(&self.law), self.law.restitution())
    }

    fn vehicle(&self) -> usize {
        self.unknown.index() + 1
    }
}

/// The approach speeds x = −u_n at which W_n has the value sought; not numbers where there are none, and of no use where not positive.
struct Approaches<T>([T; 2]);

impl<T: Real> Approaches<T> {
    /// Where W_n = ½ (1−e) x P_n with P_n = α x + β.
    #[inline(always)]
    fn new(alpha: T, beta: T, energy: T, e: T) -> Self {
        // α x² + β x − c = 0,  c = 2 W_n/(1−e); since c > 0, x > 0 means P_n > 0
        let c = energy * 2.0 / (T::ONE - e);
        // q = −½ (β ± √…) with the sign that does not cancel; the roots are q/α and −c/q.
        let root = (beta * beta + alpha * c * 4.0).sqrt();
        let q = -(if beta < T::ZERO { beta - root } else { beta + root }) * 0.5;
        Self([q / alpha, -(c / q)])
    }

    /// Those that are positive, the least first.
    fn ascending(&self) -> impl Iterator<Item = T> {
        self.ordered().into_iter().filter(|x| is_root(*x))
    }

    /// The first of these, or something else where there is none.
    #[inline(always)]
    fn slowest(&self) -> T {
        let [a, b] = self.ordered();
        if is_root(a) { a } else { b }
    }

    #[inline(always)]
    fn ordered(&self) -> [T; 2] {
        let [a, b] = self.0;
        if b < a { [b, a] } else { [a, b] }
    }
}

/// Whether this is the approach speed of a collision.
#[inline(always)]
fn is_root<T: Real>(x: T) -> bool {
    (x > T::ZERO) & x.is_finite()
}

/// Whether a speed is one of the equations alone.
#[inline(always)]
fn is_too_fast<T: Real>(speed: T) -> bool {
    speed.abs() > T::from(FASTEST)
}

/// Judges the speeds that give the energy, in the order of their approach.
struct Search<'a, T> {
    problem: &'a Problem<'a, T>,
    first: Option<(T, Law<T>, Outcome<T>, Method)>,
    roots: Roots<T>,
    refused: Option<ReconcileError>,
}

impl<'a, T: Real> Search<'a, T> {
    fn new(problem: &'a Problem<'a, T>) -> Self {
        Self { problem, first: None, roots: Roots::none(), refused: None }
    }

    fn consider(&mut self, speed: T, method: Method) {
        if is_too_fast(speed) {
            return;
        }
        let problem = self.problem;
        match problem.impact(speed) {
            Ok((law, outcome)) => {
                self.roots.push(speed);
                if self.first.is_none() {
                    self.first = Some((speed, law, outcome, method));
                }
            }
            Err(reason) => {
                let vehicle = problem.vehicle();
                self.refused.get_or_insert(ReconcileError::Inadmissible {
                    vehicle,
                    speed: speed.value(),
                    reason,
                });
            }
        }
    }

    fn finish(self) -> Result<Reconciliation<T>, ReconcileError> {
        let problem = self.problem;
        match self.first {
            Some((speed, law, outcome, method)) => {
                let normal_work = problem.sought(&law);
                Ok(Reconciliation { speed, roots: self.roots, law, outcome, normal_work, method })
            }
            None => Err(self.refused.unwrap_or(ReconcileError::NotReached {
                vehicle: problem.vehicle(),
                energy: problem.sought(&problem.law).value(),
            })),
        }
    }
}

/// The scan of approach speeds goes from this share of the one that a frictionless impact would need …
const SCAN_START: f64 = 1.0 / 1024.0;
/// … by this factor, 2^¼, to 1024 times that speed, …
const SCAN: Scan = Scan { ratio: 1.189_207_115_002_721, samples: 81 };
/// … or by 2^¹⁄₃₂ where not every turn of W_n is among the borders.
const FINE_SCAN: Scan = Scan { ratio: 1.021_897_148_654_116_7, samples: 641 };
/// Both sides of a border between two regimes of a law are sampled at this relative distance from it: far above rounding.
const BORDER_WIDTH: f64 = 1e-12;
/// A turn of W_n between three samples is narrowed by thirds, (2/3)⁴⁴ ≈ 2⁻²⁶: there W_n is as high as at the turn itself but for rounding.
const TURN_STEPS: usize = 44;
struct Scan {
    ratio: f64,
    samples: usize,
}

/// How many borders a law has at most.
const BORDERS: usize = 6;

impl Problem<'_, f64> {
    /// The speed that reconciles impact and crush: in closed form where there is one, else by the root-finder.
    ///
    /// # Errors
    /// [`ReconcileError`].
    pub fn solve(&self) -> Result<Reconciliation, ReconcileError> {
        self.closed_form().unwrap_or_else(|| self.root_finder())
    }

    /// How near a problem without an answer comes to one, to tell beside [`ReconcileError::NotReached`]: of all impacts that can happen, that whose normal
    /// work is nearest to the one sought, by a scan of the approach speed.
    ///
    /// # Errors
    /// Why none can happen: the reason at the approach speed that a frictionless impact would need.
    pub fn nearest(&self) -> Result<Iteration, ImpactError> {
        // x² = 2 E k_nn
        let frictionless = (2.0 * self.crush_energy * self.contact.inverse_mass().nn).sqrt();
        // As a share, so that under a curve of restitution each speed is held against what is sought there.
        let miss = |x: f64| match self.impact(self.line.speed(x)) {
            Ok((law, outcome)) => (outcome.energy.normal_work / self.sought(&law) - 1.0).abs(),
            Err(_) => f64::INFINITY,
        };
        let scan = successors(Some(frictionless * SCAN_START), |x| Some(x * FINE_SCAN.ratio));
        let best = once(frictionless)
            .chain(scan.take(FINE_SCAN.samples))
            .min_by(|&a, &b| miss(a).total_cmp(&miss(b)))
            .unwrap_or(frictionless);
        let (mut low, mut high) = (best / FINE_SCAN.ratio, best * FINE_SCAN.ratio);
        for _ in 0..TURN_STEPS {
            let [left, right] = thirds(low, high);
            if miss(left) < miss(right) {
                high = right;
            } else {
                low = left;
            }
        }
        let speed = self.line.speed(if miss(low) < miss(best) { low } else { best });
        self.impact(speed).map(|(_, outcome)| Iteration { speed, normal_work: outcome.energy.normal_work })
    }

    /// The answer by root-finding alone, which serves every law.
    ///
    /// W_n − E is scanned outwards from the speed at which the vehicles just touch (u_n = 0, where W_n = 0), with both sides of
    /// every border at which the law's regime changes among the samples, and every turn of W_n. A change of sign is a bracket for Brent's method.
    ///
    /// Under a curve of restitution, and under a fraction of μ_c with a moment impulse, not all borders are known: the scan is finer, and where
    /// W_n − E comes nearest to zero between samples of one sign a change of sign is looked for, but two speeds nearer to each other than 2 % of the approach speed may stay unseen.
    ///
    /// # Errors
    /// [`ReconcileError`].
    pub fn root_finder(&self) -> Result<Reconciliation, ReconcileError> {
        let k = self.contact.inverse_mass();
        // x² = 2 E k_nn, E absorbed: whatever the restitution, the speed is of this size
        let share = self.dissipated_share()?;
        let absorbed = match self.basis {
            EnergyBasis::Absorbed => self.crush_energy,
            EnergyBasis::Dissipated => self.crush_energy / share,
        };
        let frictionless = (2.0 * absorbed * k.nn).sqrt();
        let missing = |x: f64| {
            let law = self.law(x);
            // Where the vehicles just touch no work is done, whatever the quotient of two zeros; and with e = 1 at no speed.
            if x == 0.0 || law.restitution() == 1.0 {
                return -self.crush_energy;
            }
            // As a crush energy on the basis: W_n, or W_n/(1−e²)
            self.work_at(&law, self.line.at(x)) / self.basis.dissipated(1.0, law.restitution())
                - self.crush_energy
        };

        let mut search = Search::new(self);
        let mut last = [(0.0, -self.crush_energy); 2];
        let sides = self.borders();
        // Under a curve of restitution the law is another one at each speed, and W_n has its kinks at the curve's points.
        let points = self.restitution.map(RestitutionCurve::points);
        let kinks = points.into_iter().flatten().map(|&(x, _)| x);
        let borders = if points.is_some() { &[][..] } else { &sides };
        let mut borders = kinks.chain(borders.iter().copied()).peekable();
        let mut next = frictionless * SCAN_START;
        let scan = if self.has_all_turns() { SCAN } else { FINE_SCAN };
        for _ in 0..scan.samples {
            // Whatever is not a number stands at either end of the order.
            while let Some(x) = borders.next_if(|&x| x < next || x.is_nan()) {
                // Nearer to zero a border is the rounding of one at zero.
                if x > last[1].0.max(frictionless * BORDER_WIDTH) {
                    self.between(&missing, &mut last, x, &mut search)?;
                }
            }
            self.between(&missing, &mut last, next, &mut search)?;
            next *= scan.ratio;
        }
        search.finish()
    }

    /// Whether [`borders`](Self::borders) has every turn of W_n.
    fn has_all_turns(&self) -> bool {
        let fraction = matches!(self.law.tangential(), Tangential::FractionOfCritical(_));
        self.restitution.is_none() && !(fraction && self.law.has_moment())
    }

    /// 1 − e², for a curve at its lowest restitution.
    fn dissipated_share(&self) -> Result<f64, ReconcileError> {
        let lowest = match self.restitution {
            None => self.law.restitution(),
            Some(curve) => curve.points().iter().map(|&(_, e)| e).fold(1.0, f64::min),
        };
        if lowest == 1.0 {
            return Err(ReconcileError::NoRestitutionLoss { restitution: lowest });
        }
        Ok(1.0 - lowest * lowest)
    }

    /// Both sides of the approach speeds at which the law's regime changes, jams or W_n turns, in ascending order; not a number or infinite
    /// where there is none. Those of one coefficient of restitution, without the turns of a fraction of μ_c with a moment impulse.
    fn borders(&self) -> [f64; 2 * BORDERS] {
        let k = self.contact.inverse_mass();
        let (unlimited, frictionless) = (self.law.without_limit(), self.law.with_ratio(0.0));
        let impulse = |law: &Law, x: f64| law.impulse(&k, self.line.at(x));
        // The part c_n P_n + c_t P_t of an impulse without a limit, which is affine in x.
        let part = |law: &Law, c_n: f64, c_t: f64| {
            affine(|x| {
                let p = impulse(law, x).linear;
                c_n * p.normal + c_t * p.tangential
            })
        };
        // W_n ∝ x P_n
        let turn = |law: &Law| {
            let [p0, p1] = part(law, 1.0, 0.0);
            zero([p0, 2.0 * p1])
        };
        let borders: [f64; BORDERS] = match self.law.tangential() {
            // Friction suffices from P_t = −limit P_n to P_t = limit P_n; beyond, it turns about where the sliding does.
            Tangential::Friction(limit) | Tangential::FullOrSliding(limit) => {
                let sliding = affine(|x| {
                    let free = impulse(&frictionless, x);
                    k.separation(self.line.at(x), free.linear, free.moment).velocity.tangential
                });
                [
                    zero(part(&unlimited, limit, 1.0)),
                    zero(part(&unlimited, -limit, 1.0)),
                    zero(sliding),
                    turn(&unlimited),
                    turn(&self.law.with_ratio(limit)),
                    turn(&self.law.with_ratio(-limit)),
                ]
            }
            // W_n ∝ x² P_n/Q with Q = k_nn P_n + f k_nt P_t: a push ends at P_n = 0, the contact jams at Q = 0, and W_n turns where
            // 2 P_n Q + x (P_n' Q − P_n Q') = 0. With a moment impulse it jams elsewhere; as a rule an impact beside a jam creates energy.
            Tangential::FractionOfCritical(f) => {
                let [p0, p1] = part(&unlimited, 1.0, 0.0);
                let [q0, q1] = part(&unlimited, k.nn, f * k.nt);
                let [low, high] = quadratic([2.0 * p0 * q0, 3.0 * p1 * q0 + p0 * q1, 2.0 * p1 * q1]);
                [zero([p0, p1]), zero([q0, q1]), low, high, f64::NAN, f64::NAN]
            }
            Tangential::Critical
            | Tangential::Ratio(_)
            | Tangential::VelocityChange(_)
            | Tangential::Restitution(_) => {
                [turn(&self.law), f64::NAN, f64::NAN, f64::NAN, f64::NAN, f64::NAN]
            }
        };
        let mut sides = [0.0; 2 * BORDERS];
        for (pair, border) in sides.chunks_exact_mut(2).zip(borders) {
            pair.copy_from_slice(&[border * (1.0 - BORDER_WIDTH), border * (1.0 + BORDER_WIDTH)]);
        }
        sides.sort_by(f64::total_cmp);
        sides
    }

    /// Considers the roots between the last sample and the next one at `x`, and those about the last one, where W_n may turn.
    fn between(
        &self,
        missing: &impl Fn(f64) -> f64,
        last: &mut [(f64, f64); 2],
        x: f64,
        search: &mut Search<'_, f64>,
    ) -> Result<(), ReconcileError> {
        let [before, low] = *last;
        let high = (x, missing(x));
        *last = [low, high];
        if opposite(low.1, high.1) {
            return self.bracketed(missing, [low.0, high.0], search);
        }
        let nearest = low.1.abs() < before.1.abs() && low.1.abs() <= high.1.abs();
        if nearest
            && !opposite(before.1, low.1)
            && !self.has_all_turns()
            && let Some(beyond) = past_zero(missing, before.0, high.0)
        {
            self.bracketed(missing, [before.0, beyond], search)?;
            self.bracketed(missing, [beyond, high.0], search)?;
        }
        Ok(())
    }

    fn bracketed(
        &self,
        missing: &impl Fn(f64) -> f64,
        bracket: [f64; 2],
        search: &mut Search<'_, f64>,
    ) -> Result<(), ReconcileError> {
        let mut iterations = Iterations::none();
        let observe = |x: f64, residual: f64| {
            let law = self.law(x);
            iterations.push(Iteration {
                speed: self.line.speed(x),
                normal_work: self.basis.dissipated(residual + self.crush_energy, law.restitution()),
            });
        };
        match brent(missing, bracket, 0.0, observe) {
            Ok(x) if missing(x).abs() <= self.crush_energy * ENERGY_MATCH => {
                search.consider(self.line.speed(x), Method::RootFinder(iterations));
                Ok(())
            }
            // The sign changed at a pole, where the contact jams.
            Ok(_) | Err(RootError::NotBracketed { .. }) => Ok(()),
            Err(RootError::NotConverged { residual, .. }) if !residual.is_finite() => Ok(()),
            Err(RootError::NotConverged { last, residual }) => {
                Err(ReconcileError::NotConverged { last: self.line.speed(last), residual })
            }
        }
    }
}

/// The function's value at 0 and its slope.
fn affine(f: impl Fn(f64) -> f64) -> [f64; 2] {
    let at_zero = f(0.0);
    [at_zero, f(1.0) - at_zero]
}

/// Where c₀ + c₁ x = 0.
fn zero([c0, c1]: [f64; 2]) -> f64 {
    -c0 / c1
}

/// The real roots of c₀ + c₁ x + c₂ x², not numbers where there are none.
fn quadratic([c0, c1, c2]: [f64; 3]) -> [f64; 2] {
    // q = −½ (c₁ ± √(c₁² − 4 c₀ c₂)) with the sign that does not cancel; the roots are q/c₂ and c₀/q
    let q = -0.5 * (c1 + (c1 * c1 - 4.0 * c0 * c2).sqrt().copysign(c1));
    [q / c2, c0 / q]
}

fn opposite(a: f64, b: f64) -> bool {
    (a < 0.0 && b >= 0.0) || (a >= 0.0 && b < 0.0)
}

fn thirds(a: f64, b: f64) -> [f64; 2] {
    [(2.0 * a + b) / 3.0, (a + 2.0 * b) / 3.0]
}

/// A point between `a` and `b`, where `f` has the same sign, at which it has the other one, if its turn towards zero reaches there.
fn past_zero(f: &impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> Option<f64> {
    let below = f(a) < 0.0;
    for _ in 0..TURN_STEPS {
        let [left, right] = thirds(a, b);
        let (f_left, f_right) = (f(left), f(right));
        if (f_left < 0.0) != below {
            return Some(left);
        }
        if (f_right < 0.0) != below {
            return Some(right);
        }
        if f_left.abs() < f_right.abs() {
            b = right;
        } else {
            a = left;
        }
    }
    None
}
