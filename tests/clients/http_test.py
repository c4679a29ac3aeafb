"""What browsers and scripts speak at the one port: HTTP and WebSocket."""

import gzip
import hashlib
import http.client
import json
import os
import shutil
import socket
import subprocess
import unittest

import shapes
import web_socket
from door import HELLO, WithAJob, call, line, split
from harness import PATIENCE_S, SOURCE

import sculpt


class Http(WithAJob):
    def refused(self, status, word, *request, **headers):
        response, body = self.get(*request, **headers)
        self.assertEqual(response.status, status, body)
        self.assertEqual(json.loads(body)["data"]["code"], word)

    def test_health_and_metrics(self):
        for path, said in (("/livez", b"alive\n"), ("/readyz", b"ready\n")):
            response, body = self.get(path)
            self.assertEqual((response.status, body), (200, said))
        response, body = self.get("/metrics")
        self.assertEqual(response.status, 200)
        self.assertIn(b'\nsculptd_jobs{state="succeeded"} 1\n', body)

    def test_not_ready_says_why(self):
        daemon = self.daemon(disk_floor_bytes=2**62)
        other = http.client.HTTPConnection(daemon.address, timeout=PATIENCE_S)
        self.addCleanup(other.close)
        other.request("GET", "/readyz")
        response = other.getresponse()
        self.assertEqual(response.status, 503)
        self.assertIn(b"disk_floor_bytes", response.read())

    def test_an_artifact_is_the_same_as_over_the_protocol(self):
        response, body = self.get(self.path)
        self.assertEqual((response.status, body), (200, self.trajectory))
        self.assertEqual(response.getheader("ETag"), f'"{hashlib.sha256(self.trajectory).hexdigest()}"')
        self.assertEqual(self.get(self.path + "?format=csv")[1], self.csv)
        self.assertEqual(self.get(f"/v1/artifacts/{self.job}/voxels")[1][:9], b"#binvox 1")

    def test_the_timeline_packed_is_the_one_that_grew(self):
        with sculpt.Client(self.server.address) as client:
            tokens = b"".join(client.read_artifact(self.job, "timeline"))
            packed = b"".join(client.read_artifact(self.job, "timeline", format="gzip"))
            residue, packed_residue = (b"".join(client.read_artifact(self.job, "residue", format=form)) for form in ("ndjson", "gzip"))
        self.assertEqual(gzip.decompress(packed), tokens)
        self.assertEqual(gzip.decompress(packed_residue), residue)
        response, body = self.get(f"/v1/artifacts/{self.job}/timeline?format=gzip")
        self.assertEqual((response.getheader("Content-Type"), body), ("application/gzip", packed))
        header, runs, cuts = sculpt.read_timeline(tokens)
        lines = [json.loads(text) for text in self.trajectory.splitlines()]
        self.assertEqual(header, lines[0])
        self.assertEqual(cuts, [keyframe.get("voxels") for keyframe in lines[1:-1]])
        with sculpt.Client(self.server.address) as client:
            voxels = client.call("job.report", job=self.job)["voxels"]
        for label in sculpt.LABELS:
            self.assertEqual(sum(length for name, length in runs if name == label), voxels[label], label)

    def test_the_cell_of_a_job(self):
        response, body = self.get(f"/v1/jobs/{self.job}/cell/")
        self.assertEqual(response.getheader("Content-Type"), "application/json")
        bundle = json.loads(body)
        self.assertEqual(bundle["name"], "gantry")
        self.assertEqual(json.loads(bundle["cell"]), json.loads((SOURCE / "config/cells/gantry.json").read_text()))
        for reference, file in bundle["files"].items():
            response, body = self.get(f"/v1/jobs/{self.job}/cell/{file['blob']}")
            self.assertEqual(body, (SOURCE / "config/cells" / reference).read_bytes())
            tag = response.getheader("ETag")
            self.assertEqual(tag, f'"{hashlib.sha256(body).hexdigest()}"')
            response, body = self.get(f"/v1/jobs/{self.job}/cell/{file['blob']}", If_None_Match=tag)
            self.assertEqual((response.status, body), (304, b""))

    def test_of_a_cell_nothing_but_its_own_files_is_given(self):
        with sculpt.Client(self.server.address) as client:
            mesh = client.upload_file(shapes.write_stl(self.scratch / "other.stl", shapes.steps()))
        self.refused(404, "not_found", f"/v1/jobs/{self.job}/cell/{mesh['blob']}")
        self.refused(404, "not_found", f"/v1/jobs/{self.job}/cell/../../../etc/passwd")
        self.refused(404, "not_found", f"/v1/jobs/{self.job}")
        self.refused(404, "not_found", "/v1/jobs/nosuchjob/cell/")

    def test_a_link_is_for_one_file(self):
        with sculpt.Client(self.server.address) as client:
            link = client.call("artifact.link", job=self.job, artifact="trajectory", format="csv")
        self.assertTrue(link["path"].endswith("/trajectory.csv"), link)
        self.assertEqual(self.get(link["path"])[1], self.csv)
        self.assertEqual(self.get(link["path"], Range="bytes=3-9")[1], self.csv[3:10])
        ticket = link["path"].split("/")[3]
        self.assertEqual(self.get(f"/v1/links/{ticket}/voxels.binvox")[1], self.csv, "the name means nothing")
        self.refused(410, "gone", f"/v1/links/{'0' * 64}/trajectory.csv")
        self.refused(410, "gone", "/v1/links/")

    def test_the_page_is_there_for_all_and_may_speak_to_this_server_only(self):
        response, body = self.get("/")
        self.assertEqual(response.getheader("Content-Type"), "text/html; charset=utf-8")
        self.assertEqual(body, (SOURCE / "clients/web/index.html").read_bytes())
        policy = dict(rule.split(" ", 1) for rule in response.getheader("Content-Security-Policy").split("; "))
        self.assertEqual((policy["default-src"], policy["script-src"], policy["frame-ancestors"]), ("'none'", "'self'", "'none'"))
        self.assertNotIn("unsafe", str(policy))
        self.assertEqual(response.getheader("Cross-Origin-Opener-Policy"), "same-origin")
        for path in sorted((SOURCE / "clients/web").rglob("*.js")):
            name = path.relative_to(SOURCE / "clients/web")
            if name.parts[:2] == ("vendor", "source"):
                continue
            response, body = self.get(f"/ui/{name}", Accept_Encoding="br, gzip")
            self.assertEqual(response.getheader("Content-Type"), "text/javascript; charset=utf-8")
            self.assertEqual(response.getheader("Cross-Origin-Embedder-Policy"), "require-corp")
            text, file = gzip.decompress(body).decode(), path.read_text()
            if str(name) in ("app.js", "stock/worker.js"):  # with all that they import
                self.assertIn(file[-2000:].replace("export ", ""), text, name)
                self.assertGreater(len(text), 2 * len(file), name)
            else:
                self.assertEqual(text, file, name)
            again, body = self.get(f"/ui/{name}", Accept_Encoding="br, gzip", If_None_Match=response.getheader("ETag"))
            self.assertEqual((again.status, body), (304, b""))
        self.refused(404, "not_found", "/ui/nothing.js")

    def test_the_page_of_a_folder_leads_out_of_it_nowhere(self):
        web = self.scratch / "web"
        (web / "part").mkdir(parents=True)
        (web / "index.html").write_text("mine")
        (web / "part/a.js").write_text("1")
        daemon = self.daemon(web=str(web))
        other = http.client.HTTPConnection(daemon.address, timeout=PATIENCE_S)
        self.addCleanup(other.close)

        def status(path):
            other.request("GET", path)
            response = other.getresponse()
            response.read()
            return response.status
        self.assertEqual([status(path) for path in ("/", "/ui/part/a.js")], [200, 200])
        for path in ("/ui/../server.json", "/ui//etc/passwd", "/ui/part", "/ui/part/", "/ui/", "/ui/.hidden", "/ui/%2e%2e/server.json"):
            self.assertEqual(status(path), 404, path)

    def test_head_gives_the_size_alone(self):
        response, body = self.get(self.path, "HEAD")
        self.assertEqual((response.status, body), (200, b""))
        self.assertEqual(int(response.getheader("Content-Length")), len(self.trajectory))
        self.assertEqual(self.get("/livez")[1], b"alive\n", "the connection lives on")

    def test_ranges(self):
        size = len(self.trajectory)
        for asked, part in (("bytes=0-9", slice(0, 10)), (f"bytes={size - 5}-", slice(size - 5, size)), ("bytes=-7", slice(size - 7, size)),
                            (f"bytes=3-{size * 2}", slice(3, size))):
            response, body = self.get(self.path, Range=asked)
            self.assertEqual((response.status, body), (206, self.trajectory[part]), asked)
            self.assertEqual(response.getheader("Content-Range"), f"bytes {part.start}-{part.stop - 1}/{size}")
        response, body = self.get(self.path, Range=f"bytes={size}-")
        self.assertEqual((response.status, body), (416, b""))
        self.assertEqual(response.getheader("Content-Range"), f"bytes */{size}")

    def test_a_broken_download_goes_on_only_if_it_is_the_same(self):
        tag = self.get(self.path, "HEAD")[0].getheader("ETag")
        self.assertEqual(self.get(self.path, Range="bytes=5-", If_Range=tag)[1], self.trajectory[5:])
        self.assertEqual(self.get(self.path, Range="bytes=5-", If_Range='"other"')[1], self.trajectory)
        response, body = self.get(self.path, If_None_Match=f'"x", {tag}')
        self.assertEqual((response.status, body), (304, b""))
        self.assertEqual(self.get(self.path + "?format=csv", If_None_Match=tag)[0].status, 200, "another form is another thing")

    def test_what_is_not_there(self):
        self.refused(404, "not_found", "/nothing")
        self.refused(404, "not_found", "/v1/artifacts/nosuchjob/trajectory")
        self.refused(404, "not_found", "/v1/artifacts/nosuchjob")
        self.refused(400, "params_invalid", f"/v1/artifacts/{self.job}/statue")
        self.refused(400, "params_invalid", self.path + "?format=exe")
        self.refused(400, "params_invalid", self.path + "?size=1")
        self.refused(404, "not_found", "/v1/artifacts/../sculptd.db")

    def test_a_post_executes_nothing(self):
        for path in ("/", "/v1/ws", "/v1/artifacts/x/y", "/job.submit"):
            with self.subTest(path=path):
                cancel = line(HELLO) + line(call(2, "job.cancel", job=self.job))
                self.refused(405, "method_refused", path, "POST", cancel)
                self.connection.close()
        with sculpt.Client(self.server.address) as client:
            self.assertEqual([job["state"] for job in client.call("job.list")["jobs"]], ["succeeded"])

    def test_a_name_that_is_not_ours_is_refused(self):
        self.refused(421, "host_refused", "/livez", Host="evil.example")
        self.refused(421, "host_refused", "/livez", Host="localhost:x@evil.example")
        self.refused(421, "host_refused", self.path, Host=f"evil.example:{split(self.server.address)[1]}")
        for host in ("localhost", "127.0.0.1:1", "planner.example"):
            self.assertEqual(self.get("/livez", Host=host)[0].status, 200, host)

    def test_a_page_of_another_origin_is_refused(self):
        self.refused(403, "origin_refused", self.path, Origin="http://evil.example")
        self.refused(403, "origin_refused", self.path, Origin="http://localhost:3000")
        self.assertRegex(self.server.log(), r'conn=\d+ origin_refused host=.* origin="http://localhost:3000"')
        self.assertEqual(self.get(self.path, Origin=f"http://{self.server.address}")[0].status, 200)
        self.assertEqual(self.get(self.path, Origin="https://dash.example")[0].status, 200)

    def test_what_is_no_http_gets_400_and_the_end(self):
        for garbage in (b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"HELLO WORLD\n\n", b"GET / HTTP/1.1\r\nX: " + b"x" * 20000 + b"\r\n\r\n"):
            wire = self.wire(self.server)
            wire.socket.sendall(garbage)
            self.assertRegex(wire.stream.read(), rb"^HTTP/1.1 400 ", garbage[:20])

    def test_curl_speaks_to_it(self):
        curl = shutil.which("curl")
        if curl is None:
            self.skipTest("no curl here")
        target = self.scratch / "out.ndjson"
        target.write_bytes(self.trajectory[:100])
        subprocess.run([curl, "--fail", "--silent", "--continue-at", "-", "--output", target, f"http://{self.server.address}{self.path}"],
                       check=True, timeout=PATIENCE_S)
        self.assertEqual(target.read_bytes(), self.trajectory)


