//! Histograms and tornados as SVG.

use ::uncertainty::{Bar, End};
use analysis::{UncertainOutput, Uncertainty};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::Histogram;
use super::marks::{self, Mark};
use crate::drawing::{font, ticks};
use crate::sections::output_name;
use crate::staged::PlotError;
use crate::units::{Units, number};

/// Okabe & Ito's blue and orange, which stay apart in grey and for the colour-blind.
const BLUE: RGBColor = RGBColor(0, 114, 178);
const ORANGE: RGBColor = RGBColor(230, 159, 0);
const INK: RGBColor = RGBColor(40, 40, 40);
const FONT: &str = "sans-serif";
const CLASSES: u32 = 40;
/// How high the plot is over its highest bar: the labels of the lines stand above all bars.
const HEADROOM: f64 = 1.25;
/// (px) height of a row of labels.
const ROW: i32 = 15;
const MOST_TICKS: u8 = 10;
/// Bars of a tornado, the longest.
const BARS: usize = 20;
/// (px) how far the longest bar of a tornado reaches.
const REACH: i32 = 180;
/// (px) white edge of a tornado, and the room of its legend.
const EDGE: i32 = 20;
const LEGEND: i32 = 300;
/// (px) from a bar to its label.
const BESIDE: i32 = 5;
const NO_ANSWER: &str = "no answer at an end";

type Canvas<'a> = DrawingArea<SVGBackend<'a>, Shift>;

fn failed(error: impl std::fmt::Display) -> PlotError {
    PlotError::new(error)
}

fn text(size: i32, horizontal: HPos) -> TextStyle<'static> {
    TextStyle::from((FONT, size).into_font()).color(&INK).pos(Pos::new(horizontal, VPos::Center))
}

/// (px) of a text in letters of a size that [`text`] is given. What is drawn are letters of 1/1.24 of this size.
fn width(words: &str, size: i32) -> i32 {
    #[expect(clippy::cast_possible_truncation, reason = "pixels of a small drawing")]
    let pixels = font::width(words, f64::from(size) / 1.24).ceil() as i32;
    pixels
}

/// An output and what to call it.
fn output(
    uncertainty: &Uncertainty,
    place: usize,
    units: Units,
) -> Result<(&UncertainOutput, String), PlotError> {
    let output = uncertainty.outputs.get(place).ok_or_else(|| failed("there is no such output"))?;
    Ok((output, format!("{}, {}", output_name(output.output), units.name(super::pictured(output.output)))))
}

