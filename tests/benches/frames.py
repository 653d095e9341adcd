#!/usr/bin/env python3
"""Measures the frames of the real window: the times between frames that arrived on the screen.

    cargo build --release
    tests/benches/frames.py target/release/svbrdf [GT PRED...] [--only-latency]
    tests/benches/frames.py target/release/svbrdf GT PRED --why
    tests/benches/frames.py target/release/svbrdf --dataset GT METHOD...

Needs Xvfb and xdotool, and a machine that does nothing else. The window has 1360 x 860 points. The pointer hovers over a pane, then
drags the light; then both again with magnified materials, and with differences. The screen is read from the memory of Xvfb every
millisecond; a frame is a change of it. Prints the median and the 95th percentile of the times between frames, and the processor time
per frame. Then single motions: from the event of the mouse to the first changed pixel of another pane, which is what a hand feels
(`--only-latency`: nothing else). With materials also the time from the start to the first picture and to the last one, beside that of `svbrdf info`, which
reads them and does no more. With --why: from a click on the tab Why to its
first line. With --dataset: flips, memory, and drags in the contact sheet of a data set, such as that of
`cargo run --release --example make_dataset -- FOLDER`. A large material, here of 2048 x 2048 texels, of a small one:

    convert assets/samples/worn_tiles.png -sample 800% -attenuate 0.02 +noise Gaussian gt.png
"""

import math
import mmap
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import time

WIDTH, HEIGHT = 1360, 860
SECONDS = 6.0
# Events of a mouse, per second.
RATE = 120
# A frame is copied to the screen in pieces: changes closer than this belong to one frame.
ONE_FRAME = 0.004
# Single motions, and the seconds between them: everything is sharp again by then.
MOTIONS, BETWEEN_MOTIONS = 40, 0.4
# Keys to the next material of a data set whose times are measured.
FLIPS = 30
# What flips change: rows and columns inside the picture of the first method, beside titles and lists, which change before.
FLIPPED = ((540, 740), range(120, 320, 9))
# The tab Why, and where the first line of its diagnosis is, of one prediction.
WHY, FIRST_LINE = (1120, 45), ((1049, 1340), range(204, 229, 2))
# What is compared: rows of the other panes. The server itself draws the pointer, which is not a frame.
ROWS = range(8, HEIGHT, 9)
COLUMNS = (530, 1030)
# The panes, and from how many colours on they show a picture.
PANES = (10, 1010)
COLOURS = 500


class Screen:
    """The memory of a virtual display."""

    def __init__(self, folder):
        read, write = os.pipe()
        size = ["-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-fbdir", folder, "-nolisten", "tcp"]
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), *size], pass_fds=[write], stderr=subprocess.DEVNULL
        )
        os.close(write)
        self.display = ":" + os.fdopen(read).readline().strip()
        file = open(pathlib.Path(folder) / "Xvfb_screen0", "rb")
        self.memory = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        fields = struct.unpack(">25I", self.memory[:100])
        # Of an X window dump: the header, then the colours of 12 bytes each, then the rows.
        self.start, self.stride = fields[0] + 12 * fields[19], fields[12]

    def rows(self, columns=COLUMNS, rows=ROWS):
        left, right = (4 * column for column in columns)
        place = lambda row: self.start + row * self.stride
        return b"".join(self.memory[place(row) + left : place(row) + right] for row in rows)

    def shows_picture(self):
        pixels = self.rows(PANES, range(60, 800, 20))
        return len(set(struct.unpack(f"{len(pixels) // 4}I", pixels))) > COLOURS


def processor_seconds(process):
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def path(centre, radius):
    """Pointer positions on a curve that never rests."""
    for i in range(int(SECONDS * RATE)):
        turn = 2 * math.pi * i / RATE / 1.7
        yield round(centre[0] + radius * math.cos(turn)), round(centre[1] + radius * math.sin(1.3 * turn))


