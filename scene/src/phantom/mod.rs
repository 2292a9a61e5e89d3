//! Phantoms with known truth ([IO-4]).
