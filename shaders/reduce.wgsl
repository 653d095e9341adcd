// The texels of the maps that a draft shades, side by side: read from the whole maps, each would cost a line of memory in every frame.

// Which texture of floats: normal and roughness, diffuse, or specular.
override MAP: u32 = 0u;

// How many texels along an axis one stands for.
@group(0) @binding(0) var<uniform> stride: u32;

@fragment
fn reduce(corner: Corner) -> @location(0) vec4f {
    let texel = load_texel(shaded_place(vec2u(corner.position.xy), stride, stored_size()));
    switch MAP {
        case 1u { return vec4f(texel.diffuse, 0.0); }
        case 2u { return vec4f(texel.specular, 0.0); }
        default { return vec4f(texel.normal, texel.roughness); }
    }
}