class WebSockets(WithAJob):
    def open(self, **options):
        connected = socket.create_connection(split(self.server.address), timeout=PATIENCE_S)
        self.addCleanup(connected.close)
        opened = web_socket.WebSocket(connected, options.pop("host", self.server.address), **options)
        self.addCleanup(opened.close)
        return opened

    def ask(self, opened, message):
        opened.send(json.dumps(message).encode())
        kind, answer = opened.receive()
        self.assertEqual(kind, web_socket.TEXT)
        self.assertFalse(answer.endswith(b"\n"), "one message is one line, without its end")
        return json.loads(answer)

    def test_a_message_is_a_line_and_a_chunk_the_next_binary_message(self):
        opened = self.open()
        self.assertEqual(self.ask(opened, HELLO)["result"]["protocol"], [1, 0])
        answer = self.ask(opened, call(2, "artifact.read", job=self.job, artifact="trajectory", offset=0, bytes=1 << 20))
        self.assertEqual(answer["result"]["bytes"], len(self.trajectory))
        self.assertEqual(opened.receive(), (web_socket.BINARY, self.trajectory))
        self.assertEqual(self.ask(opened, call(3, "ping"))["result"], {})

    def test_an_upload_and_events(self):
        opened = self.open(origin="https://dash.example")
        self.ask(opened, HELLO)
        content = os.urandom(200_000)
        digest = hashlib.sha256(content).hexdigest()
        opened.send(json.dumps(call(2, "blob.put", sha256=digest, size=len(content), offset=0, bytes=len(content))).encode(), pieces=3)
        opened.send(content, web_socket.BINARY, pieces=7)
        self.assertTrue(json.loads(opened.receive()[1])["result"]["complete"])
        self.ask(opened, call(3, "events.subscribe", job=self.job))
        events = [json.loads(opened.receive()[1])["params"] for _ in range(4)]
        self.assertEqual([event.get("seq") for event in events], [1, 2, 3, None])
        self.assertEqual(events[3]["type"], "live")

    def test_pings_are_answered_and_a_close_is_too(self):
        opened = self.open()
        opened.send(b"still there?", web_socket.PING)
        self.assertEqual(opened.receive(), (web_socket.PONG, b"still there?"))
        opened.send((1000).to_bytes(2, "big"), web_socket.CLOSE)
        self.assertEqual(opened.receive()[0], web_socket.CLOSE)

    def test_what_no_client_should_send_ends_it_with_a_word(self):
        opened = self.open()
        answer = self.ask(opened, call(1, "ping"))
        self.assertEqual(answer["error"]["data"]["code"], "hello_required")
        opened.send(b"\x01\x02", web_socket.BINARY)
        self.assertEqual(json.loads(opened.receive()[1])["error"]["data"]["code"], "not_text")
        self.assertEqual(opened.receive()[0], web_socket.CLOSE)

    def test_foreign_pages_and_names_are_refused(self):
        for refused, options in ((403, {"origin": "http://evil.example"}), (421, {"host": "evil.example"}), (404, {"path": "/v1/wss"})):
            with self.assertRaises(web_socket.Refused) as caught:
                self.open(**options)
            self.assertEqual(caught.exception.status, refused)
        self.assertRegex(self.server.log(), r'conn=\d+ origin_refused host=.* origin="http://evil.example"')


if __name__ == "__main__":
    unittest.main()
