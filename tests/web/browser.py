"""A headless Chromium, driven over its DevTools protocol with the project's own WebSocket client: no npm, no driver program."""

import base64
import json
import os
import pathlib
import shutil
import socket
import subprocess
import tempfile
import time
import unittest
import urllib.request

import web_socket
from harness import PATIENCE_S

NAMES = "chromium", "chromium-browser", "google-chrome"
FLAGS = ["--headless=new", "--remote-debugging-port=0", "--no-first-run", "--no-default-browser-check", "--disable-background-networking",
         "--disable-component-update", "--disable-dev-shm-usage", "--disable-sync", "--disable-extensions", "--mute-audio", "--hide-scrollbars",
         # The picture is made by SwiftShader, the same everywhere.
         "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]


def find_chromium():
    """Its path; skips the test where there is none."""
    found = os.environ.get("SCULPT_CHROMIUM") or next(filter(None, map(shutil.which, NAMES)), None)
    if not found:
        raise unittest.SkipTest("no chromium: scripts/install-deps installs it, or set SCULPT_CHROMIUM to the program")
    return found


class Browser:
    """One process for many pages."""

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory(prefix="sculpt-chromium-", ignore_cleanup_errors=True)
        root = ["--no-sandbox"] if os.geteuid() == 0 else []
        self.process = subprocess.Popen([find_chromium(), *FLAGS, *root, f"--user-data-dir={self.folder.name}", "about:blank"],
                                        stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        port_file = pathlib.Path(self.folder.name) / "DevToolsActivePort"
        end = time.monotonic() + PATIENCE_S
        while not (port_file.exists() and port_file.read_text().count("\n")):
            assert self.process.poll() is None and time.monotonic() < end, "chromium did not start"
            time.sleep(0.02)
        self.address = f"127.0.0.1:{port_file.read_text().splitlines()[0]}"

    def open(self, url, width=1280, height=800, **emulation):
        request = urllib.request.Request(f"http://{self.address}/json/new?about:blank", method="PUT")
        with urllib.request.urlopen(request, timeout=PATIENCE_S) as reply:
            target = json.load(reply)
        page = Page(self.address, target["id"])
        page.begin(width, height, **emulation)
        page.go(url)
        return page

    def close(self):
        self.process.terminate()
        self.process.wait(PATIENCE_S)
        self.folder.cleanup()


class Page:
    """One tab. `faults`: exceptions, errors of the console (refusals of the content policy among them); `requests`: all URLs asked for."""

    def __init__(self, address, target):
        host, port = address.split(":")
        path = f"/devtools/page/{target}"
        self.wire = web_socket.WebSocket(socket.create_connection((host, int(port)), timeout=PATIENCE_S), address, path)
        self.next_id, self.faults, self.requests, self.bytes = 1, [], [], 0

    def begin(self, width, height, dark=False, touch=False):
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=touch)
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"},
                                                          {"name": "prefers-reduced-motion", "value": "reduce"}])

    def call(self, method, **params):
        number, self.next_id = self.next_id, self.next_id + 1
        self.wire.send(json.dumps({"id": number, "method": method, "params": params}).encode())
        while True:
            message = json.loads(self.wire.receive()[1])
            if message.get("id") == number:
                assert "error" not in message, f"{method}: {message['error']}"
                return message["result"]
            self._note(message.get("method"), message.get("params", {}))

    def _note(self, event, params):
        if event == "Runtime.exceptionThrown":
            details = params["exceptionDetails"]
            self.faults.append(details.get("exception", {}).get("description") or details["text"])
        elif event == "Log.entryAdded" and params["entry"]["level"] == "error":
            self.faults.append(f"{params['entry']['text']} {params['entry'].get('url', '')}")
        elif event == "Runtime.consoleAPICalled" and params["type"] in ("error", "assert"):
            self.faults.append(" ".join(str(argument.get("value", argument.get("description"))) for argument in params["args"]))
        elif event == "Network.requestWillBeSent":
            self.requests.append(params["request"]["url"])
        elif event == "Network.loadingFinished":
            self.bytes += params["encodedDataLength"]

    def go(self, url):
        self.call("Page.navigate", url=url)

    def run(self, expression):
        """Its value, awaited. A click on the page may be what it does."""
        result = self.call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True, userGesture=True)
        if "exceptionDetails" in result:
            details = result["exceptionDetails"]
            raise AssertionError(f"{expression}\n{details.get('exception', {}).get('description') or details['text']}")
        return result["result"].get("value")

    def app(self, expression):
        """With `app`, the page's own object, in reach; the content policy lets a module of the page be imported."""
        return self.run(f"import('/ui/app.js').then(async ({{app}}) => ({expression}))")

    def until(self, expression, what=None, pause_s=0.03):
        """Waits for it to be true of `app`; to look takes the page time."""
        end = time.monotonic() + PATIENCE_S
        while not self.app(f"Boolean({expression})"):
            assert time.monotonic() < end, f"never: {what or expression}\n{self.text()}\n{self.faults}"
            time.sleep(pause_s)

    def settled(self):
        """All that was asked for is drawn."""
        self.until("app.stage && app.stage.settled")

    def text(self, selector="body"):
        return self.run(f"document.querySelector({json.dumps(selector)})?.innerText ?? ''")

    def click(self, selector):
        self.run(f"document.querySelector({json.dumps(selector)}).click()")

    def key(self, key, shift=False):
        code = {"ArrowLeft": 37, "ArrowRight": 39, "Home": 36, "End": 35, "Escape": 27, "Tab": 9, " ": 32}.get(key, ord(key[0].upper()))
        text = {"text": key} if len(key) == 1 else {}
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, windowsVirtualKeyCode=code, modifiers=8 if shift else 0, **(text if kind == "keyDown" else {}))

    def choose_file(self, selector, path):
        document = self.call("DOM.getDocument")["root"]["nodeId"]
        node = self.call("DOM.querySelector", nodeId=document, selector=selector)["nodeId"]
        self.call("DOM.setFileInputFiles", nodeId=node, files=[str(path)])

    def save(self, path):
        """A PNG of the page."""
        pathlib.Path(path).write_bytes(base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"]))

    def close(self):
        self.call("Page.close")
        self.wire.close()
