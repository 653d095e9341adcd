// The sum of (a - b)^2 over many numbers, in the place of log_sum.wgsl.

struct LogSum {
    // The sum.
    larger: f32,
    smaller: f32,
    exponent: i32,
}

const NO_SUM = LogSum(0.0, 0.0, 0);

// The sum with one more texel.
fn with_texel(sum: LogSum, a: vec3f, b: vec3f) -> LogSum {
    return LogSum(sum.larger + length_squared(a - b), 0.0, 0);
}

fn joined(a: LogSum, b: LogSum) -> LogSum {
    return LogSum(a.larger + b.larger, 0.0, 0);
}
