"""sculpt without a server: plan, voxelize, verify FILE, and the command line itself."""

import contextlib
import hashlib
import json
import math
import os
import re
import signal
import subprocess
import unittest
import xml.etree.ElementTree

import shapes
from harness import SCULPT, SOURCE, ClientTest, environment, shared_data

import sculpt

COMMANDS = "submit list status watch wait cancel report fetch link render verify voxelize plan cell place time sample program".split()


class CommandLine(ClientTest):
    def test_every_command_explains_itself(self):
        overview = self.fine("--help")
        for command in COMMANDS:
            self.assertRegex(overview, rf"\n  {command} ")
            text = self.fine(command, "--help")
            for option in ("--help", "--server", "--version"):
                self.assertIn(option, text, command)

    def test_version_stands_before_and_after_the_command(self):
        self.assertRegex(self.fine("--version"), r"^sculpt \d+\.\d+\.\d+\n$")
        self.assertEqual(self.fine("list", "--version"), self.fine("--version"))

    def test_the_version_is_the_projects_everywhere(self):
        project = re.search(r"project\(sculptd VERSION (\S+) ", (SOURCE / "CMakeLists.txt").read_text())[1]
        self.assertEqual(self.fine("--version"), f"sculpt {project}\n")
        self.assertEqual(sculpt.VERSION, f"sculpt.py/{project}")
        self.assertIn(f"sculptd {project} listening", (SOURCE / "README.md").read_text())

    def test_a_wrong_command_line_is_usage(self):
        for arguments in ([], ["fly"], ["status"], ["status", "x", "--bogus"], ["fetch", "x"], ["fetch", "x", "-o", "y", "--format", "xml"],
                          ["voxelize", "m.stl", "--resolution", "eight", "-o", "x.binvox"],
                          ["submit", "m.stl", "--robot", "gantry"], ["plan", "m.stl", "--resolution", "8", "--robot", "gantry"],
                          ["voxelize", "m.stl", "--resolution", "8", "-o", "v", "--rotate", "1,2"]):
            self.refused(2, "usage", *arguments)

    def test_no_server_is_unreachable_wherever_the_option_stands(self):
        for arguments in (["--server", "127.0.0.1:1", "list"], ["list", "--server", "127.0.0.1:1"], ["status", "x", "--server", "127.0.0.1:1"]):
            self.assertIn("127.0.0.1:1", self.refused(3, "unreachable", *arguments))
        self.assertIn("127.0.0.1:1", self.refused(3, "unreachable", "list", server="127.0.0.1:1"))


