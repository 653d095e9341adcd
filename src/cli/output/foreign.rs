//! Words that other programs have, and what does the same here.

/// Commands of other programs, a line for each of ours.
const COMMANDS: &str = "\
compare diff evaluate eval score test: `svbrdf loss GT PRED` compares, and `svbrdf rank --dataset GT METHOD` methods over folders
open show display gui viewer: `svbrdf view FILE` opens the window
psnr ssim rmse mse mae lpips flip errors error: `svbrdf metrics GT PRED` has the metrics of maps
benchmark bench leaderboard table: `svbrdf rank --dataset GT METHOD...` makes the table of methods
figure sheet grid collage: `svbrdf strip` makes figures, `svbrdf report` pages
html page web: `svbrdf report GT PRED -o page.html`
export save import pack unpack: `svbrdf convert IN OUT`
inspect identify stat describe check validate: `svbrdf info FILE` tells what it holds
relight shade draw: `svbrdf render FILE --light X,Y,Z -o out.png`
version: `svbrdf --version`";

/// Options of other programs, and of other commands of this one.
const OPTIONS: &str = "\
gt ground-truth truth reference ref target a first: the ground truth is the first argument, without a word before it
pred prediction predictions input inputs images files b second: predictions stand after the ground truth, without a word before them
data dataset data-dir root folder dir directory: `svbrdf rank --dataset GT METHOD...` compares folders of materials
json csv latex tex html text: --format takes json, csv or another format; `svbrdf rank` and `svbrdf report` write files with -o
output out save o: reports go to stdout: add `> FILE`, with --format json or csv
epsilon eps: epsilon is part of a convention: `svbrdf conventions printed > mine.toml`, change it there, and --convention mine.toml
n samples num-samples spp num-scenes count: --near N and --distant N set the numbers of scenes
backend gpu cuda device: losses are computed on the processor; in training `svbrdf.torch` computes them on a GPU
threads jobs workers j num-workers: all processors are used; the environment variable RAYON_NUM_THREADS sets how many
size resolution res width height resize scale: --resize-to gt, pred or a width in texels
metric psnr ssim rmse mse l1 l2 mae flip: `svbrdf metrics GT PRED` has the metrics of maps
lpips: neural metrics are not computed here; docs/metrics.md tells how to give renderings to one
gamma srgb linear colorspace color-space colourspace encoding: --read albedo=linear, srgb or gamma2.2 sets the encoding of colours
opengl directx dx flip-y flip-green invert-y flip-normal: --read normal-y=up (OpenGL) or down (DirectX)
gloss glossiness: --read roughness=gloss
diffuse albedo basecolor base-color normal roughness specular metallic metalness: \
one file a map: a folder or a prefix of their names; `svbrdf info --map normal=FILE --save` for other names
order layout tiles: --read order=ndrs says what the tiles of a packed image are
light lights view camera env envmap hdri: losses sample lights and views; --scenes FILE has those of a file, `svbrdf render` has --light and --view
exposure ev tonemap: losses have no exposure; `svbrdf render` has --exposure
crop register registration align: crops and scales are found by the maps; --register specifies them
quiet silent q: leave it out: progress goes to the terminal only
debug log verbosity: the environment variable RUST_LOG=info, and --verbose for what was noticed in reading
force overwrite f y yes: leave it out: outputs are replaced
recursive r: leave it out: `svbrdf rank --dataset` looks into folders";

/// What `table` advises for `word`.
fn advice(table: &'static str, word: &str) -> Option<&'static str> {
    let word = word.trim_start_matches('-').replace('_', "-").to_lowercase();
    let mut lines = table.lines().filter_map(|line| line.split_once(": "));
    lines.find(|(words, _)| words.split(' ').any(|one| one == word)).map(|(_, advice)| advice)
}

/// What to type in place of this command of other programs.
pub fn command(word: &str) -> Option<&'static str> {
    advice(COMMANDS, word)
}

/// What to do in place of this option of other programs, which is typed with its dashes.
pub fn option(word: &str) -> Option<&'static str> {
    advice(OPTIONS, word)
}
