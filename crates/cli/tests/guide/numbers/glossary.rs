//! Patterns of crates/report/glossary.md, put together from the sources of their numbers.

use std::f64::consts::PI;

use analysis::{Analysis, Warning};
use case::{Axes, CaseFile};
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
    motion(ledger);
    ranges(ledger);
    warnings(ledger);
    let objects = field::ciss::OBJECTS;
    ledger.made(format!("(OBJCONT {} to {})", objects.start(), objects.end()));
}

fn frames(ledger: &mut Ledger) {
    let [theory, guide] = ["docs/theory.md", "docs/guide/case-file.md"].map(page);
    let [right_angle, straight_angle] = [PI / 2.0, PI].map(degrees);
    ledger.made(format!("turned … +{right_angle}°"));
    ledger.made(format!("t is n rotated … +{right_angle}°"));
    ledger.made(format!("headings … {straight_angle}°"));
    ledger.made(format!("+ {straight_angle}° … plane"));
    ledger.made(format!("in (−{straight_angle}°, {straight_angle}°]"));
    let square = |side: Side| number(side.square_pdof().to_degrees(), 0);
    let [front, right, rear, left] = [Side::Front, Side::Right, Side::Rear, Side::Left].map(square);
    ledger.made(format!("{front}° … squarely … {right}° … {left}°"));
    ledger.made(format!("({front}° … front … {right}° … {rear}° … {left}°"));
    let hour = clock(2) - clock(1);
    ledger.made(format!("({hour:.0}° … finer … ±{:.0}°", hour / 2.0));
    ledger.made(format!("finer … {:.0}°", hour / 2.0));
    ledger.quoted("PDOF_2 = θ_2 − θ_1 + PDOF_1 − 180°", &theory, "PDOF_2 = θ_2 − θ_1 + PDOF_1 − 180°");
    ledger.quoted("impact … 0", &guide, "0 (the default)");
    ledger.made(format!("itself … {right_angle}°"));
    ledger.made(format!("mistake is {straight_angle}°"));
    ledger.made(format!("θ_1 − PDOF_1 … θ_2 − PDOF_2 … differ … {straight_angle}°"));
    ledger.made(format!("|α| < {right_angle}°"));
    ledger.made(format!("makes … {right_angle}°"));
}

fn motion(ledger: &mut Ledger) {
    let theory = page("docs/theory.md");
    ledger.quoted("Within 10° of one line", &theory, "Approaches within 10° of each other");
    let edcrash = "the EDCRASH manual: tables of chapter 2, the limit of a spin in chapter 4";
    ledger.cited("asphalt … 0.55 … 0.80", edcrash);
    ledger.cited("did not spin … 10°", edcrash);
    ledger.cited(
        "miss one by more than 0.5 m and 15 % of the path",
        "REST_LEAST of deltav-analysis, and the limit of the EDCRASH manual for a point on the curve",
    );
    ledger.cited("among those within 0.5 m", "REST_LEAST of deltav-analysis");
    ledger.cited("overlap by more than 0.5 m", "OVERLAP in crates/analysis/src/warning.rs");
    ledger.cited(
        "too far away: by more than 15 % of the path",
        "the limit of the EDCRASH manual for a point on the curve",
    );
    ledger.cited("free wheel … 0.01", edcrash);
    ledger.cited("flat tyre … 0.013", edcrash);
    ledger.cited("high gear … 0.15 … 0.20", edcrash);
    ledger.cited("low gear … 0.2 … 0.4", edcrash);
    let (friction, grade) = (0.7, 0.03);
    ledger.made(format!("distance: {grade} is a grade of {:.0} %", 100.0 * grade));
    // S = v²/(2 g (μ ± s)): longer or shorter by the share s/μ.
    let share = number(100.0 * grade / friction, 0);
    ledger.made(format!("friction of {friction}, a grade of {:.0} % … {share} %", 100.0 * grade));
    ledger.cited("outline (SAE 870045", "the number of the paper");
}

