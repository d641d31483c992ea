//! Phrases of crates/report/glossary.md, put together from where their numbers come from.

use std::f64::consts::PI;

use analysis::{Analysis, Warning};
use case::{Axes, Case};
use crash3::{EnergyBasis, ObliqueCorrection, Side, Stiffness, VehicleClass, yaw_inertia_burg};
use report::Units;

use super::ledger::{
    FOOT, Ledger, MILE_PER_HOUR, bounds, clock, degrees, high_restitution, json, limit, number,
    opposite_limit, threshold, within,
};
use crate::guide::prose::page;

/// All of them.
pub(super) fn facts(ledger: &mut Ledger) {
    ledger.page("crates/report/glossary.md");
    frames(ledger);
    vehicles(ledger);
    damage(ledger);
    impact(ledger);
    answer(ledger);
    ranges(ledger);
    warnings(ledger);
}

fn frames(ledger: &mut Ledger) {
    let [theory, guide] = ["docs/theory.md", "docs/guide/case-file.md"].map(page);
    let [right_angle, straight_angle] = [PI / 2.0, PI].map(degrees);
    ledger.made(format!("y turned from it by +{right_angle}°"));
    ledger.made(format!("t is n turned by +{right_angle}°"));
    ledger.made(format!("Two vehicles that meet head-on have headings {straight_angle}° apart"));
    ledger.made(format!("Γ and Γ + {straight_angle}° are the same plane"));
    ledger.made(format!("in (−{straight_angle}°, {straight_angle}°]"));
    let square = |side: Side| number(side.square_pdof().to_degrees(), 0);
    let [front, right, rear, left] = [Side::Front, Side::Right, Side::Rear, Side::Left].map(square);
    ledger.made(format!(
        "{front}° is struck squarely in front, {right}° from the right, {left}° from the left"
    ));
    ledger.made(format!(
        "({front}° front, {right}° right, {rear}° rear, {left}° left, as PDOF of a square hit)"
    ));
    let hour = clock(2) - clock(1);
    ledger.made(format!(
        "({hour:.0}° an hour, so no finer than ±{:.0}°; the first two digits of a CDC",
        hour / 2.0
    ));
    ledger.made(format!("clock hours, which are no finer than {:.0}°", hour / 2.0));
    ledger.quoted("PDOF_2 = θ_2 − θ_1 + PDOF_1 − 180°", &theory, "PDOF_2 = θ_2 − θ_1 + PDOF_1 − 180°");
    ledger.quoted("before the impact is 0 where the file has none", &guide, "0 where absent");
    ledger.made(format!("of the plane itself: {right_angle}° off is the usual slip"));
    ledger.made(format!("a sign or a heading is wrong ({straight_angle}° off is the usual slip)"));
    ledger.made(format!("θ_1 − PDOF_1 and θ_2 − PDOF_2 differ by {straight_angle}°"));
    ledger.made(format!("|α| < {right_angle}°"));
    ledger.made(format!("The direction of force makes {right_angle}° or more with the normal"));
}

/// (m) k of CRASH3's classes, and by how much of these that of Burg's estimate is below.
fn radii() -> [Vec<f64>; 2] {
    let classes: Vec<VehicleClass> = (1..=6).map(|class| VehicleClass::new(class).unwrap()).collect();
    let burg = |class: &VehicleClass| yaw_inertia_burg(1.0, class.wheelbase, class.length).unwrap().sqrt();
    let below = classes.iter().map(|class| 1.0 - burg(class) / class.yaw_radius).collect();
    [classes.iter().map(|class| class.yaw_radius).collect(), below]
}

