//! Values written with the feature `serde` are read back unchanged.

use oracle::written::assert_again;
use serde_json::{json, to_value};

#[test]
fn numbers_with_derivatives() {
    // f = x² + 0.1 at 3: f = 9.1, f′ = 6.
    let gradients = real::gradients(&[3.0], |x| Ok::<_, ()>(vec![x[0] * x[0] + 0.1])).unwrap();
    assert_again(&gradients);
    assert_eq!(to_value(&gradients).unwrap(), json!([{ "value": 9.1, "by": [6.0] }]));
    assert_again(&real::gradients(&[0.7], |x| Ok::<_, ()>(vec![x[0] / 3.0])).unwrap());
}
