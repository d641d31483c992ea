//! Every number in the text of the guide, the README and the glossary has a source.
//!
//! Numbers in console blocks are what the program printed (`transcripts.rs`), and pieces of case files are
//! read (`keys.rs`). For those in the sentences and tables, `facts.rs` and `glossary.rs` have patterns that
//! are put together from the source of their numbers: a result of the program, a constant, a place in another
//! page. A pattern is a short anchor word and the numbers with their units, `"warns … 0.3 … 15 m/s"`: the
//! words between may change, the numbers may not. A number that is in no pattern fails here, and so does a
//! pattern that is not in the page. So if a digit of the page or a result of the program changes, this test
//! says which.

use std::ops::Range;

use crate::guide::prose::{Page, page, pages};

mod facts;
mod glossary;
mod ledger;

/// Made from the list of the keys and the table of the units, and checked by the tests of the crate `case`.
const MADE: &str = "docs/guide/case-file.md";

/// Names and dates that contain a number.
const NAMES: [&str; 10] = [
    "fixtures/sae-980025",
    "SAE 980025, 1998",
    "SAE 980025 (1998)",
    "SAE 980025",
    "SAE 2005-01-1200",
    "SAE 871993",
    "SHA-256",
    "UTF-8",
    "JCGM 100, equation 10",
    "JCGM 100",
];

/// The page's sentences and tables as one line: without fenced blocks, equations, code in backticks, the
/// targets of links and the numbers of headings and lists.
fn sentences(page: &Page) -> String {
    let mut text = String::new();
    for line in page.unfenced().into_iter().filter(|line| !line.starts_with("    ")) {
        let line = line.trim_start_matches('#').trim();
        let unnumbered = line.trim_start_matches(|c: char| c.is_ascii_digit());
        text.push_str(unnumbered.strip_prefix(". ").unwrap_or(line));
        text.push(' ');
    }
    let text: Vec<&str> = text.split('`').collect();
    let text = text
        .iter()
        .enumerate()
        .map(|(index, part)| if index % 2 == 0 { part } else { "`" })
        .collect::<String>();
    let mut parts = text.split("](");
    let mut kept = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        kept.push(']');
        kept.push_str(part.split_once(')').map_or("", |(_, rest)| rest));
    }
    kept.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The places of numbers: digits with points and commas between them, but not those of a symbol, such as d_1
/// or J670.
fn numbers(text: &str) -> Vec<Range<usize>> {
    let mut found: Vec<Range<usize>> = Vec::new();
    for (start, _) in text.char_indices().filter(|(_, c)| c.is_ascii_digit()) {
        let before = text[..start].chars().next_back();
        let goes_on = found.last().is_some_and(|last| start < last.end);
        if goes_on || before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == '^') {
            continue;
        }
        let digits = |text: &str| text.len() - text.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let mut end = start + digits(&text[start..]);
        // 1,234.5e6
        while text[end..].starts_with([',', '.', 'e']) && digits(&text[end + 1..]) > 0 {
            end += 1 + digits(&text[end + 1..]);
        }
        found.push(start..end);
    }
    found
}

/// The number of a vehicle, an equation or a section, alone or in a row: "Eq 6, 7", "sections 2 to 4".
fn is_reference(text: &str, number: &Range<usize>, theory: &Page) -> bool {
    let value: u32 = text[number.clone()].parse().unwrap_or(0);
    let mut before = &text[..number.start];
    loop {
        let is_after = |words: &[&str]| words.iter().any(|word| before.ends_with(word));
        if is_after(&["ehicle "]) {
            return value == 1 || value == 2;
        } else if is_after(&["Eq "]) {
            return (1..=8).contains(&value);
        } else if is_after(&["section ", "sections ", "heory "]) {
            return theory.text.contains(&format!("\n## {value}. "));
        }
        let joined = [", ", " to ", " and "].iter().find_map(|word| before.strip_suffix(word));
        let Some(row) = joined else { return false };
        let shorter = row.trim_end_matches(|c: char| c.is_ascii_digit());
        if shorter.len() == row.len() {
            return false;
        }
        before = shorter;
    }
}

