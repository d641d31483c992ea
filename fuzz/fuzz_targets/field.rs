//! Whatever is in a table of crashes, it ends in an error that can be shown or in pairs whose numbers are
//! plausible.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    match field::read(text) {
        Ok(pairs) => {
            for pair in &pairs {
                for vehicle in &pair.vehicles {
                    assert!(vehicle.curb_mass > 0.0 && vehicle.mass() < 1e6);
                    assert!(vehicle.depths.iter().all(|depth| (0.0..100.0).contains(depth)));
                    assert!(vehicle.recorder.iter().flatten().all(|speed| speed.abs() < 1e3));
                }
            }
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
});
