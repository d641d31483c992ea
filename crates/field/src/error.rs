//! Errors of a table of crashes.

/// Why crashes cannot be judged.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FieldError {
    /// The file is not a table.
    #[error(
        "the file is not a table: save it as comma-separated values, with a header and as many cells in every row"
    )]
    Table(#[from] csv::Error),
    /// A column is missing.
    #[error(
        "there is no column {column}; the file needs CASEID and, with _1 and _2 for the vehicles, CURBWT, CARGOWT, \
         CDCPLANE, PDOF, HEADINGANG, FIELDL, DIRECTL, DIRECTD, C1 to C6, DVTOTAL, DVLONG, MAXDVLONG and MAXDVLAT, \
         with commas between the columns"
    )]
    NoColumn {
        /// Its name.
        column: String,
    },
    /// A column appears twice.
    #[error("the column {column} appears twice: rename or delete the one that is not meant")]
    ColumnTwice {
        /// Its name.
        column: String,
    },
    /// A column of a table of recorders is missing.
    #[error(
        "there is no column {column}; --recorders needs CASEID and, with _1 and _2 for the vehicles, CURBWT, CARGOWT, \
         CDCPLANE, PDOF, HEADINGANG, FIELDL, DIRECTL, DIRECTD, C1 to C6, DVTOTAL, DVLONG, MAXDVLONG, MAXDVLAT, \
         V_T0_KMH, V_T0_AT_S, V_1S_KMH and BRAKE_T0, with commas between the columns"
    )]
    NoRecorderColumn {
        /// Its name.
        column: String,
    },
    /// A column of the program that is judged is missing.
    #[error("there is no column {column}: give the names of the program's columns without _1 and _2")]
    NoClaimColumn {
        /// Its name.
        column: String,
    },
    /// Columns that are not a list of one or three names.
    #[error(
        "\"{text}\" names no columns: write COLUMN, or COLUMN,LOW,HIGH for a program with 95 % intervals"
    )]
    ClaimColumns {
        /// What was given.
        text: String,
    },
    /// A program that makes no claim about any vehicle with a recorder.
    #[error("no vehicle of the file has both a usable recorder and a ΔV in {column}")]
    NoClaims {
        /// The column of its ΔV.
        column: String,
    },
    /// A cell does not hold a valid value.
    #[error("line {line}, column {column}: {} is not {wanted}", quoted(.text))]
    Cell {
        /// Line number, where 1 is the header.
        line: u64,
        /// The name of its column.
        column: String,
        /// Its text.
        text: String,
        /// The required value.
        wanted: &'static str,
    },
    /// The file has only a header.
    #[error("the file has no pair of vehicles: write one per line, below the header")]
    NoPairs,
    /// No vehicle struck a fixed object with its front.
    #[error("no line of the file has a front (CDCPLANE F) that struck an object")]
    NoObjects,
    /// A question about two vehicles, for a table of vehicles that struck objects.
    #[error(
        "{option} needs a table of pairs of vehicles: this one has vehicles that struck an object (OBJCONT)"
    )]
    NotOfObjects {
        /// The option of the command line.
        option: &'static str,
    },
    /// No recorder can be judged.
    #[error(
        "no vehicle of the file can be judged: that takes MAXDVLONG and MAXDVLAT, or MAXDVLONG and damage to front or \
         rear, of 8 km/h or more{}",
        if *.both { ", and for --other those of both vehicles of a pair" } else { "" }
    )]
    NothingToJudge {
        /// Whether both vehicles need a recorder.
        both: bool,
    },
    /// A pair has no estimate.
    #[error("crash {case}: {reason}")]
    Estimate {
        /// Number of the crash.
        case: String,
        /// The reason.
        reason: String,
    },
    /// No pair has a crush energy of both vehicles.
    #[error("no pair of the file has a crush energy of both vehicles; that takes FIELDL or DIRECTL of both")]
    NoShares,
    /// No recorder has a direction.
    #[error("no recorder of the file stored both MAXDVLONG and MAXDVLAT, of 8 km/h or more together")]
    NoDirections,
    /// The fit finds no maximum.
    #[error("the fit found no maximum of the likelihood of the recorders: use more pairs or more particles")]
    NoMaximum,
    /// The run was ended before there were results.
    #[error("it was ended before there were figures")]
    Ended,
}

fn quoted(text: &str) -> String {
    if text.is_empty() { "the empty cell".to_owned() } else { format!("\"{text}\"") }
}