/// What separates the parts of a pattern: any words, but no other number.
const GAP: &str = " … ";
/// (bytes) the longest gap.
const WIDEST_GAP: usize = 200;

/// The places of the part, but not within a longer number.
fn part_places<'a>(text: &'a str, part: &'a str) -> impl Iterator<Item = Range<usize>> + 'a {
    let is_digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    let is_whole = move |place: &Range<usize>| {
        let mut before = text[..place.start].chars().rev();
        let mut after = text[place.end..].chars();
        let (last, next) = (before.next(), after.next());
        let goes_on = |c: Option<char>| matches!(c, Some('.' | ','));
        let is_tail =
            is_digit(part.chars().next()) && (is_digit(last) || (goes_on(last) && is_digit(before.next())));
        let is_head = is_digit(part.chars().next_back())
            && (is_digit(next) || (goes_on(next) && is_digit(after.next())));
        !is_tail && !is_head
    };
    text.match_indices(part).map(|(start, part)| start..start + part.len()).filter(is_whole)
}

/// The places of the parts of the pattern, for each time that all of them occur in this order. No number may
/// be between them except a reference.
fn places(text: &str, pattern: &str, sourced: &[Range<usize>]) -> Vec<Vec<Range<usize>>> {
    let mut parts = pattern.split(GAP);
    let first = parts.next().unwrap_or_default();
    let rest: Vec<&str> = parts.collect();
    let whole = |start: Range<usize>| {
        let mut found = vec![start];
        for part in &rest {
            let from = found.last()?.end;
            let place = part_places(&text[from..], part).next()?;
            let place = place.start + from..place.end + from;
            let is_between = |number: &Range<usize>| from <= number.start && number.end <= place.start;
            if place.start - from > WIDEST_GAP || sourced.iter().any(is_between) {
                return None;
            }
            found.push(place);
        }
        Some(found)
    };
    part_places(text, first).filter_map(whole).collect()
}

/// The number in brackets, with the text around it.
fn in_its_place(text: &str, number: Range<usize>) -> String {
    let before: Vec<char> = text[..number.start].chars().rev().take(40).collect();
    let after: String = text[number.end..].chars().take(40).collect();
    format!("{}[{}]{after}", before.into_iter().rev().collect::<String>(), &text[number])
}

/// The numbers of these sentences without a source, and the patterns that are not in them.
fn without_source(text: &str, patterns: &[&str], theory: &Page) -> Vec<String> {
    let mut sourced = numbers(text);
    sourced.retain(|number| !is_reference(text, number, theory));
    let mut held: Vec<Range<usize>> = NAMES.iter().flat_map(|name| part_places(text, name)).collect();
    let mut missing = Vec::new();
    for pattern in patterns {
        let found = places(text, pattern, &sourced);
        if found.is_empty() {
            missing.push(format!("not in the page: {pattern}"));
        }
        held.extend(found.into_iter().flatten());
    }
    let is_held = |number: &Range<usize>| {
        held.iter().any(|place| place.start <= number.start && number.end <= place.end)
    };
    let open = sourced.into_iter().filter(|number| !is_held(number));
    open.map(|number| format!("no source: {}", in_its_place(text, number))).chain(missing).collect()
}

/// The sentences of each page whose numbers are checked, and the patterns that check them.
fn held() -> Vec<(Page, String, Vec<String>)> {
    let facts = facts::facts();
    let guide = pages(&["docs/guide"]).into_iter().filter(|page| page.name != MADE);
    let pages = guide.chain([page("crates/report/glossary.md")]);
    let with_patterns = |page: Page| {
        let of_it = facts.iter().filter(|fact| fact.page == page.name);
        let patterns = of_it.map(|fact| fact.pattern.clone()).collect();
        let text = sentences(&page);
        (page, text, patterns)
    };
    pages.map(with_patterns).collect()
}

#[test]
fn every_number_has_a_source() {
    let theory = page("docs/theory.md");
    let mut problems = Vec::new();
    for (page, text, patterns) in held() {
        let patterns: Vec<&str> = patterns.iter().map(String::as_str).collect();
        let found = without_source(&text, &patterns, &theory);
        problems.extend(found.into_iter().map(|problem| format!("{}: {problem}", page.name)));
    }
    assert!(problems.is_empty(), "{}", problems.join("\n"));
}

