"""S0..S3 of drude and of Mitsuba 3 on the same sphere, box and teapot, wavelength by wavelength.

    python3 -m venv VENV && VENV/bin/pip install mitsuba numpy
    VENV/bin/python bench/peers/mitsuba_agreement.py DRUDE [--variant V] [--scene NAME] [--runs K]
        [--spp N] [--size PIXELS]

DRUDE is the program; variants are scalar_spectral_polarized and llvm_ad_spectral_polarized (the
latter wants libLLVM, see DRJIT_LIBLLVM_PATH). Without mitsuba the script says so and ends with
status 0; with status 1 where the pictures differ.

What is compared. drude renders the layers of --stokes --spectral, means over the ten whole
wavelengths of a 10 nm bin. Mitsuba's `stokes` integrator gives S0..S3 as RGB only: its sensor is
therefore made to respond to one nanometre in the middle of the bin, so that all three channels are
S_i of that wavelength times a number, which a picture of a light of radiance 1 gives; the channel
that responds most is taken. Every spectrum is level across a bin. Thus nothing that has a sign or a
frame is this script's own.

The map between the two, derived before anything was rendered: the world is mirrored
(peer_scenes.py), pictures are not, and no component changes its sign. Both count S1 from the
picture's horizontal, S2 from there towards up as seen in the picture, and S3 > 0 clockwise looking
at the source; Mitsuba's n - ik with phases that advance is the conjugate of n + ik with phases that
retard, and drude takes the conjugate of r_p / r_s.

The test. Both programs render K pictures with seeds of their own. The mean over a tile (8 x 8) has
a variance that is measured between those pictures, in either program; Welch's t, brought to a
normal deviate (Wallace 1959), should have mean 0 and variance 1. Printed beside it: what the same
figures are when a sign is turned or the picture mirrored, and the largest difference of the
picture's mean that the comparison could have missed (|difference| + 2 standard errors, over the
mean of S0).
"""

import argparse
import json
import math
import os
import subprocess
import sys
import tempfile
import time

try:
    import numpy as np
    import mitsuba as mi
except ImportError as missing:
    print(f"skipped: {missing}; see the head of this file")
    sys.exit(0)

from peer_scenes import BINS, STEEL, constant, make_scenes, mitsuba_scene, write_pbrt

TILE = 8


def layer(stokes, first):
    return f"S{stokes}.{first + 4},500000nm"


def read_layers(path):
    """[bin][stokes][y][x] of an EXR of drude."""
    bitmap = mi.Bitmap(path)
    names = [field.name for field in bitmap.struct_()]
    data = np.array(bitmap, dtype=np.float64)
    return np.array(
        [[data[:, :, names.index(layer(s, b))] for s in range(4)] for b in BINS]
    )


def run_drude(program, scene_file, spp, seed, output):
    subprocess.run(
        [program, "render", scene_file, "-o", output, "--stokes", "--spectral", "--quiet",
         "--spp", str(spp), "--seed", str(seed)],
        check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )
    return read_layers(output)


def light_scale(program, folder, spectrum, name):
    """pbrt brings a light's spectrum to luminance 1: the factor, from an empty scene."""
    scene = {"camera": ((0, -1, 0), (0, 0, 0), (0, 0, 1), 40.0), "depth": 1,
             "environment": spectrum, "shapes": []}
    path = write_pbrt(scene, 8, 8, folder, name)
    layers = run_drude(program, path, 160, 1, os.path.join(folder, name + ".exr"))
    values = layers[:, 0].mean((1, 2))
    wavelengths, table = spectrum
    factors = [v / np.interp(b + np.arange(10), wavelengths, table).mean()
               for v, b in zip(values, BINS)]
    assert max(factors) / min(factors) - 1 < 2e-3, factors
    return float(np.mean(factors))


def scaled(scene, scale_of):
    """The scene with its lights as drude has them."""
    def times(spectrum):
        factor = scale_of[json.dumps(spectrum)]
        return spectrum[0], [v * factor for v in spectrum[1]]

    result = dict(scene)
    if scene["environment"] is not None:
        result["environment"] = times(scene["environment"])
    result["shapes"] = [
        {**shape, "light": times(shape["light"])} if "light" in shape else shape
        for shape in scene["shapes"]
    ]
    return result


