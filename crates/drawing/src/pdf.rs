//! From SVG to PDF: one page, with paths as paths and letters as outlines. No date is in it, so that the
//! bytes are the same at every run.

use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{LineCapStyle, LineJoinStyle, PaintType, TilingType};
use pdf_writer::{Content, Filter, Finish as _, Name, Pdf, Rect, Ref, TextStr};
use resvg::tiny_skia::{Path as Outline, PathSegment, Transform};
use resvg::usvg::{
    Color, FillRule, Group, LineCap, LineJoin, Node, Paint, PaintOrder, Path, Pattern, Stroke, Tree,
};

use crate::raster::{self, RenderError};

/// (pt) of a pixel of CSS: 1/96 in.
const POINT: f32 = 0.75;
/// How hard to compress: the usual compromise.
const LEVEL: u8 = 6;

const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const CONTENT: Ref = Ref::new(4);
const INFO: Ref = Ref::new(5);
/// Of the first pattern; the others follow.
const PATTERN: Ref = Ref::new(6);

pub(crate) fn pdf(svg: &str, title: &str) -> Result<Vec<u8>, RenderError> {
    let tree = raster::tree(svg)?;
    Ok(document(&tree, title))
}

fn document(tree: &Tree, title: &str) -> Vec<u8> {
    let (width, height) = (tree.size().width() * POINT, tree.size().height() * POINT);
    // The y of a PDF runs upwards.
    let page_of_svg = Transform::from_row(POINT, 0.0, 0.0, -POINT, 0.0, height);
    let mut painter = Painter { content: Content::new(), patterns: Vec::new() };
    painter.content.transform(row(page_of_svg));
    painter.group(tree.root(), page_of_svg);
    let Painter { content, patterns } = painter;

    let mut pdf = Pdf::new();
    pdf.catalog(CATALOG).pages(PAGES).lang(TextStr("en"));
    pdf.pages(PAGES).kids([PAGE]).count(1);
    pdf.document_info(INFO).title(TextStr(title)).producer(TextStr("deltav"));
    let content = compress_to_vec_zlib(&content.finish(), LEVEL);
    pdf.stream(CONTENT, &content).filter(Filter::FlateDecode);
    let mut names = Vec::new();
    for (reference, pattern) in (PATTERN.get()..).map(Ref::new).zip(&patterns) {
        let mut painter = Painter { content: Content::new(), patterns: Vec::new() };
        painter.group(pattern.of_svg.root(), Transform::identity());
        let tile = painter.content.finish();
        let size = pattern.of_svg.rect();
        let mut tiling = pdf.tiling_pattern(reference, &tile);
        tiling.paint_type(PaintType::Colored).tiling_type(TilingType::ConstantSpacing);
        tiling.bbox(Rect::new(0.0, 0.0, size.width(), size.height()));
        tiling.x_step(size.width()).y_step(size.height());
        tiling.matrix(row(pattern.page_of_tile));
        tiling.resources();
        names.push((pattern.name.as_str(), reference));
    }
    let mut page = pdf.page(PAGE);
    page.media_box(Rect::new(0.0, 0.0, width, height)).parent(PAGES).contents(CONTENT);
    let mut resources = page.resources();
    resources.patterns().pairs(names.iter().map(|(name, reference)| (Name(name.as_bytes()), *reference)));
    resources.finish();
    page.finish();
    pdf.finish()
}

/// A pattern where it is used: tiles are laid in the axes of the page.
struct Tiles<'a> {
    name: String,
    of_svg: &'a Pattern,
    page_of_tile: Transform,
}

struct Painter<'a> {
    content: Content,
    patterns: Vec<Tiles<'a>>,
}

impl<'a> Painter<'a> {
    /// `page_of_here` takes the coordinates around the group to those of the page.
    fn group(&mut self, group: &'a Group, page_of_here: Transform) {
        let inner = page_of_here.pre_concat(group.transform());
        self.content.save_state().transform(row(group.transform()));
        for node in group.children() {
            match node {
                Node::Group(group) => self.group(group, inner),
                Node::Path(path) => self.path(path, inner),
                Node::Text(text) => self.group(text.flattened(), inner),
                // No drawing has one.
                Node::Image(_) => {}
            }
        }
        self.content.restore_state();
    }

