// The sum of |ln a - ln b| over many positive numbers without a logarithm: the twin of src/loss/fused/compare.rs.
//
// It is ln(product of max(a, b)) - ln(product of min(a, b)). Mantissas are multiplied, exponents added as integers.
// A product rounds by half a unit in the last place a factor, and the same numbers give the same product: where a is b
// the sum is 0. The built-in log() is off by 1e-6 on some drivers.

const MANTISSA = 0x007fffffu;
const ONE = 0x3f800000u;

struct LogSum {
    // The mantissas of the products, in [1, 2).
    larger: f32,
    smaller: f32,
    // The exponent of the larger product minus that of the smaller one.
    exponent: i32,
}

const NO_SUM = LogSum(1.0, 1.0, 0);

fn exponents(x: vec3f) -> i32 {
    let each = bitcast<vec3u>(x) >> vec3u(23u);
    return i32(each.x + each.y + each.z);
}

// The product of the mantissas of x, below 8.
fn mantissas(x: vec3f) -> f32 {
    let each = bitcast<vec3f>((bitcast<vec3u>(x) & vec3u(MANTISSA)) | vec3u(ONE));
    return each.x * each.y * each.z;
}

// The sum whose mantissas may lie beyond [1, 2), brought back there.
fn normalized(larger: f32, smaller: f32, exponent: i32) -> LogSum {
    let bits = bitcast<vec2u>(vec2f(larger, smaller));
    let moved = bits >> vec2u(23u);
    let rest = bitcast<vec2f>((bits & vec2u(MANTISSA)) | vec2u(ONE));
    return LogSum(rest.x, rest.y, exponent + i32(moved.x) - i32(moved.y));
}

// The sum with one more texel.
fn with_texel(sum: LogSum, a: vec3f, b: vec3f) -> LogSum {
    let larger = max(a, b);
    let smaller = min(a, b);
    let exponent = sum.exponent + exponents(larger) - exponents(smaller);
    return normalized(sum.larger * mantissas(larger), sum.smaller * mantissas(smaller), exponent);
}

fn joined(a: LogSum, b: LogSum) -> LogSum {
    return normalized(a.larger * b.larger, a.smaller * b.smaller, a.exponent + b.exponent);
}
