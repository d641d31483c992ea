//! CRASH3's tables, and estimates, for unknown properties of a vehicle. CRASH3's tables are given as printed,
//! in inches and pounds, and only [`Stiffness::from_category`] and [`VehicleClass::new`] convert them to SI
//! units.
//!
//! Source of CRASH3's tables: T. D. Day and R. L. Hargens, SAE 870045 (1987), Tables 1 and 2, which reproduce
//! those of NHTSA's CRASH3. Some digits are unclear in the copy used, and were settled by relations between
//! the numbers of the tables:
//!
//! | where | reads | taken | because |
//! |---|---|---|---|
//! | stiffness, rear, category 2, G | 1074 | 1874 | G = A²/2B holds within 2 % in every row, and gives 1864 |
//! | class 2, track | 34.6 | 54.6 | the tracks grow from class to class |
//! | class 2, width | 61.2 | 67.2 | the width is twice the half width y_s = 33.6 |
//! | class 4, CG to front axle | 54.1 or 54.7 | 54.7 | only the wheelbase depends on it: 113.3 or 113.9 |
//!
//! The widths of classes 5 and 6 are as printed; twice their half widths would be 0.8 in more.

use real::Real;

use crate::direction::Side;
use crate::error::{self, CrushError};
use crate::stiffness::Stiffness;

/// (m) the inch, exact.
const INCH: f64 = 0.0254;
/// (N) the pound-force, exact.
const POUND_FORCE: f64 = 4.448_221_615_260_5;

/// A (lb/in), B (lb/in²) and G (lb) of categories 1 to 5.
type Categories = [[f64; 3]; 5];

const FRONT: Categories = [
    [302.0, 47.0, 967.0],
    [259.0, 43.0, 778.0],
    [317.0, 56.0, 901.0],
    [356.0, 34.0, 1874.0],
    [325.0, 37.0, 1429.0],
];
const REAR: Categories = [
    [366.0, 38.0, 1755.0],
    [391.0, 41.0, 1874.0],
    [410.0, 44.0, 1931.0],
    [357.0, 13.0, 4986.0],
    [297.0, 70.0, 628.0],
];
const SIDE: Categories = [
    [77.0, 37.0, 81.0],
    [140.0, 67.0, 148.0],
    [173.0, 57.0, 263.0],
    [143.0, 50.0, 203.0],
    [177.0, 47.0, 331.0],
];

impl<T: Real> Stiffness<T> {
    /// CRASH3's stiffness category of a side: A, B and an independent G.
    ///
    /// # References
    /// SAE 870045, Table 1.
    ///
    /// # Errors
    /// If the side has no such category.
    pub fn from_category(side: Side, category: u8) -> Result<Self, CrushError> {
        let (name, table) = match side {
            Side::Front => ("front", &FRONT),
            Side::Rear => ("rear", &REAR),
            Side::Left | Side::Right => ("side", &SIDE),
        };
        let row = usize::from(category).checked_sub(1).and_then(|index| table.get(index));
        let Some(&[a, b, g]) = row else {
            return Err(CrushError::NoCategory { category, side: name, known: "1, 2, 3, 4 and 5" });
        };
        Self::from_abg(
            T::from(a * POUND_FORCE / INCH),
            T::from(b * POUND_FORCE / (INCH * INCH)),
            T::from(g * POUND_FORCE),
        )
    }

    /// The stiffness of a side of the cars on the road, [`FLEET`].
    ///
    /// # Errors
    /// None occur with its figures.
    pub fn of_fleet(side: Side) -> Result<Self, CrushError> {
        let FleetStiffness { mass_per_width, no_damage_speed, slope } = FLEET;
        let i = match side {
            Side::Front => 0,
            Side::Rear => 1,
            Side::Left | Side::Right => 2,
        };
        // d₀ = √(m/w) b₀, d₁ = √(m/w) b₁
        let root = Real::sqrt(mass_per_width);
        Self::from_d0_d1(T::from(root * no_damage_speed[i]), T::from(root * slope[i]))
    }
}

/// The stiffness of the cars on the road by their damaged side: front, rear, side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FleetStiffness {
    /// (kg/m) m/w, mass per width to which the others refer.
    pub mass_per_width: f64,
    /// (m/s) b₀, the speed of an impact against a barrier that leaves no crush.
    pub no_damage_speed: [f64; 3],
    /// (1/s) b₁, the increase of that speed with the depth of crush.
    pub slope: [f64; 3],
}

/// The stiffness of cars of 1991 to 2018, on average of 2010: b₁ of fronts is the median of 698 barrier tests
/// of NHTSA, for 1600 kg on 1.6 m; the others were fitted to 329 crashes of 2017 with a recorder
/// (docs/calibration.md).
pub const FLEET: FleetStiffness = FleetStiffness {
    mass_per_width: 1600.0 / 1.6,
    no_damage_speed: [2.22, 2.22, 1.58],
    slope: [27.7, 23.1, 31.1],
};

