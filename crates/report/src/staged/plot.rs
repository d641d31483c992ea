//! Plots of computed against measured and of reconstructed against true, as SVG.

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use thiserror::Error;
use validation::{FOOT_PER_SECOND, Row, Validation};

use super::label::{Area, Wanted, place};

/// A plot could not be drawn.
#[derive(Debug, Error)]
#[error("the plot cannot be drawn: {0}")]
pub struct PlotError(String);

impl PlotError {
    pub(crate) fn new(error: impl std::fmt::Display) -> Self {
        Self(error.to_string())
    }
}

type Canvas<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// Shapes and colours that stay apart in grey and for the colour-blind (Okabe & Ito's palette).
#[derive(Clone, Copy)]
enum Marker {
    Circle,
    Square,
    Triangle,
    Diamond,
}

impl Marker {
    const ALL: [Self; 4] = [Self::Circle, Self::Square, Self::Triangle, Self::Diamond];

    fn colour(self) -> RGBColor {
        match self {
            Self::Circle => RGBColor(0, 114, 178),
            Self::Square => RGBColor(213, 94, 0),
            Self::Triangle => RGBColor(0, 158, 115),
            Self::Diamond => RGBColor(204, 121, 167),
        }
    }

    /// (px) corners around the middle.
    fn corners(self) -> &'static [(i32, i32)] {
        match self {
            Self::Circle => &[],
            Self::Square => &[(-4, -4), (4, -4), (4, 4), (-4, 4)],
            Self::Triangle => &[(0, -7), (6, 5), (-6, 5)],
            Self::Diamond => &[(0, -6), (6, 0), (0, 6), (-6, 0)],
        }
    }
}

/// A point of a plot, in the plot's units.
struct Point {
    at: (f64, f64),
    marker: Marker,
    filled: bool,
    label: Option<String>,
}

const INK: RGBColor = RGBColor(40, 40, 40);
const GREY: RGBColor = RGBColor(150, 150, 150);
const FONT: &str = "sans-serif";
/// (px) half the size of a marker with its outline.
const HALF_MARKER: i32 = 6;
/// (px) a label further from its point than this gets a line to it.
const NEAR: i32 = 16;

fn text(size: i32, horizontal: HPos) -> TextStyle<'static> {
    TextStyle::from((FONT, size).into_font()).color(&INK).pos(Pos::new(horizontal, VPos::Center))
}

fn failed(error: impl std::fmt::Display) -> PlotError {
    PlotError::new(error)
}

fn draw_marker(
    canvas: &Canvas<'_>,
    (x, y): (i32, i32),
    marker: Marker,
    filled: bool,
) -> Result<(), PlotError> {
    let colour = marker.colour();
    if marker.corners().is_empty() {
        let style = if filled { colour.filled() } else { colour.stroke_width(2) };
        return canvas.draw(&Circle::new((x, y), 5, style)).map_err(failed);
    }
    let mut corners: Vec<(i32, i32)> = marker.corners().iter().map(|(dx, dy)| (x + dx, y + dy)).collect();
    if filled {
        canvas.draw(&Polygon::new(corners.clone(), colour.filled())).map_err(failed)?;
    }
    // Round to the second corner, so that the first is mitred like the others. What is hollow hides nothing.
    corners.extend_from_within(0..2);
    canvas.draw(&PathElement::new(corners, colour.stroke_width(2))).map_err(failed)
}

/// Draws a square panel over `area` with axes from zero, the line of equality, the points and their labels.
fn panel(
    root: &Canvas<'_>,
    area: &Canvas<'_>,
    title: &str,
    [across, upward]: [&str; 2],
    end: f64,
    points: &[Point],
) -> Result<(), PlotError> {
    let mut chart: Chart<'_, '_> = ChartBuilder::on(area)
        .caption(title, text(15, HPos::Left))
        .margin(10)
        .margin_right(16)
        .x_label_area_size(42)
        .y_label_area_size(48)
        .build_cartesian_2d(0.0..end, 0.0..end)
        .map_err(failed)?;
    chart
        .configure_mesh()
        .disable_mesh()
        .axis_style(INK)
        .label_style(text(12, HPos::Left))
        .axis_desc_style(text(13, HPos::Left))
        .x_labels(8)
        .y_labels(8)
        .x_label_formatter(&|value| format!("{value:.0}"))
        .y_label_formatter(&|value| format!("{value:.0}"))
        .x_desc(across)
        .y_desc(upward)
        .draw()
        .map_err(failed)?;
    let pixel = |at: (f64, f64)| chart.backend_coord(&at);
    let equality = vec![pixel((0.0, 0.0)), pixel((end, end))];
    root.draw(&PathElement::new(equality, GREY.stroke_width(1))).map_err(failed)?;
    let mut obstacles: Vec<Area> =
        points.iter().map(|point| Area::around(pixel(point.at), HALF_MARKER, HALF_MARKER)).collect();
    // The line, as a chain of small boxes.
    obstacles.extend((0..=300).map(|i| {
        let along = end * f64::from(i) / 300.0;
        Area::around(pixel((along, along)), 1, 1)
    }));
    let labelled: Vec<(&Point, &String)> =
        points.iter().filter_map(|point| point.label.as_ref().map(|label| (point, label))).collect();
    let wanted: Vec<Wanted> = labelled
        .iter()
        .map(|(point, label)| {
            // (px) half of some 7 px a digit, and of 12 px of height.
            let digits = i32::try_from(label.chars().count()).unwrap_or(i32::MAX / 8);
            Wanted { point: pixel(point.at), half: (digits * 7 / 2 + 1, 6) }
        })
        .collect();
    let (left, bottom) = pixel((0.0, 0.0));
    let (right, top) = pixel((end, end));
    let middles = place(&wanted, &obstacles, Area { left, top, right, bottom });
    for ((point, _), &(x, y)) in labelled.iter().zip(&middles) {
        let (px, py) = pixel(point.at);
        if (x - px).abs().max((y - py).abs()) > NEAR {
            // Two thirds of the way, so that it stops before the label.
            let end = (px + (x - px) * 2 / 3, py + (y - py) * 2 / 3);
            root.draw(&PathElement::new(vec![(px, py), end], GREY.stroke_width(1))).map_err(failed)?;
        }
    }
    for point in points {
        draw_marker(root, pixel(point.at), point.marker, point.filled)?;
    }
    for ((_, label), &at) in labelled.iter().zip(&middles) {
        root.draw(&Text::new((*label).clone(), at, text(12, HPos::Center))).map_err(failed)?;
    }
    Ok(())
}

