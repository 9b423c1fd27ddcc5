# SPDX-License-Identifier: BSD-3-Clause
"""Robot and operator as two hosts, joined by a link that is thin or loses packets.

usage: two_hosts_test.py FOLDER_OF_PROGRAMS [unittest arguments]
"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

import live_system

OPERATOR_GROUP = "239.255.76.68"
OPERATOR_URL = f"udpm://{OPERATOR_GROUP}:7668?ttl=1"
ROBOT_PORT = 7667


def run(command, text=None):
    return subprocess.run(command, input=text, check=True, capture_output=True, text=True).stdout


class OperatorHost:
    """A network namespace of its own at the other end of a cable. The robot's end is `robot`."""

    def __init__(self):
        self.holder = subprocess.Popen(["unshare", "-n", "sleep", "infinity"])
        self.enter = ["nsenter", "-t", str(self.holder.pid), "-n"]
        run(["ip", "link", "add", "robot", "type", "veth", "peer", "name", "operator"])
        while "operator" in run(["ip", "-br", "link"]):  # until the holder is in its namespace
            subprocess.run(["ip", "link", "set", "operator", "netns", str(self.holder.pid)],
                           check=False, capture_output=True)
        for command, device, address in (([], "robot", 1), (self.enter, "operator", 2)):
            run([*command, "ip", "address", "add", f"10.9.0.{address}/24", "dev", device])
            run([*command, "ip", "link", "set", device, "up"])
        run(["ip", "route", "add", OPERATOR_GROUP, "dev", "robot"])
        run([*self.enter, "ip", "route", "add", "224.0.0.0/4", "dev", "operator"])

    def close(self):
        run(["ip", "link", "delete", "robot"])
        self.holder.terminate()
        self.holder.wait()

    def lose(self, percent):
        """Throws away this share of the packets, in both directions."""
        for command, device in (([], "robot"), (self.enter, "operator")):
            run([*command, "nft", "-f", "-"], f"""table ip lossy {{
                chain input {{
                    type filter hook input priority 0;
                    iif {device} numgen random mod 100 < {percent} counter drop
                }}
            }}""")

    def narrow(self, rate):
        run(["tc", "qdisc", "add", "dev", "robot", "root", "tbf", "rate", rate, "burst", "4kb",
             "latency", "200ms"])

    def sent_bytes(self):
        (link,) = json.loads(run(["ip", "-s", "-j", "link", "show", "robot"]))
        return link["stats64"]["tx"]["bytes"]


class View:
    """operator_view on one of the hosts."""

    def __init__(self, folder, url, command=()):
        self.process = live_system.Process([*command, str(PROGRAMS / "operator_view"), "-l", url], folder)

    def states(self):
        """Time, revision and hash of each."""
        lines = pathlib.Path(self.process.out.name).read_text().splitlines()
        return [(float(time), int(revision), view_hash) for time, revision, view_hash in map(str.split, lines)]

    def newest(self):
        """Revision and hash of the newest state; empty while there is none."""
        return [state[1:] for state in self.states()[-1:]]


