//! Two vehicles of a crash, as an investigator recorded them.

use real::elementary::{atan2, exp, ln};

pub use crash3::Side as Plane;

/// Two vehicles that collided.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// Number of the crash.
    pub case: String,
    /// The vehicles.
    pub vehicles: [PairVehicle; 2],
}

/// One vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairVehicle {
    /// Its number in the crash, which identifies it in another event.
    pub number: Option<u32>,
    /// (kg) mass without occupants and load.
    pub curb_mass: f64,
    /// (kg) load.
    pub cargo: Option<f64>,
    /// (m) its length.
    pub length: Option<f64>,
    /// (m) its width.
    pub width: Option<f64>,
    /// Where it was hit.
    pub plane: Plane,
    /// (rad) direction from which the force came, clockwise from its heading.
    pub pdof: f64,
    /// (rad) heading at impact, clockwise from north.
    pub heading: Option<f64>,
    /// (m) length of the whole damage.
    pub field_length: Option<f64>,
    /// (m) length of the direct damage.
    pub direct_length: Option<f64>,
    /// (m) from the middle of the face to that of the direct damage: to the right, on sides forward.
    pub direct_offset: Option<f64>,
    /// (m) depths at equal steps, from left to right, on sides from rear to front.
    pub depths: [f64; 6],
    /// (m/s) ΔV by WinSMASH: its size, and its longitudinal part.
    pub winsmash: [Option<f64>; 2],
    /// (m/s) largest ΔV that the recorder stored, forward and to the right.
    pub recorder: [Option<f64>; 2],
    /// Whether two records of its recorder fit two events of the crash far better when exchanged, by the
    /// directions of force and by the momentum that the other vehicle's recorder shows.
    pub is_record_doubted: bool,
    /// CRASH3's category of its stiffness; without one, its stiffness is that of the fleet.
    pub category: Option<u8>,
}

/// (m, –) wheelbase w = a m^b of a mass m (kg): a line through ln w and ln m of 415 vehicles of CIREN.
const WHEELBASE: [f64; 2] = [0.173, 0.378];
/// (m) the wheelbases of CRASH3's categories 1 to 5: 93, 96, 105, 114 and 121 in.
const CATEGORIES: [f64; 5] = [2.362, 2.438, 2.667, 2.896, 3.073];

/// CRASH3's category of a vehicle of this mass (kg), chosen by the wheelbase as an analyst does; the data
/// lack the wheelbase, which follows from the mass.
#[must_use]
pub fn usual_category(curb_mass: f64) -> u8 {
    let [factor, power] = WHEELBASE;
    let wheelbase = factor * exp(power * ln(curb_mass));
    let limits = CATEGORIES.windows(2).map(|ends| 0.5 * (ends[0] + ends[1]));
    limits.fold(1, |category, limit| category + u8::from(wheelbase > limit))
}

/// (kg) mass of the occupants.
const OCCUPANTS: f64 = 75.0;
/// (kg) largest load of any passenger vehicle; NHTSA's codes for unknown loads are larger.
const MOST_CARGO: f64 = 1000.0;

/// (m/s) recorders do not trigger reliably below this.
const LEAST_DELTA_V: f64 = 8.0 / 3.6;

/// The value that a recorder stored, as far as it can be judged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truth {
    /// (m/s) its size.
    pub delta_v: f64,
    /// Whether it is only the part along the vehicle.
    pub is_longitudinal: bool,
    /// (rad) direction from which the force came by both parts, clockwise from the heading.
    pub direction: Option<f64>,
}

impl PairVehicle {
    /// (kg) mass with load and occupants.
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.curb_mass + self.cargo.map_or(0.0, |cargo| cargo.min(MOST_CARGO)) + OCCUPANTS
    }

    /// The value that its recorder stored: the size of both parts or, for damage to its front or rear, the
    /// part along the vehicle; `None` below 8 km/h, and if the record may belong to another event.
    #[must_use]
    pub fn truth(&self) -> Option<Truth> {
        if self.is_record_doubted {
            return None;
        }
        let truth = match self.recorder {
            [Some(along), Some(across)] => {
                let delta_v = (along * along + across * across).sqrt();
                // ΔV points away from the origin of the force; across is positive to the right.
                let direction = Some(atan2(-across, -along));
                Truth { delta_v, is_longitudinal: false, direction }
            }
            [Some(along), None] if !self.plane.is_side() => {
                Truth { delta_v: along.abs(), is_longitudinal: true, direction: None }
            }
            _ => return None,
        };
        (truth.delta_v >= LEAST_DELTA_V).then_some(truth)
    }

    /// (m/s) WinSMASH's value for it.
    #[must_use]
    pub fn by_winsmash(&self, truth: &Truth) -> Option<f64> {
        let [whole, along] = self.winsmash;
        let delta_v = if truth.is_longitudinal { along? } else { whole? }.abs();
        (delta_v > 0.0).then_some(delta_v)
    }
}

#[cfg(test)]
mod tests {
    use super::usual_category;

    /// By hand: wheelbases of 2.36, 2.50, 2.71, 2.86 and 3.33 m.
    #[test]
    fn the_category_is_that_of_the_nearest_wheelbase() {
        for (curb_mass, category) in [(1000.0, 1), (1170.0, 2), (1450.0, 3), (1680.0, 4), (2500.0, 5)] {
            assert_eq!(usual_category(curb_mass), category, "{curb_mass}");
        }
    }
}