/// (m) k of CRASH3's classes, and the share by which k of Burg's estimate is below these.
fn radii() -> [Vec<f64>; 2] {
    let classes: Vec<VehicleClass> = (1..=6).map(|class| VehicleClass::new(class).unwrap()).collect();
    let burg = |class: &VehicleClass| yaw_inertia_burg(1.0, class.wheelbase, class.length).unwrap().sqrt();
    let below = classes.iter().map(|class| 1.0 - burg(class) / class.yaw_radius).collect();
    [classes.iter().map(|class| class.yaw_radius).collect(), below]
}

fn vehicles(ledger: &mut Ledger) {
    let theory = page("docs/theory.md");
    ledger.quoted("Both … \"3696 lb\"", &page("fixtures/sae-980025.toml"), "weight = \"3696 lb\"");
    ledger.made(format!("divided … {} m/s²", case::STANDARD_GRAVITY));
    let burg = yaw_inertia_burg(1.0, 1.0, 1.0).unwrap();
    ledger.made(format!("estimates … = {burg} ×"));
    ledger.made(format!("= {burg} × … wheelbase"));
    let [spread, of_class] = [crash3::BURG_SPREAD, crash3::CLASS_SPREAD].map(|k| number(100.0 * k, 0));
    ledger.made(format!("class … right … ±{of_class} % … Burg … ±{spread} %"));
    ledger.made(format!("gyration … {spread} %"));
    ledger.made(format!("gyration … {of_class} %"));
    ledger.made(format!("classes … ±{of_class} % … Burg's … ±{spread} %"));
    ledger.cited("cars … 1970s", "the cars whose dimensions the classes have");
    let [radii, below] = radii().map(|mut values| {
        values.sort_by(f64::total_cmp);
        [values[0], values[5]]
    });
    ledger.made(format!("{} … {} m … CRASH3's … classes", number(radii[0], 1), number(radii[1], 1)));
    ledger.made(format!(
        "estimate … {} … {} % … below",
        number(100.0 * below[0], 0),
        number(100.0 * below[1], 0)
    ));
    let [least, most] = bounds("class");
    ledger.made(format!("{least} … {most}: CRASH3's … class"));
    ledger.cited("870045 … Table … 2", "the place of the table");
    ledger.quoted("barrier … 1/m = 1/I = 0", &theory, "1/m = 1/I = 0 for a barrier");
}

fn damage(ledger: &mut Ledger) {
    let [theory, guide] = ["docs/theory.md", "docs/guide/case-file.md"].map(page);
    ledger
        .cited("CRASH3 … 2, 4 … 6 … stations", "the forms of CRASH3's program, which nothing here computes");
    ledger.cited("N − 1 … equal", "the parts between N points");
    ledger.cited("S_2,1 … S_2 … vehicle … 1", "a way of writing");
    ledger.quoted("= A²/2B … where", &theory, "G = A²/2B");
    ledger.quoted("√(2 … E/w", &guide, "√(2 E/w) = d0 + d1 C");
    let inches: f64 = 0.3048 / 0.0254;
    ledger.made(format!("factor … {} in d1 … {} in", number(inches, 0), number(inches * inches, 0)));
    let [least, most] = bounds("category");
    ledger.made(format!("{least} … {most} … CRASH3's … table"));
    ledger.cited("870045 … Table … 1", "the place of the table");
    let inches = |class: u8| number(VehicleClass::new(class).unwrap().wheelbase / FOOT * 12.0, 0);
    for (category, name) in [
        (1, "minicar"),
        (2, "subcompact"),
        (3, "compact"),
        (4, "intermediate car"),
        (5, "full-size or large car"),
    ] {
        ledger.made(format!("{category} … {name} ({} in", inches(category)));
    }
    ledger.cited("categories … 1970s", "the age of the crash tests behind CRASH3's table");
    ledger.cited("usually … 5 … 10 km/h", "a rule of thumb of those who evaluate barrier tests");
    let ratio = number(limit("force-balance"), 0);
    ledger.made(format!("should … 1 … {ratio}"));
    ledger.made(format!("forces … {ratio})"));
    ledger.made(format!("by … factor of {ratio}"));
    let factor = |angle: f64| ObliqueCorrection::Capped.factor(angle).unwrap().factor;
    ledger.made(format!("factor … ≥ {}", number(factor(0.0), 0)));
    let capped = |angle: f64| ObliqueCorrection::Capped.factor(angle).unwrap().capped;
    ledger.made(format!(
        "{}° … normal … CRASH3's … {}",
        degrees(threshold(1.5, 0.1, capped)),
        number(factor(1.5), 0)
    ));
    // γ = k²/(k² + h²) with h from 0 on
    ledger.cited("0 … 1 … share", "the range of k²/(k² + h²)");
    ledger.cited("γ = 1 … through", "k²/(k² + h²) with h = 0");
    ledger.cited("below … 1", "that value");
}

