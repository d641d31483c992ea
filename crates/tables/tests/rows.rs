//! A row in, a row out: other rows do not matter, and a bad row is reported in its place.

use std::ops::ControlFlow;
use std::sync::Arc;

use arrow_array::cast::AsArray as _;
use arrow_array::types::{Float64Type, Int32Type};
use arrow_array::{
    ArrayRef, BooleanArray, DictionaryArray, Float32Array, Float64Array, Int64Array, LargeStringArray,
    RecordBatch, StringArray, StringViewArray, StructArray, UInt8Array, new_null_array,
};
use arrow_schema::{DataType, Field, Schema};
use case::EXAMPLE;
use proptest::prelude::*;
use tables::{
    Job, Numbers, RowOptions, RowTemplate, TableError, case_schema, columns_kept, result_schema, run,
};

fn template() -> RowTemplate {
    RowTemplate::parse("template.toml", EXAMPLE).unwrap()
}

fn doubles(values: &[Option<f64>]) -> ArrayRef {
    Arc::new(Float64Array::from(values.to_vec()))
}

fn batch(columns: Vec<(&str, ArrayRef)>) -> RecordBatch {
    RecordBatch::try_from_iter(columns).unwrap()
}

fn rows(job: Job, batch: &RecordBatch) -> Result<RecordBatch, TableError> {
    run(job, batch, &template(), &RowOptions::default(), &|_, _| ControlFlow::Continue(()))
}

fn errors(results: &RecordBatch) -> Vec<Option<String>> {
    let column = results.column_by_name("error").unwrap().as_string::<i32>();
    column.iter().map(|error| error.map(str::to_owned)).collect()
}

fn speeds(results: &RecordBatch) -> Vec<Option<f64>> {
    results.column_by_name("vehicle1_speed").unwrap().as_primitive::<Float64Type>().iter().collect()
}

fn refusal(columns: Vec<(&str, ArrayRef)>) -> String {
    rows(Job::Reconstruct, &batch(columns)).unwrap_err().to_string()
}

/// A unit in the name that contradicts the one in the metadata is refused; another spelling of it is not.
#[test]
fn two_units_of_a_column_have_to_agree() {
    let with_metadata = |name: &str, unit: &str| {
        let field = Field::new(name, DataType::Float64, true);
        let field = field.with_metadata([("unit".to_owned(), unit.to_owned())].into());
        RecordBatch::try_new(Arc::new(Schema::new(vec![field])), vec![doubles(&[Some(30.0)])]).unwrap()
    };
    for name in ["vehicle2.speed [mph]", "vehicle2__speed__mph"] {
        let refused = rows(Job::Reconstruct, &with_metadata(name, "km/h")).unwrap_err().to_string();
        assert!(refused.contains("\"mph\", which differs from \"km/h\" in its metadata"), "{refused}");
    }
    let one = rows(Job::Reconstruct, &with_metadata("vehicle2.speed [km/h]", "kph")).unwrap();
    let other = rows(Job::Reconstruct, &with_metadata("vehicle2.speed", "km/h")).unwrap();
    assert_eq!(speeds(&one), speeds(&other));
}

/// Each sentence names the key; the good rows around have the same results as alone.
#[test]
fn a_bad_row_has_a_sentence() {
    let results = rows(
        Job::Reconstruct,
        &batch(vec![
            ("id", Arc::new(Int64Array::from(vec![1, 2, 3, 4, 5, 6, 7]))),
            (
                "vehicle2.mass [kg]",
                doubles(&[None, Some(-1.0), Some(f64::NAN), Some(f64::INFINITY), None, Some(1e30), None]),
            ),
            (
                "vehicle2.speed",
                Arc::new(StringArray::from(vec![
                    None,
                    None,
                    None,
                    None,
                    Some("10 furlongs"),
                    None,
                    Some("10 mph"),
                ])),
            ),
        ]),
    );
    // The template has the weight of vehicle 2: one of the two has to be removed.
    let results = results.unwrap();
    let errors = errors(&results);
    let error = |row: usize| errors[row].as_deref().unwrap();
    assert_eq!(errors[0], None);
    assert!(error(1).contains("\"vehicle2.mass\" is -1 kg, but must be greater than zero"), "{}", error(1));
    assert!(error(2).contains("vehicle2.mass: \"NaN kg\" is not a finite number"), "{}", error(2));
    assert!(error(3).contains("vehicle2.mass: \"inf kg\" is not a finite number"), "{}", error(3));
    assert!(
        error(4).contains("vehicle2.speed: \"10 furlongs\" has an unknown unit \"furlongs\""),
        "{}",
        error(4)
    );
    assert!(error(5).contains("\"1e30 kg\" is implausibly large for a mass"), "{}", error(5));
    assert_eq!(errors[6], None);
    assert_eq!(speeds(&results)[0], speeds(&results)[6]);
    assert!(speeds(&results)[1..6].iter().all(Option::is_none));
}

