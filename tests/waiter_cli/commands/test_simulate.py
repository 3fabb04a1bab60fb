"""``waiter simulate`` as a user meets it: exit codes, streams, files."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from math import atan2
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.paths import ROOT
from waiter_cli.files.layout_reader import read_layout_file
from waiter_cli.optional_packages import extra_line
from waiter_cli.simulation.summary import _nearness
from waiter_cli.simulation.world import Violation

HEADLESS = ("--headless", "--backend", "geometric")


def simulate(*arguments: str, stdin: str = ""):  # type: ignore[no-untyped-def]
    return waiter("simulate", *HEADLESS, *arguments, stdin=stdin)


def test_a_scene_says_what_it_did() -> None:
    ran = simulate("--scenario", "b1")
    assert ran.code == 0
    assert ran.out.startswith("done: b1, 7 actions in ")
    assert "\n  the robot came within 0.15 m of c1, and no closer to anything; " in ran.out
    assert "all checks passed" in ran.out
    assert ran.err == ""


def test_what_the_robot_ran_into_is_touched() -> None:
    assert _nearness("the robot", -0.02, "table1") == "the robot touched table1"


def test_json_is_one_document() -> None:
    ran = simulate("--scenario", "b3", "--json")
    document = ran.json()
    assert document["status"] == "done"
    assert document["failed_checks"] == []
    assert document["final_state"]["paid"] == ["table1"]
    assert ran.out.count("\n") == 1


def test_events_on_stdout_are_all_there_is() -> None:
    ran = simulate("--scenario", "b3", "--events", "-")
    events = [json.loads(line) for line in ran.out.splitlines()]
    assert [e["type"] for e in events][0 :: len(events) - 1] == ["start", "end"]
    assert "done: b3" in ran.err


def test_an_event_file_is_the_same_each_time(tmp_path: Path) -> None:
    texts = []
    for name in ("a.jsonl", "b.jsonl"):
        simulate(
            "--scenario",
            "b2",
            "--events",
            str(tmp_path / name),
            "--inject",
            "slip:0.3",
            "--seed",
            "4",
        )
        texts.append((tmp_path / name).read_bytes())
    assert texts[0] == texts[1] and texts[0]
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.jsonl", "b.jsonl"]


def test_a_plan_made_before(tmp_path: Path) -> None:
    made = waiter("plan", "--scenario", "b1", "--json")
    file = tmp_path / "plan.json"
    file.write_text(made.out)
    ran = simulate("--plan", str(file), "--layout", "report", "--json")
    assert ran.code == 0
    document = ran.json()
    assert document["final_state"] == made.json()["final_state"]
    assert document["replans"] == 0
    piped = simulate("--plan", "-", stdin=made.out)
    assert piped.code == 0


def test_a_plan_made_wrong_is_caught(tmp_path: Path) -> None:
    plan = waiter("plan", "--scenario", "b1", "--json").json()
    del plan["actions"][2]
    file = tmp_path / "plan.json"
    file.write_text(json.dumps(plan))
    ran = simulate("--plan", str(file), "--on-failure", "stop", "--json")
    assert ran.code == 3
    assert [f["check"] for f in ran.json()["failed_checks"]] == ["edge"]


def test_a_final_state_made_wrong_is_caught(tmp_path: Path) -> None:
    plan = waiter("plan", "--scenario", "b1", "--json").json()
    plan["final_state"]["agent"] = "n5"
    file = tmp_path / "plan.json"
    file.write_text(json.dumps(plan))
    ran = simulate("--plan", str(file), "--json")
    assert ran.code == 3
    assert [f["check"] for f in ran.json()["failed_checks"]] == ["final_state"]


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        (("--scenario", "b1", "--inject", "block:n5-n6@0"), 4, "n5-n6 stayed blocked for"),
        (("--scenario", "b1", "--inject", "slip:1", "--on-failure", "stop"), 3, "slipped"),
        (("--scenario", "too_big"), 4, "gave up"),
    ],
)
def test_what_goes_wrong_is_said(arguments: tuple[str, ...], code: int, said: str) -> None:
    ran = simulate(*arguments)
    assert ran.code == code
    assert said in ran.out


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ((), "which restaurant"),
        (("--scenario", "b1", "--events", "-", "--json"), "both write to stdout"),
        (("--scenario", "b1", "--inject", "block:n1-n7@2"), "no edge n1-n7"),
        (("--scenario", "b1", "--inject", "leave:c9@2"), "unknown customer c9\n  hint: known: c1"),
        (("--scenario", "b2", "--inject", "leave:c11@2"), "did you mean c1?"),
        (("--scenario", "b1", "--inject", "leave:table1@2"), "table1 is a table; name a guest"),
        (("--scenario", "b2", "--inject", "leave:table1@2"), "name who sits there: c1"),
        (("--layout", "report", "--inject", "leave:c1@2"), "nobody is inside, and nobody comes in"),
        (("--scenario", "b1", "--record", "film.avi"), "what kind of recording"),
        (("--scenario", "b1", "--record", "nowhere/at/all.mp4"), "no folder"),
        (("--scenario", "b1", "--record", "a.mp4", "--size", "12"), "is no size"),
        (("--scenario", "b1", "--record", "a.mp4", "--size", "9x9"), "from 160"),
        (("--scenario", "b1", "--size", "9x9"), "from 160"),
        (("--scenario", "b1", "--record", "a.html", "--record", "./a.html"), "written twice"),
        (("--scenario", "b1", "-o", "fr", "-o", "fr/"), "fr/ is to be written twice"),
        (("--scenario", "b1", "-o", "a.html", "--events", "a.html"), "a recording already"),
        (("--scenario", "b1", "-o", "a.html", "-o", "nowhere/b.html"), "no folder"),
        (("--scenario", "b1", "--inject", "slip:0.1", "--inject", "slip:0.2"), "a second one"),
        (("--scenario", "b1", "--plan", "missing.json"), "missing.json"),
        (("--scenario", "b1", "--speed", "0"), "speed"),
        (("--layout", "report", "--plan", "x.json", "--enter", "2"), "its own situation"),
    ],
)
def test_wrong_input_is_exit_2(
    arguments: tuple[str, ...], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    ran = simulate(*arguments)
    assert ran.code == 2
    assert said in (ran.err + ran.out)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ("--size 640x360", "waiter: --size has no effect without --record\n"),
        ("--view 2d --fps 3", "waiter: --view, --fps have no effect without --record\n"),
        ("--record a.html --fps 3 --quality full", "waiter: --quality has no effect on a page\n"),
        ("--record a.png --fps 3 --view 2d", "waiter: --fps has no effect on a still\n"),
        (
            "--record a --size 160x160 --view 2d --fps 1",
            "waiter: --record a is a folder of numbered frames; "
            "for a film give it an ending: a.mp4\n",
        ),
        ("--record a/ --size 160x160 --view 2d --fps 1", ""),
        (
            "--record a/ --size 161x163 --view 2d --fps 1",
            "waiter: --size 161x163 is rounded to 160x162: films have even sizes\n",
        ),
        ("--record a.html --size 161x163", "waiter: --size has no effect on a page\n"),
        ("--record a.html --fps 60", "waiter: --fps 60.0 is 30 on a page\n"),
        (
            "--record a.html --record b.png --fps 3 --size 160x160 --view 2d",
            "",
        ),
        ("--record a.png --size 160x160 --view 2d", ""),
    ],
)
def test_notes_on_what_is_recorded(
    arguments: str, said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("PIL")
    monkeypatch.chdir(tmp_path)
    ran = simulate("--scenario", "b3", *arguments.split())
    assert (ran.code, ran.err) == (0, said)


def test_whoever_leaves_may_come_in_before(tmp_path: Path) -> None:
    """By an event or by another injection; anybody else is a fault, at his place."""
    injected = ("--inject", "enter:2@1", "--inject", "leave:c3@60")
    ran = simulate("--scenario", "b1", *injected, "--events", "-")
    left = [json.loads(line) for line in ran.out.splitlines() if '"type":"left"' in line]
    assert [event["party"] for event in left] == [["c2", "c3"]]
    assert simulate("--scenario", "b1", "--inject", "enter:2@1", "--inject", "leave:c4@9").code == 2
    file = tmp_path / "evening.yaml"
    file.write_text(
        "layout: report\nevents:\n  - {time: 2, enter: [ada]}\n  - {time: 40, leave: [ada]}\n"
        "  - {time: 50, leave: [c1]}\n"
    )
    ran = simulate("--scenario", str(file))
    assert (ran.code, ran.out) == (2, "")
    shown = "    5 |   - {time: 50, leave: [c1]}\n      |                        ^\n"
    assert f"{file}:5:24: error: unknown customer c1\n{shown}  hint: known: ada\n" in ran.err
    file.write_text(file.read_text().replace("[c1]", "[ada]"))
    assert simulate("--scenario", str(file), "--json").json()["status"] == "done"


def test_an_action_and_a_wish_of_ones_own_are_played(tmp_path: Path) -> None:
    """Whatever a domain asks for at its end is not asked for after each step."""
    text = waiter("domain", "show", "--source").out
    text = text.replace(
        "+ give_bill(#agent, #table).", "+ give_bill(#agent, #table) + greet(#agent)."
    )
    text = text.replace("+ wantsbill(#table).", "+ wantsbill(#table) + hasgreeted(#agent).")
    greeting = (
        "possible(greet(agent), I) :- holds(currentlocation(agent, N), I).\n"
        "holds(hasgreeted(agent), I+1) :- occurs(greet(agent), I).\n"
        "missing(I) :- not holds(hasgreeted(agent), I).\n"
    )
    own = tmp_path / "own.sparc"
    own.write_text(text.replace("\ndisplay", f"\n{greeting}\ndisplay"))
    arguments = ("--scenario", "b3", "--domain", str(own))
    ran = simulate(*arguments)
    assert ran.code == 0 and ran.out.startswith("done: b3, 2 actions in ")
    events = simulate(*arguments, "--events", "-").out
    assert events.count('"action_start","robot"') == 2 and "greet(agent)" in events


@pytest.mark.parametrize("place", ["n5", "n7", "table2"])
def test_an_action_of_ones_own_is_done_where_it_is_declared(place: str, tmp_path: Path) -> None:
    """The robot of b3 stands on n6, and turns to a node or a table."""
    own = tmp_path / "own.sparc"
    assert waiter("domain", "new", "greeting", "-o", str(own)).code == 0
    text = own.read_text()
    line = next(line for line in text.splitlines() if line.startswith("%@ greet"))
    own.write_text(text.replace(line, f'%@ greet(agent,T): "greet {{T}}" at {place} for 1 s'))
    goal = ("--goal", "holds: isgreeted(table1)")
    given = ("--scenario", "b3", "--domain", str(own), *goal, "--events", "-")
    events = [json.loads(line) for line in simulate(*given).out.splitlines()]
    (greeted,) = [e for e in events if e["type"] == "action_end" and "greet" in e["action"]]
    layout = read_layout_file("report")
    places = {node.name: node.at for node in layout.nodes}
    places |= {table.name: table.at for table in layout.tables}
    at, here = places[place], greeted["robot"]
    assert at is not None
    assert here["yaw"] == pytest.approx(atan2(at[1] - here["y"], at[0] - here["x"]), abs=0.01)


def test_a_check_that_fails_again_is_told_once(monkeypatch: pytest.MonkeyPatch) -> None:
    from waiter_cli.simulation.world import World

    monkeypatch.setattr(World, "breach", lambda *_: Violation("preconditions", "the door is shut"))
    ran = simulate("--scenario", "b1")
    assert ran.code == 3
    assert ran.out.count("the door is shut") == 1
    assert "at 0.0 s, step 0 (and 7 more times): the door is shut\n" in ran.out
    assert len(simulate("--scenario", "b1", "--json").json()["failed_checks"]) == 8


def test_an_edge_through_a_table_is_wrong_input(tmp_path: Path) -> None:
    file = tmp_path / "narrow.yaml"
    file.write_text(
        "name: narrow\nnodes: {a: [0, 0], b: [4, 0]}\nedges: [[a, b]]\nentrance: a\nagent: a\n"
        "tables: {t: {capacity: 2, nodes: [b], at: [2, 0.3]}}\n"
    )
    ran = simulate("--layout", str(file), "--enter", "1")
    assert ran.code == 2
    assert "the edge a-b runs through t" in ran.err


def test_no_display_is_exit_5(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("pybullet")
    monkeypatch.delenv("DISPLAY", raising=False)
    if not sys.platform.startswith("linux"):
        pytest.skip("a display is always there on this system")
    ran = waiter("simulate", "--scenario", "b3", "--gui")
    assert ran.code == 5
    assert "no display" in ran.err and "xvfb-run" in ran.err


def test_a_missing_encoder_is_exit_5(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    ran = simulate("--scenario", "b3", "--record", str(tmp_path / "a.mp4"))
    assert ran.code == 5
    assert f"hint: {extra_line('record')}\n" in ran.err


# ------------------------------------------------------------ recordings


def film(tmp_path: Path, name: str, *more: str) -> Path:
    pytest.importorskip("PIL")
    out = tmp_path / name
    ran = simulate(
        "--scenario", "b3", "--record", str(out), "--size", "320x180", "--fps", "6", *more
    )
    assert ran.code == 0, ran.err
    assert [p.name for p in tmp_path.iterdir()] == [name.rstrip("/")]
    return out


@pytest.mark.parametrize(
    ("name", "magic"), [("a.mp4", b"ftyp"), ("a.gif", b"GIF89a"), ("a.png", b"PNG")]
)
def test_recordings_from_above(tmp_path: Path, name: str, magic: bytes) -> None:
    pytest.importorskip("imageio_ffmpeg")
    assert magic in film(tmp_path, name, "--view", "2d").read_bytes()[:16]


def test_several_recordings_of_one_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each is what it would be alone, and no picture is drawn twice."""
    pytest.importorskip("PIL")
    from PIL import Image

    from waiter_cli.pictures.film import Film

    monkeypatch.chdir(tmp_path)
    look = ("--scenario", "b3", "--view", "2d", "--size", "320x180", "--fps", "2")
    assert simulate(*look, "--record", "alone.html").code == 0
    drawn = []
    picture = Film._picture
    monkeypatch.setattr(
        Film, "_picture", lambda self, moment: drawn.append(1) or picture(self, moment)
    )
    names = ["a.html", "b.png", "frames/", "c.html"]
    ran = simulate(*look, *(word for name in names for word in ("--record", name)), "--json")
    assert (ran.code, ran.err) == (0, "")
    assert ran.json()["recordings"] == names and ran.json()["recording"] == "a.html"
    assert Path("a.html").read_bytes() == Path("alone.html").read_bytes()
    assert Path("c.html").read_bytes() == Path("alone.html").read_bytes()
    frames = sorted(Path("frames").iterdir())
    still, last = (Image.open(path).tobytes() for path in ("b.png", frames[-1]))
    assert still == last
    assert frames[-1].read_bytes() != frames[0].read_bytes()
    assert len(drawn) == len(frames) - 1  # the last one is shown for a second
    said = simulate(*look, "--record", "a.html", "--record", "b.png").out
    assert "  recorded: a.html\n  recorded: b.png\n" in said


