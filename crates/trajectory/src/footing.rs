//! The zones of ground under the wheels, and the points where a wheel enters another.

use real::Real;

use crate::chassis::Chassis;
use crate::field::root;
use crate::ground::{Edge, Ground, ON_BORDER, Passage};
use crate::number::{Direction, Number, direction_of_turn};
use crate::state::cubic;
use crate::step::Phase;

/// (m) maximum distance between checks of a wheel's zone near a border.
const LOOKOUT: f64 = 0.25;

/// (m) how far ahead of a wheel on a border its zone is looked up.
const AHEAD: f64 = 1e-9;

/// Fraction of a step to which a crossing is narrowed on its cubic.
const NARROW: f64 = 1e-6;

/// Fraction of a step below which it is not divided further to look for crossings.
const SHORTEST: f64 = 1e-3;

/// Rounds of the search for a crossing on the cubics of the distances; bisection follows.
const MOST_CUBICS: u32 = 8;

/// Rounds of Newton's method on such a cubic, from its chord.
const ROUNDS_ON_CUBIC: u32 = 3;

/// The ground under a vehicle.
#[derive(Clone, Copy)]
pub(crate) struct Footing<'a, T, G> {
    pub(crate) chassis: &'a Chassis<T>,
    pub(crate) ground: &'a Ground<'a, G>,
    /// (m) from the CG to the farthest wheel.
    pub(crate) radius: f64,
    /// The zone under each wheel.
    pub(crate) zones: [usize; 4],
}

/// Position and motion of a vehicle, with the sine and cosine of its heading.
#[derive(Clone, Copy)]
pub(crate) struct Pose {
    pub(crate) phase: Phase<f64>,
    pub(crate) direction: Direction<f64>,
}

/// The point where a wheel first enters another zone.
pub(crate) struct Crossing {
    /// Fraction of the step, just after the border.
    pub(crate) share: f64,
    pub(crate) wheel: usize,
    pub(crate) border: Edge,
}

/// The wheels at a fraction of a step.
#[derive(Clone, Copy)]
struct Stand {
    share: f64,
    /// (m) position of the CG.
    center: [f64; 2],
    /// (m, m, rad) motion in a whole step at this rate.
    motion: [f64; 3],
    /// (m) their positions.
    wheels: [[f64; 2]; 4],
}

impl Stand {
    /// (m) displacement of a wheel in a whole step at this rate.
    fn rate(&self, wheel: usize) -> [f64; 2] {
        let ([x, y], [cx, cy], [vx, vy, omega]) = (self.wheels[wheel], self.center, self.motion);
        [vx - omega * (y - cy), vy + omega * (x - cx)]
    }
}

/// Bounds of the path of any wheel in a whole step.
#[derive(Clone, Copy)]
struct Path {
    /// (m) its length.
    way: f64,
    /// (m) its distance from the straight line between its ends.
    bow: f64,
}

impl<'a, T: Real, G: Real> Footing<'a, T, G> {
    /// The footing outside all zones.
    pub(crate) fn new(chassis: &'a Chassis<T>, ground: &'a Ground<'a, G>) -> Self {
        let radius = chassis.wheels().iter().fold(0.0, |radius, wheel| {
            let (forward, left) = (wheel.forward.value(), wheel.left.value());
            Real::max(radius, root(forward * forward + left * left))
        });
        Self { chassis, ground, radius, zones: [0; 4] }
    }

    /// Whether the ground is uniform.
    pub(crate) fn is_even(&self) -> bool {
        self.ground.zones.is_empty()
    }

    /// Finds the zone just ahead of each wheel; `energy` (m²/s²) is twice the kinetic energy per unit mass.
    pub(crate) fn find(&mut self, Pose { phase: now, direction }: Pose, energy: f64) {
        let ahead = if energy > 0.0 { AHEAD / root(energy) } else { 0.0 };
        let [x, y] = [0, 1].map(|i| now.q[i] + now.w[i] * ahead);
        let direction = direction.turned(direction_of_turn(now.w[2] * ahead));
        self.zones = self.zones_of(self.wheels([x, y], direction));
    }

