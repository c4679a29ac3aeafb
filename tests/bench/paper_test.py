"""bench/paper: its rows, its page, going on where it was stopped, the row that is cut short, and the searches alone."""

import contextlib
import importlib.machinery
import importlib.util
import io
import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest

import shapes
from harness import PATIENCE_S, SCULPT, SOURCE, environment

PROGRAM = SOURCE / "bench/paper"

# Stands in for `sculpt`: cuts 30 of 100 voxels at once and then never ends by itself. Says that it is there by a file.
ENDLESS = """#!{python}
import pathlib, signal, sys
output = sys.argv[sys.argv.index("-o") + 1]
if sys.argv[1] == "voxelize":
    print('{{"voxels": {{"total": 200, "air": 0, "keep": 100, "remove": 100}}}}')
else:
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    pathlib.Path(output + ".part").write_text('{{"type":"cut","q":[0],"voxels":[[0,0,29],[0,0,0]]}}\\n' + '{{"type":"cut","vox')
    pathlib.Path({sign!r}).write_text("")
    signal.pause()
"""


# Stands in for `bench_search`: 0.5 s of search, and one line more in the file COUNT.
SEARCH_BENCH = """#!{python}
import json, sys
order, resolution = sys.argv[sys.argv.index("--order") + 1], int(sys.argv[sys.argv.index("--resolution") + 1])
with open({count!r}, "a") as count:
    count.write(f"{{order}} {{resolution}}\\n")
print(json.dumps({{"seconds": 0.5, "voxels_passed": 123457, "moves_per_voxel": 1.25, "ns_per_voxel_passed": 77.5, "turns": 9,
                  "peak_memory_bytes": 3 << 20, **({{"seconds_octree_and_graph": 0.125}} if order == "octree" else {{}})}}))
"""


sys.path.insert(0, str(PROGRAM.parent))  # as Python does for the program itself


def load_program():
    loader = importlib.machinery.SourceFileLoader("paper", str(PROGRAM))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("paper", loader))
    loader.exec_module(module)
    return module


class PaperTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sculpt-test-")
        self.addCleanup(folder.cleanup)
        self.scratch = pathlib.Path(folder.name)
        self.out = self.scratch / "out"
        self.mesh = shapes.write_stl(self.scratch / "steps.stl", shapes.steps())

        self.search_bench, self.count = self.scratch / "search", self.scratch / "count"
        self.write_program(self.search_bench, SEARCH_BENCH.format(python=sys.executable, count=str(self.count)))

    def write_program(self, path, text):
        path.write_text(text)
        path.chmod(0o755)

    def arguments(self, *options, program=SCULPT[0]):
        return ["--mesh", str(self.mesh), "--sculpt", str(program), "--out", str(self.out), *map(str, options)]

    def command(self, *options, program=SCULPT[0]):
        return [sys.executable, "-B", str(PROGRAM), "--search-bench", str(self.search_bench), *self.arguments(*options, program=program)]

    def run_program(self, *options, program=SCULPT[0]):
        return subprocess.run(self.command(*options, program=program), env=environment(), stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=PATIENCE_S)

    def fine(self, *options, **named):
        result = self.run_program(*options, **named)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def refused(self, words, *options, **named):
        result = self.run_program(*options, **named)
        self.assertEqual((result.returncode, result.stdout), (2, ""), result.stderr)
        self.assertRegex(result.stderr, r"\Abench/paper: .*\n\Z")
        for word in words:
            self.assertIn(word, result.stderr)

    def document(self):
        return json.loads((self.out / "paper.json").read_text())

    def page(self):
        return (self.out / "paper.md").read_text()

    def endless(self):
        program, sign = self.scratch / "endless", self.scratch / "running"
        self.write_program(program, ENDLESS.format(python=sys.executable, sign=str(sign)))
        return program, sign


