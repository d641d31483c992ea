//! All speeds of one collision, by a dense scan of its approach speed.

use super::draws::{Draws, Sought};
use super::engine::{Engine, FASTEST, Judgement, SIGNALS, State, UNDECIDED};

/// Number of samples on a geometric and on a linear grid over all speeds, and between two knots of a curve.
const GEOMETRIC: u32 = 10_000;
const LINEAR: u32 = 10_000;
const BETWEEN_KNOTS: u32 = 64;
/// The least approach speed of the geometric grid, relative to the greatest.
const LEAST: f64 = 1e-8;
/// Relative distance of the samples on both sides of a knot.
const BESIDE: f64 = 1e-12;
/// Number of samples on each side of a border, each four times nearer to it than the one before.
const CLUSTER: i32 = 16;
/// A sign change is a root if the energy is met to this relative accuracy, otherwise a jump or a pole.
const MET: f64 = 1e-6;
/// Relative distance below which rounding cannot distinguish two roots.
const APART: f64 = 1e-7;
/// Number of golden sections: 0.618⁶⁰ ≈ 3e-13.
const SECTIONS: usize = 60;

#[derive(Clone, Copy, Debug)]
struct Sample {
    x: f64,
    /// The crush energy of the collision at this speed.
    energy: f64,
    signals: [f64; SIGNALS],
}

impl Sample {
    fn is_in_regime_of(&self, other: &Self) -> bool {
        self.signals.iter().zip(other.signals).all(|(a, b)| (*a > 0.0) == (b > 0.0))
    }
}

/// W_n at all speeds, for any energy sought.
pub(crate) struct Scan {
    pub(crate) engine: Engine,
    samples: Vec<Sample>,
    /// Neighbouring numbers between which the regime changes.
    borders: Vec<[f64; 2]>,
}

/// The expected result of a search for an energy.
#[derive(Debug, Default)]
pub(crate) struct Expected {
    /// (m/s) approach speeds of all possible collisions, ascending.
    pub(crate) approaches: Vec<f64>,
    /// The reason why rounding decides, if it does.
    pub(crate) undecided: Option<&'static str>,
}

impl Scan {
    pub(crate) fn new(sought: &Sought, density: u32) -> Option<Self> {
        let engine = Engine::new(sought);
        let ends = [engine.approach_speed(-FASTEST), engine.approach_speed(FASTEST)];
        // Slightly beyond, so that the border itself is included.
        let (low, high) = (ends[0].min(ends[1]).max(0.0), ends[0].max(ends[1]) * 1.001);
        if high <= 0.0 {
            return None;
        }
        let mut scan = Self { engine, samples: Vec::new(), borders: Vec::new() };
        scan.samples =
            scan.grid([low, high], density).into_iter().map(|x| scan.sample(x)).collect::<Vec<_>>();
        scan.refine_borders();
        Some(scan)
    }

    fn sample(&self, x: f64) -> Sample {
        let State { signals, .. } = self.engine.state(x);
        Sample { x, energy: self.energy(x), signals }
    }

    fn energy(&self, x: f64) -> f64 {
        self.engine.energy(x, &self.engine.state(x))
    }

    fn grid(&self, [low, high]: [f64; 2], density: u32) -> Vec<f64> {
        let (geometric, linear) = (GEOMETRIC / density, LINEAR / density);
        let mut xs = vec![low.max(high * 1e-14)];
        let ratio = (LEAST.ln() / f64::from(geometric)).exp();
        xs.extend(
            std::iter::successors(Some(high), |x| Some(x * ratio)).take(usize::try_from(geometric).unwrap()),
        );
        xs.extend((1..linear).map(|i| low + (high - low) * f64::from(i) / f64::from(linear)));
        let knots: Vec<f64> = self.engine.curve().iter().map(|&(x, _)| x).collect();
        for (i, &knot) in knots.iter().enumerate() {
            let neighbours = [if i > 0 { knots[i - 1] } else { 0.0 }, *knots.get(i + 1).unwrap_or(&high)];
            for (side, neighbour) in [-1.0, 1.0].into_iter().zip(neighbours) {
                let beside = knot * (1.0 + side * BESIDE);
                xs.push(beside);
                xs.extend(cluster(beside, neighbour));
            }
            let next = neighbours[1];
            if i + 1 < knots.len() {
                let share = |i: u32| f64::from(i) / f64::from(BETWEEN_KNOTS);
                xs.extend((1..BETWEEN_KNOTS).map(|i| knot + (next - knot) * share(i)));
            }
        }
        xs.retain(|&x| x > 0.0 && x >= low && x <= high);
        xs.sort_by(f64::total_cmp);
        xs.dedup();
        xs
    }