#[test]
fn what_contradicts_itself_is_told_in_the_row() {
    let sd = StructArray::from(vec![
        (Arc::new(Field::new("value", DataType::Float64, true)), doubles(&[Some(4.0), None])),
        (Arc::new(Field::new("sd", DataType::Float64, true)), doubles(&[Some(-0.5), Some(0.5)])),
    ]);
    let results = rows(Job::Reconstruct, &batch(vec![("vehicle2.speed", Arc::new(sd))])).unwrap();
    let errors = errors(&results);
    assert!(errors[0].as_deref().unwrap().contains("vehicle2.speed.sd"), "{errors:?}");
    // A spread alone is put about the value of the template.
    assert_eq!(errors[1], None);
    let depths = batch(vec![
        ("vehicle1.crush.depths[1] [in]", doubles(&[Some(20.0), Some(20.0)])),
        ("vehicle1.crush.depths[2] [in]", doubles(&[None, Some(10.0)])),
        ("vehicle1.crush.depths[3] [in]", doubles(&[Some(5.0), None])),
    ]);
    let results = rows(Job::Reconstruct, &depths).unwrap();
    let errors = self::errors(&results);
    assert_eq!(
        errors[0].as_deref(),
        Some(
            "value 2 of \"vehicle1.crush.depths\" is null, but value 3 is not: a list ends at its first null"
        )
    );
    assert_eq!(errors[1], None);
}

#[test]
fn a_table_that_cannot_be_read_is_refused_in_a_sentence() {
    let one = || doubles(&[Some(1.0)]);
    let text = || -> ArrayRef { Arc::new(StringArray::from(vec!["a"])) };
    for (name, array, says) in [
        ("vehicle1_mass_kg", one(), "as \"vehicle1.mass_kg\""),
        ("vehicle1.mas [kg]", one(), "did you mean \"mass\"?"),
        ("vehicle1.mass_kg", one(), "write the unit in brackets, as \"mass [kg]\""),
        ("vehicle1.mass [mph]", one(), "is none of a mass; write one of kg"),
        ("vehicle1.mass [furlong]", one(), "is none of a mass"),
        ("vehicle1__mass__furlong", one(), "neither a key nor a unit \"furlong\""),
        ("impact.restitution [m]", one(), "does not have; leave it out"),
        ("vehicle1.name", one(), "has the type Float64, but a text is needed"),
        ("vehicle1.mass", Arc::new(BooleanArray::from(vec![true])), "but a number is needed"),
        ("vehicle1.crush.depths", one(), "but a list of numbers is needed"),
        ("vehicle1.crush", one(), "but a word is needed, as text, or a struct of its keys"),
        ("vehicle1.fixed", one(), "true or false is needed"),
        ("vehicle1.contact", text(), "a struct of its keys is needed"),
        ("surface.zone", text(), "a list of structs is needed"),
        ("vehicle1.mass[2]", one(), "\"vehicle1.mass\" is not a list"),
        ("seed", Arc::new(BooleanArray::from(vec![true])), "a seed is a whole number"),
    ] {
        let sentence = refusal(vec![(name, array)]);
        assert!(sentence.contains(name) && sentence.contains(says), "{sentence}");
    }
    let sentence = refusal(vec![("vehicle1.mass [kg]", one()), ("vehicle1.mass [lb]", one())]);
    assert_eq!(
        sentence,
        "the columns \"vehicle1.mass [kg]\" and \"vehicle1.mass [lb]\" both give vehicle1.mass: leave one out"
    );
    let inside = StructArray::from(vec![(Arc::new(Field::new("mas", DataType::Float64, true)), one())]);
    assert!(refusal(vec![("vehicle1", Arc::new(inside))]).contains("did you mean \"mass\"?"));
}

/// No type that a table can have causes a panic.
#[test]
fn columns_of_every_type_are_read_or_refused() {
    let schema = case_schema(Numbers::Ranges);
    let mut names = vec!["seed".to_owned(), "title".to_owned()];
    crate::fixtures::each_key(&mut |path, _| names.push(path.to_owned()));
    let types = [
        DataType::Null,
        DataType::Boolean,
        DataType::Int8,
        DataType::UInt64,
        DataType::Float32,
        DataType::Float64,
        DataType::Utf8,
        DataType::LargeUtf8,
        DataType::Utf8View,
        DataType::Binary,
        DataType::Date32,
        DataType::Decimal128(10, 2),
        DataType::Dictionary(Box::new(DataType::Int32), Box::new(DataType::Utf8)),
        DataType::new_list(DataType::Float64, true),
        DataType::new_large_list(DataType::Utf8, true),
        DataType::new_fixed_size_list(DataType::Float32, 3, true),
        schema.field_with_name("vehicle1").unwrap().data_type().clone(),
    ];
    let template = template();
    let mut read = 0;
    for name in &names {
        for data_type in &types {
            let batch = RecordBatch::try_new(
                Arc::new(Schema::new(vec![Field::new(name, data_type.clone(), true)])),
                vec![new_null_array(data_type, 1)],
            );
            let go_on = |_, _| ControlFlow::Continue(());
            match run(Job::Reconstruct, &batch.unwrap(), &template, &RowOptions::default(), &go_on) {
                Ok(results) => {
                    // Nothing but nulls: the template.
                    assert_eq!(errors(&results), [None], "{name} {data_type}");
                    read += 1;
                }
                Err(error) => assert!(error.to_string().contains(name), "{name} {data_type}: {error}"),
            }
        }
    }
    assert!(read > 500, "{read} read");
}

