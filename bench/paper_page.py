"""The page of bench/paper: finished runs -> what paper.json holds -> Markdown."""

from figures import figure, machine, markdown_table, percent, residue, verdict
from paper_rows import PAPER_LEAVES, PAPER_MINUTES, PAPER_SECONDS, ROWS, Run, SearchRun

BUILD_SEARCH_BENCH = "cmake --preset release -DBENCH=ON && cmake --build --preset release --target bench_search"

def extrapolate(result):
    """Minutes of the whole from the samples of a stopped run: at the mean rate, and at that of the last quarter.

    The estimate is the longer of the two, and still a lower bound: large blocks come first, and small ones take longer a voxel.
    """
    (seconds, cut), remove = result["samples"][-1], result["voxels"]["remove"]
    earlier = next(sample for sample in result["samples"] if sample[0] >= 0.75 * seconds)
    late_rate = (cut - earlier[1]) / (seconds - earlier[0]) if seconds > earlier[0] else 0
    at_mean_rate = remove / cut * seconds / 60 if cut else None
    at_late_rate = (seconds + (remove - cut) / late_rate) / 60 if late_rate else None
    return {"measured_minutes": seconds / 60, "removed": cut, "remove": remove, "rate_per_s": cut / seconds, "late_rate_per_s": late_rate,
            "minutes_at_mean_rate": at_mean_rate, "minutes_at_late_rate": at_late_rate,
            "minutes": max(at_mean_rate, at_late_rate or 0) if cut else None}


def make_row(row, run, results):
    """What paper.json says of a row: state "measured", "extrapolated" or "not run", and the figures there are."""
    table = row.partition(":")[0]
    paper = {"I": lambda: PAPER_SECONDS[run.resolution][run.search], "II": lambda: PAPER_LEAVES[run.resolution],
             "III": lambda: PAPER_MINUTES[run.resolution], "G": lambda: None}[table]()
    entry = {"row": row, "search": run.search, "resolution": run.resolution, "paper": paper, "ours": None, "ratio": None, "state": "not run"}
    if table != "G":
        entry["robot"] = run.robot
        add_plan(entry, table, results.read(run))
    if table in ("I", "G"):
        add_search(entry, results.read(SearchRun(run.search, run.resolution)))
    if paper and entry["ours"]:
        entry["ratio"] = paper / entry["ours"]
    return entry


def add_plan(entry, table, result):
    if result is None:
        return
    entry["program_sha256"] = result["program_sha256"]
    report = result.get("report")
    if report is None:
        entry.update(state="extrapolated", extrapolation=extrapolate(result))
        entry["ours"] = entry["extrapolation"]["minutes"]
        return
    entry["report"] = report
    if table == "I":  # the paper's seconds are those of a search, so ours come from one
        entry["certified_seconds"] = report["seconds"]["plan"]
    else:
        entry.update(state="measured", ours=report["octree"]["leaves"] if table == "II" else report["seconds"]["plan"] / 60)


def add_search(entry, result):
    if result is not None:
        entry.update(state="measured", ours=result["search"]["seconds"], measure=result["search"],
                     search_program_sha256=result["program_sha256"])


def make_document(results):
    tables = {"I": [], "II": [], "III": [], "G": []}
    for row, runs in ROWS.items():
        table = row.partition(":")[0]
        tables[table] += [make_row(row, run, results) for run in runs if table == "G" or isinstance(run, Run)]
    return {"mesh": results.identity["mesh"], "machine": machine(), "tables": tables}


def ratio(entry):
    if entry["ratio"] is None:
        return "-"
    return f"at most {figure(entry['ratio'])} (extrapolated)" if entry["state"] == "extrapolated" else figure(entry["ratio"])


def ours(entry):
    if entry["state"] == "not run":
        return "not run"
    if entry["state"] == "extrapolated":
        return f"at least {figure(entry['ours'])} (extrapolated)" if entry["ours"] else "nothing cut in the time given"
    return figure(entry["ours"])


def table_1(entries):
    text = "## Table I: search time of the translating robot, seconds\n\n"
    rows = [(str(e["resolution"]), e["search"], figure(e["paper"]) if e["paper"] else "N/A", ours(e), ratio(e),
             figure(e["certified_seconds"]) if "report" in e else "not run") for e in entries]
    head = ("resolution", "search", "paper", "ours: search", "paper / ours", "ours: certified and written")
    return text + markdown_table(head, rows) + (
        "\nThe set-ups differ: the paper carves a full statue on hardware it does not state, here it is the mesh and the machine named above. "
        "Search is the search alone on one core, from voxels, octree and graph that are there: the median of up to 9 runs, of fewer where they take long. "
        "Certified and written is `seconds.plan` of the report: the search, the certificate of every edge, which the paper's translating robot does "
        "not have, and writing.\n") + cure(entries, "I")


def cure(entries, table):
    if all("measure" in e for e in entries):
        return ""
    return f"\nA search that was not run: `{BUILD_SEARCH_BENCH}`, then `bench/paper --rows {table}`.\n"


def table_2(entries):
    text = "## Table II: size of the voxel graph and of the octree graph\n\n"
    rows = []
    for e in entries:
        total = e["resolution"] ** 3
        report = e.get("report")
        rows.append((str(e["resolution"]), str(total), str(e["paper"]), percent(total - e["paper"], total), ours(e),
                     percent(total - e["ours"], total) if report else "-",
                     percent(report["voxels"]["keep"], total) if report else "-"))
    head = ("resolution", "voxels", "paper: leaves", "paper: decrease", "ours: leaves", "ours: decrease", "ours: kept share")
    return text + markdown_table(head, rows) + (
        "\nThe set-ups differ: the count depends on the shape alone, and the paper's is a full statue whose kept share is not stated, so compare at "
        "like shares only; the paper's counts are not of the form 1 + 7k that the leaves of a full octree have (docs/paper.md).\n")


