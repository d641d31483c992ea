//! W_n and the possibility of a collision, by a linear solve for the impulses P_n, P_t and M in generalised
//! coordinates.
//!
//! The two vehicles are six coordinates, q = (x₁, y₁, θ₁, x₂, y₂, θ₂), with the inverse masses m⁻¹ on the
//! diagonal of D. The rows of J give the relative velocity at C along n, along t and the relative yaw rate, u
//! = J q̇, so that U = u + J D Jᵀ (P_n, P_t, M).

use oracle::{arm, cross};
use pim_core::Tangential;
use reconcile::EnergyBasis;

use super::draws::Sought;

/// Number of quantities whose signs decide between regimes.
pub(crate) const SIGNALS: usize = 6;

/// Rounding: energy is created if E_L is below zero by more than this fraction of the exchanged energy.
const ENERGY_ROUNDING: f64 = 1e-12;

/// Nearer than this to a border, rounding decides on which side of it a collision is.
pub(crate) const UNDECIDED: f64 = 1e-9;

/// (m/s) the fastest speed of a vehicle.
pub(crate) const FASTEST: f64 = 1000.0;

type Triple = [f64; 3];

fn dot(a: Triple, b: Triple) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The sum of the absolute terms of [`dot`].
fn size(a: Triple, b: Triple) -> f64 {
    (a[0] * b[0]).abs() + (a[1] * b[1]).abs() + (a[2] * b[2]).abs()
}

/// Solves a·x = b by elimination with partial pivoting. Also returns det a relative to the product of the
/// sizes of the rows.
fn eliminate<const N: usize>(mut a: [[f64; N]; N], mut b: [f64; N]) -> ([f64; N], f64) {
    let mut determinant = 1.0;
    for (row, b) in a.iter_mut().zip(&mut b) {
        let size = row.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        row.iter_mut().for_each(|x| *x /= size);
        *b /= size;
    }
    for i in 0..N {
        let mut pivot = i;
        for row in i + 1..N {
            if a[row][i].abs() > a[pivot][i].abs() {
                pivot = row;
            }
        }
        if pivot != i {
            a.swap(i, pivot);
            b.swap(i, pivot);
            determinant = -determinant;
        }
        determinant *= a[i][i];
        for row in i + 1..N {
            let factor = a[row][i] / a[i][i];
            let above = a[i];
            for (entry, above) in a[row].iter_mut().zip(above).skip(i) {
                *entry -= factor * above;
            }
            b[row] -= factor * b[i];
        }
    }
    for i in (0..N).rev() {
        for column in i + 1..N {
            b[i] -= a[i][column] * b[column];
        }
        b[i] /= a[i][i];
    }
    (b, determinant)
}

/// The tangential condition of one solve.
#[derive(Clone, Copy)]
enum Row {
    /// The change U_t − u_t is given.
    Change,
    /// P_t = μ P_n.
    Ratio(f64),
}

/// The impulses that meet the conditions, linear in the required U_n − u_n, U_t − u_t and ω₁ − ω₂.
#[derive(Clone, Copy)]
struct Response {
    rows: [Triple; 3],
    /// Determinants of the two conditions on P, and of these with Ω₁ = Ω₂: zero if the contact jams.
    determinants: [f64; 2],
}

impl Response {
    fn to(&self, asked: Triple) -> Triple {
        self.rows.map(|row| dot(row, asked))
    }
}

/// A collision at one approach speed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct State {
    pub(crate) restitution: f64,
    /// u_n, u_t and ω₁ − ω₂.
    pub(crate) before: Triple,
    /// P_n, P_t and M.
    pub(crate) impulse: Triple,
    /// Size of the terms of P_n relative to P_n.
    growth: f64,
    pub(crate) signals: [f64; SIGNALS],
    /// The smallest of the numbers that must not be zero, relative to its terms.
    jam: f64,
    /// For a fraction of μ_c: the P_n that gives μ_c, relative to its terms.
    critical: Option<f64>,
}

/// Whether such a collision is possible.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Judgement {
    Possible,
    Impossible,
    Undecided,
}

pub(crate) struct Engine {
    /// J D Jᵀ.
    compliance: [Triple; 3],
    /// u at the speed 0, and its change per m/s.
    at_rest: Triple,
    pub(crate) slope: Triple,
    /// (m/s) the size of the terms of u.
    pub(crate) size: f64,
    sought: Sought,
    full: Response,
    free: Response,
    /// With P_t = μ P_n and P_t = −μ P_n.
    with_ratio: [Response; 2],
}

