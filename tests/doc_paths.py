#!/usr/bin/env python3
"""Every file and folder of the source that a document names is there.

    tests/doc_paths.py TREE      prints each name that leads nowhere; exit 1 if there is one

Looked at is what stands between back-ticks and begins with a folder of the source or of tests/; the ending may be left
out. Words in capitals stand for something.
"""
import pathlib
import re
import sys

FOLDERS = "core|proto|server|clients|config|tests|bench|scripts|docker|docs|torture|wire|fuzz|golden"
NAME = re.compile(rf"`((?:{FOLDERS})/[\w./-]+)[`, ]")
ENDINGS = ("", ".cpp", ".hpp", ".py")


def is_there(tree, name):
    return any((tree / parent / (name + ending)).exists() for parent in ("", "tests") for ending in ENDINGS)


def main(tree):
    lost = 0
    for document in sorted([*tree.glob("*.md"), *tree.glob("*/*.md"), *tree.glob("clients/*/*.md")]):
        for name in NAME.findall(document.read_text(encoding="utf-8")):
            if not re.search(r"\b[A-Z]{2,}\b", name) and not is_there(tree, name.rstrip("/.")):
                print(f"{document.relative_to(tree)} names {name}, which is not there")
                lost += 1
    print(f"names in documents: {lost} lead nowhere" if lost else "names in documents: all there")
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
