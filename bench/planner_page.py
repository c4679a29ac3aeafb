"""The page of bench/planner: finished runs -> what planner.json holds -> Markdown."""

from figures import figure, machine, markdown_table, percent, residue, verdict
from planner_rows import GOALS, LARGEST_OCTREE, MESHES, MIB, ROBOT, SIZES, THREADS, row_name, runs_of

BUSY_CORES = 0.2  # kept busy by other programs: from there on the page warns
STAGES = ("load", "voxelize", "octree", "plan", "verify")


def make_document(results):
    """`results`: by mesh, those that are there."""
    rows = {}
    for mesh in results:
        for size in SIZES:
            rows[row_name(mesh, size)] = make_row(mesh, size, results[mesh], rows.get(row_name(mesh, size // 2)))
    meshes = {mesh: of_mesh.identity["mesh"] for mesh, of_mesh in results.items()}
    program = next(iter(results.values())).identity["program_sha256"]
    return {"machine": machine(), "robot": ROBOT, "program_sha256": program, "meshes": meshes, "rows": rows,
            "goals": [make_goal(goal, rows) for goal in GOALS], "faults": [fault for row in rows.values() for fault in row["faults"]]}


def make_row(mesh, size, results, half):
    """`half`: the row of half the size. Figures that need runs that are not there are None."""
    runs = {f"{run.search} {run.threads}": results.read(run) for run in runs_of(mesh, size)}
    row = {"row": row_name(mesh, size), "mesh": mesh, "size": size, "runs": {key: run for key, run in runs.items() if run}}
    one, two = (runs[f"sweep {threads}"] for threads in THREADS)
    octree = runs.get(f"octree {THREADS[-1]}")
    row["figures"] = {**figures_of_sweep(two), "ndjson_bytes": one["bytes"] if one else None,
                      "octree_ratio": quotient(plan_seconds(octree), plan_seconds(two)),
                      "second_thread": quotient(plan_seconds(one), plan_seconds(two))}
    row["figures"]["growth"] = quotient(row["figures"]["to_last_byte_s"], half and half["figures"]["to_last_byte_s"])
    row["faults"] = find_faults(row)
    row["same_plan"] = one["plan_sha256"] == two["plan_sha256"] if one and two else None
    return row


def figures_of_sweep(run):
    names = ("to_last_byte_s", "verify_s", "verified_s", "peak_mib", "sct_mb", "removed_percent", "travel_ratio")
    if run is None:
        return dict.fromkeys(names)
    report, path, voxels = run["report"], run["report"]["path"], run["report"]["voxels"]
    return dict(zip(names, (run["to_last_byte_s"], report["seconds"]["verify"],
                            run["to_last_byte_s"] + report["seconds"]["verify"], report["peak_memory_bytes"] / MIB, run["bytes"] / 1e6,
                            100 * voxels["removed"] / voxels["remove"] if voxels["remove"] else None,
                            quotient(path["travel_m"], path["cut_m"]))))


def plan_seconds(run):
    return run and run["report"]["seconds"]["plan"]


def quotient(a, b):
    return a / b if a is not None and b else None


def choose_sample(samples):
    """One of several runs of the same plan: that with the median planning time."""
    return sorted(samples, key=plan_seconds)[(len(samples) - 1) // 2]


def find_faults(row):
    """What must not be, as sentences."""
    faults = []
    for key, run in row["runs"].items():
        report, voxels, name = run["report"], run["report"]["voxels"], f"{row['row']} by {key.replace(' ', ' with ')} thread(s)"
        if not report["verify"]["clean"]:
            faults.append(f"{name}: the replay found {report['verify']['collisions']} contacts")
        if voxels["removed"] + voxels["residue"] != voxels["remove"]:
            faults.append(f"{name}: {voxels['removed']} removed and {voxels['residue']} residue are not the {voxels['remove']} to remove")
        if len(set(run["all_sha256"])) > 1:
            faults.append(f"{name}: {len(set(run['all_sha256']))} different plans in {len(run['all_sha256'])} runs")
    sweeps = [run for key, run in row["runs"].items() if key.startswith("sweep")]
    if len({run["plan_sha256"] for run in sweeps}) > 1:
        faults.append(f"{row['row']}: not the same plan with {' and '.join(map(str, THREADS))} threads")
    return faults


def make_goal(goal, rows):
    measured = {row: rows[row]["figures"][goal.figure] for row in goal.rows if row in rows}
    row = next((row for row, value in measured.items() if value is not None), goal.rows[0])
    value = measured.get(row)
    return {**goal._asdict(), "row": row, "measured": value, "verdict": judge(goal, value)}


def judge(goal, value):
    if value is None:
        return "not run"
    sign = 1 if goal.sense == "below" else -1
    if goal.aim is not None and sign * value <= sign * goal.aim:
        return "aim met"
    return "must met" if sign * value <= sign * goal.must else "missed"


# ---- Markdown

def busy_note(rows):
    """A warning where other programs took a good part of the machine."""
    cores = {f"{row['row']} {key}": run["other_cores"] for row in rows for key, run in row["runs"].items() if (run["other_cores"] or 0) >= BUSY_CORES}
    if not cores:
        return ""
    return (f"\n**Other programs kept up to {figure(max(cores.values()), 2)} cores busy** during {', '.join(cores)}: their seconds, and what is made of them, "
            "say little. --again on an idle machine.\n")


def table_goals(document):
    rows = []
    for goal in document["goals"]:
        unit = f" {goal['unit']}" if goal["unit"] else ""
        must, aim, measured = (figure(goal[key], 5) + unit if goal[key] is not None else "-" for key in ("must", "aim", "measured"))
        rows.append((goal["what"], goal["row"], must, aim, measured, goal["verdict"]))
    return "## Against the goals\n\n" + markdown_table(("what", "row", "must", "aim", "measured", "verdict"), rows) + (
        "\nMemory is the peak of the whole process, replay included. Growth is of mesh file to last byte, second thread of planning. "
        "The aim for what is removed is all that any direction reaches, which is no number here: see the residue by reason below.\n")


def table_seconds(rows):
    head = ("row", "remove", *STAGES, "to last byte", "verified", "growth", f"plan, {THREADS[0]} thread", "second thread", "`octree`: plan", "`octree` / sweep",
            "peak MiB")
    lines = []
    for row in rows:
        one, two = (row["runs"].get(f"sweep {threads}") for threads in THREADS)
        octree = row["runs"].get(f"octree {THREADS[-1]}")
        of = row["figures"]
        report = (two or one)["report"]
        stages = [figure(report["seconds"][stage]) if two else "-" for stage in STAGES]
        lines.append((row["row"], str(report["voxels"]["remove"]), *stages, figure(of["to_last_byte_s"]), figure(of["verified_s"]),
                      figure(of["growth"]), figure(plan_seconds(one)),
                      figure(of["second_thread"]), figure(plan_seconds(octree)) if row["size"] <= LARGEST_OCTREE else "",
                      figure(of["octree_ratio"]) if row["size"] <= LARGEST_OCTREE else "", figure(of["peak_mib"])))
    return f"## Seconds by stage, {THREADS[-1]} threads\n\n" + markdown_table(head, lines) + (
        "\nTo last byte: from the start of the program to its end, less the replay, with the .sct written. Verify: the replay "
        "after the last keyframe, most of it was done beside the plan. Verified: both together. Growth: of that, against the row of half the "
        "size. Each figure is that of the run with the median planning time, of up to 3 runs where they are quick.\n")


def table_plans(rows):
    head = ("row", "threads", "removed", "residue", "keyframes", "rows", "transits", "cut m", "travel m", "travel / cut", ".sct bytes", ".ndjson bytes",
            "bytes a keyframe", "verify", "same plan", "plan sha256")
    lines = []
    for row in rows:
        one, two = (row["runs"].get(f"sweep {threads}") for threads in THREADS)
        run = two or one
        report, path = run["report"], run["report"]["path"]
        lines.append((row["row"], str(report["threads"]), removed(report["voxels"]), residue(report), str(path["keyframes"]), str(path["rows"]),
                      str(path["transits"]), figure(path["cut_m"], 5), figure(path["travel_m"], 5), figure(quotient(path["travel_m"], path["cut_m"])),
                      figure(two and two["bytes"]), figure(one and one["bytes"]), figure(quotient(two and two["bytes"], path["keyframes"])),
                      verdict(report), {True: "yes", False: "**NO**", None: "-"}[row["same_plan"]], f"`{run['plan_sha256'][:16]}`"))
    return "## Plans\n\n" + markdown_table(head, lines) + (
        f"\nSame plan: the same sha256 with {' and '.join(map(str, THREADS))} threads. Verify is the replay of the written trajectory by a second checker.\n")


def removed(voxels):
    share = f" ({percent(voxels['removed'], voxels['remove'], 3)})" if voxels["remove"] else ""
    return f"{voxels['removed']}{share}"


def table_octree(rows):
    head = ("row", "removed", "residue", "keyframes", "transits", "travel / cut", "plan s", "verify")
    lines = []
    for row in rows:
        run = row["runs"].get(f"octree {THREADS[-1]}")
        if run:
            report, path = run["report"], run["report"]["path"]
            lines.append((row["row"], removed(report["voxels"]), residue(report), str(path["keyframes"]), str(path["transits"]),
                          figure(quotient(path["travel_m"], path["cut_m"])), figure(plan_seconds(run)), verdict(report)))
    return "## The same rows by `octree`\n\n" + (markdown_table(head, lines) if lines else "None was run.\n")


def make_page(document):
    rows = [row for row in document["rows"].values() if any(key.startswith("sweep") for key in row["runs"])]
    meshes = ", ".join(f"{mesh} ({of['name']}, sha256 `{of['sha256'][:16]}`)" for mesh, of in document["meshes"].items())
    missing = [mesh for mesh in MESHES if mesh not in document["meshes"]]
    text = ("# The `sweep` planner, measured\n\nWritten by `bench/planner`: `sculpt plan --search sweep` and, up to "
            f"{LARGEST_OCTREE}, `--search octree`, with the cell `{document['robot']}`. Machine: {document['machine']}; build `{document['program_sha256'][:16]}`. "
            f"Meshes: {meshes}." + (f" Not there: {', '.join(missing)}." if missing else "") + "\n")
    faults = document["faults"]
    text += "\n**Faults**\n\n" + "".join(f"- {fault}\n" for fault in faults) if faults else (
        "\nEvery plan below replays clean, removed and residue add up to what is to be removed, and the number of threads changes no plan.\n" if rows else "")
    text += busy_note(rows)
    if not rows:
        return text + "\nNothing was run yet.\n\n" + table_goals(document)
    return "\n".join((text, table_goals(document), table_seconds(rows), table_plans(rows), table_octree(rows)))
