//! A driver's response to a demand: reaction, swell of the brakes, full deceleration.

use pim_core::InvalidInput;
use real::Real;

use crate::course::Leg;
use pim_core::check;

/// Iterations after which Newton's method has long converged: it is quadratic, and started on the side from
/// which it cannot overshoot.
const MOST_ITERATIONS: usize = 80;

/// How the deceleration grows while the brakes take hold. Conventions differ, and the distance with them: at
/// 50 km/h, 0.2 s of swell and 7.5 m/s² by 1.4 m.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Swell {
    /// Linearly from zero to the full deceleration.
    #[default]
    Linear,
    /// Half the full deceleration during all of the swell.
    Half,
    /// None: the vehicle keeps its full speed during the swell, as if it were part of the reaction.
    FullSpeed,
}

/// What a driver does from the reaction demand on. In all methods, `speed` (m/s, not negative) is the speed
/// at the demand, and `distance` (m, not negative) is measured from the position there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Response<T = f64> {
    /// (s) t_R, from the demand to the first effect of the brakes.
    reaction: T,
    /// (s) t_S.
    swell: T,
    /// (m/s²) a.
    deceleration: T,
    form: Swell,
}

/// Where and when a driver began to react, seen from the end of the motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demand<T = f64> {
    /// (m/s) v_0, the speed before braking.
    pub speed: T,
    /// (m) s_A, from the reaction to the end of the braked distance.
    pub distance: T,
    /// (s) the time that this took.
    pub time: T,
}

impl<T: Real> Response<T> {
    /// From a reaction time (s), a swell (s) and a deceleration (m/s²).
    ///
    /// # Errors
    /// Where a time is negative, the deceleration is not positive, or a number is not finite.
    pub fn new(reaction: T, swell: T, deceleration: T, form: Swell) -> Result<Self, InvalidInput> {
        check::at_least("reaction time", reaction.value(), 0.0)?;
        check::at_least("swell of the brakes", swell.value(), 0.0)?;
        check::positive("deceleration", deceleration.value())?;
        Ok(Self { reaction, swell, deceleration, form })
    }

    /// (s) t_R.
    #[must_use]
    pub fn reaction(&self) -> T {
        self.reaction
    }

    /// (s) t_S.
    #[must_use]
    pub fn swell(&self) -> T {
        self.swell
    }

    /// (m/s²) a.
    #[must_use]
    pub fn deceleration(&self) -> T {
        self.deceleration
    }

    /// How the deceleration grows in the swell.
    #[must_use]
    pub fn form(&self) -> Swell {
        self.form
    }

    /// The same with another reaction time (s), for which the caller vouches: it is not checked.
    #[must_use]
    pub fn with_reaction(self, reaction: T) -> Self {
        Self { reaction, ..self }
    }

    /// The same with another deceleration (m/s²), for which the caller vouches: it is not checked.
    #[must_use]
    pub fn with_deceleration(self, deceleration: T) -> Self {
        Self { deceleration, ..self }
    }

    /// (s) τ: the time that counts as driven at full speed, t_R + t_S/2 where the swell brakes, all of t_R +
    /// t_S where it does not.
    #[must_use]
    pub fn delay(&self) -> T {
        match self.form {
            Swell::Linear | Swell::Half => self.reaction + self.swell * 0.5,
            Swell::FullSpeed => self.reaction + self.swell,
        }
    }

    /// (m/s) the speed lost during the swell: a t_S/2, where it brakes.
    fn lost(&self) -> T {
        match self.form {
            Swell::Linear | Swell::Half => self.deceleration * self.swell * 0.5,
            Swell::FullSpeed => T::ZERO,
        }
    }

    /// (m) the distance lost during the swell, against driving on: a t_S²/6 where the deceleration grows
    /// linearly, a t_S²/4 where it is half.
    fn lag(&self) -> T {
        let full = self.deceleration * self.swell * self.swell;
        match self.form {
            Swell::Linear => full / 6.0,
            Swell::Half => full * 0.25,
            Swell::FullSpeed => T::ZERO,
        }
    }

    /// Whether a vehicle with this speed (m/s) stops before the brakes have their full effect.
    fn stops_in_swell(&self, speed: T) -> bool {
        speed.value() < self.lost().value()
    }

