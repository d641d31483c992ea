//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, ValueEnum};

/// Reconstructs a two-vehicle collision from its damage.
///
/// The damage of both vehicles gives the crush energy (CRASH3), and planar impact mechanics gives the speed at which the impact would take just
/// this energy (Brach & Brach, SAE 980025). A case is a TOML file; fixtures/sae-980025.toml is the paper's example.
#[derive(Debug, Parser)]
#[command(
    name = "deltav",
    bin_name = "deltav",
    version,
    subcommand_required = true,
    arg_required_else_help = true,
    after_help = "Exit status: 0 done; 1 the case is well formed but has no answer; 2 the case file or the command line is wrong."
)]
pub(crate) enum Command {
    /// Find the speed that makes impact and crush agree, and print the whole reconstruction
    #[command(
        long_about = "Find the speed that makes impact and crush agree, and print the whole reconstruction.\n\n\
            Varies the speed that [reconstruct] names until the work of the normal impulse equals the crush energy of both \
            vehicles.",
        after_help = "Example:\n  deltav reconstruct fixtures/sae-980025.toml --units si\n  \
            deltav reconstruct fixtures/sae-980025.toml --format json -o result.json"
    )]
    Reconstruct(Arguments),
    /// Compute what an impact does, both speeds given
    #[command(
        long_about = "Compute what an impact does, both speeds given.\n\n\
            Planar impact mechanics forward: impulse, motion after, ΔV, PDOF and energy. Damage is assessed beside it where the case has it.",
        after_help = "Example:\n  deltav impact fixtures/sae-980025-impact.toml"
    )]
    Impact(Arguments),
    /// Compute crush energy and ΔV from damage and PDOF alone (CRASH3)
    #[command(
        long_about = "Compute crush energy and ΔV from damage and PDOF alone (CRASH3).\n\n\
            Each damaged vehicle needs a PDOF in its crush table, as no impact is computed that could give it.",
        after_help = "Example:\n  deltav crush fixtures/sae-980025-crush.toml"
    )]
    Crush(Arguments),
    /// Put the answers of every impact law and of CRASH3 side by side
    #[command(
        long_about = "Put the answers of every impact law and of CRASH3 side by side.\n\n\
            The case is solved under its own law and under Brach's, Woolley's, Ishikawa's and Kudlich–Slibar's, with its own coefficients where they \
            fit and stated assumptions where not: how much does the answer depend on that choice? A case with [reconstruct] is \
            reconstructed under each; one with both speeds is computed forward.",
        after_help = "Example:\n  deltav compare fixtures/sae-980025.toml"
    )]
    Compare(Arguments),
}

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// The case file (TOML), or - for standard input
    pub(crate) case: PathBuf,

    /// Text for people, or JSON in SI units and radians for programs
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(crate) format: Format,

    /// Units of the text; without this, those that most of the case file is written in
    #[arg(long, value_enum)]
    pub(crate) units: Option<UnitSystem>,

    /// Write to FILE instead of standard output
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    Text,
    Json,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum UnitSystem {
    /// ft/s, mph, lb, ft·lb, in
    Us,
    /// m/s, km/h, kg, J, cm
    Si,
}
