//! From SVG to PDF: one page, with paths as paths and letters as outlines. It contains no date, so that the
//! bytes are the same in every run.

use std::borrow::Cow;

use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{LineCapStyle, LineJoinStyle, PaintType, TilingType};
use pdf_writer::{Content, Filter, Finish as _, Name, Pdf, Rect, Ref, TextStr};
use resvg::tiny_skia::{Path as Outline, PathSegment, Transform};
use resvg::usvg::{
    Color, FillRule, Group, LineCap, LineJoin, Node, Paint, PaintOrder, Path, Pattern, Stroke, Tree,
};

use crate::raster::{self, RenderError};
use crate::site_plan::{Backdrop, Encoding, OPACITY, SitePlan, SitePlanError};

/// (pt) size of a CSS pixel: 1/96 in.
const POINT: f32 = 0.75;
/// Compression level: the usual compromise.
const LEVEL: u8 = 6;

const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const CONTENT: Ref = Ref::new(4);
const INFO: Ref = Ref::new(5);
/// The first pattern; the others follow.
const PATTERN: Ref = Ref::new(6);
/// The site plan, and its opacity.
const SITE_PLAN: Name = Name(b"S");
const FADED: Name = Name(b"G");

/// The top of the page is at the given y (px).
pub(crate) fn pdf(
    svg: &str,
    top: f64,
    backdrop: Option<&Backdrop>,
    title: &str,
) -> Result<Vec<u8>, RenderError> {
    let tree = raster::tree(svg)?;
    let picture = backdrop.map(|backdrop| Picture::of(&backdrop.plan)).transpose();
    let picture = picture.map_err(|error| RenderError(error.to_string()))?;
    Ok(document(&tree, top, backdrop.zip(picture.as_ref()), title))
}

fn document(tree: &Tree, top: f64, backdrop: Option<(&Backdrop, &Picture<'_>)>, title: &str) -> Vec<u8> {
    let [page_width, page_height] = [tree.size().width(), tree.size().height()];
    let (width, height) = (page_width * POINT, page_height * POINT);
    // In a PDF, y points upwards.
    let page_of_svg = Transform::from_row(POINT, 0.0, 0.0, -POINT, 0.0, height);
    let mut painter = Painter { content: Content::new(), patterns: Vec::new() };
    painter.content.transform(row(page_of_svg));
    painter.content.set_fill_rgb(1.0, 1.0, 1.0).rect(0.0, 0.0, page_width, page_height).fill_nonzero();
    if let Some((backdrop, _)) = backdrop {
        painter.backdrop(backdrop, top);
    }
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
    // The numbers after those of the patterns.
    let next = Ref::new(PATTERN.get() + i32::try_from(patterns.len()).unwrap_or_default());
    let (image, faded) = (next, next.next());
    if let Some((backdrop, picture)) = backdrop {
        let [columns, rows] = backdrop.plan.pixels.map(|number| i32::try_from(number).unwrap_or(i32::MAX));
        let mut written = pdf.image_xobject(image, &picture.samples);
        written.width(columns).height(rows).bits_per_component(8).filter(picture.filter);
        match picture.is_grey {
            true => written.color_space().device_gray(),
            false => written.color_space().device_rgb(),
        }
        written.finish();
        pdf.ext_graphics(faded).non_stroking_alpha(OPACITY);
    }
    let mut page = pdf.page(PAGE);
    page.media_box(Rect::new(0.0, 0.0, width, height)).parent(PAGES).contents(CONTENT);
    let mut resources = page.resources();
    resources.patterns().pairs(names.iter().map(|(name, reference)| (Name(name.as_bytes()), *reference)));
    if backdrop.is_some() {
        resources.x_objects().pair(SITE_PLAN, image);
        resources.ext_g_states().pair(FADED, faded);
    }
    resources.finish();
    page.finish();
    pdf.finish()
}

/// A pattern in one place: tiles are laid out in the axes of the page.
struct Tiles<'a> {
    name: String,
    of_svg: &'a Pattern,
    page_of_tile: Transform,
}

struct Painter<'a> {
    content: Content,
    patterns: Vec<Tiles<'a>>,
}

/// A site plan as stored in a PDF: 8 bits for each colour component.
struct Picture<'a> {
    samples: Cow<'a, [u8]>,
    filter: Filter,
    is_grey: bool,
}

impl<'a> Picture<'a> {
    fn of(plan: &'a SitePlan) -> Result<Self, SitePlanError> {
        Ok(match plan.encoding {
            Encoding::Jpeg { is_grey } => {
                Self { samples: Cow::Borrowed(&plan.bytes), filter: Filter::DctDecode, is_grey }
            }
            Encoding::Png => {
                let pixels = plan.decoded()?;
                let colours: Vec<u8> =
                    pixels.data().chunks_exact(4).flat_map(|rgba| [rgba[0], rgba[1], rgba[2]]).collect();
                let samples = compress_to_vec_zlib(&colours, LEVEL).into();
                Self { samples, filter: Filter::FlateDecode, is_grey: false }
            }
        })
    }
}

impl<'a> Painter<'a> {
    fn backdrop(&mut self, backdrop: &Backdrop, top: f64) {
        let frame = backdrop.frame;
        #[expect(clippy::cast_possible_truncation, reason = "numbers of the page")]
        let [x, y, width, height] =
            [frame.x0, frame.y0 - top, frame.width(), frame.height()].map(|number| number as f32);
        #[expect(clippy::cast_possible_truncation, reason = "numbers of the page")]
        let [a, b, c, d, e, f] = backdrop.page_of_plan.map(|number| number as f32);
        #[expect(clippy::cast_possible_truncation, reason = "a number of the page")]
        let place = Transform::from_row(a, b, c, d, e, f - top as f32);
        // The unit square of an image in a PDF has y upwards (ISO 32000-1, 8.9.5.1).
        let upright = place.pre_concat(Transform::from_row(1.0, 0.0, 0.0, -1.0, 0.0, 1.0));
        self.content.save_state().rect(x, y, width, height).clip_nonzero().end_path();
        self.content.set_parameters(FADED).transform(row(upright)).x_object(SITE_PLAN).restore_state();
    }

    /// `page_of_here` maps the coordinates around the group to those of the page.
    fn group(&mut self, group: &'a Group, page_of_here: Transform) {
        let inner = page_of_here.pre_concat(group.transform());
        self.content.save_state().transform(row(group.transform()));
        for node in group.children() {
            match node {
                Node::Group(group) => self.group(group, inner),
                Node::Path(path) => self.path(path, inner),
                Node::Text(text) => self.group(text.flattened(), inner),
                // No drawing contains one.
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
            // No drawing contains one.
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
                    // The control points of the cubic lie two thirds of the way to that of the quadratic.
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

/// Rounded to six decimals: the sine of a pattern's angle may differ in its last bit between machines.
fn row(transform: Transform) -> [f32; 6] {
    let Transform { sx, kx, ky, sy, tx, ty } = transform;
    #[expect(clippy::cast_possible_truncation, reason = "a number of the page, which was one of f32")]
    let rounded = |number: f32| ((f64::from(number) * 1e6).round() / 1e6) as f32;
    [sx, ky, kx, sy, tx, ty].map(rounded)
}

/// Colour components from 0 to 1.
fn rgb(Color { red, green, blue }: Color) -> [f32; 3] {
    [red, green, blue].map(|part| f32::from(part) / 255.0)
}
