//! Shaders within shaders: a part of a picture with functions, types and numbers of its own, beside those of the whole.

use super::declarations::{Declaration, declarations};
use super::{Data, Shader};
use crate::Precision;
use std::collections::{BTreeMap, BTreeSet};

impl Shader {
    /// Attaches what another shader declares: `roots` and everything that they use. Each of these names gets the suffix,
    /// unless both shaders declare the same; names in `kept` stay. Names that the other shader does not declare stand for
    /// this one's.
    ///
    /// Both declare the same if the texts are, and read no variable of their own, and no number of the scene: a list of the
    /// same data is one list.
    pub(crate) fn attach(&mut self, other: Shader, precision: Precision, suffix: &str, roots: &[&str], kept: bool) {
        let (own_text, text) = (self.text(precision), other.text(precision));
        let own: BTreeMap<&str, Declaration<'_>> = by_name(&own_text);
        let all: BTreeMap<&str, Declaration<'_>> = by_name(&text);
        let (mut needed, order) = (reached(&all, roots), declarations(&text));
        // All numbers of the scene are in one list.
        needed.retain(|name| !["params", "Params"].contains(name));
        let data = |shader: &Shader, binding: Option<u32>| -> Option<Data> {
            let entry = shader.data.iter().find(|(at, ..)| Some(*at) == binding);
            entry.map(|(_, _, data)| data.clone())
        };
        let is_same_list = |a: &Declaration<'_>, b: &Declaration<'_>| {
            let data = [data(self, a.binding()), data(&other, b.binding())];
            data[0].is_some() && data[0] == data[1] && data[0].as_ref().is_some_and(Data::is_constant)
        };
        let is_same = |name: &&str| -> bool {
            let (Some(a), b) = (own.get(*name), &all[*name]) else { return false };
            if b.is_variable { a.is_variable && is_same_list(a, b) } else { a.text.trim() == b.text.trim() }
        };
        let mut shared: BTreeSet<&str> = needed.iter().copied().filter(is_same).collect();
        loop {
            let is_shared = |name: &&str| {
                all[*name].uses().all(|used| used != "params" && (!all.contains_key(used) || shared.contains(used)))
            };
            let left: BTreeSet<&str> = shared.iter().copied().filter(is_shared).collect();
            if left.len() == shared.len() {
                break;
            }
            shared = left;
        }
        let mut texts = Vec::new();
        let mut next_binding = self.data.iter().map(|(binding, ..)| binding + 1).max().unwrap_or(0).max(FIRST);
        let numbers: BTreeSet<&str> = other.block.names().collect();
        let rename = |name: &str| {
            let is_own = needed.contains(name) && !shared.contains(name) && !(kept && roots.contains(&name));
            (is_own || numbers.contains(name)).then(|| format!("{name}{suffix}"))
        };
        for declaration in order {
            let name = declaration.name;
            if !needed.contains(name) || shared.contains(name) {
                continue;
            }
            let mut text = declaration.renamed(rename);
            if let Some(binding) = declaration.binding() {
                let entry = other.data.iter().find(|(at, ..)| *at == binding);
                if let Some((_, what, data)) = entry {
                    text = text.replace(&format!("@binding({binding})"), &format!("@binding({next_binding})"));
                    self.data.push((next_binding, what, data.clone()));
                    next_binding += 1;
                }
            }
            texts.push(text);
        }
        self.block.append(&other.block, suffix);
        self.attached.push(texts.concat());
    }
}

/// Bindings of attached shaders begin here, behind those that modules have.
const FIRST: u32 = 32;

/// Declarations by their names.
fn by_name(text: &str) -> BTreeMap<&str, Declaration<'_>> {
    declarations(text).into_iter().map(|declaration| (declaration.name, declaration)).collect()
}

/// The names that roots lead to.
fn reached<'t>(all: &BTreeMap<&'t str, Declaration<'t>>, roots: &[&str]) -> BTreeSet<&'t str> {
    let mut found = BTreeSet::new();
    let mut open: Vec<&str> = roots.to_vec();
    while let Some(name) = open.pop() {
        if let Some((&name, declaration)) = all.get_key_value(name)
            && found.insert(name)
        {
            open.extend(declaration.uses());
        }
    }
    found
}
