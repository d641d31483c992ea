//! Patterns of the README and the guide, put together from the sources of their numbers.

use std::f64::consts::PI;

use case::CaseFile;
use crash3::{ObliqueCorrection, Side};

use super::glossary::{high_no_damage_speed, large_ratio, no_damage_speeds, pdof_difference};
use super::ledger::{
    FOOT, FOOT_POUND, Fact, Ledger, MILE_PER_HOUR, at, bounds, clock, degrees, deltav, high_restitution,
    json, limit, number, threshold, width_tolerance, within,
};
use crate::guide::prose::page;

/// All of them.
pub(super) fn facts() -> Vec<Fact> {
    let mut ledger = Ledger::default();
    readme(&mut ledger);
    avoid(&mut ledger);
    contents(&mut ledger);
    conventions(&mut ledger);
    crush(&mut ledger);
    estimate(&mut ledger);
    how_do_i(&mut ledger);
    impact(&mut ledger);
    motion(&mut ledger);
    reconciliation(&mut ledger);
    sensitivity(&mut ledger);
    tutorial(&mut ledger);
    uncertainty(&mut ledger);
    super::glossary::facts(&mut ledger);
    ledger.facts
}

/// The page that lists those of the guide.
fn avoid(ledger: &mut Ledger) {
    ledger.page("docs/guide/avoid.md");
    ledger.made(format!("hid … {} s before the impact", number(analysis::SIGHT_LOOK_BACK, 0)));
    let line = degrees(reconcile::COLLINEAR);
    ledger.made(format!("headings of both lie within {line}°"));
    ledger.made(format!("more than {line}° and up to {}° off", degrees(analysis::NEARLY_ALONG)));
}

fn contents(ledger: &mut Ledger) {
    ledger.page("docs/guide/README.md");
    let [no_answer, wrong] = statuses();
    ledger.made(format!(
        "{}: {no_answer} … without … {wrong}",
        deltav("reconstruct fixtures/sae-980025.toml").1
    ));
    assert_eq!(deltav("reconstruct --frictions").1, wrong);
}