fn vehicles(ledger: &mut Ledger) {
    let theory = page("docs/theory.md");
    ledger.quoted(
        "Both \"3696 lb\" mean the same car",
        &page("fixtures/sae-980025.toml"),
        "weight = \"3696 lb\"",
    );
    ledger.made(format!("a weight is divided by {} m/s²", case::STANDARD_GRAVITY));
    let burg = yaw_inertia_burg(1.0, 1.0, 1.0).unwrap();
    ledger.made(format!("Burg estimates I = {burg} × mass × wheelbase × length"));
    ledger.made(format!("by Burg's formula, I = {burg} × mass × wheelbase × length"));
    let spread = number(100.0 * crash3::BURG_SPREAD, 0);
    ledger.made(format!("Either is taken to be right to ±{spread} % of k"));
    ledger.made(format!("Its radius of gyration may be {spread} % off"));
    let [radii, below] = radii().map(|mut values| {
        values.sort_by(f64::total_cmp);
        [values[0], values[5]]
    });
    ledger.made(format!(
        "{} to {} m for the cars of CRASH3's size classes",
        number(radii[0], 1),
        number(radii[1], 1)
    ));
    ledger.made(format!(
        "give it to ±{spread} %; the two differ, Burg's being {} to {} % below that of the classes",
        number(100.0 * below[0], 0),
        number(100.0 * below[1], 0)
    ));
    let [least, most] = bounds("class");
    ledger.made(format!("`, {least} to {most}: CRASH3's size class of a car"));
    ledger.cited("(SAE 870045, Table 2, read from a poor scan)", "the place of the table");
    ledger.quoted("a barrier or pole with 1/m = 1/I = 0", &theory, "1/m = 1/I = 0 for a barrier");
}

fn damage(ledger: &mut Ledger) {
    let [theory, guide] = ["docs/theory.md", "docs/guide/case-file.md"].map(page);
    ledger
        .cited("CRASH3 has 2, 4 or 6 stations", "the forms of CRASH3's program, which nothing here computes");
    ledger.cited("The stations divide it into N − 1 equal parts", "the parts between N points");
    ledger.cited("S_2,1 is S_2 of vehicle 1", "a way of writing");
    ledger.quoted("G = A²/2B where the file does not give it", &theory, "G = A²/2B");
    ledger.quoted("√(2 E/w) of a test", &guide, "√(2 E/w) = d0 + d1 C");
    let inches: f64 = 0.3048 / 0.0254;
    ledger.made(format!("a factor of {} in d1 is {} in B", number(inches, 0), number(inches * inches, 0)));
    let [least, most] = bounds("category");
    ledger.made(format!("`, {least} to {most}: A, B and G of CRASH3's table"));
    ledger.cited(
        "(SAE 870045, Table 1, read from a poor scan; G of category 2, rear, is doubtful)",
        "the place of the table",
    );
    ledger.cited(
        "The categories group cars of the 1970s by size",
        "the age of the crash tests behind CRASH3's table",
    );
    ledger.cited("(usually 5 to 10 km/h for a front)", "a rule of thumb of those who evaluate barrier tests");
    let ratio = number(limit("force-balance"), 0);
    ledger.made(format!("it should be near 1, and beyond {ratio} a warning says so"));
    ledger.made(format!("the ratio of the peak forces (at most {ratio})"));
    ledger.made(format!("stand for differ by more than a factor of {ratio}"));
    let factor = |angle: f64| ObliqueCorrection::Capped.factor(angle).unwrap().factor;
    ledger.made(format!("multiplied by a factor f ≥ {}", number(factor(0.0), 0)));
    let capped = |angle: f64| ObliqueCorrection::Capped.factor(angle).unwrap().capped;
    ledger.made(format!(
        "meets the damaged side at more than {}° to its normal, and CRASH3's correction was limited to a factor of {}",
        degrees(threshold(1.5, 0.1, capped)),
        number(factor(1.5), 0)
    ));
    // γ = k²/(k² + h²) with h from 0 on
    ledger.cited("between 0 and 1: the share of the mass", "the range of k²/(k² + h²)");
    ledger.cited("γ = 1 is a force through the centre of gravity", "k²/(k² + h²) with h = 0");
    ledger.cited("If γ is far below 1", "that value");
}

