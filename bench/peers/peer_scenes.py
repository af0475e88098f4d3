"""Scenes that drude and Mitsuba 3 both render: written once, handed to either in its own words.

A pbrt world is left-handed, Mitsuba's right-handed. The same things in space are described by
coordinates that differ by a mirror, here x -> -x: points, directions and cameras are mirrored, the
winding of triangles is turned round (a cross product of mirrored edges is minus the mirrored cross
product), and the two pictures then show the same thing without any mirroring of pictures.
"""

import os
import struct
import sys

here = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(here, os.pardir, os.pardir, "scenes"))

# What is compared are four wavelength bins of 10 nm. Every table is level across each of them, so
# that it does not matter how either program spreads its wavelengths within a bin, and covers both
# films (Mitsuba 360 to 830 nm, drude 380 to 780 nm), so that what either does outside a table never
# matters. The numbers are made up: copper-like, steep at 580 nm.
BINS = [450, 550, 600, 650]  # first wavelength of each


def level_across_bins(first, values, last):
    """A table (wavelengths, values) through `values` in the bins; ends at 360 and 830 nm."""
    wavelengths, table = [360], [first]
    for start, value in zip(BINS, values):
        wavelengths += [start - 2, start + 12]
        table += [value, value]
    return wavelengths + [830], table + [last]


def constant(value):
    return ([360, 830], [value, value])


ETA_TABLE = level_across_bins(1.27, [1.17, 1.04, 0.36, 0.24], 0.26)
K_TABLE = level_across_bins(1.95, [2.39, 2.59, 3.1, 3.7], 5.3)
WARM = level_across_bins(0.4, [0.7, 1.1, 1.3, 1.5], 2.2)


def quad(a, b, c, d):
    """Two triangles; the side from which a, b, c, d run counter-clockwise in a right-handed drawing
    of the numbers is the front in both programs."""
    return [a, b, c, d], [(0, 1, 2), (0, 2, 3)]


def teapot(steps, scale, height):
    """Flat facets: what a renderer does where shading and geometric normals differ is no matter of
    polarisation. The gap round the lid and the spout's mouth are closed: one sees the back of the
    metal through them, which reflects in drude and is black in Mitsuba."""
    import math

    from make_teapot import mesh

    vertices, triangles = mesh(steps)
    points = [v[:3] for v in vertices]
    # A ring from lid (1.3) to rim (1.4) just below their edges, facing up.
    around, z = 48, 2.395
    for k in range(around):
        for r in (1.25, 1.45):
            phi = 2 * math.pi * k / around
            points.append((r * math.cos(phi), r * math.sin(phi), z))
    for k in range(around):
        a, b = len(vertices) + 2 * k, len(vertices) + 2 * ((k + 1) % around)
        triangles += [(a, a + 1, b + 1), (a, b + 1, b)]
    # The mouth (x from 2.8 to 3.2), within the spout's wall.
    first = len(points)
    points += [(2.74, -0.1, 2.395), (3.26, -0.1, 2.395), (3.26, 0.1, 2.395), (2.74, 0.1, 2.395)]
    points += [(2.82, -0.15, 2.395), (3.18, -0.15, 2.395), (3.18, 0.15, 2.395), (2.82, 0.15, 2.395)]
    triangles += [
        (first, first + 1, first + 2), (first, first + 2, first + 3),
        (first + 4, first + 5, first + 6), (first + 4, first + 6, first + 7),
    ]
    return [(scale * x, scale * y, scale * z + height) for x, y, z in points], triangles


def half_sphere(rings, around):
    """Radius 1, z >= 0, vertices with normals (as the analytic half-sphere, in triangles)."""
    import math

    points, triangles = [(0.0, 0.0, 1.0)], []
    for i in range(1, rings + 1):
        theta = math.pi / 2 * i / rings
        for j in range(around):
            phi = 2 * math.pi * j / around
            z = 0.0 if i == rings else math.cos(theta)
            points.append((math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), z))
    for j in range(around):
        k = (j + 1) % around
        triangles.append((0, 1 + j, 1 + k))
        for i in range(rings - 1):
            a, b = 1 + i * around + j, 1 + i * around + k
            triangles += [(a, a + around, b + around), (a, b + around, b)]
    return points, triangles


def conductor(eta, k):
    return {"type": "conductor", "eta": eta, "k": k}


STEEL = conductor(constant(2.6), constant(3.4))
SILVER = conductor(constant(0.15), constant(3.3))
COPPER = conductor(ETA_TABLE, K_TABLE)
GREY = {"type": "diffuse", "reflectance": constant(0.6)}


