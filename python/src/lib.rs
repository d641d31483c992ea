//! The Python package `pydeltav`: the engine of the program for notebooks and tables. Its README gives the
//! commands that install it.
//!
//! [`given`] reads a case, [`request`] asks the libraries, [`solved`] hands the answer to Python. Work that
//! may take long goes through [`run`], which releases the interpreter's lock and listens to Ctrl-C.

mod ciss;
mod columns;
mod dict;
mod errors;
mod given;
mod picture;
mod request;
mod rows;
mod run;
mod solved;
mod stream;
mod table;

use pyo3::prelude::*;

/// The part of the package that is written in Rust; use ``import pydeltav``.
#[pymodule]
fn _pydeltav(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<given::PyCase>()?;
    module.add_class::<picture::Picture>()?;
    module.add_class::<columns::Columns>()?;
    for class in solved::classes(module.py()) {
        module.add(class.name()?, &class)?;
    }
    module.add_class::<rows::Rows>()?;
    module.add_class::<stream::RowStream>()?;
    module.add_class::<rows::PySchema>()?;
    for function in [
        wrap_pyfunction!(rows::reconstruct_table, module)?,
        wrap_pyfunction!(rows::impact_table, module)?,
        wrap_pyfunction!(rows::crush_table, module)?,
        wrap_pyfunction!(rows::estimate_table, module)?,
        wrap_pyfunction!(rows::stream_table, module)?,
        wrap_pyfunction!(rows::case_schema, module)?,
        wrap_pyfunction!(rows::result_schema, module)?,
    ] {
        // As users import them.
        function.setattr("__module__", "pydeltav")?;
        module.add_function(function)?;
    }
    module.add_class::<ciss::Judged>()?;
    module.add_function(wrap_pyfunction!(ciss::case_of_pair, module)?)?;
    module.add_function(wrap_pyfunction!(ciss::judge_pairs, module)?)?;
    module.add_function(wrap_pyfunction!(ciss::columns_of_pairs, module)?)?;
    module.add_function(wrap_pyfunction!(ciss::ciss_columns, module)?)?;
    module.add_function(wrap_pyfunction!(ciss::ciss_pairs, module)?)?;
    module.add_function(wrap_pyfunction!(ciss::ciss_records, module)?)?;
    module.add_function(wrap_pyfunction!(ciss::saved_pairs, module)?)?;
    module.add_function(wrap_pyfunction!(given::restore_case, module)?)?;
    module.add_function(wrap_pyfunction!(columns::restore_columns, module)?)?;
    module.add_function(wrap_pyfunction!(solved::restore_result, module)?)?;
    Ok(())
}
