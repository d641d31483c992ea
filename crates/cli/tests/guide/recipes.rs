//! Recipes of the guide, followed as they are written.

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

fn deltav(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_deltav")).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// "Reconstruct if neither speed is known": from the velocity of vehicle 2 after an impact with known speeds,
/// the recipe finds both of them again.
#[test]
fn two_unknown_speeds_follow_from_the_motion_after_the_impact() {
    // (m/s) the speed of vehicle 2 that the recipe has to find
    for (template, heading, speed) in [("rear-end", 3.0_f64, 6.0), ("front-side", 90.0, 8.0)] {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("unknown-{template}.toml"));
        let text = deltav(&["new", "--template", template]);
        let solve = |speed: f64| -> Value {
            let mut in_vehicle2 = false;
            let lines = text.lines().map(|line| {
                in_vehicle2 = line.starts_with("[vehicle2]") || in_vehicle2 && !line.starts_with('[');
                let is_speed = in_vehicle2 && line.starts_with("speed ");
                if is_speed { format!("speed = \"{speed} m/s\"\n") } else { format!("{line}\n") }
            });
            fs::write(&path, lines.collect::<String>()).unwrap();
            let name = path.to_str().unwrap();
            serde_json::from_str(&deltav(&["reconstruct", name, "--exact", "--format", "json"])).unwrap()
        };
        let vector = |of: &Value, key: &str| -> [f64; 2] {
            [0, 1].map(|axis| of["vehicle2"][key][axis].as_f64().unwrap())
        };
        let truth = solve(speed);
        let after = vector(&truth, "final_velocity");
        let (y, x) = heading.to_radians().sin_cos();
        let mut guess = 0.0;
        for _ in 0..8 {
            let change = vector(&solve(guess), "delta_v_vector");
            guess = (after[0] - change[0]) * x + (after[1] - change[1]) * y;
        }
        assert!((guess - speed).abs() < 0.01, "{template}: {guess}");
        let found = solve(guess)["found"]["value"].as_f64().unwrap();
        assert!((found - truth["found"]["value"].as_f64().unwrap()).abs() < 0.01, "{template}: {found}");
    }
}
