#!/usr/bin/env python3
"""Runs a scene whose title and names hold control characters, tags and quotes, and reads all that comes of it with readers of others.

    scripts/check_names.py PROGRAM

Needs h5py, vtk, pypdf and pillow. Each file must be read without a complaint, say the names where it says any, and none may reach a
terminal as a command to it, or a page as a tag. Prints a line a file; ends with an error at the first that does not hold.
"""

import csv
import json
import subprocess
import sys
import tempfile
import tomllib
import xml.etree.ElementTree
from html.parser import HTMLParser
from pathlib import Path

import h5py
import PIL.Image
import pypdf
import vtk

TITLE = "</title></script><script>alert(1)</script><img src=x onerror=alert(2)><!--\x1b[31m\x07\"'&]]>\ufffe"
BODY = "<svg onload=alert(3)>&'\"</script>\x1b[31mred,\r\n../x"
MATERIAL = "<b onmouseover=alert(4)>&\"'\x1b]0;x\x07,\n"


def scene():
    """Returns the scene as TOML, in which JSON's strings are strings too."""
    quoted = [json.dumps(text) for text in (TITLE, MATERIAL, BODY)]
    title, material, body = (text.replace("\\ufffe", "\\uFFFE") for text in quoted)
    return f"""title = {title}
dimension = 3
gravity = [0.0, 0.0, -9.81]
time = {{ step = 1e-3, steps = 20 }}
materials.{material}.density = 1000.0
default_law.coulomb.friction = 0.3
output.kinds = ["vtk", "steps", "trajectory", "measures"]
[[bodies]]
name = {body}
shape.box.size = [0.2, 0.2, 0.2]
material = {material}
position = [0.0, 0.0, 0.1]
[[bodies]]
name = {json.dumps("ground" + BODY)}
shape.box.size = [2.0, 2.0, 0.2]
material = {material}
position = [0.0, 0.0, -0.1]
motion = "fixed"
[[joints]]
name = {json.dumps("joint" + BODY)}
kind.slider.axis = [0.0, 0.0, 1.0]
between = [{body}]
"""


class Tags(HTMLParser):
    """Collects what tags and attributes a page has."""

    def __init__(self):
        super().__init__()
        self.scripts, self.handlers, self.text, self.inside = 0, [], "", None

    def handle_starttag(self, tag, attrs):
        self.inside = tag
        self.scripts += tag == "script"
        self.handlers += [name for name, _ in attrs if name.startswith("on")]

    def handle_data(self, data):
        self.text += data if self.inside == "title" else ""


def page(path, plain):
    """Checks that a page has as many scripts as that of a harmless scene, no handlers, and a title that says what the scene's does."""
    tags, other = Tags(), Tags()
    tags.feed(path.read_text())
    other.feed(plain.read_text())
    assert (tags.scripts, tags.handlers) == (other.scripts, []), (tags.scripts, other.scripts, tags.handlers)
    assert tags.text.startswith("</title></script><script>alert(1)"), tags.text


def vtp(path):
    """Reads a file with VTK."""
    reader, heard = vtk.vtkXMLPolyDataReader(), []
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, lambda *_: heard.append(path))
    reader.SetFileName(str(path))
    reader.Update()
    assert not heard, heard


def trajectory(path):
    with h5py.File(path) as file:
        assert file.attrs["title"].decode() == TITLE, file.attrs["title"]


def scene_again(path):
    found = tomllib.loads(path.read_text())
    assert (found["title"], found["bodies"][0]["name"], list(found["materials"])) == (TITLE, BODY, [MATERIAL]), found


READERS = {
    ".toml": scene_again,
    ".json": lambda path: json.loads(path.read_text()),
    ".csv": lambda path: [len(row) for row in csv.reader(path.open(newline=""), strict=True)],
    ".svg": xml.etree.ElementTree.parse,
    ".pvd": xml.etree.ElementTree.parse,
    ".vtp": vtp,
    ".h5": trajectory,
    ".png": lambda path: PIL.Image.open(path).load(),
    ".pdf": lambda path: [sheet.extract_text() for sheet in pypdf.PdfReader(path, strict=True).pages],
}


def moreau(program, *words, folder):
    """Runs the program; what it says must have no control characters but the ends of lines."""
    done = subprocess.run([program, *words], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done
    said = done.stdout + done.stderr
    assert not [c for c in said if ord(c) < 32 and c not in "\n\t" or ord(c) == 127], said
    return said


def main(program):
    folder = Path(tempfile.mkdtemp())
    (folder / "names.toml").write_text(scene())
    harmless = scene()
    for name in (TITLE, BODY, MATERIAL):
        harmless = harmless.replace(json.dumps(name).replace("\\ufffe", "\\uFFFE")[1:-1], f"plain{len(name)}")
    (folder / "plain.toml").write_text(harmless)
    for name in ("plain", "names"):
        moreau(program, "check", f"{name}.toml", folder=folder)
        moreau(program, "run", f"{name}.toml", "--out", name, folder=folder)
        moreau(program, "report", name, folder=folder)
    for ending in ("svg", "png", "pdf"):
        moreau(program, "plot", "names", "--out", f"names/figure.{ending}", folder=folder)
    moreau(program, "render", "names", folder=folder)
    read = {}
    for path in sorted((folder / "names").rglob("*.*")):
        if path.suffix in READERS:
            READERS[path.suffix](path)
            read[path.suffix] = read.get(path.suffix, 0) + 1
    page(folder / "names" / "report.html", folder / "plain" / "report.html")
    assert set(read) == set(READERS), set(READERS) - set(read)
    print(f"names: {read}, and the page")


main(str(Path(sys.argv[1]).resolve()))
