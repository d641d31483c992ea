//! How many rows a second: `cargo run --release -p deltav-tables --example throughput [ROWS] [SAMPLES]`.
//!
//! Each row is the example of SAE 980025 with other weights, headings, speed and depths, as flat columns
//! beside a template and as the nested row of the whole case; the time is that of one thread.

use std::error::Error;
use std::sync::Arc;
use std::time::Instant;

use arrow_array::{ArrayRef, Float64Array, RecordBatch, StructArray};
use arrow_schema::{DataType, Field};
use case::{CaseFile, EXAMPLE};
use tables::{RowOptions, RowTemplate, reconstruct};

/// The varied inputs: a column in its unit, its number in the example, and the variation.
const COLUMNS: [(&str, f64, f64); 17] = [
    ("vehicle1.weight [lb]", 3696.0, 200.0),
    ("vehicle2.weight [lb]", 3413.0, 200.0),
    ("vehicle2.heading [deg]", 67.0, 5.0),
    ("vehicle2.speed [mph]", 10.0, 2.0),
    ("impact.crush_plane [deg]", -23.0, 3.0),
    ("vehicle1.crush.depths[1] [in]", 21.3, 1.0),
    ("vehicle1.crush.depths[2] [in]", 20.3, 1.0),
    ("vehicle1.crush.depths[3] [in]", 13.8, 1.0),
    ("vehicle1.crush.depths[4] [in]", 11.3, 1.0),
    ("vehicle1.crush.depths[5] [in]", 5.3, 1.0),
    ("vehicle1.crush.depths[6] [in]", 4.8, 1.0),
    ("vehicle2.crush.depths[1] [in]", 3.0, 1.0),
    ("vehicle2.crush.depths[2] [in]", 15.8, 1.0),
    ("vehicle2.crush.depths[3] [in]", 13.5, 1.0),
    ("vehicle2.crush.depths[4] [in]", 6.7, 1.0),
    ("vehicle2.crush.depths[5] [in]", 3.3, 1.0),
    ("vehicle2.crush.depths[6] [in]", 5.0, 1.0),
];

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let rows: usize = arguments.next().map_or(Ok(20_000), |rows| rows.parse())?;
    let samples: usize = arguments.next().map_or(Ok(1000), |samples| samples.parse())?;

    let columns = COLUMNS.iter().enumerate().map(|(place, &(name, middle, spread))| {
        let numbers = (0..rows).map(|row| middle + spread * share(row * COLUMNS.len() + place));
        (name, Arc::new(Float64Array::from_iter_values(numbers)) as ArrayRef)
    });
    let columns: Vec<(&str, ArrayRef)> = columns.collect();
    let flat = RecordBatch::try_from_iter(columns.clone())?;
    let template = RowTemplate::parse("sae-980025.toml", EXAMPLE)?;
    timed("flat columns and a template", rows, || reconstruct(&flat, &template, &RowOptions::default()))?;

    // The same numbers as nested structs.
    let field = |name: &str| Arc::new(Field::new(name, DataType::Float64, true));
    let vehicle = |number: usize| -> ArrayRef {
        let of = |key: &str| {
            let name = format!("vehicle{number}.{key}");
            columns
                .iter()
                .filter(move |(column, _)| column.starts_with(&name))
                .map(|(_, array)| array.clone())
        };
        let depths = of("crush.depths");
        let crush =
            depths.enumerate().map(|(place, array)| (field(&format!("depths[{}] [in]", place + 1)), array));
        let crush: ArrayRef = Arc::new(StructArray::from(crush.collect::<Vec<_>>()));
        let weight = of("weight").map(|array| (field("weight [lb]"), array));
        let crush_field = Arc::new(Field::new("crush", crush.data_type().clone(), true));
        Arc::new(StructArray::from(weight.chain([(crush_field, crush)]).collect::<Vec<_>>()))
    };
    let nested = RecordBatch::try_from_iter([("vehicle1", vehicle(1)), ("vehicle2", vehicle(2))])?;
    timed("structs and a template", rows, || reconstruct(&nested, &template, &RowOptions::default()))?;

    let options = RowOptions { samples: Some(samples), ..RowOptions::default() };
    let few = rows.min(2000);
    let uncertain = EXAMPLE.replace("= \"10 mph\"", "= { value = \"10 mph\", sd = \"1 mph\" }");
    let uncertain = uncertain.replace("= \"65 in\"", "= { value = \"65 in\", sd = \"1 in\" }");
    let uncertain = uncertain.replace("restitution = 0.3", "restitution = { value = 0.3, sd = 0.05 }");
    let template_of_ranges = RowTemplate::parse("ranges.toml", &uncertain)?;
    let first = RecordBatch::try_from_iter(
        columns.iter().filter(|(name, _)| *name != "vehicle2.speed [mph]").cloned(),
    )?;
    let first = first.slice(0, few);
    timed(&format!("with {samples} samples"), few, || reconstruct(&first, &template_of_ranges, &options))?;

    // The times of the parts.
    let values = CaseFile::part("part.toml", EXAMPLE)?;
    timed("the reader alone", rows, || -> Result<(), Box<dyn Error>> {
        for _ in 0..rows {
            std::hint::black_box(CaseFile::from_values("row", std::hint::black_box(&values))?);
        }
        Ok(())
    })?;
    let case = CaseFile::parse("case.toml", EXAMPLE)?.case;
    timed("the solution alone", rows, || -> Result<(), Box<dyn Error>> {
        for _ in 0..rows {
            std::hint::black_box(analysis::reconstruct(std::hint::black_box(&case))?);
        }
        Ok(())
    })?;
    timed("a loop over texts", rows, || -> Result<(), Box<dyn Error>> {
        for _ in 0..rows {
            let file = CaseFile::parse("case.toml", std::hint::black_box(EXAMPLE))?;
            std::hint::black_box(analysis::reconstruct(&file.case)?);
        }
        Ok(())
    })
}

/// From −1 to 1, spread evenly: the fractional parts of the multiples of the golden ratio.
fn share(index: usize) -> f64 {
    let golden = 0.618_033_988_749_894_9;
    2.0 * (golden * index as f64).fract() - 1.0
}

#[expect(clippy::print_stdout, reason = "it is what the example is for")]
fn timed<T, E>(what: &str, rows: usize, work: impl Fn() -> Result<T, E>) -> Result<(), E> {
    let mut best = f64::INFINITY;
    for _ in 0..3 {
        let began = Instant::now();
        work()?;
        best = best.min(began.elapsed().as_secs_f64());
    }
    let each = 1e6 * best / rows as f64;
    println!("{what}: {each:.1} µs a row, {:.0} rows a second", 1e6 / each);
    Ok(())
}