fn impact(ledger: &mut Ledger) {
    let theory = page("docs/theory.md");
    ledger.quoted("u_n < 0 is an approach", &theory, "an approach has u_n < 0");
    ledger.cited("U_n ≥ 0 a separation", "the sign of n");
    ledger.quoted("U_t = 0 means that it has ended", &theory, "U_t = 0, so μ = μ_c");
    ledger.quoted("ends the sliding, U_t = 0, so that", &theory, "U_t = 0, so μ = μ_c");
    ledger.cited("K, in 1/kg", "a unit");
    let [least, most] = bounds("restitution");
    ledger.made(format!("from {least} (the contact points stay together along n) to {most}"));
    ledger.made(format!("` is e_n, {least} to {most}"));
    let [speed, restitution] = high_restitution();
    let feet = number(speed.parse::<f64>().unwrap() / FOOT, 0);
    ledger.made(format!("tests above {speed} m/s ({feet} ft/s) show {restitution} and less"));
    ledger.made(format!(
        "Restitution is above {restitution} at a closing speed above {speed} m/s ({feet} ft/s)"
    ));
    ledger.made(format!("restitution against closing speed ({restitution} above {speed} m/s)"));
    ledger.cited(
        "at medium and high speeds some 0.1 (SAE 931842), or give a curve",
        "the abstract of that paper",
    );
    ledger.quoted("With e = 1 no energy is dissipated", &theory, "With e = 1, W_n is zero at every speed");
    ledger.cited("includes interlocking, and may exceed 1", "no bound follows from the equations");
    ledger.quoted(
        "It is u_t/((1+e) u_n) only for a central impact",
        &theory,
        "μ_c = r/(1+e) | only for central impact",
    );
    ledger.quoted("takes f μ_c, 0 ≤ f ≤ 1", &theory, "0 ≤ f ≤ 1");
    ledger.quoted(
        "Where D ≥ 0, no push ends the sliding",
        &theory,
        "Where D ≥ 0 no friction, however large, ends the sliding",
    );
    ledger.cited(
        "Between vehicles 0.55 is usual, and 0.3 to 1.0 the range (SMAC: McHenry & McHenry, SAE 970947)",
        "friction between vehicles as the manual of SMAC gives it: McHenry and McHenry, SAE 970947; nothing here computes it",
    );
    ledger.quoted("M = (1 + e_m) M_c", &theory, "M = (1+e_m) M_c");
    let [none, most] = bounds("moment_restitution");
    ledger.made(format!("` is e_m, from {none} (no moment, the default) over 0 (common yaw rate) to {most}"));
    ledger.quoted("a common velocity, U_n = 0 and U_t = 0", &theory, "| Woolley | U_n = 0 | U_t = 0 |");
    let [least, most] = bounds("tangential_restitution");
    // U_t = −e_t u_t
    ledger.made(format!(
        "` is e_t, {least} to {most}: 0 ends the sliding, {least} leaves it as it was (no friction), above 0 the surfaces spring back"
    ));
    ledger.quoted("With e_t = 0 it is Brach's critical condition", &theory, "U_t = 0, so μ = μ_c");
    ledger.quoted("k_nn + μ k_nt ≤ 0: an impulse of this ratio", &theory, "k_nn + μ k_nt ≤ 0 is a jam");
    ledger.cited("the condition asks for P_n < 0", "the sign of a pull");
}

fn answer(ledger: &mut Ledger) {
    let theory = page("docs/theory.md");
    ledger.quoted("W_n = (1 − e²) E on the absorbed one", &theory, "(absorbed basis: (1−e²)(E_1 + E_2))");
    ledger.quoted("so W_n = (1 − e²) E", &theory, "(absorbed basis: (1−e²)(E_1 + E_2))");
    ledger.quoted("It is zero for e = 1", &theory, "With e = 1, W_n is zero at every speed");
    let energy = number(100.0 * limit("damage-energy"), 0);
    ledger.made(format!("Compare it with E where both speeds are known: a check does, to {energy} %"));
    ledger.made(format!("normal work against crush energy where both speeds are given ({energy} %)"));
    ledger.made(format!(
        "the normal impulse differs by more than {energy} % from what it should be by the crush energy"
    ));
    // Energy grows with the square of the closing speed.
    let speed = 100.0 * (1.1_f64.sqrt() - 1.0);
    ledger.made(format!("A difference in energy of 10 % is about {speed:.0} % in closing speed"));
    let rebound = |e: f64| number(100.0 * e * e, 0);
    ledger.made(format!(
        "With e = 0.1 the two differ by {} %, with 0.3 by {} % in energy",
        rebound(0.1),
        rebound(0.3)
    ));
    ledger.quoted("Admissible is a speed of at most 1000 m/s", &theory, "a speed of at most 1000 m/s");
    ledger.quoted("W_n = ½ (1 − e) x P_n is a quadratic", &theory, "W_n = ½ (1−e) x P_n(x)");
    ledger.cited("u_t0 that at x = 0", "the definition");
    let factor = |e: f64| ((1.0 + e) / (1.0 - e)).sqrt();
    ledger.made(format!("f_e, without unit, {} or more", number(factor(0.0), 0)));
    ledger.quoted("a common normal velocity, e = 0;", &theory, "A common normal velocity (e = 0)");
    ledger.made(format!(
        "where e is more than about 0.1, as in light collisions: without it CRASH3 is low by some {} % at e = 0.1",
        number(100.0 * (1.0 - 1.0 / factor(0.1)), 0)
    ));
}

