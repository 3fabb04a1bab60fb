"""A gesture unit in thirty lines: tells `waiter serve` what it sees, and hears what the robot does.

Run it from anywhere: python examples/gesture_client.py [LAYOUT]
"""

import json
import subprocess
import sys

GESTURES = [{"enter": ["c1"]}, {"bill": "table1"}]  # somebody comes in, later waves for the bill
layout = sys.argv[1] if len(sys.argv) > 1 else "report"
command = [sys.executable, "-m", "waiter_cli", "serve", "--layout", layout]
loop = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
print("connected to", json.loads(loop.stdout.readline())["hello"])


def tell(line: dict) -> dict:
    """Sends one line and returns its answer."""
    print(json.dumps(line), file=loop.stdin, flush=True)
    return json.loads(loop.stdout.readline())


for gesture in GESTURES:
    answer = tell({"observe": gesture})
    print(f"{gesture}: {answer['horizon']} steps, {answer['latency_ms']} ms")
    while answer["plan"]:  # here the robot would move; this one is always successful
        print("   ", answer["plan"][0]["text"])
        answer = tell({"done": answer["plan"][0]["step"]})
print("now:", tell({"ask": "state"})["state"])
loop.stdin.close()
sys.exit(loop.wait())
