"""The rows of bench/cells: a cell at a resolution; which cells there are, and what the planner is to reach in each."""

import collections
import pathlib

from mesh_cells import PANDA_MESHES
from planner_rows import Goal
from programs import SOURCE, shared_data

CELLS_DATA = SOURCE / "bench/cells_data/cells"
SIZES = (16, 32, 64)
THREADS = (1, 2)


class Cell(collections.namedtuple("Cell", "name what path meshes sizes", defaults=(False, SIZES))):
    """`path`: its file, or where a cell that is made at run time has its sources. `meshes`: its links are its maker's meshes."""

    @property
    def is_here(self):
        return self.path.exists()


def own(name, what, **more):
    return Cell(name, what, CELLS_DATA / f"{name}.json", **more)


def shared(name, what):
    return Cell(name, what, shared_data() / f"cells/{name}.json", meshes=True)


def by_name(cells):
    return {cell.name: cell for cell in cells}


CELLS = by_name((
    Cell("panda-turntable", "shipped: Franka Panda, turntable", SOURCE / "config/cells/panda-turntable.json"),
    own("ur10e", "UR10e, turntable at 0.7 m"),
    own("ur10e-far", "UR10e, turntable at 0.9 m"),
    own("ur10e-low", "UR10e, flat turntable on the bench, no spindle beside the flange"),
    own("ur10e-6mm", "UR10e, turntable at 0.7 m, 6 mm tool in a 35 mm holder, 80 mm free", sizes=(16, 32)),  # a voxel at 64 is thinner than the tool
    own("six-axis", "KR 16-like, no turntable"),
    own("rail", "KR 16-like on a rail, no turntable"),
    own("five-axis", "gantry machine with a fork head"),
    own("scara", "SCARA over a fixed stock: three axes"),
    own("scara-tilt", "SCARA over a tilting turntable"),
    own("tx2-90", "Staubli TX2-90L, turntable"),
    own("crx-10", "FANUC CRX-10iA/L (offset wrist), turntable"),
    own("iiwa-ceiling", "KUKA iiwa 14 (seven axes) at the ceiling, turntable"),
    own("ur5e-wall", "UR5e on a wall, turntable"),
    own("irb6640", "ABB IRB 6640 with balancing cylinder, turntable, stock of 0.6 m"),
    shared("kr16", "KUKA KR 16, all links as meshes, turntable"),
    shared("kr120", "KUKA KR 120, all links as meshes, turntable"),
    Cell(PANDA_MESHES, "Franka Panda, all links as meshes, turntable", shared_data() / "ros/moveit_resources_panda_description", meshes=True),
))


class Run(collections.namedtuple("Run", "cell size threads")):
    """One plan by `sculpt plan`, made several times where that is quick."""

    def __str__(self):
        return f"{self.cell} {self.size} {self.threads}"


def row_name(cell, size):
    return f"{cell}:{size}"


def rows_of(cells):
    """The sizes of each cell in order; more threads first, so that what takes too long shows itself sooner."""
    return {row_name(name, size): [Run(name, size, threads) for threads in reversed(THREADS)] for name, cell in cells.items() for size in cell.sizes}


def cell_of(row):
    return row.partition(":")[0]


def cell_of_file(path):
    """A cell that the user names by its file."""
    path = pathlib.Path(path)
    return Cell(path.stem, f"named by --cell: {path.name}", path)


def goals_of(cell):
    """`figure` of one of the rows of the cell; each cell has the same but for the seconds."""
    largest, smallest = cell.sizes[-1], cell.sizes[0]
    row, small = (row_name(cell.name, largest),), (row_name(cell.name, smallest),)
    every = [Goal("cut by `sweep` itself", row, "by_sweep_percent", "above", 99, 99.9, "%"),
             Goal("moves a voxel", row, "moves_per_voxel", "below", 1.5, 1.3, "")]
    if cell.meshes:
        return [Goal("planned", small, "plan_s", "below", 1, 0.1, "s"), Goal("planned", row, "plan_s", "below", 3, 0.3, "s"), *every]
    return [Goal("planned", row, "plan_s", "below", 1, 0.2, "s"), *every]
