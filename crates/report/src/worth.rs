//! How accurately numbers of a case are usually known: the error that an interval omits if they are taken as
//! exact.

/// The usual accuracy of a number.
pub(crate) struct Worth {
    /// Its usual error.
    pub(crate) error: &'static str,
    /// The source of that.
    pub(crate) source: &'static str,
}

pub(crate) const SMITH_NOGA: &str = "Smith and Noga (1982), 34 pairs of measurements";
pub(crate) const STAGED_MOTION: &str =
    "simulated motions of the RICSAC tests 3 and 6 against the measured ones";
pub(crate) const BARRIER_TESTS: &str = "698 full-width frontal barrier tests of NHTSA";

/// For the key of a number, or of a list of numbers.
pub(crate) fn worth(key: &str) -> Option<Worth> {
    let in_vehicle = key.split_once('.').filter(|(table, _)| table.starts_with("vehicle"));
    let key = in_vehicle.map_or(key, |(_, key)| key);
    let (error, source) = match key {
        "crush.depths" => {
            ("each: std. dev. 1.5 in (38 mm), and 0.3 in (8 mm) too deep on average", SMITH_NOGA)
        }
        "crush.width" => ("std. dev. 3.0 in (76 mm)", SMITH_NOGA),
        "crush.offset" => ("std. dev. 1.8 in (46 mm)", SMITH_NOGA),
        "contact" => (
            "at the centroid of the damage: 2.3 in (60 mm) along the face, 1.5 in (38 mm) across",
            SMITH_NOGA,
        ),
        "weight" | "mass" => ("std. dev. 65 lb (29 kg)", SMITH_NOGA),
        "crush.pdof" => ("±20° with a probability of 95 %", SMITH_NOGA),
        "crush.stiffness" => {
            ("one vehicle among others: std. dev. 0.38 of ln A, 0.59 of ln B", BARRIER_TESTS)
        }
        "yaw_inertia" => ("k to ±5 %, if from a class or Burg's formula", "docs/theory.md, section 5"),
        "crush.stiffness.test.no_damage_speed" => ("usually 8 ± 3 km/h (5 ± 2 mph)", "custom"),
        "impact.restitution" => (
            "0.10, std. dev. 0.08, above 10 m/s (22 mph)",
            "ranges of Brach, Smith and Tsongas, Rose, SAE 931842",
        ),
        "surface.friction" => ("±10 %, if it was not measured with such a vehicle", STAGED_MOTION),
        "after.drag" => {
            ("std. dev. 0.3 of its logarithm, because damage and brakes are rarely known", STAGED_MOTION)
        }
        "after.rest.x" | "after.rest.y" => {
            ("as exact as a simulation can be: 10 % of the path and 0.5 m", STAGED_MOTION)
        }
        "after.rest.heading" | "after.rest.turned" => {
            ("as exact as a simulation can be: 15°, if it turned by more than 60°", STAGED_MOTION)
        }
        "after.direction" => ("std. dev. 5° to 10°", "diagrams of the RICSAC tests"),
        _ => return None,
    };
    Some(Worth { error, source })
}
