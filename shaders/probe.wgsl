// Numbers before pictures: the shader's own render() over an array of points.

struct Point {
    normal: vec3f,
    roughness: f32,
    diffuse: vec3f,
    specular: vec3f,
    w_l: vec3f,
    w_v: vec3f,
}

@group(0) @binding(0) var<uniform> model: Model;
@group(0) @binding(1) var<storage, read> points: array<Point>;
@group(0) @binding(2) var<storage, read_write> radiances: array<vec4f>;

@compute @workgroup_size(64)
fn probe(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&points) {
        return;
    }
    let point = points[id.x];
    let texel = Texel(point.normal, point.diffuse, point.specular, point.roughness);
    radiances[id.x] = vec4f(render(model, texel, point.w_l, point.w_v), 1.0);
}
