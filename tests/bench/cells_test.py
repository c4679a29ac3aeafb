"""bench/cells: its rows, its page, its limit of time, going on where it was stopped, and each fault that it must find."""

import importlib
import json
import subprocess
import unittest

from bench_kit import BenchTest
from harness import PATIENCE_S, SCULPT, SOURCE, environment, shared_data


class CellsTest(BenchTest):
    """Changes are by "cell threads", "cell size threads", or "cell size threads run" for one of several runs."""

    name = "cells"
    what = 'pathlib.Path(option("--robot")).stem'
    report = """"path": {"transits": 3}, "quality": {"moves_per_voxel": 1.25, "ompl_calls": 12, "ompl_solved": 9},
          "sweep": {"cut": 985, "left": 5}, "seconds": {"plan": size / 64, "verify": 0.5}"""
    keys = 'f"{what} {threads}", f"{what} {size} {threads}", f"{what} {size} {threads} {run}"'


class Rows(CellsTest):
    def test_a_row_is_both_numbers_of_threads_and_takes_the_bust_where_david_is_not(self):
        self.fine("--rows", "scara:16")
        self.assertEqual(self.called(), ["bust scara 16 1", "bust scara 16 2"])
        self.add_david()
        self.fine("--rows", "rail:16")
        self.assertEqual(self.called()[2:], ["david rail 16 1", "david rail 16 2"])

    def test_what_is_chosen(self):
        cells = self.load_program()
        some = {name: cells.CELLS[name] for name in ("ur10e", "ur10e-6mm", "scara")}
        self.assertEqual(cells.choose_rows(["all"], some), ["ur10e:16", "ur10e:32", "ur10e:64", "ur10e-6mm:16", "ur10e-6mm:32", "scara:16", "scara:32", "scara:64"])
        self.assertEqual(cells.choose_rows(["64", "ur10e-6mm"], some), ["ur10e:64", "ur10e-6mm:16", "ur10e-6mm:32", "scara:64"])
        self.assertEqual(cells.choose_rows(["scara:32", "ur10e:16"], some), ["ur10e:16", "scara:32"])

    def test_a_cell_of_the_users_own_is_a_row(self):
        self.fine("--cell", SOURCE / "config/cells/gantry.json", "--rows", "gantry:16")
        self.assertEqual(self.called(), ["bust gantry 16 1", "bust gantry 16 2"])
        self.assertIn("| gantry | named by --cell: gantry.json |", self.page())

    def test_meshes_that_are_not_there_are_said_to_be_left_out(self):
        self.fine("--rows", "16")
        self.assertFalse(any("kr16" in call or "kr120" in call or "panda-meshes" in call for call in self.called()))
        self.assertIn("**Left out**: kr16, kr120, panda-meshes.", self.page())
        self.assertIn("| kr16 | KUKA KR 16, all links as meshes, turntable; **not here: needs the shared data** |", self.page())

    def test_figures_are_compared_with_the_goals(self):
        self.change({"rail 2": {"sweep": {"cut": 9}}, "rail 64 2": {"seconds": {"plan": 0.1, "verify": 0}}})
        self.fine("--rows", "scara:64", "rail:64")
        goals = {(goal["row"], goal["what"]): (goal["measured"], goal["verdict"]) for goal in self.document()["goals"]}
        self.assertEqual(goals["scara:64", "planned"], (1, "must met"))
        self.assertEqual(goals["scara:64", "cut by `sweep` itself"], (100 * 985 / 990, "must met"))
        self.assertEqual(goals["scara:64", "moves a voxel"], (1.25, "aim met"))
        self.assertEqual(goals["rail:64", "planned"], (0.1, "aim met"))
        self.assertEqual(goals["rail:64", "cut by `sweep` itself"], (100 * 9 / 990, "missed"))
        self.assertEqual(goals["ur10e:64", "planned"], (None, "not run"))
        self.assertIn("| scara:64 | planned | 1 s | 0.2 s | 1 s | must met |", self.page())
        self.assertIn("| scara:64 | 1 | 1 | 99.49 % | 1.25 | 1000 | 990 (99.000 %) | 10 (enclosed 10) | 3 | 12 | 9 | 300 | 0.5 | clean | yes |", self.page())

    def test_a_report_without_the_share_of_sweep_leaves_it_empty(self):
        self.change({"scara 1": {"sweep": {}}, "scara 2": {"sweep": {}}})
        self.fine("--rows", "scara:64")
        self.assertIn("| scara:64 | 1 | 1 | - | 1.25 |", self.page())
        self.assertIsNone(self.document()["rows"]["scara:64"]["figures"]["by_sweep_percent"])

    def test_the_real_program_is_understood(self):
        self.fine("--rows", "five-axis:16", program=SCULPT[0])
        row = self.document()["rows"]["five-axis:16"]
        self.assertEqual((sorted(row["runs"]), row["faults"], row["same_plan"]), (["sweep 1", "sweep 2"], [], True))


