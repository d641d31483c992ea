use super::*;

/// (t − r₁)(t − r₂)…
fn with_roots(roots: &[f64]) -> Polynomial {
    roots.iter().fold(Polynomial::new([1.0]), |product, &root| product * Polynomial::new([-root, 1.0]))
}

fn assert_points(points: Points, expected: &[f64], tolerance: f64) {
    let found: Vec<f64> = points.into_iter().collect();
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() <= tolerance, "{found:?} {expected:?}");
    }
}

#[test]
fn the_roots_of_a_product_are_those_of_its_factors() {
    let roots = [-0.9, -0.5, -0.49, 0.01, 0.3, 0.31, 0.8, 1.1, 1.3, 1.5, 1.7, 1.9];
    for count in 1..=DEGREE {
        let polynomial = with_roots(&roots[..count]);
        assert_points(polynomial.roots([-1.0, 2.0]), &roots[..count], 1e-9);
        // There is none outside the interval.
        assert_points(polynomial.roots([2.0, 3.0]), &[], 0.0);
        assert_points(polynomial.roots([-2.0, -0.7]), &roots[..1], 1e-9);
    }
}

/// T₈, the eighth Chebyshev polynomial: roots cos((2k−1)π/16), extrema cos(kπ/8).
#[test]
fn chebyshevs_polynomial_has_all_its_roots_and_extrema() {
    let t8 = Polynomial::new([1.0, 0.0, -32.0, 0.0, 160.0, 0.0, -256.0, 0.0, 128.0]);
    let cosine = |k: f64| Real::sin_cos(k * core::f64::consts::PI / 16.0).1;
    let roots: Vec<f64> = [15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0, 1.0].map(cosine).to_vec();
    let extrema: Vec<f64> = [14.0, 12.0, 10.0, 8.0, 6.0, 4.0, 2.0].map(cosine).to_vec();
    assert_points(t8.roots([-1.0, 1.0]), &roots, 1e-14);
    assert_points(t8.extrema([-1.0, 1.0]), &extrema, 1e-14);
}

#[test]
fn two_roots_next_to_each_other_are_told_apart() {
    for gap in [1e-2, 1e-4, 1e-6] {
        let polynomial = with_roots(&[0.4, 0.4 + gap, 3.0]);
        assert_points(polynomial.roots([0.0, 1.0]), &[0.4, 0.4 + gap], 1e-3 * gap);
    }
}

#[test]
fn without_a_root_there_is_none() {
    assert_points(Polynomial::new([1.0]).roots([-1.0, 1.0]), &[], 0.0);
    assert_points(Polynomial::new([1.0]).extrema([-1.0, 1.0]), &[], 0.0);
    assert_points(Polynomial::new([1.0, 0.0, 1.0]).roots([-1.0, 1.0]), &[], 0.0);
    assert_points(Polynomial::new([f64::NAN, 1.0, 1.0]).roots([-1.0, 1.0]), &[], 0.0);
    // A leading coefficient that is zero lowers the degree.
    assert_points(Polynomial::new([-0.5, 1.0, 0.0, 0.0]).roots([-1.0, 1.0]), &[0.5], 0.0);
}

#[test]
fn sums_and_products_have_the_values_of_their_parts() {
    let (p, q) = (Polynomial::new([1.0, -2.0, 3.0]), Polynomial::new([0.5, 4.0, 0.0, -1.0]));
    for t in [-1.5, 0.0, 0.25, 2.0] {
        let (pt, qt) = (1.0 - 2.0 * t + 3.0 * t * t, 0.5 + 4.0 * t - t * t * t);
        assert_eq!(p.at(t), pt);
        assert!(((p + q).at(t) - (pt + qt)).abs() < 1e-13);
        assert!(((p * q).at(t) - pt * qt).abs() < 1e-12);
        assert!(((-2.0 * p).at(t) + 2.0 * pt).abs() < 1e-13);
    }
}

#[test]
fn points_merge_in_order() {
    let merged = with_roots(&[0.1, 0.5]).roots([0.0, 1.0]).merged(with_roots(&[0.3]).roots([0.0, 1.0]));
    assert_points(merged, &[0.1, 0.3, 0.5], 1e-15);
}

/// No more of the factors' roots lie in an interval than the signs allow; if they allow one or none, exactly
/// that many do.
#[test]
fn the_changes_of_sign_bound_the_number_of_roots() {
    let roots = [-0.9, -0.5, -0.49, 0.01, 0.3, 0.31, 0.8, 1.1, 1.3, 1.5, 1.7, 1.9];
    let (mut exact, mut more, mut open) = (0, 0, 0);
    // With a factor (t − a)² + b² there are fewer roots than changes.
    let factors = [[1.0, 0.0, 0.0], [0.02, 0.0, 1.0], [0.3, 0.0, 1.0], [0.5, -1.0, 1.0], [1.1, -2.0, 1.0]];
    for (count, factor) in (1..=8).flat_map(|count| factors.map(|factor| (count, factor))) {
        for chosen in roots.windows(count) {
            let polynomial = with_roots(chosen) * Polynomial::new(factor);
            for low in [-1.0, -0.7, 0.05, 0.5, 0.9, 1.2] {
                for high in [-0.495, 0.25, 0.305, 0.7, 1.0, 1.4, 2.0].into_iter().filter(|high| low < *high) {
                    let inside = chosen.iter().filter(|root| low < **root && **root < high).count();
                    let Some(changes) = polynomial.changes([low, high]) else {
                        open += 1;
                        continue;
                    };
                    assert!(changes >= inside && (changes - inside) % 2 == 0, "{chosen:?} {low} {high}");
                    exact += usize::from(changes == inside);
                    more += usize::from(changes > inside);
                }
            }
        }
    }
    // A root in the middle of an interval may make a coefficient zero.
    assert!(exact > 500 && more > 100 && open < 100, "{exact} {more} {open}");
}

/// A root at an end leaves the sign there to rounding; a NaN has none.
#[test]
fn a_sign_that_rounding_decides_is_left_open() {
    let polynomial = with_roots(&[0.1, 0.7, 3.0]);
    assert_eq!(polynomial.changes([0.0, 0.7]), None);
    assert_eq!(polynomial.changes([0.7, 1.0]), None);
    assert_eq!(polynomial.changes([f64::NAN, 1.0]), None);
    assert_eq!(polynomial.changes([0.0, 0.5]), Some(1));
}

/// Starting near the root, and from points at which Newton's method leaves the interval.
#[test]
fn a_root_is_found_from_anywhere() {
    let polynomial = with_roots(&[-2.0, 0.6, 5.0]);
    for from in [0.6, 0.1, 0.9, -1.9, 4.9, 1e3, -1e3, 0.0, 2.9, f64::NAN] {
        let root = polynomial.root_in([0.0, 1.0], from).unwrap();
        assert!((root - 0.6).abs() < 1e-14, "{from}: {root}");
    }
    assert_eq!(polynomial.root_in([0.7, 1.0], 0.8), None);
}