    fn path(&mut self, path: &'a Path, page_of_here: Transform) {
        if !path.is_visible() {
            return;
        }
        match path.paint_order() {
            PaintOrder::FillAndStroke => {
                self.fill(path, page_of_here);
                self.stroke(path);
            }
            PaintOrder::StrokeAndFill => {
                self.stroke(path);
                self.fill(path, page_of_here);
            }
        }
    }

    fn fill(&mut self, path: &'a Path, page_of_here: Transform) {
        let Some(fill) = path.fill() else { return };
        match fill.paint() {
            Paint::Color(color) => {
                let [red, green, blue] = rgb(*color);
                self.content.set_fill_rgb(red, green, blue);
            }
            Paint::Pattern(pattern) => {
                let page_of_tile = page_of_here
                    .pre_concat(pattern.transform())
                    .pre_translate(pattern.rect().x(), pattern.rect().y());
                let name = format!("P{}", self.patterns.len());
                self.content.set_fill_color_space(pdf_writer::types::ColorSpaceOperand::Pattern);
                self.content.set_fill_pattern(None, Name(name.as_bytes()));
                self.patterns.push(Tiles { name, of_svg: pattern, page_of_tile });
            }
            // No drawing has one.
            Paint::LinearGradient(_) | Paint::RadialGradient(_) => return,
        }
        self.outline(path.data());
        match fill.rule() {
            FillRule::NonZero => self.content.fill_nonzero(),
            FillRule::EvenOdd => self.content.fill_even_odd(),
        };
    }

    fn stroke(&mut self, path: &Path) {
        let Some(stroke) = path.stroke() else { return };
        let Paint::Color(color) = stroke.paint() else { return };
        let [red, green, blue] = rgb(*color);
        self.content.set_stroke_rgb(red, green, blue);
        self.pen(stroke);
        self.outline(path.data());
        self.content.stroke();
    }

    fn pen(&mut self, stroke: &Stroke) {
        self.content
            .set_line_width(stroke.width().get())
            .set_miter_limit(stroke.miterlimit().get())
            .set_line_cap(match stroke.linecap() {
                LineCap::Butt => LineCapStyle::ButtCap,
                LineCap::Round => LineCapStyle::RoundCap,
                LineCap::Square => LineCapStyle::ProjectingSquareCap,
            })
            .set_line_join(match stroke.linejoin() {
                LineJoin::Miter | LineJoin::MiterClip => LineJoinStyle::MiterJoin,
                LineJoin::Round => LineJoinStyle::RoundJoin,
                LineJoin::Bevel => LineJoinStyle::BevelJoin,
            })
            .set_dash_pattern(stroke.dasharray().unwrap_or_default().iter().copied(), stroke.dashoffset());
    }

    fn outline(&mut self, path: &Outline) {
        let mut here = (0.0, 0.0);
        for segment in path.segments() {
            match segment {
                PathSegment::MoveTo(to) => {
                    self.content.move_to(to.x, to.y);
                    here = (to.x, to.y);
                }
                PathSegment::LineTo(to) => {
                    self.content.line_to(to.x, to.y);
                    here = (to.x, to.y);
                }
                PathSegment::QuadTo(by, to) => {
                    // A cubic curve has its points two thirds of the way to that of the quadratic one.
                    let third = |from: f32, by: f32| from + (by - from) * (2.0 / 3.0);
                    self.content.cubic_to(
                        third(here.0, by.x),
                        third(here.1, by.y),
                        third(to.x, by.x),
                        third(to.y, by.y),
                        to.x,
                        to.y,
                    );
                    here = (to.x, to.y);
                }
                PathSegment::CubicTo(first, second, to) => {
                    self.content.cubic_to(first.x, first.y, second.x, second.y, to.x, to.y);
                    here = (to.x, to.y);
                }
                PathSegment::Close => {
                    self.content.close_path();
                }
            }
        }
    }
}

/// In six decimals: the sine of a pattern's angle may differ in its last bit from machine to machine.
fn row(transform: Transform) -> [f32; 6] {
    let Transform { sx, kx, ky, sy, tx, ty } = transform;
    #[expect(clippy::cast_possible_truncation, reason = "a number of the page, which was one of f32")]
    let rounded = |number: f32| ((f64::from(number) * 1e6).round() / 1e6) as f32;
    [sx, ky, kx, sy, tx, ty].map(rounded)
}

/// 0 to 1.
fn rgb(Color { red, green, blue }: Color) -> [f32; 3] {
    [red, green, blue].map(|part| f32::from(part) / 255.0)
}
