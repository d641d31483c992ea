//! The page as HTML.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::{Page, Table};
use crate::checks;
use crate::steps::{Step, StepGroup};
use crate::units::Units;

/// Paper of any size: the browser's choice of A4 or Letter is respected, with margins that both have room for.
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
code, pre { font-family: 'DejaVu Sans Mono', Consolas, monospace; }
pre { font-size: 0.78rem; line-height: 1.4; white-space: pre-wrap; overflow-wrap: anywhere; border: 1px solid #ccc; padding: 0.8rem; }
.digest { font-size: 0.85rem; }
@page { margin: 16mm 15mm; }
@media print {
  body { font-size: 10pt; line-height: 1.4; max-width: none; padding: 0; }
  table { font-size: 8pt; }
  th, td { padding-top: 0.15rem; padding-bottom: 0.15rem; }
  pre { font-size: 7.5pt; }
  .supplement pre { font-size: 6.2pt; white-space: pre; }
  h2, h3, caption { break-after: avoid; }
  figure, table, tr, li, .answer { break-inside: avoid; }
  thead { display: table-header-group; }
  p { orphans: 3; widows: 3; }
}
";

/// The `id` of the warnings.
const WARNINGS: &str = "warnings";

pub(super) fn write(page: &Page) -> String {
    let markup = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (page.title) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                header {
                    h1 { (page.title) }
                    @if let Some(source) = &page.source {
                        p { "Source: " (source) }
                    }
                }
                main { (body(page)) }
            }
        }
    };
    markup.into_string() + "\n"
}

fn body(page: &Page) -> Markup {
    html! {
        p.answer { (page.answer) }
        @if let Some(count) = &page.notice {
            p { a href={ "#" (WARNINGS) } { (count) } ", at the end." }
        }
        table {
            caption { "Identification" }
            tbody {
                @for (name, value) in &page.identification {
                    tr {
                        th scope="row" { (name) }
                        @if name.starts_with("SHA") { td { code.digest { (value) } } } @else { td { (value) } }
                    }
                }
            }
        }
        (table(&page.results))
        @if !page.drawings.is_empty() {
            section {
                h2 { "Drawings" }
                @for drawing in &page.drawings {
                    figure {
                        (PreEscaped(drawing.svg()))
                        figcaption { (drawing.title()) }
                    }
                }
            }
        }
        section {
            h2 { "Method" }
            @for paragraph in &page.method { p { (subscripts(paragraph)) } }
        }
        section {
            h2 { "Inputs" }
            p {
                "Every number of the case file in the unit in which it is written, and in the SI unit in which it is used; what the file says in words; and what \
                 is assumed where it says nothing."
            }
            @for inputs in &page.inputs { (table(inputs)) }
        }
        section {
            h2 { "Results step by step" }
            p {
                "Each result has its equation, the numbers put into it, and its source. Numbers are in SI units and degrees, so that a calculator gives the result; \
                 one with fewer than six digits is exact, any other is rounded. Below a result it stands in the units of the other tables. "
                "atan2(y, x) is the angle of the point (x, y)."
            }
            @for group in &page.steps { (steps(group, page.units)) }
        }
        @if let Some(energy) = &page.energy {
            section {
                h2 { "Energy balance" }
                (table(energy))
                @for note in &page.energy_notes { p { (subscripts(note)) } }
            }
        }
        @if let Some(crash3) = &page.crash3 {
            section { h2 { "Comparison with CRASH3" } (table(crash3)) }
        }
        @if let Some(rows) = &page.checks {
            section { h2 { (checks::TITLE) } (table(rows)) }
        }
        @for supplement in &page.supplements {
            section class="supplement" { h2 { (supplement.title) } pre { (supplement.text) } }
        }
        section id=(WARNINGS) {
            h2 { "Warnings and assumptions" }
            @if page.warnings.is_empty() {
                p { "No warnings." }
            } @else {
                ul {
                    @for (code, message) in &page.warnings { li { code { (code) } ": " (message) "." } }
                }
            }
            ul {
                @for assumption in &page.assumptions { li { (subscripts(assumption)) } }
            }
        }
        section {
            h2 { "Case file" }
            p { "The complete text of " (page.case_name) "; the program can reproduce this report from it alone." }
            pre { code { (page.case_text) } }
        }
    }
}

fn table(table: &Table) -> Markup {
    html! {
        table {
            caption { (table.caption) }
            thead {
                tr {
                    @for name in &table.header {
                        @if name.is_empty() { td {} } @else { th scope="col" { (name) } }
                    }
                }
            }
            tbody {
                @for row in &table.rows {
                    tr {
                        @for (i, cell) in row.iter().enumerate() {
                            @if i == 0 { th scope="row" { (subscripts_of_row(cell)) } } @else { td.number { (cell) } }
                        }
                    }
                }
            }
        }
    }
}

fn steps(group: &StepGroup, units: Units) -> Markup {
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
                @for step in &group.steps { (row(step, units)) }
            }
        }
    }
}

fn row(step: &Step, units: Units) -> Markup {
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
                @if let Some(shown) = step.in_units(units) { br; "= " (shown) }
            }
            td { (step.source) }
        }
    }
}

/// The key of an input has underscores of its own.
fn subscripts_of_row(text: &str) -> Markup {
    if text.contains('.') && !text.contains(' ') {
        html! { code { (text) } }
    } else {
        subscripts(text)
    }
}

/// What follows an underscore, lowered: letters and digits, then such after a comma or a plus without a blank.
fn subscripts(text: &str) -> Markup {
    let mut parts = text.split('_');
    let first = parts.next().unwrap_or_default();
    let lowered: Vec<(&str, &str)> = parts.map(|part| part.split_at(subscript(part))).collect();
    html! {
        (first)
        @for (low, rest) in &lowered {
            @if low.is_empty() { "_" } @else { sub { (low) } }
            (rest)
        }
    }
}

/// (bytes) how much of a text belongs to the subscript with which it begins.
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
        ] {
            assert_eq!(subscripts(text).into_string(), expected);
        }
    }
}
