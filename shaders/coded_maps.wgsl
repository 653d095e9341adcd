// The maps of a material whose values are few, as those of 8-bit files: the floats of the normal, and codes for what the others hold.

// x, y and z of the normal as bits; roughness and diffuse R, G, B as codes, the first in the highest byte.
@group(0) @binding(1) var normal_and_codes: texture_2d<u32>;
// Specular R, G, B as codes.
@group(0) @binding(2) var specular_codes: texture_2d<u32>;
// The values of the codes of roughness, of diffuse and of specular.
@group(0) @binding(3) var<uniform> values: array<vec4f, 256>;

fn codes_of(word: u32) -> vec4u {
    return vec4u(word >> 24u, (word >> 16u) & 255u, (word >> 8u) & 255u, word & 255u);
}

fn load_texel(place: vec2u) -> Texel {
    let first = textureLoad(normal_and_codes, place, 0);
    let a = codes_of(first.w);
    let b = codes_of(textureLoad(specular_codes, place, 0).x);
    let diffuse = vec3f(values[a.y].y, values[a.z].y, values[a.w].y);
    let specular = vec3f(values[b.y].z, values[b.z].z, values[b.w].z);
    return Texel(bitcast<vec3f>(first.xyz), diffuse, specular, values[a.x].x);
}

fn stored_size() -> vec2u {
    return textureDimensions(normal_and_codes);
}
