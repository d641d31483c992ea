//! The vehicle: a rigid body on four wheels.

use pim_core::{Body, InvalidInput, Vector2};
use real::Real;

use pim_core::check;

/// (–) greatest drag of a wheel: no tyre has that much grip, so the wheel is locked on any ground.
pub const GREATEST_DRAG: f64 = 2.0;

/// Position of the axles. The wheels of an axle share its load.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Axles<T = f64> {
    /// (m) a, from the CG forward to the front axle.
    pub cg_to_front: T,
    /// (m) b, from the CG back to the rear axle.
    pub cg_to_rear: T,
    /// (m) between the centres of the left and right tyres.
    pub track: T,
}

/// Position and load of one wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wheel<T = f64> {
    /// (m) from the CG along the vehicle's axis.
    pub forward: T,
    /// (m) from the CG to the left.
    pub left: T,
    /// (–) share of the vehicle's weight.
    pub load: T,
    /// (–) d, rolling resistance as a fraction of its load. At the friction of the ground and above, the
    /// wheel is locked.
    pub drag: T,
    /// Whether it is steered.
    pub steered: bool,
}

/// A rigid body on four wheels: front left, front right, rear left, rear right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chassis<T = f64> {
    body: Body<T>,
    wheels: [Wheel<T>; 4],
}

impl<T: Real> Chassis<T> {
    /// A body on its axles, with the drag of each wheel: front left, front right, rear left, rear right.
    ///
    /// # Errors
    /// If the body is fixed, a length is not a finite number greater than zero, or a drag is outside of 0
    /// to [`GREATEST_DRAG`].
    pub fn new(body: Body<T>, axles: Axles<T>, drag: [T; 4]) -> Result<Self, InvalidInput> {
        let Axles { cg_to_front: a, cg_to_rear: b, track } = axles;
        check::positive("mass", body.mass().value())?;
        check::positive("distance from the CG to the front axle", a.value())?;
        check::positive("distance from the CG to the rear axle", b.value())?;
        check::positive("track width", track.value())?;
        for drag in drag {
            check::within("drag of a wheel", drag.value(), 0.0, GREATEST_DRAG)?;
        }
        // From moments about the other axle, half on each side: b/2L in front, a/2L at the rear.
        let (front, rear) = (b / (a + b) * 0.5, a / (a + b) * 0.5);
        let half = track * 0.5;
        let [front_left, front_right, rear_left, rear_right] = drag;
        let wheels = [
            Wheel { forward: a, left: half, load: front, drag: front_left, steered: true },
            Wheel { forward: a, left: -half, load: front, drag: front_right, steered: true },
            Wheel { forward: -b, left: half, load: rear, drag: rear_left, steered: false },
            Wheel { forward: -b, left: -half, load: rear, drag: rear_right, steered: false },
        ];
        Ok(Self { body, wheels })
    }

    /// The body.
    #[must_use]
    pub fn body(&self) -> &Body<T> {
        &self.body
    }

    /// Front left, front right, rear left, rear right.
    #[must_use]
    pub fn wheels(&self) -> &[Wheel<T>; 4] {
        &self.wheels
    }

    /// (m) distance between the axles.
    #[must_use]
    pub fn wheelbase(&self) -> T {
        self.wheels[0].forward - self.wheels[2].forward
    }

    /// (m) positions of the wheels in the scene, with the CG at `position` (m) and the given `heading` (rad).
    #[must_use]
    pub fn wheel_positions(&self, position: Vector2<T>, heading: T) -> [Vector2<T>; 4] {
        let (sin, cos) = heading.sin_cos();
        self.wheels.map(|Wheel { forward, left, .. }| {
            Vector2::new(position.x + forward * cos - left * sin, position.y + forward * sin + left * cos)
        })
    }

    /// The same chassis in another number type, without derivatives.
    pub(crate) fn constant<U: Real>(&self) -> Chassis<U> {
        let plain = |x: T| U::from(x.value());
        let body = Body::new_with_validity(plain(self.body.mass()), plain(self.body.yaw_inertia())).0;
        let wheels = self.wheels.map(|Wheel { forward, left, load, drag, steered }| Wheel {
            forward: plain(forward),
            left: plain(left),
            load: plain(load),
            drag: plain(drag),
            steered,
        });
        Chassis { body, wheels }
    }
}
