"""JPEG of every sampling, colour space and size: the values of Pillow, or a refusal that names the form."""

import io
import itertools
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import svbrdf
from PIL import Image

SIZES = [(1, 1), (2, 3), (7, 5), (8, 8), (9, 17), (16, 16), (17, 9), (33, 31), (64, 48), (70, 1)]
ONE = (1, 1)
LUMA = [ONE, (2, 1), (1, 2), (2, 2), (4, 1), (1, 4), (4, 2), (3, 1)]
# The identifiers of the components, and the colours in the marker of Adobe.
SPACES: dict[str, tuple[bytes, int | None]] = {
    "gray": (b"\1", None),
    "YCbCr": (b"\1\2\3", None),
    "YCbCr of Adobe": (b"\1\2\3", 1),
    "RGB": (b"RGB", 0),
}


def samplings(count: int) -> list[list[tuple[int, int]]]:
    if count == 1:
        return [[luma] for luma in LUMA]
    mixed = [[(2, 2), (1, 2), (1, 2)], [(2, 2), (2, 1), ONE], [ONE, (2, 1), ONE], [ONE, (2, 2), (2, 2)]]
    return [[luma, ONE, ONE] for luma in LUMA] + [[(2, 1)] * 3, [(1, 2)] * 3, *mixed]


def is_same(space: str, sampling: list[tuple[int, int]]) -> bool:
    """Whether the file has the values of libjpeg; others are refused."""
    if "YCbCr" in space:
        return all(sampling[0][axis] % one[axis] == 0 for one in sampling for axis in (0, 1))
    return len(set(sampling)) == 1


def segments(file: bytes) -> Iterator[tuple[int, bytes]]:
    """The marker and the bytes of each segment, and what follows the last."""
    at, marker = 2, 0
    while marker != 0xDA:
        marker, end = file[at + 1], at + 2 + int.from_bytes(file[at + 2 : at + 4], "big")
        yield marker, file[at:end]
        at = end
    yield 0, file[at:-2]


def codes(segment: bytes) -> dict[int, dict[str, int]]:
    """The symbols of the Huffman codes, of DC by 0 and of AC by 1."""
    tables: dict[int, dict[str, int]] = {}
    at = 4
    while at < len(segment):
        table = tables.setdefault(segment[at] >> 4, {})
        counts, code, at = segment[at + 1 : at + 17], 0, at + 17
        for length, count in enumerate(counts, 1):
            for _ in range(count):
                table[f"{code:0{length}b}"] = segment[at]
                code, at = code + 1, at + 1
            code <<= 1
    return tables


def blocks(plane: Any, factors: tuple[int, int], units: tuple[int, int]) -> tuple[list[str], bytes]:
    """The bits of every block of a plane, in the order of a scan of all components; the tables."""
    (across, down), (columns, rows) = factors, units
    tall = plane.reshape(rows, down, 8, columns, across, 8).transpose(0, 3, 1, 4, 2, 5).reshape(-1, 8)
    file = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(tall)).save(file, "JPEG", quality=90)
    parts = list(segments(file.getvalue()))
    tables = {kind: table for marker, part in parts if marker == 0xC4 for kind, table in codes(part).items()}
    bits = "".join(f"{byte:08b}" for byte in parts[-1][1].replace(b"\xff\0", b"\xff"))
    at, found = 0, []
    for _ in range(len(tall) // 8):
        start, number = at, 0
        while number < 64:
            table = tables[number > 0]
            length = next(n for n in range(1, 17) if bits[at : at + n] in table)
            symbol = table[bits[at : at + length]]
            at += length + (symbol & 15)
            number = 64 if number and not symbol else number + (symbol >> 4) + 1
        found.append(bits[start:at])
    return found, b"".join(part for marker, part in parts if marker in (0xDB, 0xC4))


def jpeg(size: tuple[int, int], sampling: list[tuple[int, int]], identifiers: bytes, adobe: int | None) -> bytes:
    """A JPEG of waves and noise, its components interleaved."""
    width, height = size
    most = [max(one[axis] for one in sampling) for axis in (0, 1)]
    random = np.random.default_rng(width)
    coded, tables = [], b""
    for number, factors in enumerate(sampling):
        # A single component has blocks in their own order, whatever its factors.
        own, of_all = (ONE, ONE) if len(sampling) == 1 else (factors, (most[0], most[1]))
        units = (-(-width // (8 * of_all[0])), -(-height // (8 * of_all[1])))
        y, x = np.mgrid[: units[1] * 8 * own[1], : units[0] * 8 * own[0]]
        wave = 128 + 90 * np.sin((0.2 + 0.05 * number) * x + number) * np.cos((0.17 + 0.04 * number) * y)
        plane = (wave + random.integers(-35, 36, wave.shape)).clip(0, 255).astype(np.uint8)
        bits, tables = blocks(plane, own, units)
        count = own[0] * own[1]
        coded.append(["".join(bits[at : at + count]) for at in range(0, len(bits), count)])
    all_bits = "".join(itertools.chain.from_iterable(zip(*coded, strict=True)))
    all_bits += "1" * (-len(all_bits) % 8)
    data = int(all_bits, 2).to_bytes(len(all_bits) // 8, "big").replace(b"\xff", b"\xff\0")

    def segment(marker: int, body: bytes) -> bytes:
        return bytes([255, marker]) + (len(body) + 2).to_bytes(2, "big") + body

    frame = b"\x08" + height.to_bytes(2, "big") + width.to_bytes(2, "big") + bytes([len(sampling)])
    frame += b"".join(bytes([name, x << 4 | y, 0]) for name, (x, y) in zip(identifiers, sampling, strict=True))
    scan = bytes([len(sampling)]) + b"".join(bytes([name, 0]) for name in identifiers) + b"\0\x3f\0"
    of_adobe = b"" if adobe is None else segment(0xEE, b"Adobe\0\x64\0\0\0\0" + bytes([adobe]))
    return b"\xff\xd8" + of_adobe + tables + segment(0xC0, frame) + segment(0xDA, scan) + data + b"\xff\xd9"


CASES = [
    (space, sampling, size)
    for space, (names, _) in SPACES.items()
    for sampling in samplings(len(names))
    for size in SIZES
]


@pytest.mark.parametrize(("space", "sampling", "size"), CASES)
@pytest.mark.filterwarnings("ignore")
def test_values_are_those_of_pillow(space: str, sampling: Any, size: Any, tmp_path: Path) -> None:
    file = tmp_path / "m_diffuse.jpg"
    file.write_bytes(jpeg(size, sampling, *SPACES[space]))
    Image.new("L", size, 128).save(tmp_path / "m_roughness.png")
    if not is_same(space, sampling):
        with pytest.raises(svbrdf.Error, match=r"m_diffuse.jpg.* with .*; convert it to PNG in RGB"):
            svbrdf.read(tmp_path, albedo="linear")
        return
    expected = np.asarray(Image.open(file).convert("RGB"))
    found = np.rint(255 * svbrdf.read(tmp_path, albedo="linear").diffuse)
    np.testing.assert_array_equal(found, expected)
