// A texel, and vectors: the twin of src/core/math/real.rs.

const FRAC_1_PI = 0.31830988618379067f;
const LARGEST = 0x1.fffffep+127f;
const SMALLEST_NORMAL = 0x1p-126f;

struct Texel {
    normal: vec3f,
    diffuse: vec3f,
    specular: vec3f,
    roughness: f32,
}

fn length_squared(a: vec3f) -> f32 {
    return a.x * a.x + a.y * a.y + a.z * a.z;
}
