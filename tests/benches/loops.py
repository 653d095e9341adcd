#!/usr/bin/env python3
"""Counts the operations of the kernel's compiled loops, and what they take at least on Zen 4 and Zen 5.

    cargo bench --no-default-features --bench loss --no-run
    tests/benches/loops.py target/release/deps/loss-HASH [llvm-mca]

Needs objdump and llvm-mca 19 or later (Debian: llvm-19; `llvm-mca-19` unless another name is given), and no AVX-512. All numbers are
for 16 texels, one vector: the instructions of the AVX-512 loops that a default loss runs (fast path, no clamps), by the execution
ports they need; the cycles of the ports, by PORTS below; and the cycles of llvm-mca. A plain bound counts 156 operations for a texel
and scene, all as halves of multiply-adds: 78 multiply-adds. What no port can fuse takes more, and that is the ports' bound.
"""

import collections
import pathlib
import re
import subprocess
import sys
import tempfile

# A model: instructions of 512 bits that start in a cycle. Zen 4 splits them in two, as the tables of llvm-mca have it; Zen 5 of full width
# does not.
PORTS = {
    "znver4": {"multiply": 1, "add": 1, "load": 1, "store": 0.5, "all": 6},
    "znver5": {"multiply": 2, "add": 2, "load": 2, "store": 1, "all": 8},
}
# The first pattern that fits an instruction names its class. The two pipes that multiply also compare, divide and estimate roots.
CLASSES = {
    "multiply-add": r"vfn?m(add|sub)",
    "multiply": r"vmulps",
    "min, max": r"v(min|max)ps",
    "divide": r"v(div|rcp)",
    "root": r"vrsqrt",
    "compare": r"vcmp",
    "add": r"v(add|sub)ps",
    "integer": r"v(p[a-lo-z]|and|or|xor|pmin|pmax)",
}
MULTIPLY = ("multiply-add", "multiply", "min, max", "divide", "root", "compare")
PLAIN_BOUND = 78


def functions(program):
    """Yields lists of (address, instruction)."""
    text = subprocess.run(
        ["objdump", "-d", "--no-show-raw-insn", program], capture_output=True, text=True, check=True
    ).stdout
    for function in re.split(r"\n\n", text):
        lines = re.findall(r"^ *([0-9a-f]+):\s+(\S.*?)\s*(?:#.*|<.*)?$", function, re.MULTILINE)
        yield [(int(address, 16), instruction) for address, instruction in lines]


def target(instruction):
    """The address that a jump goes to."""
    found = re.match(r"j\w+\s+([0-9a-f]+)$", instruction)
    return int(found[1], 16) if found else None


def blocks(function):
    """Splits a function at jumps, returns and what is jumped to. Yields (instructions, whether it is a loop)."""
    starts = {target(instruction) for _, instruction in function}
    block = []
    for address, instruction in function:
        if address in starts and block:
            yield [text for _, text in block], False
            block = []
        block.append((address, instruction))
        if instruction.startswith(("j", "ret", "ud2")):
            yield [text for _, text in block], target(instruction) == block[0][0]
            block = []


def count(block):
    """The instructions of each class."""
    counts = collections.Counter()
    for instruction in block:
        name = next((name for name, pattern in CLASSES.items() if re.match(pattern, instruction)), None)
        counts[name or "other"] += 1
        if "(" in instruction and not instruction.startswith("lea"):
            counts["store" if re.search(r"%[xyz]mm\d+,[^,]*\([^)]*\)$", instruction) else "load"] += 1
    return counts


def is_wide(block):
    """Whether it computes with vectors of 512 bits."""
    return any("%zmm" in instruction for instruction in block)