    /// (s) time from the first effect of the brakes to the stop, of a vehicle that [stops in the
    /// swell](Self::stops_in_swell).
    fn stop_in_swell(&self, speed: T) -> T {
        match self.form {
            // v = a u²/(2 t_S)
            Swell::Linear => (speed * self.swell * 2.0 / self.deceleration).sqrt(),
            // v = a u/2
            Swell::Half | Swell::FullSpeed => speed * 2.0 / self.deceleration,
        }
    }

    /// (m) the distance from the first effect of the brakes to that stop: two thirds of v u where the
    /// deceleration grows linearly, half of it where it is constant.
    fn distance_in_swell(&self, speed: T) -> T {
        let free = speed * self.stop_in_swell(speed);
        match self.form {
            Swell::Linear => free * 2.0 / 3.0,
            Swell::Half | Swell::FullSpeed => free * 0.5,
        }
    }

    /// (m) S, from the demand to the stop.
    #[must_use]
    pub fn stopping_distance(&self, speed: T) -> T {
        if self.stops_in_swell(speed) {
            return speed * self.reaction + self.distance_in_swell(speed);
        }
        // S = v (t_R + t_S) − lag + (v − lost)²/2a; with a linear swell v τ + v²/2a − a t_S²/24
        let left = speed - self.lost();
        speed * (self.reaction + self.swell) - self.lag() + left * left / (self.deceleration * 2.0)
    }

    /// (s) from the demand to the stop.
    #[must_use]
    pub fn stopping_time(&self, speed: T) -> T {
        if self.stops_in_swell(speed) {
            return self.reaction + self.stop_in_swell(speed);
        }
        // t = τ + v/a
        self.delay() + speed / self.deceleration
    }

    /// (m/s) the speed after a distance: at the collision, where that is the distance to its place. The speed
    /// itself before the brakes take hold, zero where the vehicle has stopped.
    #[must_use]
    pub fn speed_after(&self, speed: T, distance: T) -> T {
        let braked = distance - speed * self.reaction;
        if braked.value() <= 0.0 {
            return speed;
        }
        match self.time_in_swell(speed, braked) {
            Some(time) => self.speed_in_swell(speed, time),
            None => self.speed_at_full(speed, braked),
        }
    }

    /// (m/s) the speed of a vehicle under full braking, or at rest.
    fn speed_at_full(&self, speed: T, braked: T) -> T {
        if self.stops_in_swell(speed) {
            return T::ZERO;
        }
        let left = speed - self.lost();
        // v_k² = (v − lost)² − 2a (s − v t_R − v t_S + lag)
        let square = left * left - self.deceleration * 2.0 * (braked - speed * self.swell + self.lag());
        if square.value() > 0.0 { square.sqrt() } else { T::ZERO }
    }

    fn speed_in_swell(&self, speed: T, time: T) -> T {
        match self.form {
            // v − a u²/(2 t_S)
            Swell::Linear => speed - self.deceleration * time * time / (self.swell * 2.0),
            // v − a u/2
            Swell::Half => speed - self.deceleration * time * 0.5,
            Swell::FullSpeed => speed,
        }
    }

    /// (s) time from the first effect of the brakes until a distance (m) from there is reached; `None` if it
    /// is not reached within the swell.
    fn time_in_swell(&self, speed: T, braked: T) -> Option<T> {
        let reach = if self.stops_in_swell(speed) {
            self.distance_in_swell(speed)
        } else {
            speed * self.swell - self.lag()
        };
        if braked.value() >= reach.value() {
            return None;
        }
        Some(match self.form {
            Swell::Linear => self.time_in_linear_swell(speed, braked),
            // s = v u − a u²/4: u = 2 s/(v + √(v² − a s))
            Swell::Half => {
                let root = (speed * speed - self.deceleration * braked).sqrt();
                braked * 2.0 / (speed + root)
            }
            Swell::FullSpeed => braked / speed,
        })
    }

    /// s = v u − a u³/(6 t_S) for u. The left side lies below its tangents, so Newton's method rises to the
    /// root from below.
    fn time_in_linear_swell(&self, speed: T, braked: T) -> T {
        let slope = self.deceleration / (self.swell * 2.0);
        let mut time = braked / speed;
        for _ in 0..MOST_ITERATIONS {
            let missing = braked - time * (speed - slope * time * time / 3.0);
            let step = missing / (speed - slope * time * time);
            let next = time + step;
            // One more step than the value needs gives the derivatives.
            let is_settled = next.value() <= time.value();
            time = next;
            if is_settled {
                break;
            }
        }
        time
    }

