// Which texels a screen pixel covers along one axis, and how much of each.

// Texels read along one axis at most; a wider footprint is read with a stride.
const MOST_TEXELS = 16;
// Footprints of up to one texel show the nearest texel, crisply. A little more than 1: at 1:1 rounding must not blur.
const MAGNIFIED = 1.001f;
// The share of a footprint that rounding may add at either end.
const ROUNDING = 0.0009765625f;

struct Span {
    low: f32,
    high: f32,
    first: i32,
    last: i32,
    stride: i32,
}

// The span of `extent` texels around `centre`, which lies in [0, count).
fn span(centre: f32, extent: f32, count: u32) -> Span {
    let nearest = floor(centre);
    if extent <= MAGNIFIED {
        return Span(nearest, nearest + 1.0, i32(nearest), i32(nearest), 1);
    }
    // Adapters round positions and derivatives differently. A texel that is covered by less would double the stride of the others.
    let rounding = ROUNDING * extent;
    let low = clamp(centre - 0.5 * extent + rounding, 0.0, nearest);
    let high = clamp(centre + 0.5 * extent - rounding, nearest + 1.0, f32(count));
    return strided(centre - 0.5 * extent, centre + 0.5 * extent, i32(floor(low)), i32(ceil(high)) - 1);
}

fn strided(low: f32, high: f32, first: i32, last: i32) -> Span {
    let stride = (last - first + MOST_TEXELS) / MOST_TEXELS;
    return Span(low, high, first + stride / 2, last, stride);
}

// The share of texel `index` that the span covers.
fn coverage(span: Span, index: i32) -> f32 {
    return clamp(min(span.high, f32(index) + 1.0) - max(span.low, f32(index)), 0.0, 1.0);
}