def table_3(entries):
    text = "## Table III: search time of the manipulator, minutes\n\n"
    rows = [(str(e["resolution"]), str(e["paper"]), ours(e), ratio(e)) for e in entries]
    text += markdown_table(("resolution", "paper", "ours", "paper / ours"), rows) + (
        "\nThe set-ups differ: the paper carves a full statue with a Panda in Gazebo on hardware it does not state, here it is the mesh, the machine and "
        "the cell `panda-turntable`; our minutes are `seconds.plan` and include the certificate of every edge between its ends.\n")
    return text + "".join(extrapolation_note(e) for e in entries if e["state"] == "extrapolated")


def extrapolation_note(entry):
    x = entry["extrapolation"]
    mean, late = (figure(x[key]) if x[key] else "unknown" for key in ("minutes_at_mean_rate", "minutes_at_late_rate"))
    return (f"\n**Extrapolated, not measured:** {entry['row']} was stopped after {figure(x['measured_minutes'])} min with {x['removed']} of {x['remove']} "
            f"voxels cut ({figure(x['rate_per_s'])} a second). The whole would take {mean} minutes at that mean rate, {late} at the rate of the last "
            "quarter; the longer one is in the table. Read it as a lower bound: large blocks come first, and small ones take longer a voxel. The start-up counts "
            "as planning; a stopped run is not verified.\n")


def table_growth(entries):
    text = "## Growth: the search of the translating robot, from 8 to 512\n\n"
    head = ("resolution", "order", "search s", "voxels passed", "ns / voxel passed", "moves / removed voxel", "turns", "octree and graph s", "peak MiB")
    rows = []
    for e in entries:
        m = e.get("measure")
        rows.append((str(e["resolution"]), e["search"], ours(e)) + (
            (str(m["voxels_passed"]), figure(m["ns_per_voxel_passed"]), f"{m['moves_per_voxel']:.4f}", str(m["turns"]),
             figure(m.get("seconds_octree_and_graph")), figure(m["peak_memory_bytes"] / 2 ** 20)) if m else ("-",) * 6))
    return text + markdown_table(head, rows) + (
        "\nSearch seconds as in table I. Voxels passed are the steps from voxel to voxel, cuts and travel, from home and back; 1 move a removed voxel is the "
        "floor. `nearest` is plain nearest neighbour: always to the voxel with the shortest way, of equals the lowest in z, y, x. Octree and graph are "
        "built before the search and not in its seconds.\n") + cure(entries, "G")


def table_quality(entries):
    head = ("run", "removed", "residue", "moves / voxel", "air travel m", "turns", "transits", "joint travel rad", "OMPL solved / calls",
            "checks / voxel", "verify", "plan sha256")
    rows = []
    for run, report in entries.items():
        path, quality = report["path"], report["quality"]
        rows.append((str(run), str(report["voxels"]["removed"]), residue(report), figure(quality["moves_per_voxel"], 5), figure(path["travel_m"], 4),
                     str(quality["turns"]), str(path["transits"]), figure(path["joint_travel_rad"], 5),
                     f"{quality['ompl_solved']} / {quality['ompl_calls']}", figure(quality["checks_per_voxel"], 4), verdict(report),
                     f"`{report['plan_sha256']}`"))
    return "## Path quality\n\n" + markdown_table(head, rows) + (
        "\nA move is one voxel edge of the ball's path (chords between keyframes, from home and back), so 1 move a voxel is the floor. The paper gives none "
        "of these figures. Checks are configurations tested. Verify is the replay of the written trajectory by a second checker.\n")


def measured_reports(document):
    """By run, in the order of the tables, each once."""
    entries = [entry for table in document["tables"].values() for entry in table if "report" in entry]
    return {Run(e["robot"], e["search"], e["resolution"]): e["report"] for e in entries}


def builds_note(document):
    """A warning where the rows of one program come from several builds of it."""
    text = ""
    for program, key in (("sculpt", "program_sha256"), ("bench_search", "search_program_sha256")):
        builds = {e[key] for table in document["tables"].values() for e in table if key in e}
        if len(builds) > 1:
            text += f"\n**The rows were measured with {len(builds)} different builds of {program}** (`{key}` in paper.json); --again makes them one.\n"
    return text


def make_page(document):
    reports = measured_reports(document)
    threads = sorted({report["threads"] for report in reports.values()})
    mesh = document["mesh"]
    text = ("# The paper's tables, measured again\n\nJain, Hutchinson, Dellaert: *Robotic Sculpting with Collision-free Motion Planning in Voxel Space*. "
            "Written by `bench/paper`; how open points were decided is in docs/paper.md.\n\n"
            f"Mesh: {mesh['name']} (sha256 `{mesh['sha256'][:16]}`). Machine: {document['machine']}"
            + (f"; threads: {', '.join(map(str, threads))}" if threads else "") + ".\n")
    tables = document["tables"]
    return "\n".join([text + builds_note(document), table_1(tables["I"]), table_2(tables["II"]), table_3(tables["III"]), table_growth(tables["G"]),
                      table_quality(reports)])
