// Pass 1 of the report: WebGL has no constants of pipelines, so that a uniform takes their place.

struct PageShading {
    quantity: u32,
}

var<private> QUANTITY: u32;

@group(0) @binding(4) var<uniform> page: PageShading;

@fragment
fn page_shade(corner: Corner) -> @location(0) vec4f {
    QUANTITY = page.quantity;
    return shaded(corner);
}
