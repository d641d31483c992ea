//! A root, and the constants of Newton's method.

/// Steps of Newton's method: the first speed is a few per cent off, and each step doubles the digits. All
/// steps are taken, even after convergence, so that loops over many samples vectorise.
pub(crate) const STEPS: usize = 6;

/// The last step is at most this fraction of the speed: the remaining error is its square.
pub(crate) const CONVERGED: f64 = 1e-10;

/// An approach speed at which W_n has the value sought.
pub(crate) struct Root<S> {
    /// (m/s) x = −u_n.
    pub(crate) x: f64,
    /// The recorded steps of the search.
    pub(crate) steps: S,
}