class Place(ClientTest):
    """Where table or base should stand."""

    HERE = ("--x", "0.45:0.65:3", "--y", "0", "--z", "0.1")
    THERE = ("--x", "0.45", "--y", "0", "--z", "0.1", "--stickout", "0.25", "--height", "0.01")

    def place(self, *options, where=HERE):
        mesh = shapes.write_stl(self.scratch / "mesh.stl", shapes.steps())
        return self.fine("place", mesh, "--robot", "panda-turntable", *where, *options)

    def test_all_stands_as_json_best_first(self):
        report = json.loads(self.place("--json", "--turn-over"))
        self.assertEqual(report["moved"], {"joint": "table", "parent": "room", "child": "turntable"})
        self.assertEqual(len(report["stands"]), 3)
        self.assertEqual([stand["is_own"] for stand in report["stands"]].count(True), 1)
        held = [stand["estimate"]["held"] for stand in report["stands"]]
        self.assertEqual(held, sorted(held, reverse=True))
        for stand in report["stands"]:
            counts = stand["estimate"]
            self.assertEqual(counts["removable"], sum(counts[name] for name in "held tool stock links limits reach".split()))
            self.assertLessEqual(stand["certified"]["held"], counts["removable"])
        self.assertEqual(len(report["turn_overs"]), 5)

    def test_the_answer_is_the_same_at_any_number_of_threads(self):
        self.assertEqual(self.place("--json", "--threads", 1), self.place("--json", "--threads", 4))

    def test_the_table_has_the_cells_own_stand_and_a_map(self):
        text = self.place("--rows", 1)
        self.assertRegex(text, r"(?m)^ +\d+ +0\.550 +0\.000 +0\.100 .* now$")
        self.assertIn("y \\ x", text)

    def test_the_best_is_written_as_a_cell_that_differs_in_its_stand_alone(self):
        report = json.loads(self.place("--json", "--certify", 0, "-o", "better.json", where=self.THERE))
        best = report["stands"][report["best"]]
        cell = json.loads((self.scratch / "better.json").read_text())
        shipped = json.loads((SOURCE / "config/cells/panda-turntable.json").read_text())
        self.assertEqual(cell.pop("urdf"), "better.urdf")
        shipped.pop("urdf")
        self.assertEqual([*cell["stock"]["origin_m"][:2], cell["stock"]["origin_m"][2]], [-0.1, -0.1, best["height_m"]])
        self.assertEqual(cell["tool"]["stickout_m"], best["stickout_m"])
        shipped["stock"]["origin_m"][2], shipped["tool"]["stickout_m"] = best["height_m"], best["stickout_m"]
        if best["home_is_free"]:
            self.assertEqual(cell, shipped)
        before = (SOURCE / "config/robots/panda-turntable.urdf").read_text().splitlines()
        after = (self.scratch / "better.urdf").read_text().splitlines()
        changed = [(old, new) for old, new in zip(before, after) if old != new]
        self.assertEqual(len(before), len(after))
        self.assertEqual(changed, [] if best["at_m"] == [0.55, 0, 0.1] else [changed[0]])
        self.fine("plan", self.scratch / "mesh.stl", "--resolution", 8, "--robot", "./better.json", "-o", "plan.sct")

    def test_a_tool_of_less_than_nothing_is_refused(self):
        mesh = shapes.write_stl(self.scratch / "mesh.stl", shapes.steps())
        self.refused(2, "usage", "place", mesh, "--robot", "panda-turntable", "--stickout", "-0.1")

    def test_the_map_is_a_picture(self):
        self.place("--map", "map.svg")
        picture = xml.etree.ElementTree.parse(self.scratch / "map.svg")
        self.assertEqual(picture.getroot().tag, "{http://www.w3.org/2000/svg}svg")
        words = [text.text for text in picture.iter("{http://www.w3.org/2000/svg}text")]
        for said in ("as the cell stands", "the best", "z 0.100 m, block at 0.000 m, tool 0.270 m, turn 0°"):
            self.assertIn(said, words)
        self.assertIn("white", {text.get("fill") for text in picture.iter("{http://www.w3.org/2000/svg}text")}, "on the dark end of the scale")

    def test_what_makes_no_sense_is_refused(self):
        mesh = shapes.write_stl(self.scratch / "mesh.stl", shapes.steps())
        for options in (["--x", "1:2"], ["--x", "a"], ["--x", "1:2:0"], ["--x", "1:2:3.5"], ["--x", "1:2:3:4"], ["--x", "nan"], ["--x", "inf"], ["--x", "1e9"], ["--z", "0:nan:3"], ["--move", "wall"]):
            self.refused(2, "usage", "place", mesh, "--robot", "panda-turntable", *options)
        self.refused(4, "cell_invalid", "place", mesh, "--robot", "panda-turntable", "--joint", "wall")
        self.refused(4, "cell_invalid", "place", mesh, "--robot", "panda-turntable", "--x", "0:1:1000", "--y", "0:1:1000")
        for name in ("cell.json", "other.json"):
            (self.scratch / name).write_text((SOURCE / "config/cells/gantry.json").read_text().replace("../robots/gantry.urdf", "other.urdf"))
        (self.scratch / "other.urdf").write_text((SOURCE / "config/robots/gantry.urdf").read_text())
        for name in ("cell.json", "other.json"):  # the cell itself, or a name beside which its URDF would be written over
            self.refused(2, "usage", "place", mesh, "--robot", "./cell.json", "-o", name)
        self.refused(2, "format_unknown", "place", mesh, "--robot", "panda-turntable", "-o", "cell.txt")


