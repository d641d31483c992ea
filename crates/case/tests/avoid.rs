//! `[avoid]`: what is read of it, and written back.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use case::{Case, CaseFile, GivenDemand, PathForm, Spread, to_toml};
use inputs::SpeedForm;

fn read(text: &str) -> Case {
    CaseFile::parse("avoid.toml", text).unwrap_or_else(|errors| panic!("{errors}")).case
}

fn refused(text: &str) -> String {
    CaseFile::parse("avoid.toml", text).unwrap_err().to_string()
}

const FORMS: &str = r#"
    [avoid]
    vehicle = "vehicle2"
    speed = { value = "62 km/h", sd = "2 km/h" }
    limit = { value = "50 km/h", source = "a \"sign\"" }
    reaction_time = { low = "0.5 s", mode = "0.8 s", high = "1.2 s", source = "Dettinger 2008" }
    swell = "0.2 s"
    swell_form = "full speed"
    deceleration = { value = "0.7 g", within = "10 %", confidence = 0.95, source = "drag sled" }
    other_party = "cyclist"
    unbraked = true
    clear = { distance = "2.4 m", speed = { low = "3 m/s", high = "5 m/s" } }

    [avoid.demand]
    reason = "round the corner"
    other = { distance = { value = "4 m", source = "survey" }, speed = "4 m/s" }
"#;

#[test]
fn each_form_is_read_and_written_back() {
    let case = read(FORMS);
    let avoid = case.avoid.as_ref().unwrap();
    let deceleration = avoid.deceleration.as_ref().unwrap();
    // 0.7 of the standard gravity
    assert!((deceleration.quantity.si() - 0.7 * 9.80665).abs() < 1e-12);
    assert_eq!(deceleration.source.as_ref().unwrap().as_given(), "drag sled");
    assert_eq!(avoid.limit.as_ref().unwrap().source.as_ref().unwrap().as_given(), "a \"sign\"");
    assert!(avoid.swell.as_ref().unwrap().source.is_none());
    assert!(matches!(&avoid.demand, Some(GivenDemand::Other(other)) if other.distance.source.is_some()));
    let paths: Vec<&str> = case.ranges.iter().map(|range| range.path.as_str()).collect();
    let expected = ["avoid.speed", "avoid.reaction_time", "avoid.deceleration", "avoid.clear.speed"];
    assert_eq!(paths, expected);
    assert!(matches!(case.ranges[1].spread, Spread::Triangular { .. }));
    let written = to_toml(&case);
    assert_eq!(read(&written), case, "{written}");
    // Nothing is written of vehicles that are not there.
    assert!(!written.contains("[vehicle"), "{written}");
}

#[test]
fn obstacles_and_the_sight_are_read_and_written_back() {
    let text = include_str!("../../../fixtures/avoid/sight.toml");
    let case = read(text);
    let avoid = case.avoid.as_ref().unwrap();
    assert_eq!(avoid.demand, Some(GivenDemand::Sight));
    let [van] = &avoid.obstacles[..] else { panic!("{:?}", avoid.obstacles) };
    let corners: Vec<[f64; 2]> = van.polygon.iter().map(|place| [place.x.si(), place.y.si()]).collect();
    assert_eq!(corners, [[-8.0, -1.8], [-3.0, -1.8], [-3.0, -3.8], [-8.0, -3.8]]);
    assert_eq!(avoid.sight.eye.as_ref().unwrap().x.si(), -2.0);
    let paths: Vec<&str> = case.ranges.iter().map(|range| range.path.as_str()).collect();
    assert_eq!(paths, ["avoid.reaction_time", "avoid.sight.other_speed"]);
    let form = case.avoidance().unwrap().sight.unwrap();
    let PathForm::Straight(heading) = form.path else { panic!("{:?}", form.path) };
    assert_eq!((heading.si(), form.other.speed.unwrap().si()), (0.0, 1.6));
    for (line, says) in [
        ("[[avoid.obstacle]]\nname = \"van\"", "polygon"),
        (
            "[[avoid.obstacle]]\npolygon = [{ x = \"0 m\", y = \"0 m\" }, { x = \"1 m\", y = \"0 m\" }]",
            "\"avoid.obstacle[1].polygon\" has 2 corners, but an obstacle needs three or more",
        ),
        ("demand = { sight = false }", "sight = true"),
        ("demand = { sight = true, time = \"1 s\" }", "demand"),
        ("[avoid.sight]\neye = { x = \"1 m\" }", "y"),
        ("[avoid.sight]\neyes = { x = \"1 m\", y = \"0 m\" }", "did you mean \"eye\""),
    ] {
        let message = refused(&format!("[avoid]\n{line}\n"));
        assert!(message.contains(says) && message.contains("avoid.toml:"), "{line}: {message}");
    }
}

