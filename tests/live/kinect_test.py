# SPDX-License-Identifier: BSD-3-Clause
"""geomap-kinect with a virtual OpenNI2 camera: from the camera to the map, and what goes wrong.

usage: kinect_test.py FOLDER_OF_PROGRAMS VIRTUAL_CAMERA.so [unittest arguments]
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

LIBRARIES = pathlib.Path("/usr/lib") / f"{os.uname().machine}-linux-gnu"


def make_camera(folder, driver, types):
    """The folder of a virtual camera in a simulated kitchen; OpenNI2 finds drivers beside itself.

    Returns the simulated depth images.
    """
    drivers = folder / "openni2" / "OpenNI2" / "Drivers"
    drivers.mkdir(parents=True)
    (folder / "openni2" / "libOpenNI2.so.0").symlink_to(LIBRARIES / "libOpenNI2.so.0")
    (drivers / "libOniFile.so.0").symlink_to(LIBRARIES / "OpenNI2/Drivers/libOniFile.so.0")
    (drivers / "libVirtualCamera.so.0").symlink_to(driver)
    os.environ["LD_LIBRARY_PATH"] = str(folder / "openni2")
    os.environ["GEOMAP_VIRTUAL_CAMERA"] = str(folder)
    depths = live_camera.simulated_depth(PROGRAMS, folder, types)
    (folder / "depth.raw").write_bytes(b"".join(depths))
    return depths


def halved(image):
    """Every second pixel of every second row of a 640x480 image."""
    pixels = array.array("H", image)
    return b"".join(pixels[row * 640:(row + 1) * 640:2].tobytes() for row in range(0, 480, 2))


class Kinect(live_camera.CameraTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.simulated = make_camera(cls.folder, DRIVER, cls.types)

    def setUp(self):
        self.control("run")

    def control(self, word):
        """Tells the virtual camera what to do."""
        new = self.folder / "control.new"
        new.write_text(word)
        new.rename(self.folder / "control")

    def test_the_live_map_is_that_of_a_replay_and_a_recording_gives_the_same_frames(self):
        oni = self.folder / "camera.oni"
        live, replayed, log = self.map_of("camera", ["--record", str(oni)],
                                          lambda kinect: time.sleep(5.0))
        self.assertEqual(live, replayed)
        frames = self.published(log)
        self.assertGreater(len(frames), 60)
        self.assertLessEqual(set(frames), set(live_camera.digests(self.simulated)))
        recording = ["--device", str(oni), "--lossless"]
        live, replayed, log = self.map_of("recording", recording,
                                          lambda kinect: kinect.process.wait(60))
        self.assertEqual(live, replayed)
        recorded = self.published(log)
        self.assertLessEqual(set(frames), set(recorded))
        _, again, log = self.map_of("again", recording, lambda kinect: kinect.process.wait(60))
        self.assertEqual(again, replayed)
        self.assertEqual(self.published(log), recorded)
        self.is_played_at_its_own_pace(oni, len(recorded))

    def is_played_at_its_own_pace(self, oni, images):
        began = time.monotonic()
        kinect = self.start("--device", str(oni))
        kinect.process.wait(60)
        self.assertGreater(time.monotonic() - began, images / 30)
        self.assertEqual(kinect.stop(), 0)
        self.assertGreater(kinect.value("frames"), 0.9 * images)

    def test_a_recording_that_cannot_be_played_ends_the_program_with_one_line(self):
        broken = self.folder / "broken.oni"
        broken.write_bytes(b"NI10" + bytes(1000))
        for file in (broken, self.folder / "missing.oni"):
            kinect = self.start("--device", str(file))
            self.assertEqual(kinect.process.wait(20), 1)
            kinect.stop()
            self.assertRegex(kinect.errors, f"geomap-kinect: cannot play {file}")

    def test_depth_in_tenths_of_a_millimetre_at_half_the_size_is_the_same_depth(self):
        log = self.folder / "half.lcmlog"
        logger = live_system.Process(["lcm-logger", f"--lcm-url={live_system.UDP}", "-c",
                                      "RGBD_FRAME", str(log)], self.folder)
        kinect = self.start("--set", "kinect.width=320", "--set", "kinect.height=240", "--set",
                            "kinect.rate=15", "--set", "kinect.registered=false")
        self.wait_until_well()
        kinect.stop()
        logger.stop()
        frames = self.published(log)
        self.assertGreater(len(frames), 5)
        self.assertLessEqual(set(frames), set(live_camera.digests(map(halved, self.simulated))))

    def test_a_camera_file_gives_intrinsics_and_corrects_depth(self):
        camera = self.folder / "camera.yaml"
        camera.write_text("name: x\n"
                          "color: {width: 640, height: 480, fx: 550, fy: 550, cx: 319.5, cy: 239.5}\n"
                          "depth_correction: [0.05, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]\n")
        log = self.folder / "corrected.lcmlog"
        logger = live_system.Process(["lcm-logger", f"--lcm-url={live_system.UDP}", "-c",
                                      "RGBD_FRAME", str(log)], self.folder)
        kinect = self.start("--camera", str(camera))
        self.wait_until_well()
        kinect.stop()
        logger.stop()
        _, data = next(iter(live_system.read_log(log)))
        self.assertEqual(self.types.rgbd_frame_t.decode(data).depth_camera.fx, 550.0)
        image = array.array("H", live_camera.depth_images(log, self.types)[0])
        row = slice(100 * 640, 101 * 640)

        def is_corrected(plain):
            # By 5 % of the depth at a viewing ray of 0.55, nothing in the middle.
            return all(abs(after - round(before * (1 + 0.05 * (u - 319.5) / 550 / 0.55))) <= 1
                       for u, (before, after) in enumerate(zip(plain[row], image[row])) if before)
        self.assertTrue(any(is_corrected(array.array("H", plain)) for plain in self.simulated))

    def test_it_waits_for_a_camera_and_says_so_once(self):
        self.control("unplug")
        kinect = self.start()
        health = self.wait_for_health(lambda h: h.level == self.types.health_t.FAILING)
        self.assertIn("no devices found", health.message)
        time.sleep(1.5)
        self.wait_until_well(lambda: self.control("run"))
        kinect.stop()
        self.assertEqual(kinect.errors.count("no devices found"), 1)

    def test_a_camera_that_was_unplugged_is_opened_again(self):
        self.recovers_from("unplug", "was unplugged", "camera.lost")

    def test_a_camera_that_stalls_is_opened_again(self):
        self.recovers_from("stall", "no whole depth image for 1 s", "camera.lost")

    def test_a_camera_whose_depth_alone_stalls_is_opened_again(self):
        self.recovers_from("stall-depth", "no whole depth image for 1 s", "camera.lost")

    def test_half_images_are_refused(self):
        self.recovers_from("tear", "no whole (depth|colour) image for 1 s", "images.torn")

    def recovers_from(self, fault, reason, counter):
        kinect = self.start()
        self.wait_until_well()
        self.wait_for_health(lambda h: h.level == self.types.health_t.FAILING,
                             lambda: self.control(fault))
        began = time.monotonic()
        self.control("run")
        self.assertLess(self.wait_for_frame() - began, 3.0)
        kinect.stop()
        self.assertRegex(kinect.errors, reason)
        self.assertGreater(kinect.value(counter), 0)

    def test_a_call_of_the_library_that_does_not_return_ends_the_program(self):
        self.control("hang")
        kinect = self.start()
        self.assertEqual(kinect.process.wait(40), 1)
        kinect.stop()
        self.assertIn("the camera's library has not returned for 15 s", kinect.errors)

    def test_a_mode_that_the_camera_lacks_is_refused_with_those_it_has(self):
        self.start("--set", "kinect.width=320", "--set", "kinect.height=240")
        health = self.wait_for_health(lambda h: h.level == self.types.health_t.FAILING)
        self.assertIn("no depth mode 320x240 at 30; it has 640x480 at 30", health.message)

    def test_of_two_processes_the_second_waits_for_the_camera(self):
        first = self.start()
        self.wait_until_well()
        second = self.start("--channel-prefix", "second/")
        data = self.listener.wait_for(
            "second/HEALTH", lambda data: self.types.health_t.decode(data).level != 0)
        self.assertIn("another process has the camera", self.types.health_t.decode(data).message)
        first.stop()
        self.listener.wait_for("second/HEALTH",
                               lambda data: self.types.health_t.decode(data).level == 0)
        second.stop()

    def test_the_list_names_camera_and_modes(self):
        done = subprocess.run([str(PROGRAMS / live_camera.KINECT), "--list"], check=True, capture_output=True,
                              text=True)
        self.assertIn("virtual://kitchen  geomap virtual camera", done.stdout)
        self.assertIn("640x480 at 30 (depth 1 mm)", done.stdout)


if __name__ == "__main__":
    PROGRAMS = live_system.enter_namespace(sys.argv[1])
    live_camera.CameraTest.programs = PROGRAMS
    DRIVER = pathlib.Path(sys.argv[2]).resolve()
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
