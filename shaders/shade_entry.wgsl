// Pass 1 of the window.

// What is shaded: a constant of the pipeline, so that no driver compiles or runs the rest.
override QUANTITY: u32 = QUANTITY_RENDERING;

@fragment
fn shade(corner: Corner) -> @location(0) vec4f {
    return shaded(corner);
}
