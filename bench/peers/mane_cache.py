"""Reads caches of mane (docs/formats.md, "Caches")."""

import struct
from pathlib import Path

import numpy as np
import zstandard

ELEMENTS = ["u1", "<u2", "<u4", "<u8", "<f4", "<f8"]


def _arrays(payload):
    """An unpacked chunk as {name: array}, one row per record."""
    found, at = [], 4
    for _ in range(struct.unpack_from("<I", payload)[0]):
        texts = []
        for _ in range(2):  # name, unit
            size = payload[at]
            texts.append(payload[at + 1:at + 1 + size].decode())
            at += 1 + size
        element, components, records = struct.unpack_from("<BBQ", payload, at)
        at += 10
        found.append((texts[0], np.dtype(ELEMENTS[element]), components, records))
    arrays = {}
    for name, element, components, records in found:
        size = element.itemsize * components
        planes = np.frombuffer(payload, np.uint8, size * records, at).reshape(size, records)
        arrays[name] = np.ascontiguousarray(planes.T).view(element).reshape(records, components)
        at += size * records
    return arrays


def read_cache(path):
    """All chunks: {type: {number: {name: array}}}."""
    data = Path(path).read_bytes()
    chunks, at = {}, 16
    while at < len(data) - 16:
        kind, number, stored, raw = struct.unpack_from("<4sIQQ", data, at)
        payload = zstandard.ZstdDecompressor().decompress(data[at + 40:at + 40 + stored], max_output_size=raw)
        chunks.setdefault(kind.decode(), {})[number] = _arrays(payload)
        at += 40 + stored
    return chunks