fn ranges(ledger: &mut Ledger) {
    ledger.made(format!("and holds {} %", within(1.0)));
    ledger.made(format!("a power of two, such as {}", 2_u32.pow(16)));
    ledger.cited("that an input brings, 0 to 1", "the range of a share");
    let [low, high] = uncertainty::TORNADO_PROBABILITIES.map(|probability| number(100.0 * probability, 1));
    ledger.made(format!("is put to its {low} % and its {high} % quantile"));
    let sets = uncertainty::REPLICATES;
    ledger.made(format!("in each of {sets} sets, each range is divided"));
    ledger.made(format!("in {sets} sets that are scrambled by the seed"));
    ledger.cited("(JCGM 100:2008), equation 10", "the place of the equation");
    ledger.made(format!(
        "where it differs from the samples by more than {} %",
        number(100.0 * uncertainty::FIRST_ORDER_LIMIT, 0)
    ));
    ledger.cited("Inputs are ranked by the change for 1 %, or for 1° of an angle", "the definition");
}

/// The paper's example with both speeds and these changes: what it is warned of.
fn warned(changes: &[(&str, String)]) -> Analysis {
    let mut text = page("fixtures/sae-980025.toml").text;
    for (old, new) in changes {
        assert_eq!(text.matches(old).count(), 1, "{old}");
        text = text.replace(old, new);
    }
    analysis::reconstruct(&Case::parse("warned.toml", &text).unwrap()).unwrap()
}

/// (deg) how far a given PDOF may be from that of the impulse.
pub(super) fn pdof_difference() -> String {
    let computed =
        json("reconstruct fixtures/sae-980025.toml")["vehicle1"]["pdof"].as_f64().unwrap().to_degrees();
    let differs = |angle: f64| {
        let pdof =
            ("side      = \"front\"", format!("side = \"front\"\npdof = \"{} deg\"", computed + angle));
        warned(&[pdof]).warnings.iter().any(|warning| matches!(warning, Warning::PdofDiffers { .. }))
    };
    number(threshold(30.0, 0.0, differs), 0)
}

fn warnings(ledger: &mut Ledger) {
    // How far the contact point may lie before the front of a Jimmy that is as long as its CG is behind that.
    let outside = |distance: f64| {
        let contact = (
            "contact     = { distance = \"6.3 ft\", angle = \"-22.4 deg\" }",
            format!(
                "contact = {{ x = \"{} m\", y = \"-0.7 m\" }}\nlength = \"4 m\"\nwidth = \"1.8 m\"\ncg_to_front = \"1.8 m\"",
                1.8 + distance
            ),
        );
        warned(&[contact]).warnings.iter().any(|warning| matches!(warning, Warning::ContactOutside { .. }))
    };
    ledger.made(format!(
        "The contact point lies more than {} cm outside of the vehicle's outline",
        number(100.0 * threshold(0.3, 0.0, outside), 0)
    ));
    ledger.made(format!(
        "for a vehicle differs by more than {}° from that of the computed impulse",
        pdof_difference()
    ));
    ledger.cited("a PDOF by eye is good to 10° or 15°", "half an hour of the clock, or somewhat less");
    let opposite = degrees(opposite_limit());
    ledger.made(format!("the given PDOFs against opposite ({opposite}°)"));
    ledger.made(format!("that the file gives are more than {opposite}° from opposite in the scene"));
    let differs =
        Warning::DeltaVDiffers { impact: [Some(10.0); 2], crash3: [Some(8.0); 2], restitution: true };
    assert!(report::message(&differs, Units::Si, Axes::ZUp).contains("by more than 10 %"));
    ledger.made("and that of the impact differ by more than 10 %. That");
    let no_factor = |e: f64| EnergyBasis::Dissipated.restitution_factor(e).is_err();
    ledger.made(format!(
        "(without only for e = {}, which it cannot have)",
        number(threshold(1.0, 0.0, no_factor), 0)
    ));
    places(ledger);
    magnitudes(ledger);
    stiffness(ledger);
    works(ledger);
    jumps(ledger);
    ledger.made(format!("|μ| is above {}:", large_ratio()));
    let friction =
        |mu: f64| is_warned("unusual-friction", &skid(1.0, &format!("{{ friction = {mu:?} }}"), ""));
    ledger.made(format!(
        "is below {} or above {}",
        number(threshold(0.0, 0.5, friction), 1),
        number(threshold(2.0, 0.5, friction), 1)
    ));
    ledger.cited(
        "Between vehicles 0.3 to 1.0 is usual, 0.55 is a common choice",
        "friction between vehicles as the manual of SMAC gives it: McHenry and McHenry, SAE 970947; nothing here computes it",
    );
    ledger.cited("A limit of 45 is per cent or degrees", "a slip, as an example");
    ledger.made(format!("{} % is {}", 45, number(45.0 / 100.0, 2)));
    let turned = |angle: f64| {
        is_warned(
            "large-angle",
            &damaged("", "", SOFT).replace("pdof = \"0 deg\"", &format!("pdof = \"{angle} deg\"")),
        )
    };
    ledger
        .made(format!("more than a full turn to either side, {}°", number(threshold(500.0, 0.0, turned), 0)));
    ledger.made(format!("for 80 deg is {} turns", number(80.0 / (2.0 * PI), 1)));
}

