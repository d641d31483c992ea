//! Text with runs of blanks between its columns, as `pdftotext -layout` gives it, with invented numbers.

use recorder::{Channel, RecorderTable, TextFault, TextLayout, TextRefusal, read_tables};

fn one(text: &str) -> RecorderTable {
    let mut tables = read_tables(text).unwrap_or_else(|refusal| panic!("{text}{refusal}"));
    assert_eq!(tables.len(), 1, "{text}{tables:?}");
    tables.remove(0)
}

const KMH: f64 = 1.0 / 3.6;
const NONE: f64 = f64::NAN;

/// Asserts the values of a channel in a unit; [`NONE`] is a cell without a value.
#[track_caller]
fn assert_values(table: &RecorderTable, channel: Channel, unit: f64, expected: &[f64]) {
    let rounded = |value: f64| (value / unit * 1e6).round() / 1e6;
    let found: Vec<Option<f64>> = table.values(channel).into_iter().map(|value| value.map(rounded)).collect();
    let expected: Vec<Option<f64>> =
        expected.iter().map(|value| (!value.is_nan()).then_some(*value)).collect();
    assert_eq!(found, expected, "{channel:?} of {table:#?}");
}

#[track_caller]
fn refused(text: &str) -> TextRefusal {
    match read_tables(text) {
        Ok(tables) => panic!("{text}{tables:#?}"),
        Err(refusal) => refusal,
    }
}

