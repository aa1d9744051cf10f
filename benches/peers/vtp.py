"""Reads the arrays of a .vtp file as moreau writes it: appended, raw, compressed in blocks by zlib."""

import re
import struct
import zlib

import numpy as np

KINDS = {"Float64": "<f8", "Int64": "<i8", "Int32": "<i4"}


def arrays(path):
    """All arrays of a file by name, those of more components with a row a tuple."""
    data = path.read_bytes()
    mark = b'<AppendedData encoding="raw">\n   _'
    start = data.index(mark) + len(mark)
    pattern = r'<DataArray type="(\w+)" Name="(\w+)"(?: NumberOfComponents="(\d+)")?.*? offset="(\d+)"'
    found = {}
    for kind, name, components, offset in re.findall(pattern, data[:start].decode()):
        values = np.frombuffer(unpacked(data, start + int(offset)), KINDS[kind])
        found[name] = values.reshape(-1, int(components)) if components not in ("", "1") else values
    return found


def unpacked(data, at):
    """Number of blocks, bytes of a full and of the last one, compressed bytes of each, blocks."""
    (blocks,) = struct.unpack_from("<Q", data, at)
    sizes = struct.unpack_from(f"<{blocks}Q", data, at + 24)
    at += 24 + 8 * blocks
    parts = []
    for size in sizes:
        parts.append(zlib.decompress(data[at : at + size]))
        at += size
    return b"".join(parts)
