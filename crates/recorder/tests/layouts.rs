//! Tables in the layouts of printed reports, with invented numbers, as they copy out of a PDF.

use recorder::{
    Apart, Channel, CrashPulse, NoValue, PreCrash, RecorderTable, TextFault, TextLayout, columns_table,
    read_rows, read_tables,
};

fn one(text: &str) -> RecorderTable {
    let mut tables = read_tables(text).unwrap();
    assert_eq!(tables.len(), 1, "{tables:?}");
    tables.remove(0)
}

/// The values of a channel in a unit of so much.
fn values(table: &RecorderTable, channel: Channel, unit: f64) -> Vec<f64> {
    table.values(channel).into_iter().map(|value| (value.unwrap() / unit * 1e6).round() / 1e6).collect()
}

const KMH: f64 = 1.0 / 3.6;
const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Bosch CDR: a row in each line, the heading broken over lines, mph with km/h in brackets.
const BOSCH: &str = "\
Pre-Crash Data -5 to 0 sec [2 samples/sec] (First Record)
Times
(sec)
Speed, Vehicle
Indicated
MPH [km/h]
Accelerator
Pedal, % Full
(%)
Service Brake
(On, Off)
Engine RPM
ABS Activity
(Engaged,
Non-Engaged)
Stability
Control
(On, Off)
Steering Wheel
Angle
(degrees)
-2.0 50 [81] 22 1,900 Off Non-Engaged On 0.0
-1.5 50 [80] 0 1,700 Off Non-Engaged On -2.5
-1.0 48 [77] 0 1,500 On Non-Engaged On -5.0
-0.5 40 [64] 0 1,300 On Engaged On -12.5
0.0 32 [52] 0 1,200 On Engaged On Invalid
";

#[test]
fn bosch_with_the_columns_in_another_order_than_the_values_is_told() {
    // The brake's heading is before that of the engine, its values are behind the engine's: a switch cannot
    // read 1,900.
    let table = one(BOSCH);
    let wrong: Vec<_> = table.doubts.iter().filter(|doubt| doubt.channel == Channel::Brake).collect();
    assert_eq!(wrong.len(), 5);
    assert_eq!((wrong[0].place.line, wrong[0].place.column), (22, 17));
}

fn bosch() -> String {
    BOSCH.replace("Service Brake\n(On, Off)\nEngine RPM\n", "Engine RPM\nService Brake\n(On, Off)\n")
}

