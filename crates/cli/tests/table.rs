//! Tables: CSV and Parquet have the same results, with any number of threads, and in parts.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::collections::HashMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::Arc;

use arrow_array::cast::AsArray as _;
use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, StringArray, StructArray};
use arrow_schema::{DataType, Field};
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;

const TEMPLATE: &str = "fixtures/sae-980025.toml";

fn deltav(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_deltav")).current_dir("../..").args(arguments).output().unwrap()
}

fn place(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("tables");
    fs::create_dir_all(&folder).unwrap();
    folder.join(name)
}

fn write_parquet(path: &Path, batch: &RecordBatch) {
    let mut writer = ArrowWriter::try_new(File::create(path).unwrap(), batch.schema(), None).unwrap();
    writer.write(batch).unwrap();
    writer.close().unwrap();
}

fn read_parquet(path: &Path) -> (HashMap<String, String>, Vec<RecordBatch>) {
    let builder = ParquetRecordBatchReaderBuilder::try_new(File::open(path).unwrap()).unwrap();
    let metadata = builder.schema().metadata().clone();
    (metadata, builder.with_batch_size(1 << 20).build().unwrap().map(Result::unwrap).collect())
}

fn speed(row: usize) -> f64 {
    // Every hundredth goes in the other direction, too fast for an answer.
    if row % 100 == 7 { -1e5 } else { 0.25 * (row % 40) as f64 }
}

/// More rows than are read at a time.
const ROWS: usize = 9000;

fn flat() -> RecordBatch {
    let ids: ArrayRef = Arc::new(Int64Array::from_iter_values((0..ROWS).map(|row| row as i64)));
    let speeds: ArrayRef = Arc::new(Float64Array::from_iter_values((0..ROWS).map(speed)));
    RecordBatch::try_from_iter([("id", ids), ("vehicle2.speed [m/s]", speeds)]).unwrap()
}

fn nested() -> RecordBatch {
    let ids: ArrayRef = Arc::new(Int64Array::from_iter_values((0..ROWS).map(|row| row as i64)));
    let speeds: ArrayRef = Arc::new(Float64Array::from_iter_values((0..ROWS).map(speed)));
    let vehicle = StructArray::from(vec![(Arc::new(Field::new("speed", DataType::Float64, true)), speeds)]);
    let texts: ArrayRef =
        Arc::new(StringArray::from_iter_values((0..ROWS).map(|row| format!("not read {row}"))));
    RecordBatch::try_from_iter([("note", texts), ("id", ids), ("vehicle2", Arc::new(vehicle))]).unwrap()
}

#[test]
fn parquet_and_csv_say_the_same() {
    let (flat_path, nested_path, csv_path) =
        (place("flat.parquet"), place("nested.parquet"), place("rows.csv"));
    write_parquet(&flat_path, &flat());
    write_parquet(&nested_path, &nested());
    let mut csv = "id,vehicle2.speed\n".to_owned();
    for row in 0..ROWS {
        csv.push_str(&format!("{row},{}\n", speed(row)));
    }
    fs::write(&csv_path, csv).unwrap();
    let text = |path: &Path, threads: &str| {
        let output = deltav(&[
            "table",
            path.to_str().unwrap(),
            "--template",
            TEMPLATE,
            "--keep",
            "id",
            "--threads",
            threads,
        ]);
        assert_eq!(output.status.code(), Some(1));
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(error.ends_with("error: 90 of 9000 rows have an error: see the column error\n"), "{error}");
        String::from_utf8(output.stdout).unwrap()
    };
    let expected = text(&flat_path, "1");
    assert_eq!(expected.lines().count(), ROWS + 1);
    for (path, threads) in [(&flat_path, "3"), (&nested_path, "2"), (&csv_path, "2")] {
        assert!(text(path, threads) == expected, "{} on {threads} threads", path.display());
    }

    // And Parquet out has the numbers of the CSV.
    let out = place("results.parquet");
    let output =
        deltav(&["table", flat_path.to_str().unwrap(), "--template", TEMPLATE, "-o", out.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(1));
    let (metadata, batches) = read_parquet(&out);
    assert_eq!(batches.iter().map(RecordBatch::num_rows).sum::<usize>(), ROWS);
    let mut reader = csv::Reader::from_reader(expected.as_bytes());
    let header = reader.headers().unwrap().clone();
    let delta_v = header.iter().position(|name| name == "vehicle1_delta_v").unwrap();
    let rows = batches.iter().flat_map(|batch| {
        let column = batch.column_by_name("vehicle1_delta_v").unwrap();
        let column = column.as_primitive::<arrow_array::types::Float64Type>();
        column.iter().collect::<Vec<_>>()
    });
    for (found, record) in rows.zip(reader.records()) {
        let record = record.unwrap();
        let text = record.get(delta_v).unwrap();
        let expected = (!text.is_empty()).then(|| text.parse::<f64>().unwrap());
        assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits));
    }
    assert_eq!(metadata.get("deltav.job").map(String::as_str), Some("reconstruct"));

    // The output is read again as input: its columns are not keys.
    let again = deltav(&["table", out.to_str().unwrap(), "--template", TEMPLATE]);
    assert_eq!(again.status.code(), Some(2));
    let error = String::from_utf8(again.stderr).unwrap();
    assert!(error.contains("\"impact_restitution\" is not a key"), "{error}");
}