    /// (s) from the demand until a distance is reached; `None` where the vehicle stops before.
    #[must_use]
    pub fn arrival(&self, speed: T, distance: T) -> Option<T> {
        let braked = distance - speed * self.reaction;
        if braked.value() <= 0.0 {
            let stands = speed.value() <= 0.0;
            return if stands && distance.value() > 0.0 {
                None
            } else if stands {
                Some(T::ZERO)
            } else {
                Some(distance / speed)
            };
        }
        if let Some(time) = self.time_in_swell(speed, braked) {
            return Some(self.reaction + time);
        }
        if self.stops_in_swell(speed) || distance.value() > self.stopping_distance(speed).value() {
            return None;
        }
        // T = τ + (v − v_k)/a
        Some(self.delay() + (speed - self.speed_at_full(speed, braked)) / self.deceleration)
    }

    /// (m/s) v_sp, the greatest speed from which the vehicle stops within a distance: the spatial avoidance
    /// speed.
    #[must_use]
    pub fn speed_to_stop_within(&self, distance: T) -> T {
        if distance.value() <= 0.0 {
            return T::ZERO;
        }
        let lost = self.lost();
        if self.stopping_distance(lost).value() > distance.value() {
            return self.speed_to_stop_in_swell(distance);
        }
        // v²/2a + v τ − q = s with q = lag − lost²/2a: v = 2 (s + q)/(τ + √(τ² + 2 (s + q)/a))
        let delay = self.delay();
        let way = distance + self.lag() - lost * lost / (self.deceleration * 2.0);
        let root = (delay * delay + way * 2.0 / self.deceleration).sqrt();
        way * 2.0 / (delay + root)
    }

    /// (m/s) the same where it stops within the swell.
    fn speed_to_stop_in_swell(&self, distance: T) -> T {
        match self.form {
            // v t_R + v²/a = s
            Swell::Half | Swell::FullSpeed => {
                let root = (self.reaction * self.reaction + distance * 4.0 / self.deceleration).sqrt();
                distance * 2.0 / (self.reaction + root)
            }
            // v t_R + c v^(3/2) = s with c = ⅔ √(2 t_S/a), for w = √v. The left side lies above its tangents,
            // so Newton's method falls to the root from above.
            Swell::Linear => {
                let c = (self.swell * 2.0 / self.deceleration).sqrt() * 2.0 / 3.0;
                let mut root = self.lost().sqrt();
                for _ in 0..MOST_ITERATIONS {
                    let beyond = root * root * (self.reaction + c * root) - distance;
                    let next = root - beyond / (root * (self.reaction * 2.0 + c * root * 3.0));
                    let is_settled = next.value() >= root.value();
                    root = next;
                    if is_settled {
                        break;
                    }
                }
                root * root
            }
        }
    }

    /// (m/s²) the least deceleration that stops the vehicle within a distance; `None` where the reaction
    /// alone takes all of it.
    #[must_use]
    pub fn deceleration_to_stop_within(&self, speed: T, distance: T) -> Option<T> {
        let braked = distance - speed * self.reaction;
        if braked.value() <= 0.0 {
            return None;
        }
        // Where it stops in the swell: s = ⅔ v √(2 v t_S/a), or s = v²/a.
        let in_swell = match self.form {
            Swell::Linear => speed * speed * speed * self.swell * 8.0 / (braked * braked * 9.0),
            Swell::Half => speed * speed / braked,
            Swell::FullSpeed => T::ZERO,
        };
        if self.with_deceleration(in_swell).stops_in_swell(speed) {
            return Some(in_swell);
        }
        let left = distance - speed * self.delay();
        // v²/2a − q a = s − v τ with q = t_S²/24 or t_S²/8: a = v²/(s − v τ + √((s − v τ)² + 2 q v²))
        let q = self.swell
            * self.swell
            * match self.form {
                Swell::Linear => 1.0 / 24.0,
                Swell::Half => 0.125,
                Swell::FullSpeed => 0.0,
            };
        let square = left * left + q * speed * speed * 2.0;
        // √ of a constant zero has no derivative.
        let root = if square.value() > 0.0 { square.sqrt() } else { T::ZERO };
        let denominator = left + root;
        (denominator.value() > 0.0).then(|| speed * speed / denominator)
    }

