//! The page as Markdown.

use super::{Page, Table};
use crate::checks;
use crate::steps::StepGroup;
use crate::units::Units;

pub(super) fn write(page: &Page) -> String {
    let mut out = String::new();
    let mut put = |text: &str| {
        out.push_str(text);
        out.push('\n');
    };
    put(&format!("# {}\n", escaped(&page.title)));
    if let Some(source) = &page.source {
        put(&format!("Source: {}\n", escaped(source)));
    }
    put(&format!("**{}**\n", escaped(&page.answer)));
    if let Some(count) = &page.notice {
        // The anchor that GitHub, GitLab and Pandoc give to the heading.
        put(&format!("[{count}](#warnings-and-assumptions), at the end.\n"));
    }
    for (name, value) in &page.identification {
        put(&format!("- {name}: {}", escaped(value)));
    }
    put("");
    put(&table(&page.results));
    for drawing in &page.drawings {
        let what = drawing.name();
        put(&format!("- {what}: {}", escaped(drawing.description())));
    }
    put("\n## Method\n");
    for paragraph in &page.method {
        put(&format!("{}\n", escaped(paragraph)));
    }
    put("## Inputs\n");
    for inputs in &page.inputs {
        put(&format!("### {}\n", inputs.caption));
        put(&table(inputs));
    }
    put("## Results step by step\n");
    put(
        "Numbers are in SI units and degrees; one with fewer than six digits is exact, any other is rounded. At the end of a result it stands in the units of the other tables. atan2(y, x) is the angle of the point (x, y).\n",
    );
    for group in &page.steps {
        put(&steps(group, page.units));
    }
    if let Some(energy) = &page.energy {
        put("## Energy balance\n");
        put(&table(energy));
        for note in &page.energy_notes {
            put(&format!("{}\n", escaped(note)));
        }
    }
    if let Some(crash3) = &page.crash3 {
        put("## Comparison with CRASH3\n");
        put(&table(crash3));
    }
    if let Some(rows) = &page.checks {
        put(&format!("## {}\n", checks::TITLE));
        put(&table(rows));
    }
    for supplement in &page.supplements {
        put(&format!("## {}\n", supplement.title));
        let fence = fence(&supplement.text);
        put(&format!("{fence}text\n{}\n{fence}\n", supplement.text.trim_end()));
    }
    put("## Warnings and assumptions\n");
    if page.warnings.is_empty() {
        put("No warnings.\n");
    }
    for (code, message) in &page.warnings {
        put(&format!("- warning [{code}]: {}.", escaped(message)));
    }
    for assumption in &page.assumptions {
        put(&format!("- {}", escaped(assumption)));
    }
    put("\n## Case file\n");
    put(&format!(
        "The whole of {}; from it alone the program gives this report again.\n",
        escaped(&page.case_name)
    ));
    let fence = fence(&page.case_text);
    let end = if page.case_text.ends_with('\n') { "" } else { "\n" };
    put(&format!("{fence}toml\n{}{end}{fence}", page.case_text));
    out
}

fn table(table: &Table) -> String {
    let line = |cells: &[String]| {
        let cells: Vec<String> = cells.iter().map(|cell| format!(" {} |", escaped(cell))).collect();
        format!("|{}\n", cells.concat())
    };
    let mut text = line(&table.header);
    text.push_str(&format!("|{}\n", " --- |".repeat(table.header.len())));
    for row in &table.rows {
        text.push_str(&line(row));
    }
    text
}

fn steps(group: &StepGroup, units: Units) -> String {
    let mut text = format!("### {}\n\n```text\n", group.title);
    for step in &group.steps {
        let mut unit = if step.unit.is_empty() { String::new() } else { format!(" {}", step.unit) };
        if let Some(shown) = step.in_units(units) {
            unit.push_str(&format!(" = {shown}"));
        }
        text.push_str(&format!("{} ({})\n", step.name, step.source));
        let indent = " ".repeat(step.symbol.chars().count());
        let mut left = step.symbol.as_str();
        let sides = [step.formula.as_str(), &step.substitution, &format!("{}{unit}", step.printed)];
        for right in sides.into_iter().filter(|side| !side.is_empty()) {
            text.push_str(&format!("  {left} = {right}\n"));
            left = &indent;
        }
    }
    text.push_str("```\n");
    text
}

/// Longer than any run of backticks in the text.
fn fence(text: &str) -> String {
    let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    "`".repeat(longest.max(2) + 1)
}

/// Characters that Markdown would take as its own; a line of a table ends with the line.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for letter in text.chars() {
        match letter {
            '\\' | '`' | '*' | '_' | '[' | ']' | '<' | '>' | '|' | '#' => {
                out.push('\\');
                out.push(letter);
            }
            '\n' | '\r' => out.push(' '),
            letter => out.push(letter),
        }
    }
    out
}