fn impact(ledger: &mut Ledger) {
    let theory = page("docs/theory.md");
    ledger.quoted("u_n < 0 … approach", &theory, "approach … u_n < 0");
    ledger.cited("U_n ≥ 0 … separation", "the sign of n");
    ledger.quoted("U_t = 0 … means", &theory, "U_t = 0, so μ = μ_c");
    ledger.quoted("sliding … U_t = 0", &theory, "U_t = 0, so μ = μ_c");
    ledger.cited("K, in 1/kg", "a unit");
    let [least, most] = bounds("restitution");
    ledger.made(format!("{least} … contact … {most}"));
    ledger.made(format!("e_n, {least} … {most}"));
    let [speed, restitution] = high_restitution();
    let feet = number(speed.parse::<f64>().unwrap() / FOOT, 0);
    ledger.made(format!("tests … {speed} m/s ({feet} ft/s) … {restitution}"));
    ledger.made(format!("Restitution … {restitution} … {speed} m/s ({feet} ft/s)"));
    ledger.made(format!("closing … ({restitution} … {speed} m/s)"));
    ledger.cited("speeds … 0.1 … 931842)", "the abstract of that paper");
    ledger.quoted("e = 1 … dissipated", &theory, "With e = 1, W_n is zero at every speed");
    ledger.cited("exceed … 1", "no bound follows from the equations");
    ledger.quoted("u_t/((1+e) u_n) … central", &theory, "μ_c = r/(1+e) | only for central impact");
    ledger.quoted("takes … μ_c, 0 ≤ … ≤ 1", &theory, "0 ≤ f ≤ 1");
    ledger.quoted("D ≥ 0 … sliding", &theory, "D ≥ 0 … friction");
    ledger.cited(
        "vehicles … 0.55 … 0.3 … 1.0 … 970947)",
        "friction between vehicles as the manual of SMAC gives it: McHenry and McHenry, SAE 970947; nothing here computes it",
    );
    ledger.quoted("= (1 + e_m) M_c", &theory, "M = (1+e_m) M_c");
    let [none, most] = bounds("moment_restitution");
    ledger.made(format!("{none} … moment … 0 … {most}"));
    ledger.quoted("velocity … U_n = 0 … U_t = 0", &theory, "| Woolley | U_n = 0 | U_t = 0 |");
    let [least, most] = bounds("tangential_restitution");
    // U_t = −e_t u_t
    ledger.made(format!("e_t, {least} … {most}: 0 … sliding … {least} … 0"));
    ledger.quoted("e_t = 0 … Brach's", &theory, "U_t = 0, so μ = μ_c");
    ledger.quoted("k_nn + μ k_nt ≤ 0 … impulse", &theory, "k_nn + μ k_nt ≤ 0 is a jam");
    ledger.cited("condition … P_n < 0", "the sign of a pull");
}

