//! The equations of SAE 980025 in its own symbols, with its misprints corrected (docs/theory.md, sections 3,
//! 4 and 8), compared with the matrix form of `pim-core`; and each misprinted one, to show that it is wrong.
//!
//! The paper's equations are for vehicles without yaw rate before impact.

use oracle::compare::{assert_close, assert_printed, assert_relative};
use oracle::scenes::{Car, Scene, for_all, scene};
use oracle::{Effects, Scale, approach};
use pim_core::{Outcome, Tangential};

use crate::paper_example::{D0, D1, DEPTHS, FOOT, POUND_FORCE, WIDTHS, reconciliation};

/// The symbols of the paper's Eq 1 to Eq 3.
struct Paper {
    reduced_mass: f64,
    /// A, B and C of theory, section 2: m̄ k_nn, −m̄ k_nt, m̄ k_tt − 1.
    a: f64,
    b: f64,
    c: f64,
    /// d_a, d_b, d_c, d_d.
    arms: [f64; 4],
    e: f64,
    /// (v_2t − v_1t)/(v_2n − v_1n).
    r: f64,
    u_n: f64,
}

impl Paper {
    fn of(scene: &Scene) -> Self {
        let [one, two] = scene.cars;
        let (w1, w2) = (one.inverse_mass(), two.inverse_mass());
        // m̄ = m₁m₂/(m₁+m₂)
        let reduced_mass = 1.0 / (w1 + w2);
        let angle = |car: &Car| car.heading + car.angle - scene.crush_plane;
        // d_a = d₂ sin(θ₂+φ₂−Γ),  d_b = d₂ cos(…),  d_c = d₁ sin(θ₁+φ₁−Γ),  d_d = d₁ cos(…)
        let arms @ [d_a, d_b, d_c, d_d] = [
            two.distance * angle(&two).sin(),
            two.distance * angle(&two).cos(),
            one.distance * angle(&one).sin(),
            one.distance * angle(&one).cos(),
        ];
        // m̄/(mᵢ kᵢ²)
        let (s1, s2) = (reduced_mass * one.inverse_yaw_inertia(), reduced_mass * two.inverse_yaw_inertia());
        // The axes of the plane, oriented or not: u_n and u_t change sign together.
        let (sin, cos) = scene.crush_plane.sin_cos();
        let [x, y] = [0, 1].map(|axis| one.velocity[axis] - two.velocity[axis]);
        let (u_n, u_t) = (x * cos + y * sin, y * cos - x * sin);
        Self {
            reduced_mass,
            a: 1.0 + s1 * d_c * d_c + s2 * d_a * d_a,
            b: s1 * d_c * d_d + s2 * d_a * d_b,
            c: s1 * d_d * d_d + s2 * d_b * d_b,
            arms,
            e: scene.restitution,
            r: u_t / u_n,
            u_n,
        }
    }

    /// Eq 2, corrected.
    fn q(&self, mu: f64) -> f64 {
        // 1/q = A − μ B
        1.0 / (self.a - mu * self.b)
    }

    /// The ratio at which the final tangential velocities are equal.
    fn critical_ratio(&self) -> f64 {
        let Self { a, b, c, e, r, .. } = self;
        // μ_c = [r A + (1+e) B] / [(1+e)(1+C) + r B]
        (r * a + (1.0 + e) * b) / ((1.0 + e) * (1.0 + c) + r * b)
    }

    /// The term in braces in the corrected Eq 3, and in the denominator of the corrected Eq 1.
    fn braces(&self, mu: f64) -> f64 {
        let Self { b, c, e, r, .. } = self;
        // (1−e) + 2 μ r − (1+e) μ q [ μ(1+C) − B ]
        (1.0 - e) + 2.0 * mu * r - (1.0 + e) * mu * self.q(mu) * (mu * (1.0 + c) - b)
    }

    /// Eq 3, corrected.
    fn energy_loss(&self, mu: f64) -> f64 {
        // E_L = ½ m̄ q u_n² (1+e) {…}
        0.5 * self.reduced_mass * self.q(mu) * self.u_n.powi(2) * (1.0 + self.e) * self.braces(mu)
    }

    /// Eq 1, corrected.
    fn momentum_change(&self, mu: f64, energy_loss: f64) -> f64 {
        // |mᵢ ΔVᵢ| = √( 2 m̄ (1+μ²)(1+e) q E_L / {…} )
        (2.0 * self.reduced_mass * (1.0 + mu * mu) * (1.0 + self.e) * self.q(mu) * energy_loss
            / self.braces(mu))
        .sqrt()
    }

    /// Eq 4 for the normal impulse.
    fn normal_work(&self, mu: f64) -> f64 {
        // W_n = ½ m̄ q u_n² (1 − e²)
        0.5 * self.reduced_mass * self.q(mu) * self.u_n.powi(2) * (1.0 - self.e * self.e)
    }
}

