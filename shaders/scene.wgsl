// Where light and view are: the twin of src/core/model/scene.rs and src/core/model/brdf.rs.

struct Rays {
    view: vec3f,
    // 1: at positions; 0: infinitely far, the same directions at every texel.
    near: u32,
    light: vec3f,
}

struct Directions {
    w_l: vec3f,
    w_v: vec3f,
}

fn from_texel(rays: Rays, c: vec3f) -> Directions {
    if rays.near != 0u {
        return Directions(rays.light - c, rays.view - c);
    }
    return Directions(rays.light, rays.view);
}
