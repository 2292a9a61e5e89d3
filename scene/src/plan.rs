//! What a scene calls for ([PLAN-1], [PLAN-3]).
