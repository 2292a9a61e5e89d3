//! Shaders within shaders: a part of a picture with functions, types and numbers of its own, beside those of the whole.

use super::declarations::{Declaration, declarations};
use super::{Data, Shader};
use crate::Precision;
use std::collections::BTreeMap;

/// The first binding of attached shaders. It lies behind those of modules.
const FIRST: u32 = 32;

impl Shader {
    /// Attaches declarations of another shader: `roots` and everything that they use. Each name gets the suffix, unless
    /// both shaders declare the same; with `kept`, the roots keep theirs. A name that the other shader lacks refers to
    /// this shader's declaration.
    ///
    /// Declarations are the same if their texts are, and if they read neither a variable of their own nor a number of
    /// the scene. Lists of the same data are shared.
    pub(crate) fn attach(&mut self, other: Shader, precision: Precision, suffix: &str, roots: &[&str], kept: bool) {
        let (own_text, text) = (self.text(precision), other.text(precision));
        let (own, all) = (by_name(&own_text), by_name(&text));
        let data = |shader: &Shader, binding: u32| -> Option<(&'static str, Data)> {
            shader.data.iter().find(|(at, ..)| *at == binding).map(|(_, what, data)| (*what, data.clone()))
        };
        let is_same_list = |a: &Declaration<'_>, b: &Declaration<'_>| {
            let [a, b] = [(&*self, a), (&other, b)].map(|(shader, of)| of.binding().and_then(|at| data(shader, at)));
            matches!((a, b), (Some((_, a)), Some((_, b))) if a == b && a.is_constant())
        };
        let differs = |b: &Declaration<'_>| match own.get(b.name) {
            Some(a) if b.is_variable() => !a.is_variable() || !is_same_list(a, b),
            Some(a) => a.text.trim() != b.text.trim(),
            None => true,
        };
        let mut needed = BTreeMap::new();
        for root in roots {
            find_own(root, &all, &differs, &mut needed);
        }
        let numbers: Vec<&str> = other.block.names().collect();
        let rename = |name: &str| {
            let is_own = needed.get(name) == Some(&true) && !(kept && roots.contains(&name));
            (is_own || numbers.contains(&name)).then(|| format!("{name}{suffix}"))
        };
        let mut next_binding = self.data.iter().map(|(binding, ..)| binding + 1).max().unwrap_or(0).max(FIRST);
        let mut attached = String::new();
        for declaration in declarations(&text).filter(|declaration| needed.get(declaration.name) == Some(&true)) {
            let mut text = declaration.renamed(rename);
            if let Some(binding) = declaration.binding()
                && let Some((what, data)) = data(&other, binding)
            {
                text = text.replace(&format!("@binding({binding})"), &format!("@binding({next_binding})"));
                self.data.push((next_binding, what, data));
                next_binding += 1;
            }
            attached.push_str(&text);
        }
        self.block.append(&other.block, suffix);
        self.attached.push(attached);
    }
}

/// Declarations by their names.
fn by_name(text: &str) -> BTreeMap<&str, Declaration<'_>> {
    declarations(text).map(|declaration| (declaration.name, declaration)).collect()
}

/// Finds the declarations that a name leads to. A declaration is the part's own if its text differs, or if it uses one
/// that is the part's own. The list of the scene's numbers counts as the part's own, and is not attached.
fn find_own<'t>(
    name: &str,
    all: &BTreeMap<&'t str, Declaration<'t>>,
    differs: &dyn Fn(&Declaration<'_>) -> bool,
    found: &mut BTreeMap<&'t str, bool>,
) -> bool {
    let Some((&name, declaration)) = all.get_key_value(name) else { return false };
    if ["params", "Params"].contains(&name) {
        return true;
    }
    if let Some(&is_own) = found.get(name) {
        return is_own;
    }
    let mut is_own = differs(declaration);
    // A declaration uses its own name.
    found.insert(name, is_own);
    for used in declaration.uses() {
        is_own |= find_own(used, all, differs, found);
    }
    found.insert(name, is_own);
    is_own
}