    /// The point in a step of `h` (s) where a wheel is first on another zone.
    pub(crate) fn crossing(&self, from: Pose, to: Pose, h: f64) -> Option<Crossing> {
        let (first, last) = (from.phase, to.phase);
        if self.clearance(first) > farthest(first, last, h) {
            return None;
        }
        let ways = [0, 1, 2].map(|i| [first.w[i] * h, last.w[i] * h]);
        let stand = |share: f64, q: [f64; 3], motion: [f64; 3], direction: Direction<f64>| {
            let center = [q[0], q[1]];
            Stand { share, center, motion, wheels: self.wheels(center, direction) }
        };
        let at = |share: f64| {
            let of = [0, 1, 2].map(|i| cubic(share, 1.0, [first.q[i], last.q[i]], ways[i]));
            let q = of.map(|(value, _)| value);
            let direction = from.direction.turned(direction_of_turn(q[2] - first.q[2]));
            stand(share, q, of.map(|(_, rate)| rate), direction)
        };
        let path = Path { way: self.most_way(first, last, h), bow: self.most_bow(first, last, h) };
        let before = stand(0.0, first.q, ways.map(|[start, _]| start), from.direction);
        let after = stand(1.0, last.q, ways.map(|[_, end]| end), to.direction);
        self.first(&at, path, before, after)
    }

    /// The first crossing between two positions on the path of a step.
    fn first(&self, at: &impl Fn(f64) -> Stand, path: Path, before: Stand, after: Stand) -> Option<Crossing> {
        let width = after.share - before.share;
        // The bow of a part of a path shrinks with the square of its length.
        let passage = self.passage(width * width * path.bow + ON_BORDER, &before, &after);
        if passage != Passage::Unknown || width * path.way <= LOOKOUT || width < SHORTEST {
            let is_same = self.zones_of(after.wheels) == self.zones;
            return if is_same { None } else { self.narrowed(at, before, after) };
        }
        let middle = at(0.5 * (before.share + after.share));
        self.first(at, path, before, middle).or_else(|| self.first(at, path, middle, after))
    }

    /// What is certain about the path of every wheel between two positions, which leaves the straight line by
    /// at most `bow` (m). If no border is crossed twice, a wheel that ends on its zone has never left it, as
    /// it would still be in any zone that it entered.
    fn passage(&self, bow: f64, before: &Stand, after: &Stand) -> Passage {
        let ways = || before.wheels.iter().zip(&after.wheels);
        let zones = self.ground.zones.iter();
        let all = zones.flat_map(|zone| ways().map(|(from, to)| zone.region.passage(*from, *to, bow)));
        all.max().unwrap_or(Passage::Clear)
    }

    /// (m) the longest path of a wheel in a step of `h` (s): it is not much faster within a step than at its
    /// ends.
    fn most_way(&self, first: Phase<f64>, last: Phase<f64>, h: f64) -> f64 {
        let fastest = |w: [f64; 3]| length(w[0], w[1]) + w[2].abs() * self.radius;
        1.25 * h * Real::max(fastest(first.w), fastest(last.w))
    }

    /// (m) the greatest distance of a wheel on the cubic of a step of `h` (s) from the straight line between
    /// its positions at the ends.
    fn most_bow(&self, first: Phase<f64>, last: Phase<f64>, h: f64) -> f64 {
        let rise = [0, 1, 2].map(|i| last.q[i] - first.q[i]);
        // By the fraction of the step: p″ = h (±4 w₀ ± 2 w₁) ∓ 6Δ at the ends, and linear between them
        let at_start = [0, 1, 2].map(|i| 6.0 * rise[i] - h * (4.0 * first.w[i] + 2.0 * last.w[i]));
        let at_end = [0, 1, 2].map(|i| h * (2.0 * first.w[i] + 4.0 * last.w[i]) - 6.0 * rise[i]);
        let center = Real::max(length(at_start[0], at_start[1]), length(at_end[0], at_end[1]));
        let spin = Real::max(at_start[2].abs(), at_end[2].abs());
        // |ψ′| ≤ h max(|ω₀|, |ω₁|) + ½ |ψ″|, as every place is half of the step or less from an end
        let turn = h * Real::max(first.w[2].abs(), last.w[2].abs()) + 0.5 * spin;
        // |P″| ≤ |c″| + r (|ψ″| + ψ′²), and a path with |P″| ≤ M leaves its chord by at most M/8
        0.125 * (center + self.radius * (spin + turn * turn))
    }

