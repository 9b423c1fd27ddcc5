# SPDX-License-Identifier: BSD-3-Clause
"""geomap-edit on a saved map.

usage: edit_program_test.py FOLDER_OF_PROGRAMS [unittest arguments]
"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]


class EditProgram(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        log = cls.folder / "sweep.lcmlog"
        subprocess.run([PROGRAMS / "geomap-sim", "--scene", SOURCE / "config/scenes/kitchen.yaml",
                        "--trajectory", SOURCE / "config/trajectories/sweep.yaml", "--rate", "2",
                        "--log", log], check=True, capture_output=True)
        subprocess.run([PROGRAMS / "geomap-replay", log, "-o", cls.folder / "out"], check=True,
                       capture_output=True)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def setUp(self):
        self.map = self.folder / "map.lcmlog"
        shutil.copy(self.folder / "out" / "map.lcmlog", self.map)

    def edit(self, command, *words, status=0):
        done = subprocess.run([PROGRAMS / "geomap-edit", command, "--map", self.map, *words],
                              check=False, capture_output=True, text=True)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 0 if status == 0 else 1, done.stderr)
        return done.stdout + done.stderr

    def exported(self):
        out = self.folder / "map.json"
        subprocess.run([PROGRAMS / "geomap-export", self.map, out], check=True)
        return json.loads(out.read_text())

    def features(self, *words):
        return json.loads(self.edit("list", "--json", *words))

    def test_every_command_does_what_it_says_and_can_be_undone(self):
        before = self.exported()
        corners = ["-1,0,0.7", "-0.5,0,0.7", "-0.5,1,0.7", "-1,1,0.7"]
        keyframe = self.features()[0]["id"].split("-")[0]
        for words in (["delete", "1", "2"], ["move", "3", "--translate", "-0.1,0,0"],
                      ["move", "3", "--along-normal", "0.1", "--rotate-deg", "5", "--axis", "0,0,1"],
                      ["merge", "3", "4"], ["lock", "1"], ["label", "1", "2", "wall"],
                      ["split", "1", "--from", "-0.6,0,0", "--to", "-0.6,1,0"],
                      ["cut", "1", "-1.5,0,0", "-0.5,0,0", "-0.5,1,0", "-1.5,1,0"],
                      ["add", *corners, "--label", "desk"], ["drop-keyframe", keyframe]):
            text = self.edit(*words)
            self.assertRegex(text, r"^edit \d+: " + words[0].split("-")[0])
            self.assertNotEqual(self.exported()["hash"], before["hash"], words)
            self.assertIn("undo of edit", self.edit("undo"))
            self.assertEqual(self.exported()["hash"], before["hash"], words)
        self.assertIn("nothing to undo", self.edit("undo", status=1))
        self.assertEqual(len(json.loads(self.edit("history", "--json"))), 20)

    def test_a_deleted_surface_is_in_the_map_as_a_veto_until_it_is_restored(self):
        gone = self.features()[4]
        self.edit("delete", gone["id"])
        vetoes = self.exported()["vetoes"]
        self.assertEqual([(veto["edit"], veto["held"], veto["feature"]) for veto in vetoes],
                         [(1, False, gone["id"])])
        self.assertNotIn(gone["id"], [feature["id"] for feature in self.features()])
        self.edit("restore", "1")
        self.assertEqual(self.exported()["vetoes"], [])
        self.assertIn(gone["id"], [feature["id"] for feature in self.features()])
        self.assertIn("revoked", self.edit("history"))

    def test_lists_are_for_people_and_for_programs(self):
        self.edit("label", "1", "floor")
        self.edit("lock", "2")
        self.assertRegex(self.edit("list"), r"#  id .*label\n +1 .* up .* floor\n +2 .*\(held\)\n")
        self.assertEqual([feature["label"] for feature in self.features("--where", "label=floor")],
                         ["floor"])
        self.assertEqual([feature["held"] for feature in self.features("--where", "held=1")], [True])
        self.assertEqual(self.features("--where", "area>1000"), [])
        answer = json.loads(self.edit("label", "1", "", "--json"))
        self.assertEqual((answer["done"], answer["edit"]), (True, 3))

    def test_a_dry_run_or_another_output_leaves_the_file_alone(self):
        before = self.map.read_bytes()
        self.assertIn("would be edit 1", self.edit("delete", "1", "--dry-run"))
        self.edit("delete", "1", "-o", self.folder / "other.lcmlog")
        self.assertEqual(self.map.read_bytes(), before)
        self.assertTrue((self.folder / "other.lcmlog").exists())

    def test_what_cannot_be_done_is_said_in_one_line_and_changes_nothing(self):
        before = self.map.read_bytes()
        for words, reason in ((["delete", "99"], "no feature #99"), (["delete", "x"], "no feature 'x'"),
                              (["cut", "1", "0,0"], "no corner"), (["merge", "1"], "two features"),
                              (["split", "1"], "--from"), (["restore", "5"], "no edit 5"),
                              (["undo", "soon"], "no number"), (["unlock", "1"], "not held"),
                              (["label", "1"], "a feature and a text"),
                              (["move", "1", "--axis", "0,0,0"], "--axis"),
                              (["list", "--where", "weight>1"], "no field")):
            self.assertIn(reason, self.edit(*words, status=1))
        self.assertEqual(self.map.read_bytes(), before)


if __name__ == "__main__":
    PROGRAMS = pathlib.Path(sys.argv[1]).resolve()
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
