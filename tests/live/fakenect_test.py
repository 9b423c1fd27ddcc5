# SPDX-License-Identifier: BSD-3-Clause
"""geomap-kinect with libfreenect: a simulated Kinect, played by fakenect, becomes a map.

usage: fakenect_test.py FOLDER_OF_PROGRAMS [unittest arguments]
"""
import array
import os
import pathlib
import subprocess
import sys
import time
import unittest

import live_camera
import live_system

FAKENECT = pathlib.Path("/usr/lib") / f"{os.uname().machine}-linux-gnu" / "fakenect"
FREENECT = ["--driver", "freenect", "--set", "kinect.registered=false"]


def samples(images):
    """Some of the pixels."""
    return [array.array("H", image)[::997] for image in images]


def is_near(image, truth):
    """Half a step of the disparity apart, or less."""
    return all(abs(read - true) <= 1 + 1.5e-6 * true * true for read, true in zip(image, truth))


class Fakenect(live_camera.CameraTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.recording = cls.folder / "kinect"
        live_camera.simulate(PROGRAMS, cls.folder, "--fakenect", str(cls.recording))
        os.environ["FAKENECT_PATH"] = str(cls.recording)

    def setUp(self):
        os.environ["LD_LIBRARY_PATH"] = str(FAKENECT)

    def test_the_live_map_is_that_of_a_replay_and_depth_is_what_was_simulated(self):
        live, replayed, log = self.map_of("kinect", FREENECT, lambda kinect: time.sleep(7.0))
        self.assertEqual(live, replayed)
        published = samples(live_camera.depth_images(log, self.types))
        self.assertGreater(len(published), 60)
        simulated = samples(live_camera.simulated_depth(PROGRAMS, self.folder, self.types))
        for image in published:
            self.assertTrue(any(is_near(image, truth) for truth in simulated))

    def test_the_way_the_camera_is_held_is_published(self):
        kinect = self.start(*FREENECT)
        data = self.listener.wait_for("CAMERA_ATTITUDE")
        attitude = self.types.camera_attitude_t.decode(data)
        right, down, forward = attitude.acceleration
        self.assertAlmostEqual(right, 0.0, delta=0.05)
        # The camera looks down by 22 to 29 degrees.
        self.assertAlmostEqual(down, -9.8 * 0.9, delta=0.4)
        self.assertTrue(-9.8 * 0.49 < forward < -9.8 * 0.37, forward)
        kinect.stop()

    def test_the_list_names_the_kinect(self):
        done = subprocess.run([str(PROGRAMS / live_camera.KINECT), "--list"], check=True,
                              capture_output=True, text=True)
        self.assertIn("0  Kinect\n  640x480 at 30", done.stdout)

    def test_another_mode_is_refused_with_the_one_there_is(self):
        self.start("--driver", "freenect", "--set", "kinect.rate=15")
        health = self.wait_for_health(lambda h: h.level == self.types.health_t.FAILING)
        self.assertIn("a Kinect has no mode 640x480 at 15; it has 640x480 at 30", health.message)

    def test_a_kinect_that_ends_is_waited_for(self):
        kinect = self.start(*FREENECT)
        self.wait_until_well()
        health = self.wait_for_health(lambda h: h.level == self.types.health_t.FAILING)
        self.assertIn("Kinect 0 was unplugged, or fails", health.message)
        kinect.stop()

    def test_without_any_camera_both_drivers_say_so(self):
        del os.environ["LD_LIBRARY_PATH"]
        kinect = self.start()
        health = self.wait_for_health(lambda h: h.level == self.types.health_t.FAILING)
        self.assertRegex(health.message, "no devices found; libfreenect finds no Kinect")
        time.sleep(1.5)
        kinect.stop()
        self.assertEqual(kinect.errors.count("libfreenect finds no Kinect"), 1)

    def test_what_contradicts_itself_is_refused(self):
        for options, reason in ((["--record", "x.oni"], "--record is OpenNI2's"),
                                (["--device", "x.oni"], "played by --driver openni2"),
                                (["--tilt", "40"], "--tilt must be from -27 to 27")):
            done = subprocess.run([str(PROGRAMS / live_camera.KINECT), "--driver", "freenect", *options],
                                  check=False, capture_output=True, text=True)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(reason, done.stderr)


if __name__ == "__main__":
    PROGRAMS = live_system.enter_namespace(sys.argv[1])
    live_camera.CameraTest.programs = PROGRAMS
    if not FAKENECT.is_dir():
        live_system.skip(f"no fakenect: {FAKENECT}")
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
