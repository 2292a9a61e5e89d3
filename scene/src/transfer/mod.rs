//! Transfer functions as piecewise-linear nodes, and what a range of values can make visible ([RAY-2]).