/// The middle 99 % of the samples of an output, with its 95 % interval and its central value, as SVG. `None` where the samples do not differ.
///
/// # Errors
/// Where the drawing fails, which no uncertainty causes.
pub fn histogram(uncertainty: &Uncertainty, place: usize, units: Units) -> Result<Option<String>, PlotError> {
    let (output, name) = output(uncertainty, place, units)?;
    let summary = uncertainty.propagation.summaries().get(place).copied().flatten();
    let column = uncertainty.propagation.columns().get(place);
    let Some((summary, column)) = summary.zip(column) else { return Ok(None) };
    if !output.varies(summary.sd.value) {
        return Ok(None);
    }
    let Some(histogram) = Histogram::new(column, &summary, CLASSES) else { return Ok(None) };
    let value = |si: f64| units.value(super::pictured(output.output), si);
    #[expect(clippy::cast_precision_loss, reason = "a share to draw")]
    let share = |count: usize| 100.0 * count as f64 / summary.samples as f64;
    let most = histogram.counts.iter().copied().max().unwrap_or_default();
    let high = histogram.low + f64::from(CLASSES) * histogram.width;
    // Where the answer is no straight line of the inputs, the central value may lie beyond nearly all samples.
    let ends = [histogram.low.min(output.central), high.max(output.central)].map(value);

    let (_, decimals) = ticks::round((ends[1] - ends[0]) / f64::from(MOST_TICKS));
    // No coarser than the ticks below it.
    let figure = |si: f64| number(value(si), decimals.max(units.decimals(super::pictured(output.output))));
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (720, 420)).into_drawing_area();
        root.fill(&WHITE).map_err(failed)?;
        let mut chart = ChartBuilder::on(&root)
            .caption(&name, text(16, HPos::Left))
            .margin(14)
            .margin_right(24)
            .x_label_area_size(46)
            .y_label_area_size(56)
            .build_cartesian_2d(ends[0]..ends[1], 0.0..share(most) * HEADROOM)
            .map_err(failed)?;
        let across = format!("{name}: the middle 99 % of {} samples", summary.samples);
        chart
            .configure_mesh()
            .disable_mesh()
            .axis_style(INK)
            .label_style(text(12, HPos::Left))
            .axis_desc_style(text(13, HPos::Left))
            .x_labels(usize::from(MOST_TICKS))
            .x_label_formatter(&|tick| number(*tick, decimals))
            .x_desc(across)
            .y_desc("% of the samples")
            .draw()
            .map_err(failed)?;
        let bars = (0_u32..).zip(&histogram.counts).map(|(class, &count)| {
            let low = histogram.low + f64::from(class) * histogram.width;
            Rectangle::new(
                [(value(low), 0.0), (value(low + histogram.width), share(count))],
                BLUE.mix(0.7).filled(),
            )
        });
        chart.draw_series(bars).map_err(failed)?;
        let [_, _, ninety_five, _] = summary.intervals;
        let lines = [
            (ninety_five.low.value, "2.5 %:"),
            (output.central, "central:"),
            (ninety_five.high.value, "97.5 %:"),
        ]
        .map(|(si, words)| {
            let label = format!("{words} {}", figure(si));
            (chart.backend_coord(&(value(si), 0.0)), label)
        });
        let (left, top) = chart.backend_coord(&(ends[0], share(most) * HEADROOM));
        let (right, _) = chart.backend_coord(&(ends[1], 0.0));
        let marks = [0, 1, 2].map(|i| Mark { x: lines[i].0.0, width: width(&lines[i].1, 12) });
        for ((from, label), place) in lines.into_iter().zip(marks::place(marks, left + 2, right)) {
            let y = top + ROW / 2 + ROW * i32::try_from(place.row).unwrap_or_default();
            let line = vec![from, (from.0, y - ROW / 2)];
            root.draw(&PathElement::new(line, INK.stroke_width(1))).map_err(failed)?;
            root.draw(&Text::new(label, (place.left, y), text(12, HPos::Left))).map_err(failed)?;
        }
        root.present().map_err(failed)?;
    }
    Ok(Some(svg))
}

