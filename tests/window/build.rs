//! Tells the tests of the window whether there is a graphics driver.

#[path = "../../build/adapter.rs"]
mod adapter;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=../../build");
    adapter::tell_cargo();
}
