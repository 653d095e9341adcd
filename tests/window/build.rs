//! Tells the tests of the window whether there is a graphics driver.

#[path = "../needs/adapter.rs"]
mod adapter;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=../needs/adapter.rs");
    adapter::watch();
    for (name, holds) in
        [("has_adapter", adapter::is_there()), ("has_f32_adapter", adapter::renders_to_f32())]
    {
        println!("cargo::rustc-check-cfg=cfg({name})");
        if holds {
            println!("cargo::rustc-cfg={name}");
        }
    }
}