    fn wheels(&self, [x, y]: [f64; 2], Direction { sin, cos }: Direction<f64>) -> [[f64; 2]; 4] {
        self.chassis.wheels().map(|wheel| {
            let (forward, left) = (wheel.forward.value(), wheel.left.value());
            [x + forward * cos - left * sin, y + forward * sin + left * cos]
        })
    }

    fn zones_of(&self, wheels: [[f64; 2]; 4]) -> [usize; 4] {
        wheels.map(|wheel| self.ground.zone_at(wheel))
    }

    /// (m) how far the vehicle can go from here before a wheel meets a border.
    pub(crate) fn clearance(&self, now: Phase<f64>) -> f64 {
        let center = [now.q[0], now.q[1]];
        let distances = self.ground.zones.iter().map(|zone| zone.region.distance_to_border(center));
        distances.fold(f64::INFINITY, Real::min) - self.radius - AHEAD
    }

    /// The first crossing between two positions. The cubics of the distances, or else bisection, narrow it to
    /// both sides of the point where a wheel first meets a border.
    fn narrowed(&self, at: &impl Fn(f64) -> Stand, mut before: Stand, mut after: Stand) -> Option<Crossing> {
        let mut round = 0;
        while after.share - before.share > NARROW {
            let width = after.share - before.share;
            let guess = if round < MOST_CUBICS { self.met(&before, &after) } else { None };
            let probes = match guess {
                Some(share) => {
                    let middle = before.share + share * width;
                    [middle - 0.4 * NARROW, middle + 0.4 * NARROW]
                }
                None => [before.share + 0.5 * width; 2],
            };
            for probe in probes {
                if probe > before.share && probe < after.share {
                    let stand = at(probe);
                    if self.zones_of(stand.wheels) == self.zones { before = stand } else { after = stand }
                }
            }
            round += 1;
        }
        let wheel = self.changed(&after).next()?;
        let border = self.border(before.wheels[wheel], after.wheels[wheel])?;
        Some(Crossing { share: after.share, wheel, border })
    }

    /// The fraction of the path between two positions where a wheel first meets a border, by the cubic of its
    /// distance from it.
    fn met(&self, before: &Stand, after: &Stand) -> Option<f64> {
        let width = after.share - before.share;
        let of = |i: usize| {
            let border = self.border(before.wheels[i], after.wheels[i])?;
            let ends = [before, after].map(|stand| border.distance(stand.wheels[i]));
            let rates = [before, after].map(|stand| width * border.rate(stand.rate(i)));
            let mut share = ends[0] / (ends[0] - ends[1]);
            for _ in 0..ROUNDS_ON_CUBIC {
                let (distance, rate) = cubic(share, 1.0, ends, rates);
                share -= distance / rate;
            }
            (0.0..=1.0).contains(&share).then_some(share)
        };
        self.changed(after).filter_map(of).min_by(f64::total_cmp)
    }

    /// The wheels that are on another zone.
    fn changed(&self, stand: &Stand) -> impl Iterator<Item = usize> {
        let zones = self.zones_of(stand.wheels);
        (0..4).filter(move |&i| zones[i] != self.zones[i])
    }

    /// The edge between two points on different zones that is nearest to the latter.
    fn border(&self, from: [f64; 2], to: [f64; 2]) -> Option<Edge> {
        let mut zones = self.ground.zones.iter();
        let zone = zones.rfind(|zone| zone.region.contains(from) != zone.region.contains(to))?;
        zone.region.nearest_edge(to)
    }
}

/// (m) farthest distance from the start on the cubic between these positions, which takes `h` (s).
#[inline(always)]
pub(crate) fn farthest<T: Number>(from: Phase<T>, to: Phase<T>, h: T) -> T {
    let length = |x: T, y: T| (x * x + y * y).sqrt();
    // The weights of both velocities on the cubic are at most 4/27: |q − q₀| ≤ |q₁ − q₀| + 4/27 h (|w₀| +
    // |w₁|)
    let speeds = length(from.w[0], from.w[1]) + length(to.w[0], to.w[1]);
    length(to.q[0] - from.q[0], to.q[1] - from.q[1]) + h * speeds * (4.0 / 27.0)
}

