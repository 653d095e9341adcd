// From a linear value to what the screen is sent, and the marks of what the screen cannot show.

const ENCODING_RADIANCE = 0u;
const ENCODING_ALBEDO = 1u;
const ENCODING_DATA = 2u;

const MARK_NOT_FINITE = vec3f(0.0, 1.0, 0.0);
const MARK_TOO_BRIGHT = vec3f(1.0, 0.0, 0.8);
const MARK_BLACK = vec3f(0.0, 0.25, 1.0);
// Width of the stripes of the marks, in screen pixels along the diagonal.
const STRIPE = 4u;

// By its bits: compilers may take `x != x` to be never true.
fn is_finite(value: vec3f) -> bool {
    let exponent = bitcast<vec3u>(value) & vec3u(0x7f800000u);
    return all(exponent != vec3u(0x7f800000u));
}

fn is_striped(pixel: vec2u) -> bool {
    return ((pixel.x + pixel.y) / STRIPE) % 2u == 0u;
}

fn mark_clipping(exposed: vec3f, encoded: vec3f, pixel: vec2u) -> vec3f {
    let mark = select(MARK_BLACK, MARK_TOO_BRIGHT, any(exposed > vec3f(1.0)));
    let clipped = any(exposed > vec3f(1.0)) || all(exposed <= vec3f(0.0));
    return select(encoded, mark, clipped && is_striped(pixel));
}

fn encode(linear: vec3f, encoding: u32, exposure: f32, show_clipping: bool, pixel: vec2u) -> vec3f {
    let exposed = select(linear, linear * exposure, encoding == ENCODING_RADIANCE);
    let limited = clamp(exposed, vec3f(0.0), vec3f(1.0));
    let encoded = select(srgb_from_linear(limited), limited, encoding == ENCODING_DATA);
    let marked = show_clipping && encoding == ENCODING_RADIANCE;
    return select(encoded, mark_clipping(exposed, encoded, pixel), marked);
}
