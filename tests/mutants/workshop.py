"""Plans made, replayed and sampled in a copy of this commit: what `run` and `faults` stand on."""
import json
import os
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parents[1]
SAMPLES, BENCH = SOURCE / "config/samples", SOURCE / "bench/cells_data/cells"
# Cells and shapes in which faults matter: a table that turns, none, a short tool in a holder, a clamp, slides only.
TARGETS = [
    ("panda-turntable", "bust", 8, "sweep"),
    ("six-axis", "vase", 8, "sweep"),
    ("clamped-panda", "dish", 8, "sweep"),
    ("panda-turntable-6mm", "bell", 8, "sweep"),
    ("gantry", "bust", 16, "octree"),
    ("clamped-gantry", "vase", 16, "octree"),
    ("panda-turntable", "vase", 8, "octree"),
    ("six-axis", "bust", 16, "sweep"),
    ("clamped-panda", "bust", 16, "sweep"),
]
LIMIT_S = 60


def run(*command, **options):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)


class Bench:
    """Has plans made, and tries them with the program `sound` and with sampler.cpp; keeps its files in `folder`."""

    def __init__(self, folder, sound):
        self.folder, self.sound = folder, sound
        folder.mkdir(parents=True, exist_ok=True)
        self.cells = self.make_cells()
        self.sampler = folder / "sampler"
        run("g++", "-std=c++20", "-O2", "-I/usr/include/eigen3", HERE / "sampler.cpp", "-ltinyxml2", "-o", self.sampler,
            check=True)

    def make_cells(self):
        """Cells by name; two of them with a clamp over an edge of the stock."""
        cells = self.folder / "cells"
        shutil.rmtree(cells, ignore_errors=True)
        shutil.copytree(SOURCE / "config/cells", cells / "cells")
        shutil.copytree(SOURCE / "config/robots", cells / "robots")
        shutil.copy(BENCH / "six-axis.json", cells / "cells")
        for path in (BENCH.parent / "robots").glob("six-axis*"):
            shutil.copy(path, cells / "robots")
        clamps = {
            "panda-turntable": '<link name="stock"><collision><origin xyz="0.125 0 0.06"/>'
                               '<geometry><box size="0.03 0.05 0.12"/></geometry></collision></link>',
            "gantry": None,
        }
        for name, stock in clamps.items():
            cell = json.loads((cells / f"cells/{name}.json").read_text())
            urdf = cells / "cells" / cell["urdf"]
            text = urdf.read_text()
            if stock:
                text = text.replace('<link name="stock"/>', stock)
            else:
                clamp = ("<collision><origin xyz='0.09 0 0.1'/><geometry><box size='0.06 0.08 0.2'/></geometry>"
                         "</collision></link>")
                text = text.replace("</link>", clamp, 1)
            clamped = name.split("-")[0]
            (cells / f"robots/clamped-{clamped}.urdf").write_text(text)
            cell["urdf"] = f"../robots/clamped-{clamped}.urdf"
            (cells / f"cells/clamped-{clamped}.json").write_text(json.dumps(cell))
        return cells / "cells"

    def environment(self):
        return {**os.environ, "SCULPT_CELLS": str(self.cells), "SCULPT_CACHE": ""}

    def plan(self, program, target, out, seed=0):
        """The trajectory's bytes, or why there is none."""
        cell, mesh, n, search = target
        out.unlink(missing_ok=True)
        try:
            said = run(program, "plan", SAMPLES / f"{mesh}.stl", "--resolution", n, "--robot",
                       self.cells / f"{cell}.json", "--search", search, "--seed", seed, "--threads", 1, "-o", out,
                       "--json", env=self.environment(), timeout=LIMIT_S)
        except subprocess.TimeoutExpired:
            return None, f"more than {LIMIT_S} s"
        whole = out.exists() and b'"type":"end"' in out.read_bytes()[-300:]
        if said.returncode not in (0, 1) or not whole:
            return None, (said.stderr.strip().splitlines() or [f"exit {said.returncode}"])[-1][:90]
        return out.read_bytes(), ""

    def replay(self, target, out):
        cell, mesh, n, _ = target
        said = run(self.sound, "verify", out, "--mesh", SAMPLES / f"{mesh}.stl", "--robot", self.cells / f"{cell}.json",
                   "--resolution", n, "--json", env=self.environment())
        if said.returncode not in (0, 1):
            return said.stderr.strip()[:90]  # no trajectory at all: that is found, too
        findings = json.loads(said.stdout)["findings"]
        return findings[0]["sentence"][:90] if findings else ""

    def sample(self, target, out, lines=()):
        """What overlaps, in all of a file or from line to line of it; "" if nothing does."""
        said = run(self.sampler, self.cells / f"{target[0]}.json", out, *lines)
        if said.returncode == 2:
            raise RuntimeError(said.stderr)
        return "" if said.returncode == 0 else said.stdout.strip()


class Workshop(Bench):
    """A copy of this commit in which one line at a time is another; `sound` is what it makes without faults."""

    def __init__(self, folder):
        self.tree, self.build = folder / "tree", folder / "build"
        folder.mkdir(parents=True, exist_ok=True)
        shutil.rmtree(self.tree, ignore_errors=True)
        run("git", "clone", "--quiet", SOURCE, self.tree, check=True)
        configure = ["cmake", "--preset", "release", "-B", self.build, *os.environ.get("MUTANTS_CMAKE", "").split()]
        made = run(*configure, cwd=self.tree)
        if made.returncode != 0:
            sys.exit(made.stderr)
        if not self.make():
            sys.exit("the tree does not build without faults")
        super().__init__(folder, pathlib.Path(shutil.copy(self.build / "bin/sculpt", folder / "sculpt")))

    def make(self, target="sculpt"):
        return run("cmake", "--build", self.build, "--target", target, cwd=self.tree).returncode == 0