fn readme(ledger: &mut Ledger) {
    ledger.page("README.md");
    ledger.cited(
        "compiles, which takes 5 to 9 minutes … 3 to … 5 minutes",
        "user and system time, and elapsed time, of the first command in a fresh clone by Rust 1.95 on x86-64",
    );
    ledger.cited(
        "compiles … 20 to 27 minutes … 11 to 14 minutes … 4.4 GB … 8 to 11 minutes",
        "user and system time of `cargo test --workspace --no-run` by Rust 1.95 on x86-64, `du -sh target` afterwards, and the \
         elapsed time of the tests",
    );
    let calibration = page("docs/calibration.md");
    let held_out = "| all | 348 | 50.6 ± 2.8 % | 78.7 ± 2.3 % | 94.8 ± 1.3 % | −0.009 | 0.325";
    ledger.quoted("94.8 % of 348 vehicles", &calibration, held_out);
    let blind = "| CISS 2018, all | 470 | 46.4 % | 74.7 % | 93.2 % |";
    ledger.quoted("93.2 % of 470 in a year that the fit had not seen", &calibration, blind);
    ledger.quoted("the 95 % intervals", &calibration, "| 50 % | 80 % | 95 % | bias");
    let oldest = page("Cargo.toml")
        .text
        .split_once("\nrust-version = \"")
        .unwrap()
        .1
        .split('"')
        .next()
        .unwrap()
        .to_owned();
    ledger.made(format!("toolchain … ({oldest}"));

    let case = json("reconstruct fixtures/sae-980025.toml");
    let of = |path: &str| at(&case, path);
    // The printed numbers of the paper are in the data of `deltav validate`, in SI units.
    let staged = json("validate");
    let printed = |quantity: &str| {
        let rows = staged["appendix"].as_array().unwrap();
        let row =
            rows.iter().find(|row| row["quantity"] == quantity).unwrap_or_else(|| panic!("no {quantity}"));
        at(row, "/paper")
    };
    let power = |value: f64| format!("{value:.2e}");
    ledger.made(format!(
        "| {}, {} N·m | {} J, {} J |",
        power(printed("crush energy of vehicle 1")),
        power(printed("crush energy of vehicle 2")),
        number(of("/vehicle1/crush_energy"), 0),
        number(of("/vehicle2/crush_energy"), 0)
    ));
    // The appendix prints 75 ft/s and 22.9 m/s.
    ledger.made(format!(
        "| {} ft/s | {} ft/s |",
        number(printed("speed of vehicle 1 before impact") / FOOT, 0),
        number(of("/found/value") / FOOT, 2)
    ));
    ledger.made(format!(
        "| {} | {} |",
        number(printed("critical impulse ratio"), 3),
        number(of("/impact/critical_impulse_ratio"), 4)
    ));
    ledger.cited("| 1.87–", "SAE 980025 prints the energy loss with both figures");
    ledger.made(format!(
        "–{} N·m, {} % | {} J, {} % |",
        power(printed("energy loss")),
        number(100.0 * printed("energy loss / initial energy"), 1),
        number(of("/impact/energy_loss"), 0),
        number(100.0 * of("/impact/energy_loss") / of("/impact/initial_energy"), 1)
    ));
    ledger.made(format!(
        "| {:.0} N·s, {:.0} N·s (printed 1064) | {} N·s, {} N·s |",
        printed("normal impulse"),
        printed("tangential impulse"),
        number(of("/impact/normal_impulse"), 0),
        number(of("/impact/tangential_impulse"), 0)
    ));
    // The misprints are those of theory, section 8.
    let theory = page("docs/theory.md");
    ledger.quoted("(printed 1064)", &theory, "P_t = 1064 N");
    ledger.quoted("(printed −15.5)", &theory, "V_y = −15.5 ft/s");
    for vehicle in [1, 2] {
        let after =
            |axis: &str| printed(&format!("velocity of vehicle {vehicle} after impact, {axis}")) / FOOT;
        let ours = |key: &str| of(&format!("/vehicle{vehicle}/{key}"));
        let misprint = if vehicle == 2 { " (printed −15.5)" } else { "" };
        ledger.made(format!(
            "| ({}, {}) ft/s{misprint}, {} rad/s | ({}, {}) ft/s, {} rad/s |",
            number(after("x"), 1),
            number(after("y"), 1),
            number(printed(&format!("yaw rate of vehicle {vehicle} after impact")), 1),
            number(ours("final_velocity/0") / FOOT, 2),
            number(ours("final_velocity/1") / FOOT, 2),
            number(ours("final_yaw_rate"), 2)
        ));
    }
    let both = |unit: f64, decimals: usize, values: [f64; 2]| {
        format!("{}, {}", number(values[0] / unit, decimals), number(values[1] / unit, decimals))
    };
    ledger.made(format!(
        "ΔV of vehicle 1 and 2 | {} mph | {} mph |",
        both(MILE_PER_HOUR, 1, [printed("ΔV of vehicle 1"), printed("ΔV of vehicle 2")]),
        both(MILE_PER_HOUR, 2, [of("/vehicle1/delta_v"), of("/vehicle2/delta_v")])
    ));
    ledger.made(format!(
        "| {} ft/s, moment arms not stated | {} ft/s with the arms of the impulse |",
        both(
            FOOT,
            1,
            [printed("CRASH3 uncorrected ΔV of vehicle 1"), printed("CRASH3 uncorrected ΔV of vehicle 2")]
        ),
        both(FOOT, 2, [of("/crash3/delta_v/0"), of("/crash3/delta_v/1")])
    ));
    let validation = validation::validate(&validation::Data::built_in()).unwrap();
    for headline in [report::validation_headline, report::both_speeds_headline] {
        let words = headline(&validation, report::Units::Si);
        let words = words.split_whitespace().collect::<Vec<_>>().join(" ");
        let part = |begin: &str, end: &str| {
            words[words.find(begin).unwrap()..].split(end).next().unwrap().to_owned()
        };
        ledger.made(part("On average ", ";"));
        ledger.made(part("rms error of ", "."));
    }
    let first = report::validation_headline(&validation, report::Units::Si);
    ledger.made(first.split(',').next().unwrap());
}

