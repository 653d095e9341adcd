// The maps of a material whose values are few, as those of 8-bit files: packed normals, and codes for what the others hold.

// The bits of the two smaller components of the normal; a hint at the largest, diffuse R, G, B; roughness, specular R, G, B. The first
// in the highest byte.
@group(0) @binding(1) var codes: texture_2d<u32>;
// The values of the codes of roughness, of diffuse and of specular.
@group(0) @binding(2) var<uniform> values: array<vec4f, 256>;

const LOW_BITS = 5u;

fn codes_of(word: u32) -> vec4u {
    return vec4u(word >> 24u, (word >> 16u) & 255u, (word >> 8u) & 255u, word & 255u);
}

// The twin of packed_normal in src/gpu/packing.rs.
fn unpacked_normal(first: u32, second: u32, hint: u32) -> vec3f {
    let others = bitcast<vec2f>(vec2u(first, second));
    let computed = bitcast<u32>(sqrt(max(1.0 - dot(others, others), 0.0)));
    // The nearest number that ends in the bits of the hint.
    const RANGE = 1u << LOW_BITS;
    let magnitude = computed + ((hint - computed + RANGE / 2u) & (RANGE - 1u)) - RANGE / 2u;
    let largest = bitcast<f32>(magnitude | ((hint >> LOW_BITS) & 1u) << 31u);
    let which = hint >> (LOW_BITS + 1u);
    let otherwise = select(vec3f(others.x, largest, others.y), vec3f(largest, others), which == 0u);
    return select(otherwise, vec3f(others, largest), which == 2u);
}

fn load_texel(place: vec2u) -> Texel {
    let words = textureLoad(codes, place, 0);
    let a = codes_of(words.z);
    let b = codes_of(words.w);
    let diffuse = vec3f(values[a.y].y, values[a.z].y, values[a.w].y);
    let specular = vec3f(values[b.y].z, values[b.z].z, values[b.w].z);
    return Texel(unpacked_normal(words.x, words.y, a.x), diffuse, specular, values[b.x].x);
}

fn stored_size() -> vec2u {
    return textureDimensions(codes);
}
