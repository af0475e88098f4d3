"""The fits of bench/fit_speed.cpp beside pyElli and lmfit: same data, same models, same weights.

    python3 -m venv VENV && VENV/bin/pip install pyElli packaging lmfit
    VENV/bin/python bench/peers/fit_peers.py BUILD_FOLDER [ROUNDS] [--csv FILE]

Every round times each fit once, one after the other, in processes that have read everything before;
drude's own time is the one that fit_speed takes inside. All run on one thread and are timed by the
processor's clock, so that what else the machine does is left out. Printed are the medians over the rounds, as
Markdown, with how far the answers are apart. Where pyElli or lmfit is missing the script says so and
ends with status 0.

--csv writes points for `drude bench --with FILE`: into the chart "fit-time" the fits of n and k of
the five metals, on the same measurements as drude's own points there (BUILD_FOLDER/drude makes
them), and "peers-film", the film's thickness.
"""

import argparse
import json
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

try:
    import elli
    import lmfit
    import numpy as np
    import scipy
except ImportError as missing:
    print(f"skipped: {missing}; see the head of this file")
    sys.exit(0)

from importlib.metadata import version

from chart_rows import row, write_rows


def read_measurement(path):
    """Rows of the project's CSV by wavelength: {nm: array of (angle, psi, delta, sigmas)}."""
    groups = {}
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.startswith("#") or line.startswith("wavelength"):
                continue
            row = [float(word) for word in line.split(",")]
            groups.setdefault(row[0], []).append(row[1:6])
    return {nm: np.array(rows) for nm, rows in groups.items()}


def residuals(psi, delta, rows):
    turn = (delta - rows[:, 2] + 180.0) % 360.0 - 180.0
    return np.concatenate([(psi - rows[:, 1]) / rows[:, 3], turn / rows[:, 4]])


def start_of(rows):
    """n and k in closed form at 70 degrees: the start of both programs' bulk fits."""
    angle, psi, delta = rows[np.argmin(np.abs(rows[:, 0] - 70.0)), :3]
    theta = np.radians(angle)
    r = np.tan(np.radians(psi)) * np.exp(-1j * np.radians(delta))
    epsilon = np.sin(theta) ** 2 * (1 + np.tan(theta) ** 2 * ((1 - r) / (1 + r)) ** 2)
    index = np.sqrt(epsilon)
    return index.real, abs(index.imag)


def elli_angles(structure, nm, angles):
    psi, delta = [], []
    for angle in angles:
        result = structure.evaluate(nm, angle, solver=elli.Solver2x2)
        psi.append(result.psi)
        delta.append(result.delta)
    return np.concatenate(psi), np.concatenate(delta)


def numpy_angles(index, angles):
    cosine = np.cos(np.radians(angles))
    below = np.sqrt(index**2 - (1 - cosine**2))
    r_s = (cosine - below) / (cosine + below)
    r_p = (index**2 * cosine - below) / (index**2 * cosine + below)
    rho = np.conj(r_p / r_s)
    return np.degrees(np.arctan(np.abs(rho))), np.degrees(np.angle(rho))


def bulk(model):
    """A function that fits every wavelength by itself with `model`(n, k, nm, angles)."""

    def fit(groups):
        found = []
        for nm, rows in groups.items():
            n, k = start_of(rows)
            parameters = lmfit.Parameters()
            parameters.add("n", value=n, min=1e-6)
            parameters.add("k", value=k, min=0.0)

            def difference(p, nm=nm, rows=rows):
                psi, delta = model(p["n"].value, p["k"].value, nm, rows[:, 0])
                return residuals(psi, delta, rows)

            result = lmfit.minimize(difference, parameters, scale_covar=False)
            found.append([result.params["n"].value, result.params["k"].value,
                          result.params["n"].stderr, result.params["k"].stderr])
        return np.array(found)

    return fit


def bulk_elli(n, k, nm, angles):
    material = elli.IsotropicMaterial(elli.dispersions.ConstantRefractiveIndex(n=n + 1j * k))
    return elli_angles(elli.Structure(elli.AIR, [], material), np.array([nm]), angles)


def bulk_numpy(n, k, nm, angles):
    del nm
    return numpy_angles(n + 1j * k, angles)