fn conventions(ledger: &mut Ledger) {
    ledger.page("docs/guide/conventions.md");
    // The headings in the drawing: "10  Arms of the impulse (z-up)".
    let drawing = page("docs/guide/conventions.svg").text;
    let headings: Vec<&str> =
        drawing.split("class=\"h\">").skip(1).map(|rest| rest.split('<').next().unwrap()).collect();
    let panels = |wanted: &dyn Fn(&str) -> bool| {
        let numbers = headings
            .iter()
            .filter(|heading| wanted(heading))
            .map(|heading| heading.split(' ').next().unwrap());
        let numbers: Vec<&str> = numbers.collect();
        let (last, rest) = numbers.split_last().unwrap();
        if rest.is_empty() { (*last).to_owned() } else { format!("{} and {last}", rest.join(", ")) }
    };
    ledger.made(format!("panels … {}", panels(&|heading| heading.ends_with("(z-up)"))));
    ledger.made(format!("{} in … those … J670", panels(&|heading| heading.ends_with("(z-down)"))));
    ledger.made(format!(
        "{} … {} … lists",
        panels(&|heading| !heading.contains("z-") && !heading.contains("Signs") && !heading.is_empty()),
        panels(&|heading| heading.contains("Signs"))
    ));
    ledger.made(format!("(panels {})", panels(&|heading| heading.contains("Arms"))));
    ledger.made(format!("h (panel {})", panels(&|heading| heading.contains("Moment arm"))));
    let right_angle = degrees(PI / 2.0);
    let straight_angle = degrees(PI);
    ledger.made(format!(
        "| n turned by {right_angle}° counter-clockwise | n turned by {right_angle}° clockwise |"
    ));
    ledger.made(format!("headings … {straight_angle}°"));
    ledger.made(format!("plane … {right_angle}°"));
    ledger.made(format!("+ {straight_angle}° … plane"));
    let theory = page("docs/theory.md");
    ledger.quoted("approach … u_n < 0 … 1 … P_n > 0", &theory, "1: n·(r_2 − r_1) > 0 … u_n < 0 … P_n > 0");
    let square = |side: Side| number(side.square_pdof().to_degrees(), 0);
    ledger.made(format!(
        "heading … {}° in … {}° … {}° … {}°",
        square(Side::Front),
        square(Side::Right),
        square(Side::Left),
        square(Side::Rear)
    ));
    let minus = |side: Side| {
        let angle = side.square_pdof().to_degrees();
        format!("{} {}°", if angle < 0.0 { "+" } else { "−" }, number(angle.abs(), 0))
    };
    ledger.made(format!(
        "{} … front … {} … {} … {}",
        minus(Side::Front),
        minus(Side::Right),
        minus(Side::Rear),
        minus(Side::Left)
    ));
    ledger.made(format!("{}° … hour … {}°", number(clock(2), 0), number(clock(2) - clock(1), 0)));
    ledger.cited("through … h = 0", "a distance from itself");
}

