"""Every `session` of proto/PROTOCOL.md and docs/cell-controller.md, in order, against a real daemon; and the tables of PROTOCOL.md against each other."""

import json
import re
import socket
import tempfile
import unittest

from harness import PATIENCE_S, SOURCE, Daemon

PROTOCOL = SOURCE / "proto/PROTOCOL.md"
CELL_CONTROLLER = SOURCE / "docs/cell-controller.md"


def sessions(text):
    """(first line's number, lines) of each block marked `session`."""
    for block in re.finditer(r"^```session\n(.*?)^```$", text, re.M | re.S):
        yield text.count("\n", 0, block.start()) + 2, block.group(1).splitlines()


class Connection:
    """A socket as a simple client sees it: lines and counted chunks."""

    def __init__(self, address):
        host, port = address.rsplit(":", 1)
        self.socket = socket.create_connection((host, int(port)), timeout=PATIENCE_S)
        self.stream = self.socket.makefile("rb")

    def send(self, content):
        self.socket.sendall(content + b"\n")

    def read_line(self):
        return self.stream.readline().decode()

    def read_chunk(self, size):
        content = self.stream.read(size + 1)
        assert content[-1:] == b"\n", f"a chunk of {size} bytes must end in a newline: {content[-20:]!r}"
        return content[:-1]

    def close(self):
        self.stream.close()
        self.socket.close()


def fill(text, names):
    """The names in a client's line, replaced by what they were bound to."""
    return re.sub(r'"\$(\w+)"', lambda name: json.dumps(names[name.group(1)]) if name.group(1) in names else name.group(0), text)


def difference(expected, got, names, place=""):
    """What of `got` is not as expected, or None; binds names that are met first."""
    if expected == "*":
        return None
    if isinstance(expected, str) and expected.startswith("$"):
        if not isinstance(got, str):
            return f"{place}: a string was expected, not {got!r}"
        return None if names.setdefault(expected[1:], got) == got else f"{place}: {expected} is {names[expected[1:]]!r}, not {got!r}"
    if isinstance(expected, dict) and isinstance(got, dict):
        if set(expected) != set(got):
            return f"{place}: fields {sorted(set(expected) ^ set(got))} are on one side only"
        return next(filter(None, (difference(expected[key], got[key], names, f"{place}/{key}") for key in expected)), None)
    if isinstance(expected, list) and isinstance(got, list) and len(expected) == len(got):
        return next(filter(None, (difference(e, g, names, f"{place}/{n}") for n, (e, g) in enumerate(zip(expected, got)))), None)
    same = type(expected) is type(got) and expected == got
    return None if same else f"{place}: expected {expected!r}, got {got!r}"


def has_blanks(line):
    """Whether there are blanks between the parts of a JSON line: simple clients search its text."""
    return re.search(r"\s", re.sub(r'"(\\.|[^"\\])*"', "", line.rstrip("\n"))) is not None


def play(lines, first_number, address, names, document, connect=Connection):
    """Runs one session; raises AssertionError that names the line."""
    connection = connect(address)
    try:
        announced = 0
        for number, line in enumerate(lines, first_number):
            where = f"{document}:{number}: {line}\n"
            kind, _, content = line.partition(" ")
            if kind == "C":
                connection.send(fill(content, names).encode())
            elif kind == "C+":
                connection.send(json.loads(content).encode())
            elif kind == "S":
                answer = connection.read_line()
                assert answer, where + "the connection was closed"
                assert not has_blanks(answer), where + answer + "has blanks between its parts"
                found = difference(json.loads(content), json.loads(answer), names)
                assert not found, f"{where}{answer}{found}"
                result = json.loads(answer).get("result")
                announced = result.get("bytes", 0) if isinstance(result, dict) else 0
            elif kind == "S+":
                chunk = connection.read_chunk(announced)
                assert content == '"*"' or chunk == json.loads(content).encode(), f"{where}got {chunk!r}"
            else:
                raise AssertionError(where + "a session has only lines C, C+, S and S+")
    finally:
        connection.close()


class Examples(unittest.TestCase):
    def play_all(self, document):
        """How many sessions the document has; all share a fresh daemon."""
        names, played = {}, 0
        with tempfile.TemporaryDirectory(prefix="sculpt-test-") as folder, Daemon(f"{folder}/data") as daemon:
            for number, lines in sessions(document.read_text()):
                with self.subTest(line=number):
                    play(lines, number, daemon.address, names, document.name)
                played += 1
        return played

    def test_every_session_goes_as_written(self):
        self.assertGreater(self.play_all(PROTOCOL), 10, "the sessions of PROTOCOL.md were not found")

    def test_every_session_of_the_cell_controller_goes_as_written(self):
        self.assertGreater(self.play_all(CELL_CONTROLLER), 3, "the sessions of cell-controller.md were not found")

    def test_every_method_has_an_example(self):
        text = PROTOCOL.read_text()
        methods = {word for heading in re.findall(r"^### (.*)$", text, re.M) for word in heading.split(", ")}
        shown = {method for _, lines in sessions(text) for method in re.findall(r'"method":"([\w.]+)"', "\n".join(lines))}
        self.assertGreater(len(methods), 10)
        self.assertEqual(methods - shown, set())

    def test_every_error_of_an_example_is_in_the_catalogue_with_its_number(self):
        text = PROTOCOL.read_text()
        catalogue = dict((word, int(number)) for number, word in re.findall(r"^\| (-?\d+) \| `(\w+)` \|", text, re.M))
        for number, word in re.findall(r'"error":\{"code":(-?\d+),.*?"data":\{"code":"(\w+)"', text):
            self.assertEqual(catalogue.get(word), int(number), word)


class Manual(unittest.TestCase):
    def test_every_refusal_of_the_planner_is_in_protocol_and_troubleshooting(self):
        here_only = {"law", "timing", "program", "timed"}  # folders of core that no server asks
        for manual, unasked in ((PROTOCOL, here_only), (SOURCE / "README.md", set())):
            thrown = {word for file in (SOURCE / "core").rglob("*.cpp") if not unasked & set(file.parts)
                      for word in re.findall(r'InputError[({]\s*"(\w+)"', file.read_text())}
            self.assertGreater(len(thrown), 10)
            self.assertEqual({word for word in thrown if f"`{word}`" not in manual.read_text()}, set(), manual)


class TheComparison(unittest.TestCase):
    """The examples prove nothing if the comparison lets everything through."""

    def test_it_tells_differences(self):
        self.assertIsNone(difference({"a": "*", "b": "$x"}, {"b": "id", "a": [1]}, {}))
        for expected, got in (({"a": 1}, {"a": 2}), ({"a": 1}, {"a": True}), ({"a": 1}, {}), ({}, {"a": 1}), ([1], [1, 2]), (["$x", "$x"], ["a", "b"]),
                              ("$x", 1), ({"a": 1}, {"a": 1.0})):
            self.assertIsNotNone(difference(expected, got, {}), (expected, got))

    def test_it_sees_blanks_between_parts_only(self):
        self.assertFalse(has_blanks('{"a b":"c \\" d",1:[2,3]}\n'))
        self.assertTrue(has_blanks('{"a": "b"}\n'))


if __name__ == "__main__":
    unittest.main()
