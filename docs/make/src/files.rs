//! Where the generated files go.

use std::path::PathBuf;

/// A file of `docs/`, by its path there.
pub(crate) fn in_docs(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..").join(name)
}

/// Writes a file of `docs/`, with its folder, and says so.
///
/// # Errors
/// What the system says, with the file.
pub(crate) fn write(name: &str, bytes: &[u8]) -> Result<(), String> {
    let path = in_docs(name);
    let say = |e: std::io::Error| format!("{}: {e}", path.display());
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(say)?;
    }
    std::fs::write(&path, bytes).map_err(say)?;
    let shown = name.strip_prefix("../").map_or_else(|| format!("docs/{name}"), Into::into);
    println!("{shown} ({} kB)", bytes.len().div_ceil(1000));
    Ok(())
}
