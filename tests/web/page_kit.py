"""What the tests of the page share: a daemon and a browser for each class."""

import json
import pathlib
import tempfile
import unittest
import urllib.parse

from browser import Browser, find_chromium
from harness import SOURCE, Daemon

import sculpt

SAMPLES = SOURCE / "config/samples"


class PageTest(unittest.TestCase):
    """One daemon and one browser for all tests of a class."""

    settings = {}

    @classmethod
    def setUpClass(cls):
        find_chromium()
        folder = tempfile.TemporaryDirectory(prefix="sculpt-test-")
        cls.addClassCleanup(folder.cleanup)
        cls.scratch = pathlib.Path(folder.name)
        cls.start_daemon()
        cls.addClassCleanup(lambda: cls.daemon.stop())
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)

    @classmethod
    def start_daemon(cls, listen="127.0.0.1:0"):
        config = cls.scratch / "server.json"
        config.write_text(json.dumps(cls.settings))
        cls.daemon = Daemon(cls.scratch / "data", "--config", str(config), listen=listen)

    def open(self, fragment="", **options):
        page = self.browser.open(f"http://{self.daemon.address}/{fragment}", **options)
        self.addCleanup(page.close)
        return page

    @classmethod
    def plan(cls, mesh, robot="panda-turntable", resolution=32, wait=True, **spec):
        """The id of a job, finished where nothing else is said."""
        with sculpt.Client(cls.daemon.address) as client:
            job = client.submit({"mesh": client.upload_file(mesh), "robot": robot, "resolution": resolution, **spec})["job"]
            if wait:
                assert client.wait(job)["state"] == "succeeded"
            return job

    def assert_well_behaved(self, page):
        """No error, no refusal of the content policy, and nobody else was asked for anything."""
        self.assertEqual(page.faults, [])
        origins = {urllib.parse.urlsplit(url).netloc for url in page.requests if not url.startswith(("blob:", "data:", "about:"))}
        self.assertEqual(origins, {self.daemon.address})
