//! The closed forms of a response, compared with a simulation that uses none of them.

use proptest::prelude::*;
use time_distance::{Course, Response, Swell};

/// One road user in small steps: its acceleration at a time is computed from the definition alone.
struct Stepped {
    reaction: f64,
    swell: f64,
    full: f64,
    form: Swell,
}

impl Stepped {
    fn deceleration(&self, time: f64) -> f64 {
        let braked = time - self.reaction;
        if braked < 0.0 {
            0.0
        } else if braked < self.swell {
            match self.form {
                Swell::Linear => self.full * braked / self.swell,
                Swell::Half => self.full / 2.0,
                Swell::FullSpeed => 0.0,
            }
        } else {
            self.full
        }
    }

    /// Distance, time and speed where it stops or has gone `until`: steps of the exact integral of a
    /// deceleration that is linear in the time, which it is between the corners that the steps meet.
    fn run(&self, speed: f64, until: f64) -> [f64; 3] {
        let corners = [self.reaction, self.reaction + self.swell];
        let (mut s, mut t, mut v) = (0.0, 0.0, speed);
        loop {
            let next = corners.into_iter().find(|corner| *corner > t).unwrap_or(f64::INFINITY);
            let whole = (next - t).min(1e-3_f64.max((next - t) / 400.0)).min(0.01);
            let state = |h: f64| {
                // A quarter from either end, as the ends of a short step are at a corner but for rounding.
                let (a, b) = (self.deceleration(t + h * 0.25), self.deceleration(t + h * 0.75));
                // Exact for a linear deceleration.
                let v1 = v - (a + b) / 2.0 * h;
                let s1 = s + v * h - (5.0 * a + b) / 12.0 * h * h;
                (s1, v1)
            };
            let is_end = |h: f64| {
                let (s1, v1) = state(h);
                s1 >= until || v1 <= 0.0
            };
            if !is_end(whole) {
                (s, v) = state(whole);
                t = if whole == next - t { next } else { t + whole };
                continue;
            }
            let (mut low, mut high) = (0.0, whole);
            for _ in 0..200 {
                let middle = f64::midpoint(low, high);
                if is_end(middle) { high = middle } else { low = middle }
            }
            let (s1, v1) = state(high);
            return [s1, t + high, v1.max(0.0)];
        }
    }
}

fn scenes() -> impl Strategy<Value = (f64, f64, f64, f64, Swell)> {
    let form = prop_oneof![Just(Swell::Linear), Just(Swell::Half), Just(Swell::FullSpeed)];
    (0.1..60.0_f64, 0.0..2.5_f64, prop_oneof![Just(0.0), 0.01..0.8_f64], 0.5..11.0_f64, form)
}

