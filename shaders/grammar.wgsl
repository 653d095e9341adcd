// A renderer of the grammar of conventions: the twin of src/core/model/grammar/radiance.rs and src/core/material/metallic.rs.
//
// Words are numbered in the order of src/core/model/grammar/words.rs. Where f32 would cancel, 1 - (n.h)^2 is |n x h|^2.

const PI = 3.14159265358979f;

struct Model {
    // Words.
    material: u32,
    clip_maps: u32,
    alpha: u32,
    normal: u32,
    normal_y: u32,
    flip_below: u32,
    distribution: u32,
    d_xi: u32,
    nh_clamped: u32,
    shadowing: u32,
    k: u32,
    denominator: u32,
    fresnel: u32,
    f90: u32,
    spec_cosine: u32,
    diffuse: u32,
    collocated: u32,
    transfer: u32,
    // Numbers. What has no limit has one that nothing reaches; `lz` is negative where nothing is divided by l.z.
    f0: f32,
    r_min: f32,
    r_max: f32,
    vec_eps: f32,
    d_den_min: f32,
    d_add: f32,
    d_den2_min: f32,
    d_cap: f32,
    nl_min: f32,
    nv_min: f32,
    nh_min: f32,
    vh_min: f32,
    dot_max: f32,
    k_add: f32,
    k_min: f32,
    g_den_min: f32,
    g_add: f32,
    v_den_min: f32,
    den_add: f32,
    front_min: f32,
    cos_min: f32,
    cos_max: f32,
    lz: f32,
    falloff_add: f32,
    spot: f32,
    ambient: f32,
    term_low: f32,
    term_high: f32,
    low: f32,
    high: f32,
    pre_add: f32,
    after_low: f32,
    @size(8) after_high: f32,
}

// A scene as this renderer takes it.
struct Rays {
    view: vec3f,
    view_is_point: u32,
    light: vec3f,
    light_is_point: u32,
    // With the factor.
    intensity: vec3f,
    falls_off: u32,
    // The position of a texel in units of the world, from that in a grid of corners whose row 0 is on top.
    columns: vec2f,
    rows: vec2f,
    half_extent: f32,
}

struct Directions {
    w_l: vec3f,
    w_v: vec3f,
    intensity: vec3f,
    falls_off: u32,
}

// `vectors`.
fn from_texel(rays: Rays, c: vec3f) -> Directions {
    let at = vec3f(dot(rays.columns, c.xy), dot(rays.rows, c.xy), 0.0);
    let w_l = select(rays.light, rays.light * rays.half_extent - at, rays.light_is_point != 0u);
    let w_v = select(rays.view, rays.view * rays.half_extent - at, rays.view_is_point != 0u);
    return Directions(w_l, w_v, rays.intensity, rays.falls_off);
}

struct Surface {
    normal: vec3f,
    // 1 - |normal|^2.
    shortfall: f32,
    diffuse: vec3f,
    specular: vec3f,
    roughness: f32,
    metallic: f32,
}

// The unit vectors' products before the limits.
struct Vectors {
    l_z: f32,
    nl: f32,
    nv: f32,
    nh: f32,
    vh: f32,
    // 1 - nh^2.
    sine2: f32,
    // 1 - vh.
    rest: f32,
}

fn divided(vector: vec3f, epsilon: f32) -> vec3f {
    return vector / max(sqrt(length_squared(vector)) + epsilon, SMALLEST_NORMAL);
}

// 1 - |v|^2 of the `divided` v of a vector of this length.
fn shortfall(length: f32, epsilon: f32) -> f32 {
    let whole = (length + epsilon) * (length + epsilon);
    return select(epsilon * (2.0 * length + epsilon) / whole, 1.0, whole == 0.0);
}

// `left`: 1 - metallic. The smaller root by the product of both, which does not cancel.
fn left(d: f32, s: f32) -> f32 {
    let sum = d + s;
    let root = sqrt(max(sum * sum - 4.0 * 0.04 * d, 0.0));
    let large = (sum + root) / (2.0 * 0.04);
    if large <= 1.0 + 1e-6 {
        return min(large, 1.0);
    }
    return clamp(2.0 * d / (sum + root), 0.0, 1.0);
}

fn normal(model: Model, stored: vec3f) -> vec3f {
    var n = vec3f(stored.x, select(stored.y, -stored.y, model.normal_y == 1u), stored.z);
    if model.normal == 2u {
        n.z = sqrt(1.0 - min(n.x * n.x + n.y * n.y, 1.0 - 1e-6));
    }
    if model.normal != 1u {
        n = divided(n, model.vec_eps);
    }
    return select(n, -n, model.flip_below != 0u && n.z < 0.0);
}

