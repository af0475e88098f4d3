"""Rows of the charts of `drude bench`, which `drude bench --with FILE` draws into the chart of the
same id, or into a chart of their own where it has none of that id."""

import csv
import math
import os
import statistics

COLUMNS = ["chart", "method", "setting", "cost", "error", "error_sigma", "automatic", "pareto",
           "note"]


def row(chart, method, setting, costs, errors, note=""):
    """Median of the costs, mean of the errors with the standard deviation of that mean."""
    sigma = statistics.stdev(errors) / math.sqrt(len(errors)) if len(errors) > 1 else 0.0
    return [chart, method, setting, repr(float(statistics.median(costs))),
            repr(float(statistics.fmean(errors))), repr(float(sigma)), "0", "0", note]


def write_rows(path, rows):
    """The whole file or, where writing fails, none of it."""
    part = f"{path}.part{os.getpid()}"
    try:
        with open(part, "w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(COLUMNS)
            writer.writerows(rows)
            file.flush()
            os.fsync(file.fileno())
        os.replace(part, path)
    except BaseException:
        if os.path.exists(part):
            os.remove(part)
        raise
