use std::collections::BTreeMap;
use std::fmt::Write as _;

use inputs::{Dimension, InvalidQuantity, Quantity, Unit, format_number};

use super::read_unit;
use super::spelling::WORDS;
use crate::quantity::{Limit, QuantityError, format_limit, read_quantity};

#[test]
fn no_spelling_means_two_units() {
    for dimension in Dimension::ALL {
        let mut rows: BTreeMap<String, &Unit> = BTreeMap::new();
        for unit in dimension.units() {
            for spelling in unit.spellings() {
                let normal = super::normalise(spelling, super::Pound::AsWritten);
                assert_eq!(read_unit(&normal, dimension), Some(unit), "{normal} is not found");
                if let Some(other) = rows.insert(normal, unit) {
                    assert_eq!(other, unit, "{spelling} means two units of {dimension}");
                }
                assert_eq!(read_unit(spelling, dimension), Some(unit), "{spelling} is not found");
            }
        }
    }
    let mut meanings = BTreeMap::new();
    for (short, long) in WORDS {
        for word in std::iter::once(short).chain(*long) {
            assert_eq!(meanings.insert(word, short), None, "{word} means two words");
        }
    }
}

#[test]
fn what_does_not_change_the_meaning_is_forgiven() {
    use Dimension::*;
    for (dimension, written, canonical) in [
        (Inertia, "lb·ft·s²", "lb ft s^2"),
        (Inertia, "ft-lb-s^2", "lb ft s^2"),
        (Inertia, "lbf*ft*sec^2", "lb ft s^2"),
        (Inertia, "slug-ft²", "slug ft^2"),
        (Inertia, "lb-ft²", "lb ft^2"),
        (Inertia, "lbm ft2", "lb ft^2"),
        (Inertia, "pound-inch^2", "lb in^2"),
        (Inertia, "kg m2", "kg m^2"),
        (Inertia, "kg·m²", "kg m^2"),
        (StiffnessB, "N/cm²", "N/cm^2"),
        (StiffnessB, "lbs / in2", "lb/in^2"),
        (StiffnessA, "pounds/inch", "lb/in"),
        (RootForce, "√lb", "lb^0.5"),
        (RootForce, "sqrt(lbf)", "lb^0.5"),
        (RootForce, "√(N)", "N^0.5"),
        (RootForce, "lb^(1/2)", "lb^0.5"),
        (RootForce, "lb^½", "lb^0.5"),
        (RootForcePerLength, "√lb/ft", "lb^0.5/ft"),
        (RootForcePerLength, "sqrt(lb)/in", "lb^0.5/in"),
        (Speed, "feet/second", "ft/s"),
        (Speed, "miles/hour", "mph"),
        (Angle, "°", "deg"),
        (YawRate, "°/s", "deg/s"),
    ] {
        let unit = read_unit(written, dimension).map(Unit::spelling);
        assert_eq!(unit, Some(canonical), "{written}");
    }
}

#[test]
fn capitals_are_forgiven_where_they_mean_the_same() {
    use Dimension::*;
    for (dimension, written, canonical) in [
        (Speed, "MPH", "mph"),
        (Speed, "Km/h", "km/h"),
        (Speed, "KM/H", "km/h"),
        (Length, "IN", "in"),
        (Length, "Feet", "ft"),
        (Length, "METERS", "m"),
        (Weight, "LB", "lb"),
        (Weight, "LBF", "lb"),
        (Weight, "KN", "kN"),
        (Inertia, "Lb-Ft-S^2", "lb ft s^2"),
        (StiffnessA, "LB/IN", "lb/in"),
        (StiffnessB, "PSI", "lb/in^2"),
        (RootForce, "LB^0.5", "lb^0.5"),
        (Mass, "Short Tons", "short ton"),
    ] {
        assert_eq!(read_unit(written, dimension).map(Unit::spelling), Some(canonical), "{written}");
    }
    // A short ton is 2000 lb (NIST SP 811, appendix B.8: 907.1847 kg).
    let tons = read_quantity("40 short tons", Mass).unwrap();
    assert!((tons.si() - 40.0 * 907.1847).abs() < 0.01, "{}", tons.si());
}