fn crush(ledger: &mut Ledger) {
    ledger.page("docs/guide/crush.md");
    ledger.quoted("cars of 1991 to 2018", &page("docs/calibration.md"), "crashes are of 1991 to 2018");
    let [least, most] = bounds("category");
    ledger.made(format!("| CRASH3's category, {least} to {most} |"));
    ledger.cited("the … 1970s", "the age of the crash tests behind CRASH3's table");
    // B = d_1²
    ledger.made(format!("factor … {} in", number((0.3048_f64 / 0.0254).powi(2), 0)));
    // The share of the energy that rebounds is e².
    ledger.quoted("A²/2B … unless", &page("docs/theory.md"), "G = A²/2B");
    ledger.quoted("Fonda's 1/cos α", &page("docs/theory.md"), "1/cos α comes");
    ledger.quoted("SAE 1999-01-0106", &page("docs/theory.md"), "SAE 1999-01-0106");
    let rebound = |e: f64| number(100.0 * e * e, 0);
    ledger.made(format!("e = 0.1 … differ … {} % in … = 0.3 … {} %", rebound(0.1), rebound(0.3)));
    let capped = |angle: f64| ObliqueCorrection::Capped.factor(angle).unwrap().capped;
    ledger.made(format!("CRASH3 … multiplies … 1 + tan²α … 8) … {}°", degrees(threshold(1.5, 0.1, capped))));
    ledger.quoted("multiplies … 1 + tan²α", &page("docs/theory.md"), "E' = E (1 + tan²α)");
    ledger.made(format!("{} … warns", number(limit("force-balance"), 0)));
    ledger.quoted("b_0 = √(2 … speed", &page("docs/theory.md"), "b_0 = √(2 G w/m)");
    let [least, most, _] = no_damage_speeds();
    ledger.made(format!(
        "{} … {} mph … usual … {} mph",
        number(least, 0),
        number(most, 0),
        number(high_no_damage_speed(), 0)
    ));
    ledger.quoted(
        "velocity … e = 0",
        &page("docs/theory.md"),
        "A common normal velocity (e = 0) is built into Eq 6 and 7",
    );
}

fn estimate(ledger: &mut Ledger) {
    ledger.page("docs/guide/estimate.md");
    let guide = page("docs/guide/case-file.md");
    // ln of the share of the impact's energy that the crush shows.
    let share = |hit: &[evidence::DamagedSide]| {
        number(100.0 * evidence::FITTED.by_category(hit).crush_misfit(hit).bias.exp(), 0)
    };
    let fronts = share(&[evidence::DamagedSide::Front; 2]);
    let sides = share(&[evidence::DamagedSide::Side]);
    let rears = share(&[evidence::DamagedSide::Rear]);
    ledger.cited("cars of the 1970s", "the age of the crash tests behind CRASH3's table");
    ledger.cited("crashes of 2017", "the data of docs/calibration.md");
    ledger.quoted(&format!("average {fronts} % … between two fronts"), &guide, "43 % between two fronts");
    ledger.quoted(&format!("{sides} % where a side was hit"), &guide, "45 % where a side was hit");
    ledger.quoted(&format!("{rears} % where a rear was hit"), &guide, "87 % where a rear was hit");
    let fleet = number(100.0 * evidence::FITTED.crush_misfit(&[]).shown(), 0);
    ledger.made(format!("the stiffness of the fleet (`) were {fleet} %"));
    let of_object = number(100.0 * evidence::FITTED.objects.misfit.shown(), 0);
    ledger.made(format!("of the fleet, {of_object} %"));
    ledger.quoted("crushed 45 cm", &page("docs/calibration.md"), "deepest crush was 45 cm or more");
    ledger.quoted("older car … 1977", &page("docs/theory.md"), "(year − 1977)/(2010 − 1977)");
    let misfit = evidence::FITTED.objects.misfit;
    let deformation_energy =
        evidence::FITTED.energy_error(evidence::EnergyMethod::OfObject, misfit, None, false);
    let percent = |ln_sd: f64| number(100.0 * ln_sd, 0);
    ledger.made(format!("error is an assumption: {} %", percent(deformation_energy.shared_ln_sd)));
    ledger.made(format!("without a range, another {} %", percent(deformation_energy.own_ln_sd)));
    ledger.quoted("errs by 10 % of its distance", &guide, "computed distance: 10 % if left out");
    ledger.quoted("distance) and 0.5 m", &guide, "0.5 m if left out");
    ledger.quoted("between 5° and 15°", &guide, "but 5° to 15°, if left out");
    ledger.quoted("of 20 % before", &guide, "20 % if left out; from 0 %");
    ledger.cited("hurt (MAIS 3 or more)", "the abbreviated injury scale");
    ledger.cited("(DOT HS 813 219)", "the number of NHTSA's report");
    ledger.cited("part of 1 km/h at zero", "LEAST_SPEED_ERROR of deltav-analysis");
    ledger.made(format!("wider than {} % of", number(100.0 * analysis::TOLD_BELOW, 0)));
}