#[track_caller]
fn near(found: f64, expected: f64, scale: f64, what: &str) {
    assert!((found - expected).abs() <= 1e-9 * scale.max(1.0), "{what}: {found} for {expected}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn a_stop_is_where_the_steps_end((v, reaction, swell, full, form) in scenes()) {
        let response = Response::new(reaction, swell, full, form).unwrap();
        let [s, t, _] = Stepped { reaction, swell, full, form }.run(v, f64::INFINITY);
        near(response.stopping_distance(v), s, s, "distance");
        near(response.stopping_time(v), t, t, "time");
    }

    #[test]
    fn a_place_is_passed_when_and_as_the_steps_pass_it(
        (v, reaction, swell, full, form) in scenes(),
        share in 0.01..0.97_f64,
    ) {
        let response = Response::new(reaction, swell, full, form).unwrap();
        let stop = response.stopping_distance(v);
        let [s, t, at] = Stepped { reaction, swell, full, form }.run(v, share * stop);
        // Where the speed is small it is the root of a small difference.
        let scale = v * v / at.max(1e-3);
        near(response.speed_after(v, s), at, scale, "speed");
        near(response.arrival(v, s).unwrap(), t, t * scale, "arrival");
        prop_assert!(response.arrival(v, stop * 1.01).is_none());
        prop_assert_eq!(response.speed_after(v, stop * 1.01), 0.0);
        // The legs are the same motion.
        let legs = response.legs(v);
        let course = Course::new(&legs).unwrap();
        near(course.at(t).position, s, s, "leg");
        near(course.reaches(s).unwrap(), t, t * scale, "reached");
        near(course.at(t + 1e4).position, stop, stop, "stop");
    }

    #[test]
    fn each_has_its_inverse((v, reaction, swell, full, form) in scenes(), share in 0.05..0.97_f64) {
        let response = Response::new(reaction, swell, full, form).unwrap();
        let stop = response.stopping_distance(v);
        near(response.speed_to_stop_within(stop), v, v, "speed");
        near(response.deceleration_to_stop_within(v, stop).unwrap(), full, full * 1e3, "deceleration");
        near(response.reaction_to_stop_within(v, stop).unwrap(), reaction, stop / v, "reaction");
        let place = share * stop;
        let time = response.arrival(v, place).unwrap();
        near(response.speed_to_arrive_after(place, time), v, v, "temporal");
        // If the time is after the stop, only a vehicle that stops before the place has not passed it by
        // then.
        let spatial = response.speed_to_stop_within(place);
        let late = response.stopping_time(spatial) + 1.0;
        near(response.speed_to_arrive_after(place, late), spatial, v, "without end");
        prop_assert!(response.speed_to_arrive_after(place, time * 1.1) >= spatial);
        // Back from the place of the impact, where the full deceleration had begun before it.
        let left = response.speed_after(v, place);
        let lost = if form == Swell::FullSpeed { 0.0 } else { full * swell / 2.0 };
        if left < v - lost {
            let braked = ((v - lost).powi(2) - left * left) / (2.0 * full);
            let demand = response.demand_before(left, braked);
            near(demand.speed, v, v * v / left.max(1e-2), "speed back");
            near(demand.distance, place, place * 1e3, "distance back");
            near(demand.time, time, time * 1e3, "time back");
        }
    }

    /// Derivatives compared with central differences, through every branch.
    #[test]
    fn derivatives_are_exact((v, reaction, swell, full, form) in scenes(), share in 0.05..0.9_f64) {
        use time_distance::Real;
        type D = real::Duals<1>;
        let wide = |x: f64| D::from(x);
        let of = |v: f64| {
            let response = Response::new(reaction, swell, full, form).unwrap();
            let place = share * response.stopping_distance(30.0);
            [
                response.stopping_distance(v), response.speed_after(v, place),
                response.arrival(v, place).unwrap_or(0.0), response.speed_to_stop_within(v),
            ]
        };
        let response = Response::new(wide(reaction), wide(swell), wide(full), form).unwrap();
        let place = share * Response::new(reaction, swell, full, form).unwrap().stopping_distance(30.0);
        let input = D::variable(v, 0);
        let found = [
            response.stopping_distance(input), response.speed_after(input, wide(place)),
            response.arrival(input, wide(place)).unwrap_or(wide(0.0)), response.speed_to_stop_within(input),
        ];
        let h = v * 1e-6;
        let (above, below) = (of(v + h), of(v - h));
        for ((found, above), below) in found.into_iter().zip(above).zip(below) {
            let expected = (above - below) / (2.0 * h);
            let slope = found.derivatives[0];
            let curved = (above - 2.0 * found.value() + below).abs() / (h * h);
            // Not across a corner, nor where the root of nothing begins.
            if curved * h < 1e-3 * expected.abs().max(1e-3) {
                prop_assert!((slope - expected).abs() <= 1e-4 * expected.abs().max(1.0), "{} {}", slope, expected);
            }
        }
    }
}

proptest! {
    // One in a few thousand is enough to go wrong.
    #![proptest_config(ProptestConfig::with_cases(50_000))]

    /// Within rounding of the stop, its moment is good to what that leaves: √(2 δ/a).
    #[test]
    fn the_moment_of_the_stop_is_no_noise((v, reaction, swell, full, form) in scenes(), short in 0_u32..60) {
        let response = Response::new(reaction, swell, full, form).unwrap();
        let legs = response.legs(v);
        let [stop, time] = [legs[3].position, legs[3].time];
        let rounding = f64::from(short) * f64::EPSILON * stop;
        let reached = Course::new(&legs).unwrap().reaches(stop - rounding).unwrap();
        let left = (2.0 * (rounding + 4.0 * f64::EPSILON * stop) / full).sqrt();
        prop_assert!((reached - time).abs() <= 4.0 * left + 1e-9, "{} {} {}", reached, time, left);
    }
}

#[test]
fn what_cannot_be_is_refused() {
    for (reaction, swell, full) in
        [(-0.1, 0.2, 7.0), (1.0, -0.2, 7.0), (1.0, 0.2, 0.0), (f64::NAN, 0.2, 7.0), (1.0, 0.2, f64::INFINITY)]
    {
        assert!(Response::new(reaction, swell, full, Swell::Linear).is_err(), "{reaction} {swell} {full}");
    }
    let response = Response::new(1.0, 0.2, 7.0, Swell::Linear).unwrap();
    assert_eq!(response.deceleration_to_stop_within(20.0, 20.0), None);
    assert_eq!(response.reaction_to_stop_within(20.0, 20.0), None);
    assert_eq!(response.arrival(0.0, 1.0), None);
    assert_eq!(response.speed_to_stop_within(0.0), 0.0);
}
