"""Makes the picture of the studio that the documentation shows: ``python examples/studio_picture.py [FILE]``.

A lunch in the bistro, paused when guests sit, one of its colleagues sent elsewhere.  Needs the extra
``studio``, playwright and Chromium.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SIZE = {"width": 1280, "height": 800}


def take(out: str) -> None:
    """Starts a studio, lets it live for a while, and takes its picture."""
    from playwright.sync_api import sync_playwright

    command = [sys.executable, "-m", "waiter_cli", "studio", "--no-open"]
    with subprocess.Popen(
        [*command, "--scenario", "lunch", "--speed", "10"],
        stdout=subprocess.PIPE,
        text=True,
        cwd=ROOT,
    ) as studio:
        assert studio.stdout is not None
        address = studio.stdout.readline().removeprefix("studio: ").strip()
        chromium = shutil.which("chromium") or shutil.which("chromium-browser")
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
            page = browser.new_page(viewport=SIZE)
            page.goto(address)
            page.wait_for_selector('body[data-ready="true"]')
            log = page.get_by_role("log", name="events")
            log.get_by_text("sit down at table5").wait_for(timeout=60_000)
            page.get_by_role("button", name="Pause", exact=True).click()
            page.get_by_label("waiter w1", exact=True).click()
            page.get_by_role("menuitem", name="go to mid3", exact=True).click()
            page.get_by_role("list", name="diagnosis").wait_for()
            page.mouse.move(5, 5)
            page.wait_for_timeout(500)
            page.screenshot(path=out)
            browser.close()
        studio.terminate()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    default = os.path.join(ROOT, "docs", "images", "studio.png")
    parser.add_argument("file", nargs="?", default=default, metavar="FILE")
    take(parser.parse_args().file)