class TwoHosts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.log = live_system.simulate(PROGRAMS, cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def setUp(self):
        self.host = OperatorHost()
        self.addCleanup(self.host.close)

    def map_over_the_link(self):
        """Maps the log; the operator must have the robot's view in the end."""
        system = live_system.System(PROGRAMS, self.folder)
        system.start_all({"geomap-mapper": ["--operator-url", OPERATOR_URL]})
        there = View(self.folder, OPERATOR_URL, self.host.enter)
        here = View(self.folder, system.url)
        time.sleep(0.5)
        begin, bytes_before = time.monotonic(), self.host.sent_bytes()
        system.play(self.log)
        rate = (self.host.sent_bytes() - bytes_before) / (time.monotonic() - begin)
        statuses = system.stop_all(("geomap-planes", "geomap-register"))  # the map is complete then
        deadline = time.monotonic() + 20
        while here.newest() != there.newest() and time.monotonic() < deadline:
            time.sleep(0.1)
        (robot_time, *robot), (operator_time, *operator) = here.states()[-1], there.states()[-1]
        for view in (here, there):
            view.process.stop()
        statuses |= system.stop_all(("geomap-mapper",))
        print(f"{self.id()}: {rate:.0f} bytes/s, equal after {operator_time - robot_time:.3f} s, "
              f"{len(there.states())} of {len(here.states())} states seen", file=sys.stderr)
        self.assertEqual(operator, robot)
        self.assertGreater(robot[0], 3)
        self.assertEqual(set(statuses.values()), {0})
        self.assertIn(f"view_hash {robot[1]}, revision {robot[0]}", system.stages["geomap-mapper"].output)

    def test_the_operator_has_the_robots_map(self):
        self.map_over_the_link()

    def test_one_packet_in_a_hundred_is_lost(self):
        self.host.lose(1)
        self.map_over_the_link()

    def test_one_packet_in_twenty_is_lost(self):
        self.host.lose(5)
        self.map_over_the_link()

    def test_every_second_packet_is_lost(self):
        self.host.lose(50)
        self.map_over_the_link()

    def test_edits_over_a_link_that_loses_every_fifth_packet_are_done_once(self):
        self.host.lose(20)
        system = live_system.System(PROGRAMS, self.folder)
        system.start_all({"geomap-mapper": ["--operator-url", OPERATOR_URL]})
        system.play(self.log)

        def edit(command, *words):
            return run([*self.host.enter, str(PROGRAMS / "geomap-edit"), command, "-l", OPERATOR_URL,
                        "--timeout", "30", *words])
        for i in range(4):
            self.assertIn(f"edit {i + 1}: label", edit("label", "1", f"floor{i}"))
        self.assertIn("floor3", edit("list"))
        self.assertIn("undo of edit 4", edit("undo"))
        self.assertIn("floor2", edit("list"))
        self.assertEqual(len(json.loads(edit("history", "--json"))), 5)
        self.assertEqual(set(system.stop_all().values()), {0})

    def test_the_link_is_thin(self):
        self.host.narrow("256kbit")
        self.map_over_the_link()

    def test_what_has_no_ttl_stays_on_the_robot(self):
        """Even where the route of the robot's bus leads to the network."""
        run(["ip", "route", "add", "239.255.76.67", "dev", "robot"])
        run([*self.host.enter, "nft", "-f", "-"], f"""table ip arrivals {{
            chain arriving {{
                type filter hook prerouting priority 0;
                udp dport {ROBOT_PORT} counter
            }}
        }}""")

        def arrived(url):
            run(["lcm-logplayer", "-s", "4", "-e", live_system.INPUT, "-l", url, str(self.log)])
            rules = json.loads(run([*self.host.enter, "nft", "-j", "list", "ruleset"]))["nftables"]
            (rule,) = [item["rule"] for item in rules if "rule" in item]
            return next(part["counter"]["packets"] for part in rule["expr"] if "counter" in part)

        self.assertEqual(arrived(live_system.UDP), 0)
        self.assertGreater(arrived(live_system.UDP.replace("ttl=0", "ttl=1")), 100)

    def test_one_bus_cannot_be_both(self):
        mapper = live_system.Process(
            [str(PROGRAMS / "geomap-mapper"), "-l", live_system.UDP, "--operator-url",
             f"udpm://{OPERATOR_GROUP}:{ROBOT_PORT}?ttl=1"], self.folder)
        mapper.process.wait(10)
        self.assertEqual(mapper.stop(), 2)
        self.assertIn("another port", mapper.errors)

    def test_without_a_network_the_robot_maps_on(self):
        run(["ip", "link", "set", "robot", "down"])
        system = live_system.System(PROGRAMS, self.folder)
        system.start_all({"geomap-mapper": ["--operator-url", OPERATOR_URL]})
        there = View(self.folder, OPERATOR_URL, self.host.enter)
        system.play(self.log)
        statuses = system.stop_all(("geomap-planes", "geomap-register"))
        self.assertFalse(there.states())
        run(["ip", "link", "set", "robot", "up"])
        run(["ip", "route", "add", OPERATOR_GROUP, "dev", "robot"])
        deadline = time.monotonic() + 15
        while not there.states() and time.monotonic() < deadline:
            time.sleep(0.1)
        there.process.stop()
        statuses |= system.stop_all(("geomap-mapper",))
        self.assertEqual(set(statuses.values()), {0})
        _, revision, view_hash = there.states()[-1]
        self.assertIn(f"view_hash {view_hash}, revision {revision}", system.stages["geomap-mapper"].output)


if __name__ == "__main__":
    PROGRAMS = live_system.enter_namespace(sys.argv[1])
    absent = [tool for tool in ("nft", "nsenter", "tc") if shutil.which(tool) is None]
    if absent:
        live_system.skip("not installed: " + ", ".join(absent))
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
