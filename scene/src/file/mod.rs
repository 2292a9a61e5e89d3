//! Scene files: parsing with places, checking, schema ([IO-3]).
