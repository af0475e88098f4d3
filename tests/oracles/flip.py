#!/usr/bin/env python3
"""The numbers of tests/image/flip_test.cpp, from the authors' own program.

Needs the package flip-evaluator (NVIDIA, BSD-3-Clause): in a virtual environment outside the
repository, `pip install flip-evaluator numpy`, then run this file with its python. Where the package is
not there it says so and exits with 0.
"""
import sys

try:
    import flip_evaluator
    import numpy as np
except ImportError as error:
    print(f"skipped: {error}; pip install flip-evaluator numpy")
    sys.exit(0)


def pictures(width, height, gain):
    """The test's pictures: waves, an edge, a point; the second shifted, tinted and dimmed."""
    y, x = np.mgrid[0:height, 0:width].astype(np.float64)
    first = np.stack([0.5 + 0.4 * np.sin(0.31 * x + 0.1 * c) * np.cos(0.23 * y - 0.4 * c)
                      for c in range(3)], axis=-1)
    second = np.stack([0.48 + 0.4 * np.sin(0.31 * x + 0.1 * c + 0.15) * np.cos(0.23 * y - 0.4 * c)
                       for c in range(3)], axis=-1)
    second[:, :, 2] *= 0.9
    second[:, width // 2:, :] *= 0.85
    second[height // 3, width // 3, :] = 1.0
    # An HDR picture spans a range of gain.
    scale = gain ** (x / (width - 1.0))
    return (first * scale[:, :, None]).astype(np.float32), \
           (second * scale[:, :, None]).astype(np.float32)


def report(name, kind, reference, test, parameters, is_srgb):
    errors, mean, used = flip_evaluator.evaluate(
        reference, test, kind, inputsRGB=is_srgb, applyMagma=False, parameters=dict(parameters))
    errors = np.asarray(errors).reshape(reference.shape[0], reference.shape[1], -1)[:, :, 0]
    height, width = errors.shape
    print(f"{name}: mean {mean:.7f}, at (w/3, h/3) {errors[height // 3, width // 3]:.7f}, "
          f"at (0, 0) {errors[0, 0]:.7f}, at (w/2, h/2) {errors[height // 2, width // 2]:.7f}; "
          f"{used}")


ldr = [np.clip(p, 0, 1) for p in pictures(48, 32, 1.0)]
report("LDR, 67 pixels a degree", "LDR", ldr[0], ldr[1], {}, False)
report("LDR, 20 pixels a degree", "LDR", ldr[0], ldr[1], {"ppd": 20.0}, False)
hdr = pictures(48, 32, 1000.0)
report("HDR", "HDR", hdr[0], hdr[1], {}, False)
dark = [p.copy() for p in hdr]
for p in dark:
    p[:, :30, :] = 0.0
report("HDR, more than half of it black", "HDR", dark[0], dark[1], {}, False)