class MitsubaStokes:
    """S0..S3 at the middle of the bins out of the plugin `stokes`."""

    def __init__(self, scene, folder, name, size):
        # The ball behind the camera is there because a scene has to have a surface.
        unit = {"camera": ((0, -1, 0), (0, 0, 0), (0, 0, 1), 40.0), "depth": 1,
                "environment": constant(1.0),
                "shapes": [{"sphere": ((0, -9, 0), 1.0), "material": STEEL}]}
        self.scenes, self.channels, self.responses = [], [], []
        for first in BINS:
            def load(what, pixels, called):
                return mi.load_dict(mitsuba_scene(mi, what, pixels, pixels, folder, called,
                                                  wavelength=first + 4.5))

            self.scenes.append(load(scene, size, name))
            rgb = self._stokes(load(unit, 16, "unit"), 256, 1)[0].mean((0, 1))
            self.channels.append(int(np.argmax(np.abs(rgb))))
            self.responses.append(rgb[self.channels[-1]])

    @staticmethod
    def _stokes(scene, spp, seed):
        """[stokes][y][x][rgb]"""
        picture = np.array(mi.render(scene, spp=spp, seed=seed), dtype=np.float64)
        assert picture.shape[2] == 15  # R, G, B, then three a component
        return np.moveaxis(picture[:, :, 3:].reshape(*picture.shape[:2], 4, 3), 2, 0)

    def picture(self, spp, seed):
        """[bin][stokes][y][x]"""
        return np.array([
            self._stokes(scene, spp, seed * len(BINS) + i)[..., channel] / response
            for i, (scene, channel, response) in enumerate(
                zip(self.scenes, self.channels, self.responses))
        ])


