# SPDX-License-Identifier: BSD-3-Clause
"""geomap-kinect with a camera that is not there, for tests."""
import hashlib
import os
import pathlib
import re
import subprocess
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


def simulate(programs, folder, *output):
    """A robot before the kitchen; output: geomap-sim's options for what to write."""
    trajectory = folder / "sweep.yaml"
    trajectory.write_text(TRAJECTORY)
    subprocess.run([str(programs / "geomap-sim"), "--scene",
                    str(live_system.SOURCE / "config/scenes/kitchen.yaml"), "--trajectory",
                    str(trajectory), "--noise", "kinect", *output], check=True, capture_output=True)


def simulated_depth(programs, folder, types):
    log = folder / "simulated.lcmlog"
    simulate(programs, folder, "--log", str(log))
    return depth_images(log, types)


def depth_images(log, types):
    return [zlib.decompress(bytes(types.rgbd_frame_t.decode(data).depth.data))
            for channel, data in live_system.read_log(log) if channel == "RGBD_FRAME"]


def digests(images):
    """Of all but the last 32 pixels, of which OpenNI2's recorder gets some wrong: where an image ends
    within a run of equal values, it writes the run after the pixel that follows it."""
    return [hashlib.sha256(image[:-64]).hexdigest() for image in images]


class CameraTest(unittest.TestCase):
    """A folder, a listener on the bus, and geomap-kinect. `programs`: folder of the programs."""

    @classmethod
    def setUpClass(cls):
        # OpenNI2's drivers lose memory and are unloaded: a sanitizer knows no name to suppress it by.
        os.environ["ASAN_OPTIONS"] = "detect_leaks=0"
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.types = live_system.message_types(cls.folder / "types")
        cls.listener = live_system.Listener()

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def start(self, *options):
        kinect = live_system.Process([str(self.programs / KINECT), "-l", live_system.UDP, *options],
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
        system = live_system.System(self.programs, self.folder, options=["--lossless"]).start_all()
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
            [str(self.programs / "geomap-replay"), str(log), "-o", str(self.folder / name)],
            check=False, capture_output=True, text=True)
        self.assertEqual(replayed.returncode, 0, replayed.stderr)
        keyframes = re.search(r"features of (\d+) key frames", system.stages["geomap-mapper"].output)
        self.assertGreater(int(keyframes[1]), 3)
        return (system.stages["geomap-mapper"].map_hash(),
                re.search(r"map_hash:? (\w+)", replayed.stdout)[1], log)

    def published(self, log):
        return digests(depth_images(log, self.types))
