"""Plans keep their bytes: `plan_sha256` of many jobs, as written down in plans.tsv.

A change of a hash is a change of plans: someone must want it, look at the new plans, and write the table anew:
    SCULPT_GOLDEN=write python3 tests/golden/plans_test.py          (all rows; minutes)
    SCULPT_GOLDEN=all ...                                           (compares all rows, not only the short ones)
sin and cos give other bits with and without FMA, so the runs are made without.
"""

import csv
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ.get("SCULPT_SOURCE", pathlib.Path(__file__).parents[2]))
SCULPT = os.environ.get("SCULPT", str(SOURCE / "build/release/bin/sculpt"))
TABLE = pathlib.Path(__file__).parent / "plans.tsv"
MODE = os.environ.get("SCULPT_GOLDEN", "short")
FOLDERS = {"samples": SOURCE / "config/samples", "shared": SOURCE.parent / "shared/data/meshes"}
WITHOUT_FMA = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2_Usable,-AVX2,-FMA_Usable"}
COLUMNS = ["mesh", "resolution", "robot", "search", "seed", "short", "plan_sha256"]


def jobs():
    """Every job of the table without its hash; arms with `octree` only up to 32, above it takes minutes."""
    arms = {"sweep": "panda-turntable", "octree": "panda-turntable"}
    gantries = {"octree": "gantry", "voxel": "gantry"}
    for mesh, resolutions in (("samples/bust.stl", (16, 32)), ("samples/vase.stl", (16, 32)), ("samples/dish.stl", (16, 32)),
                              ("shared/david.stl", (16, 32, 64, 128)), ("shared/stanford-bunny.obj", (16, 32, 64, 128))):
        for resolution in resolutions:
            for search, robot in (*arms.items(), *gantries.items()):
                if robot in arms.values() and search == "octree" and resolution > 32:
                    continue
                for seed in (0, 7):
                    quick = search == "sweep" or robot == "gantry" and resolution <= 32 or resolution <= 16 and seed == 0
                    short = mesh.startswith("samples") and resolution <= 32 and quick
                    yield dict(mesh=mesh, resolution=resolution, robot=robot, search=search, seed=seed, short=int(short))


def mesh_path(job):
    folder, name = job["mesh"].split("/")
    return FOLDERS[folder] / name


def plan_sha256(job):
    with tempfile.TemporaryDirectory() as folder:
        options = ["--allow-freed"] if job["robot"] == "gantry" else []
        run = subprocess.run(
            [SCULPT, "plan", str(mesh_path(job)), "--resolution", str(job["resolution"]), "--robot", str(SOURCE / f"config/cells/{job['robot']}.json"),
             "--search", job["search"], "--seed", str(job["seed"]), "--json", *options, "-o", f"{folder}/plan.sct"],
            capture_output=True, text=True, env={**os.environ, **WITHOUT_FMA, "SCULPT_CACHE": ""})
        if run.returncode != 0:
            raise AssertionError(f"{job}: exit {run.returncode}: {run.stderr}")
        report = json.loads(run.stdout)
        if not report["verify"]["clean"]:
            raise AssertionError(f"{job}: the replay is not clean")
        return report["plan_sha256"]


def write_table():
    with TABLE.open("w", newline="") as file:
        table = csv.DictWriter(file, COLUMNS, delimiter="\t", lineterminator="\n")
        table.writeheader()
        for job in jobs():
            table.writerow({**job, "plan_sha256": plan_sha256(job)})
            file.flush()
            print(job, flush=True)


class Golden(unittest.TestCase):
    def test_every_plan_is_what_it_was(self):
        with TABLE.open(newline="") as file:
            rows = [row for row in csv.DictReader(file, delimiter="\t") if MODE == "all" or row["short"] == "1"]
        self.assertTrue(rows)
        missing = {row["mesh"] for row in rows if not mesh_path(row).exists()}
        for mesh in sorted(missing):
            print(f"rows of {mesh} are left out: the file is not there")
        for row in rows:
            if row["mesh"] not in missing:
                with self.subTest(**{key: row[key] for key in COLUMNS[:5]}):
                    self.assertEqual(plan_sha256(row), row["plan_sha256"])


if __name__ == "__main__":
    write_table() if MODE == "write" else unittest.main()
