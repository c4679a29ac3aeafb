"""Submit a mesh, wait, look at the figures, fetch the trajectory: 01_plan.py SERVER MESH OUT"""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "python"))  # or copy sculpt.py beside your program
import sculpt

server, mesh, out = sys.argv[1:]
with sculpt.Client(server, "01_plan") as client:
    spec = {"mesh": client.upload_file(mesh), "resolution": 16, "robot": "gantry"}
    key = spec["mesh"]["blob"]  # with a key of your own it is queued once, even if the connection breaks meanwhile
    job = client.submit(spec, key=key)["job"]

    ended = client.wait(job)
    if ended["state"] != "succeeded":
        sys.exit(f"{job}: {ended['state']}")
    report = client.call("job.report", job=job)
    print(f"removed {report['voxels']['removed']} of {report['voxels']['remove']} voxels")
    with open(out, "wb") as file:
        for chunk in client.read_artifact(job, "trajectory", format="ndjson"):
            file.write(chunk)
