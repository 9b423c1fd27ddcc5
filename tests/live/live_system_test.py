# SPDX-License-Identifier: BSD-3-Clause
"""The stages as separate processes: the same map as in one, whatever happens to them.

usage: live_system_test.py FOLDER_OF_PROGRAMS [unittest arguments]
"""
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import unittest

import live_system
from live_system import System


class LiveSystem(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.log = live_system.simulate(PROGRAMS, cls.folder)
        cls.types = live_system.message_types(cls.folder / "types")
        replay = subprocess.run([str(PROGRAMS / "geomap-replay"), str(cls.log), "-o",
                                 str(cls.folder / "replay")],
                                check=True, capture_output=True, text=True)
        cls.replayed = re.search(r"map_hash (\w+)", replay.stdout)[1]

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def setUp(self):
        self.system = None

    def tearDown(self):
        if self.system:
            for stage in self.system.stages.values():
                if stage.is_running():
                    stage.stop()

    def begin(self, *options, url=live_system.UDP):
        self.system = System(PROGRAMS, self.folder, url, options)
        return self.system

    def request(self, kind):
        message = self.types.map_request_t()
        message.kind, message.author = kind, "test"
        live_system.Publisher().send("MAP_REQUEST", message.encode())

    def test_a_replay_over_multicast_gives_the_map_of_one_process(self):
        system = self.begin("--lossless").start_all()
        system.play(self.log)
        self.assertEqual(set(system.stop_all().values()), {0})
        self.assertEqual(system.stages["geomap-mapper"].map_hash(), self.replayed)

    def test_a_replay_over_tcp_as_fast_as_it_goes_gives_the_map_of_one_process(self):
        with live_system.broker():
            system = self.begin("--lossless", "--spool-mb", "5", url=live_system.TCP).start_all()
            system.play(self.log, speed=0)
            time.sleep(10)
            self.assertEqual(set(system.stop_all().values()), {0})
        register = system.stages["geomap-register"]
        self.assertEqual(register.value("missing.RGBD_FRAME"), 0)
        self.assertEqual(system.stages["geomap-mapper"].map_hash(), self.replayed)

    def test_live_no_frame_is_missing_and_a_map_is_made(self):
        system = self.begin().start_all()
        system.play(self.log)
        self.assertEqual(set(system.stop_all().values()), {0})
        self.assertEqual(system.stages["geomap-register"].value("missing.RGBD_FRAME"), 0)
        self.assertGreater(system.stages["geomap-mapper"].value("in.PLANES"), 3)

    def test_a_second_copy_is_refused(self):
        system = self.begin().start_all()
        for name in live_system.STAGES:
            second = live_system.Process([str(PROGRAMS / name), "-l", system.url], self.folder)
            second.process.wait(10)
            self.assertEqual(second.stop(), 1)
            self.assertIn("another " + name, second.errors)
            self.assertTrue(system.stages[name].is_running())
            elsewhere = live_system.Process(
                [str(PROGRAMS / name), "-l", system.url, "--channel-prefix", "robot2/"], self.folder)
            time.sleep(2)
            self.assertTrue(elsewhere.is_running())
            self.assertEqual(elsewhere.stop(), 0)

    def test_after_a_restart_of_planes_the_others_go_on(self):
        system = self.begin().start_all()
        system.play(self.log)
        self.assertEqual(system.stages["geomap-planes"].stop(), 0)
        system.start("geomap-planes")
        time.sleep(1.5)
        self.request(self.types.map_request_t.RESET)
        system.play(self.log)
        system.stop_all()
        self.assertGreater(system.stages["geomap-planes"].value("out.PLANES"), 3)
        self.assertEqual(system.stages["geomap-mapper"].value("rejected.PLANES.already_observed"), 0)

    def test_registration_goes_on_from_its_state_after_it_was_killed(self):
        state = str(self.folder / "register_state")
        system = self.begin()
        system.start("geomap-register", "--state", state)
        time.sleep(1.5)
        system.play(self.log)
        before = system.stages["geomap-register"]
        before.stop(live_system.signal.SIGKILL)
        register = system.start("geomap-register", "--state", state)
        time.sleep(1.5)
        self.assertEqual(register.stop(), 0)
        found = re.search(r"(\d+) key frames in the point map, (\d+) points", register.output)
        self.assertGreater(int(found[1]), 3)
        self.assertGreater(int(found[2]), 1000)
        self.assertIn(f"{found[1]} key frames restored", register.errors)

    def test_paused_stages_take_no_frame(self):
        system = self.begin().start_all()
        self.request(self.types.map_request_t.PAUSE)
        system.play(self.log)
        system.stop_all()
        register = system.stages["geomap-register"]
        self.assertEqual(register.value("frames"), 0)
        self.assertGreater(register.value("paused.frames"), 100)

    def test_both_maps_let_go_of_a_dropped_key_frame(self):
        listener = live_system.Listener()
        system = self.begin().start_all()
        without = live_system.Process([str(PROGRAMS / "geomap-mapper"), "-l", system.url,
                                       "--channel-prefix", "without/"], self.folder)
        system.play(self.log)
        planes = list(listener.messages["PLANES"])
        edit = self.types.map_edit_t()
        edit.kind, edit.author = edit.DROP_KEYFRAME, "test"
        edit.T_world_moved.rotation = [1, 0, 0, 0, 1, 0, 0, 0, 1]
        edit.keyframe = self.types.plane_set_t.decode(planes[len(planes) // 2]).utime
        publisher = live_system.Publisher()
        listener.wait_for(
            "MAP_DELTA", lambda data: (self.types.map_delta_t.decode(data).cause ==
                                       self.types.map_delta_t.KEYFRAME_REMOVAL),
            after=lambda: publisher.send("MAP_EDIT", edit.encode()))
        for data in planes[:len(planes) // 2] + planes[len(planes) // 2 + 1:]:
            publisher.send("without/PLANES", data)
        system.stop_all()
        without.stop()
        register, mapper = system.stages["geomap-register"], system.stages["geomap-mapper"]
        self.assertIn(f"{len(planes) - 1} key frames in the point map", register.output)
        self.assertIn(f"of {len(planes) - 1} key frames", mapper.output)
        self.assertEqual(mapper.map_hash(), without.map_hash())

    @staticmethod
    def hostile(kind):
        """Messages of a type that no sender could mean: counts of -1 and 2^31 - 1, cut short, NaN."""
        yield b"\0" * 7
        whole = kind._get_packed_fingerprint() + b"\0" * 400  # pylint: disable=protected-access
        yield from (whole[:cut] for cut in range(0, len(whole), 7))
        for filler in (b"\xff\xff\xff\xff", b"\x7f\xff\xff\xff", b"\x7f\xf8\0\0\0\0\0\0"):
            yield whole[:8] + filler * 200
            yield whole[:8] + b"\0" * 40 + filler * 200

    def test_hostile_messages_are_counted_and_nothing_else_happens(self):
        system = self.begin().start_all()
        import bot_core  # pylint: disable=import-outside-toplevel,import-error
        kinds = {"RGBD_FRAME": self.types.rgbd_frame_t, "POSE": bot_core.pose_t,
                 "CAMERA_TO_BODY": bot_core.rigid_transform_t, "OPENNI_FRAME": bot_core.images_t,
                 "KEYFRAME": self.types.keyframe_t, "KEYFRAME_UPDATE": self.types.keyframe_update_t,
                 "PLANES": self.types.plane_set_t, "MAP_REQUEST": self.types.map_request_t,
                 "MAP_EDIT": self.types.map_edit_t,
                 "MAP_EDIT_REPLY": self.types.map_edit_reply_t, "HEALTH": self.types.health_t}
        messages = [(channel, data) for channel, kind in kinds.items()
                    for data in self.hostile(kind)]
        publisher = live_system.Publisher()
        time.sleep(1)
        before = {name: stage.memory_kb() for name, stage in system.stages.items()}
        end = time.monotonic() + 5
        sent = 0
        while time.monotonic() < end:
            for channel, data in messages:
                publisher.send(channel, data)
                sent += 1
                if sent % 100 == 0:
                    time.sleep(0.01)  # some 10 000 a second
        time.sleep(1)
        for name, stage in system.stages.items():
            self.assertTrue(stage.is_running(), name)
            self.assertLess(stage.memory_kb(), before[name] + 30_000, name)
        system.play(self.log)
        self.assertEqual(set(system.stop_all().values()), {0})
        self.assertGreater(sent, 10_000)
        rejected = sum(int(count) for stage in system.stages.values()
                       for count in re.findall(r"^rejected\.\S+\s+(\d+)", stage.output, re.MULTILINE))
        self.assertGreater(rejected, 10_000)
        self.assertGreater(system.stages["geomap-mapper"].value("in.PLANES"), 3)
        self.assertGreater(int(re.search(r"^(\d+) features",
                                         system.stages["geomap-mapper"].output, re.MULTILINE)[1]), 3)


if __name__ == "__main__":
    PROGRAMS = live_system.enter_namespace(sys.argv[1])
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
