//! The command names of the program that uses this crate, for error texts that refer to them.

use inputs::Purpose;

/// The names of purposes and commands in error texts. The default is for a library, which has no commands.
#[derive(Clone, Copy, Debug)]
pub struct Program {
    /// The name of a purpose that a case is incomplete for.
    pub name: fn(Purpose) -> String,
    /// The command that writes a template.
    pub begins: Option<&'static str>,
    /// The command that describes CRASH3's size classes.
    pub describes_classes: Option<&'static str>,
    /// The command that explains what to do if neither speed is known.
    pub explains_two_speeds: Option<&'static str>,
}

impl Program {
    /// No program: purposes keep their own names, and no command is mentioned.
    pub const NONE: Self = Self {
        name: |purpose| format!("`{purpose}`"),
        begins: None,
        describes_classes: None,
        explains_two_speeds: None,
    };
}

impl Default for Program {
    fn default() -> Self {
        Self::NONE
    }
}
