#!/usr/bin/env python3
"""Include circles: header and source of a name are one node, and no node may come back to itself.

    tests/include_circles.py TREE [FOLDER...]    folders of the source tree; default: all that have C++

Prints each circle as the way round, from the include that opens it to the one that closes it; exit 1 if there is one.
"""
import pathlib
import re
import sys

FOLDERS = ("core", "proto", "server", "clients")
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*"([^"]+)"', re.MULTILINE)


def node_of(path):
    return str(pathlib.PurePosixPath(path).with_suffix(""))


def read_includes(tree, folders):
    """Node -> the nodes that its header or source includes."""
    files = [file for folder in folders for file in sorted((tree / folder).rglob("*")) if file.suffix in (".hpp", ".cpp")]
    includes = {node_of(file.relative_to(tree).as_posix()): set() for file in files}
    for file in files:
        node = node_of(file.relative_to(tree).as_posix())
        named = (node_of(name) for name in INCLUDE.findall(file.read_text(encoding="utf-8")))
        includes[node].update(other for other in named if other != node and other in includes)
    return includes


def find_way(includes, start, end):
    """The shortest way from start to end, both named; None without one."""
    before = {start: None}
    waiting = [start]
    for node in waiting:
        for other in sorted(includes[node]):
            if other == end:
                way = [end]
                while node is not None:
                    way.append(node)
                    node = before[node]
                return way[::-1]
            if other not in before:
                before[other] = node
                waiting.append(other)
    return None


def find_circles(includes):
    """A shortest circle through each node that has one, and each circle once."""
    circles = {}
    for node in sorted(includes):
        way = find_way(includes, node, node)
        if way:
            circles.setdefault(frozenset(way), way)
    return list(circles.values())


def main(arguments):
    tree = pathlib.Path(arguments[0])
    circles = find_circles(read_includes(tree, arguments[1:] or FOLDERS))
    for way in circles:
        print("circle: " + " -> ".join(way))
    print(f"include circles: {len(circles) or 'none'}")
    return 1 if circles else 0


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__.strip())
    sys.exit(main(sys.argv[1:]))