fn answer(ledger: &mut Ledger) {
    let theory = page("docs/theory.md");
    ledger.quoted("W_n = (1 − e²) … absorbed", &theory, "(absorbed basis: (1−e²)(E_1 + E_2))");
    ledger.quoted("W_n = (1 − e²)", &theory, "(absorbed basis: (1−e²)(E_1 + E_2))");
    ledger.quoted("zero … e = 1", &theory, "With e = 1, W_n is zero at every speed");
    let [least, most] = bounds("tangential_share");
    ledger.made(format!("damage shows, from {least} to {most}: with"));
    ledger.cited("W_n + 0.5 W_t = E. 0 is", "the definition of λ");
    let factor = "1 + tan α tan β (1 − e_t)/(1 − e_n)";
    ledger.quoted(factor, &theory, factor);
    ledger.quoted("not a share of 1", &theory, "is not λ = 1");
    let energy = number(100.0 * limit("damage-energy"), 0);
    ledger.made(format!("check … {energy} %"));
    ledger.made(format!("given … ({energy} %)"));
    ledger.made(format!("differs … {energy} %"));
    // Energy grows with the square of the closing speed.
    let speed = 100.0 * (1.1_f64.sqrt() - 1.0);
    ledger.made(format!("difference … 10 % … {speed:.0} % in"));
    let rebound = |e: f64| number(100.0 * e * e, 0);
    ledger.made(format!("e = 0.1 … differ … {} % … 0.3 … {} % in", rebound(0.1), rebound(0.3)));
    ledger.quoted("Admissible … 1000 m/s", &theory, "a speed of at most 1000 m/s");
    ledger.quoted("W_n = ½ (1 − … quadratic", &theory, "W_n = ½ (1−e) x P_n(x)");
    ledger.cited("u_t0 … x = 0", "the definition");
    let factor = |e: f64| ((1.0 + e) / (1.0 - e)).sqrt();
    ledger.made(format!("f_e … {} or more", number(factor(0.0), 0)));
    ledger.quoted("velocity … e = 0", &theory, "A common normal velocity (e = 0)");
    ledger.made(format!(
        "0.1 … collisions … CRASH3 … {} % … e = 0.1",
        number(100.0 * (1.0 - 1.0 / factor(0.1)), 0)
    ));
}

fn ranges(ledger: &mut Ledger) {
    ledger.cited("interval holds 95 %", "LEVELS of deltav-estimate");
    let limits = "DOUBTFUL and CONTRADICTS in crates/analysis/src/estimate/agreement.rs";
    ledger.cited("From 0.05 … below 0.01", limits);
    ledger.made(format!("holds … {} %", within(1.0)));
    ledger.made(format!("power … {}", 2_u32.pow(16)));
    ledger.cited("contributes … 0 … 1", "the range of a share");
    let [low, high] = uncertainty::TORNADO_PROBABILITIES.map(|probability| number(100.0 * probability, 1));
    ledger.made(format!("{low} % … {high} % … quantile"));
    let sets = uncertainty::REPLICATES;
    ledger.made(format!("{sets} … range"));
    ledger.made(format!("in {sets} … scrambled"));
    ledger.cited("100:2008) … equation … 10", "the place of the equation");
    ledger.made(format!("samples … {} %", number(100.0 * uncertainty::FIRST_ORDER_LIMIT, 0)));
    ledger.cited("change … 1 % … 1° … 10 cm … 1 cm", "the definition");
}

