//! Whatever the columns of a table are called and hold, there is a result for each row, or a sentence.
#![no_main]

use std::ops::ControlFlow;
use std::sync::Arc;

use arrow_array::{ArrayRef, RecordBatch, StringArray};
use arrow_schema::{DataType, Field, Schema};
use libfuzzer_sys::fuzz_target;
use tables::{Job, RowOptions, RowTemplate, run};

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let mut lines = text.lines();
    let Some(header) = lines.next() else { return };
    let rows: Vec<Vec<&str>> = lines.take(8).map(|line| line.split(',').collect()).collect();
    let names: Vec<&str> = header.split(',').collect();
    let column = |place: usize| -> ArrayRef {
        let cells = rows.iter().map(|row| row.get(place).copied().filter(|cell| !cell.is_empty()));
        Arc::new(StringArray::from_iter(cells))
    };
    let fields: Vec<Field> = names.iter().map(|name| Field::new(*name, DataType::Utf8, true)).collect();
    let columns = (0..names.len()).map(column).collect();
    let Ok(batch) = RecordBatch::try_new(Arc::new(Schema::new(fields)), columns) else { return };
    let template = RowTemplate::parse("template.toml", case::EXAMPLE).expect("the example is a case");
    for job in [Job::Crush, Job::Impact, Job::Reconstruct] {
        match run(job, &batch, &template, &RowOptions::default(), &|_, _| ControlFlow::Continue(())) {
            Ok(results) => assert_eq!(results.num_rows(), rows.len()),
            Err(error) => assert!(!error.to_string().contains(|letter: char| letter.is_control())),
        }
    }
});
