#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes what scripts/bench measured between the marks of a Markdown file.

RESULTS holds what the programs printed: facts.txt (one line each), keyframe_bench.json and
keyframe_bench_simulated.json, extraction_quality.txt, keyframe_memory.txt, registration_pairs.txt and, if any, merging_growth.txt.
"""
import argparse
import collections
import dataclasses
import json
import pathlib
import re
import statistics

BEGIN = "<!-- bench:begin -->"
END = "<!-- bench:end -->"


@dataclasses.dataclass
class Figure:
    """One row's value in one column; `by` says in words what is compared."""

    by: str
    value: float
    text: str
    more_is_better: bool = False


@dataclasses.dataclass
class Comparison:
    """Rows that do the same, each a name and its figures; the first row is ours."""

    title: str
    remark: str
    rows: list


# Title, remark, unit of time, what is counted, and the benchmarks with their names, ours first.
COMPARISONS = [
    ("Plane extraction with outlines", "A key frame.", "ms", "planes", {
        "extraction/organized": "geomap, `organized`",
        "extraction/ransac": "geomap, `ransac`",
        "extraction/pcl_recipe_4cm": "PCL recipe, 4 cm voxels",
        "extraction/pcl_recipe_2cm": "PCL recipe, 2 cm voxels",
        "extraction/pcl_omps": "PCL integral image normals, multi-plane segmentation",
    }),
    ("Outlines", "A key frame's planes. Traced: from all pixels, by the clock. The others: from the "
     "pixels of every fourth column and row, alpha 5 cm.", "ms", "vertices", {
        "outlines/traced": "geomap, traced",
        "outlines/alpha_hull": "geomap, alpha hull",
        "outlines/pcl_concave_hull": "PCL ConcaveHull",
        "outlines/cgal_alpha_shape_2": "CGAL Alpha_shape_2",
    }),
    ("Unions", "A plane and what the next key frame sees of it; operands are converted before.",
     "µs", "parts", {
        "unions/geomap": "geomap",
        "unions/cgal": "CGAL, exact",
        "unions/boost": "Boost.Geometry, double",
    }),
    ("Merging", "A key frame with its recorded pose. Features: of the map, in the mean.", "ms", "features", {
        "merging/moments": "geomap, by moments",
        "merging/paper": "geomap, as the paper prints it",
    }),
]
# File of keyframe_bench, and what is added to the titles.
ROOMS = {"keyframe_bench.json": "", "keyframe_bench_simulated.json": ", simulated room"}
# Prefix of keyframe/all's counters, and what it is.
KEYFRAME = {
    "decoding_": "decoding",
    "tracking_": "registration and point map",
    "extraction_": "planes and outlines",
    "merging_": "merging",
    "decoded_": "all but decoding",
    "all_": "all",
}
# Column, and what it compares in words; as registration_bench prints them.
REGISTRATION = [
    ("error [cm]", "error"),
    ("95th percentile", "95th percentile of error"),
    ("error [°]", "rotation error"),
    ("95th percentile", "95th percentile of rotation error"),
    ("failed", "failures"),
    ("median [ms]", "median time"),
    ("95th percentile [ms]", "95th percentile of time"),
]
# Column of extraction_quality, and whether more of it is better.
LABELS = {"cover": True, "mismatch": False, "split": False, "rms": False}


def medians(report):
    """Of each benchmark's counters over its repetitions."""
    runs = collections.defaultdict(list)
    for run in report["benchmarks"]:
        if run["run_type"] == "iteration":
            runs[re.match(r"[^/]+/[^/]+", run["name"])[0]].append(run)
    return {name: {key: statistics.median(run[key] for run in repeated)
                   for key in repeated[0] if key.endswith("_ms") or key == "found"}
            for name, repeated in runs.items()}


def number(value):
    """Three digits, and never an exponent."""
    decimals = 2 if abs(value) < 10 else 1 if abs(value) < 100 else 0
    return f"{value:.{decimals}f}"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---" + "|--:" * (len(head) - 1) + "|"]
    return lines + ["| " + " | ".join(row) + " |" for row in rows] + [""]


def timed(counters, unit, step=""):
    scale = 1e3 if unit == "µs" else 1.0
    return [Figure(by, scale * counters[step + key], number(scale * counters[step + key]))
            for by, key in (("median time", "median_ms"), ("95th percentile of time", "p95_ms"))]


def texts(figures):
    return [figure.text for figure in figures]


def write_keyframe(counters, room):
    rows = [[label, *texts(timed(counters, "ms", step))]
            for step, label in KEYFRAME.items()]
    return [f"### A key frame{room}", "From the message of a log to the map.", "",
            *table(["step", "median [ms]", "95th percentile [ms]"], rows)]