/// Where axes end that hold all points: the next five beyond the greatest number.
fn end(points: &[&[Point]]) -> f64 {
    let greatest =
        points.iter().copied().flatten().map(|point| point.at.0.max(point.at.1)).fold(0.0, f64::max);
    // Room for a label beyond the last point.
    (greatest * 1.04 / 5.0).ceil() * 5.0
}

fn legend(
    root: &Canvas<'_>,
    mut at: (i32, i32),
    entries: &[(Marker, bool, &str, i32)],
) -> Result<(), PlotError> {
    for &(marker, filled, words, width) in entries {
        draw_marker(root, at, marker, filled)?;
        root.draw(&Text::new(words.to_owned(), (at.0 + 12, at.1), text(13, HPos::Left))).map_err(failed)?;
        at.0 += width;
    }
    Ok(())
}

/// Computed against measured ΔV (ft/s) of all vehicles, PIM beside CRASH3, as SVG. The same bytes at every run.
///
/// # Errors
/// Where the drawing fails, which no comparison causes.
pub fn computed_against_measured(validation: &Validation) -> Result<String, PlotError> {
    // One marker for each geometry of Table 1, where each method has a row.
    let geometries: Vec<&validation::Table1Row> =
        validation.table1.iter().filter(|row| row.method == validation::Method::Pim).collect();
    let marker = |test: u8| {
        let place = geometries.iter().position(|row| row.tests.contains(&test)).unwrap_or_default();
        Marker::ALL[place % Marker::ALL.len()]
    };
    let points = |row: Row| -> Vec<Point> {
        validation
            .table2
            .iter()
            .filter(|line| line.row == row)
            .flat_map(|line| {
                [0, 1].map(|i| Point {
                    at: (line.measured[i] / FOOT_PER_SECOND, line.cells[i].ours / FOOT_PER_SECOND),
                    marker: marker(line.test),
                    filled: i == 0,
                    label: Some(line.test.to_string()),
                })
            })
            .collect()
    };
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (1240, 680)).into_drawing_area();
        root.fill(&WHITE).map_err(failed)?;
        let (panels, _) = root.split_vertically(620);
        let (left, right) = panels.split_horizontally(620);
        let axes = ["measured ΔV (ft/s)", "computed ΔV (ft/s)"];
        let (pim, crash3) = (points(Row::PimTotal), points(Row::CrashCorrected));
        let end = end(&[&pim, &crash3]);
        panel(&root, &left, "PIM, total ΔV", axes, end, &pim)?;
        panel(&root, &right, "CRASH3, corrected ΔV from the published profiles", axes, end, &crash3)?;
        let names: Vec<(Marker, bool, &str, i32)> = geometries
            .iter()
            .zip(Marker::ALL)
            .map(|(row, marker)| (marker, true, row.geometry.as_str(), 170))
            .collect();
        legend(&root, (60, 640), &names)?;
        let words =
            "Labels: test. Filled: vehicle 1; hollow: vehicle 2. Grey line: computed equals measured.";
        root.draw(&Text::new(words, (54, 666), text(13, HPos::Left))).map_err(failed)?;
        root.present().map_err(failed)?;
    }
    Ok(svg)
}

/// Reconstructed against true speed (m/s) of vehicle 1, by source of the crush energy, as SVG. The same bytes at every run.
///
/// # Errors
/// Where the drawing fails, which no comparison causes.
pub fn reconstructed_speed(validation: &Validation) -> Result<String, PlotError> {
    let of = |found: fn(&validation::Reconstruction) -> f64, marker: Marker, filled: bool, labelled: bool| {
        validation.reconstructions.iter().map(move |line| Point {
            at: (line.true_speed, found(line)),
            marker,
            filled,
            label: labelled.then(|| line.test.to_string()),
        })
    };
    let mut points: Vec<Point> = of(|line| line.round_trip.ours, Marker::Diamond, false, false).collect();
    points.extend(of(|line| line.found, Marker::Circle, true, true));
    points.extend(of(|line| line.found_implied, Marker::Triangle, false, true));
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (640, 700)).into_drawing_area();
        root.fill(&WHITE).map_err(failed)?;
        let (top, _) = root.split_vertically(620);
        let axes = ["true speed of vehicle 1 (m/s)", "reconstructed speed of vehicle 1 (m/s)"];
        panel(&root, &top, "Speed from crush energy", axes, end(&[&points]), &points)?;
        let entries = [
            (Marker::Circle, true, "published profiles", 160),
            (Marker::Triangle, false, "energy implied by the paper", 220),
            (Marker::Diamond, false, "energy of SAE 871993", 0),
        ];
        legend(&root, (60, 640), &entries)?;
        let words = "Labels: test. Grey line: found equals true; the diamonds lie on it.";
        root.draw(&Text::new(words, (54, 668), text(13, HPos::Left))).map_err(failed)?;
        root.present().map_err(failed)?;
    }
    Ok(svg)
}
