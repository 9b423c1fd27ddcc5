#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes docs/message_reference.md from lcmtypes/*.lcm and messaging/channels.hpp.

Comments are taken from these files, fingerprints from the code that lcm-gen makes of them.
"""
import argparse
import collections
import dataclasses
import difflib
import importlib
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs/message_reference.md"
HEAD = """# Messages

Made by `scripts/message_reference.py` from `lcmtypes/` and `messaging/channels.hpp`; a test compares.

Numbers are big-endian as LCM encodes them. A message begins with the fingerprint of its type, which depends on the
names, types and order of all fields: a reader of another version refuses it. `utime` is the sensor's clock in
microseconds. `T_a_b` maps points of frame b to frame a. Metres, radians and seconds where no unit stands.
"""


@dataclasses.dataclass
class Member:
    """A field, or a constant with its value as length."""

    type: str
    name: str
    length: str
    comment: str


@dataclasses.dataclass
class Struct:
    name: str
    comment: str
    fields: list = dataclasses.field(default_factory=list)
    constants: list = dataclasses.field(default_factory=list)


@dataclasses.dataclass
class TypeFile:
    name: str
    comment: str = ""
    package: str = ""
    structs: list = dataclasses.field(default_factory=list)


def parse(path):
    """The project's own way of writing .lcm files: one declaration a line, comments above."""
    file, comment = TypeFile(path.name), []
    for line in map(str.strip, path.read_text().splitlines()):
        if line.startswith("//"):
            comment.append(line[2:].strip())
            continue
        text = " ".join(part for part in comment if not part.startswith("SPDX"))
        comment = []
        if not line or line == "}":
            continue
        if package := re.fullmatch(r"package (\w+);", line):
            file.package, file.comment = package[1], text
        elif struct := re.fullmatch(r"struct (\w+) \{", line):
            file.structs.append(Struct(f"{file.package}.{struct[1]}", text))
        elif constant := re.fullmatch(r"const (\w+) (\w+) = (\S+);", line):
            file.structs[-1].constants.append(Member(*constant.groups(), text))
        elif field := re.fullmatch(r"([\w.]+) (\w+)(?:\[(\w+)\])?;", line):
            file.structs[-1].fields.append(Member(field[1], field[2], field[3] or "", text))
        else:
            raise SystemExit(f"{path}: cannot read '{line}'")
    return file


def channels():
    """Group, channel, type and frames of each channel in channels.hpp."""
    group = ""
    text = (ROOT / "messaging/channels.hpp").read_text()
    for found in re.finditer(r'^// (.*)\.$|= *\n? *"(\w+)"; *// ([\w.]+)(?:: (.*))?$', text, re.MULTILINE):
        if found[1]:
            group = found[1]
        else:
            yield group, found[2], found[3], found[4] or ""


def fingerprints(lcm_gen, paths, names):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([lcm_gen, "-p", "--ppath", folder, *paths], check=True)
        sys.path.insert(0, folder)
        sys.dont_write_bytecode = True
        for name in names:
            package, struct = name.split(".")
            message_type = getattr(importlib.import_module(package), struct)
            yield name, message_type._get_packed_fingerprint().hex()
        sys.path.remove(folder)


def link(name):
    return f"[{name}](#{name.replace('.', '')})"


def type_text(field, package, known):
    full = field.type if "." in field.type else f"{package}.{field.type}"
    text = link(full) if full in known else f"`{field.type}`"
    return text + (f" [{field.length}]" if field.length else "")


def unit_and_meaning(comment):
    """A unit in brackets where a part of the comment ends."""
    found = re.search(r" ?\[([^\]]+)\](?=$|[;,])", comment)
    if not found:
        return "", comment
    return found[1], (comment[:found.start()] + comment[found.end():]).strip()


def describe(field, previous, counted):
    """What has no comment counts others, or goes with what stands above."""
    if field.comment:
        return unit_and_meaning(field.comment)
    if field.name in counted:
        return "", "number of " + ", ".join(f"`{name}`" for name in counted[field.name])
    if previous and previous.type == field.type and not previous.length:
        return unit_and_meaning(previous.comment)
    return "", ""


def table(head, rows):
    return ["| " + " | ".join(head) + " |", "| --- " * len(head) + "|",
            *("| " + " | ".join(row) + " |" for row in rows), ""]


def write_struct(struct, package, fingerprint, on_channels, known):
    lines = [f"### {struct.name}", "", f"Fingerprint `0x{fingerprint}`."]
    if on_channels:
        lines[-1] += " Channel: " + ", ".join(f"`{channel}`" for channel in on_channels) + "."
    if struct.comment:
        lines += ["", struct.comment]
    counted = collections.defaultdict(list)
    for field in struct.fields:
        counted[field.length].append(field.name)
    rows = []
    for previous, field in zip([None, *struct.fields], struct.fields):
        unit, meaning = describe(field, previous, counted)
        rows.append([f"`{field.name}`", type_text(field, package, known), unit, meaning])
    lines += ["", *table(["field", "type", "unit", "meaning"], rows)]
    if struct.constants:
        lines += table(["constant", "value", "meaning"],
                       [[f"`{constant.name}`", constant.length, constant.comment]
                        for constant in struct.constants])
    return lines


def page(lcm_gen):
    paths = sorted((ROOT / "lcmtypes").glob("*.lcm"))
    files = [parse(path) for path in paths]
    names = [struct.name for file in files for struct in file.structs]
    prints = dict(fingerprints(lcm_gen, paths, names))
    carried = collections.defaultdict(list)
    lines = [HEAD, "## Channels", ""]
    rows = []
    for group, channel, name, frames in channels():
        carried[name].append(channel)
        rows.append([f"`{channel}`", link(name), frames, group])
    lines += table(["channel", "type", "frames", "of"], rows)
    for file in files:
        lines += [f"## {file.name}", ""]
        if file.comment:
            lines += [file.comment, ""]
        for struct in file.structs:
            lines += write_struct(struct, file.package, prints[struct.name], carried[struct.name], prints)
    return "\n".join(lines).rstrip() + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true",
                        help="write nothing; exit 1 when the page is not what would be written")
    parser.add_argument("--lcm-gen", default="lcm-gen")
    arguments = parser.parse_args()
    text = page(arguments.lcm_gen)
    if not arguments.check:
        PAGE.write_text(text)
        return 0
    difference = list(difflib.unified_diff(PAGE.read_text().splitlines(), text.splitlines(),
                                           str(PAGE), "generated", lineterm=""))
    if difference:
        print(*difference, "run scripts/message_reference.py", sep="\n")
    return 1 if difference else 0


if __name__ == "__main__":
    sys.exit(main())
