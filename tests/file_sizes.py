#!/usr/bin/env python3
"""No folder of the source with more than 25 files, no file above 300 lines whose head does not say why.

    tests/file_sizes.py TREE      prints each breach; exit 1 if there is one
"""
import pathlib
import re
import sys

MAX_FILES, MAX_LINES, HEAD_LINES = 25, 300, 20
FOLDERS = ("core", "proto", "server", "clients", "tests", "bench")
CODE = (".cpp", ".hpp", ".py", ".js")
# What a long file says of itself.
REASON = re.compile(r"above 300|one file")


def full_folders(tree):
    for top in FOLDERS:
        for folder in [tree / top, *(path for path in sorted((tree / top).rglob("*")) if path.is_dir())]:
            files = sum(path.is_file() for path in folder.iterdir()) if folder.is_dir() else 0
            if files > MAX_FILES and "corpus" not in folder.parts and "__pycache__" not in folder.parts:
                yield f"{folder.relative_to(tree)} has {files} files, more than {MAX_FILES}: divide it"


def long_files(tree):
    for top in FOLDERS:
        for path in sorted((tree / top).rglob("*")):
            if path.suffix not in CODE or "vendor" in path.parts:
                continue
            lines = path.read_text(encoding="utf-8").splitlines()
            if len(lines) > MAX_LINES and not REASON.search("\n".join(lines[:HEAD_LINES]).lower()):
                yield f"{path.relative_to(tree)} has {len(lines)} lines and does not say why: divide it"


def main(tree):
    breaches = [*full_folders(tree), *long_files(tree)]
    for breach in breaches:
        print(breach)
    print(f"file sizes: {len(breaches)} breaches" if breaches else "file sizes: all kept")
    return 1 if breaches else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
