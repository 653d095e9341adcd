// The texels of a map that a draft shades, side by side: read from the whole map, each would cost a line of memory in every frame.

// How many texels along an axis one stands for.
@group(0) @binding(0) var<uniform> stride: u32;
@group(0) @binding(1) var whole: texture_2d<f32>;

@fragment
fn reduce(corner: Corner) -> @location(0) vec4f {
    return textureLoad(whole, shaded_place(vec2u(corner.position.xy), stride, textureDimensions(whole)), 0);
}
