# SPDX-License-Identifier: BSD-3-Clause
"""Operators' edits on a running system: done, answered, replayed, and not lost by a kill.

usage: edit_test.py FOLDER_OF_PROGRAMS [unittest arguments]
"""
import json
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import live_mapper
import live_system

MAPPER = "geomap-mapper"
EDITS = "(RGBD_FRAME|POSE|CAMERA_TO_BODY|MAP_EDIT|MAP_EDIT_REPLY)"
RESTARTS = 5
FLOOD = 10_000


class Edits(live_mapper.FedMapper):
    def setUp(self):
        self.processes = []

    def tearDown(self):
        for process in self.processes:
            if process.is_running():
                process.stop()

    @classmethod
    def replay(cls, log, *options):
        """map_hash of a replay."""
        done = subprocess.run([str(cls.programs / "geomap-replay"), str(log), "-o",
                               str(cls.folder / "replay"), *options],
                              check=True, capture_output=True, text=True)
        return re.search(r"map_hash (\w+)", done.stdout)[1]

    def start(self, *options):
        self.processes.append(self.start_mapper(*options))
        return self.processes[-1]

    def edit(self, *words, status=0):
        """What geomap-edit prints."""
        done = subprocess.run([str(self.programs / "geomap-edit"), words[0], "-l", live_system.UDP,
                               "--timeout", "20", *words[1:]],
                              check=False, capture_output=True, text=True)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout if status == 0 else done.stderr

    def features(self):
        return json.loads(self.edit("list", "--json"))

    def edits_left(self):
        """Numbers of the edits that could be undone."""
        return [edit["number"] for edit in json.loads(self.edit("history", "--json"))
                if edit["state"] != "undone" and not edit["text"].startswith("undo")]

    def hash_without_edits(self):
        mapper = self.start()
        self.feed(0, len(self.planes))
        self.assertEqual(mapper.stop(), 0)
        return mapper.map_hash()

    def thirds(self):
        """The log in three."""
        thirds = []
        for name, options in (("first", ["--to", "1.4"]), ("second", ["--from", "1.4", "--to", "2.7"]),
                              ("third", ["--from", "2.7"])):
            third = self.folder / f"{name}.lcmlog"
            subprocess.run([str(self.programs / "geomap-log"), "cut", str(self.log), str(third), *options],
                           check=True, capture_output=True)
            thirds.append(third)
        return thirds

    def test_a_log_with_edits_gives_the_edited_map_in_one_process_and_through_all(self):
        first, second, third = self.thirds()
        log = self.folder / "edited.lcmlog"
        system = live_system.System(self.programs, self.folder).start_all()
        self.processes += system.stages.values()
        logger = live_system.Process(["lcm-logger", "-q", f"--lcm-url={live_system.UDP}", "-c", EDITS,
                                      str(log)], self.folder)
        time.sleep(1.0)
        system.play(first, 0.5)
        time.sleep(1.0)
        self.edit("label", "1", "floor")
        self.edit("move", "2", "--along-normal", "0.1")
        self.edit("delete", "3")
        keyframe = self.features()[0]["id"].split("-")[0]
        self.edit("drop-keyframe", keyframe)
        self.edit("lock", "1")
        time.sleep(0.5)
        system.play(second, 0.5)
        time.sleep(1.0)
        self.edit("undo", "4")  # of the drop
        time.sleep(0.5)
        system.play(third, 0.5)
        time.sleep(1.0)
        self.edit("undo")
        self.edit("redo")
        self.edit("add", "0,0,0", "1,0,0", "1,1,0", "--label", "-1")
        self.assertEqual(set(system.stop_all().values()), {0})
        logger.stop()
        frames = sum(channel == "RGBD_FRAME" for channel, _ in live_system.read_log(log))
        self.assertEqual(system.stages["geomap-register"].value("frames"), frames)
        live = system.stages[MAPPER].map_hash()
        self.assertNotEqual(live, self.replay(self.log))
        self.assertEqual(self.replay(log), live)
        self.assertEqual(self.replay(log, "--threads", "3"), live)

        again = live_system.System(self.programs, self.folder, options=["--lossless"]).start_all()
        self.processes += again.stages.values()
        subprocess.run(["lcm-logplayer", "-e", EDITS, "-l", live_system.UDP, str(log)], check=True,
                       capture_output=True)
        time.sleep(1.0)
        self.assertEqual(set(again.stop_all().values()), {0})
        self.assertEqual(again.stages[MAPPER].map_hash(), live)
        self.assertEqual(again.stages["geomap-register"].output.splitlines()[-1],
                         system.stages["geomap-register"].output.splitlines()[-1])

    def test_edits_outlive_kills_and_can_all_be_undone(self):
        expected = self.hash_without_edits()
        chance = random.Random(3)
        for turn in range(RESTARTS):
            state = self.folder / f"killed{turn}"
            mapper = self.start("--state", str(state))
            kill_at = chance.randrange(1, len(self.planes))
            self.feed(0, 1)
            for i in range(1, len(self.planes)):
                number = str(chance.randrange(1, len(self.features()) + 1))
                words = chance.choice([["label", number, "wall"], ["lock", number],
                                       ["move", number, "--translate", "0.1,0,0.2"],
                                       ["delete", number]])
                command = subprocess.Popen([str(self.programs / "geomap-edit"), words[0], "-l",
                                            live_system.UDP, *words[1:]], stdout=subprocess.PIPE,
                                           stderr=subprocess.PIPE, text=True)
                if i == kill_at:
                    time.sleep(chance.uniform(0.0, 0.05))
                    mapper.stop(signal.SIGKILL)
                    mapper = self.start("--state", str(state))
                answer, _ = command.communicate()
                done = re.match(r"edit (\d+)", answer)
                if done:  # what was answered is there
                    numbers = [e["number"] for e in json.loads(self.edit("history", "--json"))]
                    self.assertIn(int(done[1]), numbers)
                self.feed(i, i + 1)
            while self.edits_left():
                self.edit("undo")
            self.assertEqual(mapper.stop(), 0)
            self.assertEqual(mapper.map_hash(), expected)

    def send(self, kind, author="ann", command=0, targets=(), **fields):
        message = self.types.map_edit_t()
        message.kind, message.author, message.command = kind, author, command
        for target in targets:
            keyframe, plane = target.split("-", 1)
            observation = self.types.observation_id_t()
            observation.keyframe, observation.plane = int(keyframe), int(plane)
            message.targets.append(observation)
        message.n_targets = len(message.targets)
        message.T_world_moved.rotation = [1, 0, 0, 0, 1, 0, 0, 0, 1]
        for name, value in fields.items():
            setattr(message, name, value)
        return message.encode()

    def answer(self, data, author, command):
        def is_it(reply):
            reply = self.types.map_edit_reply_t.decode(reply)
            return (reply.author, reply.command) == (author, command)
        return self.types.map_edit_reply_t.decode(self.listener.wait_for(
            "MAP_EDIT_REPLY", is_it, after=lambda: self.publisher.send("MAP_EDIT", data)))

    def test_two_operators_are_each_told_and_a_command_sent_twice_is_done_once(self):
        mapper = self.start()
        self.feed(0, 4)
        kinds = self.types.map_edit_t
        table = self.features()[-1]["id"]
        first = self.answer(self.send(kinds.DELETE, "ann", 7, [table]), "ann", 7)
        second = self.answer(self.send(kinds.LABEL, "bob", 7, [table], label="x"), "bob", 7)
        again = self.answer(self.send(kinds.DELETE, "ann", 7, [table]), "ann", 7)
        self.assertTrue(first.done)
        self.assertEqual((second.done, again.done, again.edit), (False, True, first.edit))
        self.assertIn("delete by ann, edit 1", second.text)
        self.assertEqual(len(json.loads(self.edit("history", "--json"))), 1)
        self.assertIn("no edit 99", self.edit("undo", "99", status=1))
        stale = self.answer(self.send(kinds.UNDO, "ann", 8, epoch=1), "ann", 8)
        self.assertIn("started anew", stale.text)
        self.assertEqual(mapper.stop(), 0)

    def test_a_command_that_is_sent_again_after_a_kill_is_not_done_again(self):
        state = str(self.folder / "again")
        mapper = self.start("--state", state)
        self.feed(0, 4)
        kinds = self.types.map_edit_t
        epoch = self.types.map_t.decode(self.listener.messages["MAP_SNAPSHOT"][-1]).epoch
        known = self.features()[0]["id"]
        command = self.send(kinds.MOVE, "ann", 5, [known], epoch=epoch)
        first = self.answer(command, "ann", 5)
        mapper.stop(signal.SIGKILL)
        mapper = self.start("--state", state)
        again = self.answer(command, "ann", 5)
        self.assertEqual((first.done, again.done, first.edit, again.edit), (True, True, 1, 1))
        refused = self.send(kinds.REDO, "ann", 6)
        self.assertIn("nothing to redo", self.answer(refused, "ann", 6).text)
        self.edit("undo")
        self.assertFalse(self.answer(refused, "ann", 6).done)  # though it could be done now
        self.assertEqual(mapper.stop(), 0)

    def test_a_dry_run_changes_nothing(self):
        mapper = self.start()
        self.feed(0, len(self.planes))
        self.assertIn("would be edit 1: delete", self.edit("delete", "1", "--dry-run"))
        self.assertIn("no edits", self.edit("history"))
        self.assertEqual(mapper.stop(), 0)
        self.assertEqual(mapper.map_hash(), self.hash_without_edits())

    def test_nonsense_and_floods_are_answered_or_counted_and_leave_the_map_alone(self):
        expected = self.hash_without_edits()
        mapper = self.start()
        self.feed(0, len(self.planes))
        kinds = self.types.map_edit_t
        corner, far, bad = (self.types.point_t() for _ in range(3))
        far.position, bad.position = [1e300, 0, 0], [float("nan"), 0, 0]
        known = self.features()[0]["id"]
        nonsense = [self.send(99), self.send(-1), self.send(kinds.DELETE),
                    self.send(kinds.DELETE, targets=["1-1"]),
                    self.send(kinds.UNDO), self.send(kinds.REDO), self.send(kinds.RESTORE),
                    self.send(kinds.MERGE, targets=[known, known]),
                    self.send(kinds.SPLIT, targets=[known], n_points=2, points=[corner, corner]),
                    self.send(kinds.CUT, targets=[known], n_points=3, points=[corner] * 3),
                    self.send(kinds.ADD, n_points=3, points=[corner, corner, far]),
                    self.send(kinds.LABEL, targets=[known], label="x" * 500),
                    self.send(kinds.LABEL, author="y" * 500, targets=[known], label="x"),
                    self.send(kinds.DROP_KEYFRAME, keyframe=5)]
        before = len(self.listener.messages["MAP_EDIT_REPLY"])
        for data in nonsense:
            self.listener.wait_for("MAP_EDIT_REPLY",
                                   after=lambda data=data: self.publisher.send("MAP_EDIT", data))
        replies = [self.types.map_edit_reply_t.decode(data)
                   for data in self.listener.messages["MAP_EDIT_REPLY"][before:]]
        self.assertEqual(len(replies), len(nonsense))
        self.assertFalse(any(reply.done for reply in replies))
        self.assertTrue(all(reply.text for reply in replies))

        for data in (self.send(kinds.ADD, n_points=3, points=[corner, corner, bad]),
                     self.send(kinds.DELETE, targets=[known])[:-3]):  # which nobody can answer
            self.publisher.send("MAP_EDIT", data)
        for i in range(FLOOD):  # within a second
            self.publisher.send("MAP_EDIT", nonsense[i % len(nonsense)])
            if i % 100 == 0:
                time.sleep(0.005)
        time.sleep(1.0)
        self.assertIn("no edits", self.edit("history"))
        self.assertEqual(mapper.stop(), 0)
        self.assertEqual(mapper.map_hash(), expected)
        self.assertEqual(sum(mapper.value(f"rejected.MAP_EDIT.{reason}")
                             for reason in ("not_finite", "truncated")), 2)
        self.assertGreater(mapper.value("edits.refused"), 0.9 * FLOOD)


if __name__ == "__main__":
    Edits.programs = live_system.enter_namespace(sys.argv[1])
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