/// A line of a heading with fewer cells than columns belongs to the columns over which its cells stand.
#[test]
fn a_short_line_of_a_heading_belongs_to_the_columns_below_it() {
    let rows = "\
0                     0                     0
10                    -5                    1
20                    -15                   4
30                    -25                   8
";
    let below = "Time (ms)             Delta-V (km/h)        Delta-V (km/h)\n";
    let table = one(&format!("                      Longitudinal          Lateral\n{below}{rows}"));
    assert_eq!(table.layout, TextLayout::Aligned);
    assert_values(&table, Channel::DeltaVLongitudinal, KMH, &[0.0, -5.0, -15.0, -25.0]);
    assert_values(&table, Channel::DeltaVLateral, KMH, &[0.0, 1.0, 4.0, 8.0]);
    let table = one(&format!("                      Lateral               Longitudinal\n{below}{rows}"));
    assert_values(&table, Channel::DeltaVLateral, KMH, &[0.0, -5.0, -15.0, -25.0]);
    assert_values(&table, Channel::DeltaVLongitudinal, KMH, &[0.0, 1.0, 4.0, 8.0]);
    let table = one("                  Vehicle           Wheel
Time (s)          Speed (km/h)      Speed (km/h)
-1                60                61
-0.5              58                50
0                 50                30
");
    assert_values(&table, Channel::Speed, KMH, &[60.0, 58.0, 50.0]);
    assert_eq!(table.ignored[0].0, "Wheel Speed (km/h)");
}

/// A heading of four lines, in which one cell stands alone in the first.
const FOUR_LINES: &str = "                       Speed,
                       Vehicle        Accelerator      Service      ABS
  Times                Indicated      Pedal            Brake        Activity
  (sec)                MPH [km/h]     (%)              (On, Off)    (On, Off)
  -1.0                 37 [60]        14               Off          Off
  -0.5                 36 [58]        0                On           Off
   0.0                 34 [55]        0                On           On
";

#[test]
fn a_heading_of_four_lines_is_read_by_its_columns() {
    let table = one(FOUR_LINES);
    let heading = |channel| table.column(channel).unwrap().heading.as_str();
    assert_eq!(heading(Channel::Speed), "Speed, Vehicle Indicated MPH [km/h]");
    assert_eq!(heading(Channel::Brake), "Service Brake (On, Off)");
    assert_values(&table, Channel::Speed, KMH, &[60.0, 58.0, 55.0]);
    assert_values(&table, Channel::Accelerator, 1.0, &[14.0, 0.0, 0.0]);
    assert_values(&table, Channel::Abs, 1.0, &[0.0, 0.0, 1.0]);
    // The same with empty cells.
    let table = one(&FOUR_LINES.replace("   0   ", "       "));
    assert_values(&table, Channel::Accelerator, 1.0, &[14.0, NONE, NONE]);
    assert_values(&table, Channel::Brake, 1.0, &[0.0, 1.0, 1.0]);
}

/// A cell over several columns belongs to each of them, alone in its line or not.
#[test]
fn a_cell_over_several_columns_belongs_to_each() {
    let rows = "
Time (ms)      Longitudinal   Lateral
    0               0             0
   10              -5             1
   20             -15             4
";
    for above in ["                     Delta-V (km/h)", "Sample               Delta-V (km/h)"] {
        let table = one(&format!("{above}{rows}"));
        assert_values(&table, Channel::Time, 1e-3, &[0.0, 10.0, 20.0]);
        assert_values(&table, Channel::DeltaVLongitudinal, KMH, &[0.0, -5.0, -15.0]);
        assert_values(&table, Channel::DeltaVLateral, KMH, &[0.0, 1.0, 4.0]);
    }
    // Over the first of the two only, it may begin there and belong to both.
    let refusal = refused(&format!("               Delta-V (km/h){rows}").replace("Lateral", "    Lateral"));
    let (Some(place), TextFault::HeadingUnplaced { text }) = (refusal.place, &refusal.fault) else {
        panic!("{refusal}")
    };
    assert_eq!((place.line, place.column, text.as_str()), (1, 16, "Delta-V (km/h)"));
    // Two columns with one heading, and a word over one of them.
    let text = "                  Wheel
Time (s)          Speed (km/h)      Speed (km/h)
-1                60                61
0                 50                30
";
    let refusal = refused(text);
    assert_eq!(refusal.place.map(|place| (place.line, place.column)), Some((1, 19)), "{refusal}");
    // A word between two columns.
    let refusal = refused(&text.replace("                  Wheel", "                                Wheel"));
    assert!(
        refusal.to_string().contains("it is not sure over which columns the heading \"Wheel\""),
        "{refusal}"
    );
}

/// Titles over a table belong to no column.
#[test]
fn a_title_over_a_table_belongs_to_no_column() {
    let table = "
Time (s)    Vehicle Speed (km/h)    Service Brake
-1.0        60                      Off
-0.5        58                      On
";
    for title in [
        "Pre-Crash Data, maximum speed 60 km/h",
        "              Pre-Crash Data",
        "Case 12     Printed on Monday",
        "Brake and wheel speed",
    ] {
        let table = one(&format!("{title}{table}"));
        assert_values(&table, Channel::Speed, KMH, &[60.0, 58.0]);
        assert_values(&table, Channel::Brake, 1.0, &[0.0, 1.0]);
    }
    // One that would change a column, and is not at the left edge, may be a part of its heading.
    let refusal = refused(&format!("            Maximum value{table}"));
    assert_eq!(refusal.place.map(|place| (place.line, place.column)), Some((1, 13)), "{refusal}");
    // One that says the axis, where the column does not.
    let refusal = refused("Lateral crash pulse\nTime (ms)   Delta-V (km/h)\n0           0\n10          3\n");
    assert!(refusal.to_string().contains("the heading \"Lateral crash pulse\" stands"), "{refusal}");
}

/// An empty cell stays where it is.
#[test]
fn an_empty_cell_shifts_no_other() {
    let text = "\
Time (s)    Vehicle Speed (km/h)    Accelerator Pedal (%)    Engine Throttle (%)
-1.0        60                      14                       15
-0.5        58                      14                       15
 0.0                                14                       15
";
    let table = one(text);
    assert_values(&table, Channel::Speed, KMH, &[60.0, 58.0, NONE]);
    assert_values(&table, Channel::Accelerator, 1.0, &[14.0; 3]);
    assert_values(&table, Channel::Throttle, 1.0, &[15.0; 3]);
    assert_eq!(table.doubts.len(), 1);
    assert_eq!(table.doubts[0].to_string(), "line 4, column 13, speed: the cell is empty");
    let pulse = "\
Time (ms)    Longitudinal Delta-V (km/h)    Lateral Delta-V (km/h)
0            0                              0
10           -3                             1
20                                          4
30           -15
40                                          9
";
    let table = one(pulse);
    assert_values(&table, Channel::DeltaVLongitudinal, KMH, &[0.0, -3.0, NONE, -15.0, NONE]);
    assert_values(&table, Channel::DeltaVLateral, KMH, &[0.0, 1.0, 4.0, NONE, 9.0]);
    // A column that is empty throughout, and a row with no more than its time.
    let table = one("\
Time (s)    Speed (km/h)    Service Brake    ABS Activity
-1.0        60                               Off
-0.5
0.0         55                               On
");
    assert_values(&table, Channel::Speed, KMH, &[60.0, NONE, 55.0]);
    assert_values(&table, Channel::Brake, 1.0, &[NONE; 3]);
    assert_values(&table, Channel::Abs, 1.0, &[0.0, NONE, 1.0]);
}

/// A row whose cells stand in no column for sure is refused with its place.
#[test]
fn a_row_that_lines_up_with_nothing_is_refused() {
    let heading = "Time (s)    Vehicle Speed (km/h)    Accelerator Pedal (%)\n";
    let rows = "-1.0        60                      14\n-0.5        58                      14\n";
    for (row, at) in [
        // Between two columns, with the cells after it moved to the left, and without a time.
        ("0.0               14\n", (4, 19)),
        ("0.0   14\n", (4, 7)),
        ("            50                      14\n", (4, 13)),
    ] {
        let refusal = refused(&format!("{heading}{rows}{row}"));
        assert!(matches!(refusal.fault, TextFault::CellUnplaced { .. }), "{row}{refusal}");
        assert_eq!(refusal.place.map(|place| (place.line, place.column)), Some(at), "{refusal}");
    }
    // Within the width of its column, but on none of its edges.
    let text = "\
Time (s)    Speed (km/h)    ABS Activity
-1.0        60              Non-Engaged
-0.5                          Off
";
    assert!(matches!(refused(text).fault, TextFault::CellUnplaced { .. }), "{}", refused(text));
    one(&text.replace("-0.5                          Off", "-0.5                        Off"));
    // Beside an empty cell, a heading over no value may be that of another column.
    let text = "\
Time (s)    Pedal (%)             Engine Throttle (%)
-1.0                    14        15
-0.5                              15
";
    assert!(matches!(refused(text).fault, TextFault::HeadingUnplaced { .. }), "{}", refused(text));
    one(&text.replace("-0.5                  ", "-0.5                 0"));
    // Three blanks between all fields: nothing lines up, and the second value may be of either column.
    let text = "Time (s)   Speed (km/h)   Pedal (%)\n-1.0   60   14\n-0.5   14\n0.0   50   14\n";
    assert!(matches!(refused(text).fault, TextFault::HeadingUnplaced { .. }), "{}", refused(text));
}

/// A page with other margins continues the table, whether its heading is repeated or not.
#[test]
fn a_page_may_be_indented() {
    let first = "\
Time (s)    Speed (km/h)    Pedal (%)
-1.0        60              14
-0.8                        13
Page 3 of 12
";
    let second = "-0.6        58              12\n-0.4                        11\n";
    for by in 0..30 {
        let indented = |text: &str| -> String {
            text.lines().map(|line| format!("{}{line}\n", " ".repeat(by))).collect()
        };
        let table = one(&format!("{first}{}", indented(second)));
        assert_values(&table, Channel::Time, 1.0, &[-1.0, -0.8, -0.6, -0.4]);
        assert_values(&table, Channel::Speed, KMH, &[60.0, NONE, 58.0, NONE]);
        assert_values(&table, Channel::Accelerator, 1.0, &[14.0, 13.0, 12.0, 11.0]);
        let heading = first.lines().next().unwrap();
        let again = format!("{first}{}", indented(&format!("{heading}\n{second}")));
        let tables = read_tables(&again).unwrap();
        assert_values(&tables[0], Channel::Speed, KMH, &[60.0, NONE]);
        assert_values(&tables[1], Channel::Speed, KMH, &[58.0, NONE]);
        assert_values(&tables[1], Channel::Accelerator, 1.0, &[12.0, 11.0]);
    }
}

/// With the times across, a missing value is where no value stands below its time.
#[test]
fn an_empty_cell_below_a_time_shifts_no_other() {
    let text = "\
Time (sec)                     -2.0    -1.0    0
Vehicle Speed (km/h)           SNA     67      62
Service Brake   (On, Off)      Off             On
ABS Activity                           Off     On
";
    let table = one(text);
    assert_eq!(table.layout, TextLayout::Transposed);
    assert_values(&table, Channel::Speed, KMH, &[NONE, 67.0, 62.0]);
    assert_values(&table, Channel::Brake, 1.0, &[0.0, NONE, 1.0]);
    assert_values(&table, Channel::Abs, 1.0, &[NONE, 0.0, 1.0]);
    let refusal = refused(
        &text.replace("                           Off     On", "                        Off        On"),
    );
    assert_eq!(refusal.place.map(|place| (place.line, place.column)), Some((4, 37)), "{refusal}");
}

/// Numbers from SplitMix64.
struct Draw(u64);

impl Draw {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        usize::try_from((mixed ^ (mixed >> 31)) % end as u64).unwrap()
    }

    fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())]
    }
}

