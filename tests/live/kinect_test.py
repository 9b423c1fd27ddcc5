# SPDX-License-Identifier: BSD-3-Clause
"""geomap-kinect with a virtual OpenNI2 camera: from the camera to the map, and what goes wrong.

usage: kinect_test.py FOLDER_OF_PROGRAMS VIRTUAL_CAMERA.so [unittest arguments]
"""
import array
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

import live_system

KINECT = "geomap-kinect"
# The beginning of config/trajectories/sweep.yaml: what is seen tells where the camera is, as it must
# without odometry.
TRAJECTORY = """name: sweep
camera_height: 1.4
camera_forward: 0.1
waypoints:
  - {t: 0, x: -2.1, y: 0.3, yaw_deg: 15, pan_deg: 12, tilt_deg: 22}
  - {t: 3.6, x: -1.95, y: 0.6, yaw_deg: 8, pan_deg: 12, tilt_deg: 28}
  - {t: 5, x: -1.9, y: 0.7, yaw_deg: 6, pan_deg: 11, tilt_deg: 29}
"""
LIBRARIES = pathlib.Path("/usr/lib") / f"{os.uname().machine}-linux-gnu"


def make_camera(folder, driver, types):
    """The folder of a virtual camera in a simulated kitchen; OpenNI2 finds drivers beside itself.

    Returns the log of the simulation.
    """
    drivers = folder / "openni2" / "OpenNI2" / "Drivers"
    drivers.mkdir(parents=True)
    (folder / "openni2" / "libOpenNI2.so.0").symlink_to(LIBRARIES / "libOpenNI2.so.0")
    (drivers / "libOniFile.so.0").symlink_to(LIBRARIES / "OpenNI2/Drivers/libOniFile.so.0")
    (drivers / "libVirtualCamera.so.0").symlink_to(driver)
    os.environ["LD_LIBRARY_PATH"] = str(folder / "openni2")
    os.environ["GEOMAP_VIRTUAL_CAMERA"] = str(folder)
    # OpenNI2's drivers lose memory and are unloaded: a sanitizer knows no name to suppress it by.
    os.environ["ASAN_OPTIONS"] = "detect_leaks=0"
    trajectory = folder / "sweep.yaml"
    trajectory.write_text(TRAJECTORY)
    log = live_system.simulate(PROGRAMS, folder, trajectory)
    (folder / "depth.raw").write_bytes(b"".join(depth_images(log, types)))
    return log


def depth_images(log, types):
    return [zlib.decompress(bytes(types.rgbd_frame_t.decode(data).depth.data))
            for channel, data in live_system.read_log(log) if channel == "RGBD_FRAME"]


def digests(images):
    """Of all but the last 32 pixels, of which OpenNI2's recorder gets some wrong: where an image ends
    within a run of equal values, it writes the run after the pixel that follows it."""
    return [hashlib.sha256(image[:-64]).hexdigest() for image in images]


def halved(image):
    """Every second pixel of every second row of a 640x480 image."""
    pixels = array.array("H", image)
    return b"".join(pixels[row * 640:(row + 1) * 640:2].tobytes() for row in range(0, 480, 2))


class Kinect(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.types = live_system.message_types(cls.folder / "types")
        cls.simulated = depth_images(make_camera(cls.folder, DRIVER, cls.types), cls.types)
        cls.listener = live_system.Listener()

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def setUp(self):
        self.control("run")

    def control(self, word):
        """Tells the virtual camera what to do."""
        new = self.folder / "control.new"
        new.write_text(word)
        new.rename(self.folder / "control")

    def start(self, *options):
        kinect = live_system.Process([str(PROGRAMS / KINECT), "-l", live_system.UDP, *options],
                                     self.folder)
        self.addCleanup(lambda: kinect.is_running() and kinect.stop())
        return kinect

    def wait_for_health(self, accept, after=lambda: None):
        def is_accepted(data):
            health = self.types.health_t.decode(data)
            return health.process == KINECT and accept(health)
        data = self.listener.wait_for("HEALTH", is_accepted, after)
        return self.types.health_t.decode(data)

    def wait_until_well(self, after=lambda: None):
        """Until frames are published."""
        counts = []

        def is_publishing(health):
            counts.append({c.name: c.value for c in health.counters}.get("out.RGBD_FRAME", 0))
            return health.level == 0 and len(counts) > 1 and counts[-1] > counts[-2]
        return self.wait_for_health(is_publishing, after)

    def wait_for_frame(self):
        seen, deadline = len(self.listener.arrivals["RGBD_FRAME"]), time.monotonic() + 10.0
        while len(self.listener.arrivals["RGBD_FRAME"]) == seen:
            self.assertLess(time.monotonic(), deadline, "no RGBD_FRAME")
            time.sleep(0.005)
        return self.listener.arrivals["RGBD_FRAME"][seen]

    def map_of(self, name, kinect_options, is_done):
        """map_hash of the live stages, and that of replaying what they were sent."""
        log = self.folder / f"{name}.lcmlog"
        system = live_system.System(PROGRAMS, self.folder, options=["--lossless"]).start_all()
        logger = live_system.Process(["lcm-logger", f"--lcm-url={live_system.UDP}", "-c", "RGBD_FRAME",
                                      str(log)], self.folder)
        time.sleep(0.5)
        kinect = self.start(*kinect_options)
        is_done(kinect)
        self.assertEqual(kinect.stop(), 0)
        time.sleep(1.0)
        self.assertEqual(set(system.stop_all().values()), {0})
        logger.stop()
        replayed = subprocess.run(
            [str(PROGRAMS / "geomap-replay"), str(log), "-o", str(self.folder / name)],
            check=False, capture_output=True, text=True)
        self.assertEqual(replayed.returncode, 0, replayed.stderr)
        keyframes = re.search(r"features of (\d+) key frames", system.stages["geomap-mapper"].output)
        self.assertGreater(int(keyframes[1]), 3)
        return (system.stages["geomap-mapper"].map_hash(),
                re.search(r"map_hash:? (\w+)", replayed.stdout)[1], log)

    def published(self, log):
        return digests(depth_images(log, self.types))

    def test_the_live_map_is_that_of_a_replay_and_a_recording_gives_the_same_frames(self):
        oni = self.folder / "camera.oni"
        live, replayed, log = self.map_of("camera", ["--record", str(oni)],
                                          lambda kinect: time.sleep(5.0))
        self.assertEqual(live, replayed)
        frames = self.published(log)
        self.assertGreater(len(frames), 60)
        self.assertLessEqual(set(frames), set(digests(self.simulated)))
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
        self.assertLessEqual(set(frames), set(digests(map(halved, self.simulated))))

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
        done = subprocess.run([str(PROGRAMS / KINECT), "--list"], check=True, capture_output=True,
                              text=True)
        self.assertIn("virtual://kitchen  geomap virtual camera", done.stdout)
        self.assertIn("640x480 at 30 (depth 1 mm)", done.stdout)


if __name__ == "__main__":
    PROGRAMS = live_system.enter_namespace(sys.argv[1])
    DRIVER = pathlib.Path(sys.argv[2]).resolve()
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