/// The analysis, with its warnings, of the paper's example with both speeds and these changes.
fn warned(changes: &[(&str, String)]) -> Analysis {
    let mut text = page("fixtures/sae-980025.toml").text;
    for (old, new) in changes {
        assert_eq!(text.matches(old).count(), 1, "{old}");
        text = text.replace(old, new);
    }
    analysis::reconstruct(&CaseFile::parse("warned.toml", &text).unwrap().case).unwrap()
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
    // How far the contact point may be ahead of the front of the Jimmy, which here is 1.8 m ahead of its CG.
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
    ledger.made(format!("{} cm … outside", number(100.0 * threshold(0.3, 0.0, outside), 0)));
    ledger.made(format!("differs … {}°", pdof_difference()));
    ledger.made(format!("without it 0 to {} km/h", number(3.6 * analysis::FASTEST_BELIEVED, 0)));
    let nearly_stood = number(3.6 * analysis::NEARLY_STOOD, 1);
    ledger.made(format!("above {nearly_stood} km/h the estimate"));
    ledger.made(format!("below {nearly_stood} km/h, or any"));
    // A recorder of the Altima, whose speed in the case is 10 mph.
    let recorder = |off: f64| {
        let speed = 10.0 * MILE_PER_HOUR + off;
        let line = (
            "speed       = \"10 mph\"",
            format!("speed = \"10 mph\"\nrecorder = {{ speed = \"{speed} m/s\" }}"),
        );
        warned(&[line]).warnings.iter().any(|warning| matches!(warning, Warning::EvidenceDiffers { .. }))
    };
    ledger.made(format!("deviations … {} km/h", number(3.6 * threshold(4.0, 0.0, recorder), 0)));
    let least = "LEAST_DIFFERENCE in crates/analysis/src/aside.rs";
    ledger.cited("that bound by more than 5 km/h", least);
    ledger.cited("its whole 95 % interval", "LEVELS of deltav-estimate");
    ledger.cited("below the bound by more than 5 km/h", least);
    ledger.cited("the lower end of the 95 % interval", "LEVELS of deltav-estimate");
    ledger.cited("the greatest stored speed by more than 5 km/h", least);
    ledger.cited("more than 45° off", "SKID_ASTRAY in crates/analysis/src/warning.rs");
    ledger.cited("recorders of crashes of 2017", "the data of docs/calibration.md");
    let share =
        |fitted: &evidence::Fitted, bias: fn(&evidence::Fitted) -> f64| number(100.0 * bias(fitted).exp(), 0);
    let of =
        |hit: evidence::DamagedSide| share(&evidence::FITTED.by_category(&[hit]), |fitted| fitted.crush_bias);
    let object = evidence::FITTED.by_category(&[evidence::DamagedSide::Front]);
    ledger.made(format!(
        "average {} % … impact took … {} % … side … {} % … rear … {} % … object",
        of(evidence::DamagedSide::Front),
        of(evidence::DamagedSide::Side),
        of(evidence::DamagedSide::Rear),
        share(&object, |fitted| fitted.objects.misfit.bias)
    ));
    let fleet = share(&evidence::FITTED, |fitted| fitted.crush_bias);
    let of_object = share(&evidence::FITTED, |fitted| fitted.objects.misfit.bias);
    ledger.quoted("cars of 1991 to 2018", &page("docs/calibration.md"), "crashes are of 1991 to 2018");
    ledger.made(format!("Energies from it are on average {fleet} % … ({of_object} % against"));
    ledger.cited("recorders of crashes of 2017, such", "the data of docs/calibration.md");
    ledger.made(format!("such energies were on average {fleet} % … {of_object} % where a front"));
    ledger.cited("good … 10°", "somewhat less than half an hour of the clock");
    ledger.made(format!("hour of the clock by more … {:.0}°", (clock(2) - clock(1)) / 2.0));
    ledger.made(format!("more than … {:.0}° for each", (clock(2) - clock(1)) / 2.0));
    let opposite = degrees(opposite_limit());
    ledger.made(format!("opposite … ({opposite}°)"));
    ledger.made(format!("{opposite}° … opposite"));
    let differs =
        Warning::DeltaVDiffers { impact: [Some(10.0); 2], crash3: [Some(8.0); 2], restitution: true };
    assert!(report::message(&differs.seen(Axes::ZUp), Units::Si).contains("by more than 10 %"));
    ledger.made("differ … 10 %");
    let no_factor = |e: f64| EnergyBasis::Dissipated.restitution_factor(e).is_err();
    ledger.made(format!("e = {} … cannot", number(threshold(1.0, 0.0, no_factor), 0)));
    places(ledger);
    magnitudes(ledger);
    stiffness(ledger);
    works(ledger);
    jumps(ledger);
    ledger.made(format!(
        "by more than {} % and {} m/s",
        number(100.0 * analysis::MOST_BY_DEGREE, 0),
        number(analysis::LEAST_BY_DEGREE, 0)
    ));
    ledger.made(format!("|μ| is above {}:", large_ratio()));
    let slipped = page("fixtures/rear-end-rest.toml").text.replace("friction = 0.7", "friction = 1.9");
    let judged = analysis::judge(&CaseFile::parse("ground.toml", &slipped).unwrap().case).warnings;
    let usual = judged.iter().find_map(|warning| match warning {
        Warning::GroundFriction { usual, .. } => Some(usual.map(|bound| bound.to_string())),
        _ => None,
    });
    let [least, most] = usual.unwrap();
    ledger.made(format!("ground is below {least} or above {most}."));
    let years = evidence::FLEET_YEARS;
    ledger.made(format!("model years {} to {}, and to depths", years.start(), years.end()));
    ledger.cited("has 0.07 to 0.25, dry asphalt 0.55 to 1.2", "the table of friction in the EDCRASH manual");
    let friction =
        |mu: f64| is_warned("unusual-friction", &skid(1.0, &format!("{{ friction = {mu:?} }}"), ""));
    ledger.made(format!(
        "below … {} … {}",
        number(threshold(0.0, 0.5, friction), 1),
        number(threshold(2.0, 0.5, friction), 1)
    ));
    ledger.cited(
        "vehicles … 0.3 … 1.0 … 0.55",
        "friction between vehicles as the manual of SMAC gives it: McHenry and McHenry, SAE 970947; nothing here computes it",
    );
    let way = "REST_MISSED, REST_SURVEY and SLOW_YAW of deltav-analysis";
    ledger.cited("ends more than 5 % of its length from the rest", way);
    ledger.cited("survey explains (0.25 m)", way);
    ledger.cited("yaw (up to 57°/s)", way);
    ledger.cited("does, by more than 30 cm", "CONTACT_APART of deltav-analysis");
    ledger.cited("limit … 45", "a slip, as an example");
    ledger.made(format!("{} % … {}", 45, number(45.0 / 100.0, 2)));
    let turned = |angle: f64| {
        is_warned(
            "large-angle",
            &damaged("", "", SOFT).replace("pdof = \"0 deg\"", &format!("pdof = \"{angle} deg\"")),
        )
    };
    ledger.made(format!("either … {}°", number(threshold(500.0, 0.0, turned), 0)));
    ledger.made(format!("80 … {} … turns", number(80.0 / (2.0 * PI), 1)));
}

