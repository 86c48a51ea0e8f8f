//! Search for the place of a value in a JSON text.

use std::collections::BTreeMap;
use std::ops::Range;

use serde_json::value::RawValue;

use super::key_path::PathStep;

/// Returns the range of bytes of the value at the end of the path `steps`, or of the innermost value around it that
/// exists.
pub(super) fn locate(text: &str, steps: &[PathStep]) -> Option<Range<usize>> {
    let mut value: &RawValue = serde_json::from_str(text).ok()?;
    for step in steps {
        let inner = match step {
            PathStep::Key(key) => serde_json::from_str::<BTreeMap<String, &RawValue>>(value.get())
                .ok()
                .and_then(|table| table.get(key).copied()),
            PathStep::Index(index) => serde_json::from_str::<Vec<&RawValue>>(value.get())
                .ok()
                .and_then(|list| list.get(*index).copied()),
        };
        let Some(inner) = inner else { break };
        value = inner;
    }
    let start = value.get().as_ptr().addr() - text.as_ptr().addr();
    Some(start..start + value.get().len())
}