/// The test above notices each digit of each number that is not a reference, if it is changed by one.
#[test]
fn a_changed_digit_is_noticed() {
    let theory = page("docs/theory.md");
    // The count of numbers without a source in a text; the rest of the page is ignored.
    let open = |text: &str, patterns: &[&str]| {
        let problems = without_source(text, patterns, &theory);
        problems.into_iter().filter(|problem| problem.starts_with("no source")).count()
    };
    let mut changed = 0;
    let mut unnoticed = Vec::new();
    for (page, text, patterns) in held() {
        let patterns: Vec<&str> = patterns.iter().map(String::as_str).collect();
        let problems = without_source(&text, &patterns, &theory);
        for number in numbers(&text).into_iter().filter(|number| !is_reference(&text, number, &theory)) {
            let around = around(&text, &number);
            let as_it_is = open(&text[around.clone()], &patterns);
            for place in number.clone().filter(|place| text.as_bytes()[*place].is_ascii_digit()) {
                let digit = text.as_bytes()[place] - b'0';
                let other = format!("{}{}{}", &text[..place], (digit + 1) % 10, &text[place + 1..]);
                // It is noticed at its place, or by a pattern that is no longer in the whole page.
                let is_noticed = open(&other[around.clone()], &patterns) > as_it_is
                    || without_source(&other, &patterns, &theory) != problems;
                if !is_noticed {
                    unnoticed.push(format!("{}: {}", page.name, in_its_place(&other, number.clone())));
                }
                changed += 1;
            }
        }
    }
    assert!(unnoticed.is_empty(), "{}", unnoticed.join("\n"));
    assert!(changed > 300, "only {changed} digits");
}

/// As much of the text on both sides of a number as a pattern may take.
fn around(text: &str, number: &Range<usize>) -> Range<usize> {
    const REACH: usize = 4 * WIDEST_GAP;
    let start = number.start.saturating_sub(REACH);
    let end = (number.end + REACH).min(text.len());
    let start = (0..=start).rev().find(|place| text.is_char_boundary(*place)).unwrap_or(0);
    let end = (end..=text.len()).find(|place| text.is_char_boundary(*place)).unwrap_or(text.len());
    start..end
}

/// A link whose text names a section leads to that section.
#[test]
fn every_section_is_the_one_that_the_link_leads_to() {
    let mut count = 0;
    for page in pages(&["docs", "docs/guide", "crates/report"]) {
        for (before, after) in
            page.text.match_indices("theory.md#").map(|(at, text)| page.text.split_at(at + text.len()))
        {
            let words = before.rsplit('[').next().unwrap().split(']').next().unwrap();
            let Some(section) = words.split("section ").nth(1) else { continue };
            assert!(
                after.starts_with(&format!("{section}-")),
                "{}: {words} leads to {}",
                page.name,
                &after[..20]
            );
            count += 1;
        }
    }
    assert!(count > 5, "only {count} links");
}

/// An equation of the guide is one of docs/theory.md or of the glossary, letter by letter.
#[test]
fn every_equation_is_one_of_the_theory() {
    let one_line = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let known = one_line(&(page("docs/theory.md").text + &page("crates/report/glossary.md").text));
    let mut count = 0;
    for page in pages(&["docs/guide"]) {
        for line in page.unfenced().into_iter().filter(|line| line.starts_with("    ")) {
            assert!(known.contains(&one_line(line)), "{}: {line}", page.name);
            count += 1;
        }
    }
    assert!(count > 15, "only {count} equations");
}

#[test]
fn numbers_are_found_where_they_stand() {
    let text = "at 1,234.5 N·m (1.02e5, −3 %), d_1, J670, Eq 6, 7 of SAE 980025; 1970s";
    let found: Vec<&str> = numbers(text).into_iter().map(|number| &text[number]).collect();
    assert_eq!(found, ["1,234.5", "1.02e5", "3", "6", "7", "980025", "1970"]);
    let theory = page("docs/theory.md");
    let references: Vec<bool> =
        numbers(text).iter().map(|number| is_reference(text, number, &theory)).collect();
    assert_eq!(references, [false, false, false, true, true, false, false]);
}