/// The text of a case of a car of 1500 kg against a wall, with further keys of the car and of its damage.
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
    let file = CaseFile::parse("warned.toml", text).unwrap();
    let analysis =
        if file.case.impact.is_some() { analysis::impact(&file.case) } else { analysis::crush(&file.case) };
    analysis.unwrap_or_else(|failure| panic!("{failure}"))
}

fn is_warned(code: &str, text: &str) -> bool {
    analysed(text).warnings.iter().any(|warning| warning.code() == code)
}

/// |μ| above which the program warns.
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
    ledger.made(format!("within … {share} %"));
    ledger.made(format!("within … {share} %"));
    ledger.made(format!("within … {share} %"));
    ledger.made(format!("known … {share} %"));
    ledger.made(format!("because over {share} %"));
    // M, and with it the step of the motion, depends on e_m: the least e_m for which the jump is named, and
    // the step there.
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
    ledger.made(format!("{} % … impact", number(100.0 * step, 1)));
    ledger.cited("with … e_m = 0)", "0 is a common yaw rate");
    ledger.cited("e_m = 0 … and … −1", "0 is a common yaw rate");
}

fn places(ledger: &mut Ledger) {
    let outline = "length = \"4.5 m\"\nwidth = \"1.8 m\"\ncg_to_front = \"2 m\"";
    let contact = |x: f64, y: f64| format!("contact = {{ x = \"{x} m\", y = \"{y} m\" }}");
    // The damage ends 75 cm to the left.
    let beside = |beyond: f64| {
        is_warned("contact-off-damage", &damaged(&contact(2.0, 0.75 + beyond), "offset = \"0 m\"", SOFT))
    };
    let beside = number(100.0 * threshold(0.5, 0.0, beside), 0);
    ledger.made(format!("contact … {beside} cm"));
    ledger.made(format!("judgement … {beside} cm"));
    let behind =
        |distance: f64| is_warned("contact-other-half", &damaged(&contact(-distance, 0.0), "", SOFT));
    ledger.made(format!("so on … {} cm", number(100.0 * threshold(0.5, 0.0, behind), 0)));
    // The front is 2 m ahead of the CG, the crush 0.3 m deep.
    let deep = |distance: f64| {
        let contact = contact(2.0 - 0.3 - distance, 0.0);
        is_warned("contact-depth", &damaged(&format!("{outline}\n{contact}"), "", SOFT))
    };
    ledger.made(format!("crush: more than {} cm on front", number(100.0 * threshold(1.0, 0.0, deep), 0)));
    // The left side is 0.9 m from the CG.
    let deep = |distance: f64| {
        let contact = contact(0.0, 0.9 - 0.3 - distance);
        let of_front = damaged(&format!("{outline}\n{contact}"), "", SOFT);
        is_warned("contact-depth", &of_front.replace("\"front\"", "\"left\""))
    };
    ledger.made(format!("more than {} cm on the sides", number(100.0 * threshold(0.6, 0.0, deep), 0)));
    let [striking, _] = analysed(include_str!("../../../../../fixtures/ricsac/10.toml")).vehicles;
    let (body, damage) = (striking.subject.dimensions.unwrap(), striking.damage.unwrap());
    let deepest = damage.depths.into_iter().fold(0.0, f64::max);
    let behind = body.cg_to_front - deepest - striking.subject.contact.unwrap()[0];
    ledger.made(format!("up to {} cm behind it (RICSAC 10)", number(100.0 * behind, 0)));
    // The front reaches 90 cm to the left, the damage 75 cm and the offset.
    let outside = |beyond: f64| {
        is_warned("damage-outside", &damaged(outline, &format!("offset = \"{} m\"", 0.15 + beyond), SOFT))
    };
    ledger.made(format!("reaches … {} cm", number(100.0 * threshold(0.5, 0.0, outside), 0)));
}

