"""The rows of bench/planner: a mesh at a resolution, and the runs that each needs; what the planner is to reach."""

import collections

from programs import SOURCE, shared_mesh

MESHES = {  # the first two are not part of the repository
    "david": shared_mesh("david.stl"),
    "bunny": shared_mesh("stanford-bunny.obj"),
    **{name: SOURCE / f"config/samples/{name}.stl" for name in ("bust", "vase", "dish")},
}
SIZES = (16, 32, 64, 128, 256, 512)
LONG_SIZES = (256, 512)
LARGEST_OCTREE = 64
ROBOT = "panda-turntable"
THREADS = (1, 2)


class Run(collections.namedtuple("Run", "mesh search size threads")):
    """One plan by `sculpt plan`, made several times where that is quick."""

    def __str__(self):
        return f"{self.mesh} {self.search} {self.size} {self.threads}"


def row_name(mesh, size):
    return f"{mesh}:{size}"


def runs_of(mesh, size):
    sweeps = [Run(mesh, "sweep", size, threads) for threads in THREADS]
    return sweeps + [Run(mesh, "octree", size, THREADS[-1])] * (size <= LARGEST_OCTREE)


ROWS = {row_name(mesh, size): runs_of(mesh, size) for mesh in MESHES for size in SIZES}
LONG_ROWS = [row_name(mesh, size) for mesh in MESHES for size in LONG_SIZES]

# What is asked of David: `figure` of the first of `rows` that has one, `sense` ("below" or "above") must or even aim.
Goal = collections.namedtuple("Goal", "what rows figure sense must aim unit")
MIB = 2 ** 20
GOALS = (
    Goal("64^3, mesh file to last byte", ("david:64",), "to_last_byte_s", "below", 0.5, 0.05, "s"),
    Goal("256^3, mesh file to last byte", ("david:256",), "to_last_byte_s", "below", 10, 1, "s"),
    Goal("512^3, mesh file to last byte", ("david:512",), "to_last_byte_s", "below", 60, 5, "s"),
    Goal("peak memory at 256^3", ("david:256",), "peak_mib", "below", 1024, 256, "MiB"),
    Goal("peak memory at 512^3", ("david:512",), "peak_mib", "below", 1024, 512, "MiB"),
    Goal("plan size (.sct) at 256^3", ("david:256",), "sct_mb", "below", 64, 32, "MB"),
    Goal("removed at 256^3, paper's tool", ("david:256",), "removed_percent", "above", 99.94, None, "%"),
    Goal("planning against `octree`, 32^3", ("david:32",), "octree_ratio", "above", 100, 1000, "times"),
    Goal("planning against `octree`, 64^3", ("david:64",), "octree_ratio", "above", 100, 1000, "times"),
    Goal("growth 128 to 256", ("david:256",), "growth", "below", 6, 4.5, "times"),
    Goal("growth 256 to 512", ("david:512",), "growth", "below", 6, 4.5, "times"),
    Goal("second thread", ("david:256", "david:128", "david:64"), "second_thread", "above", 1.6, 1.9, "times"),
    Goal("air travel of cutting length", ("david:256", "david:128", "david:64"), "travel_ratio", "below", 0.5, 0.1, ""),
    Goal("64^3, mesh file to verified plan", ("david:64",), "verified_s", "below", 0.4, 0.15, "s"),
    Goal("256^3, mesh file to verified plan", ("david:256",), "verified_s", "below", 8, 3, "s"),
    Goal("512^3, mesh file to verified plan", ("david:512",), "verified_s", "below", 75, 25, "s"),
    Goal("replay after the last keyframe, 256^3", ("david:256",), "verify_s", "below", 5, 1, "s"),
)
