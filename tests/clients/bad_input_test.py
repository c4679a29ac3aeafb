"""Bad input of every kind: the right exit code, a sentence with a cure, and a daemon that goes on."""

import json
import re
import socket
import unittest

import shapes
from harness import SCULPT_PY, SOURCE, ClientTest, Daemon, DaemonTest


class BadInput:
    """What `submit` must refuse; run by both clients, and the first half by `plan` too."""

    def job(self, mesh="good.stl", resolution=8, robot="gantry", *options):
        if mesh == "good.stl":
            shapes.write_stl(self.scratch / mesh, shapes.steps())
        return self.verb + [mesh, "--resolution", resolution, "--robot", robot, *options]

    def reject(self, exit_code, code, *arguments, hint="."):
        sentence = self.refused(exit_code, code, *self.job(*arguments))
        self.assertRegex(sentence, hint)
        self.assertGreater(len(sentence.split()), 5, "a sentence, not a word: " + sentence)

    def mesh(self, name, content):
        path = self.scratch / name
        if isinstance(content, list):
            shapes.write_stl(path, content)
        else:
            path.write_bytes(content)
        return name

    def test_a_file_that_is_not_there(self):
        self.reject(2, "file_missing", "nothere.stl", hint="nothere.stl")
        self.reject(2, "file_missing", "good.stl", 8, "nothere.json", hint="nothere.json")

    def test_a_folder_is_no_mesh(self):
        (self.scratch / "folder.stl").mkdir()
        self.reject(2, "file_unreadable", "folder.stl")

    def test_files_that_hold_no_mesh(self):
        for name, content in (("poem.stl", b"Full many a glorious morning have I seen\n" * 9), ("poem.obj", b"\0\1\2\3" * 99),
                              ("empty.ply", b""), ("half.glb", b"glTF\2\0\0\0"), ("mesh.docx", b"PK\3\4"), ("noextension", b"solid")):
            with self.subTest(name):
                self.reject(4, "(mesh_unreadable|mesh_empty|params_invalid)", self.mesh(name, content))

    def test_zero_triangles(self):
        self.reject(4, "mesh_(unreadable|empty)", self.mesh("none.stl", []))
        self.reject(4, "mesh_(unreadable|empty)", self.mesh("points.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\n"))

    def test_vertices_that_are_no_numbers(self):
        self.reject(4, "mesh_not_finite", self.mesh("nan.stl", shapes.with_vertex(float("nan"))))
        self.reject(4, "mesh_not_finite", self.mesh("inf.stl", shapes.with_vertex(float("inf"))))

    def test_a_surface_that_is_open(self):
        self.reject(4, "mesh_not_solid", self.mesh("bowl.stl", shapes.open_bowl()), hint=r"\d %")

    def test_a_binvox_that_is_none(self):
        self.reject(4, "binvox_invalid", self.mesh("x.binvox", b"#binvox 1\ndim 8 8 9\ndata\n"))
        self.reject(4, "binvox_invalid", self.mesh("y.binvox", b"#binvox 1\ndim 8 8 8\ndata\n\1\5"))

    def test_resolutions_that_are_no_power_of_two_from_8_to_1024(self):
        for resolution in (0, 7, -8, 4, 4096, 2048):
            with self.subTest(resolution):
                self.reject(4, "(resolution_invalid|params_invalid)", "good.stl", resolution, hint="8")

    def test_a_search_that_is_not_known(self):
        self.reject(4, "search_unknown", "good.stl", 8, "gantry", "--search", "magic", hint="octree")

    def test_a_cell_that_is_not_known(self):
        self.reject(4, "cell_unknown", "good.stl", 8, "no-such-cell", hint="gantry")

    def cell(self, **changes):
        shipped = json.loads((SOURCE / "config/cells/gantry.json").read_text())
        urdf = (SOURCE / "config/cells" / shipped["urdf"]).read_text()
        (self.scratch / "robot.urdf").write_text(changes.pop("urdf_text", urdf))
        (self.scratch / "cell.json").write_text(json.dumps({**shipped, "urdf": "robot.urdf", **changes}))
        return "cell.json"

    def test_a_cell_file_that_cannot_be_used(self):
        shipped = json.loads((SOURCE / "config/cells/gantry.json").read_text())
        stock, tool = shipped["stock"], shipped["tool"]
        for changes, hint in (({"stock": {**stock, "link": "nowhere"}}, "nowhere"), ({"tool": {**tool, "link": "nowhere"}}, "nowhere"),
                              ({"home": {"elbow": 0}}, "elbow"), ({"home": {**shipped["home"], "x": 99}}, "limit"),
                              ({"spindel": 1}, "spindel"), ({"stock": 7}, "stock")):
            with self.subTest(changes):
                self.reject(4, "cell_invalid", "good.stl", 8, self.cell(**changes), hint=hint)
        (self.scratch / "cell.json").write_text("{")
        self.reject(4, "cell_invalid", "good.stl", 8, "cell.json")

    def test_a_urdf_that_cannot_be_used(self):
        for text in ("<robot name='x'>", "no xml at all", "<robot name='x'></robot>"):
            with self.subTest(text):
                self.reject(4, "urdf_invalid", "good.stl", 8, self.cell(urdf_text=text))
        (self.scratch / "robot.urdf").unlink()
        self.reject(4, "file_missing", "good.stl", 8, "cell.json")

    def test_a_stock_that_the_tool_cannot_come_to(self):
        stock = json.loads((SOURCE / "config/cells/gantry.json").read_text())["stock"]
        self.reject(4, "stock_out_of_reach", "good.stl", 8, self.cell(stock={**stock, "origin_m": [50, 50, 50]}))

    def test_a_tool_wider_than_the_voxel(self):
        tool = json.loads((SOURCE / "config/cells/gantry.json").read_text())["tool"]
        wide = {"link": tool["link"], "ball_radius_m": 0.02}
        self.reject(4, "tool_too_large", "good.stl", 32, self.cell(tool=wide))

    def test_placements_that_make_no_sense(self):
        for options in (["--scale", "-1"], ["--scale", "0"], ["--margin", "0.5"]):
            with self.subTest(options):
                self.reject(4, "(placement_invalid|params_invalid)", "good.stl", 8, "gantry", *options)
        self.reject(4, "target_outside_stock", "good.stl", 8, "gantry", "--scale", "1")
        self.reject(2, "usage", "good.stl", 8, "gantry", "--stock-box", "0,0,0,1,1,1", "--stock", "x.stl")


