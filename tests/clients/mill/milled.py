"""A cell for small milled plans."""

import json
import shutil

from harness import SOURCE


def write_cell(folder):
    """The cell `studio` with a block of 50 mm: there is less to be done."""
    (folder / "cells").mkdir()
    (folder / "robots").mkdir()
    shutil.copy(SOURCE / "config/robots/studio.urdf", folder / "robots")
    cell = json.loads((SOURCE / "config/cells/studio.json").read_text())
    cell["stock"].update(size_m=0.05, origin_m=[-0.025, -0.025, 0.3])
    path = folder / "cells/small-studio.json"
    path.write_text(json.dumps(cell))
    return path