/// What a car of 1500 kg against a wall is warned of, with more of its keys and those of its damage.
fn damaged(of_car: &str, of_crush: &str, stiffness: &str) -> String {
    format!(
        "[vehicle2]\nfixed = true\n[vehicle1]\nmass = \"1500 kg\"\nyaw_radius = \"1.4 m\"\n{of_car}\n[vehicle1.crush]\nside = \"front\"\n\
         width = \"1.5 m\"\ndepths = \"0.3 0.3 m\"\nmoment_arm = \"0 m\"\npdof = \"0 deg\"\nstiffness = {stiffness}\n{of_crush}\n"
    )
}

const SOFT: &str = "{ A = \"40 kN/m\", B = \"500 kN/m^2\" }";

/// A car that meets a wall at 10 m/s and slides along it at u_t (m/s), its contact point straight ahead.
fn skid(sliding: f64, tangential: &str, of_impact: &str) -> String {
    format!(
        "[vehicle2]\nfixed = true\n[vehicle1]\nmass = \"1000 kg\"\nyaw_radius = \"2 m\"\nheading = \"0 deg\"\ncontact = {{ x = \"2 m\", y = \"0 m\" }}\n\
         velocity = {{ x = \"10 m/s\", y = \"{} m/s\" }}\n[impact]\ncrush_plane = \"0 deg\"\nrestitution = 0\ntangential = {tangential}\n{of_impact}\n",
        -sliding
    )
}

/// The analysis of a case with an impact, or of damage alone.
fn analysed(text: &str) -> Analysis {
    let file = Case::parse("warned.toml", text).unwrap();
    let analysis = if file.case.impact.is_some() { analysis::impact(&file) } else { analysis::crush(&file) };
    analysis.unwrap_or_else(|failure| panic!("{failure}"))
}

fn is_warned(code: &str, text: &str) -> bool {
    analysed(text).warnings.iter().any(|warning| warning.code() == code)
}

/// |μ| from which on the program warns.
pub(super) fn large_ratio() -> String {
    let warns = |mu: f64| is_warned("large-impulse-ratio", &skid(-40.0, &format!("{{ ratio = {mu} }}"), ""));
    number(threshold(2.0, 0.5, warns), 0)
}

