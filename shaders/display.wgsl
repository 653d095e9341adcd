// Pass 2: one fragment a screen pixel. What the camera sees of the shaded texels, encoded for the screen.

const MODE_VALUE = 0u;
const MODE_WIPE = 1u;

struct Display {
    camera: Camera,
    background: vec3f,
    exposure: f32,
    epsilon: f32,
    wipe: f32,
    // The difference that has the last colour.
    range: f32,
    // How many texels along an axis of the material one of the pictures stands for.
    stride: u32,
    // Of the material, in texels.
    size: vec2u,
    // The upper left pixel of the pane in the target.
    corner: vec2u,
}

@group(0) @binding(0) var<uniform> params: Display;
@group(0) @binding(1) var shown: texture_2d<f32>;
@group(0) @binding(2) var reference: texture_2d<f32>;

fn load(place: vec2i, from_reference: bool) -> vec3f {
    if from_reference {
        return textureLoad(reference, place, 0).rgb;
    }
    let value = textureLoad(shown, place, 0).rgb;
    if DIFFERENCE == DIFFERENCE_NONE {
        return value;
    }
    if DIFFERENCE == DIFFERENCE_COMPUTED {
        return vec3f(mean(value));
    }
    return vec3f(difference(DIFFERENCE, textureLoad(reference, place, 0).rgb, value, params.epsilon));
}

// The mean of what the pixel covers. Scaled down before it is summed, so that no sum overflows.
fn average(columns: Span, rows: Span, from_reference: bool) -> vec3f {
    const SCALE = 1.0 / f32(MOST_TEXELS * MOST_TEXELS);
    var sum = vec3f(0.0);
    var total = 0.0;
    for (var row = rows.first; row <= rows.last; row += rows.stride) {
        for (var column = columns.first; column <= columns.last; column += columns.stride) {
            let weight = SCALE * coverage(columns, column) * coverage(rows, row);
            sum += weight * load(vec2i(column, row), from_reference);
            total += weight;
        }
    }
    return sum / total;
}

fn colour(value: vec3f, from_reference: bool, pixel: vec2u) -> vec3f {
    if !is_finite(value) {
        return MARK_NOT_FINITE;
    }
    if DIFFERENCE != DIFFERENCE_NONE && !from_reference {
        return difference_colour(DIFFERENCE, value.x / params.range);
    }
    if FALSE_COLOUR && ENCODING == ENCODING_DATA {
        return heat(value.x);
    }
    return encode(value, ENCODING, params.exposure, SHOW_CLIPPING, pixel);
}

fn displayed(corner: Corner) -> vec4f {
    let seen = plane_from_ndc(params.camera, corner.ndc);
    let extent = abs(dpdx(seen.point)) + abs(dpdy(seen.point));

    let from_reference = MODE == MODE_WIPE && corner.ndc.x < params.wipe;
    let size = textureDimensions(shown);
    let texel = texel_from_plane(seen.point, params.size);
    let inside = all(texel >= vec2f(0.0)) && all(texel < vec2f(params.size));
    if !(seen.hit && inside) {
        return vec4f(params.background, 1.0);
    }
    let scale = 1.0 / f32(params.stride);
    let place = texel / f32(params.stride);
    let pixel = vec2u(corner.position.xy) - params.corner;
    if NEAREST {
        let value = load(vec2i(floor(place)), from_reference);
        return vec4f(colour(value, from_reference, pixel), 1.0);
    }
    let covered = texels_from_plane_extent(extent, params.size) * scale;
    let columns = span(place.x, covered.x, size.x);
    let rows = span(place.y, covered.y, size.y);
    let value = average(columns, rows, from_reference);
    return vec4f(colour(value, from_reference, pixel), 1.0);
}
