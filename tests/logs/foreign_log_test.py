# SPDX-License-Identifier: BSD-3-Clause
"""Logs of other LCM camera drivers, written by code that shares nothing with ours: LCM's own Python
types, the log's format from its manual, and a JPEG encoder for images of one colour."""
import argparse
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

MAGIC = 0xEDA1DA01
WIDTH, HEIGHT = 16, 12
GREY = 90
START = 1_340_000_000_000_000
PROGRAMS = None
folder = None


def write_log(name, events):
    """Events are (log time, channel, bytes)."""
    path = folder / name
    with open(path, "wb") as log:
        for number, (utime, channel, data) in enumerate(events):
            log.write(struct.pack(">IqqII", MAGIC, number, utime, len(channel), len(data)))
            log.write(channel.encode() + data)
    return path


def read_log(path):
    data = path.read_bytes()
    offset = 0
    while offset < len(data):
        magic, _, utime, name, size = struct.unpack_from(">IqqII", data, offset)
        assert magic == MAGIC
        offset += 28
        yield utime, data[offset:offset + name].decode(), data[offset + name:offset + name + size]
        offset += name + size


def grey_jpeg(width, height, grey):
    """Baseline JPEG: quantisation by 8 throughout, so that a block's DC is its value minus 128, no AC;
    DC categories as codes of four bits, end of block as the bit 0."""
    def segment(marker, body):
        return struct.pack(">BBH", 0xFF, marker, len(body) + 2) + body

    bits = ""
    for block in range((width + 7) // 8 * ((height + 7) // 8)):
        for component in range(3):
            step = grey - 128 if block == 0 and component == 0 else 0
            category = abs(step).bit_length()
            bits += f"{category:04b}"
            if step:
                bits += f"{step if step > 0 else step + (1 << category) - 1:0{category}b}"
            bits += "0"
    bits += "1" * (-len(bits) % 8)
    coded = bytes(int(bits[i:i + 8], 2) for i in range(0, len(bits), 8)).replace(b"\xff", b"\xff\x00")
    components = b"".join(bytes([i, 0x11, 0]) for i in (1, 2, 3))
    return (b"\xff\xd8" + segment(0xDB, b"\0" + bytes([8] * 64))
            + segment(0xC0, struct.pack(">BHHB", 8, height, width, 3) + components)
            + segment(0xC4, b"\x00" + bytes([0, 0, 0, 12] + [0] * 12) + bytes(range(12)))
            + segment(0xC4, b"\x10" + bytes([1] + [0] * 15) + b"\x00")
            + segment(0xDA, b"\x03" + b"".join(bytes([i, 0]) for i in (1, 2, 3)) + b"\x00\x3f\x00")
            + coded + b"\xff\xd9")


def depth_rows(width, height):
    return struct.pack(f"<{width * height}H", *(1000 + i % 500 for i in range(width * height)))


def openni_frame(utime, compressed):
    """As openni2-camera-lcm publishes, with and without -j -z."""
    color, depth = bot_core.image_t(), bot_core.image_t()
    for image, pixel_size in (color, 3), (depth, 2):
        image.utime, image.width, image.height = utime, WIDTH, HEIGHT
        image.row_stride = pixel_size * WIDTH
    color.data = grey_jpeg(WIDTH, HEIGHT, GREY) if compressed else bytes([GREY] * 3 * WIDTH * HEIGHT)
    color.pixelformat = color.PIXEL_FORMAT_MJPEG if compressed else color.PIXEL_FORMAT_RGB
    depth.data = depth_rows(WIDTH, HEIGHT)
    depth.pixelformat = depth.PIXEL_FORMAT_BE_GRAY16
    if compressed:
        depth.data = zlib.compress(depth.data, 6)
        depth.pixelformat = depth.PIXEL_FORMAT_INVALID
    message = bot_core.images_t()
    message.utime = utime
    message.images = [color, depth]
    message.image_types = [message.LEFT, message.DEPTH_MM_ZIPPED if compressed else message.DEPTH_MM]
    message.n_images = len(message.images)
    for image in message.images:
        image.size = len(image.data)
    return message.encode()


def kinect_frame(utime, compressed, size=(WIDTH, HEIGHT), depth=None):
    """As the Kinect drivers publish; without colour where a depth image is given."""
    message = kinect.frame_msg_t()
    message.timestamp = utime + 5000
    message.depth.timestamp = message.image.timestamp = utime
    message.depth.width, message.depth.height = message.image.width, message.image.height = size
    rows = depth or depth_rows(*size)
    message.depth.depth_data = zlib.compress(rows) if compressed else rows
    message.depth.depth_data_nbytes = len(message.depth.depth_data)
    message.depth.depth_data_format = message.depth.DEPTH_MM
    message.depth.compression = int(compressed)
    message.depth.uncompressed_size = len(rows)
    if depth:
        message.image.image_data = b""
        message.image.image_data_format = message.image.VIDEO_NONE
    elif compressed:
        message.image.image_data = grey_jpeg(*size, GREY)
        message.image.image_data_format = message.image.VIDEO_RGB_JPEG
    else:
        message.image.image_data = bytes([GREY] * 3 * size[0] * size[1])
        message.image.image_data_format = message.image.VIDEO_RGB
    message.image.image_data_nbytes = len(message.image.image_data)
    return message.encode()


def pose(utime):
    message = bot_core.pose_t()
    message.utime = utime
    message.pos = [1, 2, 3]
    message.orientation = [1, 0, 0, 0]
    return message.encode()


def camera_settings(width, height, focal_length):
    for camera in "depth", "color":
        for key, value in (("width", width), ("height", height), ("fx", focal_length),
                           ("fy", focal_length), ("cx", (width - 1) / 2), ("cy", (height - 1) / 2)):
            yield from ("--set", f"driver_camera.{camera}.{key}={value}")


def run(program, *arguments):
    return subprocess.run([f"{PROGRAMS}/{program}", *map(str, arguments)], capture_output=True,
                          text=True, check=False)


def run_import(log, *options):
    return run("geomap-import", "--format", "lcm", log, folder / "out.lcmlog", *options,
               *camera_settings(WIDTH, HEIGHT, 20))


def some_log(name, channel, frame, compressed):
    events = []
    for utime in range(START, START + 100_000, 33_333):
        events += [(utime + 100, "POSE", pose(utime)), (utime + 50, "LCM_SELF_TEST", b"test"),
                   (utime + 900, channel, frame(utime, compressed))]
    return write_log(name, events), events


class ForeignLog(unittest.TestCase):
    def setUp(self):
        (folder / "out.lcmlog").unlink(missing_ok=True)

    def expect_error(self, result, status, text):
        self.assertEqual(result.returncode, status, result.stderr)
        self.assertIn(text, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1)
        self.assertFalse((folder / "out.lcmlog").exists())

    def expect_frames(self, channel, frame, compressed):
        log, events = some_log("in.lcmlog", channel, frame, compressed)
        result = run_import(log)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn(f"4 frames of {channel}, 8 other events", result.stdout)
        imported = list(read_log(folder / "out.lcmlog"))
        self.assertEqual([event[0] for event in imported], [event[0] for event in events])
        self.assertEqual([event for event in imported if event[1] != "RGBD_FRAME"],
                         [event for event in events if event[1] != channel])
        frames = [geomap.rgbd_frame_t.decode(data) for _, name, data in imported if name == "RGBD_FRAME"]
        self.assertEqual([frame.utime for frame in frames], [START + 33_333 * i for i in range(4)])
        self.assertEqual([frame.sequence for frame in frames], [0, 1, 2, 3])
        for frame in frames:
            self.assertEqual(zlib.decompress(frame.depth.data), depth_rows(WIDTH, HEIGHT))
            self.assertEqual((frame.depth_camera.width, frame.depth_camera.fx), (WIDTH, 20.0))
            self.assertEqual(frame.color.pixelformat, frame.color.PIXEL_FORMAT_MJPEG)
            if compressed:
                self.assertEqual(frame.color.data, grey_jpeg(WIDTH, HEIGHT, GREY))
        self.assertEqual(run("geomap-log", "check", folder / "out.lcmlog").returncode, 0)

    def test_openni_frames_become_our_own_and_all_else_stays(self):
        self.expect_frames("OPENNI_FRAME", openni_frame, compressed=True)
        self.expect_frames("OPENNI_FRAME", openni_frame, compressed=False)

    def test_kinect_frames_become_our_own_and_all_else_stays(self):
        self.expect_frames("KINECT_FRAME", kinect_frame, compressed=True)
        self.expect_frames("KINECT_FRAME", kinect_frame, compressed=False)

    def test_frames_are_known_by_their_type_not_by_their_channel(self):
        self.expect_frames("robot1/CAMERA", openni_frame, compressed=True)

    def test_of_two_cameras_one_must_be_chosen(self):
        log = write_log("two.lcmlog", [(START, "LEFT", openni_frame(START, True)),
                                       (START, "RIGHT", openni_frame(START + 1, True))])
        self.expect_error(run_import(log), 1, "frames on LEFT and on RIGHT: choose one with --channel")
        self.assertEqual(run_import(log, "--channel", "RIGHT").returncode, 0)
        self.assertEqual([event[1] for event in read_log(folder / "out.lcmlog")],
                         ["LEFT", "RGBD_FRAME"])

    def test_a_frame_that_cannot_be_read_ends_the_import_unless_it_is_skipped(self):
        good, other = kinect_frame(START, True), kinect_frame(START, True, (WIDTH, HEIGHT + 1))
        log = write_log("bad.lcmlog", [(START, "KINECT_FRAME", good[:-1]),
                                       (START, "KINECT_FRAME", other), (START, "KINECT_FRAME", good)])
        self.expect_error(run_import(log), 1, "event 0 on KINECT_FRAME: truncated")
        result = run_import(log, "--skip-bad")
        self.assertIn("1 frames of KINECT_FRAME, 0 other events", result.stdout)
        self.assertIn("2 unreadable frames left out, the first: event 0", result.stdout)

    def test_images_of_another_size_than_the_camera_point_to_the_setting(self):
        log = write_log("size.lcmlog", [(START, "K", kinect_frame(START, True, (WIDTH, HEIGHT + 1)))])
        self.expect_error(run_import(log), 1, "driver_camera")

    def test_what_makes_no_sense_is_said_in_one_line(self):
        poses = write_log("poses.lcmlog", [(START, "POSE", pose(START))])
        ours = write_log("ours.lcmlog", [(START, "RGBD_FRAME", b"")])
        log, _ = some_log("in.lcmlog", "OPENNI_FRAME", openni_frame, True)
        self.expect_error(run_import(poses), 1, "no frame to import")
        self.expect_error(run_import(ours), 1, "holds RGBD_FRAME already")
        self.expect_error(run_import(folder / "missing.lcmlog"), 1, "No such file")
        self.expect_error(run_import(log, "--prior", "none"), 2, "are for folders")
        before = log.read_bytes()
        result = run("geomap-import", "--format", "lcm", log, log)
        self.expect_error(result, 2, "choose another name")
        self.assertEqual(log.read_bytes(), before)

    def test_a_replay_of_their_log_and_of_ours_give_the_same_map(self):
        size = 320, 240
        wall = struct.pack("<H", 1500) * (size[0] * size[1])
        settings = list(camera_settings(*size, 292.5))
        log = write_log("wall.lcmlog", [(START, "POSE", pose(START)), (START, "KINECT_FRAME",
                                        kinect_frame(START, True, size, wall)),
                                        (START, "POSE", pose(START + 200_000))])
        imported = run("geomap-import", "--format", "lcm", log, folder / "out.lcmlog", *settings)
        self.assertEqual(imported.returncode, 0, imported.stderr)
        theirs = run("geomap-replay", log, "-o", folder / "theirs", *settings)
        ours = run("geomap-replay", folder / "out.lcmlog", "-o", folder / "ours")
        self.assertIn("1 frames, 1 key frames, 1 features", theirs.stdout, theirs.stderr)
        self.assertEqual(theirs.stdout.splitlines()[1], ours.stdout.splitlines()[1])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--programs", required=True, help="folder of geomap-import and the others")
    parser.add_argument("--lcm-gen", required=True)
    parser.add_argument("--types", required=True, type=pathlib.Path, help="folder of .lcm files")
    arguments, rest = parser.parse_known_args()
    PROGRAMS = arguments.programs
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        subprocess.run([arguments.lcm_gen, "-p", "--ppath", folder / "types",
                        *sorted(arguments.types.glob("*.lcm"))], check=True)
        sys.path.insert(0, str(folder / "types"))
        import bot_core
        import geomap
        import kinect
        unittest.main(argv=[sys.argv[0], *rest])
