//! The command as people and scripts use it: the real binary in a folder of its own.

mod bad_input;
mod bare_volumes;
mod compare;
mod cost;
mod extract;
mod folder;
mod frames;
mod generated;
mod info;
mod interrupt;
mod output;
mod overrides;
mod phantom;
mod plan;
mod points;
mod probe;
mod raw;
mod repeatable;
mod sheet;
mod stats;
mod strokes;
mod styles;
mod terminal;
mod usage;
mod wedge;
