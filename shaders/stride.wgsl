// Which texel of a material stands for its neighbours where only every n-th one is shaded.

fn shaded_place(place: vec2u, stride: u32, size: vec2u) -> vec2u {
    return min(place * stride + stride / 2u, size - 1u);
}
