// Copies a picture, pixel by pixel, into a viewport of its size.

@group(0) @binding(0) var picture: texture_2d<f32>;

@fragment
fn blit(corner: Corner) -> @location(0) vec4f {
    let size = textureDimensions(picture);
    let place = (corner.ndc * vec2f(0.5, -0.5) + 0.5) * vec2f(size);
    return textureLoad(picture, min(vec2u(max(place, vec2f(0.0))), size - 1u), 0);
}