/// A text in a field of so many characters: on the left, on the right, or in the middle.
fn justified(text: &str, width: usize, side: usize) -> String {
    match side {
        0 => format!("{text:<width$}"),
        1 => format!("{text:>width$}"),
        _ => format!("{text:^width$}"),
    }
}

/// Headings of a quantity, with the lines of each after a bar; `Other` are not to be read.
const HEADINGS: [(Channel, &[&str]); 9] = [
    (Channel::Time, &["Time (s)", "Time|(s)", "Times (sec)"]),
    (Channel::Speed, &["Vehicle Speed (km/h)", "Vehicle|Speed (km/h)", "Speed, Vehicle|Indicated|(km/h)"]),
    (Channel::Other, &["Wheel Speed (km/h)", "Wheel|Speed (km/h)", "Wheel|Speed|(km/h)"]),
    (Channel::EngineSpeed, &["Engine RPM", "Engine|Speed (rpm)", "Engine|Speed|(rpm)"]),
    (Channel::Accelerator, &["Accelerator Pedal (%)", "Accelerator|Pedal (%)", "Accelerator|Pedal|(%)"]),
    (Channel::Throttle, &["Engine Throttle (%)", "Engine|Throttle (%)", "Engine|Throttle|(%)"]),
    (Channel::Brake, &["Service Brake", "Service|Brake", "Service|Brake|(On, Off)"]),
    (Channel::DeltaVLongitudinal, &["Longitudinal|Delta-V (km/h)", "Longitudinal|Delta-V|(km/h)"]),
    (Channel::DeltaVLateral, &["Lateral|Delta-V (km/h)", "Lateral|Delta-V|(km/h)"]),
];

