# SPDX-License-Identifier: BSD-3-Clause
"""The three stages as processes, in a network namespace of their own, for tests."""
import atexit
import collections
import contextlib
import os
import pathlib
import re
import shutil
import signal
import socket
import struct
import subprocess
import sys
import threading
import time

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parents[1]
UDP = "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=2097152"
TCP = "tcpq://127.0.0.1:7700"
LCM_JAR = pathlib.Path("/usr/share/java/lcm.jar")
STAGES = ("geomap-mapper", "geomap-planes", "geomap-register")
INPUT = "(RGBD_FRAME|POSE|CAMERA_TO_BODY)"

_NETWORK = 'ip link set lo up && ip route add 224.0.0.0/4 dev lo && exec "$@"'


def enter_namespace(programs):
    """Starts this script again in a network namespace; says why where that cannot be, and ends.

    programs: folder of the built programs, the script's first argument.
    """
    missing = [tool for tool in ("unshare", "ip", "lcm-logplayer", "lcm-gen", "java")
               if shutil.which(tool) is None]
    if not LCM_JAR.exists():
        missing.append(str(LCM_JAR))
    if missing:
        skip("not installed: " + ", ".join(missing))
    if os.environ.get("GEOMAP_LIVE_NAMESPACE"):
        return pathlib.Path(programs).resolve()
    enter = ["unshare", "-rn", "sh", "-c", _NETWORK, "--"]
    probe = subprocess.run([*enter, "true"], capture_output=True, text=True, check=False)
    if probe.returncode != 0:
        skip("no right to make a network namespace: " + probe.stderr.strip())
    os.environ["GEOMAP_LIVE_NAMESPACE"] = "1"
    os.execvp(enter[0], [*enter, sys.executable, "-B", *sys.argv])


def skip(reason):
    print(f"{pathlib.Path(sys.argv[0]).stem}: Skipped\n{reason}")
    sys.exit(0)


class Process:
    """One program that runs until it is told to stop, or until the test ends, however it does."""

    def __init__(self, command, cwd):
        self.name = pathlib.Path(command[0]).name
        self.out = open(pathlib.Path(cwd) / f"{self.name}-{time.monotonic_ns()}.out", "w+")
        self.err = open(self.out.name[:-3] + "err", "w+")
        # Under AddressSanitizer freed memory counts as used until it leaves the quarantine.
        environment = {**os.environ,
                       "ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "") + ":quarantine_size_mb=1",
                       "LSAN_OPTIONS": f"suppressions={HERE / 'leak_suppressions.txt'}"}
        self.process = subprocess.Popen(command, stdout=self.out, stderr=self.err, cwd=cwd,
                                        env=environment)
        atexit.register(self.process.kill)  # nothing where it has ended

    def is_running(self):
        return self.process.poll() is None

    def stop(self, how=signal.SIGINT, timeout=60):
        """Its exit status; what it printed is in `output` and `errors` then."""
        if self.is_running():
            self.process.send_signal(how)
        status = self.process.wait(timeout)
        for stream in (self.out, self.err):
            stream.seek(0)
        self.output, self.errors = self.out.read(), self.err.read()
        self.out.close()
        self.err.close()
        return status

    def memory_kb(self):
        status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return int(re.search(r"VmRSS:\s+(\d+)", status)[1])

    def value(self, name):
        """A count of the summary; 0 where it is not there. Needs stop()."""
        found = re.search(rf"^{re.escape(name)}\s+(\S+)", self.output, re.MULTILINE)
        return int(found[1]) if found else 0

    def map_hash(self):
        return re.search(r"^map_hash (\w+)", self.output, re.MULTILINE)[1]


class System:
    """geomap-register, geomap-planes and geomap-mapper on one bus."""

    def __init__(self, programs, folder, url=UDP, options=()):
        self.programs, self.folder, self.url = programs, folder, url
        self.options = ["-l", url, *options]
        self.stages = {}

    def start(self, name, *more):
        self.stages[name] = Process([str(self.programs / name), *self.options, *more], self.folder)
        return self.stages[name]

    def start_all(self, options=None):
        """options: of single stages, by name."""
        for name in STAGES:
            self.start(name, *(options or {}).get(name, ()))
        time.sleep(1.5)  # until they receive, and have heard that they are the only ones
        return self

    def play(self, log, speed=1.0):
        subprocess.run(["lcm-logplayer", "-s", str(speed), "-e", INPUT, "-l", self.url, str(log)],
                       check=True, capture_output=True)
        time.sleep(0.5)

    def stop_all(self, names=STAGES):
        """From the front, so that each one still takes what the one before it publishes last."""
        statuses = {}
        for name in reversed(names):
            if name in self.stages:
                statuses[name] = self.stages[name].stop()
                time.sleep(0.5)
        return statuses


