//! The speed at which the work of the normal impulse equals the crush energy.

use crash3::EnergyBasis;
use pim_core::{
    Contact, InverseMass, Law, Motion, NormalTangential, Outcome, Real, Tangential, Vector2, normal_work,
};

use crate::brent::{MAX_STEPS, RootError, brent};
use crate::error::ReconcileError;

/// Where the cosine between heading and crush plane normal is below this, rounding of the angles decides what the speed does.
const LEAST_COSINE: f64 = 1e-9;

/// Relative distance in normal work within which a root counts as one: far above the root-finder's rounding, far below what any
/// measurement of crush resolves.
const ENERGY_MATCH: f64 = 1e-9;

/// (m/s) no vehicle is faster: beyond, a root is one of the equations alone.
const FASTEST: f64 = 1000.0;

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
    #[must_use]
    pub fn index(self) -> usize {
        match self {
            Self::Speed1 => 0,
            Self::Speed2 => 1,
        }
    }
}

/// A collision of which one speed is unknown and the crush energy is known.
#[derive(Clone, Copy, Debug)]
pub struct Problem<T = f64> {
    contact: Contact<T>,
    law: Law<T>,
    motions: [Motion<T>; 2],
    unknown: Unknown,
    energy: T,
    line: ApproachLine<T>,
}

/// How the relative velocity at C depends on the approach speed x = −u_n: u = (−x, u_t), u_t affine in x.
#[derive(Clone, Copy, Debug)]
struct ApproachLine<T> {
    /// u at the speed s = 0.
    at_rest: NormalTangential<T>,
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

