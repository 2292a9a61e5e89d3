//! Lit-sphere pictures ([STF-1], [STF-12]).
