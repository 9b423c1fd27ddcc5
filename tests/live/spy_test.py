# SPDX-License-Identifier: BSD-3-Clause
"""geomap-spy on a bus: into a pipe, in a terminal, and without a display.

usage: spy_test.py FOLDER_OF_PROGRAMS [unittest arguments]
"""
import fcntl
import os
import pathlib
import pty
import random
import re
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import threading
import time
import unittest

import live_system


class Senders(threading.Thread):
    """A pose every 10 ms; every 50 ms a frame, but for every tenth, a damaged one, and noise."""

    def __init__(self, types):
        super().__init__(daemon=True)
        import bot_core  # pylint: disable=import-outside-toplevel,import-error
        self.frame, self.pose = types.rgbd_frame_t(), bot_core.pose_t()
        self.frame.depth.data = self.frame.color.data = b""  # lcm-gen's default cannot be encoded
        self.pose.orientation = [1.0, 0.0, 0.0, 0.0]
        self.is_wanted = True
        self.start()

    def run(self):
        publisher, noise = live_system.Publisher(), random.Random(1)
        begin, step = time.monotonic(), 0
        while self.is_wanted:
            self.pose.utime = int(1e6 * time.time()) - 40_000
            publisher.send("robot/POSE", self.pose.encode())
            if step % 5 == 0:
                self.frame.sequence = step // 5
                self.frame.utime = self.pose.utime
                if self.frame.sequence % 10 != 3:
                    publisher.send("RGBD_FRAME", self.frame.encode())
                data = noise.randbytes(noise.randrange(100))
                publisher.send(f"NOISE\x1b[{noise.randrange(3)}", data)
                publisher.send("RGBD_FRAME", self.frame.encode()[:8] + data)
            step += 1
            time.sleep(max(0.0, begin + 0.01 * step - time.monotonic()))

    def stop(self):
        self.is_wanted = False
        self.join()


class Spy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            cls.types = live_system.message_types(pathlib.Path(folder))

    def spy(self, *options):
        return subprocess.run([str(PROGRAMS / "geomap-spy"), *options],
                              capture_output=True, text=True, timeout=60, check=False)

    def send(self):
        senders = Senders(self.types)
        self.addCleanup(senders.stop)

    @staticmethod
    def table(text):
        rows = [re.split(r"  +", line.strip()) for line in text.splitlines()]
        head = next(row for row in rows if row[0] == "channel")
        return {row[0]: dict(zip(head, row)) for row in rows
                if len(row) == len(head) and row != head}

    def test_once_prints_rates_losses_latencies_and_what_cannot_be_decoded(self):
        self.send()
        spy = self.spy("--once", "5")
        self.assertEqual((spy.returncode, spy.stderr), (0, ""))
        table = self.table(spy.stdout)
        pose, frame = table["robot/POSE"], table["RGBD_FRAME"]
        self.assertEqual((pose["type"], frame["type"]), ("bot_core.pose_t", "geomap.rgbd_frame_t"))
        self.assertAlmostEqual(float(pose["Hz"]), 100, delta=15)
        self.assertAlmostEqual(float(frame["Hz"]), 38, delta=6)
        self.assertRegex(pose["bandwidth"], r"^1[0-9]\.\d kB/s$")
        self.assertEqual(pose["missing"], "-")
        self.assertAlmostEqual(int(frame["missing"]), 10, delta=2)
        self.assertAlmostEqual(float(pose["latency"].split()[0]), 40, delta=20)
        self.assertEqual(pose["undecodable"], "0")
        self.assertAlmostEqual(int(frame["undecodable"]), 100, delta=15)
        self.assertEqual(table["NOISE?[0"]["type"], "unknown")
        self.assertNotIn("\x1b", spy.stdout)

    def test_channels_and_fields_can_be_chosen_and_a_prefix_given(self):
        self.send()
        spy = self.spy("--once", "1", "--channel-prefix", "robot/", "--channel", "P.*",
                       "--fields", "POSE.orientation")
        self.assertEqual(list(self.table(spy.stdout)), ["POSE"])
        self.assertIn("\nPOSE\n  orientation: 1 0 0 0 (4)\n", spy.stdout)

    def test_where_nothing_is_heard_the_exit_status_says_so(self):
        spy = self.spy("--once", "0.5", "--channel", "NOBODY")
        self.assertEqual((spy.returncode, spy.stdout), (1, ""))
        self.assertRegex(spy.stderr, r"^geomap-spy: nothing was heard[^\n]*\n$")

    def test_mistakes_are_told_in_a_line(self):
        for wrong in (["--channel", "["], ["--once", "-1"], ["--once", "soon"]):
            spy = self.spy(*wrong)
            self.assertEqual(spy.returncode, 2)
            self.assertRegex(spy.stderr, r"^geomap-spy: [^\n]*\n$")

    def test_without_a_display_the_text_is_recommended(self):
        without = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        for environment in (without, {**without, "DISPLAY": ":99999"}):
            spy = subprocess.run([str(PROGRAMS / "geomap-spy")], env=environment, timeout=60,
                                 capture_output=True, text=True, check=False)
            self.assertEqual((spy.returncode, spy.stdout), (1, ""))
            self.assertRegex(spy.stderr, r"^geomap-spy: (no display|the graphical[^\n]*);"
                                         r"[^\n]*use --text[^\n]*\n$")

    def test_a_terminal_is_painted_in_place_until_ctrl_c(self):
        self.send()
        ours, theirs = pty.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 6, 60, 0, 0))
        spy = subprocess.Popen([str(PROGRAMS / "geomap-spy"), "--text", "--fields", "RGBD_FRAME"],
                               stdin=theirs, stdout=theirs, stderr=theirs)
        os.close(theirs)
        time.sleep(3.5)
        spy.send_signal(signal.SIGINT)
        self.assertEqual(spy.wait(10), 0)
        painted = os.read(ours, 1 << 16).decode()
        os.close(ours)
        paintings = painted.split("\x1b[H")[1:]
        self.assertIn(len(paintings), (3, 4, 5))
        for painting in paintings:
            lines = re.sub(r"\x1b\[[KJ]", "", painting).split("\r\n")
            self.assertLessEqual(len(lines), 6)
            self.assertLessEqual(max(len(line) for line in lines), 60)
        self.assertIn("more lines", paintings[-1])


if __name__ == "__main__":
    PROGRAMS = live_system.enter_namespace(sys.argv[1])
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