#[test]
fn a_table_without_rows_has_the_columns_of_results() {
    for (_, job) in Job::WORDS {
        let none = batch(vec![("vehicle2.speed [mph]", Arc::new(Float64Array::from(Vec::<f64>::new())))]);
        let results = rows(job, &none).unwrap();
        assert_eq!((results.num_rows(), results.schema()), (0, result_schema(job, &RowOptions::default())));
        let no_columns = RecordBatch::new_empty(Arc::new(Schema::empty()));
        assert_eq!(rows(job, &no_columns).unwrap().num_rows(), 0);
    }
}

/// Names that SQL and Spark accept, and types that they have.
#[test]
fn columns_of_results_have_plain_names_and_types() {
    for (_, job) in Job::WORDS {
        let samples = matches!(job, Job::Reconstruct | Job::Impact).then_some(64);
        let schema = result_schema(job, &RowOptions { samples, ..RowOptions::default() });
        let mut names: Vec<&str> = schema.fields().iter().map(|field| field.name().as_str()).collect();
        for field in schema.fields() {
            let is_plain =
                field.name().bytes().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == b'_');
            assert!(is_plain && !field.data_type().is_unsigned_integer(), "{field}");
        }
        names.sort_unstable();
        let count = names.len();
        names.dedup();
        assert_eq!(names.len(), count, "{job:?}");
    }
    let input = case_schema(Numbers::Ranges).to_string();
    assert!(!input.contains("UInt"));
    crate::fixtures::each_key(&mut |path, key| {
        assert!(!key.name.contains(['.', ' ']), "{path}");
    });
}

/// Every text type, every number type, dictionaries and nulls give the same results.
#[test]
fn types_of_columns_do_not_matter() {
    let sides = ["right", "left"];
    let keys = arrow_array::Int32Array::from(vec![Some(0), Some(1), None]);
    let dictionary: DictionaryArray<Int32Type> =
        DictionaryArray::new(keys, Arc::new(StringArray::from(sides.to_vec())));
    let texts = || vec![Some(sides[0]), Some(sides[1]), None];
    let columns: [ArrayRef; 4] = [
        Arc::new(StringArray::from(texts())),
        Arc::new(LargeStringArray::from(texts())),
        Arc::new(StringViewArray::from(texts())),
        Arc::new(dictionary),
    ];
    let results =
        columns.map(|column| rows(Job::Reconstruct, &batch(vec![("vehicle2.crush.side", column)])).unwrap());
    assert!(results.iter().all(|one| *one == results[0]));
    let numbers: [ArrayRef; 4] = [
        Arc::new(UInt8Array::from(vec![9, 10])),
        Arc::new(Int64Array::from(vec![9, 10])),
        Arc::new(Float32Array::from(vec![9.0, 10.0])),
        Arc::new(StringArray::from(vec!["9", "10"])),
    ];
    let results =
        numbers.map(|column| rows(Job::Reconstruct, &batch(vec![("vehicle2.speed [mph]", column)])).unwrap());
    assert!(results.iter().all(|one| *one == results[0]));
    assert!(errors(&results[0]).iter().all(Option::is_none));
}

#[test]
fn own_columns_are_kept_and_do_not_matter() {
    let schema = Schema::new(vec![
        Field::new("id", DataType::Int64, true),
        Field::new("vehicle2.speed [mph]", DataType::Float64, true),
        Field::new("impact", DataType::Boolean, true),
        Field::new("source", DataType::Int64, true),
        Field::new("impact_type", DataType::Utf8, true),
        Field::new("seed", DataType::Int64, true),
        Field::new("year", DataType::Utf8, true),
    ]);
    assert_eq!(columns_kept(&schema).unwrap(), [0, 2, 3, 4, 6]);
}

