"""No barrier for people who use the page by keyboard, by ear, or with other colours: axe (vendor/) finds nothing serious in what it shows."""

import pathlib
import unittest

from page_kit import SAMPLES, PageTest

AXE = (pathlib.Path(__file__).parent / "vendor" / "axe.min.js").read_text()
FOUND = """axe.run(document, {preload: false}).then(({passes, violations}) => passes.length < 10 ? ['it looked at next to nothing'] : violations.filter(({impact}) => ['serious', 'critical'].includes(impact))
    .map(({id, help, nodes}) => [id, help, ...nodes.map(({html, any}) => html.slice(0, 160) + ' ' + (any[0]?.message ?? ''))]))"""


class Barriers(PageTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.job = cls.plan(SAMPLES / "vase.stl", resolution=16)

    def assert_open(self, page, where):
        self.assertEqual(page.run(FOUND), [], where)

    def test_nothing_serious_on_the_page_light_and_dark_wide_and_narrow(self):
        for look in ({}, {"dark": True}, {"width": 390, "height": 844, "touch": True}):
            page = self.open(f"#job={self.job}", **look)
            page.settled()
            page.until("document.querySelectorAll('#panel-residue .reason').length > 0")
            page.run(AXE)
            for tab in ("report", "residue", "plots", "layers", "export"):
                page.click(f"#tab-{tab}")
                self.assert_open(page, (look, tab))

    def test_nothing_serious_in_its_dialogs_and_without_a_job(self):
        page = self.open("#job=none")
        page.until("!document.querySelector('#new-job').hidden && document.querySelector('#stage-note').innerText !== ''")
        page.run(AXE)
        self.assert_open(page, "no such job")
        page.key("?")
        self.assert_open(page, "keys")
        page.key("Escape")
        page.click("#new-job")
        page.until("document.querySelector('#submit').open")
        self.assert_open(page, "new job")

    def test_all_is_reached_by_the_keyboard(self):
        page = self.open(f"#job={self.job}")
        page.settled()
        wanted = set(page.run("""[...document.querySelectorAll('button, input, select, [tabindex="0"]')].filter(one => one.checkVisibility() && one.tabIndex >= 0
            && !one.disabled).map((one, at) => (one.dataset.stop = one.id || `${one.tagName} ${at}`))"""))
        seen = set()
        for _ in range(2 * len(wanted) + 10):
            page.key("Tab")
            seen.add(page.run("document.activeElement?.dataset.stop ?? ''"))
        self.assertEqual(wanted - seen, set())


if __name__ == "__main__":
    unittest.main()