def loops(program):
    """Finds the loops of a default loss. Yields (name, instructions, vectors of texels)."""
    wide = [list(blocks(function)) for function in functions(program) if is_wide([text for _, text in function])]
    loss = max(wide, key=lambda found: sum(count(block)["root"] for block, _ in found), default=[])
    shading = sorted(
        (block for block, loop in loss if loop and count(block)["divide"] == 1 and count(block)["store"] == 3), key=len
    )
    comparing = [
        block
        for block, _ in loss
        if count(block)["min, max"] >= 12 and count(block)["integer"] and not count(block)["root"]
    ]
    geometry = [instruction for block, _ in loss if count(block)["root"] for instruction in block]
    if not shading or not comparing or not geometry:
        sys.exit(
            f"{program}: expected the AVX-512 loops of the loss, found {len(shading)} that shade and {len(comparing)} that compare"
        )
    # Of the paths of the kernel, the fast one is the shortest, and compares with the fewest operations on exponents; near-field scenes load their geometry, distant ones keep it.
    distant = shading[0]
    near = next(block for block in shading if count(block)["load"] > count(distant)["load"] + 5)
    yield "near-field geometry", geometry, count(geometry)["root"] / 3
    yield "a material, near-field", near, 1
    yield "a material, distant", distant, 1
    fast = min(comparing, key=lambda block: count(block)["integer"] / count(block)["min, max"])
    yield "a comparison", fast, count(fast)["min, max"] / 6


def port_cycles(counts, processor):
    """The cycles of the busiest port, and its name."""
    ports = PORTS[processor]
    everything = sum(number for name, number in counts.items() if name not in ("load", "store"))
    used = {
        "multiply": sum(counts[name] for name in MULTIPLY),
        "add": counts["add"],
        "load": counts["load"],
        "store": counts["store"],
    }
    used["all"] = everything
    return max((number / ports[port], port) for port, number in used.items())


def simulated(block, processor, analyzer):
    """The cycles that llvm-mca says for one round of a block that repeats."""
    with tempfile.NamedTemporaryFile("w", suffix=".s") as file:
        file.write("".join(f"{text}\n" for text in block if not text.startswith("j") and "%rip" not in text))
        file.flush()
        command = [analyzer, "-mtriple=x86_64", f"-mcpu={processor}", "-iterations=100", file.name]
        output = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    return int(re.search(r"Total Cycles:\s+(\d+)", output)[1]) / 100


def main():
    """Prints the table."""
    program = sys.argv[1] if len(sys.argv) > 1 else sys.exit(__doc__)
    if not pathlib.Path(program).is_file():
        sys.exit(f"{program}: expected a program, found none")
    analyzer = sys.argv[2] if len(sys.argv) > 2 else "llvm-mca-19"
    names = [*CLASSES, "other", "load", "store"]
    print("| per 16 texels | " + " | ".join(names) + " | ports, Zen 4 | Zen 5 | llvm-mca, Zen 4 | Zen 5 |")
    print("|" + "---|" * (len(names) + 5))
    cycles = {}
    for name, block, vectors in loops(program):
        counts = collections.Counter({key: number / vectors for key, number in count(block).items()})
        ports = [port_cycles(counts, processor) for processor in PORTS]
        cycles[name] = [least for least, _ in ports] + [
            simulated(block, processor, analyzer) / vectors for processor in PORTS
        ]
        row = [f"{counts[key]:.3g}" for key in names] + [f"{least:.3g} ({port})" for least, port in ports]
        print(
            f"| {name} | " + " | ".join(row) + " | " + " | ".join(f"{number:.3g}" for number in cycles[name][2:]) + " |"
        )
    print()
    print("| cycles per 16 texels and scene | plain bound, Zen 4 | Zen 5 | ports, Zen 4 | Zen 5 | llvm-mca, Zen 4 |")
    print("|---|---|---|---|---|---|")
    geometry, near, distant, comparing = cycles.values()
    for predictions in (1, 8):
        parts = zip(geometry, near, distant, comparing, strict=True)
        # Two of three scenes are near-field ones.
        cost = [
            2 / 3 * (g + (1 + predictions) * n) + (1 + predictions) / 3 * d + predictions * c for g, n, d, c in parts
        ]
        plain = (98 + 58 * predictions) / 2
        assert predictions != 1 or plain == PLAIN_BOUND
        shares = [100 * plain / cost[0], 100 * plain / 2 / cost[1], 100 * plain / cost[2]]
        print(
            f"| {predictions} predictions, 6 + 3 scenes | {plain:.0f} | {plain / 2:.1f} | {cost[0]:.0f}: {shares[0]:.0f}% of the plain bound "
            f"at most | {cost[1]:.1f}: {shares[1]:.0f}% | {cost[2]:.0f}: {shares[2]:.0f}% |"
        )


if __name__ == "__main__":
    main()
