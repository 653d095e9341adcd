// Pass 2 of the report: WebGL has no constants of pipelines, so that uniforms take their place.

struct PageDisplay {
    mode: u32,
    difference: u32,
    encoding: u32,
    show_clipping: u32,
    tiling: u32,
    false_colour: u32,
    nearest: u32,
}

var<private> MODE: u32;
var<private> DIFFERENCE: u32;
var<private> ENCODING: u32;
var<private> SHOW_CLIPPING: bool;
var<private> TILING: u32;
var<private> FALSE_COLOUR: bool;
var<private> NEAREST: bool;

@group(0) @binding(3) var<uniform> page: PageDisplay;

@fragment
fn page_display(corner: Corner) -> @location(0) vec4f {
    MODE = page.mode;
    DIFFERENCE = page.difference;
    ENCODING = page.encoding;
    SHOW_CLIPPING = page.show_clipping != 0u;
    TILING = page.tiling;
    FALSE_COLOUR = page.false_colour != 0u;
    NEAREST = page.nearest != 0u;
    return displayed(corner);
}