def test_a_folder_of_frames(tmp_path: Path) -> None:
    out = film(tmp_path, "frames/", "--view", "2d")
    frames = sorted(p.name for p in out.iterdir())
    assert frames[0] == "frame_000001.png"
    assert len(frames) == 6 + 17  # a second of the last one
    (out / "mine.txt").write_text("keep me")
    ran = simulate("--scenario", "b3", "--record", str(out))
    assert ran.code == 2 and "mine.txt" in ran.err


@pytest.mark.sim
def test_a_picture_in_perspective_is_the_same_each_time(tmp_path: Path) -> None:
    pytest.importorskip("pybullet")
    pytest.importorskip("PIL")
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
    one = film(tmp_path / "one", "a.png", "--view", "3d", "--quality", "draft").read_bytes()
    assert one == film(tmp_path / "two", "a.png", "--view", "3d", "--quality", "draft").read_bytes()


def test_the_page_asks_for_nothing_from_outside(tmp_path: Path) -> None:
    page = film(tmp_path, "a.html").read_text(encoding="utf-8")
    assert "http" not in page.replace("http-equiv", "")
    assert "src=" not in page and "@import" not in page and "fetch(" not in page
    assert '"type":"bill"' in page


def test_the_page_plays_in_a_browser(tmp_path: Path) -> None:
    browser = next(
        filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None
    )
    if browser is None:
        pytest.skip("no Chromium here: apt-get install chromium")
    page = film(tmp_path, "a.html")
    text = page.read_text(encoding="utf-8")
    probe = """<script>
      const told = [];
      window.onerror = (m) => told.push("error " + m);
      document.getElementById("next").click(); told.push("stepped to " + document.body.dataset.time);
      const scrub = document.getElementById("scrub"); scrub.value = 2; scrub.dispatchEvent(new Event("input"));
      told.push("scrubbed to " + document.body.dataset.time + " " + document.querySelectorAll("li.done").length + " done");
      document.getElementById("back").click(); told.push("back to " + document.body.dataset.time);
      document.getElementById("play").click(); told.push(document.getElementById("play").textContent);
      document.getElementById("play").click(); told.push(document.getElementById("play").textContent);
      document.getElementById("banner").textContent = told.join("; ");
    </script></body>"""
    tested = tmp_path / "tested.html"
    tested.write_text(text.replace("</body>", probe), encoding="utf-8")
    done = subprocess.run(
        [browser, "--headless", "--no-sandbox", "--disable-gpu", "--dump-dom",
         f"--user-data-dir={tmp_path / 'profile'}", tested.as_uri()],
        capture_output=True, text=True, timeout=120, check=False,
    )  # fmt: skip
    assert 'data-ready="yes"' in done.stdout, done.stderr[-500:]
    assert "stepped to 0.000" not in done.stdout
    assert "stepped to 2.2" in done.stdout
    assert "scrubbed to 2.000 0 done" in done.stdout
    assert "back to 0.000" in done.stdout
    assert "Pause; Play" in done.stdout
    assert "error" not in done.stdout.partition('id="banner"')[2].partition("</div>")[0]


