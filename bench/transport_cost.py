"""What intensity and stokes transport cost beside scalar, in interleaved runs of the program.

    python3 bench/transport_cost.py DRUDE [--rounds N] [--spp N] [--size PIXELS] [--threads N]
        [--scene FILE]...

Every round renders the scene with each transport, one after the other, and takes `render_seconds` of
--json. Printed are the medians of the times and of the ratios to the same round's scalar, with the
smallest and largest ratio; as Markdown. The second pair of ratios is that of the processor's time of
the whole program less that of a run with one sample, which other programs disturb less. The scenes are half-sphere.pbrt in the courtyard and
cornell-metals.pbrt. Pictures go to a folder that is removed. `scalar` is not exact in the box: its
time alone is of interest. Only Python is needed.

Other programs that run at the same time spoil the first pair; interleaving and medians help only
against what changes slowly. The load average is printed with them.
"""

import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile

TRANSPORTS = ("scalar", "intensity", "stokes")
here = os.path.dirname(os.path.abspath(__file__))
SCENES = os.path.join(here, os.pardir, "scenes")


def render(args, scene, environment, transport, folder, spp):
    """Seconds of the loop, and processor seconds of the program."""
    command = [args.drude, "render", scene, "-o", os.path.join(folder, "out.exr"), "--quiet",
               "--json", "--transport", transport, "--spp", str(spp),
               "--threads", str(args.threads), "--resolution", f"{args.size}x{args.size}"]
    if environment:
        command += ["--environment", environment]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if run.returncode != 0:
        sys.exit(f"transport_cost: {' '.join(command)}: {run.stderr.strip()}")
    result = json.loads(run.stdout)
    if result["transport"] != transport:
        sys.exit(f"transport_cost: asked for {transport}, rendered {result['transport']}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return result["render_seconds"], processor


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("drude")
    parser.add_argument("--rounds", type=int, default=11)
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--scene", action="append", help="in place of the two; with its own light")
    parser.add_argument("--environment", default="courtyard", help="of the half-sphere")
    args = parser.parse_args()
    scenes = [(scene, None) for scene in args.scene] if args.scene else [
        (os.path.join(SCENES, "half-sphere.pbrt"), args.environment),
        (os.path.join(SCENES, "cornell-metals.pbrt"), None),
    ]
    print("| scene | scalar, s | intensity, s | stokes, s | intensity / scalar | stokes / scalar "
          "| intensity / scalar, processor | stokes / scalar, processor |")
    print("|---|---|---|---|---|---|---|---|")
    for scene, environment in scenes:
        times = {transport: [] for transport in TRANSPORTS}
        with tempfile.TemporaryDirectory() as folder:
            start = {t: min(render(args, scene, environment, t, folder, 1)[1] for _ in range(3))
                     for t in TRANSPORTS}
            for _ in range(args.rounds):
                for t in TRANSPORTS:
                    loop, processor = render(args, scene, environment, t, folder, args.spp)
                    times[t].append((loop, processor - start[t]))
        cells = [f"{statistics.median(row[0] for row in times[t]):.2f}" for t in TRANSPORTS]
        for clock in (0, 1):
            for t in TRANSPORTS[1:]:
                ratios = [a[clock] / b[clock] for a, b in zip(times[t], times["scalar"])]
                cells.append(
                    f"{statistics.median(ratios):.2f} ({min(ratios):.2f} to {max(ratios):.2f})")
        print(f"| {os.path.basename(scene)} | " + " | ".join(cells) + " |", flush=True)
    load = ", ".join(f"{x:.1f}" for x in os.getloadavg())
    print(f"\n{args.rounds} rounds, {args.size} x {args.size} x {args.spp}, {args.threads} thread(s); "
          f"load average {load} on {os.cpu_count()} processors")


if __name__ == "__main__":
    main()
