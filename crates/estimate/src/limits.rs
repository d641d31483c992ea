//! Limits of the number of particles and islands.

/// The number of particles of an island is a multiple of this: two halves of whole blocks.
pub const PARTICLES_STEP: usize = 2 * uncertainty::LANES;

/// Maximum number of particles of an island: 262,144 draws from [`ISLANDS`](crate::ISLANDS) islands. An
/// estimate by crush, directions and a recorder takes 2.8 GB with four times as many.
pub const MOST_PARTICLES: usize = 1 << 14;

/// Minimum number of islands: the spread between fewer is almost meaningless.
pub const LEAST_ISLANDS: usize = 4;

/// Maximum number of islands.
pub const MOST_ISLANDS: usize = 1 << 10;
