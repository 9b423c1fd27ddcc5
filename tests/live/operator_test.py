# SPDX-License-Identifier: BSD-3-Clause
"""The operator's window before a running mapper, worked with mouse and keys.

usage: operator_test.py FOLDER_OF_PROGRAMS [unittest arguments]
"""
import json
import math
import os
import random
import shutil
import subprocess
import sys
import time
import unittest

import live_mapper
import live_system

WIDTH, HEIGHT = 1280, 800
SCENE = (250, 40, 1010, 752)  # left, top, right, bottom of the drawing in the window
FIELD = 0.9                   # of the view [rad]
DISTANCE = 7.0                # of the eye [m]
FURTHER = 100                 # key frames after an edit


class Display:
    """An X server without a screen."""

    def __init__(self, folder):
        read, write = os.pipe()
        self.process = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-nolisten",
             "tcp"], pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            cwd=folder)
        os.close(write)
        with os.fdopen(read) as pipe:
            self.name = ":" + pipe.readline().strip()

    def xdotool(self, *words):
        return subprocess.run(["xdotool", *words], env={**os.environ, "DISPLAY": self.name},
                              check=True, capture_output=True, text=True).stdout

    def stop(self):
        self.process.terminate()
        self.process.wait()


class Operator(live_mapper.FedMapper):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.display = Display(cls.folder)
        cls.state = cls.folder / "state"
        cls.preferences = cls.folder / "viewer.json"
        # Straight down, so that where a point is drawn is known here without asking the viewer.
        cls.preferences.write_text(json.dumps(
            {"bookmark.1": f"0 0 0 {DISTANCE} {-math.pi / 2} {math.pi / 2} orthographic"}))

    @classmethod
    def tearDownClass(cls):
        cls.display.stop()
        super().tearDownClass()

    def setUp(self):
        shutil.rmtree(self.state, ignore_errors=True)
        self.processes = []
        self.mapper = self.start("mapper")
        self.feed(0, len(self.planes))
        self.saves = 0

    def tearDown(self):
        for process in self.processes:
            if process.is_running():
                process.stop()

    def start(self, what, *options):
        if what == "mapper":
            process = self.start_mapper("--state", str(self.state))
        else:
            os.environ["DISPLAY"] = self.display.name
            process = live_system.Process(
                [str(self.programs / "geomap-viewer"), "-l", live_system.UDP, "--preferences",
                 str(self.preferences), "--size", f"{WIDTH},{HEIGHT}", *options], self.folder)
        self.processes.append(process)
        return process

    def start_viewer(self):
        viewer = self.start("viewer")
        self.display.xdotool("search", "--sync", "--onlyvisible", "--name", "geomap")
        time.sleep(2.0)  # within which the whole map is there
        self.press("1")
        return viewer

    # Mouse and keys.

    def press(self, *keys):
        for key in keys:
            self.display.xdotool("key", key)
            time.sleep(0.3)
        time.sleep(0.5)

    def type(self, text):
        self.display.xdotool("type", "--delay", "60", text)
        time.sleep(0.3)

    def click(self, pixel, count=1):
        self.display.xdotool("mousemove", *(str(round(number)) for number in pixel))
        time.sleep(0.3)
        for _ in range(count):
            self.display.xdotool("click", "1")
            time.sleep(0.5)

    @staticmethod
    def pixel_of(point):
        """Where the view from straight above draws a point [px]."""
        left, top, right, bottom = SCENE
        scale = 0.5 * (bottom - top) / (DISTANCE * math.tan(0.5 * FIELD))
        return (0.5 * (left + right) + scale * point[0], 0.5 * (top + bottom) - scale * point[1])

    # The mapper's side.

    def saved(self):
        """The map as it is now: its file and the same as JSON."""
        self.saves += 1
        name = f"step{self.saves}"
        self.request(self.types.map_request_t.SAVE, name)
        self.saved_hash(self.state, name)
        return self.state / f"{name}.lcmlog", self.exported(self.state / f"{name}.lcmlog")

    def offline(self, file, *words):
        """map_hash after an edit of a saved map, by geomap-edit."""
        out = self.folder / "expected.lcmlog"
        subprocess.run([str(self.programs / "geomap-edit"), words[0], "--map", str(file), "-o", str(out),
                        *words[1:]], check=True, capture_output=True)
        return self.exported(out)["hash"]

    def edit_by(self, action):
        """The command that the viewer sends on an action, and the mapper's answer."""
        seen = len(self.listener.messages["MAP_EDIT"])
        answer = self.types.map_edit_reply_t.decode(
            self.listener.wait_for("MAP_EDIT_REPLY", after=action, timeout=20.0))
        command = self.types.map_edit_t.decode(self.listener.messages["MAP_EDIT"][seen])
        self.assertEqual((command.author, command.command), (answer.author, answer.command))
        return command, answer

    def visible_point(self, features, feature):
        """A point of a level polygon that is seen from above, far from all edges."""
        chance = random.Random(1)
        rings = [[corner[:2] for corner in polygon["outer"]] for polygon in feature["polygons"]]
        holes = [[corner[:2] for corner in hole]
                 for polygon in feature["polygons"] for hole in polygon["holes"]]
        low = [min(corner[i] for ring in rings for corner in ring) for i in range(2)]
        high = [max(corner[i] for ring in rings for corner in ring) for i in range(2)]
        edges = [edge for other in features for polygon in other["polygons"]
                 for ring in [polygon["outer"], *polygon["holes"]]
                 for edge in zip(ring, ring[1:] + ring[:1])]
        for _ in range(20000):
            point = [chance.uniform(low[i], high[i]) for i in range(2)]
            if not any(is_inside(ring, point) for ring in rings):
                continue
            if any(is_inside(hole, point) for hole in holes):
                continue
            if min(distance(point, a, b) for a, b in edges) < 0.12:
                continue
            above = [other for other in features if other["id"] != feature["id"] and
                     any(is_inside([c[:2] for c in polygon["outer"]], point)
                         for polygon in other["polygons"])
                     and polygon_height(other) > polygon_height(feature)]
            if not above:
                return point
        raise AssertionError("no point of it is seen from above")

    def further_keyframes(self, count):
        """The robot goes on looking at the same things."""
        utime = max(self.utimes)
        for i in range(count):
            planes = self.types.plane_set_t.decode(self.planes[i % len(self.planes)])
            utime += 100_000
            planes.utime, planes.sequence = utime, len(self.planes) + i
            self.feed_one(utime, planes.encode())

    def test_an_operator_deletes_moves_undoes_redoes_and_saves_with_mouse_and_keys(self):
        before, features = self.saved()
        viewer = self.start_viewer()
        level = sorted((feature for feature in features["features"] if feature["normal"][2] > 0.9),
                       key=polygon_height)
        floor, top = level[0], level[-1]
        self.assertNotEqual(floor["id"], top["id"])

        self.click(self.pixel_of(self.visible_point(features["features"], top)))
        command, answer = self.edit_by(lambda: self.press("Delete"))
        self.assertEqual(self.target_of(command), top["id"])
        self.assertTrue(answer.done, answer.text)
        deleted, after_delete = self.saved()
        self.assertEqual(after_delete["hash"], self.offline(before, "delete", top["id"]))

        self.click(self.pixel_of(self.visible_point(after_delete["features"], floor)))
        self.press("m")
        time.sleep(1.0)
        self.click((1065, 85), count=2)  # the number field "along normal"
        self.press("ctrl+a")
        self.type("0.25")
        time.sleep(1.0)
        command, answer = self.edit_by(lambda: self.press("Return"))
        self.assertEqual(self.target_of(command), floor["id"])
        self.assertTrue(answer.done, answer.text)
        shift = command.T_world_moved.translation
        for axis in range(3):
            self.assertAlmostEqual(shift[axis], 0.25 * floor["normal"][axis], places=5)
        _, after_move = self.saved()
        self.assertEqual(after_move["hash"],
                         self.offline(deleted, "move", floor["id"], "--about", "0,0,0",
                                      "--translate", ",".join(repr(number) for number in shift)))

        _, answer = self.edit_by(lambda: self.press("ctrl+z"))
        self.assertTrue(answer.done, answer.text)
        self.assertEqual(self.saved()[1]["hash"], after_delete["hash"])
        _, answer = self.edit_by(lambda: self.press("ctrl+y"))
        self.assertTrue(answer.done, answer.text)
        self.assertEqual(self.saved()[1]["hash"], after_move["hash"])

        self.press("ctrl+s")
        self.press("ctrl+a")
        self.type("by-hand")
        reply = self.types.map_edit_reply_t.decode(self.listener.wait_for(
            "MAP_EDIT_REPLY", after=lambda: self.press("Return")))
        self.assertTrue(reply.done, reply.text)
        self.assertEqual(self.saved_hash(self.state, "by-hand"), after_move["hash"])

        self.further_keyframes(FURTHER)
        _, later = self.saved()
        point = self.visible_point(features["features"], top)
        covering = [feature for feature in later["features"]
                    if abs(polygon_height(feature) - polygon_height(top)) < 0.1 and
                    feature["normal"][2] > 0.9 and
                    any(is_inside([c[:2] for c in polygon["outer"]], point)
                        for polygon in feature["polygons"])]
        self.assertEqual(covering, [], "the deleted polygon is back")
        self.assertTrue(viewer.is_running())
        self.assertEqual(viewer.stop(), 0, viewer.errors)

    def test_a_mapper_that_starts_anew_is_followed_and_rubbish_does_no_harm(self):
        viewer = self.start_viewer()
        chance = random.Random(2)
        for channel in ("MAP_DELTA", "MAP_SNAPSHOT", "MAP_EDIT_REPLY", "MAP_EDIT_RECORD",
                        "POINT_MAP", "KEYFRAME", "PLANES", "RGBD_FRAME", "CAMERA_POSE", "HEALTH"):
            for size in (0, 1, 8, 30, 500, 5000):
                self.publisher.send(channel, chance.randbytes(size))
            for data in self.listener.messages[channel][-1:]:
                for cut in range(0, len(data), max(1, len(data) // 40)):
                    self.publisher.send(channel, data[:cut])
        time.sleep(1.0)
        self.assertTrue(viewer.is_running())
        self.mapper.stop()
        self.mapper = self.start("mapper")
        time.sleep(2.0)
        _, features = self.saved()
        target = max(features["features"], key=polygon_height_of_level)
        self.click(self.pixel_of(self.visible_point(features["features"], target)))
        command, answer = self.edit_by(lambda: self.press("k"))
        self.assertEqual(self.target_of(command), target["id"])
        self.assertTrue(answer.done, answer.text)
        self.assertEqual(viewer.stop(), 0, viewer.errors)

    @staticmethod
    def target_of(command):
        return "-".join(str(number) for number in (command.targets[0].keyframe,
                                                   command.targets[0].plane))


def is_inside(ring, point):
    inside = False
    for (ax, ay), (bx, by) in zip(ring, ring[1:] + ring[:1]):
        if (ay > point[1]) != (by > point[1]) and \
                point[0] < ax + (point[1] - ay) * (bx - ax) / (by - ay):
            inside = not inside
    return inside


def distance(point, a, b):
    """Of a point from a piece of an edge, seen from above."""
    along = (b[0] - a[0], b[1] - a[1])
    squared = along[0] ** 2 + along[1] ** 2
    share = 0.0 if squared == 0.0 else max(0.0, min(1.0, (
        (point[0] - a[0]) * along[0] + (point[1] - a[1]) * along[1]) / squared))
    return math.dist(point, (a[0] + share * along[0], a[1] + share * along[1]))


def polygon_height(feature):
    corners = [corner for polygon in feature["polygons"] for corner in polygon["outer"]]
    return sum(corner[2] for corner in corners) / len(corners)


def polygon_height_of_level(feature):
    return polygon_height(feature) if feature["normal"][2] > 0.9 else -1.0


if __name__ == "__main__":
    Operator.programs = live_system.enter_namespace(sys.argv[1])
    MISSING = [tool for tool in ("Xvfb", "xdotool") if shutil.which(tool) is None]
    if MISSING:
        live_system.skip("not installed: " + ", ".join(MISSING))
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