fn how_do_i(ledger: &mut Ledger) {
    ledger.page("docs/guide/how-do-i.md");
    ledger.quoted("car of 1991", &page("docs/calibration.md"), "crashes are of 1991 to 2018");
    // The six depths of the Jimmy, and their average by trapezoids instead.
    let text = page("fixtures/sae-980025.toml").text;
    let depths = [21.3, 20.3, 13.8, 11.3, 5.3, 4.8];
    let line = format!("\"{} in\"", depths.map(|depth| depth.to_string()).join(" "));
    assert!(text.contains(&line));
    let average = (depths.iter().sum::<f64>() - f64::midpoint(depths[0], depths[5])) / 5.0;
    let energy = |text: &str| {
        let file = CaseFile::parse("depths.toml", text).unwrap();
        let analysis = analysis::reconstruct(&file.case).unwrap_or_else(|failure| panic!("{failure}"));
        analysis.vehicles[0].damage.as_ref().unwrap().crush_energy / FOOT_POUND
    };
    let [all, uniform] =
        [energy(&text), energy(&text.replace(&line, &format!("\"{average} {average} in\"")))];
    ledger.made(format!(
        "crush … {} in … {} ft·lb, {} %",
        number(average, 2),
        number(uniform, 0),
        number(100.0 * (all - uniform) / all, 0)
    ));
    let glossary = page("crates/report/glossary.md");
    ledger.cited(
        "0.1 … medium … 0.2 … 0.4 in … 2 … 5 mph … 931842)",
        "the abstract of that paper: values measured in low-speed collisions, and what is usual above",
    );
    ledger.cited("(SAE 1999-01-0097)", "the abstract of Monson and Germane's paper says that it falls");
    let [speed, restitution] = high_restitution();
    ledger.made(format!("program … {restitution} … {speed} m/s"));
    ledger.quoted(
        "(0.55 … usual … 0.3 … 1.0 … 970947",
        &glossary,
        "Between vehicles 0.55 is usual, and 0.3 to 1.0 the range (SMAC: McHenry & McHenry, SAE 970947)",
    );
    ledger.made(format!("agree … {} %", number(100.0 * width_tolerance(), 1)));
    let [least, most] = bounds("class");
    ledger.made(format!("{least} … {most} … selects … CRASH3's"));
    ledger.made(format!("±{} % … radius", number(100.0 * crash3::BURG_SPREAD, 0)));
    ledger.made(format!("1970s, to ±{} %", number(100.0 * crash3::CLASS_SPREAD, 0)));
    ledger.cited("cars … 1970s", "the cars whose dimensions the classes have");
}

fn impact(ledger: &mut Ledger) {
    ledger.page("docs/guide/impact.md");
    let glossary = page("crates/report/glossary.md");
    ledger.quoted("e = 1 … nothing", &glossary, "With e = 1 no energy is dissipated");
    let [least, most] = bounds("moment_restitution");
    ledger.made(format!("{least} … default … {most}"));
    ledger.quoted("; 0 … leaves", &glossary, "through 0 (common yaw rate) to 1");
}

