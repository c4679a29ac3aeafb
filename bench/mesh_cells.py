"""Cells whose robots are not part of the repository: made at run time from the URDF of the shared data and a room of our own."""

import json
import xml.etree.ElementTree

from programs import SOURCE, shared_data

PANDA_MESHES = "panda-meshes"
PACKAGE = "moveit_resources_panda_description"
ROOM = SOURCE / "bench/cells_data/robots/panda-room.urdf"
CELL = SOURCE / "bench/cells_data/panda-meshes.json"
TAKEN_OFF = ("panda_hand", "panda_leftfinger", "panda_rightfinger")  # where the spindle goes


def make_panda_meshes(folder):
    """Writes the cell of the Panda with meshes into `folder`; returns the cell's file. Throws OSError where its URDF is not there."""
    package = (shared_data() / "ros" / PACKAGE).resolve()
    robot = xml.etree.ElementTree.parse(package / "urdf/panda.urdf").getroot()
    for part in list(robot):
        if part.get("name") in TAKEN_OFF or any(joined.get("link") in TAKEN_OFF for joined in part.iter("child")):
            robot.remove(part)
    robot.extend(xml.etree.ElementTree.parse(ROOM).getroot())
    folder.mkdir(parents=True, exist_ok=True)
    xml.etree.ElementTree.ElementTree(robot).write(folder / f"{PANDA_MESHES}.urdf", encoding="unicode")
    cell = {"urdf": f"{PANDA_MESHES}.urdf", "packages": {PACKAGE: str(package)}, **json.loads(CELL.read_text())}
    (folder / f"{PANDA_MESHES}.json").write_text(json.dumps(cell, indent=1) + "\n")
    return folder / f"{PANDA_MESHES}.json"