fn length(x: f64, y: f64) -> f64 {
    root(x * x + y * y)
}

#[cfg(test)]
mod tests {
    use pim_core::{Body, Vector2};
    use proptest::prelude::*;

    use super::{Footing, Passage, cubic, farthest};
    use crate::chassis::{Axles, Chassis};
    use crate::ground::{Ground, ON_BORDER, Region};
    use crate::number::Direction;
    use crate::step::Phase;

    /// Number of places on a path at which its wheels are examined.
    const PLACES: u32 = 400;

    fn chassis() -> Chassis {
        let axles = Axles { cg_to_front: 1.1, cg_to_rear: 1.5, track: 1.5 };
        Chassis::new(Body::new(1300.0, 2100.0).unwrap(), axles, [0.1; 4]).unwrap()
    }

    /// Ends of a step from the origin, and its length. Some are nearly those of a parabola, some turn back.
    fn step() -> impl Strategy<Value = ([Phase<f64>; 2], f64)> {
        let three = || [-1.0..1.0, -1.0..1.0, -1.0..1.0_f64];
        let sizes = (0.0..20.0_f64, 0.0..8.0_f64, prop_oneof![Just(0.1), Just(10.0)], 0.002..0.1_f64);
        (-3.2..3.2_f64, three(), three(), three(), sizes).prop_map(
            |(heading, motion, change, off, (speed, yaw_rate, odd, h))| {
                let q = [0.0, 0.0, heading];
                let w = [0, 1, 2].map(|i| motion[i] * if i == 2 { yaw_rate } else { speed });
                // Accelerations of up to 10 m/s² and 10 rad/s²
                let a = change.map(|part| 10.0 * part);
                let end = [0, 1, 2].map(|i| q[i] + h * (w[i] + 0.5 * h * a[i] + h * odd * off[i]));
                let last = [0, 1, 2].map(|i| w[i] + h * a[i]);
                ([Phase { q, w }, Phase { q: end, w: last }], h)
            },
        )
    }

    /// Where the wheels are at a fraction of the step.
    fn at(footing: &Footing<'_, f64, f64>, [from, to]: [Phase<f64>; 2], h: f64, share: f64) -> [[f64; 2]; 4] {
        let q = [0, 1, 2].map(|i| cubic(share, h, [from.q[i], to.q[i]], [from.w[i], to.w[i]]).0);
        footing.wheels([q[0], q[1]], Direction::of(q[2]))
    }

    fn length([x, y]: [f64; 2]) -> f64 {
        super::length(x, y)
    }

    fn between([x0, y0]: [f64; 2], [x1, y1]: [f64; 2], share: f64) -> [f64; 2] {
        [x0 + share * (x1 - x0), y0 + share * (y1 - y0)]
    }

