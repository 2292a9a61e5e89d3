//! Multiplications of WGSL modules, and texts of shaders with a fault in one of them.

use std::ops::Range;
use std::path::Path;

/// A multiplication of a module.
pub(super) struct Multiplication {
    /// The path of the module from `gpu/src`, without suffix.
    pub(super) module: String,
    /// The number of its line in the file.
    pub(super) line: usize,
    /// Its line.
    pub(super) text: String,
    /// The place of the operator in the line.
    pub(super) column: usize,
    /// The text of its function.
    function: String,
    /// The number of the operator in the function.
    number: usize,
}

/// The multiplications of all modules below a folder, in the order of their paths.
///
/// # Errors
/// The system's failure to read a file.
pub(super) fn multiplications(root: &Path) -> std::io::Result<Vec<Multiplication>> {
    let (mut folders, mut files) = (vec![root.to_owned()], Vec::new());
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder)? {
            let path = entry?.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "wgsl") {
                files.push(path);
            }
        }
    }
    files.sort();
    let mut found = Vec::new();
    for file in files {
        let name = file.strip_prefix(root).unwrap_or(&file).with_extension("");
        of_module(&name.display().to_string().replace('\\', "/"), &std::fs::read_to_string(&file)?, &mut found);
    }
    Ok(found)
}

fn of_module(module: &str, text: &str, found: &mut Vec<Multiplication>) {
    for function in functions(text) {
        for (number, at) in operators(&text[function.clone()]).into_iter().enumerate() {
            let at = function.start + at;
            let start = text[..at].rfind('\n').map_or(0, |end| end + 1);
            let line = text[start..].lines().next().unwrap_or_default();
            found.push(Multiplication {
                module: module.to_owned(),
                line: text[..at].matches('\n').count() + 1,
                text: line.trim().to_owned(),
                column: at - start - (line.len() - line.trim_start().len()),
                function: text[function.clone()].to_owned(),
                number,
            });
        }
    }
}

impl Multiplication {
    /// The text of a shader with the result of the multiplication 1 % too large, in each copy of its function. Returns none
    /// if there is no copy.
    pub(super) fn planted(&self, text: &str) -> Option<String> {
        let (mut planted, mut end) = (String::new(), 0);
        for function in functions(text).filter(|range| is_copy(&self.function, &text[range.clone()])) {
            let at = function.start + *operators(&text[function]).get(self.number)?;
            planted.push_str(&text[end..at]);
            if let Some(factor) = text[at..].strip_prefix("*=") {
                let factor = factor.split(';').next()?;
                planted.push_str(&format!("*= 1.01 * ({factor})"));
                end = at + 2 + factor.len();
            } else {
                planted.push_str("* 1.01 *");
                end = at + 1;
            }
        }
        (end > 0).then(|| planted + &text[end..])
    }

    /// Whether the shader has the module's function.
    pub(super) fn is_in(&self, text: &str) -> bool {
        functions(text).any(|range| is_copy(&self.function, &text[range]))
    }
}

/// The functions of a text: from `fn` to the bracket that stands alone.
fn functions(text: &str) -> impl Iterator<Item = Range<usize>> {
    text.match_indices("\nfn ").filter_map(|(at, _)| {
        let length = text[at + 1..].find("\n}")?;
        Some(at + 1..at + 1 + length + 2)
    })
}

/// The places of the operators of multiplication. Modules dereference no pointer.
fn operators(function: &str) -> Vec<usize> {
    let is_code = |at: usize| !function[..at].rsplit('\n').next().unwrap_or_default().contains("//");
    function.match_indices('*').map(|(at, _)| at).filter(|&at| is_code(at)).collect()
}

/// Whether a function is a copy of another one: a part of a picture gives a suffix to names of its own.
fn is_copy(original: &str, copy: &str) -> bool {
    let is_break = |c: char| !(c.is_ascii_alphanumeric() || c == '_');
    let is_suffix = |rest: &str| {
        let rest = rest.strip_prefix("_of_selection").unwrap_or(rest);
        rest.is_empty() || rest.strip_prefix('_').is_some_and(|part| part.bytes().all(|c| c.is_ascii_digit()))
    };
    let is_same = |(a, b): (&str, &str)| b.strip_prefix(a).is_some_and(is_suffix);
    original.len() <= copy.len()
        && original.chars().filter(|&c| is_break(c)).eq(copy.chars().filter(|&c| is_break(c)))
        && original.split(is_break).zip(copy.split(is_break)).all(is_same)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_copy_gets_the_fault() {
        let module =
            "// a * b\n\nfn f(x: real) -> real {\n    var y = x * x; // x * x\n    y *= x + 1.0;\n    return y;\n}\n";
        let mut found = Vec::new();
        of_module("m", module, &mut found);
        let places: Vec<_> = found.iter().map(|m| (m.line, m.text.as_str(), m.column)).collect();
        assert_eq!(places, [(4, "var y = x * x; // x * x", 10), (5, "y *= x + 1.0;", 2)]);
        let shader = format!("{module}{}", module.replace("f(", "f_of_selection_0(").replace("x * x;", "x_0 * x;"));
        let [first, second] = [0, 1].map(|i| found[i].planted(&shader).unwrap());
        assert!(first.contains("x * 1.01 * x;") && first.contains("x_0 * 1.01 * x;") && !first.contains("*= 1.01"));
        assert_eq!(second.matches("y *= 1.01 * ( x + 1.0);").count(), 2);
        assert!(found[0].planted(&module.replace("x + 1.0", "x + 2.0")).is_none());
    }
}
