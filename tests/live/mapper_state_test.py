# SPDX-License-Identifier: BSD-3-Clause
"""geomap-mapper and what it keeps: kills, a full disk, saved maps, late joiners.

usage: mapper_state_test.py FOLDER_OF_PROGRAMS [unittest arguments]
"""
import concurrent.futures
import json
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import live_mapper
import live_system

MAPPER = "geomap-mapper"
KILLS = 100
AT_ONCE = 10


class MapperState(live_mapper.FedMapper):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.hashes = cls.hashes_by_key_frames()

    @classmethod
    def start_and_wait(cls, state, prefix="", command=()):
        return cls.start_mapper("--state", str(state), prefix=prefix, command=command)

    @classmethod
    def hashes_by_key_frames(cls):
        """map_hash after each number of key frames, from a mapper that nobody kills."""
        state = cls.folder / "reference"
        mapper = cls.start_and_wait(state)
        hashes = []
        for count in range(len(cls.planes) + 1):
            cls.feed(max(0, count - 1), count)
            cls.request(cls.types.map_request_t.SAVE, f"after-{count}")
            hashes.append(cls.saved_hash(state, f"after-{count}"))
        assert mapper.stop() == 0
        assert mapper.map_hash() == hashes[-1]
        return hashes

    def recovered(self, mapper):
        """Number of key frames and map_hash, as the mapper says when it starts."""
        text = pathlib.Path(mapper.err.name).read_text()
        found = re.search(r"of (\d+) key frames, map_hash (\w+)", text)
        return (int(found[1]), found[2]) if found else (0, self.hashes[0])

    def kill_again_and_again(self, worker, kills):
        """Feeds a mapper and kills it; what comes back must be what it had acknowledged."""
        chance = random.Random(worker)
        prefix, state = f"robot{worker}/", self.folder / f"killed{worker}"
        publisher = live_system.Publisher()
        deltas = self.listener.messages[prefix + "MAP_DELTA"]
        acknowledged = 0
        while True:
            mapper = self.start_and_wait(state, prefix)
            count, found_hash = self.recovered(mapper)
            self.assertEqual(found_hash, self.hashes[count])
            self.assertGreaterEqual(count, acknowledged)
            if kills == 0:
                break
            if count < len(self.planes):
                kills -= 1
                before = len(deltas)
                for data in self.planes[count:count + chance.randint(1, 4)]:
                    publisher.send(prefix + "PLANES", data)
                    time.sleep(chance.uniform(0, 0.004))
                mapper.stop(signal.SIGKILL)
                time.sleep(0.05)
                newest = [self.types.map_delta_t.decode(data).utime for data in deltas[before:]]
                acknowledged = max([count, *(self.utimes.index(utime) + 1 for utime in newest)])
            else:
                mapper.stop(signal.SIGKILL)
                shutil.rmtree(state)
                acknowledged = 0
        mapper.stop()

    def test_killed_at_any_moment_it_comes_back_with_what_it_had_acknowledged(self):
        with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as pool:
            workers = [pool.submit(self.kill_again_and_again, worker, KILLS // AT_ONCE)
                       for worker in range(AT_ONCE)]
            for worker in workers:
                worker.result()

    def test_without_room_it_goes_on_says_so_and_stores_later(self):
        state = self.folder / "full"
        small = ["sh", "-c", 'trap "" XFSZ; ulimit -Sf 16; exec "$@"', "--"]
        mapper = self.start_and_wait(state, command=small)

        def level_is(level):
            return lambda data: (lambda health: health.process == MAPPER and
                                 health.level == level)(self.types.health_t.decode(data))
        self.feed(0, len(self.planes))
        health = self.types.health_t.decode(
            self.listener.wait_for("HEALTH", level_is(self.types.health_t.FAILING)))
        self.assertIn("not stored", health.message)
        self.assertIn(str(state), health.message)
        subprocess.run(["prlimit", "--pid", str(mapper.process.pid), "--fsize=unlimited"], check=True)
        self.listener.wait_for("HEALTH", level_is(self.types.health_t.GOOD))
        mapper.stop(signal.SIGKILL)
        again = self.start_and_wait(state)
        self.assertEqual(self.recovered(again), (len(self.planes), self.hashes[-1]))
        self.assertEqual(again.stop(), 0)

    def test_maps_are_saved_and_loaded_by_name(self):
        state = self.folder / "named"
        mapper = self.start_and_wait(state)
        self.feed(0, 3)
        self.request(self.types.map_request_t.SAVE, "three")
        self.assertEqual(self.saved_hash(state, "three"), self.hashes[3])
        reset = self.types.map_delta_t.decode(self.listener.wait_for(
            "MAP_DELTA", after=lambda: self.request(self.types.map_request_t.CLEAR)))
        self.assertEqual(reset.cause, reset.RESET)
        self.assertGreater(reset.n_removed, 0)
        for name in ("../three", "/etc/passwd", "missing", ""):
            self.request(self.types.map_request_t.LOAD, name)
        self.listener.wait_for(
            "MAP_DELTA", after=lambda: self.request(self.types.map_request_t.LOAD, "three"))
        self.assertEqual(mapper.stop(), 0)
        self.assertEqual(mapper.map_hash(), self.hashes[3])
        self.assertEqual(mapper.value("failed.MAP_REQUEST"), 4)

    def test_a_save_is_answered_in_words(self):
        def answer(name, utime):
            data = self.listener.wait_for(
                "MAP_EDIT_REPLY", lambda data: self.types.map_edit_reply_t.decode(data).command == utime,
                after=lambda: self.request(self.types.map_request_t.SAVE, name, utime))
            reply = self.types.map_edit_reply_t.decode(data)
            self.assertEqual(reply.author, "test")
            return bool(reply.done), reply.text

        mapper = self.start_and_wait(self.folder / "answers")
        self.assertEqual(answer("one", 11), (True, "map saved as one"))
        self.assertEqual(answer("../one", 12), (False, "'../one' is no name for a map"))
        self.assertEqual(mapper.stop(), 0)

    def test_a_late_joiner_has_the_map_within_two_seconds_of_asking(self):
        mapper = self.start_and_wait(self.folder / "late")
        self.feed(0, 3)
        started = time.monotonic()
        data = self.listener.wait_for(
            "MAP_SNAPSHOT", lambda data: self.types.map_t.decode(data).utime == self.utimes[2],
            after=lambda: self.request(self.types.map_request_t.SNAPSHOT))
        self.assertLess(time.monotonic() - started, 1.0)
        self.assertGreater(self.types.map_t.decode(data).n_features, 0)
        mapper.stop(signal.SIGKILL)
        again = self.start_and_wait(self.folder / "late")
        snapshot = self.types.map_t.decode(self.listener.messages["MAP_SNAPSHOT"][-1])
        self.assertEqual(snapshot.utime, self.utimes[2])
        self.assertGreater(snapshot.n_features, 0)
        self.assertEqual(again.stop(), 0)

    def test_moved_key_frames_leave_no_double_walls(self):
        mapper = self.start_and_wait(self.folder / "moved")
        update = self.types.keyframe_update_t()
        update.epoch = 1
        half = len(self.planes) // 2
        self.feed(0, half)
        for data, utime in zip(self.planes[half:], self.utimes[half:]):
            planes = self.types.plane_set_t.decode(data)
            correction = self.types.pose_correction_t()
            correction.keyframe, correction.T_world_camera = utime, planes.T_world_camera
            update.corrections.append(correction)
            planes = self.types.plane_set_t.decode(data)  # with a pose that is 30 cm off
            planes.T_world_camera.translation = [
                x + 0.3 for x in planes.T_world_camera.translation]
            self.listener.wait_for(
                "MAP_DELTA", lambda data, utime=utime: self.types.map_delta_t.decode(data).utime >= utime,
                after=lambda planes=planes: self.publisher.send("PLANES", planes.encode()))
        update.n_corrections = len(update.corrections)
        self.request(self.types.map_request_t.SAVE, "doubled")
        self.assertNotEqual(self.saved_hash(self.folder / "moved", "doubled"), self.hashes[-1])
        self.listener.wait_for(
            "MAP_DELTA", lambda data: (self.types.map_delta_t.decode(data).cause ==
                                       self.types.map_delta_t.POSE_CORRECTION),
            after=lambda: self.publisher.send("KEYFRAME_UPDATE", update.encode()))
        self.assertEqual(mapper.stop(), 0)
        self.assertEqual(mapper.map_hash(), self.hashes[-1])

    def test_a_folder_serves_one_mapper(self):
        state = self.folder / "shared"
        first = self.start_and_wait(state)
        second = self.launch_mapper("--state", str(state), prefix="elsewhere/")
        second.process.wait(10)
        self.assertEqual(second.stop(), 1)
        self.assertIn("another process uses it", second.errors)
        self.assertEqual(first.stop(), 0)


if __name__ == "__main__":
    MapperState.programs = live_system.enter_namespace(sys.argv[1])
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
