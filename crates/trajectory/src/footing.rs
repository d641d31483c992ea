//! The zones of ground under the wheels, and the points at which a wheel enters another.

use real::Real;

use crate::chassis::Chassis;
use crate::field::root;
use crate::ground::{Edge, Ground};
use crate::number::Direction;
use crate::state::cubic;
use crate::step::Phase;

/// (m) maximum distance between checks of a wheel's zone near a border.
const LOOKOUT: f64 = 0.25;

/// (m) distance ahead of a wheel on a border at which its zone is looked up.
const AHEAD: f64 = 1e-9;

/// Fraction of a step to which a crossing is narrowed on its cubic.
const NARROW: f64 = 1e-6;

/// Fraction of a step below which it is not divided further to look for crossings.
const SHORTEST: f64 = 1e-3;

/// Rounds in which a crossing is sought along straight lines; after that by bisection.
const MOST_LINES: u32 = 8;

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

/// The point at which a wheel first enters another zone.
pub(crate) struct Crossing {
    /// Fraction of the step, just after the border.
    pub(crate) share: f64,
    pub(crate) wheel: usize,
    pub(crate) border: Edge,
}

/// The positions (m) of the wheels at a fraction of a step.
#[derive(Clone, Copy)]
struct Stand {
    share: f64,
    wheels: [[f64; 2]; 4],
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
    pub(crate) fn find(&mut self, now: Phase<f64>, energy: f64) {
        let ahead = if energy > 0.0 { AHEAD / root(energy) } else { 0.0 };
        let [x, y, heading] = [0, 1, 2].map(|i| now.q[i] + now.w[i] * ahead);
        self.zones = self.zones_of(self.wheels([x, y], Direction::of(heading)));
    }

    /// The point in a step of `h` (s) at which a wheel first stands on another zone.
    pub(crate) fn crossing(&self, from: Pose, to: Pose, h: f64) -> Option<Crossing> {
        let (first, last) = (from.phase, to.phase);
        if self.is_far_from_borders(first, last, h) {
            return None;
        }
        let at = |share: f64| {
            let of = |i: usize| cubic(share, h, [first.q[i], last.q[i]], [first.w[i], last.w[i]]).0;
            Stand { share, wheels: self.wheels([of(0), of(1)], Direction::of(of(2))) }
        };
        let fastest = |w: [f64; 3]| root(w[0] * w[0] + w[1] * w[1]) + w[2].abs() * self.radius;
        // (m) a wheel is not much faster within a step than at its ends.
        let way = 1.25 * h * Real::max(fastest(first.w), fastest(last.w));
        let end = |share: f64, Pose { phase, direction }: Pose| Stand {
            share,
            wheels: self.wheels([phase.q[0], phase.q[1]], direction),
        };
        self.first(&at, way, end(0.0, from), end(1.0, to))
    }

    /// The first crossing between two positions; a wheel moves at most `way` (m) in a whole step.
    fn first(&self, at: &impl Fn(f64) -> Stand, way: f64, before: Stand, after: Stand) -> Option<Crossing> {
        let width = after.share - before.share;
        if self.is_clear(width * way, &before, &after) {
            return None;
        }
        if width * way <= LOOKOUT || width < SHORTEST {
            let is_same = self.zones_of(after.wheels) == self.zones;
            return if is_same { None } else { self.narrowed(at, before, after) };
        }
        let middle = at(0.5 * (before.share + after.share));
        self.first(at, way, before, middle).or_else(|| self.first(at, way, middle, after))
    }

    /// Whether each wheel stays on its side of all borders between two positions along a path of length `way`
    /// (m): the path to a border and on would be longer.
    fn is_clear(&self, way: f64, before: &Stand, after: &Stand) -> bool {
        self.ground.zones.iter().all(|zone| {
            before.wheels.iter().zip(&after.wheels).all(|(from, to)| {
                let (from, to) = (zone.region.depth(*from), zone.region.depth(*to));
                from * to > 0.0 && from.abs() + to.abs() > way
            })
        })
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

    /// Whether no wheel can meet a border on the cubic between these positions, which takes `h` (s).
    fn is_far_from_borders(&self, from: Phase<f64>, to: Phase<f64>, h: f64) -> bool {
        let length = |x: f64, y: f64| root(x * x + y * y);
        // From the start of the cubic, whose weights of both velocities are at most 4/27:
        // |q − q₀| ≤ |q₁ − q₀| + 4/27 h (|w₀| + |w₁|)
        let speeds = length(from.w[0], from.w[1]) + length(to.w[0], to.w[1]);
        let way = length(to.q[0] - from.q[0], to.q[1] - from.q[1]) + 4.0 / 27.0 * h * speeds;
        let reach = way + self.radius + AHEAD;
        let center = [from.q[0], from.q[1]];
        self.ground.zones.iter().all(|zone| zone.region.distance_to_border(center) > reach)
    }

    /// The first crossing between two positions: narrowed to both sides of the first intersection of straight
    /// lines with the borders, or else by bisection.
    fn narrowed(&self, at: &impl Fn(f64) -> Stand, mut before: Stand, mut after: Stand) -> Option<Crossing> {
        let mut round = 0;
        while after.share - before.share > NARROW {
            let width = after.share - before.share;
            let guess = if round < MOST_LINES { self.met(&before, &after) } else { None };
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

    /// The fraction of the path between two positions at which a wheel first meets a border along a straight
    /// line.
    fn met(&self, before: &Stand, after: &Stand) -> Option<f64> {
        let of = |i: usize| {
            let (from, to) = (before.wheels[i], after.wheels[i]);
            let border = self.border(from, to)?;
            let (before, after) = (border.distance(from), border.distance(to));
            let share = before / (before - after);
            (0.0..=1.0).contains(&share).then_some(share)
        };
        self.changed(after).filter_map(of).min_by(f64::total_cmp)
    }

    /// The wheels that stand on another zone.
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