fn jumps(ledger: &mut Ledger) {
    let text = page("fixtures/jump-full.toml").text;
    let law = "{ friction = 0.39469710475650066 }";
    assert!(text.contains(law));
    let needed = 0.394_697_104_361_8;
    let near = |share: f64| {
        is_warned("near-jump", &text.replace(law, &format!("{{ friction = {} }}", needed * (1.0 + share))))
    };
    let share = number(100.0 * threshold(0.0, 0.05, near), 0);
    ledger.made(format!("The answer lies within {share} % of a place where the law jumps to another"));
    ledger.made(format!("needs a friction limit that is within {share} % of the one given"));
    ledger.made(format!("the sliding u_t is within {share} % of one"));
    ledger.made(format!("No input is known to {share} %"));
    ledger.made(format!("is not named: over {share} %"));
    // M, and with it the step of the motion, goes with e_m: from which e_m on it is named, and the step that
    // this makes.
    let sides = |e_m: f64| {
        let text = text.replace("= -0.5 ", &format!("= {e_m} "));
        // The ratio of the full impulse is that of the critical condition.
        let critical =
            analysed(&text.replace(law, "\"critical\"")).impact.unwrap().outcome.impulse_ratio.abs();
        [1.0 + 1e-9, 1.0 - 1e-9]
            .map(|share| text.replace(law, &format!("{{ friction = {} }}", critical * share)))
    };
    let least = threshold(-0.5, -0.001, |e_m| is_warned("near-jump", &sides(e_m)[0]));
    let [one, other] = sides(least).map(|text| analysed(&text).impact.unwrap());
    // (J) twice the energy of a change of motion, from the answer or from rest.
    let changed = |i: usize, from: [f64; 3]| {
        let (body, after) = (one.contact.participants()[i].body(), one.outcome.after[i]);
        let [x, y, turned] =
            [after.velocity.x - from[0], after.velocity.y - from[1], after.yaw_rate - from[2]];
        (x * x + y * y) / body.inverse_mass() + turned * turned / body.inverse_yaw_inertia()
    };
    let [jump, whole] = [&other.outcome.after, &one.outcome.before].map(|motions| -> f64 {
        (0..2).map(|i| changed(i, [motions[i].velocity.x, motions[i].velocity.y, motions[i].yaw_rate])).sum()
    });
    let step = (jump / whole).sqrt();
    ledger.made(format!(
        "A jump of less than {} % of what the impact does is not named",
        number(100.0 * step, 1)
    ));
    ledger.cited("(not with e_m = 0)", "0 is a common yaw rate");
    ledger.cited("but for e_m = 0 and −1", "0 is a common yaw rate");
}

fn places(ledger: &mut Ledger) {
    let outline = "length = \"4.5 m\"\nwidth = \"1.8 m\"\ncg_to_front = \"2 m\"";
    let contact = |x: f64, y: f64| format!("contact = {{ x = \"{x} m\", y = \"{y} m\" }}");
    // The damage ends 75 cm to the left.
    let beside = |beyond: f64| {
        is_warned("contact-off-damage", &damaged(&contact(2.0, 0.75 + beyond), "offset = \"0 m\"", SOFT))
    };
    let beside = number(100.0 * threshold(0.5, 0.0, beside), 0);
    ledger.made(format!("The contact point lies more than {beside} cm beyond the end of the damage"));
    ledger.made(format!("a judgement, hence {beside} cm"));
    let behind =
        |distance: f64| is_warned("contact-other-half", &damaged(&contact(-distance, 0.0), "", SOFT));
    ledger.made(format!("and so on, by more than {} cm", number(100.0 * threshold(0.5, 0.0, behind), 0)));
    // The front reaches 90 cm to the left, the damage 75 cm and the offset.
    let outside = |beyond: f64| {
        is_warned("damage-outside", &damaged(outline, &format!("offset = \"{} m\"", 0.15 + beyond), SOFT))
    };
    ledger.made(format!(
        "reaches more than {} cm beyond the end of the damaged side",
        number(100.0 * threshold(0.5, 0.0, outside), 0)
    ));
}

/// From what to what the program takes a number of a vehicle for usual, where it does not.
fn usual(text: &str) -> [f64; 2] {
    let mut found = analysed(text).warnings.into_iter().filter_map(|warning| match warning {
        Warning::Implausible { usual, .. } => Some(usual),
        _ => None,
    });
    let usual = found.next().unwrap_or_else(|| panic!("all is usual in\n{text}"));
    assert_eq!(found.next(), None, "{text}");
    usual
}

