//! WGSL files.

/// A WGSL file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Module {
    /// Its path from the folder of the source file that names it, without suffix.
    pub(crate) name: &'static str,
    pub(crate) text: &'static str,
}

/// The WGSL file beside a source file, by its path from the folder of that file.
macro_rules! module {
    ($name:literal) => {
        $crate::module::Module { name: $name, text: include_str!(concat!($name, ".wgsl")) }
    };
}
pub(crate) use module;