    /// u for the approach speed x.
    #[inline(always)]
    fn velocity(&self, x: T) -> NormalTangential<T> {
        NormalTangential { normal: -x, tangential: self.tangential_at_touch() + x * self.tangential_slope() }
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
#[derive(Clone, Copy, Debug)]
pub struct Iterations {
    steps: [Iteration; MAX_STEPS],
    count: usize,
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

impl<T: Real> Problem<T> {
    /// The speed of `unknown` along its heading is to make W_n equal `crush_energy` (J, of both vehicles) on `basis`.
    /// The velocity that `motions` gives for that vehicle is not used; its yaw rate is.
    ///
    /// # Errors
    /// Where the crush energy is not positive, e = 1, or the speed has no effect on u_n.
    pub fn new(
        contact: Contact<T>,
        law: Law<T>,
        mut motions: [Motion<T>; 2],
        unknown: Unknown,
        crush_energy: T,
        basis: EnergyBasis,
    ) -> Result<Self, ReconcileError> {
        let vehicle = unknown.index() + 1;
        let participant = contact.participants()[unknown.index()];
        if participant.body().is_fixed() {
            return Err(ReconcileError::Fixed { vehicle });
        }
        if !(crush_energy > T::ZERO && crush_energy.is_finite()) {
            return Err(ReconcileError::NoCrushEnergy { energy: crush_energy.value() });
        }
        let e = law.restitution();
        if e == T::ONE {
            return Err(ReconcileError::NoRestitutionLoss { restitution: e.value() });
        }
        motions[unknown.index()].velocity = Vector2::new(T::ZERO, T::ZERO);
        let at_rest = contact.relative_velocity(&motions);
        // u is vehicle 1 relative to vehicle 2, so that vehicle 2's speed counts against it.
        let forward = contact.resolve(participant.forward());
        let slope = match unknown {
            Unknown::Speed1 => forward,
            Unknown::Speed2 => NormalTangential { normal: -forward.normal, tangential: -forward.tangential },
        };
        if slope.normal.abs() < T::from(LEAST_COSINE) {
            return Err(ReconcileError::SpeedWithoutEffect { vehicle, cosine: forward.normal.value() });
        }
        Ok(Self {
            contact,
            law,
            motions,
            unknown,
            energy: basis.dissipated(crush_energy, e),
            line: ApproachLine { at_rest, slope },
        })
    }

    /// (J) the normal work sought.
    #[must_use]
    pub fn normal_work_sought(&self) -> T {
        self.energy
    }

    /// The motions before impact at the given speed (m/s) of the unknown.
    #[inline(always)]
    #[must_use]
    pub fn motions(&self, speed: T) -> [Motion<T>; 2] {
        let mut motions = self.motions;
        let i = self.unknown.index();
        motions[i].velocity = self.contact.participants()[i].forward() * speed;
        motions
    }

    /// (J) W_n at the given speed (m/s), by the law's conditions alone: negative or not a number where no impact can
    /// happen.
    #[inline(always)]
    #[must_use]
    pub fn normal_work(&self, speed: T) -> T {
        self.work_at(self.contact.relative_velocity(&self.motions(speed)))
    }

    #[inline(always)]
    fn work_at(&self, u: NormalTangential<T>) -> T {
        let impulse = self.law.impulse(self.contact.inverse_mass(), u);
        // The law's own condition: in a glancing contact u + K P would lose U_n in the rounding of K P.
        // U_n = −e u_n
        let separation = NormalTangential { normal: -(u.normal * self.law.restitution()), ..u };
        normal_work(u, impulse, separation)
    }

    /// The answer in closed form, or `None` where W_n is not quadratic in the speed: a friction limit may switch, and a fraction of μ_c makes
    /// it cubic.
    ///
    /// # Errors
    /// [`ReconcileError`].
    #[must_use]
    pub fn closed_form(&self) -> Option<Result<Reconciliation<T>, ReconcileError>> {
        let k = self.contact.inverse_mass();
        let approaches = match self.law.tangential() {
            Tangential::Critical => Approaches::common_tangential(k, &self.law, &self.line, self.energy),
            Tangential::Ratio(mu) => Approaches::given_ratio(k, &self.law, mu, self.energy),
            Tangential::FractionOfCritical(_) | Tangential::Friction(_) => return None,
        };
        let mut search = Search::new(self);
        for x in approaches.ascending() {
            search.consider(self.line.speed(x), Method::ClosedForm);
        }
        // A jam leaves no root at all: say so rather than that none was found.
        if approaches.count == 0
            && let Tangential::Ratio(_) = self.law.tangential()
        {
            let speed = self.line.speed(T::ONE);
            if let Err(jam) = self.contact.impact(self.motions(speed), &self.law) {
                return Some(Err(jam.into()));
            }
        }
        Some(search.finish())
    }

    fn vehicle(&self) -> usize {
        self.unknown.index() + 1
    }
}

/// The approach speeds x = −u_n > 0 at which W_n has the value sought.
struct Approaches<T> {
    values: [T; 2],
    count: usize,
}

impl<T: Real> Approaches<T> {
    /// W_n = ½ (1−e²) x² / (k_nn + μ k_nt) with μ given.
    #[inline(always)]
    fn given_ratio(k: InverseMass<T>, law: &Law<T>, mu: T, energy: T) -> Self {
        let e = law.restitution();
        // x² = 2 W_n (k_nn + μ k_nt) / (1−e²); the root with u_n > 0 is no approach
        let square = energy * 2.0 * (k.nn + mu * k.nt) / (T::ONE - e * e);
        if square > T::ZERO { Self::one(square.sqrt()) } else { Self::none() }
    }

    /// W_n = ½ (1−e) x P_n with P_n = (α x + β)/det K, affine in x.
    #[inline(always)]
    fn common_tangential(k: InverseMass<T>, law: &Law<T>, line: &ApproachLine<T>, energy: T) -> Self {
        let e = law.restitution();
        // P_n det K = −D = (1+e) x k_tt + u_t(x) k_nt = α x + β
        let alpha = (e + 1.0) * k.tt + line.tangential_slope() * k.nt;
        let beta = line.tangential_at_touch() * k.nt;
        // α x² + β x − c = 0,  c = 2 W_n det K / (1−e); since c > 0, x > 0 means P_n > 0
        let c = energy * 2.0 * k.determinant() / (T::ONE - e);
        let discriminant = beta * beta + alpha * c * 4.0;
        if discriminant < T::ZERO {
            return Self::none();
        }
        // q = −½ (β ± √…) with the sign that does not cancel; the roots are q/α and −c/q.
        let root = discriminant.sqrt();
        let q = -(if beta < T::ZERO { beta - root } else { beta + root }) * 0.5;
        let mut approaches = Self::none();
        for x in [q / alpha, -c / q] {
            if x > T::ZERO && x.is_finite() {
                approaches.push(x);
            }
        }
        approaches
    }

    fn none() -> Self {
        Self { values: [T::ZERO; 2], count: 0 }
    }

    fn one(x: T) -> Self {
        Self { values: [x; 2], count: 1 }
    }

    fn push(&mut self, x: T) {
        self.values[self.count] = x;
        self.count += 1;
        if self.count == 2 && self.values[1] < self.values[0] {
            self.values.swap(0, 1);
        }
    }

    fn ascending(&self) -> impl Iterator<Item = T> {
        self.values.into_iter().take(self.count)
    }
}

/// Judges the speeds that give the energy, in the order of their approach.
struct Search<'a, T> {
    problem: &'a Problem<T>,
    first: Option<(T, Outcome<T>, Method)>,
    roots: Roots<T>,
    refused: Option<ReconcileError>,
}

impl<'a, T: Real> Search<'a, T> {
    fn new(problem: &'a Problem<T>) -> Self {
        Self { problem, first: None, roots: Roots::none(), refused: None }
    }

    fn consider(&mut self, speed: T, method: Method) {
        if speed.abs() > T::from(FASTEST) {
            return;
        }
        let problem = self.problem;
        match problem.contact.impact(problem.motions(speed), &problem.law) {
            Ok(outcome) => {
                self.roots.push(speed);
                if self.first.is_none() {
                    self.first = Some((speed, outcome, method));
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
            Some((speed, outcome, method)) => {
                Ok(Reconciliation { speed, roots: self.roots, outcome, normal_work: problem.energy, method })
            }
            None => Err(self.refused.unwrap_or(ReconcileError::NotReached {
                vehicle: problem.vehicle(),
                energy: problem.energy.value(),
            })),
        }
    }
}

/// The scan of approach speeds goes from this share of the one that a frictionless impact would need …
const SCAN_START: f64 = 1.0 / 1024.0;
/// … by this factor, 2^¼, …
const SCAN_RATIO: f64 = 1.189_207_115_002_721;
/// … to 1024 times that speed.
const SCAN_SAMPLES: usize = 81;
/// Both sides of a border between two regimes of a law are sampled at this relative distance from it: far above rounding.
const BORDER_WIDTH: f64 = 1e-12;

impl Problem<f64> {
    /// The speed that reconciles impact and crush: in closed form where there is one, else by the root-finder.
    ///
    /// # Errors
    /// [`ReconcileError`].
    pub fn solve(&self) -> Result<Reconciliation, ReconcileError> {
        self.closed_form().unwrap_or_else(|| self.root_finder())
    }

    /// The answer by root-finding alone, which serves every law.
    ///
    /// W_n − E is scanned outwards from the speed at which the vehicles just touch (u_n = 0, where W_n = 0), with both sides of
    /// every border at which the law's regime changes among the samples: between two of them W_n is smooth. A change of sign is a bracket for
    /// Brent's method, and so is each side of a maximum between two samples that reaches E.
    ///
    /// # Errors
    /// [`ReconcileError`].
    pub fn root_finder(&self) -> Result<Reconciliation, ReconcileError> {
        let k = self.contact.inverse_mass();
        let e = self.law.restitution();
        let frictionless = (2.0 * self.energy * k.nn / (1.0 - e * e)).sqrt();
        // Where the vehicles just touch no work is done, whatever the quotient of two zeros.
        let missing =
            |x: f64| if x == 0.0 { -self.energy } else { self.work_at(self.line.velocity(x)) - self.energy };

        let mut search = Search::new(self);
        let mut last = (0.0, -self.energy);
        let mut borders = self.borders().into_iter().peekable();
        let mut next = frictionless * SCAN_START;
        for _ in 0..SCAN_SAMPLES {
            // Whatever is not a number stands at either end of the order.
            while let Some(x) = borders.next_if(|&x| x < next || x.is_nan()) {
                // Nearer to zero a border is the rounding of one at zero.
                if x > last.0.max(frictionless * BORDER_WIDTH) {
                    self.between(&missing, &mut last, x, &mut search)?;
                }
            }
            self.between(&missing, &mut last, next, &mut search)?;
            next *= SCAN_RATIO;
        }
        search.finish()
    }

    /// Both sides of the approach speeds at which the law's regime changes or W_n turns, in ascending order; not a number or infinite where
    /// there is none. Between two of them W_n is monotonic.
    fn borders(&self) -> [f64; 8] {
        let sticking = self.law.with_common_tangential_velocity();
        let k = self.contact.inverse_mass();
        let [touch, one] = [0.0, 1.0].map(|x| sticking.impulse(k, self.line.velocity(x)));
        // The impulse that would make the tangential velocities equal is affine in x, and so is each part c_n P_n + c_t P_t of it.
        let part = |c_n: f64, c_t: f64| {
            let at_touch = c_n * touch.normal + c_t * touch.tangential;
            [at_touch, c_n * one.normal + c_t * one.tangential - at_touch]
        };
        let zero = |[p0, p1]: [f64; 2]| -p0 / p1;
        let [p0, p1] = part(1.0, 0.0);
        let [a, b, c, d] = match self.law.tangential() {
            // Friction holds the surfaces together from P_t = −limit P_n to P_t = limit P_n, and there W_n ∝ x P_n.
            Tangential::Friction(limit) => {
                [zero(part(limit, 1.0)), zero(part(-limit, 1.0)), zero([p0, 2.0 * p1]), f64::NAN]
            }
            // W_n ∝ x² P_n/Q with Q = k_nn P_n + f k_nt P_t: a push ends at P_n = 0, the contact jams at Q = 0, and W_n turns where
            // 2 P_n Q + x (P_n' Q − P_n Q') = 0.
            Tangential::FractionOfCritical(f) => {
                let [q0, q1] = part(k.nn, f * k.nt);
                let [low, high] = quadratic([2.0 * p0 * q0, 3.0 * p1 * q0 + p0 * q1, 2.0 * p1 * q1]);
                [zero([p0, p1]), zero([q0, q1]), low, high]
            }
            Tangential::Critical | Tangential::Ratio(_) => [f64::NAN; 4],
        };
        let (before, after) = (1.0 - BORDER_WIDTH, 1.0 + BORDER_WIDTH);
        let mut sides =
            [a * before, a * after, b * before, b * after, c * before, c * after, d * before, d * after];
        sides.sort_by(f64::total_cmp);
        sides
    }

    /// Considers the roots between the last sample and the next one at `x`.
    fn between(
        &self,
        missing: &impl Fn(f64) -> f64,
        last: &mut (f64, f64),
        x: f64,
        search: &mut Search<'_, f64>,
    ) -> Result<(), ReconcileError> {
        let (low, high) = (*last, (x, missing(x)));
        *last = high;
        if opposite(low.1, high.1) {
            self.bracketed(missing, [low.0, high.0], search)
        } else if let Some(top) = hump(missing, [low, high]) {
            self.bracketed(missing, [low.0, top], search)?;
            self.bracketed(missing, [top, high.0], search)
        } else {
            Ok(())
        }
    }

    fn bracketed(
        &self,
        missing: &impl Fn(f64) -> f64,
        bracket: [f64; 2],
        search: &mut Search<'_, f64>,
    ) -> Result<(), ReconcileError> {
        let mut iterations = Iterations::none();
        let observe = |x: f64, residual: f64| {
            iterations.push(Iteration { speed: self.line.speed(x), normal_work: residual + self.energy });
        };
        match brent(missing, bracket, 0.0, observe) {
            Ok(x) if missing(x).abs() <= self.energy * ENERGY_MATCH => {
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

/// The real roots of c₀ + c₁ x + c₂ x², not numbers where there are none.
fn quadratic([c0, c1, c2]: [f64; 3]) -> [f64; 2] {
    // q = −½ (c₁ ± √(c₁² − 4 c₀ c₂)) with the sign that does not cancel; the roots are q/c₂ and c₀/q
    let q = -0.5 * (c1 + (c1 * c1 - 4.0 * c0 * c2).sqrt().copysign(c1));
    [q / c2, c0 / q]
}

fn opposite(a: f64, b: f64) -> bool {
    (a < 0.0 && b >= 0.0) || (a >= 0.0 && b < 0.0)
}

/// A point between two samples below zero at which `f` is not, by golden section; `None` where there is none, or where a parabola
/// through both and their middle has no maximum. Between the borders W_n has one maximum at most, and while the vehicles push no minimum.
fn hump(f: &impl Fn(f64) -> f64, [low, high]: [(f64, f64); 2]) -> Option<f64> {
    let middle = 0.5 * (low.0 + high.0);
    let f_middle = f(middle);
    // The parabola's slopes at both ends, times the distance between them: −3f₀ + 4f_½ − f₁ and f₀ − 4f_½ + 3f₁.
    let rises = 4.0 * f_middle - 3.0 * low.1 - high.1 > 0.0;
    let falls = low.1 - 4.0 * f_middle + 3.0 * high.1 < 0.0;
    if !(low.1 < 0.0 && rises && falls) {
        return None;
    }
    let inverse_golden = (5_f64.sqrt() - 1.0) / 2.0;
    let (mut a, mut b) = (low.0, high.0);
    let mut best = (middle, f_middle);
    while best.1 < 0.0 && b - a > f64::EPSILON.sqrt() * b {
        let (left, right) = (b - (b - a) * inverse_golden, a + (b - a) * inverse_golden);
        let (f_left, f_right) = (f(left), f(right));
        if f_left > f_right {
            b = right;
            best = (left, f_left);
        } else {
            a = left;
            best = (right, f_right);
        }
    }
    (best.1 >= 0.0).then_some(best.0)
}
