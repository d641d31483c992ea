//! The command names of the program that uses this crate, for error texts that refer to them.

use inputs::Purpose;

/// How a program names what error texts refer to. The default is a library, which has no commands.
#[derive(Clone, Copy, Debug)]
pub struct Program {
    /// The name of a purpose that a case is incomplete for.
    pub name: fn(Purpose) -> String,
    /// The command that writes a template.
    pub begins: Option<&'static str>,
    /// The command that describes CRASH3's size classes.
    pub describes_classes: Option<&'static str>,
    /// The command that explains what to do where neither speed is known.
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
