//! `deltav explain`.

use anyhow::Result;

use crate::arguments::ExplainArguments;
use crate::present::present;

pub(crate) fn explain(ExplainArguments { topic, format, output }: &ExplainArguments) -> Result<()> {
    let topic = match topic.as_slice() {
        [] => None,
        words => Some(report::topic(&words.join(" "))?),
    };
    let document = || Ok(topic.map_or_else(report::list_of_topics, report::explanation));
    present(*format, output.file(), document, || topic.map_or_else(report::topics_json, report::topic_json))
}