class Film:
    """Porous alumina on aluminium, all wavelengths together."""

    def __init__(self, folder, groups):
        table = np.loadtxt(os.path.join(folder, "film_constants.csv"), delimiter=",", skiprows=1)
        self.nm = table[:, 0]
        self.dense = table[:, 1] + 1j * table[:, 2]
        self.below = table[:, 3] + 1j * table[:, 4]
        stack = np.array([groups[nm] for nm in self.nm])  # wavelength, angle, column
        self.angles = stack[0, :, 0]
        self.rows = np.concatenate([stack[:, i, :] for i in range(len(self.angles))])
        as_material = lambda n: elli.IsotropicMaterial(elli.dispersions.Table(lbda=self.nm, n=n))
        self.alumina = as_material(self.dense)
        self.aluminium = as_material(self.below)

    def elli(self, thickness, porosity):
        mixture = elli.BruggemanEMA(self.alumina, elli.AIR, porosity)
        layer = elli.Layer(mixture, thickness)
        return elli_angles(elli.Structure(elli.AIR, [layer], self.aluminium), self.nm, self.angles)

    def numpy(self, thickness, porosity):
        a, b = self.dense**2, 1.0
        middle = (2 - 3 * porosity) * a + (3 * porosity - 1) * b
        film = (middle + np.sqrt(middle**2 + 8 * a * b)) / 4
        below = self.below**2
        psi, delta = [], []
        for angle in self.angles:
            cosine = np.cos(np.radians(angle))
            u = 1 - cosine**2
            q1, q2 = np.sqrt(film - u), np.sqrt(below - u)
            turn = np.exp(4j * np.pi * thickness * q1 / self.nm)
            s1, s2 = (cosine - q1) / (cosine + q1), (q1 - q2) / (q1 + q2)
            p1 = (film * cosine - q1) / (film * cosine + q1)
            p2 = (below * q1 - film * q2) / (below * q1 + film * q2)
            r_s = (s1 + s2 * turn) / (1 + s1 * s2 * turn)
            r_p = (p1 + p2 * turn) / (1 + p1 * p2 * turn)
            rho = np.conj(r_p / r_s)
            psi.append(np.degrees(np.arctan(np.abs(rho))))
            delta.append(np.degrees(np.angle(rho)))
        return np.concatenate(psi), np.concatenate(delta)

    def fit(self, model, start):
        parameters = lmfit.Parameters()
        parameters.add("thickness", value=start[0], min=0.0, max=1e4)
        parameters.add("porosity", value=start[1], min=0.0, max=0.95)

        def difference(p):
            psi, delta = model(p["thickness"].value, p["porosity"].value)
            return residuals(psi, delta, self.rows)

        result = lmfit.minimize(difference, parameters, scale_covar=False)
        values = [result.params[name] for name in ("thickness", "porosity")]
        return [v.value for v in values] + [v.stderr for v in values]


# The metals of the chart "fit-time" (bench/charts/five_metals.h).
METALS = ["Cu-McPeak", "Ag-McPeak", "Au-McPeak", "Al-McPeak", "Zn-Werner-DFT"]
here = os.path.dirname(os.path.abspath(__file__))
GRID = np.arange(380, 780)  # where the chart compares n + ik


def true_index(metal):
    path = os.path.join(here, os.pardir, os.pardir, "materials", "tables", metal + ".csv")
    with open(path, encoding="utf-8") as file:
        lines = [line for line in file if not line.startswith("#")]
    columns = lines[0].strip().split(",")
    table = np.array([[float(x) for x in line.split(",")] for line in lines[1:]])
    n, k = (table[:, columns.index(name)] for name in ("n", "k"))
    nm = table[:, 0]
    return np.interp(GRID, nm, n) + 1j * np.interp(GRID, nm, k)