/// A random collision of vehicles that do not turn before impact.
fn without_yaw(scene: Scene) -> Scene {
    scene.with_cars(|car| Car { yaw_rate: 0.0, ..car }).approaching()
}

#[test]
fn the_mended_equations_are_those_of_the_matrix() {
    for_all(50_000, 0.6, scene(), |scene| {
        let scene = scene.without_moment();
        let scene = without_yaw(scene);
        let Ok(outcome) = scene.impact() else { return false };
        let effects = Effects::from(&outcome);
        let scale = Scale::of(&scene, &effects);
        let paper = Paper::of(&scene);
        let mu = outcome.impulse_ratio;
        if let Some(critical) = outcome.critical_impulse_ratio {
            assert_close("μ_c", critical, paper.critical_ratio(), scale.critical_ratio * 1e-10);
        }
        let p_n = outcome.impulse.normal;
        // P_n = −(1+e) m̄ q u_n
        let expected = (1.0 + paper.e) * paper.reduced_mass * paper.q(mu) * paper.u_n.abs();
        assert_close("P_n", p_n, expected, scale.impulse * 1e-10);
        assert_close("W_n", outcome.energy.normal_work, paper.normal_work(mu), scale.work * 1e-10);
        assert_close("E_L", outcome.energy.loss, paper.energy_loss(mu), scale.work * 1e-10);
        // Eq 1 divides the loss by the braces: if both vanish, it is indeterminate.
        if paper.braces(mu) < 1e-3 {
            return false;
        }
        for (car, dv) in scene.cars.iter().zip(outcome.delta_v_magnitude()) {
            if !car.fixed {
                let expected = paper.momentum_change(mu, outcome.energy.loss);
                assert_close("|m ΔV|", car.mass * dv, expected, scale.impulse / 1e-3 * 1e-10);
            }
        }
        true
    });
}

#[test]
fn the_paper_s_arms_are_the_arms_in_the_axes_of_the_crush_plane() {
    for_all(2000, 1.0, scene(), |scene| {
        let scene = scene.without_moment();
        let contact = scene.contact();
        let [d_a, d_b, d_c, d_d] = Paper::of(&scene).arms;
        let n = contact.normal();
        // The paper does not orient n: with the other normal all four change sign.
        let sign =
            if n.x * scene.crush_plane.cos() + n.y * scene.crush_plane.sin() > 0.0 { 1.0 } else { -1.0 };
        let [r1, r2] = contact.arms();
        for (actual, expected) in
            [(r1.normal, d_d), (r1.tangential, d_c), (r2.normal, d_b), (r2.tangential, d_a)]
        {
            assert_close("arm", actual, sign * expected, 1e-12 * 6.0);
        }
        true
    });
}

#[test]
fn the_matrix_holds_the_paper_s_coefficients() {
    for_all(2000, 1.0, scene(), |scene| {
        let scene = scene.without_moment();
        let k = scene.contact().inverse_mass();
        let Paper { reduced_mass, a, b, c, .. } = Paper::of(&scene);
        let size = a + c;
        assert_close("A", reduced_mass * k.nn, a, size * 1e-12);
        assert_close("−B", reduced_mass * k.nt, -b, size * 1e-12);
        assert_close("1 + C", reduced_mass * k.tt, 1.0 + c, size * 1e-12);
        assert!(k.determinant() > 0.0);
        assert_close("det K", k.determinant(), k.nn * k.tt - k.nt * k.nt, k.nn * k.tt * 1e-12);
        true
    });
}

/// The example in the appendix, in the paper's symbols.
fn example() -> (Scene, Outcome, Paper) {
    let outcome = reconciliation().outcome;
    let car = |weight: f64, inertia: f64, heading: f64, distance: f64, angle: f64, i: usize| {
        let mass = weight * 0.453_592_37;
        let velocity = outcome.before[i].velocity;
        Car {
            fixed: false,
            mass,
            yaw_radius: (inertia * POUND_FORCE * FOOT / mass).sqrt(),
            heading: heading.to_radians(),
            distance: distance * FOOT,
            angle: angle.to_radians(),
            velocity: [velocity.x, velocity.y],
            yaw_rate: 0.0,
        }
    };
    let scene = Scene {
        cars: [car(3696.0, 2437.0, 180.0, 6.3, -22.4, 0), car(3413.0, 2165.0, 67.0, 3.8, -39.0, 1)],
        crush_plane: (-23_f64).to_radians(),
        restitution: 0.3,
        tangential: Tangential::Critical,
        moment: -1.0,
    };
    let paper = Paper::of(&scene);
    (scene, outcome, paper)
}

