//! The reference page of all keys, from the same descriptions.

use super::describe::{Later, Section, SectionKey};
use super::out::Out;

/// A page of Markdown with every table and key: what may stand there, the default, what it does, what it can make a
/// picture compute ([PLAN-1]), and the rule, which `rules.md` explains.
pub(crate) fn page(title: &str, root: &Section) -> String {
    let mut page = format!("# {title}\n");
    write(&mut page, "", root);
    page
}

/// Writes a table and the tables in it.
fn write(page: &mut String, path: &str, section: &Section) {
    let title = match path {
        "" => "Top of the file".into(),
        _ if path.contains(['.', '[']) => format!("`{path}`"),
        _ => format!("`[{path}]`"),
    };
    page.push_str(&format!("\n## {title}\n\n{}\n\n", escaped(section.doc)));
    page.push_str("| key | value | default | what it does | can call for | rule |\n|---|---|---|---|---|---|\n");
    section.keys.iter().for_each(|key| page.push_str(&row(path, key)));
    if let Some(open) = &section.open {
        let (value, doc) = (escaped(&open.shape.expected()), escaped(open.doc));
        page.push_str(&format!("| *any name*, at most {} | {value} | | {doc} | | |\n", open.most));
    }
    if !section.later.is_empty() {
        let name = |later: &Later| format!("`{}` ({})", later.name, rule(later.tag));
        let names: Vec<String> = section.later.iter().map(name).collect();
        page.push_str(&format!("\nNot built yet: {}.\n", names.join(", ")));
    }
    for key in &section.keys {
        let inner = if path.is_empty() { key.name.to_owned() } else { format!("{path}.{}", key.name) };
        if let Some(table) = key.shape.section() {
            if !is_of_the_top(path, &table) {
                write(page, &inner, &table);
            }
        } else if let Some(table) = key.shape.item_section() {
            write(page, &format!("{inner}[…]"), &table);
        }
    }
}

/// Whether a table inside the table at `outer` has the keys of a table at the top, where the keys are described.
pub(crate) fn is_of_the_top(outer: &str, table: &Section) -> bool {
    !outer.is_empty() && table.title.starts_with('[') && !table.title.contains('.')
}

fn row(path: &str, key: &SectionKey) -> String {
    let options = key.shape.options();
    let values = if !options.is_empty() {
        options.iter().map(|(name, doc)| format!("`{name:?}`: {}", escaped(doc))).collect::<Vec<_>>().join("<br>")
    } else if let Some(table) = key.shape.section().filter(|table| is_of_the_top(path, table)) {
        format!("as `{}`", table.title)
    } else if key.shape.section().is_some() {
        "below".into()
    } else if key.shape.item_section().is_some() {
        let most = key.shape.most_items().map(|most| format!("at most {most}, ")).unwrap_or_default();
        format!("{most}below")
    } else {
        escaped(&key.shape.expected())
    };
    let default = match &key.default {
        _ if key.required => "must be there".into(),
        None if key.absent.is_empty() => String::new(),
        None => escaped(key.absent),
        Some(Out::Table(_)) => "below".into(),
        Some(value) => format!("`{}`", value.toml()),
    };
    let needs: Vec<String> = key.needs.iter().map(|need| escaped(need.name())).collect();
    let (name, does, rule) = (key.name, escaped(&key.doc), rule(key.tag));
    format!("| `{name}` | {values} | {default} | {does} | {} | {rule} |\n", needs.join(", "))
}

/// A rule's tag, as a link to where it is explained.
fn rule(tag: &str) -> String {
    if tag.is_empty() { String::new() } else { format!("[{tag}](rules.md#{})", tag.to_lowercase()) }
}

/// Text for a cell of a table.
fn escaped(text: &str) -> String {
    text.replace('|', "\\|").replace('<', "&lt;")
}