def measure(screen, process, environment, name, button, centre, radius):
    moves = [word for x, y in path(centre, radius) for word in ("mousemove", str(x), str(y), "sleep", str(1 / RATE))]
    down, up = (["mousedown", "1"], ["mouseup", "1"]) if button else ([], [])
    subprocess.run(["xdotool", "mousemove", str(centre[0]), str(centre[1]), *down], env=environment, check=True)
    time.sleep(0.5)
    pointer = subprocess.Popen(["xdotool", *moves], env=environment)
    before, start = screen.rows(), time.perf_counter()
    used, changes = processor_seconds(process), []
    while pointer.poll() is None:
        now, rows = time.perf_counter(), screen.rows()
        if rows != before and (not changes or now - changes[-1] > ONE_FRAME):
            changes.append(now)
        before = rows
        time.sleep(0.001)
    used = processor_seconds(process) - used
    if up:
        subprocess.run(["xdotool", *up], env=environment, check=True)
    # The first tenth is the adapter's warming up and the choice of how much is shaded.
    changes = [change for change in changes if change - start > 0.1 * SECONDS]
    times = sorted(1e3 * (b - a) for a, b in zip(changes, changes[1:]))
    if len(times) < 10:
        print(f"{name:<28} only {len(times)} frames")
        return
    at = lambda share: times[min(int(share * len(times)), len(times) - 1)]
    cost = 1e3 * used / len(times)
    print(
        f"{name:<28} {len(times):4} frames, p50 {at(0.5):6.1f} ms, p95 {at(0.95):6.1f} ms, {cost:6.1f} ms of processor a frame"
    )


def latency(screen, environment, name, centre, radius):
    """Times from the event of a motion to the first changed pixel of another pane, while the light is held."""
    subprocess.run(
        ["xdotool", "mousemove", str(centre[0]), str(centre[1]), "mousedown", "1"], env=environment, check=True
    )
    time.sleep(1.0)
    times = []
    for i in range(MOTIONS):
        turn = 2 * math.pi * i / 7.3
        x, y = round(centre[0] + radius * math.cos(turn)), round(centre[1] + radius * math.sin(turn))
        before = screen.rows()
        # The event is in the queue of the window when the program has ended; starting it takes a few milliseconds.
        subprocess.run(["xdotool", "mousemove", str(x), str(y)], env=environment, check=True)
        start = time.perf_counter()
        while screen.rows() == before and time.perf_counter() - start < 1.0:
            time.sleep(0.0005)
        times.append(1e3 * (time.perf_counter() - start))
        time.sleep(BETWEEN_MOTIONS)
    subprocess.run(["xdotool", "mouseup", "1"], env=environment, check=True)
    times.sort()
    print(
        f"{name:<28} {len(times):4} motions, p50 {times[len(times) // 2]:6.1f} ms, p95 {times[int(0.95 * len(times))]:6.1f} ms to the changed pixel"
    )


def first_line(screen, environment):
    """The time from a click on the tab Why to the first line of its diagnosis."""
    move = ["mousemove", *map(str, WHY)]
    subprocess.run(["xdotool", *move, "sleep", "0.5"], env=environment, check=True)
    before, start = screen.rows(*FIRST_LINE), time.perf_counter()
    subprocess.run(["xdotool", "click", "1"], env=environment, check=True)
    last = start
    # First what another tab had there goes, then the line comes.
    while time.perf_counter() - start < 20 and (last == start or time.perf_counter() - last < 5):
        if (now := screen.rows(*FIRST_LINE)) != before:
            before, last = now, time.perf_counter()
        time.sleep(0.002)
    print(f"first line of the diagnosis {last - start:.2f} s after the click")


def flips(screen, process, environment):
    """Times from the key to the first changed pixel of a picture, and the memory after many flips."""
    press = lambda key: subprocess.run(["xdotool", "key", key], env=environment, check=True)
    times = []
    for flip in range(FLIPS):
        before = screen.rows(*FLIPPED)
        # To and fro: a small data set has an end.
        press("Next" if flip % 20 < 10 else "Prior")
        start = time.perf_counter()
        while screen.rows(*FLIPPED) == before and time.perf_counter() - start < 2.0:
            time.sleep(0.0005)
        times.append(1e3 * (time.perf_counter() - start))
        time.sleep(0.8)
    times.sort()
    print(f"{'flips':<28} {len(times):4} keys, p50 {times[len(times) // 2]:6.1f} ms, p95 {times[int(0.95 * len(times))]:6.1f} ms to the changed pixel")
    for count in (0, 100, 200, 300, 400, 500):
        for flip in range(100 if count else 0):
            press("Next" if flip % 40 < 20 else "Prior")
            time.sleep(0.1)
        time.sleep(1)
        status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
        resident = int(status.split("VmRSS:")[1].split()[0]) / 1024
        print(f"  after {count} flips {resident:.0f} MiB")


