//! How many particles and islands a run can have.

/// The number of particles of an island is a multiple of this: two halves of whole blocks.
pub const PARTICLES_STEP: usize = 2 * uncertainty::LANES;

/// The most particles of an island: a million draws of [`ISLANDS`](crate::ISLANDS) islands, which take some
/// gigabytes.
pub const MOST_PARTICLES: usize = 1 << 16;

/// The fewest islands: between fewer the spread says nearly nothing.
pub const LEAST_ISLANDS: usize = 4;