fn magnitudes(ledger: &mut Ledger) {
    let plain = damaged("", "", SOFT);
    let [length, width] = [4.5, 1.8];
    let outline =
        damaged(&format!("length = \"{length} m\"\nwidth = \"{width} m\"\ncg_to_front = \"2 m\""), "", SOFT);
    let with = |text: &str, old: &str, new: &str| {
        assert_eq!(text.matches(old).count(), 1, "{old}");
        text.replace(old, new)
    };
    let mass = usual(&with(&plain, "1500 kg", "90 t"));
    let of_size = usual(&with(&outline, "1500 kg", "90 t"))[1] / (length * width);
    ledger.made(format!(
        "a mass of {} kg to {} t (with an outline at most {} t/m²",
        number(mass[0], 0),
        number(mass[1] / 1000.0, 0),
        number(of_size / 1000.0, 0)
    ));
    ledger.cited(
        "cars have 0.15 to 0.25, a mixer 1.4)",
        "mass by length and width of small to large cars, and of a mixer of four axles: 32 t on 9.3 m by 2.5 m",
    );
    let radius = usual(&with(&plain, "1.4 m", "5 m"));
    let [of_cars, _] = radii();
    ledger.made(format!(
        "√(I/m) of {} to {} m (cars {} to {})",
        number(radius[0], 1),
        number(radius[1], 0),
        number(of_cars.iter().copied().fold(f64::INFINITY, f64::min), 1),
        number(of_cars.iter().copied().fold(0.0, f64::max), 1)
    ));
    let fast = skid(0.0, "{ friction = 0.5 }", "").replace("10 m/s", "100 m/s");
    ledger.made(format!("a speed up to {} km/h, crush", number(usual(&fast)[1] * 3.6, 0)));
    let body = |length: f64, width: f64| {
        let of_car = format!("length = \"{length} m\"\nwidth = \"{width} m\"\ncg_to_front = \"1 m\"");
        with(&damaged(&of_car, "", SOFT), "\nwidth = \"1.5 m\"", "\nwidth = \"0.4 m\"")
            .replace("1500 kg", "900 kg")
    };
    let [long, wide] = [usual(&body(70.0, 1.8)), usual(&body(4.5, 18.0))];
    ledger.made(format!(
        "a body {} to {} m long and {} to {} m wide",
        number(long[0], 1),
        number(long[1], 0),
        number(wide[0], 1),
        number(wide[1], 0)
    ));
    let depth = |text: &str| usual(&with(text, "0.3 0.3 m", "4 4 m"))[1];
    let close = |value: f64, expected: f64| assert!((value - expected).abs() < 1e-9, "{value} {expected}");
    // A body so small that its own size is the bound.
    let small = body(2.5, 1.3);
    close(depth(&small), 2.5 / 2.0);
    close(depth(&small.replace("\"front\"", "\"left\"")), 1.3);
    close(depth(&outline), depth(&plain));
    ledger.made(format!("crush no deeper than {} m, half the length or the width", number(depth(&plain), 1)));
    let test = |mass: &str, speed: &str| {
        let stiffness = format!(
            "{{ test = {{ mass = \"{mass}\", speed = \"{speed}\", width = \"1.5 m\", depths = \"0.5 0.5 m\", no_damage_speed = \"1 m/s\" }} }}"
        );
        usual(&damaged("", "", &stiffness))
    };
    close(test("60 t", "15 m/s")[1], mass[1]);
    let speeds = test("1500 kg", "50 m/s");
    ledger.made(format!("with {} m/s to {} km/h", number(speeds[0], 0), number(speeds[1] * 3.6, 0)));
    let damage = |text: &str| usual(&with(text, "width = \"1.5 m\"", "width = \"9 m\""))[1];
    let more = damage(&outline) / width;
    close(damage(&outline.replace("\"front\"", "\"left\"")) / length, more);
    ledger.made(format!(
        "no wider than its side and {} % (else {} m in front and rear, {} m at the sides)",
        number(100.0 * (more - 1.0), 0),
        number(damage(&plain), 1),
        number(damage(&plain.replace("\"front\"", "\"left\"")), 0)
    ));
}

/// (mph) the no-damage speeds of CRASH3's categories, without and then with the rear of category 4: on the width of a car of about that size, whose mass
/// is usual for it, and on 2 m of its side.
pub(super) fn no_damage_speeds() -> [f64; 3] {
    let cars = [(1, 950.0), (2, 1200.0), (3, 1500.0), (4, 1800.0), (5, 2100.0)];
    let (mut usual, mut high) = (Vec::new(), 0.0);
    for (category, mass) in cars {
        let body = VehicleClass::new(category).unwrap().width;
        for (side, width) in [(Side::Front, body), (Side::Rear, body), (Side::Left, 2.0)] {
            let stiffness = Stiffness::<f64>::from_category(side, category).unwrap();
            // b_0 = √(2 G w/m)
            let speed = (2.0 * stiffness.g() * width / mass).sqrt() / MILE_PER_HOUR;
            if (side, category) == (Side::Rear, 4) { high = speed } else { usual.push(speed) }
        }
    }
    usual.sort_by(f64::total_cmp);
    [usual[0], usual[usual.len() - 1], high]
}

