// Algorithm 1: sums of |ln(R_gt + epsilon) - ln(R_pred + epsilon)|, or of squares, over blocks of texels, for each scene and prediction.
//
// No workgroup memory: software drivers take ten times as long with it. In `loss` an invocation sums every LANES-th
// texel of a block, so that neighbours read neighbours; in `gather` another one joins the sums of a block.

// Invocations that share a block.
const LANES = 64u;
// Texels that each of them sums.
const RUN = 64u;
// Predictions of one pass: they share the renderings of the ground truth.
const MOST_PREDICTIONS = 4u;
// Planes of a material: normal, diffuse, specular, roughness.
const PLANES = 10u;

struct Band {
    model: Model,
    // Of the whole material.
    size: vec2u,
    // The number of the band's first texel.
    first: u32,
    texels: u32,
    // Texels from one plane to the next.
    stride: u32,
    blocks: u32,
    predictions: u32,
    epsilon: f32,
}

@group(0) @binding(0) var<uniform> band: Band;
@group(0) @binding(1) var<storage, read> scenes: array<Rays>;
// The planes of the ground truth, then those of the predictions.
@group(0) @binding(2) var<storage, read> planes: array<f32>;
// By scene, prediction, block and lane.
@group(0) @binding(3) var<storage, read_write> lane_sums: array<LogSum>;
// By scene, prediction and block.
@group(0) @binding(4) var<storage, read_write> block_sums: array<LogSum>;

fn load_colour(first: u32) -> vec3f {
    return vec3f(planes[first], planes[first + band.stride], planes[first + 2u * band.stride]);
}

fn load_texel(material: u32, texel: u32) -> Texel {
    let first = material * PLANES * band.stride + texel;
    let normal = load_colour(first);
    let diffuse = load_colour(first + 3u * band.stride);
    let specular = load_colour(first + 6u * band.stride);
    return Texel(normal, diffuse, specular, planes[first + 9u * band.stride]);
}

// R + epsilon.
fn lifted(material: u32, texel: u32, directions: Directions) -> vec3f {
    let radiance = rendered(band.model, load_texel(material, texel), directions);
    return radiance + band.epsilon;
}

@compute @workgroup_size(LANES)
fn loss(@builtin(workgroup_id) place: vec3u, @builtin(local_invocation_index) lane: u32) {
    let rays = scenes[place.y];
    var sums = array<LogSum, MOST_PREDICTIONS>(NO_SUM, NO_SUM, NO_SUM, NO_SUM);
    for (var i = 0u; i < RUN; i++) {
        let texel = (place.x * RUN + i) * LANES + lane;
        if texel >= band.texels {
            break;
        }
        let index = band.first + texel;
        let directions = from_texel(rays, position(index % band.size.x, index / band.size.x, band.size));
        let expected = lifted(0u, texel, directions);
        for (var p = 0u; p < band.predictions; p++) {
            sums[p] = with_texel(sums[p], expected, lifted(p + 1u, texel, directions));
        }
    }
    for (var p = 0u; p < band.predictions; p++) {
        let block = (place.y * band.predictions + p) * band.blocks + place.x;
        lane_sums[block * LANES + lane] = sums[p];
    }
}

@compute @workgroup_size(LANES)
fn gather(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&block_sums) {
        return;
    }
    var sum = NO_SUM;
    for (var lane = 0u; lane < LANES; lane++) {
        sum = joined(sum, lane_sums[id.x * LANES + lane]);
    }
    block_sums[id.x] = sum;
}