    /// (s) the longest reaction time that lets the vehicle stop within a distance; `None` if it does not stop
    /// even without one, or is at rest.
    #[must_use]
    pub fn reaction_to_stop_within(&self, speed: T, distance: T) -> Option<T> {
        let left = distance - self.with_reaction(T::ZERO).stopping_distance(speed);
        (left.value() >= 0.0 && speed.value() > 0.0).then(|| left / speed)
    }

    /// The speed before braking, and the distance and time from the reaction, of a vehicle that had the speed
    /// `at_end` (m/s) after the full deceleration over the distance `braked` (m).
    #[must_use]
    pub fn demand_before(&self, at_end: T, braked: T) -> Demand<T> {
        // v_0 = √(v_c² + 2 a s_B) + lost; s_A = v_0 (t_R + t_S) − lag + s_B
        let square = at_end * at_end + self.deceleration * braked * 2.0;
        let full = if square.value() > 0.0 { square.sqrt() } else { T::ZERO };
        let speed = full + self.lost();
        let distance = speed * (self.reaction + self.swell) - self.lag() + braked;
        let time = self.reaction + self.swell + (full - at_end) / self.deceleration;
        Demand { speed, distance, time }
    }

    /// (m) how far the vehicle is behind one that does not brake, and (m/s) the speed that it has lost, at a
    /// time (s) after the demand: the same at every speed, as long as it moves.
    fn behind(&self, time: T) -> [T; 2] {
        let (a, braked) = (self.deceleration, time - self.reaction);
        if braked.value() <= 0.0 {
            return [T::ZERO; 2];
        }
        let at_full = braked - self.swell;
        if at_full.value() >= 0.0 {
            // D = lag + lost w + a w²/2
            let distance = self.lag() + at_full * (self.lost() + a * at_full * 0.5);
            return [distance, self.lost() + a * at_full];
        }
        match self.form {
            // D = a u³/(6 t_S)
            Swell::Linear => {
                [a * braked * braked * braked / (self.swell * 6.0), a * braked * braked / (self.swell * 2.0)]
            }
            // D = a u²/4
            Swell::Half => [a * braked * braked * 0.25, a * braked * 0.5],
            Swell::FullSpeed => [T::ZERO; 2],
        }
    }

    /// (m/s) the greatest speed that brings the vehicle to a distance no earlier than a time (s) after the
    /// demand: the temporal avoidance speed, if the other party has then just cleared the danger zone. It is
    /// never less than [the speed from which it stops before](Self::speed_to_stop_within).
    ///
    /// The distance must be positive; a time of zero or less has no such speed, and gives infinity.
    #[must_use]
    pub fn speed_to_arrive_after(&self, distance: T, time: T) -> T {
        if time.value() <= 0.0 {
            return T::from(f64::INFINITY);
        }
        // s = v t − D(t), while it moves
        let [behind, slower] = self.behind(time);
        let speed = (distance + behind) / time;
        if speed.value() > slower.value() { speed } else { self.speed_to_stop_within(distance) }
    }

    /// The motion from the demand (at time and place zero) to the stop and beyond, as legs: reaction, swell,
    /// full deceleration, rest. A leg may last no time.
    #[must_use]
    pub fn legs(&self, speed: T) -> [Leg<T>; 4] {
        let reaction = Leg { acceleration: T::ZERO, jerk: T::ZERO, ..Leg::at_rest(T::ZERO, T::ZERO) };
        let reaction = Leg { speed, ..reaction };
        let (acceleration, jerk) = match self.form {
            Swell::Linear if self.swell.value() > 0.0 => (T::ZERO, -self.deceleration / self.swell),
            Swell::Half => (-self.deceleration * 0.5, T::ZERO),
            Swell::Linear | Swell::FullSpeed => (T::ZERO, T::ZERO),
        };
        let stops = self.stops_in_swell(speed);
        let lasts = if stops { self.stop_in_swell(speed) } else { self.swell };
        let swell = Leg { acceleration, jerk, ..reaction.after(self.reaction) };
        let full = Leg { acceleration: -self.deceleration, jerk: T::ZERO, ..swell.after(lasts) };
        let stop = Leg::at_rest(self.stopping_time(speed), self.stopping_distance(speed));
        if stops { [reaction, swell, stop, stop] } else { [reaction, swell, full, stop] }
    }
}
