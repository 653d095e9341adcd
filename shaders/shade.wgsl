// Pass 1: one fragment a texel of the map. The rendering, or one of the maps, as linear floats.

const QUANTITY_RENDERING = 0u;
const QUANTITY_NORMAL = 1u;
const QUANTITY_DIFFUSE = 2u;
const QUANTITY_SPECULAR = 3u;
const QUANTITY_ROUGHNESS = 4u;

struct Shading {
    rays: Rays,
    model: Model,
    // The largest number that the target holds.
    largest: f32,
    // How many texels along an axis one fragment stands for.
    stride: u32,
    // Of the material, in texels.
    size: vec2u,
}

@group(0) @binding(0) var<uniform> shading: Shading;
// The texel at the position `c`, which the maps hold at `stored`.
fn shade_texel(c: vec3f, stored: vec2u) -> vec3f {
    let texel = load_texel(stored);
    switch QUANTITY {
        case QUANTITY_NORMAL { return texel.normal * 0.5 + 0.5; }
        case QUANTITY_DIFFUSE { return texel.diffuse; }
        case QUANTITY_SPECULAR { return texel.specular; }
        case QUANTITY_ROUGHNESS { return vec3f(texel.roughness); }
        default {}
    }
    let directions = from_texel(shading.rays, c);
    return render(shading.model, texel, directions.w_l, directions.w_v);
}

fn shaded(corner: Corner) -> vec4f {
    let fragment = vec2u(corner.position.xy);
    // Reduced maps hold the texels of the fragments, and no others.
    let is_reduced = any(stored_size() != shading.size);
    let place = shaded_place(fragment, shading.stride, shading.size);
    let c = position(place.x, place.y, shading.size);
    return held(shade_texel(c, select(place, fragment, is_reduced)));
}

// As the target can hold it.
fn held(value: vec3f) -> vec4f {
    return vec4f(min(value, vec3f(shading.largest)), 1.0);
}