#[test]
fn what_changes_the_meaning_is_not() {
    use Dimension::*;
    for (dimension, written) in [
        (Mass, "lbf"),
        (Weight, "lbff"),
        // Mega or milli, if not a slip.
        (Length, "M"),
        (StiffnessB, "mN/m^2"),
        (Mass, "ton"),
        // A force, and no knots.
        (Speed, "kN"),
        (Speed, "ft s"),
        // Neither force times length squared nor mass times length times time squared is an inertia.
        (Inertia, "lbf ft^2"),
        (Inertia, "lbm ft s^2"),
        (Inertia, "lb ft"),
        (StiffnessA, "N/cm^2"),
        (StiffnessB, "N/cm"),
        (RootForce, "lb"),
        // A root of nothing.
        (RootForce, "N√()"),
        (RootForce, "lb sqrt( )"),
        (Weight, "kg"),
        (Length, ""),
    ] {
        assert_eq!(read_unit(written, dimension), None, "{written}");
    }
}

#[test]
fn the_nearest_unit_is_the_one_that_was_meant() {
    use super::nearest_unit;
    let nearest = |written, dimension| nearest_unit(written, dimension).map(Unit::spelling);
    assert_eq!(nearest("feets/s", Dimension::Speed), Some("ft/s"));
    assert_eq!(nearest("kmh", Dimension::Speed), Some("km/h"));
    assert_eq!(nearest("MPH", Dimension::Speed), Some("mph"));
    assert_eq!(nearest("lbft-s^2", Dimension::Inertia), Some("lb ft s^2"));
    assert_eq!(nearest("kg.m2", Dimension::Inertia), Some("kg m^2"));
    assert_eq!(nearest("KN/M", Dimension::StiffnessA), Some("kN/m"));
    // "m/h" is one slip from three units, and "Grad" is German for a degree.
    assert_eq!(nearest("m/h", Dimension::Speed), None);
    assert_eq!(nearest("Grad", Dimension::Angle), None);
}

/// A wrong suggestion of a near unit is off by a factor that nobody would notice.
#[test]
fn no_unit_of_another_size_is_proposed() {
    use super::nearest_unit;
    for (written, dimension) in [
        ("lb ft s", Dimension::Inertia),
        ("lbf ft^2", Dimension::Inertia),
        ("kg cm^2", Dimension::Inertia),
        ("MN/cm", Dimension::StiffnessA),
        ("N/cm^3", Dimension::StiffnessB),
        ("fpm", Dimension::Speed),
        ("km/s", Dimension::Speed),
        ("rps", Dimension::YawRate),
        ("deg/h", Dimension::YawRate),
        ("dm", Dimension::Length),
        ("mil", Dimension::Length),
        ("kip", Dimension::Weight),
        ("kips", Dimension::StiffnessG),
        ("ton", Dimension::Mass),
    ] {
        assert_eq!(read_unit(written, dimension), None, "{written}");
        assert_eq!(nearest_unit(written, dimension), None, "{written}");
    }
    // All spellings made from a unit by adding, removing or changing one letter or digit.
    for dimension in Dimension::ALL {
        for unit in dimension.units() {
            let letters: Vec<char> = unit.spelling().chars().collect();
            for place in (0..letters.len()).filter(|&place| letters[place].is_alphanumeric()) {
                for other in ('a'..='z').chain('1'..='9').map(Some).chain([None]) {
                    let mut slip = letters.clone();
                    slip.splice(place..=place, other);
                    let slip: String = slip.into_iter().collect();
                    let factor =
                        read_unit(&slip, dimension).or(nearest_unit(&slip, dimension)).map(Unit::factor);
                    let is_other = read_unit(&slip, dimension).is_some() || factor.is_none();
                    assert!(is_other || factor == Some(unit.factor()), "{slip} for {unit}: {factor:?}");
                }
            }
        }
    }
}

