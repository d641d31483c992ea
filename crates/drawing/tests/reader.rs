//! A picture as read by resvg, independently of the program that laid it out. The tests of `report` use this
//! reader, too.

use std::sync::Arc;

use resvg::tiny_skia::Rect;
use resvg::usvg::{Group, Node, Options, Text, TextChunk, Tree, fontdb::Database};

pub(crate) struct Reader(Options<'static>);

impl Reader {
    pub(crate) fn new() -> Self {
        let mut fonts = Database::new();
        fonts.load_font_data(dejavu::sans::regular().to_vec());
        fonts.set_sans_serif_family("DejaVu Sans");
        Self(Options { fontdb: Arc::new(fonts), font_family: "DejaVu Sans".to_owned(), ..Options::default() })
    }

    pub(crate) fn tree(&self, svg: &str) -> Tree {
        Tree::from_str(svg, &self.0).unwrap()
    }

    /// Checks that everything is on the page, and that no text is on another or was cut; returns the texts
    /// with their places.
    pub(crate) fn readable(&self, name: &str, svg: &str) -> Vec<(String, Rect)> {
        let tree = self.tree(svg);
        let (mut texts, mut others) = (Vec::new(), Vec::new());
        boxes(tree.root(), &mut texts, &mut others);
        let page = tree.size().to_rect(0.0, 0.0).unwrap();
        for area in others.iter().chain(texts.iter().map(|(_, area)| area)) {
            let inside = area.left() >= page.left()
                && area.top() >= page.top()
                && area.right() <= page.right()
                && area.bottom() <= page.bottom();
            assert!(inside, "{name}: {area:?} is not on the page {page:?}");
        }
        for (i, (words, area)) in texts.iter().enumerate() {
            for (other_words, other) in &texts[..i] {
                assert!(area.intersect(other).is_none(), "{name}: \"{words}\" is on \"{other_words}\"");
            }
        }
        texts
    }
}

/// Where the letters are, and everything else.
pub(crate) fn boxes(group: &Group, texts: &mut Vec<(String, Rect)>, others: &mut Vec<Rect>) {
    for node in group.children() {
        match node {
            Node::Group(group) => boxes(group, texts, others),
            // The white rim of the text that follows.
            Node::Text(text) if is_rim(text) => {}
            Node::Text(text) => {
                let words: String = text.chunks().iter().map(|chunk| chunk.text().to_owned()).collect();
                texts.push((words, text.abs_bounding_box()));
            }
            node => others.push(node.abs_stroke_bounding_box()),
        }
    }
}

fn is_rim(text: &Text) -> bool {
    text.chunks().iter().flat_map(TextChunk::spans).any(|span| span.stroke().is_some())
}

/// The attribute of the element with an id.
pub(crate) fn attribute(svg: &str, id: &str, name: &str) -> Option<String> {
    let element = svg.lines().find(|line| line.contains(&format!(" id=\"{id}\"")))?;
    let start = element.find(&format!(" {name}=\""))? + name.len() + 3;
    let end = element[start..].find('"')? + start;
    Some(element[start..end].to_owned())
}

pub(crate) fn number(svg: &str, id: &str, name: &str) -> f64 {
    attribute(svg, id, name).unwrap_or_else(|| panic!("no {name} of {id}")).parse().unwrap()
}

/// A linear scale of a chart, from pixels to the values of its axis.
#[derive(Debug)]
pub(crate) struct Scale {
    first: (f64, f64),
    last: (f64, f64),
}

impl Scale {
    /// Through the first and the last of some ticks: pixel and number.
    fn through(ticks: &[(f64, f64)]) -> Self {
        let (first, last) = (ticks[0], ticks[ticks.len() - 1]);
        assert!(ticks.len() > 1 && first.0 != last.0, "{ticks:?}");
        Self { first, last }
    }

    pub(crate) fn value(&self, pixel: f64) -> f64 {
        let Self { first, last } = self;
        first.1 + (pixel - first.0) * self.pixel() * (last.0 - first.0).signum()
    }

    /// The value of one pixel.
    pub(crate) fn pixel(&self) -> f64 {
        let Self { first, last } = self;
        (last.1 - first.1) / (last.0 - first.0).abs()
    }
}

/// The scales of the chart between `left` and `right` (px), across and upward, from its grid and the numbers
/// written to it.
pub(crate) fn scales(svg: &str, left: f64, right: f64) -> [Scale; 2] {
    let lines: Vec<&str> = svg.lines().collect();
    let (mut across, mut upward) = (Vec::new(), Vec::new());
    for pair in lines.windows(2).filter(|pair| pair[0].starts_with("<line ") && pair[1].starts_with("<text "))
    {
        let of = |name: &str| {
            let rest = pair[0].split_once(&format!(" {name}=\"")).unwrap().1;
            rest.split('"').next().unwrap().parse::<f64>().unwrap()
        };
        let (from, to) = ([of("x1"), of("y1")], [of("x2"), of("y2")]);
        let words = pair[1].split_once('>').unwrap().1.strip_suffix("</text>").unwrap();
        let Ok(value) = words.replace(',', "").parse::<f64>() else { continue };
        if from[0] < left || to[0] > right {
            continue;
        }
        if from[0] == to[0] && pair[1].contains("text-anchor=\"middle\"") {
            across.push((from[0], value));
        } else if from[1] == to[1] && pair[1].contains("text-anchor=\"end\"") {
            upward.push((from[1], value));
        }
    }
    [Scale::through(&across), Scale::through(&upward)]
}

/// The area of the shape with an id, without its edge.
pub(crate) fn area(tree: &Tree, id: &str) -> Rect {
    tree.node_by_id(id).unwrap_or_else(|| panic!("no {id}")).abs_bounding_box()
}
