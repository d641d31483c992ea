//! Columns of a table next to the results.

use std::sync::Arc;

use arrow_array::RecordBatch;
use arrow_schema::{Schema, SchemaRef};

use crate::TableError;

/// Columns of a table that are copied to its results.
#[derive(Clone, Debug)]
pub struct Carried {
    places: Vec<usize>,
    schema: SchemaRef,
}

impl Carried {
    /// The columns of a table at these indices, followed by the results.
    ///
    /// # Errors
    /// [`TableError::NameOfResult`] if a column has the name of one of the results, and [`TableError::Arrow`]
    /// if the table has no column at an index.
    pub fn new(table: &Schema, places: Vec<usize>, results: &Schema) -> Result<Self, TableError> {
        let kept = table.project(&places)?;
        if let Some(field) = kept.fields().iter().find(|field| results.field_with_name(field.name()).is_ok())
        {
            return Err(TableError::NameOfResult { column: field.name().clone() });
        }
        let fields: Vec<_> = kept.fields().iter().chain(results.fields()).cloned().collect();
        let schema = Arc::new(Schema::new_with_metadata(fields, results.metadata().clone()));
        Ok(Self { places, schema })
    }

    /// The schema of both together.
    #[must_use]
    pub fn schema(&self) -> &SchemaRef {
        &self.schema
    }

    /// The carried columns of a batch, followed by its results.
    ///
    /// # Errors
    /// [`TableError::Arrow`] if the batch and its results do not have the schemas of the table and of its
    /// results, or differ in their number of rows.
    pub fn beside(&self, batch: &RecordBatch, results: &RecordBatch) -> Result<RecordBatch, TableError> {
        let kept = batch.project(&self.places)?;
        let columns = kept.columns().iter().chain(results.columns()).cloned().collect();
        Ok(RecordBatch::try_new(self.schema.clone(), columns)?)
    }
}