def make_scenes():
    """name -> camera, size, depth (reflections), environment (spectrum or None), shapes."""
    scenes = {}
    scenes["sphere"] = {
        "camera": ((0.6, -6.0, 1.6), (0.1, 0.0, 0.7), (0.25, 0.1, 1.0), 36.0),
        "depth": 8,
        "environment": constant(1.0),
        "shapes": [
            {"sphere": ((-1.0, 0.0, 1.0), 1.0), "material": COPPER},
            {"sphere": ((1.2, 0.6, 0.8), 0.8), "material": STEEL},
            {
                "mesh": quad((-9, -9, 0), (9, -9, 0), (9, 9, 0), (-9, 9, 0)),
                "material": SILVER,
            },
        ],
    }
    scenes["box"] = {
        "camera": ((0.1, -0.95, 1.05), (0.0, 1.0, 0.85), (0.1, 0.0, 1.0), 70.0),
        "depth": 12,
        "environment": None,
        "shapes": [
            {"mesh": quad((-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)), "material": STEEL},
            {"mesh": quad((-1, -1, 2), (-1, 1, 2), (1, 1, 2), (1, -1, 2)), "material": SILVER},
            {"mesh": quad((1, -1, 0), (1, -1, 2), (1, 1, 2), (1, 1, 0)), "material": COPPER},
            {"mesh": quad((-1, -1, 0), (-1, 1, 0), (-1, 1, 2), (-1, -1, 2)), "material": SILVER},
            {"mesh": quad((-1, 1, 0), (1, 1, 0), (1, 1, 2), (-1, 1, 2)), "material": STEEL},
            {"mesh": quad((-1, -1, 0), (-1, -1, 2), (1, -1, 2), (1, -1, 0)), "material": COPPER},
            {
                "mesh": quad(
                    (-0.7, -0.6, 1.98), (-0.7, 0.7, 1.98), (0.5, 0.7, 1.98), (0.5, -0.6, 1.98)
                ),
                "light": WARM,
            },
            {
                "mesh": quad(
                    (0.98, -0.4, 0.2), (0.98, -0.4, 1.2), (0.98, 0.5, 1.2), (0.98, 0.5, 0.2)
                ),
                "light": constant(1.0),
            },
            {"sphere": ((0.35, 0.35, 0.4), 0.4), "material": COPPER},
            {"sphere": ((-0.45, 0.1, 0.3), 0.3), "material": GREY},
        ],
    }
    scenes["teapot"] = {
        # Below the rim, so that the gap round the lid, where Mitsuba's one-sided metal has no
        # front, is never seen.
        "camera": ((1.5, -8.0, 1.3), (0.3, 0.0, 1.35), (0.1, 0.0, 1.0), 42.0),
        "depth": 10,
        "environment": constant(0.3),
        "shapes": [
            {"mesh": teapot(6, 1.0, 0.05), "material": COPPER},
            {
                "mesh": quad((-9, -9, 0), (9, -9, 0), (9, 9, 0), (-9, 9, 0)),
                "material": STEEL,
            },
            {
                "mesh": quad((-6, -6, 1), (-6, 4, 1), (-6, 4, 6), (-6, -6, 6)),
                "light": WARM,
            },
        ],
    }
    return scenes


# ---- pbrt --------------------------------------------------------------------------------------


def pbrt_spectrum(spectrum):
    return "[ " + " ".join(f"{w} {v}" for w, v in zip(*spectrum)) + " ]"


def numbers(values):
    return " ".join(repr(float(v)) for v in values)


def write_pbrt(scene, width, height, folder, name):
    """Returns the path of the scene file."""
    origin, target, up, fov = scene["camera"]
    lines = [
        f"LookAt {numbers(origin)}  {numbers(target)}  {numbers(up)}",
        f'Camera "perspective" "float fov" {fov!r}',
        f'Film "rgb" "integer xresolution" {width} "integer yresolution" {height}',
        'PixelFilter "box"',
        f'Integrator "path" "integer maxdepth" {scene["depth"]}',
        "WorldBegin",
    ]
    environment = scene["environment"]
    if isinstance(environment, str):
        lines.append(f'LightSource "infinite" "string filename" "{environment}"')
    elif environment is not None:
        lines.append(f'LightSource "infinite" "spectrum L" {pbrt_spectrum(environment)}')
    for i, shape in enumerate(scene["shapes"]):
        lines.append("AttributeBegin")
        if "light" in shape:
            lines.append(f'AreaLightSource "diffuse" "spectrum L" {pbrt_spectrum(shape["light"])}')
            lines.append('Material "diffuse" "rgb reflectance" [ 0 0 0 ]')
        else:
            words = [f'Material "{shape["material"]["type"]}"']
            for key, spectrum in shape["material"].items():
                if key != "type":
                    words.append(f'"spectrum {key}" {pbrt_spectrum(spectrum)}')
            lines.append(" ".join(words))
        if "sphere" in shape:
            centre, radius = shape["sphere"]
            lines.append(f"Translate {numbers(centre)}")
            lines.append(f'Shape "sphere" "float radius" {radius!r}')
        else:
            points, triangles = shape["mesh"]
            write_mesh(os.path.join(folder, f"{name}-{i}.ply"), points, triangles,
                       shape.get("normals"))
            lines.append(f'Shape "plymesh" "string filename" "{name}-{i}.ply"')
        lines.append("AttributeEnd")
    path = os.path.join(folder, f"{name}.pbrt")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    return path