/// The usual range of a number of a vehicle, from the warning about an unusual one.
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
    let of_size = usual(&with(&outline, "1500 kg", "90 t")).map(|mass| mass / (length * width));
    ledger.made(format!(
        "{} kg … {} t … outline … {} … {} t/m²",
        number(mass[0], 0),
        number(mass[1] / 1000.0, 0),
        number(of_size[0] / 1000.0, 1),
        number(of_size[1] / 1000.0, 2)
    ));
    ledger.cited("0.15 … 0.25)", "mass by length and width of small to large cars");
    let radius = usual(&with(&plain, "1.4 m", "5 m"));
    let [of_cars, _] = radii();
    ledger.made(format!(
        "{} … {} m … mostly … {} … {})",
        number(radius[0], 1),
        number(radius[1], 1),
        number(of_cars.iter().copied().fold(f64::INFINITY, f64::min), 1),
        number(of_cars.iter().copied().fold(0.0, f64::max), 1)
    ));
    let fast = skid(0.0, "{ friction = 0.5 }", "").replace("10 m/s", "100 m/s");
    ledger.made(format!("{} km/h … crush", number(usual(&fast)[1] * 3.6, 0)));
    let body = |length: f64, width: f64| {
        let of_car = format!("length = \"{length} m\"\nwidth = \"{width} m\"\ncg_to_front = \"1 m\"");
        with(&damaged(&of_car, "", SOFT), "\nwidth = \"1.5 m\"", "\nwidth = \"0.4 m\"")
            .replace("1500 kg", "900 kg")
    };
    let [long, wide] = [usual(&body(70.0, 1.8)), usual(&body(4.5, 18.0))];
    ledger.made(format!(
        "body … {} … {} m … {} … {} m",
        number(long[0], 1),
        number(long[1], 1),
        number(wide[0], 1),
        number(wide[1], 1)
    ));
    let depth = |text: &str| usual(&with(text, "0.3 0.3 m", "4 4 m"))[1];
    let close = |value: f64, expected: f64| assert!((value - expected).abs() < 1e-9, "{value} {expected}");
    // A body so small that its own size is the bound.
    let small = body(2.5, 1.3);
    close(depth(&small), 2.5 / 2.0);
    close(depth(&small.replace("\"front\"", "\"left\"")), 1.3);
    close(depth(&outline), depth(&plain));
    ledger.made(format!("deeper … {} m", number(depth(&plain), 1)));
    let test = |mass: &str, speed: &str| {
        let stiffness = format!(
            "{{ test = {{ mass = \"{mass}\", speed = \"{speed}\", width = \"1.5 m\", depths = \"0.5 0.5 m\", no_damage_speed = \"1 m/s\" }} }}"
        );
        usual(&damaged("", "", &stiffness))
    };
    close(test("60 t", "15 m/s")[1], mass[1]);
    let speeds = test("1500 kg", "50 m/s");
    ledger.made(format!("with … {} m/s … {} km/h", number(speeds[0], 0), number(speeds[1] * 3.6, 0)));
    let damage = |text: &str| usual(&with(text, "width = \"1.5 m\"", "width = \"9 m\""))[1];
    let more = damage(&outline) / width;
    close(damage(&outline.replace("\"front\"", "\"left\"")) / length, more);
    ledger.made(format!(
        "wider … {} % … {} m in … {} m",
        number(100.0 * (more - 1.0), 0),
        number(damage(&plain), 1),
        number(damage(&plain.replace("\"front\"", "\"left\"")), 0)
    ));
}

