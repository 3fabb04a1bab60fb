"""Plays evenings of several robots by chance: nobody meets, nobody is stuck, nobody is lost.

Two kinds.  ``executive``: generated small restaurants, where robots begin and end what they do in any order,
fail, stop and go on, and guests come and leave; whoever could meet is looked at after every event.
``rooms``: three scenes in the simulated room, with slips, stalls, stops (some for good) and blocked paths,
each played twice to the same events.  An evening that breaks is named by its seed, and makes the exit code 1.

    python benchmarks/bench_evenings.py --seeds 0..2000
    python benchmarks/bench_evenings.py --kind rooms --seeds 0..300 --workers 2
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from tests.support.fleet_evenings import Evening
from tests.support.fleet_rooms import SCENES, calm

TROUBLES = ("done", "failed", "out", "refused")


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--seeds", default="0..10000", help="first..last, the last one not played")
    parser.add_argument("--kind", choices=("executive", "rooms"), default="executive")
    parser.add_argument("--workers", type=int, default=1)
    given = parser.parse_args()
    first, last = map(int, given.seeds.split(".."))
    found: Counter[str] = Counter()
    began = time.monotonic()
    with ProcessPoolExecutor(given.workers) as pool:
        evening = partial(one_evening, given.kind)
        for seed, counts in zip(
            range(first, last), pool.map(evening, range(first, last), chunksize=20)
        ):
            found.update(counts)
            if counts["broken"]:
                print(f"seed {seed} broke: {next(iter(counts - Counter(broken=1)))}", flush=True)
    print(f"{last - first} seeds of {given.kind} in {time.monotonic() - began:.0f} s")
    for what, number in sorted(found.items()):
        if ":" not in what:
            print(f"  {what}: {number}")
    return 1 if found["broken"] else 0


def one_evening(kind: str, seed: int) -> Counter[str]:
    """Returns how the evenings of a seed ended, and what befell robots in them."""
    try:
        if kind == "rooms":
            return Counter(calm(layout, scenario, seed) for layout, scenario in SCENES)
        evening = Evening(seed)
        ended = evening.play()
    except Exception as fault:  # a report, not an end: the other seeds are played
        return Counter({"broken": 1, f"{type(fault).__name__}: {fault}": 1})
    troubles = {f"actions {name}": getattr(evening.counts, name) for name in TROUBLES}
    return Counter({ended: 1, **troubles})


if __name__ == "__main__":
    sys.exit(main())