def write_mesh(path, points, triangles, normals=None):
    names = ("x", "y", "z") + (("nx", "ny", "nz") if normals else ())
    rows = [tuple(p) + tuple(n) for p, n in zip(points, normals)] if normals else points
    with open(path, "wb") as file:
        file.write(
            (
                f"ply\nformat binary_little_endian 1.0\nelement vertex {len(rows)}\n"
                + "".join(f"property float {n}\n" for n in names)
                + f"element face {len(triangles)}\n"
                "property list uchar int vertex_indices\nend_header\n"
            ).encode("ascii")
        )
        for row in rows:
            file.write(struct.pack(f"<{len(names)}f", *row))
        for triangle in triangles:
            file.write(struct.pack("<B3i", 3, *triangle))


# ---- Mitsuba -----------------------------------------------------------------------------------


def mirrored(v):
    return [-float(v[0]), float(v[1]), float(v[2])]


def mitsuba_spectrum(spectrum):
    wavelengths, values = spectrum
    if len(set(values)) == 1:
        return {"type": "uniform", "value": float(values[0])}
    return {
        "type": "irregular",
        "wavelengths": ", ".join(str(w) for w in wavelengths),
        "values": ", ".join(str(v) for v in values),
    }


def mitsuba_scene(mi, scene, width, height, folder, name, samples=1, environment_light=None,
                  wavelength=None, sampler="independent"):
    """A dictionary for mi.load_dict, Stokes integrator included.

    With `wavelength` the sensor responds to that one alone, give or take half a nanometre.
    """
    origin, target, up, fov = scene["camera"]
    result = {
        "type": "scene",
        "integrator": {
            "type": "stokes",
            # Mitsuba counts edges: emission alone is 1, one reflection 2.
            "nested": {"type": "path", "max_depth": scene["depth"] + 1},
        },
        "sensor": {
            "type": "perspective",
            "fov": fov,
            "to_world": mi.ScalarTransform4f().look_at(
                origin=mirrored(origin), target=mirrored(target), up=mirrored(up)
            ),
            "sampler": {"type": sampler, "sample_count": samples},
            "film": {
                "type": "hdrfilm",
                "width": width,
                "height": height,
                "pixel_format": "rgb",
                "component_format": "float32",
                "rfilter": {"type": "box"},
            },
        },
    }
    if wavelength is not None:
        result["sensor"]["srf"] = {
            "type": "regular",
            "wavelength_min": wavelength - 0.5,
            "wavelength_max": wavelength + 0.5,
            "values": "1, 1",
        }
    if environment_light is not None:
        result["environment"] = environment_light
    elif scene["environment"] is not None:
        result["environment"] = {
            "type": "constant",
            "radiance": mitsuba_spectrum(scene["environment"]),
        }
    for i, shape in enumerate(scene["shapes"]):
        if "sphere" in shape:
            centre, radius = shape["sphere"]
            item = {"type": "sphere", "center": mirrored(centre), "radius": radius}
        else:
            points, triangles = shape["mesh"]
            path = os.path.join(folder, f"{name}-{i}-mirrored.ply")
            normals = shape.get("normals")
            write_mesh(
                path,
                [mirrored(p) for p in points],
                [t[::-1] for t in triangles],
                [mirrored(n) for n in normals] if normals else None,
            )
            item = {"type": "ply", "filename": path, "face_normals": normals is None}
        if "light" in shape:
            item["emitter"] = {"type": "area", "radiance": mitsuba_spectrum(shape["light"])}
            item["bsdf"] = {"type": "diffuse", "reflectance": {"type": "uniform", "value": 0.0}}
        else:
            material = shape["material"]
            item["bsdf"] = {"type": material["type"]}
            for key, spectrum in material.items():
                if key != "type":
                    item["bsdf"][key] = mitsuba_spectrum(spectrum)
        result[f"shape{i}"] = item
    return result
