//! Histograms and tornados of an uncertainty.

use ::drawing::{Axis, Drawing, HistogramPicture, TornadoBar, TornadoPicture, ValueMark};
use ::uncertainty::{Bar, Classes, End, Histogram};
use analysis::{UncertainInput, UncertainOutput, Uncertainty};
use case::{Case, Origin};

use super::title;
use crate::outputs::{input_name, label, pictured};
use crate::units::{Units, grouped, number, significant};

/// Maximum number of bars of a tornado, the longest.
const BARS: usize = 20;
const NO_ANSWER: &str = "no answer at an end";

/// An output and its name.
fn output(uncertainty: &Uncertainty, place: usize, units: Units) -> Option<(&UncertainOutput, String)> {
    let output = uncertainty.outputs.get(place)?;
    Some((output, label(output.output, pictured(output.output), units)))
}

/// The second line of a subtitle: the data that reproduce the numbers of the plot.
fn origin(case: &Case, uncertainty: &Uncertainty) -> String {
    let settings = &uncertainty.settings;
    format!(
        "{}. deltav {}, method {}, {} samples, seed {}",
        title(case),
        env!("CARGO_PKG_VERSION"),
        settings.method.name(),
        grouped(uncertainty.propagation.evaluated()),
        settings.seed
    )
}

/// The middle 99 % of the samples of an output, with its 95 % interval and its central value. `None` if the
/// samples do not differ, or if there is no such output.
#[must_use]
pub fn histogram(case: &Case, uncertainty: &Uncertainty, place: usize, units: Units) -> Option<Drawing> {
    Some(histogram_picture(case, uncertainty, place, units)?.draw())
}

/// The same before it is drawn.
pub(crate) fn histogram_picture(
    case: &Case,
    uncertainty: &Uncertainty,
    place: usize,
    units: Units,
) -> Option<HistogramPicture> {
    let (output, name) = output(uncertainty, place, units)?;
    let summary = uncertainty.propagation.summaries().get(place).copied().flatten()?;
    if !output.varies(summary.sd.value) {
        return None;
    }
    let Histogram { low, width, counts, .. } = uncertainty.propagation.histogram(place, Classes::Fine)?;
    let quantity = pictured(output.output);
    #[expect(clippy::cast_precision_loss, reason = "a share to draw")]
    let shares: Vec<f64> =
        counts.iter().map(|&count| 100.0 * count as f64 / summary.samples as f64).collect();
    let samples = format!("the middle 99 % of {} samples", grouped(summary.samples));
    let most = shares.iter().copied().fold(0.0, f64::max);
    let mark = |value: f64, lead: &str| ValueMark { value, lead: lead.to_owned() };
    let [_, _, ninety_five, _] = summary.intervals;
    Some(HistogramPicture {
        subtitle: format!("Histogram: {samples}\n{}", origin(case, uncertainty)),
        description: format!(
            "{name}: {samples}, in {} classes; the fullest has {} % of the samples. Ends of the 95 % interval \
             and central value:",
            Classes::Fine.count(),
            number(most, 1)
        ),
        across: Axis { title: name.clone(), unit: units.size(quantity) },
        title: name,
        decimals: units.decimals(quantity),
        upward: "% of the samples".to_owned(),
        low,
        width,
        shares,
        interval: [mark(ninety_five.low.value, "2.5 %:"), mark(ninety_five.high.value, "97.5 %:")],
        central: mark(output.central, "central:"),
        legend: ["samples, by class", "ends of the 95 % interval", "all inputs at central values"]
            .map(str::to_owned),
    })
}

/// The effect of each input alone on an output, from its 2.5 % to its 97.5 % quantile, the longest bars
/// first. `None` if there is no such output.
#[must_use]
pub fn tornado(case: &Case, uncertainty: &Uncertainty, place: usize, units: Units) -> Option<Drawing> {
    Some(tornado_picture(case, uncertainty, place, units)?.draw())
}

/// The same before it is drawn.
pub(crate) fn tornado_picture(
    case: &Case,
    uncertainty: &Uncertainty,
    place: usize,
    units: Units,
) -> Option<TornadoPicture> {
    let (output, name) = output(uncertainty, place, units)?;
    let value = |end: &End| {
        let outputs = end.outputs.as_ref().ok()?;
        outputs.get(place).copied()
    };
    let print = |end: f64| units.plain(pictured(output.output), end);
    let printed = print(output.central);
    let ranked = uncertainty.tornado.ranked(place);
    let bars: Vec<TornadoBar> = ranked
        .iter()
        .take(BARS)
        .map(|bar| {
            let ends = [value(&bar.low), value(&bar.high)];
            TornadoBar {
                name: input_with_range(&uncertainty.inputs[bar.input], bar),
                ends,
                labels: of_bar(ends, output.central, print),
                remark: ends.contains(&None).then(|| NO_ANSWER.to_owned()),
            }
        })
        .collect();
    // Bars for inputs that change no printed digit would show rounding as an effect.
    let changes = bars.iter().flat_map(|bar| bar.ends).flatten().filter(|end| print(*end) != printed);
    let longest = changes.map(|end| (end - output.central).abs()).fold(0.0, f64::max);
    let same = if longest == 0.0 { "; no input alone changes it as printed" } else { "" };
    let central_label = format!("central {printed}{same}");
    let end = |end: Option<f64>| end.map_or_else(|| "no answer".to_owned(), print);
    let words: Vec<String> = bars
        .iter()
        .map(|bar| format!("{} {} and {}", bar.name, end(bar.ends[0]), end(bar.ends[1])))
        .collect();
    let of_all = if ranked.len() > BARS {
        format!("; the {BARS} longest bars of {}", ranked.len())
    } else {
        String::new()
    };
    Some(TornadoPicture {
        subtitle: format!(
            "Tornado: what each input alone does, from its 2.5 % to its 97.5 % quantile{of_all}\n{}",
            origin(case, uncertainty)
        ),
        description: format!(
            "{name}: {central_label}. At the low and the high end of each input alone: {}.",
            words.join("; ")
        ),
        title: name,
        central: output.central,
        central_label,
        longest,
        bars,
        legend: ["input low (2.5 %)", "input high (97.5 %)"].map(str::to_owned),
    })
}

