//! The declarations of a WGSL text: its functions, types, constants and variables.

use std::ops::Range;

/// A declaration, with the comments and the attributes before it.
pub(super) struct Declaration<'t> {
    pub(super) name: &'t str,
    pub(super) text: &'t str,
    /// Identifiers in the text that may stand for declarations: no members, no attributes.
    identifiers: Vec<Range<usize>>,
    /// Whether it is a variable.
    pub(super) is_variable: bool,
}

impl<'t> Declaration<'t> {
    /// The identifiers that may stand for declarations.
    pub(super) fn uses(&self) -> impl Iterator<Item = &'t str> {
        let text = self.text;
        self.identifiers.iter().map(move |range| &text[range.clone()])
    }

    /// The text with other identifiers; none: the identifier as it is.
    pub(super) fn renamed(&self, rename: impl Fn(&str) -> Option<String>) -> String {
        let (mut text, mut end) = (String::new(), 0);
        for range in &self.identifiers {
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
}

/// The declarations of a text, in their order.
pub(super) fn declarations(text: &str) -> Vec<Declaration<'_>> {
    let (mut found, mut start, mut depth) = (Vec::new(), 0, 0);
    let (mut tokens, mut is_struct) = (Vec::new(), false);
    let all = Tokens { text, at: 0 };
    for token in all {
        let word = &text[token.clone()];
        match word {
            "{" => depth += 1,
            "}" => depth -= 1,
            _ if depth == 0 && word == "struct" => is_struct = true,
            _ => {}
        }
        tokens.push(token.clone());
        let ends = depth == 0 && (word == ";" || word == "}");
        if ends {
            found.extend(declaration(text, start..token.end, &tokens, is_struct));
            (start, is_struct) = (token.end, false);
            tokens.clear();
        }
    }
    found
}

/// The declaration of a part of a text with its tokens.
fn declaration<'t>(
    text: &'t str,
    part: Range<usize>,
    tokens: &[Range<usize>],
    is_struct: bool,
) -> Option<Declaration<'t>> {
    const KEYWORDS: [&str; 6] = ["fn", "struct", "const", "override", "alias", "var"];
    let word = |i: usize| tokens.get(i).map_or("", |token| &text[token.clone()]);
    let keyword = (0..tokens.len()).find(|&i| KEYWORDS.contains(&word(i)))?;
    // Of a variable the address space comes first.
    let name =
        if word(keyword + 1) == "<" { (keyword..tokens.len()).find(|&i| word(i) == ">")? + 1 } else { keyword + 1 };
    let is_identifier = |i: usize| word(i).starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    let stands_alone = |i: usize| {
        let before = if i == 0 { "" } else { word(i - 1) };
        // The members of a type stand before a colon, those of a value behind a point.
        before != "." && before != "@" && !(is_struct && word(i + 1) == ":")
    };
    // A member of the parameters stands for a number of the scene.
    let is_parameter = |i: usize| i > 1 && word(i - 1) == "." && word(i - 2) == "params";
    let identifiers = (0..tokens.len()).filter(|&i| is_identifier(i) && (stands_alone(i) || is_parameter(i)));
    let identifiers = identifiers.map(|i| tokens[i].start - part.start..tokens[i].end - part.start).collect();
    let name = &text[tokens.get(name)?.clone()];
    Some(Declaration { name, text: &text[part], identifiers, is_variable: word(keyword) == "var" })
}

/// Words, numbers and signs of a text, without comments and spaces.
struct Tokens<'t> {
    text: &'t str,
    at: usize,
}

impl Iterator for Tokens<'_> {
    type Item = Range<usize>;

    fn next(&mut self) -> Option<Range<usize>> {
        loop {
            let rest = &self.text[self.at..];
            let first = rest.chars().next()?;
            if rest.starts_with("//") {
                self.at += rest.find('\n').unwrap_or(rest.len());
                continue;
            }
            let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
            let end = if first.is_ascii_digit() {
                rest.find(|c: char| !is_word(c) && c != '.')
            } else if is_word(first) {
                rest.find(|c: char| !is_word(c))
            } else {
                Some(first.len_utf8())
            };
            let token = self.at..self.at + end.unwrap_or(rest.len());
            self.at = token.end;
            if !first.is_whitespace() {
                return Some(token);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "// One of b.\n@group(1) @binding(3) var<storage, read> list: array<Item>;\n\n\
                        struct Item {\n    // A size.\n    size: real,\n}\n\n\
                        fn first(size: real) -> real {\n    return list[0].size * params.size + 1.0e-2; // size\n}\n";

    #[test]
    fn declarations_have_names_and_what_they_use() {
        let found = declarations(TEXT);
        let names: Vec<&str> = found.iter().map(|found| found.name).collect();
        assert_eq!(names, ["list", "Item", "first"]);
        assert_eq!(found[0].binding(), Some(3));
        assert!(found[0].is_variable && !found[2].is_variable);
        let uses: Vec<&str> = found[1].uses().collect();
        assert_eq!(uses, ["struct", "Item", "real"]);
        assert_eq!(found.iter().map(|found| found.text).collect::<String>(), TEXT.trim_end());
    }

    #[test]
    fn members_keep_their_names() {
        let found = declarations(TEXT);
        let rename = |name: &str| (name == "size").then(|| "width".to_owned());
        assert_eq!(found[1].renamed(rename), found[1].text);
        let function = found[2].renamed(rename);
        assert!(function.contains("fn first(width: real)") && function.contains("list[0].size * params.width"));
        assert!(function.ends_with("1.0e-2; // size\n}"));
    }
}