impl Engine {
    pub(crate) fn new(sought: &Sought) -> Self {
        let scene = &sought.scene;
        let [r1, r2] = scene.cars.map(|car| arm(&car));
        let (sin, cos) = scene.crush_plane.sin_cos();
        // n from vehicle 2 towards vehicle 1.
        let towards = if (r2[0] - r1[0]) * cos + (r2[1] - r1[1]) * sin > 0.0 { 1.0 } else { -1.0 };
        let n = [towards * cos, towards * sin];
        let t = [-n[1], n[0]];
        let along = |a: [f64; 2]| [a[0], a[1], cross(r1, a), -a[0], -a[1], -cross(r2, a)];
        let jacobian = [along(n), along(t), [0.0, 0.0, 1.0, 0.0, 0.0, -1.0]];
        let [w1, w2] = scene.cars.map(|car| [car.inverse_mass(), car.inverse_yaw_inertia()]);
        let inverse = [w1[0], w1[0], w1[1], w2[0], w2[0], w2[1]];
        let compliance =
            jacobian.map(|a| jacobian.map(|b| (0..6).map(|i| a[i] * inverse[i] * b[i]).sum::<f64>()));

        let [c1, c2] = scene.cars;
        let moving = sought.unknown.index();
        let forward = [scene.cars[moving].heading.cos(), scene.cars[moving].heading.sin()];
        let mut rates =
            [c1.velocity[0], c1.velocity[1], c1.yaw_rate, c2.velocity[0], c2.velocity[1], c2.yaw_rate];
        let mut unit = [0.0; 6];
        for i in 0..2 {
            rates[3 * moving + i] = 0.0;
            unit[3 * moving + i] = forward[i];
        }
        let resolve = |rates: [f64; 6]| jacobian.map(|row| (0..6).map(|i| row[i] * rates[i]).sum::<f64>());
        let size =
            (0..6).map(|i| (jacobian[0][i] * rates[i]).abs() + (jacobian[1][i] * rates[i]).abs()).sum();
        let nothing = Response { rows: [[0.0; 3]; 3], determinants: [1.0; 2] };
        let mut engine = Self {
            compliance,
            at_rest: resolve(rates),
            slope: resolve(unit),
            size,
            sought: sought.clone(),
            full: nothing,
            free: nothing,
            with_ratio: [nothing; 2],
        };
        let limit = match scene.tangential {
            Tangential::Friction(mu) | Tangential::FullOrSliding(mu) | Tangential::Ratio(mu) => mu,
            _ => 0.0,
        };
        engine.full = engine.response(Row::Change);
        engine.free = engine.response(Row::Ratio(0.0));
        engine.with_ratio = [limit, -limit].map(|mu| engine.response(Row::Ratio(mu)));
        engine
    }

    /// The impulses under one tangential condition as functions of the required changes.
    fn response(&self, row: Row) -> Response {
        let mut determinants = [1.0; 2];
        let columns = [0, 1, 2].map(|i| {
            let mut asked = [0.0; 3];
            asked[i] = 1.0;
            let (impulse, of) = self.solve(row, asked);
            determinants = of;
            impulse
        });
        Response { rows: [0, 1, 2].map(|i| [0, 1, 2].map(|j| columns[j][i])), determinants }
    }

    /// The impulses for U_n − u_n, U_t − u_t (unless the ratio is given) and ω₁ − ω₂.
    fn solve(&self, row: Row, [normal, tangential, spin]: Triple) -> (Triple, [f64; 2]) {
        let [along_n, along_t, turning] = self.compliance;
        // The coefficient of P_n is one, so that the determinant for a ratio is that of k_nn + μ k_nt.
        let (condition, value) = match row {
            Row::Change => (along_t, tangential),
            Row::Ratio(mu) => ([-mu, 1.0, 0.0], 0.0),
        };
        let moment_restitution = self.sought.scene.moment;
        let (moment, common) = if moment_restitution == -1.0 {
            (0.0, 1.0)
        } else {
            // M_c: Ω₁ = Ω₂
            let ([_, _, m], of) = eliminate([along_n, condition, turning], [normal, value, -spin]);
            // M = (1 + e_m) M_c
            ((1.0 + moment_restitution) * m, of)
        };
        let block = [[along_n[0], along_n[1]], [condition[0], condition[1]]];
        let (linear, of) = eliminate(block, [normal - moment * along_n[2], value - moment * condition[2]]);
        ([linear[0], linear[1], moment], [of, common])
    }

    /// (m/s) the speed at an approach speed x.
    pub(crate) fn speed(&self, x: f64) -> f64 {
        // −x = u_n = u_n(0) + s w_n
        -(x + self.at_rest[0]) / self.slope[0]
    }

    pub(crate) fn approach_speed(&self, speed: f64) -> f64 {
        -(self.at_rest[0] + speed * self.slope[0])
    }

    pub(crate) fn curve(&self) -> &[(f64, f64)] {
        &self.sought.curve
    }