fn surface(model: Model, texel: Texel) -> Surface {
    // Their texels are stored as unit normals.
    let short = select(shortfall(1.0, model.vec_eps), 0.0, model.normal == 1u);
    var result = Surface(normal(model, texel.normal), short, texel.diffuse, texel.specular, texel.roughness, 0.0);
    if model.material == 1u {
        let rest = left(dot(texel.diffuse, vec3f(1.0)) / 3.0, dot(texel.specular, vec3f(1.0)) / 3.0);
        result.metallic = 1.0 - rest;
        result.diffuse = clamp(texel.diffuse + texel.specular - 0.04 * rest, vec3f(0.0), vec3f(1.0));
    }
    if model.clip_maps != 0u {
        result.diffuse = clamp(result.diffuse, vec3f(0.0), vec3f(1.0));
        result.specular = clamp(result.specular, vec3f(0.0), vec3f(1.0));
        result.roughness = clamp(result.roughness, 0.0, 1.0);
    }
    if model.material != 0u {
        result.specular = model.f0 * (1.0 - result.metallic) + result.metallic * result.diffuse;
    }
    result.roughness = min(max(result.roughness, model.r_min), model.r_max);
    return result;
}

fn limited(model: Model, product: f32, least: f32) -> f32 {
    return min(max(product, least), model.dot_max);
}

fn distribution(model: Model, x: Vectors, a: f32) -> f32 {
    var nh = x.nh;
    var sine2 = x.sine2;
    if model.nh_clamped != 0u {
        nh = limited(model, x.nh, model.nh_min);
        if nh != x.nh {
            sine2 = 1.0 - nh * nh;
        }
    }
    let a2 = a * a;
    let nh2 = nh * nh;
    let sum = max(nh2 * a2 + sine2, model.d_den_min);
    let ratio = a / sum;
    var d = FRAC_1_PI * (ratio * ratio);
    if model.d_add > 0.0 || model.d_den2_min > 0.0 {
        d = a2 / max(PI * sum * sum + model.d_add, model.d_den2_min);
    }
    if model.distribution == 1u {
        d = exp(-sine2 / (nh2 * a2)) / (PI * a2 * nh2 * nh2);
    }
    return select(min(d, model.d_cap), 0.0, model.d_xi != 0u && x.nh <= 0.0);
}

// Smith's factor for GGX.
// `shadowing`.
fn smith(model: Model, x: f32, a2: f32) -> f32 {
    let x2 = x * x + model.g_add;
    let root = sqrt(x2);
    return 2.0 * root / (root + sqrt(x2 + a2 * (1.0 - x * x)));
}

fn beckmann_factor(x: f32, a: f32) -> f32 {
    let across = a * sqrt(max(1.0 - x * x, 0.0));
    if x >= 1.6 * across {
        return 1.0;
    }
    let e = x / across;
    return (3.535 * e + 2.181 * e * e) / (1.0 + 2.276 * e + 2.577 * e * e);
}

// `shadowing`.
fn schlick_k(model: Model, roughness: f32, a: f32) -> f32 {
    var k = a / 2.0;
    if model.k == 1u {
        k = roughness * roughness / 2.0;
    }
    if model.k == 2u {
        k = (roughness + 1.0) * (roughness + 1.0) / 8.0;
    }
    return max(k + model.k_add, model.k_min);
}

// The shadowing term, and what it is divided by n.l n.v.
fn shadowing(model: Model, nl: f32, nv: f32, roughness: f32, a: f32) -> vec2f {
    let a2 = a * a;
    let both = nl * nv;
    var full = 1.0;
    switch model.shadowing {
        case 0u {
            let k = schlick_k(model, roughness, a);
            let visibility = 1.0 / (max(nl * (1.0 - k) + k, model.g_den_min) * max(nv * (1.0 - k) + k, model.g_den_min));
            return vec2f(visibility * both, visibility);
        }
        case 1u { full = smith(model, nl, a2) * smith(model, nv, a2); }
        case 2u {
            let sum = nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2);
            let visibility = select(0.0, 2.0 / max(sum, max(model.v_den_min, SMALLEST_NORMAL)), sum > 0.0);
            return vec2f(visibility * both, visibility);
        }
        case 3u {
            // 1 + Lambda(l) + Lambda(v), times 2 n.l n.v.
            let sum = nv * sqrt(nl * nl + a2 * (1.0 - nl * nl)) + nl * sqrt(nv * nv + a2 * (1.0 - nv * nv));
            full = 2.0 * both / sum;
        }
        case 4u { full = beckmann_factor(nl, a) * beckmann_factor(nv, a); }
        default { return vec2f(1.0); }
    }
    return vec2f(full, full / both);
}

fn geometry(model: Model, x: Vectors, roughness: f32, a: f32) -> f32 {
    let nl = limited(model, x.nl, model.nl_min);
    let nv = limited(model, x.nv, model.nv_min);
    let g = shadowing(model, nl, nv, roughness, a);
    switch model.denominator {
        case 0u { return g.y / (4.0 + model.den_add); }
        case 1u { return g.x / (4.0 * nl * nv + model.den_add); }
        case 2u { return g.x / (4.0 * nl + model.den_add); }
        default { return g.x / (4.0 * max(x.nv, model.nv_min)); }
    }
}

