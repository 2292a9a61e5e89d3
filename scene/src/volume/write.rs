//! Writing volumes: NRRD.