#[test]
fn an_output_does_not_replace_the_table_or_the_template() {
    let path = place("table.csv");
    fs::write(&path, "id\n1\n").unwrap();
    let name = path.to_str().unwrap();
    for arguments in [
        ["table", name, "--template", TEMPLATE, "-o", name],
        ["table", name, "--template", TEMPLATE, "-o", TEMPLATE],
    ] {
        let output = deltav(&arguments);
        assert_eq!(output.status.code(), Some(2));
        assert!(String::from_utf8(output.stderr).unwrap().contains("would overwrite"));
    }
    assert_eq!(fs::read_to_string(&path).unwrap(), "id\n1\n");
}

#[test]
fn what_is_no_parquet_is_refused() {
    let path = place("broken.parquet");
    for (bytes, says) in
        [(&b"id\n1\n"[..], "it does not begin with PAR1"), (b"PAR1 and no more", "cannot read the table")]
    {
        fs::write(&path, bytes).unwrap();
        let output = deltav(&["table", path.to_str().unwrap()]);
        assert_eq!(output.status.code(), Some(2));
        assert!(String::from_utf8(output.stderr).unwrap().contains(says));
    }
}

/// Status, results and messages of a table as CSV, given by its bytes.
fn of_csv(name: &str, bytes: &[u8]) -> (Option<i32>, String, String) {
    let path = place(name);
    fs::write(&path, bytes).unwrap();
    let output = deltav(&["table", path.to_str().unwrap(), "--template", TEMPLATE]);
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

fn column(csv: &str, name: &str) -> Vec<String> {
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let place = reader.headers().unwrap().iter().position(|header| header == name).unwrap();
    reader.records().map(|record| record.unwrap()[place].to_owned()).collect()
}

/// Whatever separates the columns is found and named; the rows are those of commas.
#[test]
fn other_separators_are_found() {
    let plain = of_csv("commas.csv", b"id,vehicle2.speed [mph]\n1,10\n2,40\n");
    assert_eq!(plain.0, Some(0), "{}", plain.2);
    let speeds = column(&plain.1, "vehicle1_speed");
    assert_ne!(speeds[0], speeds[1]);
    for (separator, called) in [(";", "semicolons"), ("\t", "tabs"), ("|", "bars")] {
        let table =
            format!("\u{feff}id{separator}vehicle2.speed [mph]\r\n1{separator}10\r\n2{separator}40\r\n");
        let (status, out, messages) = of_csv("other.csv", table.as_bytes());
        assert_eq!(status, Some(0), "{messages}");
        assert!(messages.contains(&format!("separated by {called}")), "{messages}");
        assert_eq!(column(&out, "vehicle1_speed"), speeds);
    }
}

/// What a spreadsheet saves where the comma is the decimal mark is read, as is what `--csv-style european`
/// writes.
#[test]
fn decimal_commas_are_read_between_semicolons() {
    let points = of_csv(
        "points.csv",
        b"vehicle2.speed [mph],vehicle2.crush.depths [in]\n10.5,8.5 7 6.25\n-2.5,9 8.5\n",
    );
    let commas =
        "note;vehicle2.speed [mph];vehicle2.crush.depths [in]\n1,5;10,5;8,5 7 6,25\na,b;\u{2212}2,5;9 8,5\n";
    let commas = of_csv("commas.csv", commas.as_bytes());
    assert_eq!((points.0, commas.0), (Some(0), Some(0)), "{}{}", points.2, commas.2);
    assert!(commas.2.contains("a comma in a number is a decimal comma"), "{}", commas.2);
    assert_eq!(column(&commas.1, "vehicle1_speed"), column(&points.1, "vehicle1_speed"));
    // A column of the table's own stays as it is.
    assert_eq!(column(&commas.1, "note"), ["1,5", "a,b"]);
    // Where other characters separate the columns, such a number is refused.
    let tabs = of_csv("tabs.csv", b"id\tvehicle2.speed [mph]\n1\t10,5\n");
    assert_eq!(tabs.0, Some(1));
    assert!(column(&tabs.1, "help")[0].contains("10.5"), "{}", tabs.1);
}

/// "1.651" beside decimal commas may be 1651: the table says so once. Points or commas alone pass unremarked.
#[test]
fn points_beside_decimal_commas_are_remarked_once() {
    let told = |rows: &str| {
        let table = format!("vehicle2.weight [lb];vehicle2.speed [mph]\n{rows}");
        let (_, _, messages) = of_csv("marks.csv", table.as_bytes());
        messages.matches("is read with a decimal point").count()
    };
    assert_eq!(told("1.651;10,5\n2.651;10,5\n"), 1);
    assert_eq!(told("1651;10,5\n1.651;10\n"), 1);
    for quiet in ["1.651;10.5\n", "1651,5;10,5\n", "16.51;10,5\n", "0.651;10,5\n"] {
        assert_eq!(told(quiet), 0, "{quiet}");
    }
    let (_, _, messages) =
        of_csv("marks.csv", b"vehicle2.weight [lb];vehicle2.speed [mph]\n3100;10,5\n1.651;9\n");
    assert!(messages.contains("marks.csv:3: \"1.651\" is read"), "{messages}");
    assert!(messages.contains("write 1651 if the point separates thousands"), "{messages}");
}

/// A row with too many or too few fields, or in another encoding, has an error of its own, and is reported
/// with its place before the rows are computed.
#[test]
fn a_wrong_row_costs_that_row_alone() {
    let (status, out, messages) =
        of_csv("wrong.csv", b"id,vehicle2.speed [mph],note\n1,10,a\n2,10\n3,10,b,c\n4,10,\xe9\n5,10,=1+1\n");
    assert_eq!(status, Some(1), "{messages}");
    let errors = column(&out, "error");
    for (row, says) in [
        (1, "wrong.csv:3: the row has 2 fields, and the header has 3: it ends before the column \"note\""),
        (
            2,
            "wrong.csv:4: the row has 4 fields, and the header has 3: \"c\" is beyond the last column, \"note\"",
        ),
        (3, "wrong.csv:5: the column \"note\" is not UTF-8 text"),
    ] {
        assert!(errors[row].contains(says), "{}", errors[row]);
        assert!(messages.contains(says), "{messages}");
    }
    assert!(errors[0].is_empty() && errors[4].is_empty());
    let speeds = column(&out, "vehicle1_speed");
    assert!(speeds[0] == speeds[4] && !speeds[0].is_empty());
    // A text that would be a formula in a spreadsheet stays a text.
    assert_eq!(column(&out, "note")[4], "'=1+1");
}

#[test]
fn what_is_no_table_is_said() {
    for (bytes, says) in [
        (&b""[..], "it has no header"),
        (b"note\n1\n", "no column of the table is a key of a case"),
        (b"id,id,vehicle2.speed [mph]\n1,1,10\n", "two columns are called \"id\""),
        (b"\xff\xfei\0d\0\n\0", "encoded in UTF-16"),
        (b"VEHICLE2__SPEED__MPH\n10\n", "keys are written in small letters"),
    ] {
        let (status, out, messages) = of_csv("none.csv", bytes);
        assert_eq!((status, out.as_str()), (Some(2), ""), "{messages}");
        assert!(messages.contains(says), "{messages}");
    }
}

/// Numbers without a unit are in SI units, which is stated.
#[test]
fn units_that_are_assumed_are_said() {
    let (status, _, messages) = of_csv("si.csv", b"id,vehicle2.speed\n1,10\n");
    assert_eq!(status, Some(0));
    assert!(messages.contains("numbers without a unit are SI: vehicle2.speed in m/s"), "{messages}");
    let (.., messages) = of_csv("units.csv", b"id,vehicle2.speed\n1,10 mph\n");
    assert_eq!(messages, "");
}

#[cfg(unix)]
#[test]
fn a_table_may_come_through_a_pipe() {
    use std::io::Write as _;
    use std::process::Stdio;
    let run = |bytes: &[u8]| {
        let mut child = Command::new(env!("CARGO_BIN_EXE_deltav"))
            .current_dir("../..")
            .args(["table", "/dev/stdin", "--template", TEMPLATE])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        child.stdin.take().unwrap().write_all(bytes).unwrap();
        child.wait_with_output().unwrap()
    };
    let output = run(b"id,vehicle2.speed [mph]\n1,10\n");
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(column(&String::from_utf8(output.stdout).unwrap(), "id"), ["1"]);
    let output = run(b"PAR1 and more\n");
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("cannot come through a pipe"));
}