/// The exit statuses of a case without an answer, and of a file that is wrong.
fn statuses() -> [i32; 2] {
    ["reconstruct fixtures/no-answer/no-crush.toml", "reconstruct fixtures/invalid/bare-number.toml"]
        .map(|run| deltav(run).1)
}

fn motion(ledger: &mut Ledger) {
    ledger.page("docs/guide/motion.md");
    let theory = page("docs/theory.md");
    let collinear = "Approaches within 10° of each other";
    ledger.quoted("cross … more than 10°", &theory, collinear);
    ledger.quoted("one line … within 10°", &theory, collinear);
    ledger.quoted("impulse ratio … 0 to μ_c", &theory, "is to lie between 0 and μ_c");
    let edcrash = "the tables of the EDCRASH manual, chapter 2";
    for pattern in [
        "EDCRASH manual, chapter 2, Tables 2-6 and 2-7",
        "rolls freely | 0.01",
        "share of the friction, such as 0.013/μ",
        "partly flat | 0.013",
        "high gear | 0.15 to 0.20",
        "low gear | 0.2 to 0.4",
        "below 30 mph | above 30 mph",
        "new asphalt, dry | 0.80 to 1.20 | 0.65 to 1.00",
        "travelled asphalt, dry | 0.60 to 0.80 | 0.55 to 0.70",
        "polished asphalt, dry | 0.55 to 0.75 | 0.45 to 0.65",
        "new concrete, dry | 0.80 to 1.20 | 0.70 to 1.00",
        "travelled concrete, dry | 0.60 to 0.80 | 0.60 to 0.75",
        "travelled asphalt, wet | 0.50 to 0.80 | 0.45 to 0.75",
        "smooth ice | 0.10 to 0.25 | 0.07 to 0.20",
        "gravel … 0.40 to 0.70",
        "snow … 0.30 to 0.55",
    ] {
        ledger.cited(pattern, edcrash);
    }
}

fn reconciliation(ledger: &mut Ledger) {
    ledger.page("docs/guide/reconciliation.md");
    ledger.made(format!("no more than {} km/h", number(3.6 * analysis::FASTEST_BELIEVED, 0)));
    ledger.made(format!("above {} km/h, the", number(3.6 * analysis::NEARLY_STOOD, 1)));
    let theory = page("docs/theory.md");
    ledger.quoted("(1 − e²)(E_1 + E_2) … absorbed", &theory, "(absorbed basis: (1−e²)(E_1 + E_2))");
    ledger.made(format!("heading … {}°", degrees(PI)));
    let [least, most] = bounds("tangential_share");
    ledger.made(format!("how much, from {least} to {most}: the"));
    ledger.cited("method, 0, stays", "the definition of λ");
    ledger.made(format!("{}° … impulse", pdof_difference()));
    ledger.cited("velocity … s = 0", "the definition of u_n0");
    // Energy grows with the square of the closing speed.
    let speed = 100.0 * (1.1_f64.sqrt() - 1.0);
    ledger.made(format!("error … 10 % in … {speed:.0} % in"));
    ledger.quoted("1000 m/s … answer", &theory, "a speed of at most 1000 m/s");
    ledger.quoted("finds all … 1000 m/s", &theory, "a speed of at most 1000 m/s");
}

fn sensitivity(ledger: &mut Ledger) {
    ledger.page("docs/guide/sensitivity.md");
    ledger.cited("1 % … input", "the definition");
    ledger.cited("1° … angle", "the definition");
    ledger.cited("10 cm … coordinate", "the definition");
    ledger.cited("1 cm … contact point", "the definition");
    // By trial, not by the derivative.
    let text = page("fixtures/sae-980025.toml").text;
    let speed = |plane: &str| {
        let text = text.replace("\"-23 deg\"", &format!("\"{plane} deg\""));
        analysis::reconstruct(&CaseFile::parse("plane.toml", &text).unwrap().case)
            .unwrap()
            .found
            .unwrap()
            .speed
            / MILE_PER_HOUR
    };
    ledger.made(format!("2° … counter-clockwise … {} mph", number(speed("-23") - speed("-21"), 1)));
    let result = json("sensitivity fixtures/sae-980025.toml --pdof-step 10 --pdof-steps 1");
    let mut of_vehicle_1: Vec<f64> = result["pdof_sweep"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| at(row, "/uncorrected_delta_v/0") / MILE_PER_HOUR)
        .collect();
    of_vehicle_1.sort_by(f64::total_cmp);
    ledger.made(format!(
        "10° … either … CRASH3's … 1 … {} … {} mph",
        number(of_vehicle_1[0], 2),
        number(of_vehicle_1[2], 2)
    ));
}