def timings_in(times, room):
    """Each comparison of times with its unit, what it counts, and how many of them."""
    for title, remark, unit, found, names in COMPARISONS:
        rows = [(label, timed(times[name], unit)) for name, label in names.items()]
        counts = [times[name]["found"] for name in names]
        yield Comparison(title + room, remark, rows), unit, found, counts


def write_times(comparison, unit, found, counts):
    ours = comparison.rows[0][1][0].value
    rows = [[label, *texts(figures), f"{figures[0].value / ours:.2f}", number(count)]
            for (label, figures), count in zip(comparison.rows, counts)]
    head = ["", f"median [{unit}]", f"95th percentile [{unit}]", "to ours", found]
    return [f"### {comparison.title}", comparison.remark, "", *table(head, rows)]


def registration(text):
    """The lines `name runs error error degrees degrees failures time time ...`."""
    rows = []
    for line in text.splitlines():
        row = re.match(r"(\S.*?)\s{2,}(\d+)" + r"\s+([\d.]+)" * len(REGISTRATION), line)
        if row:
            figures = [Figure(by, float(value), value)
                       for (_, by), value in zip(REGISTRATION, row.groups()[2:])]
            rows.append((row[1], figures))
    return Comparison("Registration", "Pairs of kitchen frames, started 5 cm and 3° off.", rows)


def write_registration(comparison):
    ours = comparison.rows[0][1][5].value
    rows = [[label, *texts(figures), f"{figures[5].value / ours:.2f}"]
            for label, figures in comparison.rows]
    head = ["", *(name for name, _ in REGISTRATION), "to ours"]
    return [f"### {comparison.title}", comparison.remark, "", *table(head, rows)]


def tables_in(text):
    """Cells of each Markdown table, without the rulers."""
    for block in re.findall(r"(?:^\|.*\n?)+", text, re.MULTILINE):
        rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in block.splitlines()]
        yield rows[0], rows[2:]


def labels(text):
    """The extractors in the tables of extraction_quality, without their times."""
    (head, by_extractor), (depths, by_depth) = tables_in(text)
    kinds = [name.split()[0] for name in head]
    rows = {cells[0]: [Figure(kind, float(cell.split()[0]), cell, LABELS[kind])
                       for kind, cell in zip(kinds, cells) if kind in LABELS]
            for cells in by_extractor}
    for cells in by_depth:
        rows.get(cells[0], []).extend(Figure(f"cover % at {depth}", float(cell), cell, True)
                                      for depth, cell in zip(depths[1:], cells[1:]))
    return Comparison("Labels", "The same frames by another extractor.", list(rows.items()))


def worse(comparison):
    """One line for each figure in which another row beats ours; a row that bears our name and more
    is a variant of ours."""
    our_name, ours = comparison.rows[0]
    others = [row for row in comparison.rows if not row[0].startswith(our_name)]
    for name, figures in others:
        for own, other in zip(ours, figures):
            better = other.value > own.value if own.more_is_better else other.value < own.value
            if better:
                yield (f"- {comparison.title}, {own.by}: {name} has {other.text}, "
                       f"{our_name} {own.text}.")


def page(results):
    def read(name):
        return (results / name).read_text()

    pairs = registration(read("registration_pairs.txt"))
    quality = "\n".join(line for line in read("extraction_quality.txt").splitlines()
                        if "labels.png" not in line)
    lines = [*(f"- {fact}" for fact in read("facts.txt").splitlines()), ""]
    compared = []
    for file, room in ROOMS.items():
        times = medians(json.loads(read(file)))
        lines += write_keyframe(times["keyframe/all"], room)
        for comparison, *timing in timings_in(times, room):
            lines += write_times(comparison, *timing)
            compared.append(comparison)
    lines += write_registration(pairs)
    lines += ["### Labels", quality.strip(), ""]
    lines += ["### Memory", read("keyframe_memory.txt").strip(), ""]
    if (results / "merging_growth.txt").exists():
        lines += ["### Merging in a growing map", read("merging_growth.txt").strip(), ""]
    lines += ["### Worse than others", "Every figure above in which another row beats the first; geomap's "
              "own second ways count as others.", ""]
    compared += [pairs, labels(quality)]
    lines += [line for comparison in compared for line in worse(comparison)] or ["- none"]
    return "\n".join(lines)


def replaced(document, block):
    """The document with `block` between the marks."""
    before, begin, rest = document.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        raise SystemExit(f"no marks {BEGIN} and {END} in the document")
    return f"{before}{BEGIN}\n\n{block}\n\n{END}{after}"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=pathlib.Path)
    parser.add_argument("document", type=pathlib.Path)
    arguments = parser.parse_args()
    block = page(arguments.results)
    arguments.document.write_text(replaced(arguments.document.read_text(), block))


if __name__ == "__main__":
    main()
