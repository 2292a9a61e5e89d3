//! Functions as text.

use std::fmt::Write;

/// Appends a function with these lines. It returns an expression, or nothing.
pub(crate) fn write_function(
    text: &mut String,
    head: &str,
    lines: impl IntoIterator<Item = String>,
    result: Option<&str>,
) {
    let _ = write!(text, "\nfn {head} {{\n");
    for line in lines {
        let _ = writeln!(text, "    {line}");
    }
    if let Some(result) = result {
        let _ = writeln!(text, "    return {result};");
    }
    text.push_str("}\n");
}