fn fresnel_weight(model: Model, x: Vectors) -> f32 {
    let vh = limited(model, x.vh, model.vh_min);
    switch model.fresnel {
        case 0u { return exp2((-5.55473 * vh - 6.98316) * vh); }
        case 1u {
            let t = max(select(1.0 - vh, x.rest, vh == x.vh), 0.0);
            return t * t * (t * t) * t;
        }
        default { return 0.0; }
    }
}

struct Terms {
    diffuse: vec3f,
    specular: vec3f,
}

fn terms(model: Model, surface: Surface, x: Vectors) -> Terms {
    let weight = fresnel_weight(model, x);
    let r = surface.roughness;
    let a = select(r * r, r, model.alpha == 1u);
    var lobe = 0.0;
    if x.nl > model.front_min && x.nv > model.front_min {
        lobe = distribution(model, x, a) * geometry(model, x, r, a);
    }
    let s = surface.specular;
    let f90 = select(1.0, clamp(16.5 * (s.r + s.g + s.b), 0.0, 1.0), model.f90 == 1u);
    let dielectric = model.f0 + (1.0 - model.f0) * weight;
    let fresnel = s + (f90 - s) * weight;
    var share = vec3f(1.0);
    switch model.diffuse {
        case 0u {}
        case 1u { share = 1.0 - s; }
        case 2u { share = 1.0 - fresnel; }
        case 3u { share = vec3f(1.0 - surface.metallic); }
        case 4u { share = (1.0 - fresnel) * (1.0 - surface.metallic); }
        case 5u { share = select(vec3f((1.0 - dielectric) * (1.0 - surface.metallic)), 1.0 - fresnel, model.material == 0u); }
        default { share = vec3f(0.0); }
    }
    return Terms(surface.diffuse * share * FRAC_1_PI, fresnel * lobe);
}

fn irradiance(model: Model, x: Vectors, directions: Directions) -> vec3f {
    var scale = 1.0;
    if directions.falls_off != 0u {
        scale /= length_squared(directions.w_l) + model.falloff_add;
    }
    if model.spot > 0.0 {
        scale *= pow(clamp(x.l_z, 0.0, 1.0), model.spot);
    }
    if model.lz >= 0.0 {
        scale /= max(x.l_z, model.lz);
    }
    return directions.intensity * scale;
}

// `encoded`. Without limits, what is not a number stays so.
fn clipped(x: vec3f, low: f32, high: f32) -> vec3f {
    if low == -LARGEST && high == LARGEST {
        return x;
    }
    return min(max(x, vec3f(low)), vec3f(high));
}

fn encoded(model: Model, radiance: vec3f) -> vec3f {
    var x = clipped(radiance, model.low, model.high) + model.pre_add;
    if model.transfer == 1u {
        x = pow(max(x, vec3f(0.0)), vec3f(1.0 / 2.2));
    }
    if model.transfer == 2u {
        x = select(1.055 * pow(max(x, vec3f(0.0)), vec3f(1.0 / 2.4)) - 0.055, 12.92 * x, x <= vec3f(0.0031308));
    }
    return clipped(x, model.after_low, model.after_high);
}

// `radiance`.
fn rendered(model: Model, texel: Texel, directions: Directions) -> vec3f {
    let here = surface(model, texel);
    let w_v = select(directions.w_v, directions.w_l, model.collocated != 0u);
    let l = divided(directions.w_l, model.vec_eps);
    let v = divided(w_v, model.vec_eps);
    let middle = 0.5 * (l + v);
    let h = divided(middle, model.vec_eps);
    let n = here.normal;
    // |n x h|^2 = |n|^2 |h|^2 - (n.h)^2 and |v - h|^2 = |v|^2 + |h|^2 - 2 v.h, and no vector needs to have length 1.
    let short = shortfall(sqrt(length_squared(middle)), model.vec_eps);
    let short_v = shortfall(sqrt(length_squared(w_v)), model.vec_eps);
    let sine2 = length_squared(cross(n, h)) + here.shortfall + short - here.shortfall * short;
    let rest = 0.5 * (length_squared(v - h) + short_v + short);
    let x = Vectors(l.z, dot(n, l), dot(n, v), dot(n, h), dot(v, h), sine2, rest);
    if model.lz == 0.0 && (x.l_z <= 0.0 || x.nl <= 0.0) {
        return encoded(model, vec3f(0.0));
    }
    let parts = terms(model, here, x);
    let light = irradiance(model, x, directions);
    let cosine = min(max(x.nl, model.cos_min), model.cos_max);
    let matte = clipped(parts.diffuse * cosine * light, model.term_low, model.term_high);
    let scale = select(1.0, cosine, model.spec_cosine != 0u);
    let lobe = clipped(parts.specular * scale * light, model.term_low, model.term_high);
    let result = encoded(model, matte + lobe + model.ambient * here.diffuse);
    // Where 0 is divided by 0, nothing; by its bits, since compilers may take `x != x` to be never true.
    let is_number = (bitcast<vec3u>(result) & vec3u(0x7fffffffu)) <= vec3u(0x7f800000u);
    return select(vec3f(0.0), min(result, vec3f(LARGEST)), is_number);
}