    fn apart([x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> f64 {
        length([x1 - x0, y1 - y0])
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(3000))]

        /// No wheel leaves its chord by more than the bow, and none goes farther than the clearance allows.
        #[test]
        fn bounds_of_a_path_hold((ends, h) in step()) {
            let (chassis, ground) = (chassis(), Ground::level(0.7));
            let footing = Footing::new(&chassis, &ground);
            let [from, to] = ends;
            let (first, last) = (at(&footing, ends, h, 0.0), at(&footing, ends, h, 1.0));
            let (mut bow, mut far): (f64, f64) = (0.0, 0.0);
            for k in 0..=PLACES {
                let share = f64::from(k) / f64::from(PLACES);
                let wheels = at(&footing, ends, h, share);
                for (i, wheel) in wheels.iter().enumerate() {
                    bow = bow.max(apart(*wheel, between(first[i], last[i], share)));
                    far = far.max(length(*wheel) - footing.radius);
                }
            }
            let (most_bow, farthest) = (footing.most_bow(from, to, h), farthest(from, to, h));
            prop_assert!(bow <= most_bow + 1e-12, "{bow} {most_bow}");
            prop_assert!(far <= farthest + 1e-12, "{far} {farthest}");
        }

        /// The classification of the passage of a border holds at many places of the path, with the actual
        /// curvature of the path, and with a border where a wheel starts.
        #[test]
        fn a_path_passes_a_border_as_said(
            (ends, h) in step(),
            (is_half, angle, off) in (any::<bool>(), -3.2..3.2_f64, prop_oneof![Just(0.0), -0.3..0.3_f64]),
        ) {
            let (chassis, ground) = (chassis(), Ground::level(0.7));
            let footing = Footing::new(&chassis, &ground);
            let places = |k: u32| at(&footing, ends, h, f64::from(k) / f64::from(PLACES));
            let (first, last) = (places(0), places(PLACES));
            let Direction { sin, cos } = Direction::of(angle);
            let along = |ahead: f64, aside: f64| {
                let ahead = ahead + off;
                Vector2::new(first[0][0] + ahead * cos - aside * sin, first[0][1] + ahead * sin + aside * cos)
            };
            let corners = [along(0.0, -0.5), along(0.1, -0.5), along(0.1, 0.5), along(0.0, 0.5)];
            let region = match is_half {
                true => Region::half_plane(along(0.0, 0.0), angle),
                false => Region::Polygon(&corners),
            };
            for wheel in 0..4 {
                let path: Vec<[f64; 2]> = (0..=PLACES).map(|k| places(k)[wheel]).collect();
                // |P″|/8, from second differences.
                let bows = path.windows(3).map(|three| {
                    let bend = [0, 1].map(|i| three[0][i] - 2.0 * three[1][i] + three[2][i]);
                    0.125 * length(bend) * f64::from(PLACES * PLACES)
                });
                let bow = bows.fold(0.0, f64::max);
                // On which side the wheel starts, rounding decides.
                let sides = path[1..].windows(2).filter(|two| region.contains(two[0]) != region.contains(two[1]));
                let changes = sides.count();
                match region.passage(first[wheel], last[wheel], 1.01 * bow + ON_BORDER) {
                    Passage::Clear => prop_assert_eq!(changes, 0),
                    Passage::Once => prop_assert!(changes <= 1),
                    Passage::Unknown => {}
                }
            }
        }
    }

    /// A path of a metre beside a border, at any distance that is worth a look, is found clear; one that
    /// crosses it plainly is found to do so once.
    #[test]
    fn a_plain_path_is_not_left_unknown() {
        let region = Region::half_plane(Vector2::new(0.0, 0.0), 0.0);
        assert_eq!(region.passage([0.02, 0.0], [0.02, 1.0], 0.01), Passage::Clear);
        assert_eq!(region.passage([0.0, 0.0], [0.5, 1.0], 0.1), Passage::Clear);
        assert_eq!(region.passage([-0.5, 0.0], [0.5, 1.0], 0.1), Passage::Once);
        assert_eq!(region.passage([0.02, 0.0], [0.02, 1.0], 0.03), Passage::Unknown);
        // d = −0.1 + 0.2 t ± 4 b t (1 − t) has a rate of 0 at an end if b = 0.05.
        assert_eq!(region.passage([-0.1, 0.0], [0.1, 1.0], 0.049), Passage::Once);
        assert_eq!(region.passage([-0.1, 0.0], [0.1, 1.0], 0.051), Passage::Unknown);
        let stripe = [[0.0, 0.0], [1.0, 0.0], [1.0, 4.0], [0.0, 4.0]].map(|[x, y]| Vector2::new(x, y));
        let stripe = Region::Polygon(&stripe);
        assert_eq!(stripe.passage([0.5, 0.5], [0.5, 3.0], 0.1), Passage::Clear);
        assert_eq!(stripe.passage([1.5, -0.5], [3.0, 3.0], 0.1), Passage::Clear);
        assert_eq!(stripe.passage([-0.5, 4.0], [2.5, 7.5], 0.05), Passage::Clear);
        assert_eq!(stripe.passage([-0.5, 1.0], [1.5, 1.0], 0.1), Passage::Unknown);
    }
}
