//! Reading volumes ([IO-1]).