class ItsOwnCells(CellsTest):
    """Against the real program: each is a cell that can be planned, at 8 for the time it takes."""

    def plan(self, cell):
        ended = subprocess.run([*SCULPT, "plan", SOURCE / "config/samples/dish.stl", "--resolution", "8", "--robot", cell, "--json", "-o", self.scratch / "plan.sct"],
                               env=environment(), capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual(ended.returncode, 0, f"{cell}: {ended.stderr}")
        return json.loads(ended.stdout)

    def test_each_home_is_free_and_most_of_the_stock_is_within_reach(self):
        cells = sorted((SOURCE / "bench/cells_data/cells").glob("*.json"))
        self.assertGreater(len(cells), 10)
        for cell in cells:
            with self.subTest(cell.stem):
                voxels = self.plan(cell)["voxels"]
                self.assertGreater(voxels["removed"], 0.9 * voxels["remove"])

    def test_each_cell_of_the_folder_is_in_a_row(self):
        cells = self.load_program().CELLS
        self.assertEqual({path.stem for path in (SOURCE / "bench/cells_data/cells").glob("*.json")}, {name for name, cell in cells.items() if "cells_data" in str(cell.path)})

    def test_the_panda_with_meshes_has_all_its_links_but_the_hand(self):
        shared_data(self, "ros/moveit_resources_panda_description/urdf/panda.urdf")
        cell = importlib.import_module("mesh_cells").make_panda_meshes(self.scratch / "made")
        urdf = (self.scratch / "made/panda-meshes.urdf").read_text()
        self.assertNotIn("finger", urdf)
        self.assertEqual([n for n in range(8) if f"collision/link{n}.stl" in urdf], list(range(8)))
        voxels = self.plan(cell)["voxels"]
        self.assertGreater(voxels["removed"], 0.9 * voxels["remove"])


class Limit(CellsTest):
    def test_what_takes_too_long_is_stopped_recorded_and_larger_sizes_are_not_tried(self):
        self.change({"scara 16 2": {"sleep": PATIENCE_S}})
        self.fine("--rows", "scara", "--limit", "0.5")
        self.assertEqual(self.called(), ["bust scara 16 2"])
        self.assertIn("| scara | SCARA over a fixed stock: three axes | not in 0.5 s | - | - |", self.page())
        self.assertIn("| scara:16 | not in 0.5 s | - |", self.page())

    def test_a_higher_limit_tries_again_the_same_does_not(self):
        self.change({"scara 16 2": {"sleep": PATIENCE_S}})
        self.fine("--rows", "scara:16", "--limit", "0.5")
        self.change({})
        self.fine("--rows", "scara:16", "--limit", "0.5")
        self.assertIn("not in 0.5 s", self.page())
        self.fine("--rows", "scara:16", "--limit", "100")
        self.assertIn("| scara:16 | 0.25 | 0.25 |", self.page())

    def test_a_replay_has_a_limit_of_its_own(self):
        self.change({"scara 16 2": {"replay": PATIENCE_S}})
        self.fine("--rows", "scara:16", "--limit", "0.5")
        self.assertIn("| scara:16 | replay not in 0.5 s |", self.page())

    def test_no_time_is_refused(self):
        result = self.run_program("--rows", "scara:16", "--limit", "0")
        self.assertEqual(result.returncode, 2)
        self.assertIn("above 0", result.stderr)


class GoingOn(CellsTest):
    def test_a_second_run_does_what_is_missing_until_asked_again(self):
        self.fine("--rows", "scara:16")
        calls = self.calls.read_text()
        self.assertIn("2 of 4 runs are there already", self.fine("--rows", "scara:16", "scara:32").stderr)
        self.assertEqual([line for line in self.calls.read_text()[len(calls):].splitlines() if " 16 " in line], [])
        self.fine("--rows", "scara:16", "--again")
        self.assertEqual(self.calls.read_text().count("bust scara 16 2"), 6)

    def test_runs_of_another_build_or_of_a_changed_cell_do_not_count(self):
        for part in ("cells/gantry.json", "robots/gantry.urdf"):
            (self.scratch / part).parent.mkdir(exist_ok=True)
            (self.scratch / part).write_text((SOURCE / "config" / part).read_text())
        mine = ("--cell", self.scratch / "cells/gantry.json", "--rows", "gantry:16")
        self.fine(*mine)
        self.assertIn("already", self.fine(*mine).stderr)
        with (self.scratch / "robots/gantry.urdf").open("a") as urdf:
            urdf.write("<!-- changed -->\n")
        self.assertNotIn("already", self.fine(*mine).stderr)
        self.program.write_text(self.program.read_text() + "# another build\n")
        self.assertNotIn("already", self.fine(*mine).stderr)


class Faults(CellsTest):
    def test_a_plan_that_does_not_replay_clean(self):
        self.change({"scara 1": {"verify": {"clean": False, "collisions": 3}}})
        self.fault("scara:16 by sweep with 1 thread(s): the replay found 3 contacts", "--rows", "scara:16")

    def test_voxels_that_do_not_add_up(self):
        self.change({"scara 2": {"voxels": {"residue": 9}}})
        self.fault("990 removed and 9 residue are not the 1000 to remove", "--rows", "scara:16")

    def test_another_plan_with_another_number_of_threads(self):
        self.change({"scara 2": {"plan_sha256": "other"}})
        self.fault("scara:16: not the same plan with 1 and 2 threads", "--rows", "scara:16")
        self.assertIn("| **NO** |", self.page())

    def test_another_plan_at_the_second_time(self):
        self.change({"scara 16 2 2": {"plan_sha256": "other"}})
        self.fault("2 different plans in 3 runs", "--rows", "scara:16")

    def test_a_refused_cell_keeps_the_words_of_sculpt_and_others_go_on(self):
        self.change({"rail 16 2": {"refuse": "at home 'a' touches 'b'"}})
        self.fault("rail:16: sculpt: at home 'a' touches 'b'", "--rows", "rail:16", "rail:32", "scara:16")
        self.assertEqual(self.called(), ["bust rail 16 2", "bust scara 16 1", "bust scara 16 2"])
        self.assertIn("| rail:16 | refused | - |", self.page())


class Refusals(CellsTest):
    def test_an_unknown_row_names_those_there_are(self):
        self.refused(["'scara:48'", "ur10e", "64"], "--rows", "scara:48")
        self.refused(["'ur10e-6mm:64'", "if the cell has that size"], "--rows", "ur10e-6mm:64")
        self.assertFalse(self.out.exists())

    def test_a_cell_that_is_not_there_names_the_cure(self):
        self.refused(["kr16.json", "SCULPT_SHARED_DATA"], "--rows", "kr16:16")
        self.refused(["mine.json"], "--cell", "mine.json", "--rows", "mine")

    def test_a_file_that_is_no_cell_names_the_cure(self):
        (self.scratch / "mine.json").write_text("{}")
        self.refused(["mine.json", "docs/cells.md"], "--cell", self.scratch / "mine.json", "--rows", "mine")

    def test_a_missing_program_names_the_cure(self):
        self.refused(["nowhere", "--preset release", "--sculpt"], "--rows", "scara:16", program="nowhere")


if __name__ == "__main__":
    unittest.main()
