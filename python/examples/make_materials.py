"""Makes the data set of docs/tutorial.md: twelve materials in gt/, and what three methods predict for them.

Every map is a PPM picture of 64 x 64 texels, so this needs nothing but Python. `soft` flattens the normals. `plain` has
one diffuse and one roughness for each material. `sharp` is close, but stores alpha = r^2 as its roughness.
"""

from math import sin
from pathlib import Path

SIZE = 64
Maps = dict[str, list[list[float]]]
NAMES = "brick cobble concrete cork cotton gravel leather linen oak plaster rubber slate".split()  # noqa: SIM905


def wave(seed: int, x: float, y: float) -> float:
    """A smooth pattern from 0 to 1."""
    return 0.5 + 0.25 * (sin((5 + seed % 4) * x + seed) + sin((7 + seed % 3) * y + 3 * x + 2 * seed))


def material(seed: int, steep: float = 1, even: bool = False, power: float = 1) -> Maps:
    """The colours of each map: slopes times `steep`, one diffuse and roughness if `even`, roughness to the `power`."""
    maps: Maps = {"normal": [], "diffuse": [], "specular": [], "roughness": []}
    for row in range(SIZE):
        for column in range(SIZE):
            x, y = 6 * column / SIZE, 6 * row / SIZE
            height = wave(seed, x, y)
            slope = [2 * steep * (height - wave(seed, x + 0.1, y)), 2 * steep * (wave(seed, x, y + 0.1) - height)]
            length = (slope[0] ** 2 + slope[1] ** 2 + 1) ** 0.5
            shade = 0.5 if even else wave(seed + 5, y, x)
            maps["normal"].append([0.5 + 0.5 * v / length for v in (*slope, 1)])
            albedo = 0.25 + 0.2 * shade
            maps["diffuse"].append([albedo, albedo * 0.8, albedo * (0.4 + 0.05 * (seed % 8))])
            maps["specular"].append(3 * [0.04])
            maps["roughness"].append(3 * [(0.3 + 0.04 * (seed % 6) + 0.1 * shade) ** power])
    return maps


def write(folder: Path, maps: Maps) -> None:
    """Writes a picture of each map."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, colours in maps.items():
        stored = bytes(round(255 * value) for colour in colours for value in colour)
        (folder / f"{name}.ppm").write_bytes(b"P6 %d %d 255\n" % (SIZE, SIZE) + stored)


for seed, name in enumerate(NAMES):
    write(Path("gt", name), material(seed))
    write(Path("soft", name), material(seed, steep=0.85))
    write(Path("plain", name), material(seed, even=True))
    write(Path("sharp", name), material(seed, steep=0.95, power=2))