class SecondClamping(ClientTest):
    def test_what_only_a_second_clamping_reaches_is_cut_by_it(self):
        mesh = SOURCE / "config/samples/dish.stl"  # upside down: hollow from below
        common = ("--robot", "panda-turntable", "--resolution", 16, "--json")
        first = json.loads(self.fine("plan", mesh, *common, "--rotate", "180,0,0", "--turn-over", "180,0,0", "-o", "first.sct"))
        self.assertGreater(first["voxels"]["residue"], 0)
        second = json.loads(self.fine("plan", "first.sct.target.binvox", "--stock", "first.sct.stock.binvox", *common, "-o", "second.sct"))
        self.assertEqual(second["voxels"]["remove"], first["voxels"]["residue"])
        self.assertEqual(second["voxels"]["residue"], 0)

    def test_only_quarters_turn_a_grid_onto_itself(self):
        mesh = shapes.write_stl(self.scratch / "mesh.stl", shapes.steps())
        self.refused(2, "usage", "plan", mesh, "--robot", "gantry", "--resolution", 8, "-o", "x.sct", "--turn-over", "45,0,0")


class Voxelize(ClientTest):
    def voxelize(self, triangles, *options):
        mesh = shapes.write_stl(self.scratch / "mesh.stl", triangles)
        counts = json.loads(self.fine("voxelize", mesh, "--resolution", 16, "-o", "mesh.binvox", "--json", *options))
        return counts["voxels"], (self.scratch / "mesh.binvox").read_bytes()

    def test_a_box_fills_its_share_of_the_grid(self):
        voxels, binvox = self.voxelize(shapes.steps())
        self.assertEqual(voxels, {"total": 4096, "air": 0, "keep": 16 * 16 * 8 + 8 * 8 * 8, "remove": 4096 - 2560, "ambiguous": 0})
        self.assertTrue(binvox.startswith(b"#binvox 1\ndim 16 16 16\n"), binvox[:60])

    def test_a_ball_has_the_volume_of_a_ball(self):
        voxels, _ = self.voxelize(shapes.ball(24))
        self.assertAlmostEqual(voxels["keep"] / (math.pi / 6 * 4096), 1, delta=0.05)

    def test_what_the_mesh_leaves_in_doubt_is_counted_and_told(self):
        mesh = shapes.write_stl(self.scratch / "mesh.stl", shapes.box((0, 0, 0), (16, 16, 16)) + shapes.box((4, 4, 4), (12, 12, 12)))
        done = self.run_client("voxelize", mesh, "--resolution", 16, "-o", "mesh.binvox", "--json")
        self.assertEqual(json.loads(done.stdout)["voxels"]["ambiguous"], 8 ** 3)
        self.assertRegex(done.stderr, r"warning: of 512 voxels .* \(around 500\.0, 500\.0, 500\.0 mm")

    def test_placement_is_metres_and_degrees(self):
        quarter, _ = self.voxelize(shapes.box((0, 0, 0), (1, 2, 4)), "--scale", "0.25", "--rotate", "0,90,0")
        self.assertEqual(quarter["keep"], 16 * 8 * 4)
        shifted, _ = self.voxelize(shapes.box((0, 0, 0), (1, 1, 1)), "--scale", "0.5", "--offset", "-0.25,0.25,0.5")
        self.assertEqual(shifted["keep"], 8 * 8 * 8)
        self.refused(4, "target_outside_stock", "voxelize", self.scratch / "mesh.stl", "--resolution", 16, "-o", "x.binvox",
                     "--scale", "0.5", "--offset", "0.3,0,0")

    def test_stock_may_be_a_box_or_an_earlier_grid(self):
        half, _ = self.voxelize(shapes.steps(), "--stock-box", "0,0,0,1,1,0.5")
        self.assertEqual((half["air"], half["keep"], half["remove"]), (2048, 2048, 0))
        (self.scratch / "mesh.binvox").rename(self.scratch / "half.binvox")
        again, _ = self.voxelize(shapes.steps(), "--stock", "half.binvox")
        self.assertEqual(again, half)

    def test_the_memory_cap_is_kept_before_loading(self):
        mesh = shapes.write_stl(self.scratch / "mesh.stl", shapes.steps())
        self.refused(4, "memory_cap", "voxelize", mesh, "--resolution", 16, "-o", "x.binvox", "--memory-cap", "100k")
        self.refused(2, "usage", "voxelize", mesh, "--resolution", 16, "-o", "x.binvox", "--memory-cap", "lots")

    def test_an_output_that_cannot_be_written_is_usage(self):
        mesh = shapes.write_stl(self.scratch / "mesh.stl", shapes.steps())
        self.refused(2, "file_unwritable", "voxelize", mesh, "--resolution", 16, "-o", "no/such/folder.binvox")