fn tutorial(ledger: &mut Ledger) {
    ledger.page("docs/guide/tutorial.md");
    let text = page("fixtures/sae-980025.toml").text;
    let case = CaseFile::parse("sae-980025.toml", &text).unwrap().case;
    let heading = |vehicle: usize| degrees(case.vehicles[vehicle].heading.unwrap().si());
    ledger.made(format!("heading … {}°", heading(0)));
    ledger.made(format!("drove … {}°", heading(1)));
    let Some(case::ContactPoint::Polar { distance, angle }) = case.vehicles[0].contact else {
        panic!("{:?}", case.vehicles[0].contact)
    };
    assert!(angle.si() < 0.0);
    ledger.made(format!(
        "contact … {} ft … {}°",
        number(distance.si() / FOOT, 1),
        number(angle.si().abs().to_degrees(), 1)
    ));
    let impact = case.impact.as_ref().unwrap();
    let plane = degrees(impact.crush_plane.si());
    let right_angle = degrees(PI / 2.0);
    ledger.made(format!("Altima's … {}°", heading(1)));
    ledger.made(format!("{}° − {right_angle}° = {plane}°", heading(1)));
    assert_eq!(plane, degrees(case.vehicles[1].heading.unwrap().si() - PI / 2.0));
    ledger.made(format!("above {} … justified", large_ratio()));
    ledger.cited("1 % … input … 1°", "the definition");
    ledger.quoted("points … 2 … 1", &page("docs/theory.md"), "n points from vehicle 2 towards vehicle 1");
}

fn uncertainty(ledger: &mut Ledger) {
    ledger.page("docs/guide/uncertainty.md");
    let [no_answer, _] = statuses();
    ledger.made(format!("run exits with status {no_answer}"));
    ledger.made(format!("{} % … within … {} %", within(1.0), within(2.0)));
    // confidence = 0.95 against 0.05
    ledger.made(format!("within … 10 % … {} … 1", number(0.95 / 0.05, 0)));
    ledger.made(format!("more than {} % off", number(100.0 * ::uncertainty::FIRST_ORDER_LIMIT, 0)));
    ledger.made(format!("methods … {}", ::uncertainty::REPLICATES));
    let most = ::uncertainty::MAX_SAMPLES;
    ledger.made(format!("at most {} samples", number(most as f64, 0)));
    ledger.made(format!("{} MB for each result and million samples", size_of::<f64>()));
    // √(p(1 − p)/n)/φ(1.96), p = 0.025
    let density = (-0.5 * 1.96_f64.powi(2)).exp() / (2.0 * PI).sqrt();
    let error = (0.025 * 0.975 / most as f64).sqrt() / density;
    ledger.made(format!(
        "end of the {} % interval … {} %",
        number(100.0 * ::uncertainty::LEVELS[2], 0),
        number(100.0 * error, 2)
    ));
    let level = number(100.0 * ::uncertainty::LEVELS[2], 0);
    ledger.made(format!("| {level} % | {level} % of the samples lie between these two |"));
    ledger.made(format!("ranges … {level} %"));
    let [low, high] = ::uncertainty::TORNADO_PROBABILITIES.map(|probability| number(100.0 * probability, 1));
    ledger.made(format!("{low} % … {high} % … quantile"));
}