#[test]
fn phases_and_paths_are_read() {
    let case = read(include_str!("../../../fixtures/avoid/from-stop.toml"));
    let [first, second] = case.vehicles[0].phases() else { panic!("{:?}", case.vehicles[0].before) };
    assert!(first.form.leads_on() && second.form.given() == 2);
    assert_eq!(first.source.as_ref().map(ToString::to_string).as_deref(), Some("SAE 2010-01-0062"));
    let form = case.avoidance().unwrap();
    assert_eq!(form.speed, SpeedForm::ByPhases);
    let sight = form.sight.unwrap();
    assert!(matches!(&sight.path, PathForm::Along(points) if points.len() == 2), "{:?}", sight.path);
    // None of it is part of the collision.
    let alone = case.without_avoid();
    assert!(alone.vehicles[0].phases().is_empty() && alone.ranges.is_empty(), "{:?}", alone.ranges);

    let phases =
        |before: &str| format!("[vehicle1]\nspeed = \"40 km/h\"\n[vehicle1.before]\n{before}\n[avoid]\n");
    for (before, says) in [
        ("phase = [{ speeds = \"40 km/h\" }]", "did you mean \"speed\""),
        ("phase = [{ }]", "\"vehicle1.before.phase[1]\" gives none of its keys"),
        ("phase = [{ distance = \"-4 m\" }]", "vehicle1.before.phase[1].distance"),
        (
            "skid = { length = \"4 m\" }\nphase = [{ time = \"1 s\" }]",
            "[vehicle1.before] gives both \"skid\" and \"phase\"",
        ),
        ("speed = \"4 m/s\"\nphase = [{ time = \"1 s\" }]", "a phase has a `speed` of its own"),
        ("", "skid"),
    ] {
        let message = refused(&phases(before));
        assert!(message.contains(says) && message.contains("avoid.toml:"), "{before}: {message}");
    }
    let line = "heading = \"0 deg\"\npath = [{ x = \"0 m\", y = \"0 m\" }]";
    assert!(
        refused(&format!("[avoid]\n[avoid.sight]\n{line}\n")).contains("gives both \"heading\" and \"path\"")
    );
}

/// Beside a position in the coordinates of a survey, nobody is at its origin because nothing is said.
#[test]
fn a_place_in_a_survey_needs_that_of_the_other() {
    let text = |more: &str| {
        format!(
            "[vehicle1]\nheading = \"0 deg\"\nposition = {{ x = \"100 m\", y = \"50 m\" }}\nspeed = \"40 km/h\"\n\
             [vehicle2]\nheading = \"90 deg\"\nspeed = \"5 km/h\"\n{more}\n[avoid]\nlimit = \"30 km/h\"\n\
             reaction_time = \"1.0 s\"\ndeceleration = \"7.5 m/s^2\"\ndemand = {{ sight = true }}\n\
             obstacle = [{{ polygon = [{{ x = \"10 m\", y = \"20 m\" }}, {{ x = \"20 m\", y = \"20 m\" }}, {{ x = \"20 m\", y = \"30 m\" }}] }}]\n"
        )
    };
    let alone = text("");
    for (text, lacks) in [
        (alone.clone(), "avoid.sight.point"),
        (format!("{alone}vehicle = \"vehicle2\"\n"), "avoid.sight.eye"),
    ] {
        let faults = read(&text).avoidance().unwrap_err();
        let keys: Vec<&str> = faults.list().iter().map(|fault| fault.key.as_str()).collect();
        assert_eq!(keys, [lacks], "{faults}");
    }
    for known in [
        text("position = { x = \"101 m\", y = \"50 m\" }"),
        text("[scene]\ncontact = { x = \"102 m\", y = \"50 m\" }"),
        format!("{alone}sight = {{ point = {{ x = \"101 m\", y = \"50 m\" }} }}\n"),
    ] {
        assert!(read(&known).avoidance().is_ok(), "{known}");
    }
}

/// An error that only numbers of this table share is no part of the collision.
#[test]
fn an_error_of_the_question_alone_is_not_of_the_collision() {
    let text = |of: &str| {
        format!(
            "[vehicle1]\nmass = \"1500 kg\"\nspeed = \"40 km/h\"\n[avoid]\nreaction_time = \"1 s\"\n\
             [uncertainty]\nshared = [{{ name = \"my watch\", of = [{of}], within = \"5 %\", confidence = 0.95 }}]\n"
        )
    };
    let shared = |of: &str| read(&text(of)).without_avoid().uncertainty.shared.clone();
    assert!(shared("\"avoid.reaction_time\"").is_empty());
    let left = shared("\"avoid.reaction_time\", \"vehicle1.speed\"");
    assert!(matches!(left.as_slice(), [error] if error.of == ["vehicle1.speed"]), "{left:?}");
}

