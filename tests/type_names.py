#!/usr/bin/env python3
"""No two types of one name in one namespace: a linker takes the destructor of one for the other without a word.

    tests/type_names.py TREE      prints each name that is defined twice; exit 1 if there is one

Types in unnamed namespaces and inside of other types may repeat. What this does not see (functions, templates) the preset odr does.
"""
import collections
import pathlib
import re
import sys

FOLDERS = ("core", "proto", "server", "clients", "tests", "bench")
OPEN = re.compile(r"^(?:inline )?namespace(?: ([\w:]+))? \{$")
CLOSE = re.compile(r"^\}  // namespace")
TYPE = re.compile(r"^(?:struct|class|union|enum(?: class| struct)?) (?:alignas\(\w+\) )?(\w+)(?: final)?(?: : [^;]*)?\s*\{")


def types_of(path):
    """Full names of the types that a file defines where others see them."""
    spaces = []
    for line in path.read_text(encoding="utf-8").splitlines():
        if opened := OPEN.match(line):
            spaces.append(opened[1])
        elif CLOSE.match(line):
            spaces.pop()
        elif (found := TYPE.match(line)) and None not in spaces:
            yield "::".join([*spaces, found[1]])


def find_doubles(tree):
    places = collections.defaultdict(list)
    for top in FOLDERS:
        for path in sorted((tree / top).rglob("*.[ch]pp")):
            for name in types_of(path):
                places[name].append(str(path.relative_to(tree)))
    return {name: files for name, files in sorted(places.items()) if len(files) > 1}


def main(tree):
    doubles = find_doubles(tree)
    for name, files in doubles.items():
        print(f"{name} is defined in {' and '.join(files)}: rename one")
    print(f"type names: {len(doubles)} defined twice" if doubles else "type names: each one type")
    return 1 if doubles else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
