"""The page of bench/cells: finished runs -> what cells.json holds -> Markdown."""

from cells_rows import THREADS, cell_of, goals_of, row_name, rows_of
from figures import figure, machine, markdown_table, residue, verdict
from planner_page import BUSY_CORES, find_faults, make_goal, plan_seconds, quotient, removed


def make_document(cells, results):
    """`results`: by cell, those that are here."""
    rows = {row: make_row(row, runs, results[cell_of(row)]) for row, runs in rows_of(cells).items() if cell_of(row) in results}
    identity = next(iter(results.values())).identity
    about = {name: {"what": cell.what, "meshes": cell.meshes, "here": name in results} for name, cell in cells.items()}
    goals = [make_goal(goal, rows) for name, cell in cells.items() if name in results for goal in goals_of(cell)]
    return {"machine": machine(), "program_sha256": identity["program_sha256"], "mesh": identity["mesh"], "cells": about, "rows": rows, "goals": goals,
            "faults": [fault for row in rows.values() for fault in row["faults"]]}


def make_row(name, runs, results):
    """Finished runs are `runs`, those that were stopped or refused `without_plan`. Figures that need runs that are not there are None."""
    read = {run: results.read(run) for run in runs}
    row = {"row": name, "cell": cell_of(name), "size": runs[0].size,
           "runs": {f"sweep {run.threads}": result for run, result in read.items() if result and "report" in result},
           "without_plan": {f"sweep {run.threads}": result for run, result in read.items() if result and "report" not in result}}
    hashes = {run["plan_sha256"] for run in row["runs"].values()}
    row["same_plan"] = len(hashes) == 1 if len(row["runs"]) == len(THREADS) else None
    row["figures"] = figures_of(row["runs"].get(f"sweep {THREADS[-1]}"))
    row["faults"] = find_faults(row) + [f"{name}: {result['refused']}" for result in row["without_plan"].values() if "refused" in result]
    return row


def figures_of(run):
    if run is None:
        return dict.fromkeys(("plan_s", "by_sweep_percent", "moves_per_voxel"))
    report = run["report"]
    by_sweep = quotient(report.get("sweep", {}).get("cut"), report["voxels"]["removed"])
    return {"plan_s": plan_seconds(run), "by_sweep_percent": None if by_sweep is None else 100 * by_sweep,
            "moves_per_voxel": report["quality"]["moves_per_voxel"]}


# ---- Markdown

def busy_note(rows):
    """A warning where other programs took a good part of the machine; there are too many rows to name each."""
    cores = [run["other_cores"] or 0 for row in rows for run in row["runs"].values()]
    busy = sum(each >= BUSY_CORES for each in cores)
    return (f"\n**Other programs kept up to {figure(max(cores), 2)} cores busy** during {busy} of {len(cores)} runs: their seconds say little. "
            "--again on an idle machine.\n") if busy else ""


def say_late(result):
    return f"{'replay ' if result['stage'] == 'replay' else ''}not in {result['not_in_s']:g} s"


def seconds_or_why(row, threads):
    """Planning seconds, or why there are none."""
    key = f"sweep {threads}"
    if key in row["runs"]:
        return figure(plan_seconds(row["runs"][key]))
    if key in row["without_plan"]:
        result = row["without_plan"][key]
        return say_late(result) if "not_in_s" in result else "refused"
    return "-"


def table_seconds(document):
    sizes = sorted({row["size"] for row in document["rows"].values()})
    lines = []
    for name, about in document["cells"].items():
        rows = [document["rows"].get(row_name(name, size)) for size in sizes]
        lines.append((name, about["what"], *(seconds_or_why(row, THREADS[-1]) if row else "" for row in rows)) if about["here"] else
                     (name, f"{about['what']}; **not here: needs the shared data**", *[""] * len(sizes)))
    return f"## Planning seconds, {THREADS[-1]} threads\n\n" + markdown_table(("cell", "what", *(f"{size}^3" for size in sizes)), lines)


def table_goals(document):
    lines = []
    for goal in document["goals"]:
        unit = f" {goal['unit']}" if goal["unit"] else ""
        must, aim, measured = (figure(goal[key], 4) + unit if goal[key] is not None else "-" for key in ("must", "aim", "measured"))
        lines.append((goal["row"], goal["what"], must, aim, measured, goal["verdict"]))
    return "## Against the goals\n\n" + markdown_table(("row", "what", "must", "aim", "measured", "verdict"), lines) + (
        "\nCut by `sweep` itself: of what was removed; the rest fell to `octree`. It is empty where a build does not report it.\n")


def table_plans(rows):
    head = ("row", *(f"plan s, {threads} thr." for threads in reversed(THREADS)), "by sweep", "moves a voxel", "remove", "removed", "residue", "transits",
            "OMPL asked", "solved", "peak MiB", "verify s", "verify", "same plan")
    return "## Plans\n\n" + markdown_table(head, [line_of_plan(row) for row in rows]) + (
        f"\nSame plan: the same sha256 with {' and '.join(map(str, THREADS))} threads. Verify is the replay of the written trajectory by a second checker. "
        "Each figure is that of the run with the median planning time, of up to 3 runs where they are quick.\n")


def line_of_plan(row):
    seconds = [seconds_or_why(row, threads) for threads in reversed(THREADS)]
    run = row["runs"].get(f"sweep {THREADS[-1]}") or next(iter(row["runs"].values()), None)
    if run is None:
        return (row["row"], *seconds, *["-"] * 12)
    report, quality, by_sweep = run["report"], run["report"]["quality"], row["figures"]["by_sweep_percent"]
    return (row["row"], *seconds, "-" if by_sweep is None else f"{by_sweep:.2f} %", figure(quality["moves_per_voxel"]), str(report["voxels"]["remove"]),
            removed(report["voxels"]), residue(report), str(report["path"]["transits"]), str(quality["ompl_calls"]), str(quality["ompl_solved"]),
            figure(report["peak_memory_bytes"] / 2 ** 20), figure(report["seconds"]["verify"]), verdict(report),
            {True: "yes", False: "**NO**", None: "-"}[row["same_plan"]])


def make_page(document):
    rows = [row for row in document["rows"].values() if row["runs"] or row["without_plan"]]
    text = ("# Cells of many makes, measured\n\nWritten by `bench/cells`: `sculpt plan --search sweep`. Machine: "
            f"{document['machine']}; build `{document['program_sha256'][:16]}`. Mesh: {document['mesh']['name']} (sha256 `{document['mesh']['sha256'][:16]}`).\n")
    missing = [name for name, about in document["cells"].items() if not about["here"]]
    if missing:
        text += f"\n**Left out**: {', '.join(missing)}. Their robots' meshes are in the shared data, whose folder SCULPT_SHARED_DATA names.\n"
    if document["faults"]:
        text += "\n**Faults**\n\n" + "".join(f"- {fault}\n" for fault in document["faults"])
    elif rows:
        text += "\nEvery plan below replays clean, removed and residue add up to what is to be removed, and the number of threads changes no plan.\n"
    if not rows:
        return text + "\nNothing was run yet.\n"
    return "\n".join((text + busy_note(rows), table_seconds(document), table_goals(document), table_plans(rows)))
