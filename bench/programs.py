"""What the benchmarks in Python share: running a program to its end, progress on stderr, and how a run of theirs fails."""

import collections
import contextlib
import os
import pathlib
import resource
import subprocess
import sys
import time

SOURCE = pathlib.Path(__file__).resolve().parent.parent
SCULPT = SOURCE / "build/release/bin/sculpt"
FINE, FAILED, USAGE, INTERRUPTED = 0, 1, 2, 130


class Ended(collections.namedtuple("Ended", "stdout stderr exit_code seconds other_cores")):
    """How a program ended. `other_cores`: how many cores all other programs kept busy meanwhile, None where that is not known."""

    @property
    def error(self):
        """Its last line on stderr; progress may stand before it."""
        return (self.stderr.strip() or f"ended with {self.exit_code} and no word").splitlines()[-1]


class Failure(Exception):
    """Ends the program with an exit code and one line on stderr."""

    def __init__(self, exit_code, sentence):
        super().__init__(sentence)
        self.exit_code = exit_code


def shared_data():
    """The folder of what is not part of the repository, which need not be there."""
    return pathlib.Path(os.environ.get("SCULPT_SHARED_DATA") or SOURCE.parent / "shared/data")


def shared_mesh(name):
    """Where a mesh that is not part of the repository is if it is there."""
    return shared_data() / "meshes" / name


def is_program(path):
    return os.access(path, os.X_OK) and not path.is_dir()


def check_sculpt(path):
    if not is_program(path):
        raise Failure(USAGE, f"there is no program {path}: build it (cmake --preset release && "
                             "cmake --build --preset release), or name it with --sculpt PATH")


@contextlib.contextmanager
def daemon(program, data, *options):
    """Gives the address of a sculptd that runs meanwhile; its log is beside the data folder."""
    log = data.parent / "log"
    with log.open("ab") as said:
        process = subprocess.Popen([str(program), "--listen", "127.0.0.1:0", "--data", str(data), "--log", "warn", *map(str, options)],
                                   env={"SCULPT_CELLS": str(SOURCE / "config/cells"), **os.environ}, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=said, text=True)
    try:
        line = process.stdout.readline().strip()
        if " listening on " not in line:
            raise Failure(FAILED, f"{program} did not start:\n" + log.read_text())
        yield line.rpartition(" ")[2]
    finally:
        stop(process)


class Program:
    """Runs `program`, which the user names by `option`. While one runs, `said` is what it has printed on stderr."""

    def __init__(self, program, option, show):
        self.program, self.option, self.show, self.said = program.resolve(), option, show, ""
        self.environment = {"SCULPT_CELLS": str(SOURCE / "config/cells"), **os.environ, "SCULPT_CACHE": ""}  # each run finds its fields itself

    def run(self, *arguments, look=None, every_s=0.2):
        """To its end. Meanwhile shows what `look` makes of the seconds since its start; if `look` raises, it is stopped."""
        before = busy_seconds()
        process, started = self._start(arguments), time.monotonic()
        try:
            while True:
                try:
                    stdout, stderr = process.communicate(timeout=every_s)
                    seconds = time.monotonic() - started
                    return Ended(stdout, stderr, process.returncode, seconds, before and max(0.0, (busy_seconds() - before) / seconds))
                except subprocess.TimeoutExpired as waiting:
                    elapsed = time.monotonic() - started
                    self.said = (waiting.stderr or b"").decode(errors="replace")
                    self.show.running(look(elapsed) if look else f"{elapsed:.0f} s")
        finally:
            stop(process)

    def _start(self, arguments):
        try:
            return subprocess.Popen([str(self.program), *map(str, arguments)], env=self.environment, stdin=subprocess.DEVNULL,
                                    stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        except OSError as error:
            raise Failure(USAGE, f"cannot run {self.program} ({error.strerror}): name another with {self.option} PATH") from error


def busy_seconds():
    """Of all cores since the machine started, without what this program and its ended children used; None if not known."""
    try:
        with open("/proc/stat", encoding="ascii") as stat:
            user, nice, system, _, _, irq, softirq, steal = map(int, stat.readline().split()[1:9])
    except (OSError, ValueError):
        return None
    own = sum(usage.ru_utime + usage.ru_stime for usage in map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)))
    return (user + nice + system + irq + softirq + steal) / os.sysconf("SC_CLK_TCK") - own


def stop(process):
    """Politely, and if that does not help within seconds, for good."""
    for ask in (process.terminate, process.kill):
        if process.poll() is None:
            ask()
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                pass


class Show:
    """Progress on stderr: a bar that redraws itself on a terminal, else a line when a run begins and when it ends."""

    def __init__(self, total):
        self.total, self.done, self.run, self.bar = total, 0, None, sys.stderr.isatty()

    def begin(self, run):
        self.run = run
        if self.bar:
            self.running("")
        else:
            print(f"{self.done + 1}/{self.total} {run} ...", file=sys.stderr, flush=True)

    def running(self, note):
        if self.bar:
            full = 30 * self.done // self.total
            print(f"\r\x1b[K[{'#' * full}{'.' * (30 - full)}] {self.done + 1}/{self.total} {self.run}  {note}",
                  end="", file=sys.stderr, flush=True)

    def end(self, note):
        self.done += 1
        self.clear()
        print(f"{self.done}/{self.total} {self.run}: {note}", file=sys.stderr, flush=True)

    def clear(self):
        if self.bar:
            print("\r\x1b[K", end="", file=sys.stderr, flush=True)
