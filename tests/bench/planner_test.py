"""bench/planner: its rows, its page, going on where it was stopped, and each fault that it must find."""

import importlib
import unittest

from bench_kit import BenchTest
from harness import SCULPT


class PlannerTest(BenchTest):
    """Changes are by "search threads", or by "search threads run" for one of several runs."""

    name = "planner"
    what = 'option("--search")'
    report = """"path": {"keyframes": 50, "rows": 7, "transits": 3, "cut_m": 8.0, "travel_m": 2.0},
          "seconds": {"load": 0, "voxelize": 0, "octree": 0, "plan": size / 16 * (200 if what == "octree" else 2 if threads == 1 else 1), "verify": 0}"""
    keys = 'f"{what} {threads}", f"{what} {threads} {run}"'

    def setUp(self):
        super().setUp()
        self.add_david()


class Rows(PlannerTest):
    def test_a_row_is_both_numbers_of_threads_and_octree_up_to_64(self):
        self.fine("--rows", "bust:64", "bust:128")
        self.assertEqual(self.called(), ["bust octree 64 2", "bust sweep 128 1", "bust sweep 128 2", "bust sweep 64 1", "bust sweep 64 2"])

    def test_what_is_chosen(self):
        planner = self.load_program()
        here = {mesh: path for mesh, path in planner.MESHES.items() if mesh != "bunny"}
        self.assertEqual(planner.choose_rows([], {"bust": 0, "dish": 0}), [f"{mesh}:{n}" for mesh in ("bust", "dish") for n in (16, 32, 64, 128)])
        self.assertEqual(planner.choose_rows(["256", "vase", "dish:64"], here), ["david:256", "bust:256", *(f"vase:{n}" for n in (16, 32, 64, 128, 256, 512)),
                                                                               "dish:64", "dish:256"])
        self.assertEqual(planner.choose_rows(["all"], planner.MESHES), list(planner.ROWS))
        self.assertEqual(planner.choose_rows(["all"], here), [row for row in planner.ROWS if not row.startswith("bunny")])

    def test_figures_are_compared_with_the_goals(self):
        self.fine("--rows", "david:32", "david:64", "david:256")
        goals = {(goal["what"], goal["row"]): (goal["measured"], goal["verdict"]) for goal in self.document()["goals"]}
        self.assertEqual(goals["planning against `octree`, 64^3", "david:64"], (200, "must met"))
        self.assertEqual(goals["peak memory at 256^3", "david:256"], (300, "must met"))
        self.assertEqual(goals["plan size (.sct) at 256^3", "david:256"], (256 / 1e6, "aim met"))
        self.assertEqual(goals["removed at 256^3, paper's tool", "david:256"], (99, "missed"))
        self.assertEqual(goals["second thread", "david:256"], (2, "aim met"))
        self.assertEqual(goals["air travel of cutting length", "david:256"], (0.25, "must met"))
        self.assertEqual(goals["growth 256 to 512", "david:512"], (None, "not run"))
        self.assertIn("| peak memory at 256^3 | david:256 | 1024 MiB | 256 MiB | 300 MiB | must met |", self.page())
        self.assertRegex(self.page(), r"\| david:64 \| 1000 \| 0 \| 0 \| 0 \| 4 \| 0 \| 0\.\d+ \| 0\.\d+ \| \d\S* \| 8 \| 2 \| 800 \| 200 \| 300 \|")
        self.assertIn("| david:64 | 2 | 990 (99.000 %) | 10 (enclosed 10) | 50 | 7 | 3 | 8 | 2 | 0.25 | 64 | 64 | 1.28 | clean | yes |", self.page())
        self.assertIn("Every plan below replays clean", self.page())

    def test_what_was_not_measured_at_256_is_taken_from_the_largest_row_there_is(self):
        self.fine("--rows", "david:64", "david:128")
        self.assertIn("| second thread | david:128 | 1.6 times | 1.9 times | 2 times | aim met |", self.page())

    def test_the_run_with_the_median_time_counts(self):
        self.change({f"sweep 2 {run}": {"seconds": {"plan": seconds, "load": 0, "voxelize": 0, "octree": 0, "verify": 0}}
                     for run, seconds in ((1, 9.0), (2, 5.0), (3, 7.0))})
        self.fine("--rows", "bust:16")
        run = self.document()["rows"]["bust:16"]["runs"]["sweep 2"]
        self.assertEqual((run["report"]["seconds"]["plan"], run["all_plan_s"]), (7, [9, 5, 7]))

    def test_what_other_programs_took_from_the_machine_is_said(self):
        page = importlib.import_module("planner_page")
        rows = [{"row": "bust:16", "runs": {"sweep 1": {"other_cores": 0.1}, "sweep 2": {"other_cores": 1.25}, "octree 2": {"other_cores": None}}}]
        self.assertIn("kept up to 1.2 cores busy** during bust:16 sweep 2: ", page.busy_note(rows))
        self.assertEqual(page.busy_note([{"row": "bust:16", "runs": {"sweep 1": {"other_cores": 0.1}}}]), "")

    def test_the_real_program_is_understood(self):
        self.fine("--rows", "dish:16", program=SCULPT[0])
        row = self.document()["rows"]["dish:16"]
        self.assertEqual((sorted(row["runs"]), row["faults"], row["same_plan"]), (["octree 2", "sweep 1", "sweep 2"], [], True))
        self.assertEqual([row["runs"][key]["report"]["search"] for key in sorted(row["runs"])], ["octree", "sweep", "sweep"])
        self.assertLess(row["runs"]["sweep 2"]["bytes"], row["runs"]["sweep 1"]["bytes"])  # .sct and .ndjson


