# SPDX-License-Identifier: BSD-3-Clause
"""The records of an MCAP file (mcap.dev), uncompressed."""

import io
import struct

MAGIC = b"\x89MCAP0\r\n"
HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, MESSAGE_INDEX, CHUNK_INDEX = range(1, 9)
STATISTICS, SUMMARY_OFFSET, DATA_END = 0x0B, 0x0E, 0x0F


class Fields:
    """The fields of a record, in sequence."""

    def __init__(self, data):
        self.stream = io.BytesIO(data)

    def number(self, size):
        return int.from_bytes(self.stream.read(size), "little")

    def raw(self):
        return self.stream.read(self.number(4))

    def text(self):
        return self.raw().decode()

    def map(self, *sizes):
        inner, found = Fields(self.raw()), []
        while inner.stream.tell() < len(inner.stream.getbuffer()):
            found.append(tuple(inner.number(size) for size in sizes))
        return found

    def rest(self):
        return self.stream.read()


def records(data, start=0):
    """(offset, operation, content) of each record."""
    at = start
    while at < len(data):
        operation, length = struct.unpack_from("<BQ", data, at)
        yield at, operation, data[at + 9:at + 9 + length]
        at += 9 + length


def messages(data):
    """{topic: [(time, bytes)]} of a whole file."""
    topics, found = {}, {}
    for _, operation, content in records(data[:-len(MAGIC)], len(MAGIC)):
        if operation != CHUNK:
            continue
        fields = Fields(content)
        for size in (8, 8, 8, 4):
            fields.number(size)
        fields.text()
        for _, what, record in records(fields.stream.read(fields.number(8))):
            of = Fields(record)
            number = of.number(2)
            if what == CHANNEL:
                of.number(2)
                topics[number] = of.text()
                found.setdefault(topics[number], [])
            elif what == MESSAGE:
                of.number(4)
                time = of.number(8)
                of.number(8)
                found[topics[number]].append((time, of.rest()))
    return found
