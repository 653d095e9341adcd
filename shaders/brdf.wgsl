// Algorithm 3 at one point: the twin of src/core/model/brdf.rs and of the vectors of src/core/math/real.rs. The same names, argument
// order and order of operations; what is per channel there is a vec3f here.

struct Model {
    intensity: f32,
    roughness_floor: f32,
    light_z_floor: f32,
    clamp_n_dot_h: u32,
    d_floor: f32,
    @size(12) g_floor: f32,
}

// `normalize`, not the built-in one: drivers may take its inverseSqrt from a table.
fn unit(a: vec3f) -> vec3f {
    return a * (1.0 / sqrt(length_squared(a)));
}

fn is_direction(a: vec3f) -> bool {
    let squared = length_squared(a);
    return squared <= LARGEST && squared >= SMALLEST_NORMAL;
}

fn half_vector(n: vec3f, l: vec3f, v: vec3f) -> vec3f {
    let sum = l + v;
    if is_direction(sum) {
        return unit(sum);
    }
    return n;
}

fn distribution(model: Model, n: vec3f, h: vec3f, a: f32) -> f32 {
    let n_dot_h = dot(n, h);
    let behind = model.clamp_n_dot_h != 0u && n_dot_h < 0.0;
    let lobe = length_squared(cross(n, h)) + (a * a) * (n_dot_h * n_dot_h);
    let denominator = select(lobe, 1.0, behind);
    let ratio = a / max(denominator, model.d_floor);
    return FRAC_1_PI * (ratio * ratio);
}

fn geometry_factor(model: Model, cosine: f32, k: f32) -> f32 {
    return 1.0 / max(cosine * (1.0 - k) + k, model.g_floor);
}

fn fresnel_weight(v_dot_h: f32) -> f32 {
    return exp2((-5.55473 * v_dot_h - 6.98316) * v_dot_h);
}

fn fresnel(specular: vec3f, weight: f32) -> vec3f {
    return specular + (1.0 - specular) * weight;
}

fn lambert(diffuse: vec3f, specular: vec3f) -> vec3f {
    return diffuse * (1.0 - specular) * FRAC_1_PI;
}

fn irradiance(model: Model, n_dot_l: f32, l_z: f32) -> f32 {
    return n_dot_l / max(l_z, model.light_z_floor) * model.intensity;
}

fn reflectance(model: Model, texel: Texel, l: vec3f, v: vec3f) -> vec3f {
    let n = texel.normal;
    let h = half_vector(n, l, v);
    let n_dot_l = max(dot(n, l), 0.0);
    let n_dot_v = max(dot(n, v), 0.0);
    let v_dot_h = clamp(dot(v, h), 0.0, 1.0);

    let rough = max(texel.roughness, model.roughness_floor);
    let a = rough * rough;
    let k = a * 0.5;
    let d = distribution(model, n, h, a);
    let g = geometry_factor(model, n_dot_l, k) * geometry_factor(model, n_dot_v, k);
    let lobe = g * d * 0.25;
    let weight = fresnel_weight(v_dot_h);
    return fresnel(texel.specular, weight) * lobe + lambert(texel.diffuse, texel.specular);
}

fn render(model: Model, texel: Texel, w_l: vec3f, w_v: vec3f) -> vec3f {
    let l = unit(w_l);
    let n_dot_l = dot(texel.normal, l);
    if n_dot_l <= 0.0 || l.z <= 0.0 {
        return vec3f(0.0);
    }
    let v = unit(w_v);
    let e = irradiance(model, n_dot_l, l.z);
    return min(reflectance(model, texel, l, v) * e, vec3f(LARGEST));
}