fn is_bosch(table: &RecorderTable) {
    assert_eq!(values(table, Channel::Time, 1.0), [-2.0, -1.5, -1.0, -0.5, 0.0]);
    assert_eq!(values(table, Channel::Speed, KMH), [81.0, 80.0, 77.0, 64.0, 52.0]);
    assert_eq!(values(table, Channel::Accelerator, 1.0), [22.0, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(values(table, Channel::EngineSpeed, 1.0), [1900.0, 1700.0, 1500.0, 1300.0, 1200.0]);
    assert_eq!(values(table, Channel::Brake, 1.0), [0.0, 0.0, 1.0, 1.0, 1.0]);
    assert_eq!(values(table, Channel::Abs, 1.0), [0.0, 0.0, 0.0, 1.0, 1.0]);
    assert_eq!(values(table, Channel::Stability, 1.0), [1.0; 5]);
    let steering = table.values(Channel::Steering);
    assert_eq!(steering[3].map(|angle| angle / DEGREE), Some(-12.5));
    assert_eq!(steering[4], None);
    assert_eq!(table.doubts.len(), 1, "{:?}", table.doubts);
    assert_eq!(table.doubts[0].reason, NoValue::Word("Invalid".into()));
    assert_eq!(table.column(Channel::Speed).unwrap().unit.name, "km/h");
}

#[test]
fn bosch_with_a_row_in_each_line() {
    let table = one(&bosch());
    assert_eq!(table.layout, TextLayout::RowLines);
    is_bosch(&table);
    let record = PreCrash::from_table(&table).unwrap();
    assert_eq!(record.samples()[4].abs, Some(true));
}

#[test]
fn bosch_with_a_value_in_each_line_and_a_footer_between() {
    let text = bosch();
    let (heading, rows) = text.split_at(text.find("-2.0").unwrap());
    let rows = rows.replace(" [", "_[").replace(' ', "\n").replace("_[", " [");
    let rows = rows.replacen("-1.0\n", "CDR File Information\nPage 3 of 12 Printed on: Monday\n-1.0\n", 1);
    let table = one(&format!("{heading}{rows}"));
    assert_eq!(table.layout, TextLayout::RowAfterRow);
    is_bosch(&table);
}

#[test]
fn bosch_with_column_after_column() {
    let text = bosch();
    let (heading, rows) = text.split_at(text.find("-2.0").unwrap());
    let rows = rows.replace(" [", "_[");
    let rows: Vec<Vec<&str>> = rows.lines().map(|row| row.split(' ').collect()).collect();
    let columns: Vec<String> =
        (0..8).flat_map(|k| rows.iter().map(move |row| row[k].replace("_[", " ["))).collect();
    let table = one(&format!("{heading}{}", columns.join("\n")));
    assert_eq!(table.layout, TextLayout::ColumnAfterColumn);
    is_bosch(&table);
}

#[test]
fn bosch_delta_v_of_both_axes() {
    let text = "\
Longitudinal Crash Pulse (First Record)
Time
(msec)
Delta-V, longitudinal
(MPH)
Delta-V, longitudinal
(km/h)
0 0.0 0.0
10 -1.2 -2.0
20 -5.6 -9.0
30 -9.9 -16.0
40 -11.2 -18.0
Lateral Crash Pulse (First Record)
Time
(msec)
Delta-V, lateral
(MPH)
Delta-V, lateral
(km/h)
0 0.0 0.0
10 0.6 1.0
20 1.9 3.0
30 2.5 4.0
40 78.9 127.0
";
    let tables = read_tables(text).unwrap();
    assert_eq!(tables.len(), 2);
    assert_eq!(values(&tables[0], Channel::Time, 1.0), [0.0, 0.01, 0.02, 0.03, 0.04]);
    // The unit with the finer step of the two is read: a tenth of 1 km/h.
    let printed: Vec<f64> = values(&tables[0], Channel::DeltaVLongitudinal, KMH);
    assert_eq!(printed, [0.0, -2.0, -9.0, -16.0, -18.0]);
    assert_eq!(tables[0].ignored[0].0, "Delta-V, longitudinal (MPH)");
    // 127 km/h is the code for no value.
    assert_eq!(tables[1].doubts[0].reason, NoValue::Code("127.0".into()));
    assert_eq!((tables[1].doubts[0].place.line, tables[1].doubts[0].place.column), (24, 9));
    let [along, across] = [0, 1].map(|k| CrashPulse::from_table(&tables[k]).unwrap());
    let both = along.with(&across);
    // The lateral pulse ends alone.
    assert_eq!(both.samples().len(), 5);
    assert_eq!(both.samples()[4].lateral, None);
    assert!((both.samples()[3].lateral.unwrap() - 4.0 * KMH).abs() < 1e-12);
}

/// Toyota: a quantity in each row, and times across that end with the trigger.
const TOYOTA: &str = "\
Pre-Crash Data, -5 to 0 seconds (Most Recent Event, TRG 2)
Time (sec) -4.6 -3.6 -2.6 -1.6 -0.6 0 (TRG)
Vehicle Speed (MPH [km/h]) 36 [58] 35 [56] 35 [56] 32 [52] 22 [36] 17 [28]
Brake Switch OFF OFF OFF ON ON ON
Accelerator Rate (V) 0.78 0.78 0.78 0.78 0.78 0.78
Engine RPM (RPM) 1,200 1,200 1,200 800 800 400
";

#[test]
fn toyota_with_times_across() {
    // The voltage of the pedal's sensor is not its position in per cent: the row has a unit that is not known
    // for it.
    let error = read_tables(TOYOTA);
    let table = error.map_or_else(|error| panic!("{error}"), |mut tables| tables.remove(0));
    assert_eq!(table.layout, TextLayout::Transposed);
    is_toyota(&table);
}

fn is_toyota(table: &RecorderTable) {
    assert_eq!(values(table, Channel::Time, 1.0), [-4.6, -3.6, -2.6, -1.6, -0.6, 0.0]);
    assert_eq!(values(table, Channel::Speed, KMH), [58.0, 56.0, 56.0, 52.0, 36.0, 28.0]);
    assert_eq!(values(table, Channel::Brake, 1.0), [0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
    assert_eq!(values(table, Channel::EngineSpeed, 1.0), [1200.0, 1200.0, 1200.0, 800.0, 800.0, 400.0]);
    assert!(table.column(Channel::Accelerator).is_none());
}

#[test]
fn toyota_with_each_label_above_its_values() {
    let text = TOYOTA
        .replace(") -4.6", ")\n-4.6")
        .replace("]) 36", "])\n36")
        .replace("Speed (MPH", "Speed\n(MPH")
        .replace("h OFF OFF", "h\nOFF\nOFF")
        .replace(") 1,200", ")\n1,200\n")
        .replace("0 (TRG)", "0\n(TRG)");
    is_toyota(&one(&text));
}

/// UN R160: a table of the data elements in their order, with semicolons and decimal commas.
const R160: &str = "\
Data element;Time;Speed, vehicle indicated;Engine throttle, % full (or accelerator pedal, % full);Service brake, on/off;\
ABS activity;Steering input;Longitudinal acceleration;Maker's counter
;s;km/h;%;;;deg;g;
;-1,5;63;12;off;not active;-5;-0,05;7
;-1,0;63;0;off;not active;-5;-0,10;7
;-0,5;61;0;on;active;0;-0,85;8
;0,0;255;0;on;active;5;-1,00;8
";

#[test]
fn un_r160_with_semicolons() {
    let table = one(R160);
    assert_eq!(table.layout, TextLayout::Delimited(';'));
    assert_eq!(values(&table, Channel::Time, 1.0), [-1.5, -1.0, -0.5, 0.0]);
    assert_eq!(table.values(Channel::Speed)[2].map(|speed| (speed * 3.6).round()), Some(61.0));
    assert_eq!(table.values(Channel::Speed)[3], None);
    assert_eq!(table.doubts[0].reason, NoValue::Code("255".into()));
    assert_eq!((table.doubts[0].place.line, table.doubts[0].place.column), (6, 6));
    assert_eq!(values(&table, Channel::Throttle, 1.0), [12.0, 0.0, 0.0, 0.0]);
    assert_eq!(values(&table, Channel::Abs, 1.0), [0.0, 0.0, 1.0, 1.0]);
    assert_eq!(values(&table, Channel::Steering, DEGREE), [-5.0, -5.0, 0.0, 5.0]);
    assert_eq!(values(&table, Channel::AccelerationLongitudinal, 9.80665), [-0.05, -0.1, -0.85, -1.0]);
    assert!(table.ignored.iter().any(|(heading, _)| heading == "Maker's counter"), "{:?}", table.ignored);
}

#[test]
fn un_r160_out_of_a_pdf_with_tabs_commas_and_aligned_columns() {
    let csv = "time_s,speed_kmh,brake,\"Longitudinal delta-V (km/h)\"\n0.5,63,0,0\n1.0,60,1,-1\n";
    let rows = [
        ("\t", TextLayout::Delimited('\t')),
        (",", TextLayout::Delimited(',')),
        ("   ", TextLayout::Aligned),
    ];
    for (between, layout) in rows {
        let table = one(&csv.replace(',', between).replace('"', if between == "," { "\"" } else { "" }));
        assert_eq!(table.layout, layout);
        assert_eq!(values(&table, Channel::Speed, KMH), [63.0, 60.0]);
        assert_eq!(values(&table, Channel::DeltaVLongitudinal, KMH), [0.0, -1.0]);
        assert_eq!(values(&table, Channel::Brake, 1.0), [0.0, 1.0]);
    }
    // A heading in quotes may run over several lines, as in spreadsheets; its place is that of its first
    // line.
    let broken = "\"Time\n(sec)\",\"Speed\n(km/h)\",Service Brake\n-1.0,50,Off\n-0.5,O.9,On\n0,45,On\n";
    let table = one(broken);
    assert_eq!(table.values(Channel::Speed)[0], Some(50.0 * KMH));
    assert_eq!(values(&table, Channel::Brake, 1.0), [0.0, 1.0, 1.0]);
    let far = broken.replace("-1.0", "-100").replace("-0.5,O", "-50,4");
    let error = read_tables(&far).unwrap_err().to_string();
    assert!(error.starts_with("line 4, column 1: the time \"-100\" is beyond -60 to 60"), "{error}");
    let across = "Time (s);-1;-0.5;0\nVehicle speed (km/h);50;48;SNA\nBrake;off;on;on\n";
    let table = one(across);
    assert_eq!(table.layout, TextLayout::Transposed);
    assert_eq!(table.values(Channel::Speed)[2], None);
    assert_eq!(values(&table, Channel::Brake, 1.0), [0.0, 1.0, 1.0]);
}

#[test]
fn times_that_count_down_or_run_backward_rise_in_what_is_read() {
    let table = one("Time (s),Speed (km/h)\n1.0,50\n0.5,48\n0.0,40\n");
    assert!(table.counted_down);
    assert_eq!(values(&table, Channel::Time, 1.0), [-1.0, -0.5, 0.0]);
    assert_eq!(values(&table, Channel::Speed, KMH), [50.0, 48.0, 40.0]);
    let table = one("Time (s),Speed (km/h)\n0,40\n-0.5,48\n-1.0,50\n");
    assert!(!table.counted_down);
    assert_eq!(values(&table, Channel::Speed, KMH), [50.0, 48.0, 40.0]);
}

#[test]
fn what_is_no_value_is_told_with_its_place() {
    let text = "Time (s),Speed (km/h),Accelerator (%),Brake,Engine rpm,Longitudinal delta-V (km/h)\n\
                -2.0,254,101,maybe,16320,126\n\
                -1.5,255,127,7,N/A,-128\n\
                -1.0,Data Not Available,-128,on,,127\n\
                0.0,50,0,off,900,0\n\
                0.5,50,0,off,900,0\n";
    let table = one(text);
    let told: Vec<String> = table.doubts.iter().map(ToString::to_string).collect();
    let expected = [
        ((2, 6), "254"),
        ((2, 10), "101"),
        ((2, 14), "maybe"),
        ((2, 20), "16320"),
        ((2, 26), "126"),
        ((3, 6), "255"),
        ((3, 10), "127"),
        ((3, 14), "7"),
        ((3, 16), "N/A"),
        ((3, 20), "-128"),
        ((4, 1), "a sample is missing"),
        ((4, 6), "Data Not Available"),
        ((4, 25), "-128"),
        ((4, 33), "empty"),
        ((4, 34), "127"),
    ];
    assert_eq!(told.len(), expected.len(), "{told:#?}");
    for (doubt, ((line, column), word)) in told.iter().zip(expected) {
        assert!(doubt.starts_with(&format!("line {line}, column {column}, ")), "{doubt}");
        assert!(doubt.contains(word), "{doubt}");
    }
}

#[test]
fn what_gives_no_table_is_refused_with_its_place() {
    let refused = |text: &str| read_tables(text).unwrap_err();
    assert_eq!(refused(" \n "), TextFault::Empty.into());
    let begins = "The weather was fine.".to_owned();
    assert_eq!(refused("The weather was fine.\n1 2 3\n"), TextFault::NoHeading { begins }.into());
    let place = |text: &str| refused(text).place.map(|place| (place.line, place.column));
    for (text, at, word) in [
        ("Time (s),Speed (knots)\n0,3\n", (1, 10), "mph"),
        ("Time,Speed (km/h)\n0,3\n", (1, 1), "ms"),
        ("Time (s),Speed (km/h)\n-1,3\n-2,3\n0,3\n", (3, 1), "follows -1"),
        ("Time (s),Speed (km/h)\n-3,3\n-2,3\n-1,3\n-5,3\n", (5, 1), "most times rise"),
        ("Time (s),Speed (km/h)\n-1,3\n-1,3\n0,3\n", (3, 1), "-1 s appears twice"),
        ("Time (s),Speed (km/h)\n-1,3\nInvalid,3\n0,3\n", (3, 1), "Invalid"),
        ("Time (s),Weather (km/h)\n-1,3\n0,3\n", (1, 1), "known are"),
        ("Time (s),Speed (km/h)\n-1,3,4\n0,3\n0.5,3\n", (2, 1), "3 values"),
        ("Time (s) Speed (km/h) Brake\n-1 50 on\n-0.5 48\n0 40 on\n", (3, 1), "2 values"),
        ("Time (s) -1 -0.5 0\nVehicle speed (km/h) 50 48\n", (2, 22), "2 values"),
        ("Vehicle speed (km/h) 50 48\nBrake on off on\n", (1, 1), "no times here"),
        ("Time (s) Speed (km/h) Brake\n", (1, 1), "no values"),
    ] {
        assert_eq!(place(text), Some(at), "{text}: {}", refused(text));
        assert!(refused(text).to_string().contains(word), "{text}: {}", refused(text));
    }
}

#[test]
fn a_title_that_names_a_quantity_is_no_column() {
    let text =
        "Longitudinal delta-V, 0 to 250 ms\nTime (ms)\nDelta-V, longitudinal\n(km/h)\n0 0\n10 -4\n20 -9\n";
    let table = one(text);
    assert_eq!(values(&table, Channel::Time, 1.0), [0.0, 0.01, 0.02]);
    assert_eq!(values(&table, Channel::DeltaVLongitudinal, KMH), [0.0, -4.0, -9.0]);
}

#[test]
fn columns_that_stand_apart() {
    let table = columns_table(&[
        (Channel::Time, "-1 -0.5 0 s"),
        (Channel::Speed, "60 58 255 km/h"),
        (Channel::Brake, "off on on"),
    ]);
    let table = table.unwrap();
    assert_eq!(values(&table, Channel::Time, 1.0), [-1.0, -0.5, 0.0]);
    assert_eq!(table.values(Channel::Speed)[2], None);
    assert_eq!(table.doubts[0].place.column, 7);
    assert_eq!(values(&table, Channel::Brake, 1.0), [0.0, 1.0, 1.0]);
    let refused = |columns: &[(Channel, &str)]| columns_table(columns).unwrap_err();
    let (channel, refusal) = refused(&[(Channel::Time, "-1 0 s"), (Channel::Speed, "60 58 40 km/h")]);
    assert_eq!((channel, refusal.place.unwrap().column), (Channel::Speed, 7));
    let (channel, refusal) = refused(&[(Channel::Time, "-1 0 s"), (Channel::Speed, "60 58")]);
    assert_eq!(channel, Channel::Speed);
    assert!(
        refusal.fault.to_string().starts_with("these values have no unit that is known for a speed"),
        "{}",
        refusal.fault.to_string()
    );
    let (channel, refusal) = refused(&[(Channel::Time, "-1 0 -2 s"), (Channel::Speed, "6 5 4 km/h")]);
    assert_eq!((channel, refusal.place.unwrap().column), (Channel::Time, 4));
}

#[test]
fn velocity_is_speed_and_its_change_is_not() {
    let speeds = one("Time (s)  Velocity (km/h)\n-2 60\n-1 55\n0 50\n");
    assert_eq!(values(&speeds, Channel::Speed, KMH), [60.0, 55.0, 50.0]);
    let change = one("Time (ms)  Velocity Change (km/h)\n0 0\n10 -5\n20 -9\n");
    assert!(change.column(Channel::Speed).is_none());
    assert_eq!(values(&change, Channel::DeltaVLongitudinal, KMH), [0.0, -5.0, -9.0]);
}

/// Two records of a vehicle and one of another, as NHTSA publishes them: one row for each value.
const LONG: &str = "\
CASEID,VEHNO,EDRSUMMNO,EDREVENTNO,PCODE,PTIME,PVALUE,CASEWGT
30123,1,1,1,1010,-1.0,58,12.5
30123,1,1,1,1010,-0.5,51,12.5
30123,1,1,1,1010,0.0,40,12.5
30123,1,1,1,1040,-1.0,0,12.5
30123,1,1,1,1040,0.0,1,12.5
30123,1,1,1,1080,-1.0,99997,12.5
30123,1,1,1,1010,9996,33,12.5
30123,1,1,1,1090,0.0,5,12.5
30123,1,1,2,1010,-1.0,41,12.5
30123,1,1,2,1010,0.0,39,12.5
30123,2,1,1,1010,-1.0,20,12.5
30123,2,1,1,2010,0,0,12.5
30123,2,1,1,2010,20,-11,12.5
30123,2,1,1,2020,20,3,12.5
";

#[test]
fn a_long_table_of_nhtsa_is_read_by_its_codes() {
    let tables = read_rows(LONG, "VEHNO 1, EDREVENTNO 1").unwrap();
    assert_eq!(tables.len(), 1);
    let table = &tables[0];
    assert_eq!(table.times(), [-1.0, -0.5, 0.0]);
    let kmh = |value: &Option<f64>| value.map(|si| (si * 36.0).round() / 10.0);
    let speeds: Vec<Option<f64>> = table.values(Channel::Speed).iter().map(kmh).collect();
    assert_eq!(speeds, [Some(58.0), Some(51.0), Some(40.0)]);
    assert_eq!(table.values(Channel::Brake), [Some(0.0), None, Some(1.0)]);
    assert_eq!(table.values(Channel::Steering), [None; 3]);
    assert_eq!(table.ignored.iter().map(|(text, _)| text.as_str()).collect::<Vec<_>>(), ["PCODE 1090"]);
    let doubts: Vec<String> = table.doubts.iter().map(ToString::to_string).collect();
    for told in [
        "line 7, column 23, steering wheel: 99997 is the recorder's code",
        "line 8, column 18, time: 9996 is the recorder's code",
    ] {
        assert!(doubts.iter().any(|doubt| doubt.starts_with(told)), "{told}: {doubts:#?}");
    }
    // Both tables of a record in one text: times before the impact are in s, those within it in ms.
    let tables = read_rows(LONG, "CASEID = 30123, vehno = 2").unwrap();
    assert_eq!(tables.len(), 2);
    assert!(tables[0].is_pre_crash() && tables[1].is_pulse());
    assert_eq!(tables[1].times(), [0.0, 0.02]);
    let along = tables[1].values(Channel::DeltaVLongitudinal);
    assert!((along[1].unwrap() * 3.6 + 11.0).abs() < 1e-9, "{along:?}");
}

#[test]
fn rows_of_several_records_or_of_none_are_refused() {
    let wide = "Time (s),Speed (km/h)\n-1,60\n0,50\n";
    for (text, rows, words) in [
        (LONG, "", "VEHNO 1, 2 and EDREVENTNO 1, 2; choose one with rows = \"VEHNO 1, EDREVENTNO 1\""),
        (LONG, "VEHNO 1", "EDREVENTNO 1, 2; choose one with rows = \"EDREVENTNO 1\""),
        (LONG, "VEHNO 1, EDREVENTNO 3", "no row has EDREVENTNO 3; there are 1, 2"),
        (LONG, "PCODE 1010", "by PCODE; write one of CASEID, VEHNO, EDRSUMMNO, EDREVENTNO"),
        (wide, "VEHNO 1", "this table is not one: leave `rows` out"),
    ] {
        let refusal = read_rows(text, rows).unwrap_err().to_string();
        assert!(refusal.contains(words), "{rows}: {refusal}");
    }
    // Words in place of NHTSA's codes.
    let words = "CASEID,VEHNO,PCODE,PTIME,PVALUE\n7,1,Vehicle Speed,-1,60\n7,1,Service Brake,-1,0\n";
    let refusal = read_rows(words, "VEHNO 1").unwrap_err().to_string();
    let told = "line 2, column 5: no PCODE begins with 1, as before the impact, or 2, as during it; there are Service Brake, \
                Vehicle Speed; ";
    assert!(refusal.starts_with(told), "{refusal}");
    // A time that occurs twice in one record, and a cell that is not a time.
    let twice = LONG.replace("1,1,1010,-0.5,51", "1,1,1010,-1.0,51");
    assert!(
        read_rows(&twice, "VEHNO 1, EDREVENTNO 1").unwrap_err().to_string().starts_with("line 3, column 18")
    );
    let bad = LONG.replace("1,1,1010,-0.5,51", "1,1,1010,soon,51");
    assert!(
        read_rows(&bad, "VEHNO 1, EDREVENTNO 1").unwrap_err().to_string().contains("\"soon\" is not a time")
    );
}

/// The data elements of 49 CFR 563.7 (tables I and II) and of Annex 4 of UN R160 that are series, in their
/// words, and others that reports print, each in a CSV with times.
#[test]
fn headings_of_rules_and_reports_are_recognised() {
    for (channel, headings) in [
        (
            Channel::Speed,
            "Speed, vehicle indicated (km/h)|Vehicle speed [mph]|Indicated speed (km/h)|Road speed (km/h)|Geschwindigkeit (km/h)",
        ),
        (
            Channel::Throttle,
            "Engine throttle, per cent full (%)|Engine throttle, % full|Throttle opening (%)",
        ),
        (Channel::Accelerator, "Accelerator pedal, per cent full (%)|Accelerator Opening Ratio (%)"),
        (Channel::Brake, "Service brake, on/off|Brake Switch|Brake pedal status (on/off)|Service brakes"),
        (Channel::EngineSpeed, "Engine rpm|Engine RPM (RPM)|Motordrehzahl (1/min)"),
        (
            Channel::Abs,
            "ABS activity|Anti-lock braking system activity|Anti-lock brake system|Antilock braking system (on/off)",
        ),
        (Channel::Stability, "Stability control|Electronic Stability Control Status|VDC"),
        (Channel::Steering, "Steering input (deg)|Steering wheel angle (degrees)|Steering wheel input (deg)"),
        (Channel::YawRate, "Yaw rate (deg/s)|Yaw angular velocity (deg/sec)"),
        (
            Channel::DeltaVLongitudinal,
            "Delta-V, longitudinal (km/h)|Longitudinal change in velocity (mph)|Cumulative delta-V, longitudinal (km/h)",
        ),
        (Channel::DeltaVLateral, "Delta-V, lateral (km/h)|Lateral change in velocity (mph)"),
        (Channel::AccelerationLongitudinal, "Longitudinal acceleration (g)"),
        (Channel::AccelerationLateral, "Lateral acceleration (g)"),
        (
            Channel::Other,
            "Wheel speed (km/h)|Wheel speed, front left (km/h)|Normal acceleration (g)|Vehicle roll angle (deg)|Speed limit (km/h)|\
             Time, maximum delta-V, longitudinal (ms)|Maximum delta-V, longitudinal (km/h)|Ignition cycle, crash|Set speed (km/h)|\
             Adaptive cruise control|Tyre pressure|Brake pressure (bar)|Colour|\
             Relative velocity (m/s)|Lead vehicle speed (km/h)|Emergency brake|ABS warning lamp|Brake fluid level|\
             Resultant velocity change (km/h)|Steering angle (%)",
        ),
    ] {
        for heading in headings.split('|') {
            // Next to it is another quantity; the heading is in quotes, as it may have a comma.
            let is_speed = matches!(channel, Channel::Speed | Channel::Other);
            let known = if is_speed { "Yaw rate (deg/s)" } else { "Speed (km/h)" };
            let text = format!("Time (s),{known},\"{heading}\"\n-1,1,1\n0,1,0\n");
            let table = one(&text);
            let found = table.columns.iter().find(|column| column.heading == heading);
            let found = found.map_or(Channel::Other, |column| column.channel);
            assert_eq!(found, channel, "{heading}: {table:?}");
            assert_eq!(table.ignored.len(), usize::from(channel == Channel::Other), "{heading}: {table:?}");
        }
    }
}

/// A refusal lists the headings of the table, and the known ones.
#[test]
fn a_refusal_names_the_headings() {
    let refused = |text: &str| read_tables(text).unwrap_err().to_string();
    let said = refused("Time (s),Wheel speed (km/h),Colour\n-1,50,3\n0,40,4\n");
    for words in ["in \"Wheel speed (km/h)\", \"Colour\"", "known are speed, accelerator pedal"] {
        assert!(said.contains(words), "{said}");
    }
    let said = refused("a;b\n1;2\n3;4\n");
    assert!(said.contains("begins with \"a;b\""), "{said}");
    let across = "Time (s),-1,-0.5,0\nVehicle speed (km/h),60,58,47\nMood,1,2,3\n";
    assert_eq!(one(across).ignored.len(), 1);
    let set = "Time (sec) Vehicle Speed (km/h) Cruise Control Set Speed (km/h) Brake\n-1 64 63 off\n-0.5 60 60 on\n0 49 20 on\n";
    assert_eq!(one(set).ignored[0].0, "Cruise Control Set Speed (km/h)");
    let headings = one("Time (s),Speed (km/h),Wheel speed (km/h)\n-1,50,49\n0,40,39\n").headings();
    assert_eq!(
        headings,
        "\"Time (s)\" as time, \"Speed (km/h)\" as speed; it did not read \"Wheel speed (km/h)\""
    );
}

/// Each row of a table with times across has one value for each time, in text of every kind; empty cells
/// after the last belong to nothing.
#[test]
fn a_row_across_has_as_many_values_as_there_are_times() {
    let rows = [
        ("Vehicle Speed (km/h),60,55,50\nService Brake,Off,On\n", (3, 15), "2 values, where 3"),
        ("Vehicle Speed (km/h),60,55,50,45\nService Brake,Off,On,On\n", (2, 22), "4 values, where 3"),
        ("Delta-V lateral (km/h),0,1\nDelta-V longitudinal (km/h),0,-5,-9\n", (2, 24), "2 values, where 3"),
    ];
    for (text, at, words) in rows {
        for between in [",", "\t", ";"] {
            let text = format!("Time (s),-1.0,-0.5,0\n{text}").replace(',', between);
            let refusal = read_tables(&text).unwrap_err();
            assert_eq!(refusal.place.map(|place| (place.line, place.column)), Some(at), "{refusal}");
            assert!(refusal.to_string().contains(words), "{refusal}");
        }
    }
    let table = one("Time (s),-1.0,-0.5,0,\nVehicle Speed (km/h),60,,50,,\nService Brake,Off,On,,\n");
    assert_eq!(values(&table, Channel::Time, 1.0), [-1.0, -0.5, 0.0]);
    assert_eq!(table.values(Channel::Speed)[1], None);
    assert_eq!(table.values(Channel::Brake), [Some(0.0), Some(1.0), None]);
}

/// The heading that names a quantity with the fewest other words is that of its column, wherever it is, and a
/// heading whose words negate the quantity names none.
#[test]
fn the_surest_heading_is_read_whatever_the_order() {
    let speeds = "Relative velocity (m/s)|Lead vehicle speed (km/h)|GPS speed (km/h)|Maximum speed (km/h)|\
                  Cruise set vehicle speed (km/h)|Wheel velocity FL (km/h)|Fan speed (km/h)|\
                  Trailer speed (km/h)|Speed error (km/h)";
    let brakes = "Emergency brake|Brake system warning|Brake fluid level|Engine brake|Retarder brake|\
                  Service brake system fault";
    for (others, own, channel, unit) in [
        (speeds, "Vehicle Speed (km/h)", Channel::Speed, KMH),
        (speeds, "Speed (km/h)", Channel::Speed, KMH),
        (brakes, "Service Brake", Channel::Brake, 1.0),
        ("ABS warning lamp", "ABS active", Channel::Abs, 1.0),
    ] {
        for other in others.split('|') {
            for (between, layout) in [(",", TextLayout::Delimited(',')), ("|", TextLayout::Delimited('|'))] {
                let known = "Yaw rate (deg/s)";
                let [first, second] = [[other, own], [own, other]].map(|two| two.join(between));
                let text = format!("Time (s){between}{known}{between}{first}\n-1,9,0,1\n0,9,0,1\n");
                let table = one(&text.replace(',', between));
                assert_eq!(table.layout, layout);
                assert_eq!(values(&table, channel, unit), [1.0, 1.0], "{other}");
                assert_eq!(table.ignored[0].0, other, "{table:?}");
                let text = format!("Time (s){between}{known}{between}{second}\n-1,9,1,0\n0,9,1,0\n");
                assert_eq!(values(&one(&text.replace(',', between)), channel, unit), [1.0, 1.0], "{other}");
            }
        }
    }
    // In flowing text the words before a name belong to its heading, too.
    let table = one("Time (s) Trailer speed (km/h) Vehicle speed (km/h) ABS\n-1 10 50 off\n0 20 40 on\n");
    assert_eq!(values(&table, Channel::Speed, KMH), [50.0, 40.0]);
    assert_eq!(table.ignored[0].0, "Trailer speed (km/h)");
}

/// Two columns of one quantity: the finer is read if they agree within the last digits of both, and neither
/// if they do not.
#[test]
fn two_columns_of_one_quantity_agree_or_are_refused() {
    let heading = "Time (s),Vehicle Speed (mph),Vehicle Speed (km/h),Service Brake\n";
    let table = one(&format!("{heading}-1.0,31,50,off\n-0.5,29,47,on\n0.0,25,40,on\n"));
    assert_eq!(values(&table, Channel::Speed, KMH), [50.0, 47.0, 40.0]);
    assert_eq!(table.ignored[0].0, "Vehicle Speed (mph)");
    let refusal = read_tables(&format!("{heading}-1.0,31,50,off\n-0.5,40,50,on\n")).unwrap_err();
    assert_eq!(refusal.place.map(|place| (place.line, place.column)), Some((3, 9)));
    let said = "two columns give the speed, and disagree: 40 under \"Vehicle Speed (mph)\" and 50 under \
                \"Vehicle Speed (km/h)\"";
    assert!(refusal.to_string().contains(said), "{refusal}");
    let refusal = read_tables("Time (s),ABS active,ABS activity\n-1,on,off\n0,on,on\n").unwrap_err();
    assert!(refusal.to_string().contains("on under \"ABS active\" and off under"), "{refusal}");
}

/// The axis of a velocity change may be anywhere in its heading, in all layouts.
#[test]
fn a_velocity_change_is_along_the_axis_that_its_heading_names() {
    let lateral = "Time (ms),Lateral Axis Recorded Velocity Change (MPH)\n10,0\n20,4\n30,13\n";
    let table = one(lateral);
    assert_eq!(values(&table, Channel::DeltaVLateral, 0.44704), [0.0, 4.0, 13.0]);
    assert!(table.column(Channel::DeltaVLongitudinal).is_none());
    let both = "Time (milliseconds),SDM Lateral Axis Recorded Velocity Change (MPH),\
                SDM Longitudinal Axis Recorded Velocity Change (MPH)\n10,1,-4\n20,2,-9\n30,3,-13\n";
    let across = "Time (milliseconds) 10 20 30\nSDM Lateral Axis Recorded Velocity Change (MPH) 1 2 3\n\
                  SDM Longitudinal Axis Recorded Velocity Change (MPH) -4 -9 -13\n";
    let bracketed = "Time (ms),Velocity change (lateral) mph,Velocity change (longitudinal) mph\n\
                     10,1,-4\n20,2,-9\n30,3,-13\n";
    for text in
        [both.to_owned(), both.replace(',', " "), both.replace(',', "\t"), across.into(), bracketed.into()]
    {
        let table = one(&text);
        assert_eq!(values(&table, Channel::DeltaVLateral, 0.44704), [1.0, 2.0, 3.0], "{text}");
        assert_eq!(values(&table, Channel::DeltaVLongitudinal, 0.44704), [-4.0, -9.0, -13.0], "{text}");
        let heading = &table.column(Channel::DeltaVLateral).unwrap().heading;
        assert!(heading.to_lowercase().contains("lateral"), "{heading}");
    }
    let resultant = "Time (ms),Resultant velocity change (mph),Delta-V lateral (mph)\n10,1,2\n20,1,2\n";
    assert!(one(resultant).column(Channel::DeltaVLongitudinal).is_none());
}

/// The speed (km/h) and brake of a table of three rows at -1, -0.5 and 0 s.
fn three(table: &RecorderTable) -> ([Option<f64>; 3], [Option<f64>; 3]) {
    assert_eq!(table.times(), [-1.0, -0.5, 0.0], "{table:?}");
    let three = |channel, unit: f64| -> [Option<f64>; 3] {
        let rounded = |value: Option<f64>| value.map(|value| (value / unit * 1e6).round() / 1e6);
        table.values(channel).into_iter().map(rounded).collect::<Vec<_>>().try_into().unwrap()
    };
    (three(Channel::Speed, KMH), three(Channel::Brake, 1.0))
}

/// A row in which one cell has a mark, a unit or words is read, and a cell without a value is reported with
/// its place: no row vanishes.
#[test]
fn a_row_with_words_in_it_is_read() {
    const ON: Option<f64> = Some(1.0);
    let whole = ([Some(64.0), Some(60.0), Some(49.0)], [Some(0.0), ON, ON]);
    for rows in [
        "-1.0 64 Off|-0.5 60 On*|0 49* On|* Data limitations apply",
        "-1.0 64 Off|-0.5 60 On (1)|0 49 On|(1) see data limitations",
        "-1.0 64 Off|-0.5 60 On|0.0 (AE) 49 On",
        "-1.0 64 Off|-0.5 60 On|0.0* 49 On†",
        "-1.0 64 Off|-0.5 60 On|0.0 49 Brake On",
        "-1.0 64 Released|-0.5 60 Pressed|0.0 49 Depressed",
        "-1.0 s 64 km/h Off|-0.5 s 60 km/h On|0.0 s 49 km/h On",
        "-1.0 (s) 64 Off|-0.5 60 (max) On|Page 5 of 22|0.0 49 On",
    ] {
        let table =
            one(&format!("Time (sec) Vehicle Speed (km/h) Service Brake\n{}\n", rows.replace('|', "\n")));
        assert_eq!(three(&table), whole, "{rows}");
        assert_eq!(table.doubts, [], "{rows}");
    }
    let without_speed = |row: usize| {
        let mut speeds = whole.0;
        speeds[row] = None;
        (speeds, whole.1)
    };
    let without_brake = |row: usize| {
        let mut brakes = whole.1;
        brakes[row] = None;
        (whole.0, brakes)
    };
    for (rows, expected, (line, column), words) in [
        ("-1.0 64 Off|-0.5 >= 60 On|0 49 On", without_speed(1), (3, 6), ">= 60"),
        ("-1.0 126 or greater Off|-0.5 60 On|0 49 On", without_speed(0), (2, 6), "126 or greater"),
        ("-1.0 64 Off|-0.5 60 On|0 4O On", without_speed(2), (4, 3), "4O"),
        ("-1.0 64 Off|-0.5 Sensor Fault On|0 49 On", without_speed(1), (3, 6), "Sensor Fault"),
        ("-1.0 64 Off|-0.5 60 On|0.0 49 Yes/No", without_brake(2), (4, 8), "Yes/No"),
        ("-1.0 64 Off|-0.5 60 On|0.0 49 Undefined", without_brake(2), (4, 8), "Undefined"),
        ("-1.0 64 Off|-0.5 60 On|0.0 *** On", without_speed(2), (4, 5), "***"),
    ] {
        let table =
            one(&format!("Time (sec) Vehicle Speed (km/h) Service Brake\n{}\n", rows.replace('|', "\n")));
        assert_eq!(three(&table), expected, "{rows}");
        let doubt = &table.doubts[0];
        assert_eq!((doubt.place.line, doubt.place.column, table.doubts.len()), (line, column, 1), "{rows}");
        let none = if words == "***" { NoValue::Word } else { NoValue::Unreadable };
        assert_eq!(doubt.reason, none(words.into()), "{rows}");
    }
    // A column that is known and not read may have any words.
    let gear = "Time (sec) Vehicle Speed (km/h) Service Brake Gear\n-1.0 64 Off D\n-0.5 60 On N\n0 49 On N\n";
    assert_eq!(three(&one(gear)), whole);
    assert_eq!(one(gear).ignored[0].0, "Gear");
    // A line with too few cells for a row is refused, or reported as a line that was not read.
    let heading = "Time (sec) Vehicle Speed (km/h) Service Brake\n-1.0 64 Off\n";
    let refusal = read_tables(&format!("{heading}-0.5 60 On or Off or Fault\n0 49 On\n")).unwrap_err();
    assert_eq!(refusal.place.map(|place| place.line), Some(3), "{refusal}");
    let table = one(&format!("{heading}-0.5 Fault\n0 49 On\n"));
    assert_eq!(table.times(), [-1.0, 0.0]);
    assert_eq!(
        table.ignored.iter().map(|(text, at)| (text.as_str(), at.line)).collect::<Vec<_>>(),
        [("-0.5 Fault", 3)]
    );
    let pulse = "Time (msec) Delta-V, longitudinal (km/h)\n0 0\n20 -5\n40 -15 (max)\n60 -16*\n80 -16*\n";
    assert_eq!(values(&one(pulse), Channel::DeltaVLongitudinal, KMH), [0.0, -5.0, -15.0, -16.0, -16.0]);
    let units =
        "Time (ms) Longitudinal Delta V Lateral Delta V\n0 0.0 km/h 0.0 km/h\n20 -5.0 km/h 1.0 km/h\n";
    assert_eq!(values(&one(units), Channel::DeltaVLongitudinal, KMH), [0.0, -5.0]);
    assert_eq!(values(&one(units), Channel::DeltaVLateral, KMH), [0.0, 1.0]);
}

/// With the times across, a quantity with words among its values is read, and an unknown word is reported.
#[test]
fn a_row_across_with_words_in_it_is_read() {
    let text = "Time (sec) -1.0 -0.5 0\nVehicle Speed (km/h) 64 60 49\nABS Off Engaged Fault\n\
                Stability control Fault Off On\nBrake Off On On*\nShift Position D D D\nMood 1 2 3\n\
                Percentage of Engine Throttle (%) 15 13 13\nLongitudinal Acceleration, VSC Sensor (m/sec^2) 0 -1 -2\n\
                Seat belt Buckled Buckled Buckled\n";
    let table = one(text);
    assert_eq!(three(&table), ([Some(64.0), Some(60.0), Some(49.0)], [Some(0.0), Some(1.0), Some(1.0)]));
    assert_eq!(table.values(Channel::Abs), [Some(0.0), Some(1.0), None]);
    assert_eq!(table.values(Channel::Stability), [None, Some(0.0), Some(1.0)]);
    assert_eq!(values(&table, Channel::AccelerationLongitudinal, 1.0), [0.0, -1.0, -2.0]);
    let told: Vec<_> = table.doubts.iter().map(|doubt| (doubt.place.line, doubt.place.column)).collect();
    assert_eq!(told, [(3, 17), (4, 19)]);
    let unread: Vec<&str> = table.ignored.iter().map(|(heading, _)| heading.as_str()).collect();
    assert_eq!(unread, ["Shift Position", "Mood", "Seat belt"]);
    let heading = |channel| table.column(channel).unwrap().heading.as_str();
    assert_eq!(heading(Channel::Throttle), "Percentage of Engine Throttle (%)");
    assert_eq!(heading(Channel::AccelerationLongitudinal), "Longitudinal Acceleration, VSC Sensor (m/sec^2)");
}

/// A column of text with unknown words is not read, but the others are.
#[test]
fn a_column_of_unknown_words_refuses_no_table() {
    let text = "Time (sec),Vehicle Speed (km/h),Service Brake,Gear Position\n\
                -1.0,64,Off,Drive\n-0.5,60,On,Drive\n0,49,On,Drive\n";
    let whole = ([Some(64.0), Some(60.0), Some(49.0)], [Some(0.0), Some(1.0), Some(1.0)]);
    for (between, delimiter) in [(",", ','), (";", ';'), ("\t", '\t'), (" | ", '|')] {
        let table = one(&text.replace(',', between));
        assert_eq!(table.layout, TextLayout::Delimited(delimiter));
        assert_eq!(three(&table), whole);
        assert_eq!(table.ignored[0].0, "Gear Position");
    }
    let ruled = "| Time (s) | Speed (km/h) | Brake |\n|---|---|---|\n| -1 | 64 | Off |\n| -0.5 | 60 | On |\n| 0 | 49 | On |\n";
    assert_eq!(three(&one(ruled)), whole);
    // Across, a word among values is a cell without a value, even the first.
    let across = "Time (s),-1,-0.5,0\nSpeed (km/h),64,60,Fault\nBrake,Fault,On,On\nGear,Drive,Drive,Drive\n";
    let table = one(across);
    assert_eq!(three(&table), ([Some(64.0), Some(60.0), None], [None, Some(1.0), Some(1.0)]));
    assert_eq!(table.doubts.len(), 2);
    assert_eq!(table.ignored[0].0, "Gear");
    // A cell that is not a time is reported, and a footer with a comma does not begin a table.
    let typo = text.replace("-0.5,", "-O.5,");
    assert_eq!(
        read_tables(&typo).unwrap_err().to_string(),
        "line 3, column 1: \"-O.5\" is not a time; write the time of each row as a number, and leave a row without one out"
    );
    let footer = text.replace("0,49", "Page 5, of 22\n0,49");
    assert_eq!(three(&one(&footer)), whole);
    // A percentage of the greatest angle is not an angle.
    let share = one("Time (s) Speed (km/h) Brake Steering angle (%)\n-1 64 off 5\n-0.5 60 on 5\n0 49 on 5\n");
    assert_eq!(three(&share), whole);
    assert_eq!(share.ignored[0].0, "Steering angle (%)");
}

/// Reports of GM count the seconds before algorithm enable.
#[test]
fn seconds_before_algorithm_enable_are_times() {
    let text = "Seconds Before AE\tVehicle Speed (MPH)\tPercent Throttle\tBrake Switch Circuit Status\n\
                5\t55\t12\tOFF\n4\t54\t5\tON\n3\t45\t0\tON\n";
    for text in [
        text.to_owned(),
        text.replace('\t', " "),
        text.replace("\n5", "\n-5").replace("\n4", "\n-4").replace("\n3", "\n-3"),
    ] {
        let table = one(&text);
        assert_eq!(values(&table, Channel::Time, 1.0), [-5.0, -4.0, -3.0]);
        assert_eq!(values(&table, Channel::Speed, 0.44704), [55.0, 54.0, 45.0]);
        assert_eq!(values(&table, Channel::Throttle, 1.0), [12.0, 5.0, 0.0]);
        assert_eq!(values(&table, Channel::Brake, 1.0), [0.0, 1.0, 1.0]);
    }
}

/// A minus with a space behind it belongs to its number if every row then fits the heading.
#[test]
fn a_minus_that_stands_apart_is_joined_to_its_number() {
    let table = one("Time (s) Vehicle Speed (km/h) Brake\n- 1.0 50 -\n- 0.5 47 On\n0.0 40 On\n");
    assert_eq!(values(&table, Channel::Time, 1.0), [-1.0, -0.5, 0.0]);
    assert_eq!(values(&table, Channel::Speed, KMH), [50.0, 47.0, 40.0]);
    let text = "Time (s) Vehicle Speed (km/h) Wheel Speed FL (km/h)\n- 1.0 50 49 50\n- 0.5 47 46\n";
    let said = read_tables(text).unwrap_err().to_string();
    assert_eq!(
        said,
        "line 2, column 1: 5 values, where 3 are needed: \"Time (s)\", \"Vehicle Speed (km/h)\", \
         \"Wheel Speed FL (km/h)\"; a minus apart from its number counts as a value: join them"
    );
}

/// Tables of one record in one text are joined by their times, and a second record is left out by name.
#[test]
fn tables_of_one_record_are_joined_by_their_times() {
    let pedals = "Times (sec) Service Brake Engine RPM\n-1.0 Off 1800\n-0.6 On 1700\n0.0 On 1700\n";
    let speeds = "Times (sec) Vehicle Speed (km/h)\n-1.0 58\n-0.5 55\n0.0 48\n";
    for text in [format!("{pedals}{speeds}"), format!("{speeds}{pedals}")] {
        let mut tables = read_tables(&text).unwrap();
        let at = tables.iter().position(RecorderTable::is_pre_crash).unwrap();
        let mut table = tables.remove(at);
        assert!(table.not_with(&tables[0]).is_none() && tables[0].not_before_impact().is_none());
        table.join(tables.remove(0));
        assert_eq!(table.times(), [-1.0, -0.6, -0.5, 0.0]);
        let kmh = |value: Option<f64>| value.map(|value| (value * 3.6).round());
        let found: Vec<Option<f64>> = table.values(Channel::Speed).into_iter().map(kmh).collect();
        assert_eq!(found, [Some(58.0), None, Some(55.0), Some(48.0)]);
        assert_eq!(table.values(Channel::Brake), [Some(0.0), Some(1.0), None, Some(1.0)]);
        let first = if text.starts_with(pedals) { 2 } else { 6 };
        assert_eq!(table.rows[1].line, first + 1);
    }
    // A table that continues where the other ends is of the same record, and one with the same times is of
    // another.
    let later = "Times (sec) Vehicle Speed (km/h)\n0.5 40\n1.0 30\n";
    let [mut one, two] = [one(speeds), one(later)];
    assert!(one.not_with(&two).is_none() && two.not_with(&one).is_none() && one.not_with(&one).is_some());
    let again = Apart::GivenTwice { channel: Channel::Speed, time: -1.0 };
    assert_eq!([one.not_with(&one), one.not_with(&two)], [Some(again), None]);
    let after = two.not_before_impact().unwrap();
    assert_eq!(after, Apart::AfterImpact { time: 0.5 });
    one.leave(two.clone(), after);
    assert_eq!(one.left[0].headings, ["Vehicle Speed (km/h)"]);
    assert_eq!(one.ignored[0].0, "Vehicle Speed (km/h)");
    one.join(two);
    assert_eq!(one.times(), [-1.0, -0.5, 0.0, 0.5, 1.0]);
}

/// Two series side by side, each with its own times, are two tables.
#[test]
fn a_quantity_has_the_times_on_its_left() {
    let text = "Time (ms),Longitudinal Delta-V (km/h),Time (ms),Lateral Delta-V (km/h)\n\
                0,0,5,0\n10,-3,15,1\n20,-9,25,4\n30,-15,,\n";
    for (between, whole) in
        [(",", true), (";", true), ("\t", true), ("|", true), (" ", false), ("    ", false)]
    {
        let text = if whole { text.to_owned() } else { text.replace("30,-15,,\n", "") };
        let tables = read_tables(&text.replace(',', between)).unwrap();
        assert_eq!(tables.len(), 2, "{between:?}");
        let along = [0.0, -3.0, -9.0, -15.0];
        let along = if whole { &along[..] } else { &along[..3] };
        assert_eq!(values(&tables[0], Channel::DeltaVLongitudinal, KMH), along);
        assert_eq!(values(&tables[1], Channel::Time, 1e-3), [5.0, 15.0, 25.0]);
        assert_eq!(values(&tables[1], Channel::DeltaVLateral, KMH), [0.0, 1.0, 4.0]);
        assert!(tables[0].column(Channel::DeltaVLateral).is_none());
    }
    // The same times again, or in another unit, or times without a quantity, make no other table.
    for text in [
        "Time (ms),Longitudinal Delta-V (km/h),Time (s),Lateral Delta-V (km/h)\n0,0,0,0\n10,-3,0.010,1\n",
        "Time (ms),Longitudinal Delta-V (km/h),Lateral Delta-V (km/h),Time (ms)\n0,0,0,5\n10,-3,1,15\n",
        "Time (ms),Time (s),Longitudinal Delta-V (km/h),Lateral Delta-V (km/h)\n0,3,0,0\n10,4,-3,1\n",
    ] {
        let table = one(text);
        assert_eq!(values(&table, Channel::Time, 1e-3), [0.0, 10.0]);
        assert_eq!(values(&table, Channel::DeltaVLateral, KMH), [0.0, 1.0]);
    }
}

/// A heading that says how its values are meant is read as it says, or refused.
#[test]
fn a_heading_says_how_its_values_are_meant() {
    let brake = |heading: &str, cells: [&str; 3]| {
        let [first, second, third] = cells;
        let text =
            format!("Time (s);Speed (km/h);{heading}\n-1;60;{first}\n-0.5;58;{second}\n0;50;{third}\n");
        read_tables(&text).map(|tables| tables[0].values(Channel::Brake))
    };
    let [on, off] = [Some(1.0), Some(0.0)];
    for heading in
        ["Brake (0 = On, 1 = Off)", "Brake (On = 0, Off = 1)", "Brake (0: applied, 1: not applied)"]
    {
        assert_eq!(brake(heading, ["1", "0", "0"]), Ok(vec![off, on, on]), "{heading}");
        // Words stay what they say.
        assert_eq!(brake(heading, ["off", "0", "SNA"]), Ok(vec![off, on, None]), "{heading}");
    }
    assert_eq!(brake("Brake, 0 = on", ["1", "0", "0"]), Ok(vec![off, on, on]));
    assert_eq!(brake("Brake (0=Off 1=On)", ["0", "1", "1"]), Ok(vec![off, on, on]));
    assert_eq!(brake("Brake (1 = Off, 2 = On, 3 = Fault)", ["1", "2", "3"]), Ok(vec![off, on, None]));
    assert_eq!(brake("Brake (On, Off)", ["0", "1", "1"]), Ok(vec![off, on, on]));
    for heading in ["Brake (0 = red, 1 = green)", "Brake (0 = On, 0 = Off)", "Brake (0 = On, 1 = On)"] {
        let said = brake(heading, ["0", "1", "1"]).unwrap_err().to_string();
        assert!(said.starts_with("line 1, column 23: the heading \"Brake"), "{said}");
        assert!(said.ends_with("but not clearly: write on and off for its values"), "{said}");
    }
    let flowing = "Time (s) Speed (km/h) Brake (0 = On, 1 = Off)\n-1 60 1\n-0.5 58 0\n0 50 0\n";
    assert_eq!(one(flowing).values(Channel::Brake), [off, on, on]);

    let pulse = |heading: &str| read_tables(&format!("Time (ms)\t{heading}\n0\t0\n10\t3\n20\t8\n"));
    for (heading, channel, sign) in [
        ("Longitudinal Delta-V (km/h; positive = deceleration)", Channel::DeltaVLongitudinal, -1.0),
        ("Delta-V, longitudinal (km/h) (forward +)", Channel::DeltaVLongitudinal, 1.0),
        ("Longitudinal Delta-V (rearward negative) (km/h)", Channel::DeltaVLongitudinal, 1.0),
        ("Lateral Delta-V left positive (km/h)", Channel::DeltaVLateral, -1.0),
        ("Lateral Delta-V (km/h) (+left)", Channel::DeltaVLateral, -1.0),
        ("Lateral Delta-V (km/h) (left -, right +)", Channel::DeltaVLateral, 1.0),
        ("Lateral Delta-V (km/h, right = positive, left = negative)", Channel::DeltaVLateral, 1.0),
        ("Lateral Delta-V (km/h) (+/- 2)", Channel::DeltaVLateral, 1.0),
    ] {
        let table = pulse(heading).unwrap_or_else(|refusal| panic!("{heading}: {refusal}")).remove(0);
        assert_eq!(values(&table, channel, KMH), [0.0, sign * 3.0, sign * 8.0], "{heading}");
    }
    for heading in
        ["Lateral Delta-V (km/h) (left positive, right positive)", "Lateral Delta-V (km/h) (left/right +/-)"]
    {
        let said = pulse(heading).unwrap_err().to_string();
        assert!(said.contains("not clearly: write the values positive forward and to the right"), "{said}");
    }
}

/// "Brakes" in the name of another system heads no column.
#[test]
fn traction_control_is_no_brake() {
    for by in ["Brakes", "Engine"] {
        let text = format!(
            "Times (sec) Speed vehicle indicated MPH [km/h] Service brake, on/off Traction Control via {by} (engaged, \
             non-engaged)\n-1.0 53.4 [86.0] On non-engaged\n-0.5 49.7 [80.0] On non-engaged\n0.0 42.3 [68.0] Off engaged\n"
        );
        let table = read_tables(&text).unwrap().remove(0);
        let shown: Vec<Channel> = table.columns.iter().map(|column| column.channel).collect();
        assert_eq!(shown, [Channel::Time, Channel::Speed, Channel::Brake], "{by}");
        let brake = &table.columns[2];
        assert_eq!(brake.values, [Some(1.0), Some(1.0), Some(0.0)]);
        assert_eq!(table.ignored.len(), 1);
    }
}

/// With the times across and single blanks, a quantity with too few values is refused, whatever they are.
#[test]
fn a_row_across_with_an_empty_cell_is_refused() {
    let stability = "Stability Control (On, Off, Engaged) Off Off† Off\n";
    for (brake, count) in [
        ("Brake Switch Circuit Status Off On\n", 2),
        ("Brake Switch Circuit Status On\n", 1),
        ("Accelerator Pedal (%) 14\n", 1),
    ] {
        for (before, after, line) in [("", stability, 3), (stability, "", 4)] {
            let text =
                format!("Time (sec) -2.0 -1.0 0\nVehicle Speed (km/h) SNA 67 62\n{before}{brake}{after}");
            let refusal = read_tables(&text).unwrap_err();
            let TextFault::Uneven { found, expected: 3, .. } = refusal.fault else { panic!("{refusal}") };
            assert_eq!((refusal.place.map(|place| place.line), found), (Some(line), count), "{text}");
        }
    }
    // A mark that stands apart from its value fills no cell.
    for text in [
        "Time (s) -1.0 -0.5 0\nSpeed (km/h) 60 * 58\n",
        "Time (s) -1.0 -0.5 0\nSpeed (km/h) 60 58 50\nService Brake On * Off\n",
        "Time (s) Speed (km/h) Brake\n-1.0 60 On\n-0.5 60 *\n0 50 On\n",
    ] {
        let said = read_tables(text).unwrap_err().to_string();
        assert!(said.contains("2 values, where 3 are needed"), "{said}");
    }
    let table = one("Time (s) Speed (km/h) Brake\n-1.0 60 * On\n-0.5 60 On †\n0 50 On\n");
    assert_eq!(table.doubts, []);
    // The states of a switch above its values, and words that name a quantity, are no row.
    let text = "Time (sec) -2.0 -1.0 0\nVehicle Speed (km/h) SNA 67 62\nService Brake, On Off\nOff On On\n\
                The brake was off\n";
    assert_eq!(
        one(&text.replace("was off", "acted")).values(Channel::Brake),
        [Some(0.0), Some(1.0), Some(1.0)]
    );
}

/// No engine turns at 1.250 rpm, and a point between thousands is one if the other numbers are whole.
#[test]
fn a_point_in_an_engine_speed_may_be_between_thousands() {
    let engine = |cells: [&str; 3]| {
        let [first, second, third] = cells;
        let table = one(&format!(
            "Time (s) Speed (km/h) Engine RPM\n-1 60 {first}\n-0.5 58 {second}\n0 50 {third}\n"
        ));
        table.values(Channel::EngineSpeed)
    };
    assert_eq!(engine(["1.250", "1.300", "950"]), [Some(1250.0), Some(1300.0), Some(950.0)]);
    assert_eq!(engine(["1.250*", "2200", "SNA"]), [Some(1250.0), Some(2200.0), None]);
    assert_eq!(engine(["1,250", "1250", "0"]), [Some(1250.0), Some(1250.0), Some(0.0)]);
    // A number with other decimals beside it leaves it open, and three decimals are three decimals.
    assert_eq!(engine(["1.250", "812.5", "800"]), [None, Some(812.5), Some(800.0)]);
    assert_eq!(engine(["12.000", "812.500", "800.250"]), [Some(12.0), Some(812.5), Some(800.25)]);
    let speed = one("Time (s) Speed (km/h)\n-1 1.250\n0 2.250\n");
    assert_eq!(values(&speed, Channel::Speed, KMH), [1.25, 2.25]);
}

/// The codes 254 and 255 of km/h, converted to whole miles per hour.
#[test]
fn a_code_converted_to_miles_is_no_value() {
    let speeds = |unit: &str, first: &str| {
        one(&format!("Time (s) Speed ({unit})\n-1 {first}\n0 40\n")).values(Channel::Speed)[0].is_some()
    };
    assert!(!speeds("mph", "158") && !speeds("mph", "157.8") && !speeds("km/h", "254"));
    assert!(speeds("mph", "157") && speeds("mph", "159") && speeds("mph", "158.2") && speeds("km/h", "158"));
}

/// Units of two values, in a heading or beside each time, and short names of a speed.
#[test]
fn units_and_names_that_leave_no_doubt_are_read() {
    for heading in ["v [km/h]", "v (km/h)", "v_kmh", "speed_km_h"] {
        let table = one(&format!("time_s;{heading};brake\n-1;60;0\n0;55;1\n"));
        assert_eq!(values(&table, Channel::Speed, KMH), [60.0, 55.0], "{heading}");
    }
    // A voltage is no speed.
    let volts = one("time_s;v [V];brake\n-1;1.2;0\n0;1.3;1\n");
    assert!(volts.column(Channel::Speed).is_none());
    let both = "Times (sec)|Speed (MPH / km/h)|Brake\n-1.0|36 / 58|On\n-0.5|34 / 55|On\n";
    for between in ["|", ",", " ", "      "] {
        let table = one(&both.replace('|', between));
        assert_eq!(values(&table, Channel::Speed, KMH), [58.0, 55.0], "{between:?}");
        assert_eq!(values(&table, Channel::Brake, 1.0), [1.0, 1.0]);
    }
    let across = one("Time -1.0 sec -0.5 sec 0 sec\nVehicle Speed (km/h) 60 58 55\n");
    assert_eq!(values(&across, Channel::Time, 1.0), [-1.0, -0.5, 0.0]);
    assert_eq!(values(&across, Channel::Speed, KMH), [60.0, 58.0, 55.0]);
}

/// A note between rows may name a quantity: the rows go on if the times do.
#[test]
fn a_note_between_rows_begins_no_table() {
    let rows = |note: &str, second: &str| {
        read_tables(&format!(
            "Time (s) Speed (km/h) Brake\n-2.0 60 Off\n-1.5 60 Off\n{note}\n{second} 58 On\n"
        ))
    };
    for note in ["*** note: speed may be affected by wheel slip", "Wheel slip affects the speed"] {
        let table = rows(note, "-1.0").unwrap().remove(0);
        assert_eq!(values(&table, Channel::Speed, KMH), [60.0, 60.0, 58.0], "{note}");
        assert_eq!(values(&table, Channel::Brake, 1.0), [0.0, 0.0, 1.0]);
        // After another step, they may be of another table.
        let said = rows(note, "-0.8").unwrap_err().to_string();
        assert!(said.starts_with("line 4, column ") && said.contains("has no times here"), "{said}");
    }
    // A note after the rows is not read.
    let table = one("Time (s) Speed (km/h)\n-1 60\n0 50\nnote: speed and service brake may be wrong\n");
    assert_eq!(values(&table, Channel::Speed, KMH), [60.0, 50.0]);
    assert_eq!(table.ignored.len(), 2);
    // Times that are the last column of text without separators are not told from a title.
    let said = read_tables("Brake Speed (km/h) Time (s)\nOff 60 -1.0\nOn 58 -0.5\n").unwrap_err().to_string();
    let expected = "line 1, column 1: the times of \"Brake Speed (km/h) Time (s)\" are not its first column: put \
                    them first, or write a semicolon between the columns";
    assert_eq!(said, expected);
}

/// Values one below the other that rise both as rows and as columns are read as their kinds and steps say, or
/// refused.
#[test]
fn values_below_each_other_are_rows_or_columns() {
    let read =
        |heading: &str, cells: &str| read_tables(&format!("{heading}\n{}\n", cells.replace(' ', "\n")));
    let brake = "Time (s)\nEngine Throttle (%)\nService Brake\nVehicle Speed (km/h)\nAccelerator Pedal (%)";
    let table = read(brake, "-2.0 -1.0 0 14 33 0 On Off On 60 55 52 5 0 0").unwrap().remove(0);
    assert_eq!(table.layout, TextLayout::ColumnAfterColumn);
    assert_eq!(values(&table, Channel::Speed, KMH), [60.0, 55.0, 52.0]);
    let speeds = "Time (s)\nVehicle Speed (km/h)";
    let table = read(speeds, "-2.0 -1.0 0 30 35 52").unwrap().remove(0);
    assert_eq!(values(&table, Channel::Speed, KMH), [30.0, 35.0, 52.0]);
    let table = read(speeds, "-2.0 3 0 5 2 9").unwrap().remove(0);
    assert_eq!(values(&table, Channel::Speed, KMH), [3.0, 5.0, 9.0]);
    let said = read(speeds, "0 1 2 3 4 7").unwrap_err().to_string();
    assert!(said.starts_with("line 1, column 1: the values below this heading may be those of"), "{said}");
}