@pytest.mark.wide
def test_an_interrupted_recording_leaves_nothing(tmp_path: Path) -> None:
    pytest.importorskip("imageio_ffmpeg")
    pytest.importorskip("PIL")
    import signal
    import time

    out = tmp_path / "a.mp4"
    running = subprocess.Popen(
        [sys.executable, "-m", "waiter_cli", "simulate", "--scenario", "b1", "--record", str(out),
         "--view", "2d", "--backend", "geometric", "--fps", "60"],
        env={**os.environ, "PYTHONPATH": str(ROOT)}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    for _ in range(600):
        if list(tmp_path.iterdir()) or running.poll() is not None:
            break
        time.sleep(0.02)
    running.send_signal(signal.SIGTERM)
    assert running.wait(30) == 143
    assert list(tmp_path.iterdir()) == []


# -- guests who come by chance --------------------------------------------------------------------

EVENING = """\
layout: {layout}
guests:
  arrivals: {{per_hour: 30}}
  sizes: {{1: 1, 2: 1}}
  eat: [3, 6]
  order_after: 1
  cook: [1, 2]
  bill_after: 0
  patience: 6
minutes: 20
"""


def evening(tmp_path: Path, *arguments: str, layout: str = "bistro") -> dict[str, object]:
    path = tmp_path / "evening.yaml"
    path.write_text(EVENING.format(layout=layout))
    ran = simulate("--scenario", str(path), "--json", *arguments)
    assert ran.code == 0, ran.err
    found: dict[str, object] = ran.json()["figures"]
    return found


@pytest.mark.wide
def test_an_evening_is_lived_to_its_end(tmp_path: Path) -> None:
    figures = evening(tmp_path, "--seed", "3")
    assert figures["parties"] == figures["served"] + figures["lost"] > 5  # type: ignore[operator]
    assert figures["wait_bill_p95"] and 0.0 < figures["table_use"] < 1.0  # type: ignore[operator]
    assert evening(tmp_path, "--seed", "3") == figures
    assert evening(tmp_path, "--seed", "4") != figures


@pytest.mark.wide
def test_the_same_guests_come_to_every_layout(tmp_path: Path) -> None:
    came = []
    for layout, speed in (("bistro", "0.8"), ("report_large", "0.8"), ("bistro", "0.5")):
        log = tmp_path / "events.jsonl"
        evening(tmp_path, "--speed", speed, "--events", str(log), layout=layout)
        events = map(json.loads, log.read_text().splitlines())
        seen = [e for e in events if e["type"] == "observed" and e["kind"] == "enter"]
        came.append([(round(e["t"], 1), e["party"]) for e in seen])
    assert len(came[0]) > 5
    assert [len(party) for _, party in came[0]] == [len(party) for _, party in came[1]]
    for (at, _), (elsewhere, _), (slowly, _) in zip(*came, strict=True):
        assert abs(at - elsewhere) < 0.1 and abs(at - slowly) < 0.1


def test_what_an_evening_was_like_is_told(tmp_path: Path) -> None:
    path = tmp_path / "evening.yaml"
    path.write_text(EVENING.format(layout="report").replace("patience: 6", "patience: 1"))
    ran = simulate("--scenario", str(path), "--seed", "1")
    assert ran.code == 0
    assert " served, " in ran.out and " without a table)" in ran.out
    assert "minutes waited, mean (95 %): for a table " in ran.out
    assert all(len(line) <= 120 for line in ran.out.splitlines())
