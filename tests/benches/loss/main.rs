//! The rendering loss: the fused kernel beside the plain one, at several sizes, scene counts and instruction sets.
//!
//! Tables with the time per texel-scene ("pp": both materials rendered and compared) and the share of the compute bound, which is
//! measured in the same run. Every measured loss is asserted.

#![allow(clippy::disallowed_methods, reason = "a benchmark reads files of the system")]

mod bound;
mod job;
mod rows;

use svbrdf_core::render::simd::Level;

use bound::bound;
use job::{Job, on};
use rows::{predictions_rows, rendering_rows, sampled_rows, sizes};

fn main() {
    let threads = rayon::current_num_threads();
    let bounds = [1, threads].map(|threads| on(threads, bound));
    println!("compute bound: {:.2} ns/pp on 1 thread, {:.2} on {threads}\n", bounds[0], bounds[1]);
    println!("| texels | scenes | threads | level | ms, best | median | ns/pp | of the bound | plain, ms |");
    println!("|---|---|---|---|---|---|---|---|---|");
    for (size, near, distant) in
        [(64, 6, 3), (256, 6, 3), (1024, 6, 3), (256, 1, 0), (256, 0, 1), (256, 64, 32)]
    {
        let job = Job::new(size, near, distant);
        for (threads, bound) in [1, threads].into_iter().zip(bounds) {
            on(threads, || job.row("best", Level::best(), bound));
        }
        if (size, near) == (256, 6) {
            for (name, level) in Level::all() {
                match level {
                    Some(level) => on(1, || job.row(name, level, bounds[0])),
                    None => println!("| {size}^2 | {near} + {distant} | 1 | {name} | not on this machine |"),
                }
            }
        }
    }
    println!();
    on(1, || predictions_rows(bounds[0]));
    println!();
    on(1, rendering_rows);
    on(threads, rendering_rows);
    on(threads, sampled_rows);
    sizes(threads);
}