/// The advice is of a library: it names no program.
#[test]
fn advice_names_no_command() {
    for text in ["[vehicle1]\nspeed = \"40 km/h\"", "[avoid]\nlimit = \"50 km/h\""] {
        let faults = read(text).avoidance().unwrap_err();
        let advice: Vec<_> = faults.list().iter().filter_map(|fault| fault.advice.as_deref()).collect();
        assert!(!advice.is_empty() && advice.iter().all(|one| !one.contains("deltav ")), "{advice:?}");
        assert!(advice.iter().any(|one| one.contains("the template \"avoid\"")), "{advice:?}");
    }
}

#[test]
fn fixtures_are_written_back() {
    for text in [
        include_str!("../../../fixtures/avoid/pedestrian.toml"),
        include_str!("../../../fixtures/avoid/skid.toml"),
        include_str!("../../../fixtures/avoid/evidence.toml"),
        include_str!("../../../fixtures/avoid/sight.toml"),
        include_str!("../../../fixtures/avoid/from-stop.toml"),
        include_str!("../../../fixtures/avoid/recorder.toml"),
    ] {
        let case = read(text);
        assert_eq!(read(&to_toml(&case)), case);
        assert!(case.avoidance().is_ok());
        assert!(case.without_avoid().avoid.is_none());
    }
}

#[test]
fn what_cannot_be_read_is_told_with_its_place() {
    for (line, says) in [
        ("speed = 62", "avoid.toml:2:9"),
        ("limit = { value = \"50 km/h\" }", "source"),
        ("limit = { source = \"a sign\" }", "source"),
        ("reaction_time = { value = \"1 s\", sorce = \"x\" }", "did you mean \"source\""),
        ("deceleration = \"7 m/s\"", "m/s^2"),
        ("demand = { distance = \"30 m\", time = \"2 s\" }", "demand"),
        ("demand = { other = { distance = \"4 m\" } }", "speed"),
        ("demand = { other = { speed = \"4 m/s\" } }", "distance"),
        ("demand = { other = { distance = \"4 m\", acceleration = \"-1 m/s^2\" } }", "acceleration"),
        ("demand = { sight = false }", "\"avoid.demand.sight\" is false"),
        ("clear = { outlines = false }", "\"avoid.clear.outlines\" is false"),
        ("swell_form = \"lineer\"", "did you mean \"linear\""),
        ("vehicle = \"vehicle3\"", "vehicle1"),
        ("reaction = \"1 s\"", "reaction_time"),
    ] {
        let message = refused(&format!("[avoid]\n{line}\n"));
        assert!(message.contains(says) && message.contains("avoid.toml:2:"), "{line}: {message}");
    }
    // Without the table, a vehicle is needed as before.
    assert!(refused("title = \"nothing\"").contains("vehicle1"));
    // A source belongs to the numbers of this table alone.
    assert!(
        refused("[vehicle1]\nspeed = { value = \"10 m/s\", sd = \"1 m/s\", source = \"x\" }")
            .contains("source")
    );
}

/// The question is about vehicle 1 unless the file says otherwise; a file that describes only the other has
/// to say so.
#[test]
fn a_question_about_a_vehicle_that_is_not_there() {
    let text = |vehicle: &str, speed: &str| {
        format!(
            "[vehicle2]\nspeed = \"60 km/h\"\n[avoid]\n{vehicle}\nlimit = \"50 km/h\"\nreaction_time = \"1 s\"\n\
             deceleration = \"7 m/s^2\"\ndemand = {{ distance = \"30 m\" }}\n{speed}\n"
        )
    };
    let asked = |vehicle: &str, speed: &str| {
        CaseFile::parse("case.toml", &text(vehicle, speed))
            .unwrap()
            .case
            .avoidance()
            .map_err(|faults| format!("{faults:?}"))
    };
    for speed in ["", "speed = \"62 km/h\""] {
        let errors = asked("", speed).unwrap_err();
        assert!(errors.contains("asks about [vehicle1], but the case has only [vehicle2]"), "{errors}");
        assert!(errors.contains("write vehicle = \\\"vehicle2\\\" in [avoid]"), "{errors}");
    }
    assert!(asked("vehicle = \"vehicle2\"", "").is_ok());
    assert!(asked("vehicle = \"vehicle1\"", "speed = \"62 km/h\"").is_ok());
}