/// One byte after another of a Parquet file is another: an answer, or a sentence.
#[test]
fn damaged_parquet_is_refused() {
    let (whole, damaged) = (place("whole.parquet"), place("damaged.parquet"));
    write_parquet(&whole, &flat().slice(0, 40));
    let bytes = fs::read(&whole).unwrap();
    let mut refused = 0;
    // The schema of Arrow is near the end, and contains most of the data that a reader relies on.
    for place in (bytes.len() / 2..bytes.len() - 8).step_by(bytes.len() / 120) {
        let mut bytes = bytes.clone();
        bytes[place] ^= 0x5a;
        fs::write(&damaged, &bytes).unwrap();
        let output = deltav(&["table", damaged.to_str().unwrap(), "--template", TEMPLATE]);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(matches!(output.status.code(), Some(0..=2)), "byte {place}: {message}");
        assert!(!message.contains("panicked"), "byte {place}: {message}");
        refused += usize::from(output.status.code() == Some(2));
    }
    assert!(refused > 10, "{refused}");
}

/// The rest of the file would be one cell of that row.
#[test]
fn a_quote_that_nothing_closes_is_refused() {
    let (path, rows) = (place("quote.csv"), place("quote-rows.csv"));
    let table = |cells: &str| {
        fs::write(&path, format!("id,vehicle1.weight [lb],note\n1,3600,{cells}")).unwrap();
        let _ = fs::remove_file(&rows);
        let [from, to] = [&path, &rows].map(|path| path.to_str().unwrap());
        let output = deltav(&["table", from, "--template", TEMPLATE, "-o", to]);
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    let (status, message) = table("\"6\n2,3700,x\n3,3800,y\n");
    assert_eq!(status, Some(2), "{message}");
    assert!(
        message.starts_with("error: ")
            && message.matches("quote.csv").count() == 1
            && message.contains("quote.csv:2: the last cell of this row opens with a double quote"),
        "{message}"
    );
    for whole in [
        "\"6\"\n2,3700,x\n",
        "\"two\nlines\"\n",
        "\"two\nlines\"",
        "x\n2,3700,\"two\nlines\"\n3,3800,y\n",
        "6\"\n",
    ] {
        assert_eq!(table(whole).0, Some(0), "{whole}");
    }
}

#[test]
fn a_column_that_is_named_twice_is_carried_over_once() {
    let path = place("twice.csv");
    fs::write(&path, "id,vehicle2.speed\n7,4\n").unwrap();
    let output =
        deltav(&["table", path.to_str().unwrap(), "--template", TEMPLATE, "--keep", "id,vehicle2.speed,id"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.starts_with("id,vehicle2.speed,error,"), "{text}");
}
