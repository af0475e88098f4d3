#!/usr/bin/env python3
"""What films cost: checkpoints, memory, pixels and samples, threads against processes.

bench/film.py [DRUDE] [--environment FILE]: prints the tables of bench/results/film.md. Ratios are
of runs that take turns on one machine; times are the program's own render_seconds.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def start(drude, folder, name, options):
    command = [drude, "render", os.path.join(ROOT, "scenes/half-sphere.pbrt"), "--json", "-q",
               "-o", os.path.join(folder, name)] + options
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)


def finish(process):
    """The run's JSON and its peak memory in MB (10^6 bytes)."""
    out = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"drude ended with {process.returncode}")
    return json.loads(out), usage.ru_maxrss * 1024 / 1e6


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("drude", nargs="?", default=os.path.join(ROOT, "build/drude"))
    parser.add_argument("--environment", default="courtyard")
    parser.add_argument("--turns", type=int, default=5)
    arguments = parser.parse_args()
    sky = ["--environment", arguments.environment]
    with tempfile.TemporaryDirectory(dir=os.getcwd()) as folder:
        def run(options, name="a.exr"):
            return finish(start(arguments.drude, folder, name, sky + options))

        print("peak memory, 1024x1024 --stokes, 2 threads\n samples    MB")
        for samples in (2, 16, 64):
            print(f"{samples:8} {run(['--resolution', '1024x1024', '--stokes', '--spp', str(samples)])[1]:5.0f}",
                  flush=True)

        print("\ncheckpoints of 1024x1024 --stokes, one every 4 s")
        result, _ = run(["--resolution", "1024x1024", "--stokes", "--spp", "128", "--checkpoint", "4"])
        if result["checkpoints"]:
            each = result["checkpoint_seconds"] / result["checkpoints"]
            print(f"{result['checkpoints']} of {each:.2f} s each; by default one in "
                  f"{max(60, 180 * each):.0f} s: {100 * each / max(60, 180 * each):.2f} % of the time")

        print("\ntime against pixels x samples, one thread, median of turns\n"
              "     size  samples  ns a sample")
        for size in (128, 256, 512):
            for samples in (16, 64):
                options = ["--resolution", f"{size}x{size}", "--spp", str(samples), "--threads", "1"]
                times = [run(options)[0]["render_seconds"] for _ in range(arguments.turns)]
                each = statistics.median(times) / (size * size * samples)
                print(f"{size:4}x{size:4} {samples:8} {1e9 * each:12.0f}", flush=True)

        print("\ntwo threads against two processes of one thread, 512x512x64, taking turns\n"
              "   Msamples/s of two threads, of two processes, ratio")
        options = ["--resolution", "512x512", "--spp", "64"]
        work = 512 * 512 * 64 / 1e6
        ratios = []
        for _ in range(arguments.turns):
            threads = work / run(options + ["--threads", "2"])[0]["render_seconds"]
            pair = [start(arguments.drude, folder, f"{i}.exr", sky + options + ["--threads", "1"])
                    for i in range(2)]
            processes = sum(work / finish(one)[0]["render_seconds"] for one in pair)
            ratios.append(threads / processes)
            print(f"{threads:15.2f} {processes:18.2f} {ratios[-1]:10.3f}", flush=True)
        print(f"median ratio {statistics.median(ratios):.3f}")


if __name__ == "__main__":
    main()
