"""Figures of reports as Markdown."""

import os
import pathlib
import platform
import re


def machine():
    model = "processor unknown"
    try:
        found = re.search(r"^model name\s*:\s*(.+)$", pathlib.Path("/proc/cpuinfo").read_text(), re.MULTILINE)
        model = found.group(1) if found else platform.machine()
    except OSError:
        model = platform.processor() or model
    return f"{model}, {os.cpu_count()} cores"


def figure(value, digits=3):
    """At least `digits` significant digits, no exponent."""
    if value is None:
        return "-"
    if isinstance(value, int) or abs(value) >= 10 ** digits:
        return f"{value:.0f}"
    return f"{float(f'{value:.{digits}g}'):.10f}".rstrip("0").rstrip(".")


def percent(part, whole, digits=1):
    return f"{100 * part / whole:.{digits}f} %"


def markdown_table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def residue(report):
    reasons = ", ".join(f"{r['reason']} {r['voxels']}" for r in report["residue"])
    return str(report["voxels"]["residue"]) + (f" ({reasons})" if reasons else "")


def verdict(report):
    return "clean" if report["verify"]["clean"] else f"NOT CLEAN ({report['verify']['collisions']} collisions)"
