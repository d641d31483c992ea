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
    /// Say how much the answer moves with each estimate
    #[command(
        long_about = "Say how much the answer moves with each estimate.\n\n\
            A case with [reconstruct] gets the exact derivative of the speed found and of both velocity changes by each number of the file, in that \
            number's own unit and in per cent per per cent, the most influential first. Any case whose damage and directions of force are \
            known gets a sweep of the PDOF: CRASH3's answer for lines of action turned to both sides, positive counter-clockwise.",
        after_help = "Examples:\n  deltav sensitivity fixtures/sae-980025.toml\n  \
            deltav sensitivity fixtures/sae-980025.toml --pdof-step 10 --pdof-steps 1 --format json"
    )]
    Sensitivity(SensitivityArguments),
}

#[derive(Debug, Args)]
pub(crate) struct SensitivityArguments {
    #[command(flatten)]
    pub(crate) arguments: Arguments,

    /// Degrees from one direction of force to the next
    #[arg(long, value_name = "DEGREES", default_value_t = 5.0, value_parser = degrees)]
    pub(crate) pdof_step: f64,

    /// Directions of force to each side of the nominal one
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u32).range(0..=180))]
    pub(crate) pdof_steps: u32,
}

fn degrees(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(degrees) if degrees > 0.0 && degrees <= 180.0 => Ok(degrees),
        _ => Err("give degrees above 0 and up to 180, such as 5".to_owned()),
    }
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
