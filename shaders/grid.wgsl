// Where the texels lie in the plane z = 0: the twin of src/core/material/grid.rs.

// `half_spacings`: half the distance of the outermost columns is mapped to 1.
fn grid_scale(size: vec2u) -> f32 {
    return f32(max(size.x, 2u) - 1u);
}

// The position C of a texel. The numerators are whole numbers, exact in f32 for any texture.
fn position(column: u32, row: u32, size: vec2u) -> vec3f {
    let x = (2.0 * f32(column) - f32(size.x - 1u)) / grid_scale(size);
    let y = (f32(size.y - 1u) - 2.0 * f32(row)) / grid_scale(size);
    return vec3f(x, y, 0.0);
}

// `place`, the inverse: (column, row) counted from the corner of the map, so that texel (i, j) covers [i, i+1) x [j, j+1).
fn texel_from_plane(point: vec2f, size: vec2u) -> vec2f {
    return 0.5 * (vec2f(point.x, -point.y) * grid_scale(size) + vec2f(size));
}

// `place` of differences: how many texels a distance in the plane spans, along columns and along rows.
fn texels_from_plane_extent(extent: vec2f, size: vec2u) -> vec2f {
    return 0.5 * extent * grid_scale(size);
}
