//! The scalars that a shader reads.

use crate::Precision;
use drypoint_scene::glam::DVec3;
use std::fmt::Write;

/// Scalars by their names. The WGSL struct has numbers alone, so member i lies at i times the size of a number,
/// whatever its type. A vector is three numbers and a function that joins them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ParamBlock {
    fields: Vec<(String, f64)>,
    vectors: Vec<&'static str>,
}

impl ParamBlock {
    /// Adds a number, `params.name` in the shader.
    pub(crate) fn number(&mut self, name: impl Into<String>, value: f64) {
        self.fields.push((name.into(), value));
    }

    /// Adds a vector, `name()` in the shader.
    pub(crate) fn vector(&mut self, name: &'static str, value: DVec3) {
        for (axis, value) in ["x", "y", "z"].into_iter().zip(value.to_array()) {
            self.number(format!("{name}_{axis}"), value);
        }
        self.vectors.push(name);
    }

    /// The struct, its binding, and the functions of vectors.
    pub(crate) fn wgsl(&self) -> String {
        let mut text = String::from("struct Params {\n");
        for (name, _) in &self.fields {
            let _ = writeln!(text, "    {name}: real,");
        }
        text.push_str("}\n\n@group(0) @binding(0) var<storage, read> params: Params;\n");
        for name in &self.vectors {
            let _ = write!(
                text,
                "\nfn {name}() -> vec3<real> {{\n    return vec3<real>(params.{name}_x, params.{name}_y, params.{name}_z);\n}}\n"
            );
        }
        text
    }

    /// The numbers as the shader reads them.
    pub(crate) fn bytes(&self, precision: Precision) -> Vec<u8> {
        let values: Vec<f64> = self.fields.iter().map(|(_, value)| *value).collect();
        precision.bytes(&values)
    }

    /// Replaces the numbers that another block also has by the other block's.
    pub(crate) fn update(&mut self, other: &Self) {
        other.fields.iter().for_each(|(name, value)| self.set(name, *value));
    }

    /// The place of a number; none if the block does not have it.
    pub(crate) fn place(&self, name: &str) -> Option<usize> {
        self.fields.iter().position(|field| field.0 == name)
    }

    /// The names of the numbers.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.fields.iter().map(|(name, _)| name.as_str())
    }

    /// Adds the numbers of another block, with a suffix to their names.
    pub(crate) fn append(&mut self, other: &Self, suffix: &str) {
        self.fields.extend(other.fields.iter().map(|(name, value)| (format!("{name}{suffix}"), *value)));
    }

    /// Sets a number, if the block has it.
    pub(crate) fn set(&mut self, name: &str, value: f64) {
        for field in self.fields.iter_mut().filter(|field| field.0 == name) {
            field.1 = value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The offsets that naga gives the members are those at which the bytes lie.
    #[test]
    fn members_lie_one_after_the_other() {
        let mut block = ParamBlock::default();
        block.number("a", 1.0);
        block.vector("b", DVec3::new(2.0, 3.0, 4.0));
        block.number("c", 5.0);
        for (precision, alias, size) in [(Precision::Single, "f32", 4), (Precision::Double, "f64", 8)] {
            let text = format!("alias real = {alias};\n{}", block.wgsl());
            let module = wgpu::naga::front::wgsl::parse_str(&text).unwrap();
            let (_, params) = module.types.iter().find(|(_, t)| t.name.as_deref() == Some("Params")).unwrap();
            let wgpu::naga::TypeInner::Struct { members, .. } = &params.inner else { panic!("no struct") };
            let offsets: Vec<u32> = members.iter().map(|member| member.offset).collect();
            assert_eq!(offsets, (0..5).map(|i| i * size).collect::<Vec<_>>());
            assert_eq!(block.bytes(precision).len(), 5 * size as usize);
        }
    }
}