/// A table as drawn: its text, and the values of each quantity.
struct Drawn {
    text: String,
    columns: Vec<(Channel, Vec<Option<f64>>)>,
    /// Whether it is as regular as reports are.
    is_plain: bool,
}

fn drawn(draw: &mut Draw) -> Drawn {
    let rows = 2 + draw.below(6);
    let blanks = draw.one_of(&[0, 0, 15, 40]);
    let mut quantities: Vec<usize> = (1..HEADINGS.len()).collect();
    while quantities.len() > 5 || (quantities.len() > 1 && draw.below(3) > 0) {
        quantities.remove(draw.below(quantities.len()));
    }
    for at in (1..quantities.len()).rev() {
        quantities.swap(at, draw.below(at + 1));
    }
    let time_at = if draw.below(6) == 0 { draw.below(quantities.len() + 1) } else { 0 };
    quantities.insert(time_at, 0);
    // Two axes side by side may have their quantity over both.
    let both = quantities.windows(2).position(|pair| pair == [7, 8] || pair == [8, 7]);
    let both = both.filter(|_| draw.below(2) == 0);
    let [side, head_side, bottom] = [draw.below(3), draw.below(3), draw.below(4).min(1)];
    let head_side = if draw.below(2) == 0 { side } else { head_side };
    let (gap, indent) = (2 + draw.below(6), draw.below(5));
    let mut cells: Vec<Vec<String>> = Vec::new();
    let mut lines: Vec<Vec<&str>> = Vec::new();
    let mut columns = Vec::new();
    for (at, quantity) in quantities.iter().enumerate() {
        let (channel, headings) = HEADINGS[*quantity];
        let is_under = both.is_some_and(|both| both == at || both + 1 == at);
        let heading = draw.one_of(headings);
        let own: Vec<&str> = heading.split('|').collect();
        lines.push(if is_under { own[..1].to_vec() } else { own });
        let mut values = Vec::new();
        let mut texts = Vec::new();
        for row in 0..rows {
            let tenths = draw.below(99);
            let (text, value) = match channel {
                Channel::Time => {
                    let time = (row as f64 - rows as f64 + 1.0) / 2.0;
                    (format!("{time:.1}"), time)
                }
                Channel::Brake => {
                    let (text, value) = draw.one_of(&[("On", 1.0), ("Off", 0.0)]);
                    (text.to_owned(), value)
                }
                Channel::EngineSpeed => (format!("{}", 600 + 10 * tenths), 600.0 + 10.0 * tenths as f64),
                Channel::DeltaVLateral | Channel::DeltaVLongitudinal => {
                    (format!("-{tenths}"), -(tenths as f64) * KMH)
                }
                Channel::Speed => (format!("{tenths}"), tenths as f64 * KMH),
                _ => (format!("{tenths}"), tenths as f64),
            };
            let is_blank = channel != Channel::Time && draw.below(100) < blanks;
            texts.push(if is_blank { String::new() } else { text });
            values.push((!is_blank).then_some(value));
        }
        cells.push(texts);
        columns.push((channel, values));
    }
    let widest = |at: usize| {
        let all = cells[at].iter().map(String::as_str).chain(lines[at].iter().copied());
        all.map(|text| text.chars().count()).max().unwrap_or(0)
    };
    let mut widths: Vec<usize> =
        (0..cells.len()).map(|at| widest(at) + draw.below(4) * draw.below(2)).collect();
    let over = "Delta-V (km/h)";
    if let Some(both) = both {
        widths[both] = widths[both].max(over.len() / 2);
        widths[both + 1] = widths[both + 1].max(over.len() / 2);
    }
    let depth = lines.iter().map(Vec::len).max().unwrap_or(1).max(if both.is_some() { 2 } else { 1 });
    let mut text = if draw.below(5) == 0 { "Pre-Crash Data\n".to_owned() } else { String::new() };
    let margin = " ".repeat(indent);
    for line in 0..depth {
        let mut whole = margin.clone();
        let mut at = 0;
        while at < lines.len() {
            let is_over = both == Some(at) && line + 2 == depth;
            let width = widths[at] + if is_over { gap + widths[at + 1] } else { 0 };
            let is_under = both.is_some_and(|both| both == at || both + 1 == at);
            let top = if bottom == 1 || is_under { depth - lines[at].len() } else { 0 };
            let own = line.checked_sub(top).and_then(|line| lines[at].get(line)).copied().unwrap_or("");
            let shown = if is_over { justified(over, width, 2) } else { justified(own, width, head_side) };
            whole += &(shown + &" ".repeat(gap));
            at += if is_over { 2 } else { 1 };
        }
        text += whole.trim_end();
        text.push('\n');
    }
    let turned = draw.below(rows * 3);
    let moved = " ".repeat(draw.below(12));
    for row in 0..rows {
        let mut whole = margin.clone();
        if turned > 0 && row == turned {
            text += "Page 3 of 12\n";
        }
        if turned > 0 && row >= turned {
            whole += &moved;
        }
        for (column, width) in cells.iter().zip(&widths) {
            whole += &(justified(&column[row], *width, side) + &" ".repeat(gap));
        }
        text += whole.trim_end();
        text.push('\n');
    }
    let is_plain = turned >= rows && head_side == side && bottom == 1 && blanks < 40;
    Drawn { text, columns, is_plain }
}