/// What each input alone does to an output, from its 2.5 % to its 97.5 % quantile, the longest bars first, as SVG.
///
/// # Errors
/// Where the drawing fails, which no uncertainty causes.
pub fn tornado(uncertainty: &Uncertainty, place: usize, units: Units) -> Result<String, PlotError> {
    let (output, name) = output(uncertainty, place, units)?;
    let value = |end: &End| {
        let outputs = end.outputs.as_ref().ok()?;
        outputs.get(place).copied()
    };
    let bars: Vec<&Bar> = uncertainty.tornado.ranked(place).into_iter().take(BARS).collect();
    let ends = bars.iter().flat_map(|bar| [value(&bar.low), value(&bar.high)]).flatten();
    let print = |end: f64| units.plain(super::pictured(output.output), end);
    // Bars for what changes no digit would show rounding as if it were an effect.
    let printed = print(output.central);
    let ends: Vec<f64> = ends.filter(|end| print(*end) != printed).collect();
    let longest = ends.iter().map(|end| (end - output.central).abs()).fold(0.0, f64::max);
    let labels: Vec<Vec<(f64, String)>> = bars
        .iter()
        .map(|bar| marks::of_bar([value(&bar.low), value(&bar.high)], output.central, print))
        .collect();
    let fails = |bar: &Bar| value(&bar.low).is_none() || value(&bar.high).is_none();
    // (px) the columns: names, labels to the left, bars, labels to the right, remarks.
    let names = bars.iter().map(|bar| width(path(uncertainty, bar), 12)).max().unwrap_or_default();
    let beside = labels.iter().flatten().map(|(_, label)| width(label, 11)).max().unwrap_or_default();
    let middle = EDGE + names + 2 * BESIDE + beside + REACH;
    let remarks = middle + REACH + beside + 3 * BESIDE;
    let remark = if bars.iter().any(|bar| fails(bar)) { width(NO_ANSWER, 11) } else { 0 };
    let wide = (remarks + remark + EDGE).max(2 * EDGE + width(&name, 16) + LEGEND);

    let rows = u32::try_from(bars.len()).unwrap_or_default();
    let mut svg = String::new();
    {
        let page = (u32::try_from(wide).unwrap_or_default(), 90 + 22 * rows);
        let root = SVGBackend::with_string(&mut svg, page).into_drawing_area();
        root.fill(&WHITE).map_err(failed)?;
        root.draw(&Text::new(name, (EDGE, 22), text(16, HPos::Left))).map_err(failed)?;
        legend(&root, wide - LEGEND)?;
        let across = |si: f64| {
            let share = if longest > 0.0 { (si - output.central) / longest } else { 0.0 };
            #[expect(clippy::cast_possible_truncation, reason = "pixels of a small drawing")]
            let pixels = (share * f64::from(REACH)).round() as i32;
            middle + pixels
        };
        for (row, (bar, labels)) in (0_i32..).zip(bars.iter().zip(labels)) {
            let y = 66 + 22 * row;
            let name = path(uncertainty, bar).to_owned();
            root.draw(&Text::new(name, (EDGE + names, y), text(12, HPos::Right))).map_err(failed)?;
            let mut drawn = [(&bar.low, ORANGE), (&bar.high, BLUE)].map(|(end, colour)| (value(end), colour));
            // The longer first, so that it does not hide the shorter where both are on one side.
            let length = |end: Option<f64>| end.map_or(0.0, |end| (end - output.central).abs());
            drawn.sort_by(|(one, _), (other, _)| length(*other).total_cmp(&length(*one)));
            for (end, colour) in drawn {
                let Some(end) = end else { continue };
                let (from, to) = (across(end).min(middle), across(end).max(middle));
                root.draw(&Rectangle::new([(from, y - 7), (to, y + 7)], colour.filled())).map_err(failed)?;
            }
            for (end, label) in labels {
                let is_left = end < output.central;
                let (side, away) = if is_left { (HPos::Right, -BESIDE) } else { (HPos::Left, BESIDE) };
                root.draw(&Text::new(label, (across(end) + away, y), text(11, side))).map_err(failed)?;
            }
            if fails(bar) {
                root.draw(&Text::new(NO_ANSWER, (remarks, y), text(11, HPos::Left))).map_err(failed)?;
            }
        }
        let bottom = 60 + 22 * i32::try_from(rows).unwrap_or_default();
        root.draw(&PathElement::new(vec![(middle, 52), (middle, bottom)], INK.stroke_width(1)))
            .map_err(failed)?;
        let same = if ends.is_empty() { "; no input alone changes it as printed" } else { "" };
        let central = format!("central {printed}{same}");
        root.draw(&Text::new(central, (middle, bottom + 14), text(12, HPos::Center))).map_err(failed)?;
        root.present().map_err(failed)?;
    }
    Ok(svg)
}

/// The input of a bar.
fn path<'a>(uncertainty: &'a Uncertainty, bar: &Bar) -> &'a str {
    &uncertainty.inputs[bar.input].input.path
}

fn legend(root: &Canvas<'_>, left: i32) -> Result<(), PlotError> {
    for (x, colour, words) in [(left, ORANGE, "input low (2.5 %)"), (left + 140, BLUE, "input high (97.5 %)")]
    {
        root.draw(&Rectangle::new([(x, 16), (x + 14, 28)], colour.filled())).map_err(failed)?;
        root.draw(&Text::new(words, (x + 20, 22), text(12, HPos::Left))).map_err(failed)?;
    }
    Ok(())
}