    /// Adds both sides of every change of regime, and samples that approach them.
    fn refine_borders(&mut self) {
        let mut more: Vec<f64> = Vec::new();
        // A signal that touches zero between samples changes the regime twice.
        for triple in self.samples.windows(3) {
            let [a, b, c] = [triple[0], triple[1], triple[2]];
            for k in 0..SIGNALS {
                let f = |x: f64| self.engine.state(x).signals[k];
                if let Some(x) = dip(f, [a, b, c].map(|s| (s.x, s.signals[k]))).crossing() {
                    more.push(x);
                }
            }
        }
        self.insert(&more);
        more.clear();
        let mut borders = Vec::new();
        for pair in self.samples.windows(2) {
            for k in 0..SIGNALS {
                if (pair[0].signals[k] > 0.0) == (pair[1].signals[k] > 0.0) {
                    continue;
                }
                let is_above = |x: f64| self.engine.state(x).signals[k] > 0.0;
                let [a, b] = halve([pair[0].x, pair[1].x], is_above);
                borders.push([a, b]);
                more.extend([a, b]);
                more.extend(cluster(a, pair[0].x));
                more.extend(cluster(b, pair[1].x));
            }
        }
        self.insert(&more);
        self.borders = borders;
    }

    fn insert(&mut self, xs: &[f64]) {
        let more: Vec<Sample> = xs.iter().map(|&x| self.sample(x)).collect();
        self.samples.extend(more);
        self.samples.sort_by(|a, b| a.x.total_cmp(&b.x));
        self.samples.dedup_by(|a, b| a.x == b.x);
    }

    fn judge(&self, x: f64) -> Judgement {
        self.engine.judge(x, &self.engine.state(x))
    }

    /// Every speed at which the collision takes this crush energy (J).
    pub(crate) fn expect(&self, energy: f64) -> Expected {
        let mut expected = Expected::default();
        let missing = |x: f64| self.energy(x) - energy;
        let mut points: Vec<(f64, f64)> = Vec::with_capacity(self.samples.len());
        let mut pairs: Vec<[(f64, f64); 2]> = Vec::new();
        points.extend(self.samples.iter().map(|s| (s.x, s.energy - energy)));
        for (i, point) in points.iter().enumerate().skip(1) {
            if self.samples[i - 1].is_in_regime_of(&self.samples[i]) && opposite(points[i - 1].1, point.1) {
                pairs.push([points[i - 1], *point]);
            }
        }
        // If the energy is nearly met between samples of one sign, an extremum may reach it.
        for (samples, triple) in self.samples.windows(3).zip(points.windows(3)) {
            if !(samples[0].is_in_regime_of(&samples[1]) && samples[1].is_in_regime_of(&samples[2])) {
                continue;
            }
            match dip(missing, [triple[0], triple[1], triple[2]]) {
                Dip::None => {}
                Dip::Crosses(x) => {
                    let middle = (x, missing(x));
                    pairs.extend([[triple[0], middle], [middle, triple[2]]]);
                }
                Dip::Touches(x, least) => {
                    if least.abs() < energy * UNDECIDED && self.judge(x) != Judgement::Impossible {
                        expected.undecided = Some("at a turn");
                    }
                }
            }
        }
        for [a, b] in pairs {
            let [x, other] = halve([a.0, b.0], |x| missing(x) < 0.0);
            let x = if missing(x).abs() <= missing(other).abs() { x } else { other };
            let residual = missing(x).abs() / energy;
            if residual > MET {
                continue;
            }
            match self.judge(x) {
                Judgement::Possible => expected.approaches.push(x),
                Judgement::Impossible => continue,
                Judgement::Undecided => expected.undecided = Some("hardly possible"),
            }
            if residual > UNDECIDED {
                expected.undecided = Some("steep");
            }
        }
        expected.approaches.sort_by(f64::total_cmp);
        // The terms of u_n limit the accuracy of a slow approach.
        let resolution = |x: f64| 1e-13 * self.engine.size / x;
        for pair in expected.approaches.windows(2) {
            if pair[1] - pair[0] < pair[1] * (APART + resolution(pair[1])) {
                expected.undecided = Some("two at once");
            }
        }
        for &[a, b] in &self.borders {
            let near = UNDECIDED + resolution(b);
            if expected.approaches.iter().any(|x| (x - a).abs() < near * a) {
                expected.undecided = Some("at a border");
            }
            for side in [a, b] {
                if missing(side).abs() < energy * UNDECIDED && self.judge(side) != Judgement::Impossible {
                    expected.undecided = Some("meets a border");
                }
            }
        }
        expected
    }

