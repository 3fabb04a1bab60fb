"""A gesture unit in forty lines: tells `waiter serve` what it sees, and hears what the robot does.

Run it from anywhere, where waiter is installed: python examples/gesture_client.py [LAYOUT]
"""

import json
import subprocess
import sys

layout = sys.argv[1] if len(sys.argv) > 1 else "report"
command = [sys.executable, "-m", "waiter_cli", "serve", "--layout", layout]
loop = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
hello = loop.stdout.readline()
if not hello:  # it has said why
    sys.exit(loop.wait())
print("connected to", json.loads(hello)["hello"])


def tell(line: dict) -> dict:
    """Sends one line and returns its answer; an error ends the run."""
    print(json.dumps(line), file=loop.stdin, flush=True)
    answer = json.loads(loop.stdout.readline())
    if "error" in answer:
        sys.exit(f"{line}: {answer['error']['message']}")
    return answer


def see(gesture: dict) -> None:
    """Tells what was seen, and of every step of the plan that it was done."""
    answer = tell({"observe": gesture})
    print(f"{gesture}: {answer['horizon']} steps, {answer['latency_ms']} ms")
    for waiting in answer.get("pending", []):
        print("    later:", "; ".join(reason["message"] for reason in waiting["reasons"]))
    while answer["plan"]:  # here the robot would move; this one is always successful
        print("   ", answer["plan"][0]["text"])
        answer = tell({"done": answer["plan"][0]["step"]})


see({"enter": ["c1"]})  # somebody comes in, and later waves for the bill
for table in tell({"ask": "state"})["state"].get("seated", {}):
    see({"bill": table})
print("now:", tell({"ask": "state"})["state"])
loop.stdin.close()
sys.exit(loop.wait())
