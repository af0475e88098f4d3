"""1 / (time x mean squared error) of drude beside Mitsuba 3: a copper half-sphere under a picture.

    VENV/bin/python bench/peers/mitsuba_efficiency.py DRUDE ENVIRONMENT [--alpha A] [--rounds N]
        [--size PIXELS] [--spp N] [--variant V]... [--sampler S] [--csv FILE]

ENVIRONMENT is a lat-long EXR; both programs get it in grey (its luminance), turned the same way.
The half-sphere is one mesh of triangles with normals, n and k the tables of peer_scenes.py, the
film box filtered S0..S3 in RGB (`--stokes` here, the integrator `stokes` there). --alpha 0 (the
default) is a mirror; any other is a Trowbridge-Reitz (GGX) alpha, with the two programs' own
masking functions.

Every round renders once with each program, one after the other, with its own seed. The error is
that of S0 (and of S1..S3 together) against the same program's own reference of many more samples,
mean of squares over pixels and R, G, B, over the square of the reference's mean S0. Times are those
of the rendering loop alone, by the wall: drude's `render_seconds`, and Mitsuba's mi.render of a
scene that is loaded and, in the llvm variant, compiled already. Medians over the rounds; above 1 is
better for drude. Ends with status 0 where mitsuba is missing.

--csv writes the points of two charts for `drude bench --with FILE`, error (root of the mean square)
of S0 and of S1..S3 against seconds, with a sixteenth, a quarter and all of --spp samples a pixel.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

try:
    import mitsuba as mi
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}; see the head of mitsuba_agreement.py")
    sys.exit(0)

from chart_rows import row, write_rows
from peer_scenes import ETA_TABLE, K_TABLE, half_sphere, mitsuba_scene, write_pbrt


def make_scene(environment):
    points, triangles = half_sphere(64, 256)
    return {
        "camera": ((0.0, -3.4, 0.3), (0.0, 0.0, 0.42), (0.0, 0.0, 1.0), 40.0),
        "depth": 10,
        "environment": environment,
        "shapes": [
            {
                "mesh": (points, triangles),
                "normals": points,  # of the unit sphere
                "material": {"type": "conductor", "eta": ETA_TABLE, "k": K_TABLE},
            }
        ],
    }


def grey(path, output):
    """float32 R = G = B = luminance."""
    picture = np.array(mi.Bitmap(path).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32))
    luminance = picture @ np.array([0.212671, 0.715160, 0.072169], dtype=np.float32)
    mi.Bitmap(np.repeat(luminance[:, :, None], 3, axis=2)).write(output)


class Drude:
    def __init__(self, program, folder, grey_picture, args):
        self.program, self.folder = program, folder
        self.scene = write_pbrt(make_scene(grey_picture), args.size, args.size, folder, "half")
        with open(self.scene, encoding="utf-8") as file:
            text = file.read()
        if args.alpha > 0:
            # pbrt's own words for an alpha, which is Trowbridge-Reitz with Smith's masking.
            text = text.replace('Material "conductor"', 'Material "conductor" "float roughness" '
                                f'{args.alpha} "bool remaproughness" false')
            with open(self.scene, "w", encoding="utf-8") as file:
                file.write(text)

    def render(self, spp, seed):
        """Seconds, and [stokes][y][x][rgb]."""
        output = os.path.join(self.folder, "drude.exr")
        run = subprocess.run(
            [self.program, "render", self.scene, "-o", output, "--stokes", "--quiet", "--json",
             "--spp", str(spp), "--seed", str(seed)],
            check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
        )
        bitmap = mi.Bitmap(output)
        names = [field.name for field in bitmap.struct_()]
        data = np.array(bitmap, dtype=np.float64)
        picture = np.array([[data[:, :, names.index(f"S{s}.{c}")] for c in "RGB"]
                            for s in range(4)])
        return json.loads(run.stdout)["render_seconds"], np.moveaxis(picture, 1, 3)


class Mitsuba:
    """Of the variant that is set."""

    def __init__(self, folder, grey_picture, args):
        # Its pictures lie around y; ours around z, column 0 towards +x of the pbrt world.
        to_world = mi.ScalarTransform4f(
            np.array([[0, 0, 1, 0], [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1.0]]))
        light = {"type": "envmap", "filename": grey_picture, "to_world": to_world}
        description = mitsuba_scene(mi, make_scene(None), args.size, args.size, folder, "half",
                                    environment_light=light,
                                    samples=args.spp, sampler=args.sampler)
        if args.alpha > 0:
            bsdf = description["shape0"]["bsdf"]
            bsdf.update(type="roughconductor", distribution="ggx", alpha=args.alpha)
        self.scene = mi.load_dict(description)

    def render(self, spp, seed):
        start = time.perf_counter()
        tensor = mi.render(self.scene, spp=spp, seed=seed)
        picture = np.array(tensor, dtype=np.float64)  # waits for the result
        seconds = time.perf_counter() - start
        return seconds, np.moveaxis(picture[:, :, 3:].reshape(*picture.shape[:2], 4, 3), 2, 0)


def reference(renderer, spp, passes, first_seed):
    return sum(renderer.render(spp, first_seed + i)[1] for i in range(passes)) / passes


def errors(picture, truth):
    """Of S0, and of S1..S3."""
    square = ((picture - truth) / truth[0].mean()) ** 2
    return square[0].mean(), square[1:].sum(0).mean()


def measure_points(counts, args, *programs):
    """Rows of each program's curve, all rendered in turn."""
    surface = "mirror" if args.alpha == 0 else f"ggx-{args.alpha:g}".replace(".", "-")
    curves = [[] for _ in programs]
    for spp in counts:
        figures = [[] for _ in programs]
        for k in range(args.rounds + 1):
            for mine, (_, renderer, known) in zip(figures, programs):
                seconds, picture = renderer.render(spp, 1 + k)
                if k > 0:  # the first compiles for this number of samples
                    mine.append((seconds, *errors(picture, known)))
        for curve, mine, (name, _, _) in zip(curves, figures, programs):
            method = name if name == "drude" else f"Mitsuba {name}, {args.sampler}"
            for i, part in ((1, "s0"), (2, "s123")):
                curve.append(row(
                    f"peers-{surface}-{part}", method, f"{spp} spp", [f[0] for f in mine],
                    [f[i] ** 0.5 for f in mine],
                    f"{args.size} x {args.size} pixels, all processors, by the wall"))
    return curves


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("drude")
    parser.add_argument("environment")
    parser.add_argument("--alpha", type=float, default=0)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--reference-passes", type=int, default=64, help="of --spp samples each")
    parser.add_argument("--variant", action="append")
    parser.add_argument("--sampler", default="independent", help="of Mitsuba (its default)")
    parser.add_argument("--csv", help="points for drude bench --with")
    args = parser.parse_args()
    variants = args.variant or ["llvm_ad_spectral_polarized", "scalar_spectral_polarized"]

    counts = sorted({max(1, args.spp // 16), max(1, args.spp // 4), args.spp})
    rows, points, own = {}, [], []
    with tempfile.TemporaryDirectory() as folder:
        mi.set_variant("llvm_ad_spectral_polarized")
        grey_picture = os.path.join(folder, "grey.exr")
        grey(args.environment, grey_picture)
        drude = Drude(args.drude, folder, grey_picture, args)
        truth = reference(drude, args.spp * args.reference_passes, 1, 10_000)
        peer_truth = None
        for variant in variants:
            try:
                mi.set_variant(variant)
                mitsuba = Mitsuba(folder, grey_picture, args)
                mitsuba.render(args.spp, 99)  # compiles, and fills caches
            except Exception as error:
                print(f"skipped: {variant}: {error}", file=sys.stderr)
                continue
            if peer_truth is None:  # both variants converge to the same picture
                peer_truth = reference(mitsuba, args.spp, args.reference_passes, 10_000)
                for name, s in zip(("S0", "S1", "S2", "S3"), range(4)):
                    a, b = truth[s] / truth[0].mean(), peer_truth[s] / peer_truth[0].mean()
                    print(f"{name}: root mean square of the two references' difference "
                          f"{np.sqrt(((a - b) ** 2).mean()):.1e} of mean S0, of the signal "
                          f"{np.sqrt((a ** 2).mean()):.1e}", file=sys.stderr)
            figures = {"drude": [], variant: []}
            for k in range(args.rounds):
                for name, renderer, known in (("drude", drude, truth),
                                              (variant, mitsuba, peer_truth)):
                    seconds, picture = renderer.render(args.spp, 1 + k)
                    figures[name].append((seconds, *errors(picture, known)))
            rows[variant] = figures
            if args.csv:
                own_points, peer_points = measure_points(
                    counts, args, ("drude", drude, truth), (variant, mitsuba, peer_truth))
                own = own or own_points  # those beside the first variant
                points += peer_points
    print("| against | alpha | drude, s | its MSE of S0, S1..3 | Mitsuba, s | its MSE of S0, S1..3 "
          "| efficiency S0 | S1..3 |")
    print("|---|---|---|---|---|---|---|---|")
    for variant, figures in rows.items():
        ours, theirs = figures["drude"], figures[variant]

        def median(values, i):
            return statistics.median(row[i] for row in values)

        gain = [
            statistics.median((b[0] * b[i]) / (a[0] * a[i]) for a, b in zip(ours, theirs))
            for i in (1, 2)
        ]
        print(f"| {variant}, {args.sampler} | {args.alpha} | {median(ours, 0):.2f} "
              f"| {median(ours, 1):.2e}, {median(ours, 2):.2e} | {median(theirs, 0):.2f} "
              f"| {median(theirs, 1):.2e}, {median(theirs, 2):.2e} "
              f"| {gain[0]:.1f} | {gain[1]:.1f} |")
    if args.csv:
        write_rows(args.csv, own + points)


if __name__ == "__main__":
    main()
