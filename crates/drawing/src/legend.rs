//! The parts above and below a drawing: its title, the legend, the scale bar.

use kurbo::{BezPath, Point, Rect, Vec2};

use crate::canvas::{Canvas, Head};
use crate::font::{self, Anchor, LARGE, SMALL};
use crate::number::{count, number};
use crate::pens::{BLACK, GREY, Pen, THIN};
use crate::symbol::Symbol;
use crate::ticks;
use crate::vector::polyline;

/// (px) default width of a drawing.
pub(crate) const WIDTH: f64 = 960.0;
/// (px) margin of the page.
pub(crate) const EDGE: f64 = 24.0;
/// (px) from the top of the page to the picture below the title.
pub(crate) const HEADER: f64 = 66.0;
/// (px) line height of the legend.
const ROW: f64 = 24.0;
/// (px) width of a sample in the legend.
const SAMPLE: f64 = 40.0;

/// (px) line height of the title, and of the lines below it.
const LEADING: [f64; 2] = [22.0, 18.0];

/// A page of this width (px) with a title and the lines below it.
pub(crate) fn page(name: &'static str, width: f64, title: &str, below: &str) -> Canvas {
    let mut canvas = Canvas::new(name, width);
    header(&mut canvas, title, below);
    canvas
}

/// Draws the title and the lines below it. Lines that do not fit above the picture extend the page upwards.
pub(crate) fn header(canvas: &mut Canvas, title: &str, below: &str) {
    let most = canvas.width - 2.0 * EDGE;
    let below = below.lines().flat_map(|line| font::lines(line, SMALL, most)).map(|line| (line, SMALL, GREY));
    let lines: Vec<_> =
        font::lines(title, LARGE, most).into_iter().map(|line| (line, LARGE, BLACK)).chain(below).collect();
    // Each line has its room below it. There is always room for a title and one line.
    let room = |(_, size, _): &(String, f64, &'static str)| LEADING[usize::from(*size == SMALL)];
    let above = lines.iter().map(room).sum::<f64>() - LEADING.iter().sum::<f64>();
    canvas.above = above.max(0.0);
    let mut base = 30.0 - canvas.above;
    for line in &lines {
        let (words, size, colour) = line;
        canvas.text(Point::new(EDGE, base), words, *size, Anchor::Start, colour);
        base += room(line);
    }
}

/// The unit of a scale bar.
#[derive(Clone, Debug, PartialEq)]
pub struct ScaleUnit {
    /// Its printed name.
    pub name: String,
    /// Its size in SI units.
    pub size: f64,
}

/// A sample in the legend.
pub(crate) enum Sample {
    Arrow(Pen, Head),
    Line(Pen),
    /// A filled box with its edge.
    Box(Pen, String),
    CentreOfGravity,
    /// For an entry that is not drawn.
    Nothing,
    Dot(Option<Pen>, &'static str),
    /// As on a vehicle that faces to the right.
    Windscreen(Pen),
    Symbol(Symbol),
    Cross(Pen),
    /// As on a vehicle that faces to the right.
    Chevron(Pen),
}

/// The legend entry of a windscreen.
pub(crate) fn windscreen() -> (Sample, String) {
    (Sample::Windscreen(THIN), "windscreen: shows the front".to_owned())
}

/// Draws the legend in columns of equal width, from `top` downwards. Returns where it ends (px).
pub(crate) fn legend(canvas: &mut Canvas, top: f64, columns: usize, entries: &[(Sample, String)]) -> f64 {
    let columns = columns.max(1);
    let width = (canvas.width - 2.0 * EDGE) / count(columns);
    canvas.grid(Point::new(EDGE, top), Point::new(canvas.width - EDGE, top), THIN);
    for (i, (sample, text)) in entries.iter().enumerate() {
        let (column, row) = (count(i % columns), count(i / columns));
        let (x, y) = (EDGE + column * width, top + (row + 0.8) * ROW);
        let (from, to) = (Point::new(x, y), Point::new(x + SAMPLE, y));
        let middle = Point::new(x + SAMPLE / 2.0, y);
        match sample {
            Sample::Arrow(pen, head) => canvas.arrow("", from, to, *pen, *head),
            Sample::Line(pen) => canvas.line("", from, to, *pen),
            Sample::Box(pen, fill) => {
                canvas.rect("", Rect::from_center_size(middle, (SAMPLE - 6.0, 14.0)), Some(*pen), fill);
            }
            Sample::CentreOfGravity => canvas.centre_of_gravity("", middle),
            Sample::Nothing => {}
            Sample::Windscreen(pen) => {
                let mut path = BezPath::new();
                path.move_to((middle.x + 2.0, middle.y - 8.0));
                path.quad_to((middle.x + 7.0, middle.y), (middle.x + 2.0, middle.y + 8.0));
                path.line_to((middle.x - 7.0, middle.y + 6.5));
                path.quad_to((middle.x - 3.0, middle.y), (middle.x - 7.0, middle.y - 6.5));
                path.close_path();
                canvas.path("", &path, Some(*pen), "none");
            }
            Sample::Cross(pen) => canvas.path("", &cross(middle, 6.0), Some(*pen), "none"),
            Sample::Chevron(pen) => {
                let corners = [(-3.0, -7.0), (5.0, 0.0), (-3.0, 7.0)].map(|at| middle + Vec2::from(at));
                canvas.path("", &polyline(corners), Some(*pen), "none");
            }
            Sample::Symbol(symbol) => symbol.draw(canvas, "", middle),
            Sample::Dot(pen, fill) => canvas.dot("", middle, 5.0, *pen, fill),
        }
        let left = x + SAMPLE + 8.0;
        let most = width - SAMPLE - 16.0;
        canvas.text(Point::new(left, y + 4.5), &font::cut(text, SMALL, most), SMALL, Anchor::Start, BLACK);
    }
    top + ROW * (count(entries.len().div_ceil(columns)) + 0.5)
}

/// A cross: two strokes through a point, whose ends lie `reach` (px) across and down from it.
pub(crate) fn cross(at: Point, reach: f64) -> BezPath {
    let mut path = BezPath::new();
    for arm in [(1.0, 1.0), (1.0, -1.0)].map(|(x, y)| Vec2::new(x, y) * reach) {
        path.move_to(at - arm);
        path.line_to(at + arm);
    }
    path
}

/// A bar of round length in a unit, at `pixels` per unit of SI. Returns the point to the right of its text.
pub(crate) fn scale_bar(
    canvas: &mut Canvas,
    id: &str,
    at: Point,
    pixels: f64,
    ScaleUnit { name, size }: &ScaleUnit,
    what: &str,
) -> f64 {
    let pixels = pixels * size;
    let (length, decimals) = ticks::round(150.0 / pixels);
    let end = Point::new(at.x + length * pixels, at.y);
    let pen = Pen { colour: BLACK, width: 2.0, dashes: "" };
    canvas.scale(id, at, end, length * size, pen);
    let text = format!("{} {name}{what}", number(length, decimals));
    let left = end.x + 10.0;
    canvas.text(Point::new(left, at.y + 4.5), &text, SMALL, Anchor::Start, BLACK);
    left + font::width(&text, SMALL)
}
