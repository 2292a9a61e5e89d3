//! Drypoint, an illustrative volume renderer.
