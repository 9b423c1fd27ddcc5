# SPDX-License-Identifier: BSD-3-Clause
"""A running geomap-mapper that is fed, key frame by key frame, with what a simulated robot sees."""
import json
import pathlib
import subprocess
import tempfile
import time
import unittest

import live_system


class FedMapper(unittest.TestCase):
    """Its planes are those of a robot that turns before the kitchen."""

    programs = None  # folder, set by the test's main

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.log = live_system.simulate(cls.programs, cls.folder)
        cls.derived = cls.folder / "derived.lcmlog"
        subprocess.run([str(cls.programs / "geomap-replay"), str(cls.log), "-o",
                        str(cls.folder / "replay"), "--log-out", str(cls.derived)],
                       check=True, capture_output=True)
        cls.planes = [data for channel, data in live_system.read_log(cls.derived)
                      if channel == "PLANES"]
        cls.types = live_system.message_types(cls.folder / "types")
        cls.utimes = [cls.types.plane_set_t.decode(data).utime for data in cls.planes]
        cls.listener = live_system.Listener()
        cls.publisher = live_system.Publisher()

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def launch_mapper(cls, *options, prefix="", command=()):
        """command: that shall run it."""
        return live_system.Process(
            [*command, str(cls.programs / "geomap-mapper"), "-l", live_system.UDP, *options,
             *(["--channel-prefix", prefix] if prefix else [])], cls.folder)

    @classmethod
    def start_mapper(cls, *options, prefix="", command=()):
        """Returns once it publishes; it is silent for a second."""
        started = time.time_ns() // 1000
        mapper = cls.launch_mapper(*options, prefix=prefix, command=command)
        cls.listener.wait_for(prefix + "MAP_SNAPSHOT",
                              lambda data: cls.types.map_t.decode(data).epoch >= started)
        return mapper

    @classmethod
    def feed_one(cls, utime, planes):
        """Sends a key frame and waits until it is in the map."""
        cls.listener.wait_for("MAP_DELTA",
                              lambda data: cls.types.map_delta_t.decode(data).utime >= utime,
                              after=lambda: cls.publisher.send("PLANES", planes))

    @classmethod
    def feed(cls, first, end):
        for i in range(first, end):
            cls.feed_one(cls.utimes[i], cls.planes[i])

    @classmethod
    def request(cls, kind, name="", utime=0):
        """utime: 0 has no number and is not answered."""
        message = cls.types.map_request_t()
        message.kind, message.author, message.name, message.utime = kind, "test", name, utime
        cls.publisher.send("MAP_REQUEST", message.encode())

    @classmethod
    def exported(cls, file):
        """A saved map as JSON."""
        out = cls.folder / "exported.json"
        subprocess.run([str(cls.programs / "geomap-export"), str(file), str(out)], check=True,
                       capture_output=True)
        return json.loads(out.read_text())

    @classmethod
    def saved_hash(cls, state, name):
        """map_hash of a map that was saved by name."""
        file = state / f"{name}.lcmlog"
        for _ in range(200):
            if file.exists():
                break
            time.sleep(0.02)
        return cls.exported(file)["hash"]