def until_still(screen, start):
    """Waits until nothing has changed for a while: the materials are there, and the loss is computed. The times of the first picture and
    of the last change."""
    still, since, first = screen.rows(PANES), time.perf_counter(), None
    while time.perf_counter() - since < 8 or first is None:
        time.sleep(0.01)
        if first is None and screen.shows_picture():
            first = time.perf_counter() - start
        if (now := screen.rows(PANES)) != still:
            still, since = now, time.perf_counter()
    return first, since - start


def reading(program, material):
    start = time.perf_counter()
    subprocess.run([program, "info", material], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return time.perf_counter() - start


def main():
    options = ("--only-latency", "--dataset", "--why")
    only_latency, is_dataset, is_why = (option in sys.argv for option in options)
    arguments = [argument for argument in sys.argv[1:] if argument not in options]
    program, materials = pathlib.Path(arguments[0]).resolve(), [str(pathlib.Path(p).resolve()) for p in arguments[1:]]
    with tempfile.TemporaryDirectory() as folder:
        screen = Screen(folder)
        environment = {
            **os.environ,
            "DISPLAY": screen.display,
            "HOME": folder,
            "XDG_RUNTIME_DIR": folder,
            "WGPU_BACKEND": "vulkan",
        }
        environment.pop("WAYLAND_DISPLAY", None)
        # Twice: the first time the files come from the disk.
        alone = [] if is_dataset else [[reading(program, material) for material in materials] for _ in range(2)][1]
        start = time.perf_counter()
        command = [program, *(["view", "--dataset"] if is_dataset else []), *materials]
        process = subprocess.Popen(command, env=environment, cwd=folder, stderr=subprocess.DEVNULL)
        try:
            first, last = until_still(screen, start)
            if is_dataset:
                print(f"first picture {first:.2f} s, all losses {last:.2f} s")
            elif materials:
                print(
                    f"first picture {first:.2f} s (reading it alone {alone[0]:.2f} s), all {last:.2f} s ({sum(alone):.2f} s)"
                )
            subprocess.run(
                [
                    "xdotool",
                    "search",
                    "--sync",
                    "--onlyvisible",
                    "--name",
                    "svbrdf",
                    "windowsize",
                    str(WIDTH),
                    str(HEIGHT),
                    "windowmove",
                    "0",
                    "0",
                    "windowfocus",
                ],
                env=environment,
                check=True,
                stdout=subprocess.DEVNULL,
            )
            print(f"load {os.getloadavg()[0]:.1f} before the measurement")
            if is_dataset:
                flips(screen, process, environment)
                subprocess.run(["xdotool", "key", "s"], env=environment, check=True)
                time.sleep(5)
                measure(screen, process, environment, "drag the light in the sheet", True, (600, 400), 30)
                return
            if is_why:
                first_line(screen, environment)
                return
            pane, key = (260, 240), lambda k: subprocess.run(["xdotool", "key", k], env=environment, check=True)
            latency(screen, environment, "motions of the light", pane, 90)
            if only_latency:
                return
            measure(screen, process, environment, "hover", False, pane, 90)
            measure(screen, process, environment, "drag the light", True, pane, 90)
            subprocess.run(["xdotool", "mousemove", *map(str, pane), *["click", "4"] * 8], env=environment, check=True)
            time.sleep(2)
            measure(screen, process, environment, "hover, magnified", False, pane, 90)
            measure(screen, process, environment, "drag the light, magnified", True, pane, 90)
            key("r"), key("d")
            time.sleep(3)
            measure(screen, process, environment, "hover, difference", False, pane, 90)
            measure(screen, process, environment, "drag the light, difference", True, pane, 90)
        finally:
            for one in (process, screen.server):
                one.terminate()
                one.wait()


if __name__ == "__main__":
    main()