/// Tables in drawn layouts, with empty cells, headings of one to three lines and pages, are read exactly or
/// refused.
#[test]
fn a_drawn_table_is_read_exactly_or_refused() {
    let [mut plain, mut plain_read, mut read, total] = [0, 0, 0, 2_000];
    for seed in 0..total {
        let table = drawn(&mut Draw(seed));
        // With a value in each line, and no other, columns are no longer to be seen.
        let quantities = || table.columns.iter().filter(|(channel, _)| *channel != Channel::Time);
        if quantities().all(|(_, values)| values.iter().all(Option::is_none)) {
            continue;
        }
        plain += u64::from(table.is_plain);
        let Ok(tables) = read_tables(&table.text) else { continue };
        let said = || format!("seed {seed}\n{}{tables:#?}", table.text);
        assert_eq!(tables.len(), 1, "{}", said());
        for (channel, expected) in table.columns.iter().filter(|(channel, _)| *channel != Channel::Other) {
            let found = tables[0].values(*channel);
            let same = |(one, other): (&Option<f64>, &Option<f64>)| match (one, other) {
                (Some(one), Some(other)) => (one - other).abs() < 1e-9,
                (one, other) => one.is_none() && other.is_none(),
            };
            assert!(found.len() == expected.len() && found.iter().zip(expected).all(same), "{}", said());
        }
        let known = table.columns.iter().filter(|(channel, _)| *channel != Channel::Other).count();
        assert_eq!(tables[0].columns.len(), known, "{}", said());
        read += 1;
        plain_read += u64::from(table.is_plain);
    }
    println!("{read} of {total} drawn tables are read, {plain_read} of the {plain} plain ones");
    assert!(
        plain_read * 10 > plain * 9 && read * 10 > total * 7,
        "{plain_read} of {plain}, {read} of {total}"
    );
}