def tiles(pictures):
    """[run][bin][stokes][y][x] -> means over tiles."""
    k, b, s, h, w = pictures.shape
    return pictures.reshape(k, b, s, h // TILE, TILE, w // TILE, TILE).mean((4, 6))


def deviates(a, b):
    """Welch's t of [run]... arrays as normal deviates; NaN where neither varies."""
    va, vb = a.var(0, ddof=1) / len(a), b.var(0, ddof=1) / len(b)
    variance = va + vb
    with np.errstate(invalid="ignore", divide="ignore"):
        t = (a.mean(0) - b.mean(0)) / np.sqrt(variance)
        freedom = variance**2 / (va**2 / (len(a) - 1) + vb**2 / (len(b) - 1))
        z = np.sign(t) * (8 * freedom + 1) / (8 * freedom + 3) * np.sqrt(
            freedom * np.log1p(t * t / freedom))
    # A difference below what float32 can tell is none (pixels that see a constant light).
    level = np.maximum(np.abs(a.mean(0)), np.abs(b.mean(0)))
    exact = np.sqrt(variance) < 1e-5 * np.maximum(level, a.mean(0)[:, :1])
    return np.where(exact, np.nan, z)


def figures(a, b):
    z = deviates(tiles(a), tiles(b))
    z = z[np.isfinite(z)]
    chi2, n = float((z * z).sum()), z.size
    return {
        "tiles": n,
        "mean_z": float(z.mean()),
        "mean_abs_z": float(np.abs(z).mean()),
        "max_abs_z": float(np.abs(z).max()),
        "chi2": chi2,
        # Wilson and Hilferty's normal deviate of chi2.
        "chi2_deviate": ((chi2 / n) ** (1 / 3) - (1 - 2 / (9 * n))) / math.sqrt(2 / (9 * n)),
    }


def bias_bounds(a, b):
    """Of S0..S3, over the mean of S0, per cent; all bins together."""
    mean_a, mean_b = a.mean((3, 4)), b.mean((3, 4))  # [run][bin][stokes]
    level = mean_a[:, :, 0].mean(0)
    difference = ((mean_a.mean(0) - mean_b.mean(0)) / level[:, None]).mean(0)
    error = np.sqrt(
        (((mean_a / level[:, None]).mean(1)).var(0, ddof=1)) / len(a)
        + (((mean_b / level[:, None]).mean(1)).var(0, ddof=1)) / len(b)
    )
    return [100 * float(abs(d) + 2 * e) for d, e in zip(difference, error)]


def compare(args, name, scene):
    with tempfile.TemporaryDirectory() as folder:
        spectra = [scene["environment"]] + [s.get("light") for s in scene["shapes"]]
        scale_of = {}
        for i, spectrum in enumerate(s for s in spectra if s is not None):
            key = json.dumps(spectrum)
            if key not in scale_of:
                scale_of[key] = light_scale(args.drude, folder, spectrum, f"light{i}")
        path = write_pbrt(scene, args.size, args.size, folder, name)
        output = os.path.join(folder, "picture.exr")
        ours = np.array(
            [run_drude(args.drude, path, args.spp, 1000 + k, output) for k in range(args.runs)]
        )
        peer = MitsubaStokes(scaled(scene, scale_of), folder, name, args.size)
        start = time.time()
        theirs = np.array([peer.picture(args.peer_spp, 1 + k) for k in range(args.runs)])
        seconds = time.time() - start
    if not (np.isfinite(ours).all() and np.isfinite(theirs).all()):
        print(f"{name}: not every pixel is finite")
        return False
    if args.save:
        np.savez(f"{args.save}-{name}-{mi.variant()}.npz", ours=ours, theirs=theirs)
    f = figures(ours, theirs)
    # With thousands of tiles the largest of n normal deviates passes this once in a hundred times.
    limit = math.sqrt(2 * math.log(f["tiles"] / 0.01))
    agree = f["max_abs_z"] < limit and abs(f["chi2_deviate"]) < 4
    print(
        f"| {name} | {mi.variant()} | {f['tiles']} | {f['mean_z']:+.3f} | {f['mean_abs_z']:.3f} "
        f"| {f['max_abs_z']:.2f} of {limit:.2f} | {f['chi2'] / f['tiles']:.3f} "
        f"| {f['chi2_deviate']:+.2f} | "
        + ", ".join(f"{b:.3f}" for b in bias_bounds(ours, theirs))
        + f" | {'agree' if agree else 'DIFFER'} |"
    )
    mean = ours.mean(0)
    spread = [float(np.abs(mean[:, s]).mean() / mean[:, 0].mean()) for s in range(4)]
    controls = {
        "S1 turned": theirs * np.array([1, -1, 1, 1])[:, None, None],
        "S2 turned": theirs * np.array([1, 1, -1, 1])[:, None, None],
        "S3 turned": theirs * np.array([1, 1, 1, -1])[:, None, None],
        "picture mirrored": theirs[..., ::-1],
    }
    print(
        f"  mean |S1..3| over S0: {spread[1]:.3f}, {spread[2]:.3f}, {spread[3]:.3f}; "
        f"chi2 a tile if "
        + ", ".join(
            f"{what}: {figures(ours, wrong)['chi2'] / f['tiles']:.0f}"
            for what, wrong in controls.items()
        )
        + f"; {seconds:.0f} s in Mitsuba",
        file=sys.stderr,
    )
    sys.stdout.flush()
    return agree


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("drude")
    parser.add_argument("--variant", default="llvm_ad_spectral_polarized")
    parser.add_argument("--scene", action="append", choices=sorted(make_scenes()))
    parser.add_argument("--runs", type=int, default=16, help="pictures of either program")
    parser.add_argument("--spp", type=int, default=64, help="samples a pixel and picture of drude")
    parser.add_argument("--peer-spp", type=int, default=64, help="the same of Mitsuba, a bin")
    parser.add_argument("--size", type=int, default=64)
    parser.add_argument("--save", help="keep the pictures as SAVE-SCENE-VARIANT.npz")
    args = parser.parse_args()
    if args.size % TILE:
        sys.exit(f"--size must be a multiple of {TILE}")
    try:
        mi.set_variant(args.variant)
        if args.variant.startswith("llvm"):
            import drjit as dr

            dr.eval(dr.arange(mi.Float, 4))
    except Exception as error:  # an ImportError of the variant, or drjit without libLLVM
        print(f"skipped: {args.variant}: {error}")
        return 0
    print("| scene | variant | tiles | mean z | mean abs z | max abs z | chi2 / tiles "
          "| deviate of chi2 | bias of S0..S3 below, % of S0 | |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    fine = True
    for name, scene in make_scenes().items():
        if args.scene is None or name in args.scene:
            fine = compare(args, name, scene) and fine
    return 0 if fine else 1


if __name__ == "__main__":
    sys.exit(main())
