//! The speed into a fixed object, from the motion after the impact.

use pim_core::{Motion, Real, VehicleId, check};

use crate::momentum::{Momentum, MomentumError, cross, possible};

/// (–) minimum slope of U_n + e u_n as a function of the speed before impact: at this slope an error after
/// the impact is magnified 50 times before it, and more would make the answer useless.
const LEAST_SLOPE: f64 = 0.02;

impl<T: Real> Momentum<T> {
    /// (m/s) the speed of a vehicle along its course before it hit a fixed object, from its motion
    /// afterwards and the restitution e at C. The object takes momentum, so that momentum alone does not give
    /// the speed; the impulse P follows from the velocities of the vehicle, and the condition at C is linear
    /// in the speed v:
    ///
    /// U_n(v) + e u_n(v) = 0,  P = m (V − v ê),  Ω = ω + r × P/I if Ω is unknown
    ///
    /// For a central impact this is v_n = −V_n/e.
    ///
    /// # Errors
    /// If the vehicle is fixed or the other body is not, the restitution is not between 0 and 1, a number is
    /// not finite, the speed after the impact hardly depends on that before, or the vehicle would not
    /// approach.
    pub fn speed_into_wall(&self, vehicle: VehicleId, restitution: T) -> Result<T, MomentumError> {
        self.check_numbers()?;
        check::within("coefficient of restitution", restitution.value(), 0.0, 1.0)?;
        let i = vehicle.index();
        let participant = &self.contact.participants()[i];
        if participant.body().is_fixed() {
            return Err(MomentumError::Fixed { vehicle });
        }
        if !self.contact.participants()[vehicle.other().index()].body().is_fixed() {
            return Err(MomentumError::Movable { vehicle: vehicle.other() });
        }
        let (body, arm, course) = (participant.body(), participant.arm(), participant.course());
        // The other body is at rest before and after.
        let pair = |motion: Motion<T>| {
            let mut motions = [Motion::rest(); 2];
            motions[i] = motion;
            motions
        };
        let [at_rest, at_one] = [T::ZERO, T::ONE].map(|speed| {
            let velocity = self.after[i].velocity;
            let impulse = (velocity - course * speed) * body.mass();
            // Ω = ω + r × P/I
            let free = self.yaw_rates[i] + cross(arm, impulse) * body.inverse_yaw_inertia();
            let yaw_rate = self.after[i].yaw_rate.unwrap_or(free);
            let after = self.contact.approach(&pair(Motion { velocity, yaw_rate })).velocity.normal;
            let before = Motion { velocity: course * speed, yaw_rate: self.yaw_rates[i] };
            let before = self.contact.approach(&pair(before)).velocity.normal;
            // U_n + e u_n
            after + before * restitution
        });
        let slope = at_one - at_rest;
        if slope.abs() < T::from(LEAST_SLOPE) {
            return Err(MomentumError::NoReturn {
                vehicle,
                restitution: restitution.value(),
                slope: slope.abs().value(),
            });
        }
        let speed = possible(vehicle, -(at_rest / slope))?;
        let before = pair(Motion { velocity: course * speed, yaw_rate: self.yaw_rates[i] });
        if self.contact.approach(&before).velocity.normal >= T::ZERO {
            return Err(MomentumError::LeavesWall { vehicle, speed: speed.value() });
        }
        Ok(speed)
    }
}
