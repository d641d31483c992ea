//! The words of the program around this crate, for errors that point to its commands.

use inputs::Purpose;

/// What a program calls what an error text points to. A library has no commands, which is the default.
#[derive(Clone, Copy, Debug)]
pub struct Program {
    /// What it calls a purpose that a case lacks something for.
    pub name: fn(Purpose) -> String,
    /// What writes a case to begin with.
    pub begins: Option<&'static str>,
    /// What describes CRASH3's size classes.
    pub describes_classes: Option<&'static str>,
}

impl Program {
    /// None: purposes have their own names, and nothing is pointed to.
    pub const NONE: Self =
        Self { name: |purpose| format!("`{purpose}`"), begins: None, describes_classes: None };
}

impl Default for Program {
    fn default() -> Self {
        Self::NONE
    }
}
