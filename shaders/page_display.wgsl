// Pass 2 of the report: WebGL has no constants of pipelines, so that uniforms take their place.

struct PageDisplay {
    mode: u32,
    difference: u32,
    encoding: u32,
}

var<private> MODE: u32;
var<private> DIFFERENCE: u32;
var<private> ENCODING: u32;
const SHOW_CLIPPING = false;
const FALSE_COLOUR = false;
const NEAREST = false;

@group(0) @binding(3) var<uniform> page: PageDisplay;

@fragment
fn page_display(corner: Corner) -> @location(0) vec4f {
    MODE = page.mode;
    DIFFERENCE = page.difference;
    ENCODING = page.encoding;
    return displayed(corner);
}
