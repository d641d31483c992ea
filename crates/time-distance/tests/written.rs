//! Values written with the feature `serde` are read back unchanged, and values that no constructor accepts
//! are refused.

use oracle::written::{assert_again, assert_refused};
use serde_json::json;
use time_distance::{Crossing, Party, Response, Swell};

#[test]
fn responses_and_crossings() {
    assert_again(&Response::new(0.8, 0.2, 7.5, Swell::Half).unwrap());
    let party = Party { front: 1.0, rear: 3.0, width: 1.8 };
    assert_again(&Crossing::new(1.2, [party, party]).unwrap());
    let response = |reaction: f64, deceleration: f64| {
        let form = "Linear";
        json!({ "reaction": reaction, "swell": 0.2, "deceleration": deceleration, "form": form })
    };
    assert_refused::<Response>(response(-0.8, 7.5), "the reaction time is -0.8");
    assert_refused::<Response>(response(0.8, 0.0), "the deceleration is 0");
    let crossing = |angle: f64, width: f64| {
        let party = json!({ "front": 1.0, "rear": 3.0, "width": width });
        json!({ "angle": angle, "parties": [party, party] })
    };
    assert_refused::<Crossing>(crossing(0.0, 1.8), "sine of the angle between the paths");
    assert_refused::<Crossing>(crossing(1.2, -1.8), "the width is -1.8");
}
