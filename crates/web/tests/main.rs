//! The functions of the page, called on this machine.