class Rows(PaperTest):
    def test_cheap_rows_give_page_and_json(self):
        self.fine("--rows", "I:8", "II:8")
        tables = self.document()["tables"]
        self.assertEqual({table: len(rows) for table, rows in tables.items()}, {"I": 8, "II": 4, "III": 3, "G": 21})
        voxel, octree = tables["I"][:2]
        for entry, paper in ((voxel, 12), (octree, 14)):
            self.assertEqual((entry["state"], entry["paper"]), ("measured", paper))
            self.assertEqual((entry["ours"], entry["ratio"]), (0.5, paper / 0.5))
            self.assertEqual(entry["certified_seconds"], entry["report"]["seconds"]["plan"])
            self.assertTrue(entry["report"]["verify"]["clean"])
        # Two boxes of half the height, the upper of half the width: 8*8*4 + 4*4*4 of 512 voxels stay.
        self.assertEqual(tables["II"][0]["report"]["voxels"]["keep"], 320)
        self.assertEqual(tables["II"][0]["ours"], octree["report"]["octree"]["leaves"])
        self.assertEqual({e["state"] for e in tables["II"][1:] + tables["III"]}, {"not run"})
        self.assertEqual([(e["search"], e["state"]) for e in tables["G"][:3]], [("voxel", "measured"), ("octree", "measured"), ("nearest", "not run")])
        page = self.page()
        self.assertIn("| 8 | 512 | 354 | 30.9 % |", page)
        self.assertIn("| 62.5 % |", page)
        self.assertRegex(page, r"\| 8 \| octree \| 14 \| 0\.5 \| 28 \| 0\.\d+ \|")
        self.assertIn("| 256 | voxel | N/A | not run | - | not run |", page)
        self.assertIn("| 256 | 457 | not run | - |", page)
        self.assertEqual(page.count("The set-ups differ: "), 3)
        self.assertIn(octree["report"]["plan_sha256"], page)
        self.assertNotIn("Extrapolated", page)

    def test_a_second_run_does_nothing_until_asked_again(self):
        self.fine("--rows", "II:8")
        result = self.out / "gantry-octree-8.json"
        marked = {**json.loads(result.read_text()), "mark": 1}
        result.write_text(json.dumps(marked))
        more = self.fine("--rows", "I:8").stderr
        self.assertIn("1 of 4 runs are there already", more)
        self.assertEqual(json.loads(result.read_text()), marked)
        self.assertTrue((self.out / "gantry-voxel-8.json").exists())
        self.fine("--rows", "II:8", "--again")
        self.assertNotIn("mark", json.loads(result.read_text()))

    def test_results_of_another_mesh_do_not_count(self):
        self.fine("--rows", "II:8")
        self.mesh = shapes.write_stl(self.scratch / "ball.stl", shapes.ball())
        self.fine("--rows", "II:8")
        self.assertEqual(self.document()["tables"]["II"][0]["report"]["mesh"], "ball.stl")

    def test_by_default_the_long_rows_are_left_out(self):
        paper = load_program()
        self.assertEqual(paper.choose_rows([]), ["I:8", "I:16", "I:64", "II:8", "II:16", "II:64", "II:256", "III:16",
                                                 "G:8", "G:16", "G:32", "G:64", "G:128", "G:256"])
        self.assertEqual(paper.choose_rows(["III", "I:64"]), ["I:64", "III:16", "III:64", "III:256"])
        self.assertEqual(paper.choose_rows(["all"]), list(paper.ROWS))


class SearchesAlone(PaperTest):
    def test_growth_shows_each_order_and_runs_it_once(self):
        self.fine("--rows", "G:8", "G:512")
        self.fine("--rows", "G")
        done = sorted(self.count.read_text().splitlines())
        self.assertEqual(done, sorted(f"{order} {n}" for order in ("voxel", "octree", "nearest") for n in (8, 16, 32, 64, 128, 256, 512)))
        page = self.page()
        self.assertIn("| 512 | nearest | 0.5 | 123457 | 77.5 | 1.2500 | 9 | - | 3 |", page)
        self.assertIn("| 16 | octree | 0.5 | 123457 | 77.5 | 1.2500 | 9 | 0.125 | 3 |", page)
        self.assertEqual(page.count("A search that was not run: "), 0)

    def test_table_one_shares_its_searches_with_growth(self):
        self.fine("--rows", "G:8")
        self.assertIn("2 of 4 runs are there already", self.fine("--rows", "I:8").stderr)
        self.assertEqual(self.document()["tables"]["I"][1]["ours"], 0.5)

    def test_without_the_program_the_column_says_so_with_the_cure(self):
        paper = load_program()
        paper.DEFAULT_SEARCH_BENCH = self.scratch / "nowhere"
        with contextlib.redirect_stderr(io.StringIO()) as said, contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(paper.main(self.arguments("--rows", "I:8", "G:16")), 0, said)
        self.assertIn("5 of 7 runs need bench_search and are left out: build it (cmake --preset release -DBENCH=ON", said.getvalue())
        entry = self.document()["tables"]["I"][0]
        self.assertEqual((entry["state"], entry["ours"], entry["ratio"]), ("not run", None, None))
        self.assertTrue(entry["report"]["verify"]["clean"])
        self.assertRegex(self.page(), r"\| 8 \| voxel \| 12 \| not run \| - \| 0\.\d+ \|")
        self.assertEqual(self.page().count("-DBENCH=ON"), 2)

    def test_one_that_fails_keeps_its_words_and_leaves_no_result(self):
        self.write_program(self.search_bench, "#!/bin/sh\necho 'bench_search: no luck' >&2\nexit 1\n")
        result = self.run_program("--rows", "G:8")
        self.assertEqual(result.returncode, 1)
        self.assertIn("`bench_search` at search voxel 8: bench_search: no luck", result.stderr)
        self.assertEqual({e["state"] for e in self.document()["tables"]["G"]}, {"not run"})

    def test_the_real_one_is_understood(self):
        self.search_bench = pathlib.Path(SCULPT[0]).with_name("bench_search")
        if not self.search_bench.exists():
            self.skipTest("bench_search is not built: configure with -DBENCH=ON")
        self.fine("--rows", "I:8", "G:8")
        tables = self.document()["tables"]
        self.assertEqual([e["measure"]["order"] for e in tables["G"][:3]], ["voxel", "octree", "nearest"])
        for entry in tables["G"][:3]:  # 320 of 512 voxels stay
            self.assertEqual((entry["measure"]["resolution"], entry["measure"]["removed"]), (8, 192))
        for searched, planned in zip(tables["G"][:2], tables["I"][:2]):
            self.assertEqual(searched["measure"]["removed"], planned["report"]["voxels"]["removed"])


