//! Tables: CSV and Parquet say the same, in any number of threads, and in parts.

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
    // Every hundredth goes the other way, too fast for an answer.
    if row % 100 == 7 { -1e5 } else { 0.25 * (row % 40) as f64 }
}

/// More rows than are read at a time.
const ROWS: usize = 9000;

fn flat() -> RecordBatch {
    let ids: ArrayRef = Arc::new(Int64Array::from_iter_values((0..ROWS).map(|row| row as i64)));
    let speeds: ArrayRef = Arc::new(Float64Array::from_iter_values((0..ROWS).map(speed)));
    RecordBatch::try_from_iter([("id", ids), ("vehicle2.speed", speeds)]).unwrap()
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
        assert_eq!(error, "error: 90 of 9000 rows have an error: see the column error\n");
        String::from_utf8(output.stdout).unwrap()
    };
    let expected = text(&flat_path, "1");
    assert_eq!(expected.lines().count(), ROWS + 1);
    for (path, threads) in [(&flat_path, "3"), (&nested_path, "2"), (&csv_path, "1"), (&csv_path, "2")] {
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

    // What came out goes in again: its columns are no keys.
    let again = deltav(&["table", out.to_str().unwrap(), "--template", TEMPLATE]);
    assert_eq!(again.status.code(), Some(2));
    let error = String::from_utf8(again.stderr).unwrap();
    assert!(error.contains("\"impact_restitution\" is no key"), "{error}");
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
        assert!(String::from_utf8(output.stderr).unwrap().contains("would write over"));
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
