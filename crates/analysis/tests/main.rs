//! The tests of a case analysed, in one binary.

mod avoid;
mod both_speeds;
mod checks;
mod choice;
mod contact;
mod coverage;
mod driven;
mod edcrash;
mod energies;
mod estimates;
mod evidence;
mod friction;
mod headline;
mod inputs;
mod judgement;
mod momentum_asked;
mod plausibility;
mod public_cases;
mod recorders;
mod same_line;
mod sensitivity;
mod tangential_share;
mod to_rest;
mod uncertainty;
mod warnings;
mod way_out;