#[test]
fn numbers_are_read_as_they_are_written() {
    for (text, number) in [
        ("6.3 ft", 6.3),
        ("6.3ft", 6.3),
        ("  -6.3   ft ", -6.3),
        ("−6.3 ft", -6.3),
        ("+6.3 ft", 6.3),
        (".5 ft", 0.5),
        ("5. ft", 5.0),
        ("1e2 ft", 100.0),
        ("1.5E-1ft", 0.15),
    ] {
        let quantity =
            read_quantity(text, Dimension::Length).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(quantity.number(), number, "{text}");
    }
    for text in [
        "--6 ft", "-+6 ft", "+-6 ft", ". ft", "- ft", "e5 ft", "nan ft", "inf ft", "6 3 ft", "1_000 ft",
        "0x10 ft",
    ] {
        assert!(read_quantity(text, Dimension::Length).is_err(), "{text}");
    }
}

#[test]
fn the_bound_is_accepted_and_named_in_the_users_unit() {
    for dimension in Dimension::ALL {
        for unit in dimension.units() {
            let Err(error) = Quantity::new(1e30, unit) else { panic!("{unit} has no bound") };
            let help = QuantityError::from(error).help();
            let limit = help.split(" is ").nth(1).and_then(|rest| rest.split(';').next()).unwrap_or_default();
            let limit = read_quantity(limit, dimension)
                .unwrap_or_else(|error| panic!("the limit {limit} is refused: {error}"));
            let share = limit.si() / dimension.bound();
            assert!((0.999..=1.0 + 1e-12).contains(&share), "{limit}: {share} of the bound");
        }
    }
    for dimension in Dimension::ALL {
        for unit in dimension.units() {
            let limit = format_limit(dimension.least_positive(), unit, Limit::Least);
            let share = read_quantity(&limit, dimension).unwrap().si() / dimension.least_positive();
            assert!((1.0 - 1e-12..=1.001).contains(&share), "{limit}: {share} of the smallest");
        }
    }
    // 1000 m is 3280.84 ft, and 0.000 001 m is 0.000 003 280 84 ft (SP 811: 0.3048 m).
    let foot = Dimension::Length.unit("ft").unwrap();
    assert_eq!(format_limit(1e3, foot, Limit::Most), "3280 ft");
    assert_eq!(format_limit(1e-6, foot, Limit::Least), "3.281e-6 ft");
    let error = Quantity::new(f64::NAN, foot).unwrap_err();
    assert!(matches!(error, InvalidQuantity::NotFinite { .. }), "{error:?}");
}

/// The tables of the documentation, written from the tables of the program.
fn documentation() -> String {
    let ticked = |words: &mut dyn Iterator<Item = &str>| {
        words.map(|word| format!("`{word}`")).collect::<Vec<_>>().join(" ")
    };
    let mut text = String::from("| quantity | spellings | in SI |\n|---|---|---|\n");
    for dimension in Dimension::ALL {
        for unit in dimension.units() {
            let spellings = ticked(&mut unit.spellings());
            let factor = format_number(unit.factor());
            writeln!(text, "| {dimension} | {spellings} | {factor} {} |", dimension.si_unit()).unwrap();
        }
    }
    text.push_str("\nIn any unit, a word may replace its short form:\n\n| short | words |\n|---|---|\n");
    for (short, long) in WORDS {
        writeln!(text, "| `{short}` | {} |", ticked(&mut long.iter().copied())).unwrap();
    }
    text.push_str(
        "\nA value beyond these limits is refused; the smallest applies to values that must be positive:\n\n\
         | quantity | smallest | largest |\n|---|---|---|\n",
    );
    for dimension in Dimension::ALL {
        let [least, most] = [dimension.least_positive(), dimension.bound()].map(format_number);
        writeln!(text, "| {dimension} | {least} {unit} | {most} {unit} |", unit = dimension.si_unit())
            .unwrap();
    }
    text
}

#[test]
fn the_documentation_lists_these_units() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/units.md");
    let wanted = documentation();
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(path, &wanted).unwrap();
    }
    let written = std::fs::read_to_string(path).unwrap();
    assert!(written == wanted, "src/units.md differs from the table; UPDATE=1 writes it anew:\n{wanted}");
}