/// ERRATUM, Eq 1: printed with (1+μ) for (1+μ²), and with −μ²r/μ_c for the term in braces. That is equal for
/// B = 0, or at μ = μ_c if this is not the text's r/(1+e) either.
#[test]
fn eq_1_as_printed_is_not_the_momentum_change() {
    let (scene, at_critical, paper) = example();
    let half = 0.5 * at_critical.impulse_ratio;
    let sliding = Scene { tangential: Tangential::Ratio(half), ..scene }.impact().unwrap();
    let denominator = |mu: f64, mu_c: f64| (1.0 - paper.e) + 2.0 * mu * paper.r - mu * mu * paper.r / mu_c;
    for (outcome, mu_c) in [
        (at_critical, paper.r / (1.0 + paper.e)),
        (sliding, paper.r / (1.0 + paper.e)),
        (sliding, paper.critical_ratio()),
    ] {
        let (mu, loss) = (outcome.impulse_ratio, outcome.energy.loss);
        let momentum = scene.cars[0].mass * outcome.delta_v_magnitude()[0];
        assert_relative("Eq 1, mended", paper.momentum_change(mu, loss), momentum, 1e-10);
        let printed = |factor: f64, denominator: f64| {
            (2.0 * paper.reduced_mass * factor * (1.0 + paper.e) * paper.q(mu) * loss / denominator).sqrt()
        };
        for (what, wrong) in [
            ("1+μ", printed(1.0 + mu, paper.braces(mu))),
            ("μ²r/μ_c", printed(1.0 + mu * mu, denominator(mu, mu_c))),
            ("both", printed(1.0 + mu, denominator(mu, mu_c))),
        ] {
            assert!((wrong / momentum - 1.0).abs() > 1e-3, "{what}: {wrong} {momentum}");
        }
    }
    let critical = paper.critical_ratio();
    assert_relative("the denominator", denominator(critical, critical), paper.braces(critical), 1e-12);
    // For B = 0, a central impact, the two denominators are equal.
    let (scene, paper) = central();
    let mu = 0.5 * paper.critical_ratio();
    let printed = (1.0 - paper.e) + 2.0 * mu * paper.r - mu * mu * paper.r / paper.critical_ratio();
    assert_relative("the denominator", printed, paper.braces(mu), 1e-12);
    assert!(approach(&scene)[0] < 0.0);
}

/// C on the line between the CGs, which is normal to the crush plane: the arms are along n.
fn central() -> (Scene, Paper) {
    let car = Car {
        fixed: false,
        mass: 1500.0,
        yaw_radius: 1.4,
        heading: 0.0,
        distance: 0.0,
        angle: 0.0,
        velocity: [10.0, 3.0],
        yaw_rate: 0.0,
    };
    let other = Car { mass: 1100.0, distance: 1e-3, velocity: [-5.0, -2.0], ..car };
    let scene = Scene {
        cars: [Car { angle: std::f64::consts::PI, ..car }, Car { velocity: [12.0, 8.0], ..other }],
        crush_plane: 0.0,
        restitution: 0.3,
        tangential: Tangential::Critical,
        moment: -1.0,
    }
    .approaching();
    // Point masses: C at both CGs except for a millimetre that orients the normal, omitted in the paper's
    // arms.
    let point = scene.with_cars(|car| Car { distance: 0.0, ..car });
    (scene, Paper::of(&point))
}

/// ERRATUM, Eq 2: printed with m_2 k_1² below d_c d_d, +μ, d_b and d_d as sines, and angles without Γ.
#[test]
fn eq_2_as_printed_is_not_the_normal_impulse() {
    let (scene, outcome, paper) = example();
    let [one, two] = scene.cars;
    let mu = outcome.impulse_ratio;
    // q from the impulse itself: P_n = −(1+e) m̄ q u_n.
    let q = outcome.impulse.normal / ((1.0 + paper.e) * paper.reduced_mass * paper.u_n.abs());
    let m = paper.reduced_mass;
    let (k1, k2) = (one.yaw_radius.powi(2), two.yaw_radius.powi(2));
    let eq2 = |[d_a, d_b, d_c, d_d]: [f64; 4], mass_of_dc_dd: f64, sign: f64| {
        let cross = m * d_c * d_d / (mass_of_dc_dd * k1) + m * d_a * d_b / (two.mass * k2);
        1.0 / (1.0 + m * d_a * d_a / (two.mass * k2) + m * d_c * d_c / (one.mass * k1) + sign * mu * cross)
    };
    assert_relative("Eq 2, mended", eq2(paper.arms, one.mass, -1.0), q, 1e-10);
    let angles = scene.cars.map(|car| car.heading + car.angle);
    let sine = [two.distance * angles[1].sin(), one.distance * angles[0].sin()];
    let as_printed = [sine[0], sine[0], sine[1], sine[1]];
    let without_plane = [sine[0], two.distance * angles[1].cos(), sine[1], one.distance * angles[0].cos()];
    let [d_a, _, d_c, _] = paper.arms;
    for (what, q_printed, least) in [
        ("all of it", eq2(as_printed, two.mass, 1.0), 0.01),
        ("m_2 k_1²", eq2(paper.arms, two.mass, -1.0), 1e-4),
        ("+μ", eq2(paper.arms, one.mass, 1.0), 0.01),
        ("sines", eq2([d_a, d_a, d_c, d_c], one.mass, -1.0), 0.01),
        ("no Γ", eq2(without_plane, one.mass, -1.0), 0.01),
    ] {
        assert!((q_printed / q - 1.0).abs() > least, "{what}: {}", q_printed / q - 1.0);
    }
}

