// From a point of a pane to the point of the plane that is seen there: the twin of src/camera.rs.

struct Camera {
    origin: vec3f,
    origin_right: vec3f,
    origin_up: vec3f,
    direction: vec3f,
    direction_right: vec3f,
    direction_up: vec3f,
}

struct Seen {
    point: vec2f,
    // Whether the ray meets the plane at all; the point means nothing otherwise.
    hit: bool,
}

fn plane_from_ndc(camera: Camera, ndc: vec2f) -> Seen {
    let origin = camera.origin + camera.origin_right * ndc.x + camera.origin_up * ndc.y;
    let direction = camera.direction + camera.direction_right * ndc.x + camera.direction_up * ndc.y;
    let hit = direction.z < 0.0;
    let t = -origin.z / select(-1.0, direction.z, hit);
    return Seen(origin.xy + direction.xy * t, hit);
}
