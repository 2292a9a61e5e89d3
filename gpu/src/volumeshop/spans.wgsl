// Spans of samples at which the same parts can show something.
// Glue: Ranges of samples.

// From sample k on: the last sample up to which the same parts can show something, and whether there are any.
struct Span {
    end: i32,
    is_mixed: bool,
}

// A span that ends where a range of samples begins or ends.
fn span_within(span: Span, k: i32, range: vec2<i32>) -> Span {
    if (range.x <= k && k <= range.y) {
        return Span(min(span.end, range.y), true);
    }
    if (k < range.x && range.x <= range.y) {
        return Span(min(span.end, range.x - 1), span.is_mixed);
    }
    return span;
}

// The samples from the first to the last of two ranges.
fn hull(a: vec2<i32>, b: vec2<i32>) -> vec2<i32> {
    if (b.x > b.y) {
        return a;
    }
    if (a.x > a.y) {
        return b;
    }
    return vec2(min(a.x, b.x), max(a.y, b.y));
}