/// ERRATUM, Eq 3: printed without q, and with (1+μ)μ² for the last term.
#[test]
fn eq_3_as_printed_is_not_the_energy_loss() {
    let (_, outcome, paper) = example();
    let mu = outcome.impulse_ratio;
    let loss = outcome.energy.loss;
    assert_relative("Eq 3, mended", paper.energy_loss(mu), loss, 1e-10);
    let printed_braces = (1.0 - paper.e) + 2.0 * mu * paper.r - (1.0 + mu) * mu * mu;
    let eq3 =
        |q: f64, braces: f64| 0.5 * paper.reduced_mass * q * paper.u_n.powi(2) * (1.0 + paper.e) * braces;
    assert!((eq3(1.0, printed_braces) / loss - 1.0).abs() > 0.1);
    assert!((eq3(1.0, paper.braces(mu)) / loss - 1.0).abs() > 0.1);
    assert!((eq3(paper.q(mu), printed_braces) / loss - 1.0).abs() > 0.01);
}

/// ERRATUM: the text's μ_c = r/(1+e) is that of point masses.
#[test]
fn the_printed_critical_ratio_is_that_of_a_central_impact() {
    let (_, outcome, paper) = example();
    let printed = paper.r / (1.0 + paper.e);
    let critical = outcome.critical_impulse_ratio.unwrap();
    assert_relative("μ_c", paper.critical_ratio(), critical, 1e-10);
    assert!((printed / critical - 1.0).abs() > 0.1, "{printed} {critical}");
    let (scene, paper) = central();
    // The effect of the millimetre of arm is (0.001/1.4)².
    let critical = scene.impact().unwrap().critical_impulse_ratio.unwrap();
    assert_relative("μ_c of a central impact", critical, paper.r / (1.0 + paper.e), 1e-6);
    assert_relative("μ_c of a central impact", paper.critical_ratio(), paper.r / (1.0 + paper.e), 1e-14);
}

/// ERRATUM, Eq 5: printed with B/6 on the squares only and 5G outside L/5. Taken literally, in feet and
/// pounds, it gives vehicle 1 of the example 80.4 kJ instead of 102.2 kJ.
#[test]
fn eq_5_as_printed_is_not_the_crush_energy() {
    let c = DEPTHS[0].map(|inch| inch / 12.0);
    let width = WIDTHS[0] / 12.0;
    let (a, b, g) = (D0[0] * D1[0], D1[0] * D1[0], D0[0] * D0[0] / 2.0);
    let inner: f64 = c[1..5].iter().sum();
    let depths = c[0] + 2.0 * inner + c[5];
    let squares = c[0].powi(2) + 2.0 * c[1..5].iter().map(|c| c * c).sum::<f64>() + c[5].powi(2);
    let products: f64 = c.windows(2).map(|pair| pair[0] * pair[1]).sum();
    let joule = POUND_FORCE * FOOT;
    // E = (L/5)[ (A/2)(C₁+2C₂+…) + (B/6)(C₁²+2C₂²+…) + C₁C₂+… ] + 5G
    let printed = width / 5.0 * (a / 2.0 * depths + b / 6.0 * squares + products) + 5.0 * g;
    assert_printed(printed * joule / 1e3, "80.4");
    // E = (L/5)[ (A/2)(C₁+2C₂+…) + (B/6)(C₁²+2C₂²+… + C₁C₂+…) + 5G ]
    let mended = width / 5.0 * (a / 2.0 * depths + b / 6.0 * (squares + products) + 5.0 * g);
    assert_printed(mended * joule, "102165");
}

/// ERRATUM: the text prints 1 + tan² 30° = 1.25.
#[test]
fn the_square_of_the_tangent_of_30_degrees_is_a_third() {
    assert_printed(1.0 + 30_f64.to_radians().tan().powi(2), "1.333");
    let factor = crash3::ObliqueCorrection::Capped.factor(30_f64.to_radians()).unwrap().factor;
    assert_relative("1 + tan² 30°", factor, 4.0 / 3.0, 1e-15);
}
