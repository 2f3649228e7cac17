"""Common Data Representation of plain types (XCDR version 1, little endian), as messages of ROS 2 have it, written for the tests alone."""
import struct

SIZES = {"B": 1, "?": 1, "i": 4, "I": 4, "f": 4, "q": 8, "Q": 8, "d": 8}


class Writer:
    def __init__(self):
        self.bytes = bytearray()

    def number(self, kind, value):
        self.bytes += bytes(-len(self.bytes) % SIZES[kind]) + struct.pack("<" + kind, value)
        return self

    def text(self, value):
        data = value.encode() + b"\0"
        self.number("I", len(data))
        self.bytes += data
        return self

    def hex(self):
        return (b"\0\1\0\0" + self.bytes).hex()


class Reader:
    def __init__(self, text):
        data = bytes.fromhex(text)
        assert data[:4] == b"\0\1\0\0", data[:4]
        self.bytes, self.at = data[4:], 0

    def number(self, kind):
        self.at += -self.at % SIZES[kind]
        (value,) = struct.unpack_from("<" + kind, self.bytes, self.at)
        self.at += SIZES[kind]
        return value

    def text(self):
        size = self.number("I")
        value = self.bytes[self.at:self.at + size]
        self.at += size
        assert value.endswith(b"\0"), value
        return value[:-1].decode()

    def list(self, one):
        return [one() for _ in range(self.number("I"))]

    def done(self):
        # RTPS fills messages up to four bytes.
        rest = self.bytes[self.at:]
        assert len(rest) < 4 and not any(rest), "%d bytes more than expected" % len(rest)
