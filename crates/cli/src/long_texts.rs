//! Carried texts that are too long for a table.

use std::sync::Arc;

use arrow_array::cast::AsArray as _;
use arrow_array::{Array, ArrayRef, LargeStringArray, RecordBatch, StringArray, StringViewArray};
use arrow_schema::{ArrowError, DataType};

/// (bytes) longest text that is carried over. A cell of a spreadsheet holds 32,767 letters, and a few
/// kilobytes of a damaged file can unpack into gigabytes of text.
pub(crate) const LONGEST: usize = 65_536;

/// The batch with a remark in place of each text in these columns that is too long, and the number of such
/// texts.
///
/// # Errors
/// None, as the columns keep their types.
pub(crate) fn shortened(batch: &RecordBatch, columns: &[usize]) -> Result<(RecordBatch, usize), ArrowError> {
    let (mut arrays, mut count) = (batch.columns().to_vec(), 0);
    for &place in columns {
        if let Some(array) = arrays.get_mut(place) {
            let (short, replaced) = column(array)?;
            *array = short;
            count += replaced;
        }
    }
    if count == 0 {
        Ok((batch.clone(), 0))
    } else {
        Ok((RecordBatch::try_new(batch.schema(), arrays)?, count))
    }
}

fn column(array: &ArrayRef) -> Result<(ArrayRef, usize), ArrowError> {
    let kept = || Ok((array.clone(), 0));
    if let Some(dictionary) = array.as_any_dictionary_opt() {
        let (values, replaced) = column(dictionary.values())?;
        return if replaced == 0 { kept() } else { Ok((dictionary.with_values(values), replaced)) };
    }
    let texts: Vec<Option<&str>> = match array.data_type() {
        DataType::Utf8 => array.as_string::<i32>().iter().collect(),
        DataType::LargeUtf8 => array.as_string::<i64>().iter().collect(),
        DataType::Utf8View => array.as_string_view().iter().collect(),
        _ => return kept(),
    };
    let is_long = |text: &&str| text.len() > LONGEST;
    let replaced = texts.iter().flatten().filter(|text| is_long(text)).count();
    if replaced == 0 {
        return kept();
    }
    let short = texts
        .into_iter()
        .map(|text| text.map(|text| if is_long(&text) { remark(text.len()) } else { text.to_owned() }));
    let short: ArrayRef = match array.data_type() {
        DataType::Utf8 => Arc::new(short.collect::<StringArray>()),
        DataType::LargeUtf8 => Arc::new(short.collect::<LargeStringArray>()),
        _ => Arc::new(short.collect::<StringViewArray>()),
    };
    Ok((short, replaced))
}

fn remark(bytes: usize) -> String {
    format!("(left out: a text of {bytes} bytes; at most {LONGEST} are carried over)")
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use arrow_array::cast::AsArray as _;
    use arrow_array::types::Int32Type;
    use arrow_array::{
        Array as _, ArrayRef, DictionaryArray, Float64Array, LargeStringArray, RecordBatch, StringArray,
        StringViewArray,
    };

    use super::{LONGEST, shortened};

    /// In each form that a text can have, the longest one stays, a longer one and no other is replaced.
    #[test]
    fn long_texts_are_replaced_and_counted() {
        let (fits, long) = ("a".repeat(LONGEST), "b".repeat(LONGEST + 1));
        let texts = [Some(fits.as_str()), Some(long.as_str()), None];
        let columns: [(&str, ArrayRef); 5] = [
            ("number", Arc::new(Float64Array::from(vec![1.0, 2.0, 3.0]))),
            ("text", Arc::new(StringArray::from_iter(texts))),
            ("large", Arc::new(LargeStringArray::from_iter(texts))),
            ("view", Arc::new(StringViewArray::from_iter(texts))),
            ("dictionary", Arc::new(DictionaryArray::<Int32Type>::from_iter(texts))),
        ];
        let batch = RecordBatch::try_from_iter(columns).unwrap();
        let (short, count) = shortened(&batch, &[0, 1, 2, 3, 4]).unwrap();
        assert_eq!((count, short.schema()), (4, batch.schema()));
        let remark = "(left out: a text of 65537 bytes; at most 65536 are carried over)";
        let expected = [Some(fits.as_str()), Some(remark), None];
        assert!(short["text"].as_string::<i32>().iter().eq(expected));
        assert!(short["large"].as_string::<i64>().iter().eq(expected));
        assert!(short["view"].as_string_view().iter().eq(expected));
        let dictionary = short["dictionary"].as_dictionary::<Int32Type>();
        assert!(dictionary.downcast_dict::<StringArray>().unwrap().into_iter().eq(expected));
        assert_eq!(&short["number"], &batch["number"]);
        // A column that is not carried over stays as it is.
        let (untouched, count) = shortened(&batch, &[0]).unwrap();
        assert_eq!((count, untouched["text"].len()), (0, 3));
        assert_eq!(&untouched["text"], &batch["text"]);
    }
}