class Plan(ClientTest):
    def plan(self, output, *options, robot="panda-turntable", resolution=8):
        self.mesh = shapes.write_stl(self.scratch / "steps.stl", shapes.steps())
        return json.loads(self.fine("plan", self.mesh, "--resolution", resolution, "--robot", robot, "--json", "-o", output, *options))

    def verify(self, file, **expected):
        return self.run_client("verify", file, "--mesh", self.mesh, "--robot", expected.get("robot", "panda-turntable"), "--json")

    def test_both_cells_remove_all_of_a_shape_without_hidden_corners(self):
        for robot in ("gantry", "panda-turntable"):
            with self.subTest(robot=robot):
                report = self.plan("plan.ndjson", robot=robot)
                voxels = report["voxels"]
                self.assertEqual((voxels["remove"], voxels["removed"], voxels["residue"]), (192, 192, 0), report)
                self.assertTrue(report["verify"]["clean"], report)
                self.assertEqual(report["robot"], robot)

    def test_the_report_has_the_promised_fields(self):
        report = self.plan("plan.ndjson", "--seed", 7)
        fields = {"mesh", "robot", "search", "seed", "resolution", "voxels", "residue", "octree", "path", "seconds", "peak_memory_bytes",
                  "threads", "plan_sha256", "verify"}
        self.assertLessEqual(fields, set(report))
        self.assertEqual(set(report["voxels"]), {"total", "air", "keep", "remove", "removed", "residue", "loose_keep", "loose_keep_pieces", "freed", "ambiguous"})
        self.assertLessEqual({"keyframes", "rows", "transits", "cut_m", "travel_m", "joint_travel_rad"}, set(report["path"]))
        self.assertLessEqual({"load", "voxelize", "octree", "plan", "verify", "total"}, set(report["seconds"]))
        self.assertEqual((report["mesh"], report["seed"], report["resolution"]), ("steps.stl", 7, 8))

    def test_the_same_seed_gives_the_same_bytes_at_any_number_of_threads(self):
        hashes, texts = set(), set()
        for threads in (1, 2, 4):
            hashes.add(self.plan("plan.ndjson", "--threads", threads)["plan_sha256"])
            texts.add((self.scratch / "plan.ndjson").read_bytes())
        self.assertEqual((len(hashes), len(texts)), (1, 1))
        lines = texts.pop().splitlines(keepends=True)
        end = json.loads(lines[-1])
        self.assertEqual(end["sha256"], hashlib.sha256(b"".join(lines[:-1])).hexdigest())
        self.assertEqual(end["sha256"], hashes.pop())

    def test_the_extension_chooses_the_format(self):
        self.plan("plan.ndjson")
        self.plan("plan.sct")
        self.plan("plan.csv")
        keyframes = len((self.scratch / "plan.ndjson").read_bytes().splitlines()) - 2
        csv = [line for line in (self.scratch / "plan.csv").read_text().splitlines() if not line.startswith("#")]
        self.assertEqual(len(csv), keyframes + 1)
        self.assertTrue((self.scratch / "plan.sct").read_bytes().startswith(b"SCULPTRJ"))
        self.refused(2, "format_unknown", "plan", self.mesh, "--resolution", 8, "--robot", "gantry", "-o", "plan.txt")
        self.assertEqual(sorted(os.listdir(self.scratch)), ["plan.csv", "plan.ndjson", "plan.sct", "steps.stl"])

    def test_a_file_is_replayed_in_both_forms(self):
        self.plan("plan.ndjson")
        self.plan("plan.sct")
        for file in ("plan.ndjson", "plan.sct"):
            verdict = self.verify(file)
            self.assertEqual(verdict.returncode, 0, verdict.stdout + verdict.stderr)
            self.assertEqual(json.loads(verdict.stdout)["voxels_checked"], 192)

    def test_a_damaged_file_is_refused_and_a_wrong_plan_is_found(self):
        self.plan("plan.ndjson")
        lines = (self.scratch / "plan.ndjson").read_text().splitlines(keepends=True)
        (self.scratch / "damaged.ndjson").write_text("".join(lines[:-2] + lines[-1:]))
        self.refused(4, "trajectory_invalid", "verify", "damaged.ndjson", "--mesh", self.mesh, "--robot", "panda-turntable")
        cut = next(n for n, line in enumerate(lines) if '"cut"' in line)
        keyframe = json.loads(lines[cut])
        keyframe["q"][1] += 0.02
        lines[cut] = json.dumps(keyframe, separators=(",", ":")) + "\n"
        end = json.loads(lines[-1])
        end["sha256"] = hashlib.sha256("".join(lines[:-1]).encode()).hexdigest()
        lines[-1] = json.dumps(end, separators=(",", ":")) + "\n"
        (self.scratch / "wrong.ndjson").write_text("".join(lines))
        verdict = self.verify("wrong.ndjson")
        self.assertEqual(verdict.returncode, 1, verdict.stdout + verdict.stderr)
        self.assertEqual(json.loads(verdict.stdout)["findings"][0]["line"], cut + 1)

    def test_a_file_needs_the_mesh_and_the_cell(self):
        self.plan("plan.ndjson")
        self.refused(2, "usage", "verify", "plan.ndjson")
        self.refused(2, "file_missing", "verify", "nothere.ndjson", "--mesh", self.mesh, "--robot", "gantry")

    def test_interrupt_ends_a_plan_and_leaves_no_file(self):
        mesh = shapes.write_stl(self.scratch / "ball.stl", shapes.ball(24))
        process = subprocess.Popen([*SCULPT, "plan", mesh, "--resolution", "256", "--robot", "panda-turntable", "-o", "ball.ndjson"],
                                   cwd=self.scratch, env=environment(), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while not list(self.scratch.glob("*.part")):  # from the moment there is a file on, interrupts are caught
            with contextlib.suppress(subprocess.TimeoutExpired):
                self.fail(f"it ended with {process.wait(timeout=0.01)} before the interrupt")
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate()
        self.assertEqual(process.returncode, 1, errors)
        self.assertRegex(errors, r"sculpt: cancelled: ")
        self.assertEqual(os.listdir(self.scratch), ["ball.stl"])

    def test_davids_head_on_the_gantry_is_planned_whole(self):
        david = shared_data(self, "meshes/david.stl")
        report = json.loads(self.fine("plan", david, "--resolution", 64, "--robot", "gantry", "--json", "-o", "david.ndjson"))
        voxels = report["voxels"]
        self.assertEqual(voxels["removed"] + voxels["residue"], voxels["remove"])
        self.assertLess(voxels["residue"], 0.01 * voxels["remove"])
        self.assertTrue(report["verify"]["clean"])


if __name__ == "__main__":
    unittest.main()
