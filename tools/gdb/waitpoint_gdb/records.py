# SPDX-License-Identifier: BSD-3-Clause
"""The kernel's records, read from the memory of a process or of a core file.

They are documented in fibers/kernel/task.hpp and debugger.hpp. A record is read as a whole, and its members are extracted
from the bytes by the offsets in the debugging information: gdb's own values cost some ten microseconds per member, too much
for thousands of tasks.
"""

import contextlib
import functools

import gdb

NAMESPACE = "waitpoint::kernel::"
NO_TIME = 2**63 - 1  # Time::max(): never
TEXT_PIECE = 64  # read at once: within a page


other = None  # while another process's memory is read: see of_process()


@functools.lru_cache(maxsize=None)
def record_type(name):
    """Of the kernel, or with its whole name."""
    try:
        return gdb.lookup_type(name if name.startswith("waitpoint::") else NAMESPACE + name).strip_typedefs()
    except gdb.error:
        raise gdb.GdbError("this program has no tasks of waitpoint, or no debugging information (-g) of them") from None


@functools.lru_cache(maxsize=None)
def place(name, path):
    """(offset, size, True if signed) of the member `path`, "fiber.context" for example, of the record `name`."""
    kind, offset = record_type(name), 0
    for part in path.split("."):
        for field in kind.fields():
            if field.name == part:
                break
        else:
            raise gdb.GdbError(f"{name} has no member {path}: these commands are of another version of waitpoint")
        offset += field.bitpos // 8
        kind = field.type.strip_typedefs()
    return offset, kind.sizeof, kind.code == gdb.TYPE_CODE_INT and kind.is_signed


def number_at(address, name, path):
    """A member of a record that is not read as a whole."""
    offset, size, signed = place(name, path)
    return int.from_bytes(memory(address + offset, size), "little", signed=signed)


@functools.lru_cache(maxsize=None)
def enumerators(name):
    """The names of an enumeration by their values."""
    return {field.enumval: field.name.rsplit("::", 1)[-1] for field in record_type(name).fields()}


@functools.lru_cache(maxsize=None)
def constant(record, name):
    """The static constant `name` of the class `record` (with namespace), from the debugging information."""
    try:
        return int(gdb.parse_and_eval(f"waitpoint::{record}::{name}"))
    except gdb.error:
        raise gdb.GdbError(f"{record} has no constant {name}: these commands are of another version of waitpoint") from None


def forget():
    """Call for a new program, which has other offsets."""
    for cache in (record_type, place, enumerators, constant):
        cache.cache_clear()


class Memory:
    """Of another process, which has the same libraries, but not at the same addresses."""

    def __init__(self, file):
        self.file = file

    def read(self, address, size):
        self.file.seek(address)
        return self.file.read(size)


@contextlib.contextmanager
def of_process(system_id):
    """Reads records from the memory of another process. OSError if it has ended."""
    global other
    with open(f"/proc/{system_id}/mem", "rb", buffering=0) as file:
        other = Memory(file)
        try:
            yield
        finally:
            other = None


def memory(address, size):
    if other is None:
        return bytes(gdb.selected_inferior().read_memory(address, size))
    return other.read(address, size)


def text_at(address):
    """The zero-terminated text at this address: a kind or a label."""
    if not address:
        return ""
    if other is None:
        return own_text_at(address)
    text = b""
    while b"\0" not in text:
        text += other.read(address + len(text), TEXT_PIECE - (address + len(text)) % TEXT_PIECE)
    return text.split(b"\0")[0].decode(errors="replace")


@functools.lru_cache(maxsize=4096)
def own_text_at(address):
    """They never change."""
    return gdb.Value(address).cast(gdb.lookup_type("char").pointer()).string(errors="replace")


class Record:
    """A copy of one record."""

    def __init__(self, name, address):
        self.name, self.address = name, address
        self.bytes = memory(address, record_type(name).sizeof)

    def number(self, path):
        offset, size, signed = place(self.name, path)
        return int.from_bytes(self.bytes[offset : offset + size], "little", signed=signed)

    def text(self, path):
        """An array of characters."""
        offset, size, _ = place(self.name, path)
        return self.bytes[offset : offset + size].split(b"\0")[0].decode(errors="replace")

    def follow(self, path, name):
        """The record at a pointer, or None."""
        address = self.number(path)
        return Record(name, address) if address else None


def address_of(variable):
    """The address of a global variable of the kernel."""
    symbol = gdb.lookup_global_symbol(NAMESPACE + variable)
    if symbol is None:
        raise gdb.GdbError("this program has no tasks of waitpoint, or no debugging information (-g) of them")
    return int(symbol.value().address)


def view():
    """The kernel's interface for debuggers."""
    if gdb.selected_inferior().pid == 0 and not gdb.selected_inferior().threads():
        raise gdb.GdbError("no program is being run, and no core file is read")
    return Record("DebuggerView", address_of("debugger_view"))


def write_view(path, value):
    """Sends a request to the kernel: the only memory written here."""
    offset, size, signed = place("DebuggerView", path)
    gdb.selected_inferior().write_memory(address_of("debugger_view") + offset, value.to_bytes(size, "little", signed=signed))


def scheduler():
    """The scheduler of the run entered last."""
    found = view().follow("scheduler", "Scheduler")
    if found is None:
        raise gdb.GdbError("no run has begun, or it is over")
    return found


def events_of(run):
    """The number of events executed in this scheduler's run, as in kernel::events()."""
    inverse = constant("PairDigest", "inverse_of_step")
    events = run.number("roster.ended_robots_digest_.last_key_") * inverse
    robot = run.follow("roster.first_robot_", "Robot")
    while robot:
        events += robot.number("digest.last_key_") * inverse - robot.number("outputs")
        robot = robot.follow("next", "Robot")
    return events % 2**64


def seconds(time_ns):
    """The time in the format of reports."""
    if time_ns == NO_TIME:
        return "never"
    sign = "-" if time_ns < 0 else ""
    return f"{sign}{abs(time_ns) // 10**9}.{abs(time_ns) % 10**9:09d}"