@contextlib.contextmanager
def broker():
    """LCM's own broker for tcpq."""
    java = subprocess.Popen(["java", "-cp", str(LCM_JAR), "lcm.lcm.TCPService"],
                            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    for _ in range(100):
        with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", 7700)):
            break
        time.sleep(0.1)
    try:
        yield
    finally:
        java.terminate()
        java.wait()


def message_types(folder):
    """The generated Python types, as a second implementation of the messages."""
    files = sorted(str(file) for file in (SOURCE / "lcmtypes").glob("*.lcm"))
    subprocess.run(["lcm-gen", "-p", "--ppath", str(folder), *files], check=True)
    sys.path.insert(0, str(folder))
    import geomap  # pylint: disable=import-outside-toplevel
    return geomap


class Publisher:
    """Sends bytes on a channel as LCM does over multicast, whole messages only."""

    def __init__(self):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
        self.sequence = 0

    def __del__(self):
        self.socket.close()

    def send(self, channel, data):
        self.sequence += 1
        packet = struct.pack(">II", 0x4C433032, self.sequence) + channel.encode() + b"\0" + data
        self.socket.sendto(packet, ("239.255.76.67", 7667))


def read_log(path):
    """Channel and data of every event of an LCM log."""
    data, at = pathlib.Path(path).read_bytes(), 0
    while at < len(data):
        _, _, _, channel_size, size = struct.unpack_from(">IqqII", data, at)
        at += 28 + channel_size
        yield data[at - channel_size:at].decode(), data[at:at + size]
        at += size


class Listener(threading.Thread):
    """Keeps the messages of the bus, by channel; of those in fragments, when they began to come."""

    def __init__(self):
        super().__init__(daemon=True)
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEPORT, 1)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 22)
        self.socket.bind(("239.255.76.67", 7667))
        group = socket.inet_aton("239.255.76.67") + socket.inet_aton("127.0.0.1")
        self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, group)
        self.messages = collections.defaultdict(list)
        self.arrivals = collections.defaultdict(list)
        self.start()

    def run(self):
        while True:
            packet = self.socket.recv(65536)
            if packet[:4] == b"LC02":
                end = packet.index(b"\0", 8)
                self.messages[packet[8:end].decode()].append(packet[end + 1:])
            elif packet[:4] == b"LC03" and packet[16:18] == b"\0\0":  # the first fragment
                self.arrivals[packet[20:packet.index(b"\0", 20)].decode()].append(time.monotonic())

    def wait_for(self, channel, accept=lambda data: True, after=lambda: None, timeout=10.0):
        """The first accepted message since `after` was called."""
        seen, deadline = len(self.messages[channel]), time.monotonic() + timeout
        after()
        while time.monotonic() < deadline:
            for data in self.messages[channel][seen:]:
                seen += 1
                if accept(data):
                    return data
            time.sleep(0.005)
        raise AssertionError(f"nothing on {channel} within {timeout} s")


def write_trajectory(folder, seconds, turn=4):
    """A file for geomap-sim: a robot that turns to and fro before the kitchen."""
    ends = ["x: -2.0, y: 0.3, yaw_deg: 0, tilt_deg: 20",
            f"x: -1.9, y: 0.5, yaw_deg: {12 * turn}, tilt_deg: 25"]
    waypoints = [f"  - {{t: {turn * i}, {ends[i % 2]}}}" for i in range(max(1, seconds // turn) + 1)]
    trajectory = folder / "turn.yaml"
    trajectory.write_text("\n".join(["name: turn", "camera_height: 1.4", "camera_forward: 0.1",
                                     "waypoints:", *waypoints, ""]))
    return trajectory


def simulate(programs, folder):
    """A short log of a robot that turns before the kitchen."""
    log = folder / "turn.lcmlog"
    subprocess.run([str(programs / "geomap-sim"), "--scene", str(SOURCE / "config/scenes/kitchen.yaml"),
                    "--trajectory", str(write_trajectory(folder, 4)), "--noise", "kinect",
                    "--drift-m-per-m", "0.02", "--log", str(log)], check=True, capture_output=True)
    return log
