//! Limits of the number of particles and islands.

/// The number of particles of an island is a multiple of this: two halves of whole blocks.
pub const PARTICLES_STEP: usize = 2 * uncertainty::LANES;

/// Maximum number of particles of an island: a million draws from [`ISLANDS`](crate::ISLANDS) islands, which
/// take some gigabytes.
pub const MOST_PARTICLES: usize = 1 << 16;

/// Minimum number of islands: the spread between fewer is almost meaningless.
pub const LEAST_ISLANDS: usize = 4;
