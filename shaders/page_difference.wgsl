// Differences as numbers, for readouts and histograms of the report: a texel a fragment.

struct PageDifference {
    kind: u32,
    epsilon: f32,
}

@group(0) @binding(0) var<uniform> page: PageDifference;
@group(0) @binding(1) var prediction: texture_2d<f32>;
@group(0) @binding(2) var reference: texture_2d<f32>;

@fragment
fn page_difference(corner: Corner) -> @location(0) vec4f {
    let place = vec2i(corner.position.xy);
    let g = textureLoad(reference, place, 0).rgb;
    let p = textureLoad(prediction, place, 0).rgb;
    return vec4f(difference(page.kind, g, p, page.epsilon), 0.0, 0.0, 1.0);
}
