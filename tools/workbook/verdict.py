"""A verdict: made from what the checks report and how they ended (docs/authoring.md)."""

import json
import signal
from dataclasses import dataclass, field

EXIT_CODES = {"CORRECT": 0, "TODO": 10, "DOES NOT BUILD": 11, "CUDA ERROR": 12, "WRONG": 13,
              "RACY": 14}

SIGNALS = {signal.SIGSEGV: "it read or wrote memory that is not its own (segmentation fault)",
           signal.SIGBUS: "it read or wrote memory that is not there (bus error)",
           signal.SIGFPE: "an integer was divided by zero, or an impossible sum (SIGFPE)",
           signal.SIGABRT: "it was aborted (SIGABRT)",
           signal.SIGILL: "it ran into an instruction that does not exist (SIGILL)",
           signal.SIGKILL: "the system killed it, perhaps because memory ran out (SIGKILL)"}


def how_it_ended(code):
    """An exit code in words."""
    if code >= 0:
        return f"the program ended itself with exit code {code}"
    number = -code
    return SIGNALS.get(number, f"signal {number}")


@dataclass
class Verdict:
    chapter: str                                       # "02"
    files: list = field(default_factory=list)          # tested, relative to the project's folder
    options: str = ""                                  # of this call, for the command to repeat
    seed: int = None
    devices: list = field(default_factory=list)        # backends that were tested
    skipped: list = field(default_factory=list)        # {"device", "why"}
    holes: list = field(default_factory=list)          # ids reached while open
    results: list = field(default_factory=list)        # the "result" events
    crashes: list = field(default_factory=list)        # {"id", "device", "how", "out_of_bounds"}
    timeout: dict = None                               # {"id", "device", "limit"}
    error: object = None                               # a CompileError
    measured: list = field(default_factory=list)       # texts
    pictures: list = field(default_factory=list)       # paths
    speed: dict = None                                 # filled in after CORRECT
    gave_up: bool = False                              # after too many crashes
    ended: bool = False                                # an "end" event came in the last run
    running: tuple = None                              # (id, device) of the check under way
    last: tuple = None                                 # (id, device) of the last check begun

    def take(self, event):
        """Takes in one event."""
        kind = event.get("event")
        if kind == "start":
            self.seed = event.get("seed")
            self.devices = event.get("devices", [])
            self.skipped = event.get("skipped", [])
        elif kind == "case":
            self.running = self.last = (event["id"], event.get("device", ""))
        elif kind == "hole" and event["id"] not in self.holes:
            self.holes.append(event["id"])
        elif kind == "result":
            self.results.append(event)
            self.running = None
        elif kind == "measured":
            self.measured.append(event["text"])
        elif kind == "picture" and event["path"] not in self.pictures:
            self.pictures.append(event["path"])
        elif kind == "end":
            self.ended, self.running = True, None

    def take_crash(self, how, out_of_bounds=""):
        """The program ended in the middle: by itself, by a signal, or it printed too much."""
        check, device = self.running or self.last or ("", "")
        self.crashes.append({"id": check, "device": device, "how": how,
                             "out_of_bounds": out_of_bounds})
        self.running = None

    def take_timeout(self, limit):
        check, device = self.running or self.last or ("", "")
        self.timeout = {"id": check, "device": device, "limit": limit}

    @property
    def failed(self):
        return [result for result in self.results if result["state"] != "passed"]

    @property
    def passed_count(self):
        """Checks that passed. One that met an open hole proves nothing, whatever it says."""
        return sum(result["state"] == "passed" and not result.get("open")
                   for result in self.results)

    @property
    def wrong_already(self):
        """Beside open holes: checks that failed without meeting one."""
        return [result for result in self.failed if self.holes and not result.get("open")]

    @property
    def state(self):
        states = {result["state"] for result in self.failed}
        if self.holes:
            return "TODO"
        if self.error:
            return "DOES NOT BUILD"
        if "cuda error" in states:
            return "CUDA ERROR"
        if "wrong" in states or self.crashes or self.timeout:
            return "WRONG"
        return "RACY" if "racy" in states else "CORRECT"

    @property
    def exit_code(self):
        return EXIT_CODES[self.state]

    def rejects(self, check):
        """The reports against one check: failed results, crashes, a timeout."""
        reports = self.failed + self.crashes + ([self.timeout] if self.timeout else [])
        return [report for report in reports if report["id"] == check]

    def as_json(self):
        """All of it as one line."""
        return json.dumps({
            "chapter": self.chapter, "state": self.state, "exit_code": self.exit_code,
            "files": self.files, "seed": self.seed, "devices": self.devices,
            "skipped": self.skipped, "holes": self.holes, "passed": self.passed_count,
            "failed": self.failed, "crashes": self.crashes, "timeout": self.timeout,
            "error": self.error.as_dict() if self.error else None, "measured": self.measured,
            "pictures": self.pictures, "speed": self.speed})
