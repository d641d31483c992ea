//! A text that is accepted as a quantity is finite, and reads back as the same; one that is refused has its
//! reason and remedy.
#![no_main]

use case::{Dimension, read_quantity};
use libfuzzer_sys::fuzz_target;

// The first byte chooses the dimension, the others are the text.
fuzz_target!(|data: &[u8]| {
    let Some((&first, text)) = data.split_first() else { return };
    let Ok(text) = std::str::from_utf8(text) else { return };
    let dimension = Dimension::ALL[usize::from(first) % Dimension::ALL.len()];
    match read_quantity(text, dimension) {
        Ok(quantity) => {
            assert!(quantity.si().is_finite(), "{quantity:?}");
            assert!(quantity.si().abs() <= dimension.bound(), "{quantity:?}");
            assert_eq!(quantity.dimension(), dimension);
            let written = quantity.to_string();
            assert_eq!(read_quantity(&written, dimension).as_ref(), Ok(&quantity), "written as {written}");
        }
        Err(error) => {
            assert!(!error.to_string().is_empty());
            assert!(!error.help().is_empty());
        }
    }
});