    pub(crate) fn state(&self, x: f64) -> State {
        let e = self.sought.restitution(x);
        let speed = self.speed(x);
        let before = [-x, self.at_rest[1] + speed * self.slope[1], self.at_rest[2]];
        // U_n − u_n = −(1+e) u_n
        let asked = |change: f64| [(1.0 + e) * x, change, before[2]];
        let mut signals = [1.0; SIGNALS];
        let mut critical = None;
        let state = |response: &Response, asked: Triple| State {
            restitution: e,
            before,
            impulse: response.to(asked),
            growth: size(response.rows[0], asked) / dot(response.rows[0], asked).abs(),
            signals: [0.0; SIGNALS],
            jam: response.determinants.iter().fold(1.0, |least: f64, of| least.min(of.abs())),
            critical: None,
        };
        let to_stop = asked(-before[1]);
        let mut state = match self.sought.scene.tangential {
            Tangential::Critical => state(&self.full, to_stop),
            Tangential::VelocityChange(change) => state(&self.full, asked(change)),
            Tangential::Restitution(e_t) => state(&self.full, asked(-(1.0 + e_t) * before[1])),
            Tangential::Ratio(_) => state(&self.with_ratio[0], asked(0.0)),
            Tangential::FractionOfCritical(f) if f > 0.0 => {
                let full = self.full.to(to_stop);
                critical = Some(full[0] / size(self.full.rows[0], to_stop));
                let response = self.response(Row::Ratio(f * full[1] / full[0]));
                [signals[2], signals[3], signals[4]] =
                    [full[0], response.determinants[0], response.determinants[1]];
                state(&response, asked(0.0))
            }
            // A fraction of 0 means no friction, whatever μ_c.
            Tangential::FractionOfCritical(_) => state(&self.free, asked(0.0)),
            Tangential::Friction(limit) | Tangential::FullOrSliding(limit) => {
                let asked_full = if let Tangential::Friction(_) = self.sought.scene.tangential {
                    to_stop
                } else {
                    asked(-(1.0 + e) * before[1])
                };
                let full = self.full.to(asked_full);
                // The sliding that would remain without friction.
                let free = before[1] + dot(self.compliance[1], self.free.to(asked(0.0)));
                [signals[2], signals[3], signals[4], signals[5]] =
                    [full[0], full[1] - limit * full[0], full[1] + limit * full[0], free];
                if full[0] > 0.0 && full[1].abs() <= limit * full[0] {
                    state(&self.full, asked_full)
                } else {
                    // Friction opposes it.
                    state(&self.with_ratio[usize::from(free > 0.0)], asked(0.0))
                }
            }
        };
        signals[0] = state.impulse[0];
        signals[1] = if e < 1.0 { 1.0 } else { -1.0 };
        state.signals = signals;
        state.critical = critical;
        state
    }

    /// (J) the crush energy of this collision on the basis: W_n, or W_n/(1−e²).
    pub(crate) fn energy(&self, x: f64, state: &State) -> f64 {
        let e = state.restitution;
        if e == 1.0 {
            return 0.0;
        }
        match self.sought.basis {
            // W_n = −½ P_n (u_n + U_n) = ½ (1−e) x P_n
            EnergyBasis::Dissipated => 0.5 * (1.0 - e) * x * state.impulse[0],
            // W_n/(1−e²) = ½ x P_n/(1+e)
            EnergyBasis::Absorbed => 0.5 * x * state.impulse[0] / (1.0 + e),
        }
    }

    /// E_L and the energy that the impulses exchange.
    pub(crate) fn loss(&self, state: &State) -> [f64; 2] {
        let after = [0, 1, 2].map(|i| state.before[i] + dot(self.compliance[i], state.impulse));
        // E_L = −½ Σ P (u + U)
        let loss = (0..3).map(|i| -0.5 * state.impulse[i] * (state.before[i] + after[i])).sum();
        let exchanged =
            (0..3).map(|i| state.impulse[i].abs() * (state.before[i].abs() + after[i].abs())).sum();
        [loss, exchanged]
    }

    pub(crate) fn judge(&self, x: f64, state: &State) -> Judgement {
        let [loss, exchanged] = self.loss(state);
        let fastest = self.speed(x).abs() / FASTEST - 1.0;
        let critical = state.critical.unwrap_or(1.0);
        let possible = x > 0.0
            && state.impulse[0] > 0.0
            && critical > 0.0
            && fastest <= 0.0
            && loss >= -exchanged * ENERGY_ROUNDING;
        let by_far = (state.impulse[0] <= 0.0 && state.growth < 1.0 / UNDECIDED)
            || critical < -UNDECIDED
            || fastest > UNDECIDED
            || loss < -exchanged * UNDECIDED;
        if by_far {
            return Judgement::Impossible;
        }
        let near = critical.abs() < UNDECIDED
            || fastest.abs() < UNDECIDED
            || state.growth > 1.0 / UNDECIDED
            || state.jam < UNDECIDED
            // Without friction and with e = 1 no energy is exchanged at all.
            || (loss < exchanged * UNDECIDED && loss != 0.0);
        match (near, possible) {
            (true, _) => Judgement::Undecided,
            (false, true) => Judgement::Possible,
            (false, false) => Judgement::Impossible,
        }
    }
}
