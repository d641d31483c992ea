//! Reads a question to an estimate.

use analysis::{Kind, Output};
use case::{Dimension, read_quantity};

use super::Question;

impl Question {
    /// Reads a question such as `vehicle1.speed 50 km/h`: one of the results of the case, and a limit.
    ///
    /// # Errors
    /// A sentence, if the case has no such result, or if the limit does not have a unit of that result.
    pub fn read(text: &str, outputs: &[Output]) -> Result<Self, String> {
        let text = text.trim();
        let (key, limit) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
        let Some(&output) = outputs.iter().find(|output| output.path() == key) else {
            let keys: Vec<String> = outputs.iter().map(|output| output.path()).collect();
            return Err(format!("the case has no result of this name; its results are {}", keys.join(", ")));
        };
        Ok(Self { output, limit: limit_of(limit.trim(), output.quantity().kind)? })
    }
}

/// (SI) a number with a unit of its kind.
fn limit_of(text: &str, kind: Kind) -> Result<f64, String> {
    let dimension = match kind {
        Kind::Ratio => {
            let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
            return number.ok_or_else(|| "give a number without a unit, such as 0.3".to_owned());
        }
        Kind::Energy => Dimension::Energy,
        Kind::Speed => Dimension::Speed,
        Kind::Length => Dimension::Length,
        Kind::Angle => Dimension::Angle,
        Kind::YawRate => Dimension::YawRate,
        Kind::Time => Dimension::Time,
        // No result of an estimate is of these kinds.
        Kind::Impulse | Kind::MomentImpulse | Kind::Force => {
            return Err("no limit can be given for this result".to_owned());
        }
    };
    let quantity = read_quantity(text, dimension);
    quantity.map(|quantity| quantity.si()).map_err(|error| format!("{error}; {}", error.help()))
}

#[cfg(test)]
mod tests {
    use analysis::quantities::{CRUSH_ENERGY, IMPACT_CLOSING_SPEED, IMPACT_RESTITUTION};

    use crate::Question;

    #[test]
    fn a_question_names_a_result_and_a_limit() {
        let closing = IMPACT_CLOSING_SPEED.of_collision();
        let outputs = [closing, IMPACT_RESTITUTION.of_collision(), CRUSH_ENERGY.of_collision()];
        let limit = |text: &str| Question::read(text, &outputs).map(|question| question.limit);
        assert_eq!(Question::read("impact.closing_speed 36 km/h", &outputs).unwrap().output, closing);
        assert_eq!(limit(" impact.closing_speed  36 km/h "), Ok(10.0));
        assert_eq!(limit("impact.closing_speed -36 km/h"), Ok(-10.0));
        assert_eq!(limit("impact.restitution 0.3"), Ok(0.3));
        assert_eq!(limit("crush_energy 50 kJ"), Ok(50_000.0));
        assert_eq!(limit("crush_energy 50000 N m"), Ok(50_000.0));
        // 1 ft·lb is 1.355 817 95 J; the case file and the CSV write it with a blank.
        for spelled in ["ft-lb", "ft·lb", "ft lb"] {
            let joule = limit(&format!("crush_energy 1000 {spelled}")).unwrap();
            assert!((joule - 1355.818).abs() < 1e-3, "{spelled}: {joule}");
        }
        for (text, says) in [
            ("speed 50 km/h", "its results are impact.closing_speed, impact.restitution, crush_energy"),
            ("", "its results are impact.closing_speed"),
            ("impact.closing_speed", "a speed"),
            ("impact.closing_speed 50", "km/h"),
            ("impact.closing_speed 50 kg", "a speed"),
            ("impact.restitution 3 m", "without a unit"),
            ("crush_energy 5 km/h", "an energy"),
            ("crush_energy inf J", "inf"),
        ] {
            let error = limit(text).unwrap_err();
            assert!(error.contains(says), "{text}: {error}");
        }
    }
}
