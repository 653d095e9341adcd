// The maps of a material as floats.

@group(0) @binding(1) var normal_roughness: texture_2d<f32>;
@group(0) @binding(2) var diffuse: texture_2d<f32>;
@group(0) @binding(3) var specular: texture_2d<f32>;

fn load_texel(place: vec2u) -> Texel {
    let first = textureLoad(normal_roughness, place, 0);
    return Texel(first.xyz, textureLoad(diffuse, place, 0).rgb, textureLoad(specular, place, 0).rgb, first.w);
}

fn stored_size() -> vec2u {
    return textureDimensions(normal_roughness);
}
