#!/usr/bin/env python3
"""Table 1 of the report, where the time of a picture goes in a window:
reproduce_window.py PROGRAM FOLDER FRAMES"""

import csv
import json
import pathlib
import subprocess
import sys

BODIES = 20000
# Percent of the program's time in the report's table.
REPORT = {"gui": 42.62, "collisions": 37.71, "drawing": 8.65}
PARTS = {"gui": ("gui",), "drawing": ("prepare", "draw", "present"),
         "collisions": ("integrate", "partition", "flatten", "copy_to_device", "resolve",
                        "copy_to_host")}
RUNS = {"impulse, every 10, cuda": ("--law=impulse", "--rebuild=every:10", "--resolver=cuda"),
        "impulse, every 10, sequential": ("--law=impulse", "--rebuild=every:10",
                                          "--resolver=sequential"),
        "continuous, skin, sequential": ("--resolver=sequential",)}
COLUMNS = ("run", "part", "ms", "percent", "report_percent", "renderer")


def measure(program, frames, options):
    """The summary of a run, or why there is none."""
    command = [program, "--offscreen", "--no-fallback", f"--entities={BODIES}", "--profile",
               f"--frames={frames}", "--json=-", *options]
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode:
        return None, run.stderr.strip().splitlines()[-1]
    return json.loads(run.stdout), None


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    program, folder, frames = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
    rows, notes = [], []
    for name, options in RUNS.items():
        print(f"window: {name}", file=sys.stderr)
        summary, reason = measure(program, frames, options)
        if reason:
            notes.append(f"{name}: {reason}")
            rows += [(name, part, "-", "-", REPORT[part], "-") for part in PARTS]
            continue
        phases = summary["phases_ms"]
        parts = {part: sum(phases[p] for p in names) for part, names in PARTS.items()}
        total = sum(parts.values())
        rows += [(name, part, f"{ms:.4g}", f"{100 * ms / total:.4g}", REPORT[part],
                  summary["window"]["renderer"]) for part, ms in parts.items()]
    # The machine is that of the other tables.
    machine = []
    with open(folder / "speedup.csv", encoding="utf-8") as file:
        while not (machine and machine[-1].startswith("date:")):
            machine.append(next(file)[2:].rstrip())
    notes.append(f"balanced, {BODIES} bodies, a step in every picture: table 1 of the report, whose "
                 "percents are of its whole program; ours are of the three parts")
    with open(folder / "window.csv", "w", newline="", encoding="utf-8") as file:
        file.writelines(f"# {line}\n" for line in machine + notes)
        csv.writer(file, lineterminator="\n").writerows([COLUMNS, *rows])
    with open(folder / "window.md", "w", encoding="utf-8") as file:
        file.writelines(f"- {line}\n" for line in machine)
        for row in [None, COLUMNS, ["---"] * len(COLUMNS), *rows]:
            file.write("| " + " | ".join(map(str, row)) + " |\n" if row else "\n")
        file.writelines(f"\n- {line}\n" for line in notes)
    for row in [COLUMNS, *rows]:
        print(*row, sep="  ")
    for note in notes:
        print(f"reproduce: {note}", file=sys.stderr)


if __name__ == "__main__":
    main()
