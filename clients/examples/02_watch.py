"""Follow a job's events: 02_watch.py SERVER JOB"""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "python"))
import sculpt

server, job = sys.argv[1:]
with sculpt.Client(server, "02_watch") as client:
    client.call("events.subscribe", job=job, after=0)  # from the first event on, also of a job that has ended
    state = None
    while state not in sculpt.FINAL:
        event = client.next_event()
        if event["type"] == "progress":
            print(event["data"]["stage"], f"{event['data']['done']}/{event['data']['total']}")
        elif event["type"] == "state":
            state = event["data"]["to"]
            print(event["seq"], state)
sys.exit(state != "succeeded")