/// Of each class, in inches and square inches: track, length, width, from the CG to the front axle, to the
/// rear axle and to the front, and k².
const CLASSES: [[f64; 7]; 6] = [
    [51.1, 159.8, 60.8, 45.1, 48.1, 76.0, 2006.0],
    [54.6, 174.9, 67.2, 46.3, 50.1, 83.3, 2951.0],
    [58.9, 196.2, 72.6, 51.3, 53.5, 89.8, 3324.0],
    [61.8, 212.8, 77.0, 54.7, 59.2, 98.8, 3741.0],
    [63.1, 223.7, 79.0, 58.1, 63.0, 101.8, 4040.0],
    [63.7, 229.4, 79.0, 60.1, 65.1, 104.2, 4229.0],
];

/// CRASH3's typical passenger car of a size class. The classes are ordered by wheelbase, from 93 in (2.37 m)
/// for class 1 to 125 in (3.18 m) for class 6.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct VehicleClass {
    /// (m) between the axles.
    pub wheelbase: f64,
    /// (m) between the wheels of an axle.
    pub track: f64,
    /// (m) of the body.
    pub length: f64,
    /// (m) of the body.
    pub width: f64,
    /// (m) from the CG forward to the front of the body.
    pub cg_to_front: f64,
    /// (m) from the CG forward to the front axle.
    pub cg_to_front_axle: f64,
    /// (m) k, yaw radius of gyration.
    pub yaw_radius: f64,
}

impl VehicleClass {
    /// Class 1 to 6.
    ///
    /// # References
    /// SAE 870045, Table 2.
    ///
    /// # Errors
    /// If there is no such class.
    pub fn new(class: u8) -> Result<Self, CrushError> {
        let row = usize::from(class).checked_sub(1).and_then(|index| CLASSES.get(index));
        let Some(&[track, length, width, front_axle, rear_axle, front, k_squared]) = row else {
            return Err(CrushError::NoClass { class, known: "1, 2, 3, 4, 5 and 6" });
        };
        Ok(Self {
            wheelbase: (front_axle + rear_axle) * INCH,
            track: track * INCH,
            length: length * INCH,
            width: width * INCH,
            cg_to_front: front * INCH,
            cg_to_front_axle: front_axle * INCH,
            yaw_radius: k_squared.sqrt() * INCH,
        })
    }
}

/// (1) the coefficient of Burg's formula, see [`yaw_inertia_burg`].
pub const BURG: f64 = 0.1269;
/// Relative uncertainty of a radius of gyration k from [`yaw_inertia_burg`].
pub const BURG_SPREAD: f64 = 0.05;
/// Relative uncertainty of that of a [`VehicleClass`]: the classes are those of the cars of the 1970s, and k
/// by Burg's formula is up to 15 % below theirs.
pub const CLASS_SPREAD: f64 = 0.15;

/// (kg·m²) yaw inertia of a passenger car of the given `mass` (kg), `wheelbase` (m) and overall `length` (m),
/// after Burg: I = 0.1269 × mass × wheelbase × length. The resulting radius of gyration is taken to be
/// accurate to about [`BURG_SPREAD`]; it is 3 to 15 % below those of CRASH3's older and larger cars
/// ([`VehicleClass`]).
///
/// # Errors
/// If one of the three is not positive.
pub fn yaw_inertia_burg<T: Real>(mass: T, wheelbase: T, length: T) -> Result<T, CrushError> {
    error::positive("mass", mass.value())?;
    error::positive("wheelbase", wheelbase.value())?;
    error::positive("length", length.value())?;
    // I = 0.1269 × mass × wheelbase × length
    Ok(mass * wheelbase * length * BURG)
}

#[cfg(test)]
mod tests {
    use super::{CLASSES, FRONT, REAR, SIDE};

    /// The relations that settled the unclear digits hold in every row.
    #[test]
    fn the_numbers_of_the_tables_fit_each_other() {
        for [a, b, g] in [FRONT, REAR, SIDE].into_iter().flatten() {
            // G = A²/2B
            assert!((a * a / (2.0 * b) / g - 1.0).abs() < 0.02, "{a} {b} {g}");
        }
        // SAE 870045, Table 2: the half widths y_s, in.
        for ([_, _, width, ..], half_width) in CLASSES.into_iter().zip([30.4, 33.6, 36.3, 38.5, 39.9, 39.9]) {
            assert!((width - 2.0 * half_width).abs() < 0.81, "{width}");
        }
        // And the distances from the CG to the rear end, x_r, in.
        for (class, to_rear) in CLASSES.into_iter().zip([83.8, 91.6, 106.4, 114.0, 121.9, 125.2]) {
            let [_, length, .., front, _] = class;
            assert!((length - front - to_rear).abs() < 0.051, "{length}");
        }
        assert!(CLASSES.windows(2).all(|pair| pair[0][0] < pair[1][0]));
    }
}