/// (mph) the no-damage speed from which on the program warns.
pub(super) fn high_no_damage_speed() -> f64 {
    threshold(20.0, 1.0, |speed| no_damage_speed_is_warned("high-no-damage-speed", speed)) / MILE_PER_HOUR
}

/// Of a no-damage speed (m/s).
fn no_damage_speed_is_warned(code: &str, speed: f64) -> bool {
    // b_0 = √(2 G w/m), so that G = b_0² m/2w
    let g = speed * speed * 1500.0 / 3.0;
    is_warned(code, &damaged("", "", &format!("{{ A = \"40 kN/m\", B = \"500 kN/m^2\", G = \"{g} N\" }}")))
}

fn stiffness(ledger: &mut Ledger) {
    ledger.cited(
        "Fronts have some 5 mph",
        "a rule of thumb, as the 5 to 10 km/h of those who evaluate barrier tests",
    );
    ledger.made(format!("5 mph ({} km/h) by tests", number(5.0 * MILE_PER_HOUR * 3.6, 0)));
    let [least, most, rear] = no_damage_speeds().map(|speed| number(speed, 0));
    let limit = high_no_damage_speed();
    ledger.made(format!("categories stand for {least} to {most} mph, but the rear of category 4 for {rear}"));
    ledger.made(format!("Above {} mph a warning says", number(limit, 0)));
    ledger.made(format!(
        "at more than {} mph ({} m/s) leaves no damage: b_0 = √(2 G w/m)",
        number(limit, 0),
        number(limit * MILE_PER_HOUR, 1)
    ));
    ledger.made(format!(
        "stand for {least} to {most} mph over the width of the face, but for the rear of category 4 ({rear})"
    ));
    let low = threshold(0.1, 1.0, |speed| no_damage_speed_is_warned("low-no-damage-speed", speed));
    ledger.made(format!(
        "at less than {} mph ({} m/s) leaves damage already: b_0 = √(2 G w/m)",
        number(low / MILE_PER_HOUR, 0),
        number(low, 2)
    ));
    ledger.made(format!("categories stand for {least} to {most} mph over the width of the face. Mostly"));
    ledger.cited("A line that is meant to begin at zero has A = 0", "what A means");
}

/// (%) the works of the tangential and of the moment impulse, of the energy loss.
fn shares(text: &str) -> [f64; 2] {
    let energy = analysed(text).impact.unwrap().outcome.energy;
    [energy.tangential_work, energy.moment_work].map(|work| 100.0 * work / energy.loss)
}

fn works(ledger: &mut Ledger) {
    let ratio = |mu: f64| skid(-4.0, &format!("{{ ratio = {mu} }}"), "");
    let along = threshold(-0.2, 0.0, |mu| is_warned("sliding-driven", &ratio(mu)));
    let [sliding, _] = shares(&ratio(along));
    ledger.made(format!(
        "The work of the tangential impulse is below {} % of the energy loss",
        number(sliding, 0)
    ));
    let moment = |e_m: f64| skid(-4.0, "{ ratio = 0.2 }", &format!("moment_restitution = {e_m}"));
    let beyond = threshold(0.9, 0.1, |e_m| is_warned("rotation-driven", &moment(e_m)));
    let [_, rotation] = shares(&moment(beyond));
    ledger.made(format!(
        "The work of the moment impulse is below {} % of the energy loss",
        number(rotation, 0)
    ));
    ledger.cited("` above 0 does so wherever", "0 is a common yaw rate");
    ledger.cited("with 0 or less it happens", "0 is a common yaw rate");
    ledger.cited("Give 0 or less, or leave", "0 is a common yaw rate");
    // The two staged collisions in which a ratio that was fitted to the test drives the sliding most.
    let mut staged: Vec<(f64, u8)> = [1, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]
        .map(|test| (shares(&page(&format!("fixtures/ricsac/{test:02}.toml")).text)[0], test))
        .to_vec();
    staged.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    let most = staged[0].0;
    let mut tests = [staged[0].1, staged[1].1];
    tests.sort_unstable();
    ledger.made(format!(
        "Up to {} % comes of ratios fitted to staged collisions (RICSAC {}, {}), hence {} %",
        number(-most, 1),
        tests[0],
        tests[1],
        number(-sliding, 0)
    ));
}