/// An input and its ends, in the unit of the file.
fn input_with_range(input: &UncertainInput, bar: &Bar) -> String {
    let [low, high] = [&bar.low, &bar.high].map(|end| significant(end.input, 4));
    let name = match input.input.origin {
        Origin::Given => input_in_words(&input.input.path),
        Origin::Shared(_) => input_name(&input.input),
        Origin::Estimate(_) if input.input.unit.is_some() => input_name(&input.input),
        Origin::Estimate(_) => return format!("{}: × {low} to {high}", input_name(&input.input)),
    };
    let unit = input.input.unit.map_or_else(String::new, |unit| format!(" {unit}"));
    format!("{name}: {low} to {high}{unit}")
}

/// Keys of the case file below a vehicle or a table, and their names for a reader who does not know the file.
/// Other keys are shown as they are spelled.
const WORDS: [(&str, &str); 13] = [
    ("yaw_radius", "radius of gyration"),
    ("contact.distance", "distance of the contact point"),
    ("contact.angle", "angle of the contact point"),
    ("contact.x", "contact point, forward"),
    ("contact.y", "contact point, sideways"),
    ("crush.width", "damage width"),
    ("crush.offset", "damage offset"),
    ("crush.pdof", "PDOF"),
    ("crush_plane", "crush plane"),
    ("tangential.ratio", "impulse ratio"),
    ("tangential.fraction", "fraction of the critical impulse ratio"),
    ("tangential.friction", "friction"),
    ("moment_restitution", "moment restitution"),
];

/// `vehicle1.crush.depths[2]` is the crush depth C2 of vehicle 1.
fn input_in_words(path: &str) -> String {
    let (table, key) = path.split_once('.').unwrap_or(("", path));
    let of = table.strip_prefix("vehicle").map_or_else(String::new, |number| format!(", vehicle {number}"));
    let station = |lead: &str, letter: &str| {
        let number = key.strip_prefix(lead)?.strip_prefix('[')?.strip_suffix(']')?;
        Some(format!("{letter}{number}"))
    };
    let name = if let Some(depth) = station("crush.depths", "C") {
        format!("crush depth {depth}")
    } else if let Some(width) = station("crush.spacing", "w") {
        format!("width {width} between stations")
    } else if let Some((_, words)) = WORDS.iter().find(|(known, _)| *known == key) {
        (*words).to_owned()
    } else {
        let key = key.strip_prefix("crush.").unwrap_or(key);
        key.replace(['_', '.'], " ")
    };
    format!("{name}{of}")
}

/// The labels of a bar of a tornado, each with its end of the bar. Two ends that are printed alike share one
/// label, as do two ends on one side, where the shorter part of the bar lies on the longer one.
fn of_bar(ends: [Option<f64>; 2], central: f64, print: impl Fn(f64) -> String) -> Vec<(f64, String)> {
    if let [Some(low), Some(high)] = ends {
        let longer = if (low - central).abs() > (high - central).abs() { low } else { high };
        let [one, other] = [low, high].map(&print);
        if one == other {
            return vec![(longer, other)];
        }
        if (low < central) == (high < central) {
            return vec![(longer, format!("low {one}, high {other}"))];
        }
    }
    ends.into_iter().flatten().map(|end| (end, print(end))).collect()
}

#[cfg(test)]
mod tests {
    use super::{input_in_words, of_bar};

    #[test]
    fn inputs_have_names_that_a_reader_knows() {
        for (path, name) in [
            ("vehicle1.crush.depths[2]", "crush depth C2, vehicle 1"),
            ("vehicle2.crush.spacing[1]", "width w1 between stations, vehicle 2"),
            ("vehicle2.contact.angle", "angle of the contact point, vehicle 2"),
            ("vehicle1.crush.stiffness.A", "stiffness A, vehicle 1"),
            ("vehicle1.crush.stiffness.test.no_damage_speed", "stiffness test no damage speed, vehicle 1"),
            ("vehicle2.yaw_inertia", "yaw inertia, vehicle 2"),
            ("impact.crush_plane", "crush plane"),
            ("impact.restitution", "restitution"),
        ] {
            assert_eq!(input_in_words(path), name);
        }
    }

    #[test]
    fn a_bar_prints_no_value_twice() {
        let print = |value: f64| format!("{value:.1}");
        let labels = |low, high| of_bar([low, high], 10.0, print);
        let one = |end: f64, text: &str| vec![(end, text.to_owned())];
        assert_eq!(labels(Some(10.0), Some(10.0)), one(10.0, "10.0"));
        assert_eq!(labels(Some(9.99), Some(10.01)), one(10.01, "10.0"));
        assert_eq!(labels(Some(12.01), Some(12.0)), one(12.01, "12.0"));
        assert_eq!(labels(Some(11.0), Some(13.0)), one(13.0, "low 11.0, high 13.0"));
        assert_eq!(labels(Some(7.0), Some(8.0)), one(7.0, "low 7.0, high 8.0"));
        assert_eq!(labels(Some(12.0), Some(9.0)), [(12.0, "12.0".to_owned()), (9.0, "9.0".to_owned())]);
        assert_eq!(labels(None, Some(9.0)), one(9.0, "9.0"));
        assert!(labels(None, None).is_empty());
    }
}