class Refusals(PaperTest):
    def test_an_unknown_row_names_those_there_are(self):
        self.refused(["'IV:8'", "I:8", "III:256"], "--rows", "I:8", "IV:8")
        self.refused(["'I:32'"], "--rows", "I:32")
        self.assertFalse(self.out.exists())

    def test_a_missing_program_names_the_cure(self):
        self.refused(["nowhere", "--preset release", "--sculpt"], "--rows", "I:8", program="nowhere")

    def test_a_missing_search_bench_names_the_cure(self):
        self.search_bench = self.scratch / "nowhere"
        self.refused(["nowhere", "-DBENCH=ON", "--search-bench"], "--rows", "G:8")

    def test_a_missing_mesh_names_the_cure(self):
        self.mesh = self.scratch / "none.stl"
        self.refused(["none.stl", "--mesh"], "--rows", "I:8")

    def test_a_mesh_that_cannot_be_planned_keeps_the_words_of_sculpt(self):
        self.mesh = shapes.write_stl(self.scratch / "open.stl", shapes.open_bowl())
        result = self.run_program("--rows", "II:8")
        self.assertEqual(result.returncode, 1)
        self.assertIn("sculpt: mesh_not_solid: ", result.stderr)
        self.assertEqual(self.document()["tables"]["II"][0]["state"], "not run")


class CutShort(PaperTest):
    def test_the_timed_row_is_stopped_and_marked_as_extrapolated(self):
        program, _ = self.endless()
        self.fine("--rows", "III:256", "--minutes", "0.03", program=program)
        entry = self.document()["tables"]["III"][2]
        self.assertEqual((entry["state"], entry["extrapolation"]["removed"], entry["extrapolation"]["remove"]), ("extrapolated", 30, 100))
        self.assertAlmostEqual(entry["ours"], entry["extrapolation"]["measured_minutes"] / 0.3)
        self.assertRegex(self.page(), r"\| 256 \| 457 \| at least \S+ \(extrapolated\) \| at most \S+ \(extrapolated\) \|")
        self.assertIn("**Extrapolated, not measured:** III:256", self.page())
        self.assertIn("already", self.fine("--rows", "III:256", program=program).stderr)

    def test_the_slower_of_the_mean_and_the_last_rate_is_the_estimate(self):
        samples = [[60.0, 90], [90.0, 100], [120.0, 110]]
        x = importlib.import_module("paper_page").extrapolate({"samples": samples, "voxels": {"remove": 220}})
        self.assertEqual(x["minutes_at_mean_rate"], 4)
        self.assertAlmostEqual(x["minutes_at_late_rate"], (120 + 110 * 3) / 60)
        self.assertEqual(x["minutes"], x["minutes_at_late_rate"])

    def test_voxels_are_counted_while_lines_grow(self):
        path = self.scratch / "growing"
        counter = load_program().CutCounter(path)
        self.assertEqual(counter.count(), 0)
        line = '{"type":"cut","q":[0.5],"voxels":[[3,4,5],[3,1,5]]}\n'
        path.write_text(line[:40])
        self.assertEqual(counter.count(), 0)
        path.write_text(line + '{"type":"move","q":[1]}\n' + line)
        self.assertEqual(counter.count(), 8)
        self.assertEqual(counter.count(), 8)

    def test_interrupting_leaves_no_rest_and_says_how_to_go_on(self):
        program, sign = self.endless()
        process = subprocess.Popen(self.command("--rows", "II:8", program=program), env=environment(), stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.assertEqual(process.stderr.readline(), "1/1 gantry octree 8 ...\n")
        while process.poll() is None and not sign.exists():
            try:
                process.wait(0.02)
            except subprocess.TimeoutExpired:
                pass
        process.send_signal(signal.SIGINT)
        _, stderr = process.communicate(timeout=PATIENCE_S)
        self.assertEqual(process.returncode, 130, stderr)
        self.assertEqual(stderr, "bench/paper: interrupted; the finished runs are kept, the same command goes on from there\n")
        self.assertEqual(sorted(path.name for path in self.out.iterdir()), ["paper.json", "paper.md"])


if __name__ == "__main__":
    unittest.main()