class GoingOn(PlannerTest):
    def test_a_second_run_does_what_is_missing_until_asked_again(self):
        self.fine("--rows", "bust:16")
        calls = self.calls.read_text()
        self.assertIn("3 of 6 runs are there already", self.fine("--rows", "bust:16", "bust:32").stderr)
        self.assertEqual([line for line in self.calls.read_text()[len(calls):].splitlines() if " 16 " in line], [])
        self.fine("--rows", "bust:16", "--again")
        self.assertEqual(self.calls.read_text().count("bust sweep 16 2"), 6)
        self.assertIn("| bust:32 |", self.page())

    def test_runs_of_another_build_do_not_count(self):
        self.fine("--rows", "bust:16", "bust:32")
        self.program.write_text(self.program.read_text() + "# another build\n")
        self.assertNotIn("already", self.fine("--rows", "bust:16").stderr)
        self.assertNotIn("| bust:32 |", self.page())


class Faults(PlannerTest):
    def test_a_plan_that_does_not_replay_clean(self):
        self.change({"sweep 1": {"verify": {"clean": False, "collisions": 3}}})
        self.fault("bust:16 by sweep with 1 thread(s): the replay found 3 contacts", "--rows", "bust:16")

    def test_an_octree_plan_that_does_not_replay_clean(self):
        self.change({"octree 2": {"verify": {"clean": False, "collisions": 3}}})
        self.fault("bust:16 by octree with 2 thread(s): the replay found 3 contacts", "--rows", "bust:16")

    def test_voxels_that_do_not_add_up(self):
        self.change({"sweep 2": {"voxels": {"residue": 9}}})
        self.fault("990 removed and 9 residue are not the 1000 to remove", "--rows", "bust:16")

    def test_another_plan_with_another_number_of_threads(self):
        self.change({"sweep 2": {"plan_sha256": "other"}})
        self.fault("bust:16: not the same plan with 1 and 2 threads", "--rows", "bust:16")
        self.assertIn("| **NO** |", self.page())

    def test_another_plan_at_the_second_time(self):
        self.change({"sweep 2 2": {"plan_sha256": "other"}})
        self.fault("2 different plans in 3 runs", "--rows", "bust:16")

    def test_a_plan_that_cannot_be_made_keeps_the_words_of_sculpt(self):
        self.program.write_text("#!/bin/sh\necho 'sculpt: no luck' >&2\nexit 1\n")
        result = self.run_program("--rows", "bust:16")
        self.assertEqual(result.returncode, 1)
        self.assertIn("`sculpt plan` at bust sweep 16 1: sculpt: no luck", result.stderr)
        self.assertIn("Nothing was run yet.", self.page())


class Refusals(PlannerTest):
    def test_an_unknown_row_names_those_there_are(self):
        self.refused(["'bust:48'", "vase", "512"], "--rows", "bust:48")
        self.refused(["'head'"], "--rows", "head")
        self.assertFalse(self.out.exists())

    def test_a_mesh_that_is_not_there_names_the_cure(self):
        self.refused(["stanford-bunny.obj", "SCULPT_SHARED_DATA"], "--rows", "bunny:16")

    def test_a_missing_program_names_the_cure(self):
        self.refused(["nowhere", "--preset release", "--sculpt"], "--rows", "bust:16", program="nowhere")


if __name__ == "__main__":
    unittest.main()
