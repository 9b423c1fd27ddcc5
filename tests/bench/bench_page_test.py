# SPDX-License-Identifier: BSD-3-Clause
"""How scripts/bench_page.py makes tables and verdicts of what programs printed."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "scripts"))

import bench_page

QUALITY = """25 kitchen frames

| extractor | cover %, median (p5) | mismatch % | split (flush) | rms mm | time ms |
|---|--:|--:|--:|--:|--:|
| organized | 85.2 (81.5) | 0.30 | 0.68 (0.04) | 8.2 | 14.0 |
| ransac | 86.0 (81.0) | 0.40 | 0.92 (0.09) | 8.1 | 1.0 |

| cover % by depth | <1 m | >3 m |
|---|--:|--:|
| share of the readings | 8.1 | 0.8 |
| organized | 86.6 | 69.9 |
| ransac | 88.2 | 67.1 |
"""

PAIRS = """Pairs of kitchen frames 10 apart, start 5 cm and 3 degrees off (median, p95)
                 runs   error [cm]  error [deg]   fail      time [ms]  median time by stage [ms]
ours               49   1.05  2.19  0.333  0.99      0    1.28   1.92  view 0.88 align 0.92
ours, learnt       49   0.93  2.29  0.351  1.01      0    1.23   1.80  view 0.97
PCL GICP           49   1.25  2.68  0.315  0.75      0   46.37  70.53  prepare 14.76  (36.2 x ours)
ours: in 3 runs a part of the pose is left to the start
"""


def run(name, milliseconds, kind="iteration"):
    return {"name": name + "/iterations:40/manual_time", "run_type": kind,
            "median_ms": milliseconds, "p95_ms": 2 * milliseconds, "found": 3, "cpu_time": 0}


def comparison(ours, other, more_is_better=False):
    def row(name, value):
        return name, [bench_page.Figure("time", value, str(value), more_is_better)]
    return bench_page.Comparison("Unions", "", [row("geomap", ours), row("CGAL", other)])


class BenchPage(unittest.TestCase):
    def test_a_benchmark_counts_with_the_median_of_its_repetitions(self):
        report = {"benchmarks": [run("unions/cgal", 3), run("unions/cgal", 9), run("unions/cgal", 4),
                                 run("unions/cgal", 100, "aggregate")]}
        self.assertEqual(bench_page.medians(report),
                         {"unions/cgal": {"median_ms": 4, "p95_ms": 8, "found": 3}})

    def test_a_table_has_its_first_row_for_the_unit_of_ratios(self):
        rows = [("geomap", bench_page.timed({"median_ms": 0.02, "p95_ms": 0.1}, "µs")),
                ("CGAL", bench_page.timed({"median_ms": 0.05, "p95_ms": 0.2}, "µs"))]
        unions = bench_page.Comparison("Unions", "Pairs.", rows)
        lines = bench_page.write_times(unions, "µs", "parts", [1, 2])
        self.assertEqual(lines[3:7], ["|  | median [µs] | 95th percentile [µs] | to ours | parts |",
                                      "|---|--:|--:|--:|--:|",
                                      "| geomap | 20.0 | 100 | 1.00 | 1.00 |",
                                      "| CGAL | 50.0 | 200 | 2.50 | 2.00 |"])

    def test_what_another_does_better_is_named(self):
        self.assertEqual(list(bench_page.worse(comparison(5, 4))),
                         ["- Unions, time: CGAL has 4, geomap 5."])
        self.assertEqual(list(bench_page.worse(comparison(4, 5))), [])
        self.assertEqual(list(bench_page.worse(comparison(4, 4))), [])

    def test_more_may_be_better(self):
        self.assertEqual(list(bench_page.worse(comparison(5, 4, True))), [])
        self.assertEqual(len(list(bench_page.worse(comparison(4, 5, True)))), 1)

    def test_labels_are_compared_by_quality_and_depth_not_by_time(self):
        self.assertEqual(list(bench_page.worse(bench_page.labels(QUALITY))),
                         ["- Labels, cover: ransac has 86.0 (81.0), organized 85.2 (81.5).",
                          "- Labels, rms: ransac has 8.1, organized 8.2.",
                          "- Labels, cover % at <1 m: ransac has 88.2, organized 86.6."])

    def test_registration_is_beaten_by_others_not_by_its_own_variant(self):
        pairs = bench_page.registration(PAIRS)
        self.assertEqual([name for name, _ in pairs.rows], ["ours", "ours, learnt", "PCL GICP"])
        self.assertEqual(list(bench_page.worse(pairs)),
                         ["- Registration, rotation error: PCL GICP has 0.315, ours 0.333.",
                          "- Registration, 95th percentile of rotation error: PCL GICP has 0.75, ours 0.99."])

    def test_only_what_stands_between_the_marks_is_replaced(self):
        old = f"before\n{bench_page.BEGIN}\nold\n{bench_page.END}\nafter\n"
        new = bench_page.replaced(old, "new")
        self.assertEqual(new, f"before\n{bench_page.BEGIN}\n\nnew\n\n{bench_page.END}\nafter\n")
        self.assertEqual(bench_page.replaced(new, "new"), new)

    def test_a_document_without_marks_is_refused(self):
        with self.assertRaises(SystemExit):
            bench_page.replaced(f"{bench_page.END} {bench_page.BEGIN}", "new")


if __name__ == "__main__":
    unittest.main()