#[test]
fn a_run_can_be_ended() {
    let many = batch(vec![("vehicle2.speed [mph]", doubles(&vec![Some(9.0); 10_000]))]);
    let ended = run(Job::Reconstruct, &many, &template(), &RowOptions::default(), &|done, _| {
        if done >= 50 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let Err(TableError::Ended { finished, total: 10_000 }) = ended else { panic!("{ended:?}") };
    // The rows that were done, in their order and without a gap: but for those that other threads had begun.
    let rows = finished.num_rows();
    assert!((40..10_000).contains(&rows), "{rows}");
    assert_eq!(finished.column_by_name("error").unwrap().null_count(), rows);
}

#[test]
fn options_that_make_no_sense_are_refused() {
    let one = batch(vec![("vehicle2.speed [mph]", doubles(&[Some(9.0)]))]);
    let refused = |job: Job, options: RowOptions| {
        run(job, &one, &template(), &options, &|_, _| ControlFlow::Continue(())).unwrap_err().to_string()
    };
    let samples = |samples: usize| RowOptions { samples: Some(samples), ..RowOptions::default() };
    assert!(refused(Job::Crush, samples(1000)).contains("the job is crush: leave them out"));
    assert!(refused(Job::Reconstruct, samples(1)).contains("too few"));
    assert!(
        refused(Job::Estimate, RowOptions { particles: 100, ..RowOptions::default() })
            .contains("multiple of 128")
    );
    // They would change nothing.
    for without_effect in [
        RowOptions { particles: 128, ..RowOptions::default() },
        RowOptions { prior: Some(case::SeverityPrior::Flat), ..RowOptions::default() },
    ] {
        assert!(refused(Job::Reconstruct, without_effect).contains("the job is reconstruct: leave them out"));
    }
}

fn speeds_and_masses() -> impl Strategy<Value = Vec<(Option<f64>, Option<f64>, Option<i64>)>> {
    let speed = prop_oneof![4 => (-40.0..40.0).prop_map(Some), 1 => Just(None), 1 => Just(Some(f64::NAN))];
    let weight =
        prop_oneof![4 => (5e3..3e4).prop_map(Some), 1 => Just(None), 1 => (-1.0..1.0).prop_map(Some)];
    let seed = prop_oneof![(0_i64..5).prop_map(Some), Just(None)];
    prop::collection::vec((speed, weight, seed), 1..24)
}

fn table_of(rows: &[(Option<f64>, Option<f64>, Option<i64>)]) -> RecordBatch {
    batch(vec![
        ("vehicle2.speed", doubles(&rows.iter().map(|row| row.0).collect::<Vec<_>>())),
        ("vehicle2__weight__N", doubles(&rows.iter().map(|row| row.1).collect::<Vec<_>>())),
        ("seed", Arc::new(Int64Array::from(rows.iter().map(|row| row.2).collect::<Vec<_>>()))),
    ])
}

/// The words of a list in each row.
fn words(results: &RecordBatch, column: &str) -> Vec<Vec<String>> {
    let lists = results.column_by_name(column).unwrap().as_list::<i32>();
    let of = |list: ArrayRef| list.as_string::<i32>().iter().flatten().map(str::to_owned).collect();
    lists.iter().map(|list| of(list.unwrap())).collect()
}

/// A lateral ΔV of −26 km/h agrees with the other evidence, and one of 80 km/h in the other direction with
/// nothing. In a record that the recorder did not finish, 150 km/h is a bound above all answers.
#[test]
fn an_estimate_names_what_contradicts_it_and_its_warnings() {
    let text = include_str!("../../../fixtures/estimate.toml");
    let template = RowTemplate::parse("t.toml", text).unwrap();
    let columns = batch(vec![
        ("vehicle2.recorder.delta_v_lateral [km/h]", Arc::new(Float64Array::from(vec![-26.0, 80.0, -150.0]))),
        ("vehicle2.recorder.incomplete", Arc::new(BooleanArray::from(vec![false, false, true]))),
    ]);
    let options = RowOptions { particles: 128, seed: 3, ..RowOptions::default() };
    let results =
        run(Job::Estimate, &columns, &template, &options, &|_, _| ControlFlow::Continue(())).unwrap();
    assert_eq!(errors(&results), [None, None, None]);
    let [agrees, reversed, bounded] = &words(&results, "contradicting")[..] else { panic!() };
    assert!(agrees.is_empty() && bounded.is_empty(), "{agrees:?} {bounded:?}");
    assert!(reversed.iter().any(|key| key.starts_with("vehicle2.recorder")), "{reversed:?}");
    let bound = "vehicle2.below-record".to_owned();
    let warned: Vec<bool> = words(&results, "warnings").iter().map(|codes| codes.contains(&bound)).collect();
    assert_eq!(warned, [false, false, true]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    /// Neither its neighbours, nor its place, nor the batch: a row is what it is alone.
    #[test]
    fn rows_do_not_know_each_other(rows in speeds_and_masses(), at in 0_usize..24) {
        let options = RowOptions { samples: Some(64), ..RowOptions::default() };
        let template = RowTemplate::parse("t.toml", &EXAMPLE.replace("\"10 mph\"", "{ value = \"10 mph\", sd = \"1 mph\" }").replace("weight      = \"3696 lb\"", "weight = { value = \"3696 lb\", sd = \"50 lb\" }")).unwrap();
        let solve = |rows: &[(Option<f64>, Option<f64>, Option<i64>)]| {
            run(Job::Reconstruct, &table_of(rows), &template, &options, &|_, _| ControlFlow::Continue(())).unwrap()
        };
        let all = solve(&rows);
        let at = at % rows.len();
        for (place, row) in rows.iter().enumerate() {
            prop_assert_eq!(&solve(&[*row]), &all.slice(place, 1));
        }
        let turned: Vec<_> = rows.iter().rev().copied().collect();
        let (first, second) = turned.split_at(at);
        let parts = [first, second].map(solve);
        for place in 0..rows.len() {
            let other = rows.len() - 1 - place;
            let row = if other < at { parts[0].slice(other, 1) } else { parts[1].slice(other - at, 1) };
            prop_assert_eq!(&row, &all.slice(place, 1));
        }
        // A part of a batch has offsets of its own.
        let sliced = table_of(&rows).slice(at, rows.len() - at);
        let results = run(Job::Reconstruct, &sliced, &template, &options, &|_, _| ControlFlow::Continue(())).unwrap();
        prop_assert_eq!(&results, &all.slice(at, rows.len() - at));
    }
}

/// Columns that look like a key and are not one, and a table without any key: every row would be the
/// template.
#[test]
fn no_table_is_the_template_in_silence() {
    let one = || doubles(&[Some(10.0)]);
    for (column, help) in [
        ("Vehicle2.Speed [mph]", "small letters"),
        ("VEHICLE2__SPEED__MPH", "small letters"),
        ("VEHICLE2.SPEED [mph]", "small letters"),
        ("v2.speed", "\"vehicle1.speed\" or \"vehicle2.speed\""),
        ("car__speed", "\"vehicle1.speed\""),
        (
            "mass [kg]",
            "\"vehicle1.mass\" or \"vehicle2.mass\"? If the column is not meant as a key, rename it",
        ),
        ("crush_plane [deg]", "\"impact.crush_plane\""),
        ("crush.depths [cm]", "\"vehicle1.crush.depths\" or \"vehicle2.crush.depths\""),
        ("pdof__deg", "\"vehicle1.crush.pdof\""),
        ("depths[2] [in]", "\"vehicle1.crush.depths[2]\""),
        ("Seed", "write \"seed\" in small letters"),
        ("note", "no column of the table is a key of a case"),
        ("id;vehicle2.speed [mph]", "did you mean \"vehicle1.speed\" or \"vehicle2.speed\""),
        ("\u{1b}[31mred", "␛[31mred"),
    ] {
        let message = refusal(vec![(column, one())]);
        assert!(message.contains(help), "{column}: {message}");
        assert!(!message.contains('\u{1b}'), "{message}");
        assert!(columns_kept(batch(vec![(column, one())]).schema_ref()).is_err(), "{column}");
    }
    // A column of the table's own in addition to one key, with dots and a unit.
    for own in ["weather.temperature [C]", "Speed", "driver.age", "mass", "mass [C]", "restitution"] {
        let results = rows(
            Job::Reconstruct,
            &batch(vec![(own, one()), ("vehicle2.speed [mph]", doubles(&[Some(10.0)]))]),
        );
        assert_eq!(errors(&results.unwrap()), [None], "{own}");
    }
}

/// An empty list is not the same as an omitted list.
#[test]
fn an_empty_list_is_refused_in_its_row() {
    use arrow_array::ListArray;
    let lists = ListArray::from_iter_primitive::<Float64Type, _, _>(vec![
        None,
        Some(vec![]),
        Some(vec![Some(0.2), Some(0.3)]),
    ]);
    let results =
        rows(Job::Reconstruct, &batch(vec![("vehicle1.crush.depths [m]", Arc::new(lists))])).unwrap();
    let [None, Some(empty), _] = &errors(&results)[..] else { panic!("{:?}", errors(&results)) };
    assert!(empty.contains("empty list") && empty.contains("leave it null"), "{empty}");
}

/// Decimal numbers, as SQL has them, and halves are the doubles nearest to them.
#[test]
fn decimals_and_halves_are_numbers() {
    use arrow_array::types::Float16Type;
    use arrow_array::{ArrowPrimitiveType, Decimal128Array, Float16Array};
    type Half = <Float16Type as ArrowPrimitiveType>::Native;
    let of = |column: ArrayRef| {
        let results = rows(Job::Reconstruct, &batch(vec![("vehicle2.speed [mph]", column)])).unwrap();
        assert!(errors(&results).iter().all(Option::is_none));
        speeds(&results)
    };
    let plain = of(doubles(&[Some(10.25), None, Some(20.3)]));
    let decimals = Decimal128Array::from(vec![Some(1025), None, Some(2030)]).with_precision_and_scale(10, 2);
    assert_eq!(of(Arc::new(decimals.unwrap())), plain);
    let same = doubles(&[Some(10.25), None, Some(20.0)]);
    let halves =
        Float16Array::from_iter([Some(10.25), None, Some(20.0)].map(|value| value.map(Half::from_f64)));
    assert_eq!(of(Arc::new(halves)), of(same));
}

/// A number without a unit is in SI units, and the columns with such numbers are reported.
#[test]
fn assumed_units_are_told() {
    let texts = |texts: Vec<&str>| -> ArrayRef { Arc::new(StringArray::from(texts)) };
    let of = |columns: Vec<(&str, ArrayRef)>| tables::assumed_units(&batch(columns)).unwrap();
    let told = |column: &str, unit: &'static str| vec![(column.to_owned(), unit)];
    assert_eq!(of(vec![("vehicle2.speed", doubles(&[Some(4.0)]))]), told("vehicle2.speed", "m/s"));
    assert_eq!(of(vec![("vehicle2.speed", texts(vec!["4"]))]), told("vehicle2.speed", "m/s"));
    assert_eq!(of(vec![("vehicle1__crush__depths", texts(vec!["0.1 0.2"]))]).len(), 1);
    assert!(of(vec![("vehicle2.speed", texts(vec!["4 mph"]))]).is_empty());
    assert!(of(vec![("vehicle2.speed [mph]", doubles(&[Some(4.0)]))]).is_empty());
    assert!(of(vec![("impact.restitution", doubles(&[Some(0.1)]))]).is_empty());
    assert!(of(vec![("vehicle2.speed", doubles(&[None]))]).is_empty());
}

/// sicher-auto-30-50: 6.5 m/s² after 1 s, 20 m ahead: 28.73 m to the stop from 50 km/h, and 39.19 km/h just
/// avoid it. From 60 km/h with 1 s: 16.67 + 21.37 m. A row without a demand says so.
#[test]
fn a_table_asks_whether_collisions_were_avoidable() {
    let table = batch(vec![
        ("avoid.speed [km/h]", doubles(&[Some(50.0), Some(60.0), Some(50.0)])),
        ("avoid.limit [km/h]", doubles(&[Some(30.0), Some(40.0), Some(30.0)])),
        ("avoid.reaction_time [s]", doubles(&[Some(1.0); 3])),
        ("avoid.deceleration [m/s^2]", doubles(&[Some(6.5); 3])),
        ("avoid.demand.distance [m]", doubles(&[Some(20.0), Some(20.0), None])),
    ]);
    let options = RowOptions::default();
    let go_on = |_, _| ControlFlow::Continue(());
    let results = run(Job::Avoid, &table, &RowTemplate::default(), &options, &go_on).unwrap();
    let errors = errors(&results);
    assert_eq!(&errors[..2], [None, None]);
    assert!(errors[2].as_ref().unwrap().contains("avoid.demand"), "{errors:?}");
    let numbers = |name: &str| -> Vec<Option<f64>> {
        results.column_by_name(name).unwrap().as_primitive::<Float64Type>().iter().collect()
    };
    let near = |name: &str, expected: [f64; 2]| {
        for (found, expected) in numbers(name).into_iter().zip(expected) {
            assert!((found.unwrap() - expected).abs() < 0.005, "{name}: {found:?}, not {expected}");
        }
    };
    near("avoid_stopping_distance", [28.73, 38.03]);
    near("avoid_spatial_speed", [39.187 / 3.6, 39.187 / 3.6]);
    // √((40/3.6)² − 13 (20 − 40/3.6)), by hand.
    near("avoid_at_limit_collision_speed", [0.0, 2.81]);
    assert_eq!(numbers("avoid_temporal_speed"), [None; 3]);
    let flags = results.column_by_name("avoid_spatial_avoidable_at_limit").unwrap().as_boolean();
    assert_eq!(flags.iter().collect::<Vec<_>>(), [Some(true), Some(false), None]);
    // With ranges, a probability: the limit is avoided with a reaction below 20/v − v/2a of the range.
    let ranges = batch(vec![
        ("avoid.speed [km/h]", doubles(&[Some(60.0)])),
        ("avoid.limit [km/h]", doubles(&[Some(36.0)])),
        ("avoid.reaction_time.low [s]", doubles(&[Some(0.5)])),
        ("avoid.reaction_time.high [s]", doubles(&[Some(2.0)])),
        ("avoid.deceleration [m/s^2]", doubles(&[Some(5.0)])),
        ("avoid.demand.distance [m]", doubles(&[Some(20.0)])),
        ("avoid.unbraked", Arc::new(BooleanArray::from(vec![true]))),
    ]);
    let options = RowOptions { samples: Some(4_000), ..RowOptions::default() };
    let results = run(Job::Avoid, &ranges, &RowTemplate::default(), &options, &go_on).unwrap();
    let column = results.column_by_name("avoid_probability_avoided_at_limit").unwrap();
    let probability = column.as_primitive::<Float64Type>().value(0);
    // 36 km/h: 10 m of braking, and 10 m in 1 s: a third of the range.
    assert!((probability - 1.0 / 3.0).abs() < 0.03, "{probability}");
}

/// The results of one row, which is a case as a template.
fn avoided(case: &str) -> RecordBatch {
    alone(Job::Avoid, case, &RowOptions::default())
}

/// From a stop, 8 m with 1.6 m/s² on the first 6: the vehicle never reaches a limit of 50 km/h. With a
/// reaction of 0.3 s it stops before the other's path, whatever would happen from 50 km/h at the demand.
#[test]
fn a_vehicle_from_a_stop_is_asked_at_the_speed_that_it_reaches() {
    let case = include_str!("../../../fixtures/avoid/from-stop.toml");
    let lines = case.lines().map(|line| match line.split_whitespace().next() {
        Some("limit") => "limit = \"50 km/h\"",
        Some("reaction_time") => "reaction_time = \"0.3 s\"",
        _ => line,
    });
    let results = avoided(&lines.collect::<Vec<_>>().join("\n"));
    assert_eq!(errors(&results), [None]);
    let left = results.column_by_name("avoid_at_limit_collision_speed").unwrap();
    assert_eq!(left.as_primitive::<Float64Type>().value(0), 0.0);
    for kind in ["spatial", "temporal"] {
        let column = results.column_by_name(&format!("avoid_{kind}_avoidable_at_limit")).unwrap();
        assert!(column.as_boolean().value(0), "{kind}");
    }
}

/// 12 m/s² is 1.22 g, more than any road is listed with; and a barrier, which does not move, has no ΔV.
#[test]
fn a_row_of_avoidability_has_its_warnings_and_no_delta_v_of_a_barrier() {
    let barrier = include_str!("../../../fixtures/barrier.toml");
    let avoid = "[avoid]\nvehicle = \"vehicle1\"\nlimit = \"20 km/h\"\nreaction_time = \"0.8 s\"\n\
                 deceleration = \"12 m/s^2\"\ndemand = { distance = \"4 m\" }\n";
    let results = avoided(&format!("{barrier}\n{avoid}"));
    assert_eq!(errors(&results), [None]);
    let [warnings] = &words(&results, "warnings")[..] else { panic!() };
    assert!(warnings.iter().any(|warning| warning.contains("is 1.22 g")), "{warnings:?}");
    let delta_v = |id: u8| {
        let column = results.column_by_name(&format!("avoid_at_limit_vehicle{id}_delta_v")).unwrap();
        column.as_primitive::<Float64Type>().iter().next().unwrap()
    };
    assert!(delta_v(1).unwrap() > 1.0);
    assert_eq!(delta_v(2), None);
}

/// All speeds but those of 0.05 km/h are excluded: hardly a collision is possible.
#[test]
fn a_row_of_avoidability_without_a_probability_says_why() {
    let within = |low: &str, high: &str| {
        format!("certain_speed = {{ at_least = \"{low} km/h\", at_most = \"{high} km/h\" }}\nmass")
    };
    let case = include_str!("../../../fixtures/avoid/evidence.toml")
        .replacen("mass", &within("46.95", "47"), 1)
        .replacen("mass = \"1320", &format!("{} = \"1320", within("30", "30.1")), 1);
    let results = avoided(
        &case.replace("\"50 km/h\", source = \"built-up area\"", "\"30 km/h\", source = \"built-up area\""),
    );
    let [Some(error)] = &errors(&results)[..] else { panic!() };
    assert!(error.contains("did not converge"), "{error}");
    let speed = results.column_by_name("avoid_speed").unwrap();
    assert!(speed.is_valid(0));
    let probability = results.column_by_name("avoid_probability_avoided_at_limit").unwrap();
    assert!(probability.is_null(0));
}

#[test]
fn the_metadata_of_an_estimate_have_the_prior_that_was_asked_for() {
    let prior = |prior| {
        let schema = result_schema(Job::Estimate, &RowOptions { prior, ..RowOptions::default() });
        schema.metadata().get("deltav.prior").cloned()
    };
    assert_eq!(prior(None), None);
    assert_eq!(prior(Some(case::SeverityPrior::Flat)).as_deref(), Some("flat"));
}

/// The row of a case alone, by this job.
fn alone(job: Job, case: &str, options: &RowOptions) -> RecordBatch {
    let one = batch(vec![("seed", Arc::new(Int64Array::from(vec![1])))]);
    let template = RowTemplate::parse("../../fixtures/t.toml", case).unwrap();
    run(job, &one, &template, options, &|_, _| ControlFlow::Continue(())).unwrap()
}

fn text<'a>(results: &'a RecordBatch, column: &str) -> Option<&'a str> {
    let column = results.column_by_name(column).unwrap().as_string::<i32>();
    column.iter().next().unwrap()
}

fn list(results: &RecordBatch, column: &str) -> Vec<String> {
    let column = results.column_by_name(column).unwrap().as_list::<i32>().value(0);
    column.as_string::<i32>().iter().map(|word| word.unwrap().to_owned()).collect()
}

const FEW: RowOptions = RowOptions { samples: None, seed: 1, particles: 128, prior: None };

/// Its interval would look like any other.
#[test]
fn an_estimate_of_evidence_that_contradicts_itself_is_no_answer() {
    let case = include_str!("../../../fixtures/roots/hidden-root.toml");
    let results = alone(Job::Estimate, case, &FEW);
    assert!(text(&results, "error").unwrap().starts_with("the evidence contradicts itself"));
    assert!(results.column_by_name("converged").unwrap().as_boolean().value(0));
    for column in ["vehicle1_speed_median", "vehicle1_speed_p025", "vehicle1_delta_v_p975"] {
        assert!(results.column_by_name(column).unwrap().is_null(0), "{column}");
    }
}

/// Crush energies tell how much was lost, and hardly which vehicle was how fast.
#[test]
fn a_row_names_what_the_evidence_does_not_determine() {
    let damaged = |id: u8, heading: u16, side: &str| {
        format!(
            "[vehicle{id}]\nmass = \"1600 kg\"\nclass = 4\nheading = \"{heading} deg\"\n[vehicle{id}.crush]\n\
             side = \"{side}\"\nwidth = \"150 cm\"\noffset = \"0 cm\"\ndepths = \"10 20 30 30 20 10 cm\"\nstiffness.category = 3\n"
        )
    };
    let case = format!(
        "[impact]\nrestitution = 0.1\ntangential = \"critical\"\ncrush_plane = \"0 deg\"\n{}{}",
        damaged(1, 0, "front"),
        damaged(2, 90, "right")
    );
    let results = alone(Job::Estimate, &case, &FEW);
    assert_eq!(text(&results, "error"), None);
    let open = list(&results, "undetermined");
    assert!(open.iter().any(|output| output == "vehicle2.speed"), "{open:?}");
    assert!(!open.iter().any(|output| output == "vehicle1.delta_v"), "{open:?}");
    assert!(list(&results, "same_twice").is_empty());
    // With a PDOF beside the ΔV of a recorder, whose direction says the same.
    let twice = case.replacen("[vehicle1.crush]", "[vehicle1.crush]\npdof = \"0 deg\"", 1)
        + "[vehicle1.recorder]\ndelta_v_longitudinal = \"-30 km/h\"\ndelta_v_lateral = \"0 km/h\"\n";
    let pair = "vehicle1.crush.pdof vehicle1.recorder.delta_v_lateral";
    assert!(list(&alone(Job::Estimate, &twice, &FEW), "same_twice").iter().any(|keys| keys == pair));
}

/// What single cases lead with, the row says of its exact solution.
#[test]
fn a_row_says_whether_its_exact_solution_is_the_answer() {
    let led = |case: &str| {
        let results = alone(Job::Reconstruct, case, &RowOptions::default());
        assert_eq!(errors(&results), [None]);
        (text(&results, "headline_by").map(str::to_owned), list(&results, "left_aside"))
    };
    let by = |word: &str| Some(word.to_owned());
    assert_eq!(led(EXAMPLE), (by("exact"), Vec::new()));
    assert_eq!(led(include_str!("../../../fixtures/t-bone-category.toml")).0, by("none"));
    let recorded = EXAMPLE.to_owned() + "[vehicle1.recorder]\nspeed = \"22 m/s\"\n";
    assert_eq!(led(&recorded), (by("none"), vec!["vehicle1.recorder.speed".to_owned()]));
}

/// A row of avoidability tells a speed that the evidence gives from one that it leaves open.
#[test]
fn a_row_of_avoidability_names_the_source_of_its_speed() {
    let results = avoided(include_str!("../../../fixtures/avoid/evidence.toml"));
    assert_eq!(text(&results, "avoid_speed_source"), Some("estimate"));
    assert!(results.column_by_name("avoid_speed_determined").unwrap().as_boolean().value(0));
}

/// A table of a recorder in a file is sought beside the template.
#[test]
fn a_file_of_a_recorder_is_read_beside_the_template() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("recorded");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("r.csv"), "time (s),speed (mph)\n-1.0,30\n-0.5,30\n0.0,30\n").unwrap();
    let name = folder.join("t.toml").display().to_string();
    let template = RowTemplate::parse(&name, EXAMPLE).unwrap();
    let files = |name: &str| {
        let file = batch(vec![(
            "vehicle1.recorder.pre_crash.file",
            Arc::new(StringArray::from(vec![name])) as ArrayRef,
        )]);
        run(Job::Reconstruct, &file, &template, &RowOptions::default(), &|_, _| ControlFlow::Continue(()))
            .unwrap()
    };
    let read = files("r.csv");
    assert_eq!(errors(&read), [None]);
    assert_eq!(list(&read, "left_aside"), ["vehicle1.recorder.pre_crash"]);
    let error = errors(&files("none.csv")).remove(0).unwrap();
    assert!(error.contains("cannot read none.csv"), "{error}");
}