    /// A crush energy within a relative 1e-1 … 1e-6 of that at an extremum of W_n, on either side of a border
    /// or at a knot, if a collision is possible there.
    pub(crate) fn aim(&self, draws: &mut Draws) -> Option<f64> {
        let possible = |x: &f64| {
            let energy = self.energy(*x);
            *x > 0.0 && energy > 10.0 && energy < 1e8 && self.judge(*x) != Judgement::Impossible
        };
        let turns = self.samples.windows(3).filter_map(|triple| {
            let [a, b, c] = [triple[0], triple[1], triple[2]];
            let in_regime = a.is_in_regime_of(&b) && b.is_in_regime_of(&c);
            (in_regime && (b.energy > a.energy) == (b.energy > c.energy)).then_some(b.x)
        });
        let turns: Vec<f64> = turns.filter(possible).collect();
        let mut aims: Vec<f64> = self.engine.curve().iter().map(|&(x, _)| x).collect();
        for &[a, b] in &self.borders {
            // Near a pole the energy is that at this distance from it.
            let offset = 10_f64.powf(draws.between(-6.0, -1.0));
            aims.extend([a, b, a * (1.0 - offset), b * (1.0 + offset)]);
        }
        aims.retain(possible);
        // There are fewer extrema than sides of borders.
        if !turns.is_empty() && (aims.is_empty() || draws.chance(0.6)) {
            aims = turns;
        }
        if aims.is_empty() {
            return None;
        }
        let energy = self.energy(aims[draws.below(aims.len())]);
        Some(energy * (1.0 + draws.sign() * 10_f64.powf(draws.between(-6.0, -1.0))))
    }

    /// A crush energy of a collision at some speed, or occasionally any energy.
    pub(crate) fn any_energy(&self, draws: &mut Draws) -> f64 {
        let high = self.samples[self.samples.len() - 1].x;
        if draws.chance(0.9) {
            for _ in 0..30 {
                let x = draws.log_between(0.3, 60.0);
                let energy = self.energy(x);
                let possible = x < high && self.judge(x) == Judgement::Possible;
                if possible && energy > 1.0 && energy < 1e9 {
                    return energy;
                }
            }
        }
        draws.log_between(1e2, 1e7)
    }
}

fn opposite(a: f64, b: f64) -> bool {
    (a < 0.0 && b >= 0.0) || (a >= 0.0 && b < 0.0)
}

/// Samples between two numbers that approach the first, but not at either.
fn cluster(from: f64, to: f64) -> impl Iterator<Item = f64> {
    (1..=CLUSTER).map(move |k| from + (to - from) * 0.25_f64.powi(k))
}

/// The neighbouring numbers between which the condition of the first end ceases to hold.
fn halve([mut a, mut b]: [f64; 2], holds: impl Fn(f64) -> bool) -> [f64; 2] {
    let first = holds(a);
    loop {
        let middle = 0.5 * (a + b);
        if middle <= a || middle >= b {
            return [a, b];
        }
        if holds(middle) == first {
            a = middle;
        } else {
            b = middle;
        }
    }
}

/// The point at which a function is nearest to zero between two samples of one sign.
enum Dip {
    /// At one of the ends.
    None,
    /// The function has the other sign here.
    Crosses(f64),
    /// The function does not reach zero, and is nearest here.
    Touches(f64, f64),
}

impl Dip {
    fn crossing(self) -> Option<f64> {
        if let Self::Crosses(x) = self { Some(x) } else { None }
    }
}

fn dip(f: impl Fn(f64) -> f64, [a, b, c]: [(f64, f64); 3]) -> Dip {
    let positive = b.1 >= 0.0;
    let one_sign = (a.1 >= 0.0) == positive && (c.1 >= 0.0) == positive;
    let nearest = b.1.abs() < a.1.abs() && b.1.abs() < c.1.abs();
    if !(one_sign && nearest) {
        return Dip::None;
    }
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut low, mut high) = (a.0, c.0);
    let mut left = high - golden * (high - low);
    let mut right = low + golden * (high - low);
    let (mut f_left, mut f_right) = (f(left), f(right));
    for _ in 0..SECTIONS {
        for (x, y) in [(left, f_left), (right, f_right)] {
            if (y >= 0.0) != positive {
                return Dip::Crosses(x);
            }
        }
        if f_left.abs() < f_right.abs() {
            (high, right, f_right) = (right, left, f_left);
            left = high - golden * (high - low);
            f_left = f(left);
        } else {
            (low, left, f_left) = (left, right, f_right);
            right = low + golden * (high - low);
            f_right = f(right);
        }
    }
    if f_left.abs() < f_right.abs() { Dip::Touches(left, f_left) } else { Dip::Touches(right, f_right) }
}
