//! A document as HTML.

use ::drawing::Drawing;
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::{anchor, code_spans};
use crate::document::{Block, Cells, Column, Row, Table};
use crate::steps::{Step, StepGroup};

/// Paper of any size: the browser's choice of A4 or Letter is respected, with margins that fit both.
const STYLE: &str = "
:root { color-scheme: light; }
body { font: 16px/1.5 Arial, Helvetica, 'DejaVu Sans', sans-serif; color: #111; background: #fff; max-width: 60rem; margin: 0 auto; padding: 1rem 1.25rem 3rem; }
h1 { font-size: 1.7rem; line-height: 1.25; margin: 0.5rem 0; }
h2 { font-size: 1.3rem; margin: 2.2rem 0 0.6rem; border-bottom: 2px solid #0072b2; padding-bottom: 0.2rem; }
h3 { font-size: 1.05rem; margin: 1.4rem 0 0.4rem; }
.answer { font-size: 1.2rem; font-weight: bold; border-left: 4px solid #0072b2; padding-left: 0.8rem; }
figure { margin: 1.2rem 0; }
svg { display: block; width: 100%; height: auto; }
figcaption, caption { color: #444; font-size: 0.9rem; text-align: left; padding: 0.2rem 0; }
table { border-collapse: collapse; width: 100%; margin: 0.4rem 0 1.2rem; font-size: 0.9rem; }
th, td { text-align: left; vertical-align: top; padding: 0.28rem 0.6rem 0.28rem 0; border-bottom: 1px solid #ccc; overflow-wrap: anywhere; }
thead th { border-bottom: 1.5px solid #111; }
tbody th { font-weight: normal; }
.steps .name { width: 20%; }
.steps .value { width: 17%; }
.steps .source { width: 9%; }
.steps .numbers { color: #444; }
.result { font-weight: bold; }
.number { font-variant-numeric: tabular-nums; }
.right { text-align: right; }
.bar { font-family: 'DejaVu Sans Mono', Consolas, monospace; white-space: pre; font-size: 0.7rem; }
code, pre { font-family: 'DejaVu Sans Mono', Consolas, monospace; }
pre { font-size: 0.78rem; line-height: 1.4; white-space: pre-wrap; overflow-wrap: anywhere; border: 1px solid #ccc; padding: 0.8rem; }
.digest { font-size: 0.85rem; }
@page { margin: 16mm 15mm; }
@media print {
  body { font-size: 10pt; line-height: 1.4; max-width: none; padding: 0; }
  table { font-size: 8pt; }
  th, td { padding-top: 0.15rem; padding-bottom: 0.15rem; }
  pre { font-size: 7.5pt; }
  h2, h3, caption { break-after: avoid; }
  figure, table, tr, li, .answer { break-inside: avoid; }
  thead { display: table-header-group; }
  p { orphans: 3; widows: 3; }
}
";

/// The document as one page: a section for each of its headings.
pub(crate) fn write(blocks: &[Block]) -> String {
    let title = blocks.iter().find_map(|block| match block {
        Block::Title { title, .. } => Some(title.as_str()),
        _ => None,
    });
    let mut sections = blocks.chunk_by(|_, next| !matches!(next, Block::Heading(_)));
    let markup = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title.unwrap_or("deltav")) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                main { @for section in sections.by_ref() { (self::section(section)) } }
            }
        }
    };
    markup.into_string() + "\n"
}

/// The document as a part of another page, which has a style of its own: without the head of a page, and
/// without drawings, whose `id`s another part may have as well.
pub(crate) fn fragment(blocks: &[Block]) -> String {
    let part = |part: &Block| match part {
        Block::Drawing(_) | Block::Picture { .. } => html! {},
        Block::Chart { instead, .. } => html! { @if let Some(instead) = instead { (table(instead)) } },
        part => block(part),
    };
    html! { div.deltav { @for block in blocks { (part(block)) } } }.into_string()
}

fn section(blocks: &[Block]) -> Markup {
    match blocks.first() {
        Some(Block::Heading(heading)) => html! {
            section id=(anchor(heading)) { @for part in blocks { (block(part)) } }
        },
        _ => html! { @for part in blocks { (block(part)) } },
    }
}

fn block(block: &Block) -> Markup {
    match block {
        Block::Title { title, source } => html! {
            header {
                h1 { (title) }
                @if let Some(source) = source { p { "Source: " (source) } }
            }
        },
        Block::Heading(heading) => html! { h2 { (heading) } },
        Block::Subheading(heading) => html! { h3 { (heading) } },
        Block::Paragraph(words) => html! { p { (prose(words)) } },
        Block::Answer { found, how } => html! {
            p.answer { @for (i, line) in found.iter().enumerate() { @if i > 0 { br; } (line) } }
            @if !how.is_empty() { p { (prose(how)) } }
        },
        Block::Notice { count, heading } => html! {
            p {
                @match heading {
                    Some(heading) => { a href={ "#" (anchor(heading)) } { (count) } ", at the end." }
                    None => { (count) ", at the end." }
                }
            }
        },
        Block::Warnings { warnings, more } => html! {
            @if warnings.is_empty() {
                p { "No warnings." }
            } @else {
                ul {
                    @for (code, message) in warnings { li { code { (code) } ": " (prose(message)) "." } }
                }
                @if !more.is_empty() { p { (prose(more)) } }
            }
        },
        Block::List(items) => html! { ul { @for item in items { li { (prose(item)) } } } },
        Block::Notes(notes) => html! { ol { @for note in notes { li { (prose(note)) } } } },
        Block::Facts { title, facts } => html! {
            table {
                caption { (title) }
                tbody {
                    @for (name, value) in facts {
                        tr {
                            th scope="row" { (name) }
                            @if name.starts_with("SHA") { td { code.digest { (value) } } } @else { td { (value) } }
                        }
                    }
                }
            }
        },
        Block::Entries(entries) => html! {
            table {
                tbody {
                    @for (words, value) in entries {
                        tr { th scope="row" { (subscripts_of_row(words)) } td { (prose(value)) } }
                    }
                }
            }
        },
        Block::Table(table) => self::table(table),
        Block::Steps(group) => steps(group),
        Block::Drawing(drawing) | Block::Picture { drawing, .. } => figure(drawing, drawing.name()),
        Block::Chart { name, drawing, .. } => figure(&drawing.draw(), name),
        Block::Listing { text, .. } => html! { pre { code { (text) } } },
    }
}

/// A drawing with an `id` of its own.
fn figure(drawing: &Drawing, name: &str) -> Markup {
    html! {
        figure {
            (PreEscaped(drawing.svg_named(name)))
            figcaption { (drawing.title()) }
        }
    }
}

fn table(table: &Table) -> Markup {
    html! {
        table {
            @if !table.title.is_empty() { caption { (table.title) } }
            thead {
                tr {
                    @for column in &table.columns {
                        @if column.heading().is_empty() {
                            td {}
                        } @else {
                            th class=[is_number(column).then_some("right")] scope="col" { (subscripts(&column.heading())) }
                        }
                    }
                }
            }
            tbody {
                @for row in &table.rows { (self::row(row, &table.columns)) }
            }
        }
        @for note in &table.notes { p { (prose(note)) } }
    }
}

fn row(row: &Row, columns: &[Column]) -> Markup {
    match row {
        Row::Cells(cells) => html! {
            tr {
                @for (i, (cell, column)) in cells.iter().zip(columns).enumerate() {
                    @if i == 0 {
                        th scope="row" { (subscripts_of_row(cell)) }
                    } @else if column.cells == Cells::Bars {
                        td.bar { (cell) }
                    } @else {
                        td class=(if is_number(column) { "number right" } else { "number" }) { (lines(cell)) }
                    }
                }
            }
        },
        Row::Shared { label, value, source } => html! {
            tr {
                th scope="row" { (subscripts(label)) }
                td.number colspan=(columns.len().saturating_sub(2)) { (value) }
                td { (source) }
            }
        },
        Row::Detail(words) => {
            html! { tr { td {} td colspan=(columns.len().saturating_sub(1)) { (prose(words)) } } }
        }
    }
}

fn is_number(column: &Column) -> bool {
    column.cells == Cells::Numbers
}

/// Each line of a text on its own line.
fn lines(text: &str) -> Markup {
    html! {
        @for (i, line) in text.lines().enumerate() {
            @if i > 0 { br; }
            (subscripts(line))
        }
    }
}

fn steps(group: &StepGroup) -> Markup {
    html! {
        h3 { (group.title) }
        table.steps {
            thead {
                tr {
                    th.name scope="col" { "result" }
                    th scope="col" { "equation, and the numbers in it" }
                    th.value scope="col" { "value" }
                    th.source scope="col" { "source" }
                }
            }
            tbody {
                @for step in &group.steps { (self::step(step)) }
            }
        }
    }
}

fn step(step: &Step) -> Markup {
    html! {
        tr {
            th scope="row" { (subscripts(&step.name)) }
            td {
                (subscripts(&step.symbol))
                @if !step.formula.is_empty() { " = " (subscripts(&step.formula)) }
                @if !step.substitution.is_empty() { br; span.numbers { "= " (step.substitution) } }
            }
            td.number {
                span.result { (step.printed) @if !step.unit.is_empty() { "\u{a0}" (step.unit) } }
                @if let Some(shown) = &step.repeated { br; "= " (shown) }
            }
            td { (step.source) }
        }
    }
}

/// The label of a row: the underscores of a key stay.
fn subscripts_of_row(text: &str) -> Markup {
    if text.contains('.') && !text.contains(' ') {
        html! { code { (text) } }
    } else {
        subscripts(text)
    }
}

/// A sentence of the program: text in backticks is code.
fn prose(text: &str) -> Markup {
    html! {
        @for (part, is_code) in code_spans(text) {
            @if is_code { code { (part) } } @else { (subscripts(part)) }
        }
    }
}

/// Sets the text after an underscore as a subscript: letters and digits, and more of them after a comma or a
/// plus without a blank. The underscores of a key, such as `crush_plane`, stay.
fn subscripts(text: &str) -> Markup {
    let mut begin = 0;
    let mut parts = Vec::new();
    for part in text.split('_') {
        let is_subscript = begin > 0 && !is_key(&text[..begin - 1]);
        let (low, rest) = part.split_at(if is_subscript { subscript(part) } else { 0 });
        parts.push((begin > 0 && low.is_empty(), low, rest));
        begin += part.len() + 1;
    }
    html! {
        @for (is_underscore, low, rest) in &parts {
            @if *is_underscore { "_" }
            @if !low.is_empty() { sub { (low) } }
            (rest)
        }
    }
}

/// Whether a text ends in the beginning of a key: a word in lower case, whereas a symbol has one or two
/// letters.
fn is_key(text: &str) -> bool {
    let begin = text.trim_end_matches(|letter: char| letter.is_ascii_alphanumeric() || letter == '_').len();
    let word = text[begin..].split('_').next().unwrap_or_default();
    word.len() >= 3 && word.bytes().all(|letter| letter.is_ascii_lowercase())
}

/// (bytes) of the subscript with which a text begins.
fn subscript(text: &str) -> usize {
    let mut end = 0;
    let mut letters = text.char_indices().peekable();
    while let Some((at, letter)) = letters.next() {
        let joins = (letter == ',' || letter == '+')
            && at > 0
            && letters.peek().is_some_and(|(_, next)| next.is_ascii_alphanumeric());
        if !letter.is_ascii_alphanumeric() && !joins {
            break;
        }
        end = at + letter.len_utf8();
    }
    end
}

#[cfg(test)]
mod tests {
    use super::subscripts;

    #[test]
    fn subscripts_end_where_they_should() {
        for (text, expected) in [
            ("E_1 + E_2", "E<sub>1</sub> + E<sub>2</sub>"),
            ("Σ w_j (C_j + C_j+1)/2", "Σ w<sub>j</sub> (C<sub>j</sub> + C<sub>j+1</sub>)/2"),
            ("S_1,2 < 3", "S<sub>1,2</sub> &lt; 3"),
            ("W_n, then", "W<sub>n</sub>, then"),
            ("a _ b", "a _ b"),
            ("check crush_plane and E_1", "check crush_plane and E<sub>1</sub>"),
            ("[vehicle1.after] delta_v_error, μ_c", "[vehicle1.after] delta_v_error, μ<sub>c</sub>"),
        ] {
            assert_eq!(subscripts(text).into_string(), expected);
        }
    }
}