class ByPlan(BadInput, ClientTest):
    verb = ["plan", "-o", "x.ndjson"]

    def test_a_mesh_over_the_memory_cap(self):
        self.reject(4, "memory_cap", "good.stl", 8, "gantry", "--memory-cap", "1M")


class BySubmit(BadInput, DaemonTest):
    verb = ["submit"]

    def test_priorities_and_seeds_out_of_range(self):
        self.reject(4, "params_invalid", "good.stl", 8, "gantry", "--priority", "101", hint="100")
        for seed in ("-1", "18446744073709551616", "1e3"):
            self.reject(2, "usage", "good.stl", 8, "gantry", "--seed", seed, hint=seed)

    def tearDown(self):
        super().tearDown()
        jobs = json.loads(self.fine("list", "--json"))["jobs"]
        self.assertEqual(jobs, [], "nothing that was refused may be queued")


class BySubmitInPython(BySubmit):
    client = SCULPT_PY

    def refused(self, exit_code, code, *arguments, **options):
        if code != "usage":
            return super().refused(exit_code, code, *arguments, **options)
        result = self.run_client(*arguments, **options)
        self.assertEqual(result.returncode, exit_code, result.stderr)
        return result.stderr

    def test_priorities_and_seeds_out_of_range(self):
        self.reject(4, "params_invalid", "good.stl", 8, "gantry", "--priority", "101", hint="100")
        self.reject(4, "params_invalid", "good.stl", 8, "gantry", "--seed", "-1")


class MemoryCapOfTheDaemon(ClientTest):
    def test_a_job_over_it_is_refused(self):
        (self.scratch / "server.json").write_text(json.dumps({"memory_cap_bytes": 8 << 20}))
        with Daemon(self.scratch / "data", "--config", str(self.scratch / "server.json")) as daemon:
            self.server = daemon.address
            mesh = shapes.write_stl(self.scratch / "ball.stl", shapes.ball())
            self.refused(4, "memory_cap", "submit", mesh, "--resolution", 1024, "--robot", "gantry")
            self.fine("submit", mesh, "--resolution", 8, "--robot", "gantry", "--wait")


class StrangersOnTheWire(DaemonTest):
    def say(self, request):
        """Everything the server answers before it closes, or before 5 quiet seconds."""
        host, port = self.server.rsplit(":", 1)
        with socket.create_connection((host, int(port)), timeout=5) as connection:
            connection.sendall(request)
            connection.shutdown(socket.SHUT_WR)
            answer = b""
            try:
                while chunk := connection.recv(65536):
                    answer += chunk
            except (TimeoutError, ConnectionResetError):
                pass
            return answer.decode()

    def test_what_is_no_request_gets_an_error_and_harms_nobody(self):
        for request, code in ((b"EHLO x\r\n", "not_text"), (bytes(range(256)) * 64, "not_text"),
                              (b"{" + b"x" * (2 << 20), "line_too_long"), (b"{" * 10000 + b"\n", "parse_error"),
                              (b'{"id":1,"method":["hello"]}\n', "bad_request"), (b'{"id":1,"id":2,"method":"ping"}\n', "parse_error"),
                              (b'{"id":1,"method":"hello","params":{"protocol":[1,0],"client":"x","colour":1}}\n', "params_invalid")):
            with self.subTest(request[:40]):
                self.assertIn(f'"code":"{code}"', re.sub(r"\s", "", self.say(request)))
                self.fine("list")

    def test_a_client_that_goes_away_in_mid_stream_is_forgotten(self):
        mesh = shapes.write_stl(self.scratch / "ball.stl", shapes.ball())
        job = self.fine("submit", mesh, "--resolution", 16, "--robot", "panda-turntable").strip()
        hello = b'{"id":1,"method":"hello","params":{"protocol":[1,0],"client":"rude"}}\n'
        subscribe = b'{"id":2,"method":"events.subscribe","params":{"job":"%s"}}\n' % job.encode()
        read = b'{"id":3,"method":"artifact.read","params":{"job":"%s","artifact":"trajectory","offset":0,"bytes":4000000}}\n' % job.encode()
        upload = b'{"id":4,"method":"blob.put","params":{"sha256":"%s","size":1000000,"offset":0,"bytes":1000000}}\nhalf' % (b"0" * 64)
        host, port = self.server.rsplit(":", 1)
        for request in (hello, hello + subscribe, hello + subscribe + read * 20, hello + upload):
            connection = socket.create_connection((host, int(port)))
            connection.sendall(request)
            connection.close()
        self.fine("wait", job)


if __name__ == "__main__":
    unittest.main()
