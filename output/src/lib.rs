//! Files of pictures: PNG, EXR, and comparing them. This crate knows no volume.