/// (mph) the no-damage speeds of CRASH3's categories, without and then with the rear of category 4: on the
/// width of a car of about that size, whose mass is usual for it, and on 2 m of its side.
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

/// (mph) the no-damage speed above which the program warns.
pub(super) fn high_no_damage_speed() -> f64 {
    threshold(20.0, 1.0, |speed| no_damage_speed_is_warned("high-no-damage-speed", speed)) / MILE_PER_HOUR
}

/// Whether there is a warning with this code for a no-damage speed (m/s).
fn no_damage_speed_is_warned(code: &str, speed: f64) -> bool {
    // b_0 = √(2 G w/m), so that G = b_0² m/2w
    let g = speed * speed * 1500.0 / 3.0;
    is_warned(code, &damaged("", "", &format!("{{ A = \"40 kN/m\", B = \"500 kN/m^2\", G = \"{g} N\" }}")))
}

fn stiffness(ledger: &mut Ledger) {
    ledger
        .cited("Fronts … 5 mph", "a rule of thumb, as the 5 to 10 km/h of those who evaluate barrier tests");
    ledger.made(format!("5 mph ({} km/h) … tests", number(5.0 * MILE_PER_HOUR * 3.6, 0)));
    let [least, most, rear] = no_damage_speeds().map(|speed| number(speed, 0));
    let limit = high_no_damage_speed();
    ledger.made(format!("categories … {least} … {most} mph … 4 … {rear}"));
    ledger.made(format!("{} mph … warning", number(limit, 0)));
    ledger.made(format!(
        "{} mph ({} m/s) … leaves … b_0 = √(2",
        number(limit, 0),
        number(limit * MILE_PER_HOUR, 1)
    ));
    ledger.made(format!("imply … {least} … {most} mph … 4 ({rear})"));
    let low = threshold(0.1, 1.0, |speed| no_damage_speed_is_warned("low-no-damage-speed", speed));
    ledger.made(format!(
        "{} mph ({} m/s) … leaves … b_0 = √(2",
        number(low / MILE_PER_HOUR, 0),
        number(low, 2)
    ));
    ledger.made(format!("categories … {least} … {most} mph"));
    ledger.cited("begin … A = 0", "what A means");
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
    ledger.made(format!("tangential … {} %", number(sliding, 0)));
    let moment = |e_m: f64| skid(-4.0, "{ ratio = 0.2 }", &format!("moment_restitution = {e_m}"));
    let beyond = threshold(0.9, 0.1, |e_m| is_warned("rotation-driven", &moment(e_m)));
    let [_, rotation] = shares(&moment(beyond));
    ledger.made(format!("below … {} %", number(rotation, 0)));
    ledger.cited("0 … whenever", "0 is a common yaw rate");
    ledger.cited("with 0 or less it happens", "0 is a common yaw rate");
    ledger.cited("Give 0 or less … leave", "0 is a common yaw rate");
    // The two staged collisions in which a ratio that was fitted to the test drives the sliding most.
    let mut staged: Vec<(f64, u8)> = [1, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]
        .map(|test| (shares(&page(&format!("fixtures/ricsac/{test:02}.toml")).text)[0], test))
        .to_vec();
    staged.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    let most = staged[0].0;
    let mut tests = [staged[0].1, staged[1].1];
    tests.sort_unstable();
    ledger.made(format!(
        "{} % … occurs … {}, {}) … {} %",
        number(-most, 1),
        tests[0],
        tests[1],
        number(-sliding, 0)
    ));
}
