// Differences of a prediction p from the ground truth g at a texel: the twin of src/picture/difference.rs.

const DIFFERENCE_NONE = 0u;
const DIFFERENCE_LOG = 1u;
const DIFFERENCE_SIGNED_LOG = 2u;
const DIFFERENCE_ABSOLUTE = 3u;
const DIFFERENCE_SIGNED = 4u;
const DIFFERENCE_RELATIVE = 5u;
const DIFFERENCE_ANGLE = 6u;
// The picture holds the difference of each channel already; unsigned.
const DIFFERENCE_COMPUTED = 7u;

fn mean(rgb: vec3f) -> f32 {
    return (rgb.r + rgb.g + rgb.b) / 3.0;
}

// In degrees, of normals n stored as (n + 1) / 2. atan2, since acos is inexact at small angles.
fn angle(g: vec3f, p: vec3f) -> f32 {
    let n_g = 2.0 * g - 1.0;
    let n_p = 2.0 * p - 1.0;
    return degrees(atan2(length(cross(n_g, n_p)), dot(n_g, n_p)));
}

fn difference(kind: u32, g: vec3f, p: vec3f, epsilon: f32) -> f32 {
    let logarithm = log(p + epsilon) - log(g + epsilon);
    switch kind {
        case DIFFERENCE_LOG { return mean(abs(logarithm)); }
        case DIFFERENCE_SIGNED_LOG { return mean(logarithm); }
        case DIFFERENCE_ABSOLUTE { return mean(abs(p - g)); }
        case DIFFERENCE_SIGNED { return mean(p - g); }
        case DIFFERENCE_RELATIVE { return mean(abs(p - g) / (g + epsilon)); }
        default { return angle(g, p); }
    }
}

fn difference_colour(kind: u32, amount: f32) -> vec3f {
    let is_signed = kind == DIFFERENCE_SIGNED_LOG || kind == DIFFERENCE_SIGNED;
    return select(heat(amount), diverging(amount), is_signed);
}
