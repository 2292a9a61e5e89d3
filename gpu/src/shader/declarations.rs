//! The declarations of a WGSL text: its functions, types, constants and variables.
//!
//! Lines within a declaration are indented, or end with an opening bracket. A declaration ends with a line of `}` or `;`.

use std::ops::Range;

/// A declaration, with the comments and the attributes before it.
pub(super) struct Declaration<'t> {
    pub(super) name: &'t str,
    pub(super) text: &'t str,
    keyword: &'t str,
}

impl<'t> Declaration<'t> {
    /// Whether it is a variable.
    pub(super) fn is_variable(&self) -> bool {
        self.keyword == "var"
    }

    /// The identifiers that may stand for declarations.
    pub(super) fn uses(&self) -> impl Iterator<Item = &'t str> {
        self.identifiers().map(|range| &self.text[range])
    }

    /// The text with renamed identifiers. An identifier for which `rename` returns none is kept.
    pub(super) fn renamed(&self, rename: impl Fn(&str) -> Option<String>) -> String {
        let (mut text, mut end) = (String::new(), 0);
        for range in self.identifiers() {
            if let Some(name) = rename(&self.text[range.clone()]) {
                text.push_str(&self.text[end..range.start]);
                text.push_str(&name);
                end = range.end;
            }
        }
        text + &self.text[end..]
    }

    /// The binding of a variable.
    pub(super) fn binding(&self) -> Option<u32> {
        let (_, rest) = self.text.split_once("@group(1) @binding(")?;
        rest.split_once(')')?.0.parse().ok()
    }

    /// The places of identifiers that may stand for declarations. Members and attributes do not, except that a member
    /// of the parameters stands for a number of the scene.
    fn identifiers(&self) -> impl Iterator<Item = Range<usize>> {
        let (text, is_struct) = (self.text, self.keyword == "struct");
        words(text).filter(move |word| {
            let (before, after) = (&text[..word.start], &text[word.end..]);
            let is_member =
                before.ends_with('.') && !before.ends_with("params.") || is_struct && after.starts_with(':');
            !is_member && !before.ends_with('@')
        })
    }
}

/// The words of a text that begin with a letter, without comments.
fn words(text: &str) -> impl Iterator<Item = Range<usize>> {
    let mut at = 0;
    let all = std::iter::from_fn(move || {
        loop {
            let rest = &text[at..];
            let start = at + rest.find(|c: char| c == '/' || is_word(c))?;
            let rest = &text[start..];
            if let Some(behind) = rest.strip_prefix('/') {
                at = start + if behind.starts_with('/') { rest.find('\n').unwrap_or(rest.len()) } else { 1 };
                continue;
            }
            at = start + rest.find(|c: char| !is_word(c)).unwrap_or(rest.len());
            return Some(start..at);
        }
    });
    all.filter(|word| !text[word.start..].starts_with(|c: char| c.is_ascii_digit()))
}

fn is_word(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

/// The declarations of a text, in their order.
pub(super) fn declarations(text: &str) -> impl Iterator<Item = Declaration<'_>> {
    let (mut start, mut end) = (0, 0);
    text.split_inclusive('\n').filter_map(move |line| {
        end += line.len();
        let ends = !line.starts_with([' ', '/']) && line.trim_end().ends_with(['}', ';']);
        ends.then(|| declaration(&text[std::mem::replace(&mut start, end)..end])).flatten()
    })
}

/// A declaration by its text.
fn declaration(text: &str) -> Option<Declaration<'_>> {
    const KEYWORDS: [&str; 6] = ["fn", "struct", "const", "override", "alias", "var"];
    let keyword = words(text).find(|word| KEYWORDS.contains(&&text[word.clone()]))?;
    // The address space of a variable comes before its name.
    let behind = &text[keyword.end..];
    let skipped = if behind.starts_with('<') { behind.find('>')? } else { 0 };
    let name = words(&behind[skipped..]).next()?;
    Some(Declaration { name: &behind[skipped..][name], text, keyword: &text[keyword] })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "// One of b.\n@group(1) @binding(3) var<storage, read> list: array<Item>;\n\n\
                        struct Item {\n    // A size.\n    size: real,\n}\n\n\
                        fn first(size: real) -> real {\n    return list[0].size * params.size + 1.0e-2; // size\n}\n";

    #[test]
    fn declarations_have_names_and_what_they_use() {
        let found: Vec<_> = declarations(TEXT).collect();
        let names: Vec<&str> = found.iter().map(|found| found.name).collect();
        assert_eq!(names, ["list", "Item", "first"]);
        assert_eq!(found[0].binding(), Some(3));
        assert!(found[0].is_variable() && !found[2].is_variable());
        let uses: Vec<&str> = found[1].uses().collect();
        assert_eq!(uses, ["struct", "Item", "real"]);
        assert_eq!(found.iter().map(|found| found.text).collect::<String>(), TEXT);
    }

    #[test]
    fn members_keep_their_names() {
        let found: Vec<_> = declarations(TEXT).collect();
        let rename = |name: &str| (name == "size").then(|| "width".to_owned());
        assert_eq!(found[1].renamed(rename), found[1].text);
        let function = found[2].renamed(rename);
        assert!(function.contains("fn first(width: real)") && function.contains("list[0].size * params.width"));
        assert!(function.ends_with("1.0e-2; // size\n}\n"));
    }
}
