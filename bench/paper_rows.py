"""The rows of the paper's tables: its figures, and the runs of ours that each row needs."""

import collections

LONG_ROWS = ("I:256", "III:64", "III:256", "G:512")
TIMED_ROW = "III:256"

PAPER_SECONDS = {  # table I: resolution -> voxel search, octree search; None is the paper's N/A
    8: {"voxel": 12, "octree": 14},
    16: {"voxel": 65, "octree": 25},
    64: {"voxel": 2745, "octree": 209},
    256: {"voxel": None, "octree": 1265},
}
PAPER_LEAVES = {8: 354, 16: 1756, 64: 53512, 256: 793403}
PAPER_MINUTES = {16: 7, 64: 47, 256: 457}
ORDERS = ("voxel", "octree", "nearest")
GROWTH = (8, 16, 32, 64, 128, 256, 512)


class Run(collections.namedtuple("Run", "robot search resolution")):
    """A whole plan, by `sculpt plan`."""

    def __str__(self):
        return f"{self.robot} {self.search} {self.resolution}"


class SearchRun(collections.namedtuple("SearchRun", "search resolution")):
    """The search of the translating robot alone, by `bench_search`."""

    def __str__(self):
        return f"search {self.search} {self.resolution}"


# Runs are shared: those of tables I and II, and the searches of I and of the growth.
ROWS = {
    **{f"I:{n}": [kind for search in ("voxel", "octree") for kind in (Run("gantry", search, n), SearchRun(search, n))]
       for n in PAPER_SECONDS},
    **{f"II:{n}": [Run("gantry", "octree", n)] for n in PAPER_LEAVES},
    **{f"III:{n}": [Run("panda-turntable", "octree", n)] for n in PAPER_MINUTES},
    **{f"G:{n}": [SearchRun(order, n) for order in ORDERS] for n in GROWTH},
}
