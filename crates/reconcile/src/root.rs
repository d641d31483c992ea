//! A root, and how Newton's method finds one.

/// Steps of Newton's method: the first speed is a few per cent off, and each step doubles the digits. All of
/// them are made, whenever it converges, so that loops over many samples vectorise.
pub(crate) const STEPS: usize = 6;

/// The last step is at most this share of the speed: the error left is its square.
pub(crate) const CONVERGED: f64 = 1e-10;

/// An approach speed at which W_n has the value sought.
pub(crate) struct Root<S> {
    /// (m/s) x = −u_n.
    pub(crate) x: f64,
    /// What is kept of how it was found.
    pub(crate) steps: S,
}
