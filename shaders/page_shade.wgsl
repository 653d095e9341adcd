// Pass 1 of the report: WebGL has no constants of pipelines, so that uniforms take their place.

struct PageShading {
    quantity: u32,
    repeated: u32,
}

var<private> QUANTITY: u32;
var<private> REPEATED: bool;

@group(0) @binding(4) var<uniform> page: PageShading;

@fragment
fn page_shade(corner: Corner) -> @location(0) vec4f {
    QUANTITY = page.quantity;
    REPEATED = page.repeated != 0u;
    return shaded(corner);
}