def metal_points(program, folder, seeds):
    """Rows of the chart "fit-time"."""
    points = []
    models = {"lmfit + pyElli": (bulk_elli, (5, 11, 21)),
              "lmfit + plain numpy": (bulk_numpy, (5, 11, 21, 41, 81))}
    for name, (model, counts) in models.items():
        for count in counts:
            seconds, errors = [], []
            for seed in range(1, seeds + 1):
                sum_of_seconds, sum_of_errors = 0.0, 0.0
                for metal in METALS:
                    path = os.path.join(folder, "metal-of-chart.csv")
                    subprocess.run(
                        [program, "simulate", metal, "--angles", "65,70,75", "--wavelengths",
                         f"380:780:{400 // (count - 1)}", "--noise", "0.05,0.1", "--seed",
                         str(seed), "-o", path],
                        check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                    data = read_measurement(path)
                    begin = time.process_time()
                    found = bulk(model)(data)
                    sum_of_seconds += time.process_time() - begin
                    nm = np.array(sorted(data))
                    index = np.interp(GRID, nm, found[:, 0]) + 1j * np.interp(GRID, nm, found[:, 1])
                    truth = true_index(metal)
                    sum_of_errors += np.sqrt(np.mean(np.abs((index - truth) / truth) ** 2))
                seconds.append(sum_of_seconds / len(METALS))
                errors.append(sum_of_errors / len(METALS))
            points.append(row("fit-time", name, f"{count} wavelengths", seconds, errors,
                              f"{len(METALS)} metals, {seeds} seeds"))
    return points


def film_points(first, own, peers, seconds, truth_nm):
    """Rows of "peers-film": error of the thickness over it."""
    def point(method, setting, cost, thickness):
        return row("peers-film", method, setting, [cost], [abs(thickness / truth_nm - 1)],
                   f"{thickness:.3f} nm of {truth_nm:g}")

    points = [point("drude", "from a start", own["film_local"],
                    first["film_local"]["thickness_nm"]),
              point("drude", "global search", own["film_global"],
                    first["film_global"]["thickness_nm"])]
    for name, method in (("film pyElli", "lmfit + pyElli"), ("film numpy", "lmfit + plain numpy")):
        points.append(point(method, "from a start", seconds[name], peers[name][0]))
    return points


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        for line in file:
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return platform.processor()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build_folder")
    parser.add_argument("rounds", nargs="?", type=int, default=5)
    parser.add_argument("--csv", help="points for drude bench --with")
    parser.add_argument("--seeds", type=int, default=3, help="of the measurements in --csv")
    args = parser.parse_args()
    program = os.path.join(args.build_folder, "fit_speed")
    rounds = args.rounds
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "write", folder], check=True)
        metal = read_measurement(os.path.join(folder, "metal.csv"))
        film = Film(folder, read_measurement(os.path.join(folder, "film.csv")))
        ours = lambda: json.loads(subprocess.run([program, "run", folder], check=True,
                                                 capture_output=True, text=True).stdout)
        first = ours()
        start = (first["film_local"]["start_nm"], first["film_local"]["start_porosity"])
        peers = {
            "bulk pyElli": lambda: bulk(bulk_elli)(metal),
            "bulk numpy": lambda: bulk(bulk_numpy)(metal),
            "film pyElli": lambda: film.fit(film.elli, start),
            "film numpy": lambda: film.fit(film.numpy, start),
        }
        answers = {name: run() for name, run in peers.items()}
        seconds = {name: [] for name in peers}
        own = {"bulk": [], "film_local": [], "film_global": []}
        for _ in range(rounds):
            result = ours()
            for name in own:
                own[name].append(result[name]["seconds"])
            for name, run in peers.items():
                begin = time.process_time()
                run()
                seconds[name].append(time.process_time() - begin)
        points = (metal_points(os.path.join(args.build_folder, "drude"), folder, args.seeds)
                  if args.csv else [])

    wavelengths = len(metal)
    own = {name: statistics.median(values) for name, values in own.items()}
    seconds = {name: statistics.median(values) for name, values in seconds.items()}
    print(f"{processor()}, {os.cpu_count()} processors, one thread used; processor time, medians of {rounds} "
          f"rounds.\n\ndrude {first['version']} ({first['isa']}), pyElli {version('pyElli')}, "
          f"lmfit {version('lmfit')}, scipy {scipy.__version__}, numpy {np.__version__}, "
          f"Python {platform.python_version()}.\n")
    print("| fit | drude, ms | lmfit + pyElli, ms | ratio | lmfit + plain numpy, ms | ratio |")
    print("|---|---|---|---|---|---|")

    def table_row(name, mine, slow, plain, per):
        print(f"| {name} | {1e3 * mine / per:.3f} | {1e3 * slow / per:.1f} | {slow / mine:.0f} | "
              f"{1e3 * plain / per:.2f} | {plain / mine:.0f} |")

    table_row("n, k of one wavelength, 6 angles", own["bulk"], seconds["bulk pyElli"],
              seconds["bulk numpy"], wavelengths)
    table_row(f"n, k and covariance of all {wavelengths} wavelengths", own["bulk"],
              seconds["bulk pyElli"], seconds["bulk numpy"], 1)
    table_row("film of 3 um, from the same start", own["film_local"], seconds["film pyElli"],
              seconds["film numpy"], 1)
    print(f"| film, global search and refinement | {1e3 * own['film_global']:.1f} | | | | |\n")

    mine = first["bulk"]
    sigma = np.stack([mine["sigma_n"], mine["sigma_k"]], axis=1)
    values = np.stack([mine["n"], mine["k"]], axis=1)
    for name in ("bulk pyElli", "bulk numpy"):
        apart = np.max(np.abs(answers[name][:, :2] - values) / sigma)
        errors = np.max(np.abs(answers[name][:, 2:] / sigma - 1))
        print(f"- {name}: n and k at most {apart:.1e} standard deviations apart, the standard "
              f"deviations {100 * errors:.2g} %.")
    local = first["film_local"]
    for name in ("film pyElli", "film numpy"):
        thickness, porosity, sigma_thickness, _ = answers[name]
        apart = abs(thickness - local["thickness_nm"]) / local["sigma_thickness_nm"]
        print(f"- {name}: {thickness:.3f} nm and {porosity:.5f} against "
              f"{local['thickness_nm']:.3f} and {local['porosity']:.5f}: {apart:.1e} standard "
              f"deviations apart, those {100 * (sigma_thickness / local['sigma_thickness_nm'] - 1):.2g}"
              " %.")
    print(f"- thickness of the global search {first['film_global']['thickness_nm']:.3f} nm.")
    targets = {
        "200x a wavelength against lmfit + pyElli": seconds["bulk pyElli"] / own["bulk"] >= 200,
        f"{wavelengths} wavelengths within 10 ms": own["bulk"] < 0.010,
        "50x a film against lmfit + pyElli": seconds["film pyElli"] / own["film_local"] >= 50,
    }
    if args.csv:
        write_rows(args.csv, points + film_points(first, own, answers, seconds, 3000.0))
    for target, met in targets.items():
        print(f"- {target}: {'met' if met else 'NOT met'}.")
    return 0 if all(targets.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
