#!/usr/bin/env python3
"""Measures the frames of the real window: the times between frames that arrived on the screen.

    cargo build --release
    tests/benches/frames.py target/release/svbrdf [GT PRED...] [--only-latency]

Needs Xvfb and xdotool, and a machine that does nothing else. The window has 1360 x 860 points. The pointer hovers over a pane, then
drags the light; then both again with magnified materials, and with differences. The screen is read from the memory of Xvfb every
millisecond; a frame is a change of it. Prints the median and the 95th percentile of the times between frames, and the processor time
per frame. Then single motions: from the event of the mouse to the first changed pixel of another pane, which is what a hand feels
(`--only-latency`: nothing else). With materials also the time from the start to the first picture and to the last one, beside that of `svbrdf info`, which
reads them and does no more. A large material, here of 2048 x 2048 texels, of a small one:

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
    only_latency = "--only-latency" in sys.argv
    arguments = [argument for argument in sys.argv[1:] if argument != "--only-latency"]
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
        alone = [[reading(program, material) for material in materials] for _ in range(2)][1]
        start = time.perf_counter()
        process = subprocess.Popen([program, *materials], env=environment, cwd=folder, stderr=subprocess.DEVNULL)
        try:
            first, last = until_still(screen, start)
            if materials:
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
            # Within the picture of the ground truth.
            pane, key = (170, 400), lambda k: subprocess.run(["xdotool", "key", k], env=environment, check=True)
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
