"""Child processes: none outlives the command, hangs for ever, or fills the memory with prints."""

import os
import signal
import subprocess
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field

AT_ONCE = 2

_children = set()
_lock = threading.Lock()
_interrupted = False


def start(command, **options):
    """A child in a session of its own: Ctrl-C reaches us alone, and we end it with its children."""
    with _lock:
        if _interrupted:
            raise KeyboardInterrupt
        child = subprocess.Popen(command, stdin=subprocess.DEVNULL, start_new_session=True,
                                 **options)
        _children.add(child)
    return child


def _signal(child, number):
    try:
        os.killpg(child.pid, number)
    except ProcessLookupError:
        pass


def stop(child):
    """Ends a child. Asked politely first: Ninja ends its compilers only when it is asked."""
    _signal(child, signal.SIGTERM)
    try:
        child.wait(2.0)
    except subprocess.TimeoutExpired:
        pass
    _signal(child, signal.SIGKILL)
    child.wait()
    _children.discard(child)


def stop_all():
    """After Ctrl-C: ends every child and lets none start again."""
    global _interrupted
    with _lock:
        _interrupted = True
    for child in list(_children):
        stop(child)


def finish(child):
    """Waits for a child; returns its exit code (negative: the signal that ended it)."""
    try:
        return child.wait()
    finally:
        stop(child)


def results_of(jobs):
    """Calls functions that wait for children, two at a time; yields their results in order. If one
    fails, or after Ctrl-C, no child is left."""
    with ThreadPoolExecutor(AT_ONCE) as pool:
        futures = [pool.submit(job) for job in jobs]
        try:
            for future in futures:
                yield future.result()
        except BaseException:
            # Also when the caller has seen the last result and lets go: then nothing is left.
            if not all(future.done() for future in futures):
                pool.shutdown(wait=False, cancel_futures=True)
                stop_all()
            raise


def run_logged(command, log, **options):
    """Runs a command with all it prints in the file `log`. True if it succeeded."""
    with open(log, "w") as file:
        return finish(start(command, stdout=file, stderr=subprocess.STDOUT, **options)) == 0


def output_of(command, time_limit=None, **options):
    """What a command prints, or None if it fails. After `time_limit` seconds it is stopped, and
    subprocess.TimeoutExpired raised."""
    child = start(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, **options)
    try:
        output = child.communicate(timeout=time_limit)[0]
    finally:
        stop(child)
    return output if child.returncode == 0 else None


@dataclass
class Printed:
    """What a program under test prints: the first lines are kept, the rest is counted."""
    lines: list = field(default_factory=list)
    line_count: int = 0
    byte_count: int = 0
    out_of_bounds: str = ""  # the last such line of a bounds-checked array

    LINES_KEPT = 40
    LINE_LENGTH = 300

    def read(self, pipe):
        rest = b""
        while chunk := os.read(pipe.fileno(), 1 << 16):
            self.byte_count += len(chunk)
            *complete, rest = (rest + chunk).split(b"\n")
            rest = rest[:self.LINE_LENGTH]  # a line without an end must not grow for ever
            for line in complete:
                self._keep(line)
        if rest:
            self._keep(rest)

    def take_out_of_bounds(self):
        """The last such line, once."""
        line, self.out_of_bounds = self.out_of_bounds, ""
        return line

    def _keep(self, line):
        if line.startswith(b"out of bounds: "):
            self.out_of_bounds = line[:self.LINE_LENGTH].decode(errors="replace")
            return
        self.line_count += 1
        if len(self.lines) < self.LINES_KEPT:
            self.lines.append(line[:self.LINE_LENGTH].decode(errors="replace"))


def run_watched(command, events, time_limit, byte_limit, printed):
    """Runs a program that reports to the file `events`; what it prints goes to `printed`.

    It is stopped when nothing new stands in `events` for `time_limit` seconds, or when it has
    printed more than `byte_limit`. Returns (exit code, why it was stopped: "time", "flood", "")."""
    child = start(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    reader = threading.Thread(target=printed.read, args=(child.stdout,), daemon=True)
    reader.start()
    size, deadline, why = 0, time.monotonic() + time_limit, ""
    byte_limit += printed.byte_count  # of an earlier run
    try:
        while not why:
            try:
                child.wait(0.02)
                break
            except subprocess.TimeoutExpired:
                pass
            if (grown := events.stat().st_size) != size:
                size, deadline = grown, time.monotonic() + time_limit
            if time.monotonic() > deadline:
                why = "time"
            elif printed.byte_count > byte_limit:
                why = "flood"
    finally:
        stop(child)
    reader.join(2.0)
    return child.returncode, why
