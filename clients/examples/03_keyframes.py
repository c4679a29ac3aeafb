"""Read a plan in the compact binary form, keyframe by keyframe: 03_keyframes.py SERVER JOB"""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "python"))
import sculpt

server, job = sys.argv[1:]
with sculpt.Client(server, "03_keyframes") as client, tempfile.NamedTemporaryFile(suffix=".sct") as file:
    for chunk in client.read_artifact(job, "trajectory", format="binary"):
        file.write(chunk)
    file.flush()
    lines = list(sculpt.read_sct(file.name))
print(sum(line["type"] == "cut" for line in lines), "cuts,", sum(line["type"] == "move" for line in lines), "moves")
