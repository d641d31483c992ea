//! Histograms and tornados as SVG.

use ::uncertainty::{Bar, End};
use analysis::{UncertainOutput, Uncertainty};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::{Histogram, pictured};
use crate::sensitivity::output_name;
use crate::staged::PlotError;
use crate::units::{Units, number};

/// Okabe & Ito's blue and orange, which stay apart in grey and for the colour-blind.
const BLUE: RGBColor = RGBColor(0, 114, 178);
const ORANGE: RGBColor = RGBColor(230, 159, 0);
const INK: RGBColor = RGBColor(40, 40, 40);
const FONT: &str = "sans-serif";
const CLASSES: u32 = 40;
const MOST_TICKS: usize = 10;
/// Decimals beyond which no figure goes.
const MOST_DECIMALS: usize = 12;
/// Bars of a tornado, the longest.
const BARS: usize = 20;

type Canvas<'a> = DrawingArea<SVGBackend<'a>, Shift>;

fn failed(error: impl std::fmt::Display) -> PlotError {
    PlotError::new(error)
}

fn text(size: i32, horizontal: HPos) -> TextStyle<'static> {
    TextStyle::from((FONT, size).into_font()).color(&INK).pos(Pos::new(horizontal, VPos::Center))
}

/// An output and what to call it.
fn output(
    uncertainty: &Uncertainty,
    place: usize,
    units: Units,
) -> Result<(&UncertainOutput, String), PlotError> {
    let output = uncertainty.outputs.get(place).ok_or_else(|| failed("there is no such output"))?;
    Ok((output, format!("{}, {}", output_name(output.output), units.name(pictured(output.output)))))
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
    let value = |si: f64| units.value(pictured(output.output), si);
    #[expect(clippy::cast_precision_loss, reason = "a share to draw")]
    let share = |count: usize| 100.0 * count as f64 / summary.samples as f64;
    let most = histogram.counts.iter().copied().max().unwrap_or_default();
    let high = histogram.low + f64::from(CLASSES) * histogram.width;

    let decimals = tick_decimals(value(high) - value(histogram.low));
    // No coarser than the ticks below it.
    let figure = |si: f64| number(value(si), decimals.max(units.decimals(pictured(output.output))));
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
            .build_cartesian_2d(value(histogram.low)..value(high), 0.0..share(most) * 1.1)
            .map_err(failed)?;
        let across = format!("{name}: the middle 99 % of {} samples", summary.samples);
        chart
            .configure_mesh()
            .disable_mesh()
            .axis_style(INK)
            .label_style(text(12, HPos::Left))
            .axis_desc_style(text(13, HPos::Left))
            .x_labels(MOST_TICKS)
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
        let top = share(most) * 1.08;
        let marks = [
            (ninety_five.low.value, "2.5 %:"),
            (output.central, "central:"),
            (ninety_five.high.value, "97.5 %:"),
        ];
        for (si, words) in marks {
            let from = chart.backend_coord(&(value(si), 0.0));
            let to = chart.backend_coord(&(value(si), top));
            root.draw(&PathElement::new(vec![from, to], INK.stroke_width(1))).map_err(failed)?;
            let label = format!("{words} {}", figure(si));
            root.draw(&Text::new(label, (to.0 + 4, to.1 + 6), text(12, HPos::Left))).map_err(failed)?;
        }
        root.present().map_err(failed)?;
    }
    Ok(Some(svg))
}

/// The decimals of 1, 2 or 5 times a power of ten of which no more than [`MOST_TICKS`] go into a width.
fn tick_decimals(width: f64) -> usize {
    let mut step = width / f64::from(u32::try_from(MOST_TICKS).unwrap_or(u32::MAX));
    let mut decimals = 0;
    while step < 1.0 && decimals < MOST_DECIMALS {
        step *= 10.0;
        decimals += 1;
    }
    decimals
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
    let longest = ends.map(|end| (end - output.central).abs()).fold(0.0, f64::max);

    let rows = u32::try_from(bars.len()).unwrap_or_default();
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (820, 90 + 22 * rows)).into_drawing_area();
        root.fill(&WHITE).map_err(failed)?;
        root.draw(&Text::new(name, (20, 22), text(16, HPos::Left))).map_err(failed)?;
        legend(&root)?;
        // (px) the middle of the bars, and how far they reach.
        let (middle, reach) = (540_i32, 180.0);
        let across = |si: f64| {
            let share = if longest > 0.0 { (si - output.central) / longest } else { 0.0 };
            #[expect(clippy::cast_possible_truncation, reason = "pixels of a small drawing")]
            let pixels = (share * reach).round() as i32;
            middle + pixels
        };
        for (row, bar) in (0_i32..).zip(&bars) {
            let y = 66 + 22 * row;
            let path = uncertainty.inputs[bar.input].input.path.clone();
            root.draw(&Text::new(path, (280, y), text(12, HPos::Right))).map_err(failed)?;
            let mut drawn = [(&bar.low, ORANGE), (&bar.high, BLUE)].map(|(end, colour)| (value(end), colour));
            // The longer first, so that it does not hide the shorter where both are on one side.
            let length = |end: Option<f64>| end.map_or(0.0, |end| (end - output.central).abs());
            drawn.sort_by(|(one, _), (other, _)| length(*other).total_cmp(&length(*one)));
            for (end, colour) in drawn {
                let Some(end) = end else { continue };
                let (from, to) = (across(end).min(middle), across(end).max(middle));
                root.draw(&Rectangle::new([(from, y - 7), (to, y + 7)], colour.filled())).map_err(failed)?;
                let (at, side) =
                    if end < output.central { (from - 5, HPos::Right) } else { (to + 5, HPos::Left) };
                let label = units.plain(pictured(output.output), end);
                root.draw(&Text::new(label, (at, y), text(11, side))).map_err(failed)?;
            }
            if value(&bar.low).is_none() || value(&bar.high).is_none() {
                root.draw(&Text::new("no answer at an end", (middle + 190, y), text(11, HPos::Left)))
                    .map_err(failed)?;
            }
        }
        let bottom = 60 + 22 * i32::try_from(rows).unwrap_or_default();
        root.draw(&PathElement::new(vec![(middle, 52), (middle, bottom)], INK.stroke_width(1)))
            .map_err(failed)?;
        let central = format!("central {}", units.plain(pictured(output.output), output.central));
        root.draw(&Text::new(central, (middle, bottom + 14), text(12, HPos::Center))).map_err(failed)?;
        root.present().map_err(failed)?;
    }
    Ok(svg)
}

fn legend(root: &Canvas<'_>) -> Result<(), PlotError> {
    for (x, colour, words) in [(520, ORANGE, "input low (2.5 %)"), (660, BLUE, "input high (97.5 %)")] {
        root.draw(&Rectangle::new([(x, 16), (x + 14, 28)], colour.filled())).map_err(failed)?;
        root.draw(&Text::new(words, (x + 20, 22), text(12, HPos::Left))).map_err(failed)?;
    }
    Ok(())
}
