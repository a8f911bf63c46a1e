"""A worker that is warm compiles nothing: nobody waits for a kernel."""

import json
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

#: In a process of its own: what other tests compiled does not count.
PROGRAM = """
import json, sys
from pathlib import Path
from numba.core.dispatcher import Dispatcher
from app.fleet.registry import AircraftRegistry
from solver.assessment import TouchdownRecord
from solver.landing.contact import Contact, Lift
from solver.landing.contact_uncertainty import ContactUncertainty
from worker.solve import solve
from worker.warm import Models

def compiled():
    return {
        f"{module.__name__}.{name}": len(found.nopython_signatures)
        for module in list(sys.modules.values())
        if getattr(module, "__name__", "").startswith("solver")
        for name, found in vars(module).items()
        if isinstance(found, Dispatcher)
    }

models = Models(AircraftRegistry(Path(sys.argv[1])), Path(sys.argv[2]))
models.warm_up()
before = compiled()
bounced = (
    Contact(sink_rate=2.0, ground_speed=55.0, pitch=0.02, roll=-0.04, drift=0.03, roll_rate=0.03),
    Contact(sink_rate=1.0, ground_speed=50.0, pitch=-0.02, lift=Lift(model="held")),
)
known = ContactUncertainty.independent(sink_rate=0.3, roll=0.02)
record = TouchdownRecord("mini", bounced, uncertainties=(known, known))
assessment = solve(models.get("mini"), record)
print(json.dumps({
    "verdict": assessment.verdict,
    "samples": assessment.limit_probability.samples,
    "before": sum(before.values()),
    "added": {name: count for name, count in compiled().items() if count != before.get(name)},
}))
"""


def test_an_assessment_after_the_warm_up_compiles_nothing(
    aircraft_folder: Path, cache_folder: Path
) -> None:
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, aircraft_folder, cache_folder],
        cwd=ROOT,
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=True,
    )
    found = json.loads(done.stdout.splitlines()[-1])
    assert found["verdict"] in ("NORMAL", "FIRM", "INSPECT", "HARD")
    assert found["samples"] > 0
    assert found["before"] > 20
    assert found["added"] == {}
