// One triangle that covers the viewport.

struct Corner {
    @builtin(position) position: vec4f,
    // The pane's coordinates: x right, y up, both in [-1, 1].
    @location(0) ndc: vec2f,
}

@vertex
fn cover(@builtin(vertex_index) index: u32) -> Corner {
    let ndc = vec2f(select(-1.0, 3.0, index == 1u), select(-1.0, 3.0, index == 2u));
    return Corner(vec4f(ndc, 0.0, 1.0), ndc);
}
