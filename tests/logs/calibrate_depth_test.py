# SPDX-License-Identifier: BSD-3-Clause
"""geomap-calibrate-depth on a simulated kitchen: what it writes makes the map better.

usage: calibrate_depth_test.py FOLDER_OF_PROGRAMS [unittest arguments]
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]


def run(program, *arguments, check=True):
    return subprocess.run([str(PROGRAMS / program), *map(str, arguments)], check=check,
                          capture_output=True, text=True)


def simulate(log, *options):
    run("geomap-sim", "--scene", SOURCE / "config/scenes/kitchen.yaml", "--trajectory",
        SOURCE / "config/trajectories/sweep.yaml", "--noise", "kinect", "--rate", 3,
        "--drift-m-per-m", 0.02, "--log", log, *options)
    return log


class CalibrateDepth(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.distorted = simulate(cls.folder / "distorted.lcmlog")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def rms_p(self, log, *options):
        """Of the map against the truth [m]."""
        out = self.folder / "out"
        run("geomap-replay", log, "-o", out, *options)
        run("geomap-eval", "--map", out / "map.lcmlog", "--truth", log.with_suffix(".truth.yaml"),
            "-o", out / "evaluation")
        return json.loads((out / "evaluation" / "evaluation.json").read_text())["rms_p"]

    def test_another_drive_with_the_same_camera_gives_a_far_better_map(self):
        other = simulate(self.folder / "other.lcmlog", "--seed", 7)
        camera = self.folder / "camera.yaml"
        done = run("geomap-calibrate-depth", other, "-o", camera)
        self.assertIn("depth_correction", done.stdout)
        before, after = self.rms_p(self.distorted), self.rms_p(self.distorted, "--camera", camera)
        report = json.loads((self.folder / "out" / "report.json").read_text())
        self.assertEqual(report["camera"], str(camera))
        self.assertLess(after, 0.25 * before)

    def test_a_camera_without_distortion_gets_no_correction(self):
        straight = simulate(self.folder / "straight.lcmlog", "--distortion", 0)
        camera = self.folder / "straight.yaml"
        done = run("geomap-calibrate-depth", straight, "-o", camera)
        self.assertIn("no correction", done.stdout)
        self.assertNotIn("depth_correction", camera.read_text())

    def test_of_a_file_that_exists_only_the_correction_changes(self):
        camera = self.folder / "mine.yaml"
        run("geomap-calibrate-depth", self.distorted, "-o", camera)
        name, depth, color, *correction = camera.read_text().splitlines(keepends=True)
        self.assertEqual(name, "name: mine\n")
        self.assertIn("depth_correction: [", "".join(correction))
        camera.write_text("name: the one in front\n" + color)
        run("geomap-calibrate-depth", self.distorted, "-o", camera)
        self.assertEqual(camera.read_text(), "name: the one in front\n" + color + "".join(correction))

    def test_a_correction_is_not_lost_to_a_log_that_is_corrected_already(self):
        straight = simulate(self.folder / "corrected.lcmlog", "--distortion", 0)
        camera = self.folder / "good.yaml"
        run("geomap-calibrate-depth", self.distorted, "-o", camera)
        good = camera.read_text()
        done = run("geomap-calibrate-depth", straight, "-o", camera, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("keeps its correction", done.stderr)
        self.assertEqual(camera.read_text(), good)

    def test_a_correction_is_not_written_beside_other_intrinsics(self):
        camera = self.folder / "other.yaml"
        camera.write_text("name: x\ndepth: {width: 640, height: 480, fx: 500, fy: 500, cx: 320, cy: 240}\n")
        done = run("geomap-calibrate-depth", self.distorted, "-o", camera, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("has other intrinsics", done.stderr)

    def test_a_log_that_shows_too_little_is_refused_and_nothing_is_lost(self):
        short = self.folder / "short.lcmlog"
        run("geomap-log", "cut", self.distorted, short, "--to", 2)
        camera = self.folder / "kept.yaml"
        camera.write_text("name: kept\n")
        done = run("geomap-calibrate-depth", short, "-o", camera, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("tell too little", done.stderr)
        self.assertEqual(camera.read_text(), "name: kept\n")

    def test_a_file_that_is_no_camera_is_named_before_anything_is_done(self):
        camera = self.folder / "broken.yaml"
        camera.write_text("nam: x\n")
        for done in (run("geomap-calibrate-depth", self.distorted, "-o", camera, check=False),
                     run("geomap-replay", self.distorted, "-o", self.folder / "none", "--camera",
                         camera, check=False)):
            self.assertEqual(done.returncode, 1)
            self.assertIn("broken.yaml:1", done.stderr)
        self.assertFalse((self.folder / "none").exists())


if __name__ == "__main__":
    PROGRAMS = pathlib.Path(sys.argv[1]).resolve()
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
