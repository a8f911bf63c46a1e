"""`hardlanding run` and `hardlanding demo`: the whole service on one machine, shown at work."""

import json
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import httpx
import typer
from rich.console import Console
from rich.table import Table

from app.cli.progress import STANDARD_ERROR, progress_bars
from app.config import Settings, get_settings

EXAMPLE_AIRCRAFT = "ebj-19"
DEMO_LANDINGS = Path(__file__).resolve().parents[2] / "examples" / "landings"
DEMO_ORDER = ("smooth", "ten-feet-per-second", "rolled-hard", "nose-first")

#: A verdict takes a fraction of a second; the first one waits for the worker to load its model.
PATIENCE = 180.0  #: [s]


def demo(
    url: Annotated[str, typer.Option(help="Address of the service.")] = "http://127.0.0.1:8000",
    api_key: Annotated[str, typer.Option(help="Key with the scopes post and read.")] = "",
) -> None:
    """Post the demo landings to a running service and print their verdicts."""
    post_demo_landings(url, api_key, Console())


def run(
    host: Annotated[str | None, typer.Option(help="Address to listen on.")] = None,
    port: Annotated[int | None, typer.Option(help="Port to listen on.")] = None,
) -> None:
    """Build the example airframe, start API and worker, post the demo landings, stay up."""
    from app.cli.serve import supervise

    given = {"host": host, "port": port}
    settings = get_settings().model_copy(
        update={name: value for name, value in given.items() if value is not None}
    )
    prepare(settings)
    key = _demo_key(settings)
    url = f"http://{settings.host}:{settings.port}"
    log = settings.var / "service.log"

    shown = threading.Event()

    def show() -> None:
        console = Console()
        if not _is_ready(url):
            console.print(f"the service did not answer at {url}", style="red")
            return
        try:
            post_demo_landings(url, key, console)
        finally:
            shown.set()
        console.print(
            f"\nThe service is up: {url}/docs. Look further, for example:\n"
            f"  curl -s -H 'X-API-Key: {key}' {url}/v1/landings\n"
            f"Its log is {log}. Stop it with Ctrl-C.",
            highlight=False,
            soft_wrap=True,
        )

    threading.Thread(target=show, name="demo", daemon=True).start()
    # What takes both cores for minutes begins when the demonstration is over.
    supervise(settings, log, is_calm=shown)


def prepare(settings: Settings) -> None:
    """Write the example aircraft, build its reduced model unless it is kept, and the database."""
    from app.cli.migrate import upgrade
    from solver.aircraft.bizjet import build_bizjet
    from solver.assess import load_assessment_model

    folder = settings.aircraft_folder / EXAMPLE_AIRCRAFT
    with progress_bars() as progress:
        build_bizjet(
            folder, progress=progress
        )  # the same bytes each time, unless the program moved on
        load_assessment_model(folder, settings.cache_folder, progress)
    upgrade(settings)


def _demo_key(settings: Settings) -> str:
    """Key of the demo operator, made once and kept readable only by its owner."""
    from app.cli.key import create_key

    path = settings.var / "demo.key"
    if not path.is_file():
        settings.var.mkdir(parents=True, exist_ok=True)
        path.touch(mode=0o600)
        path.write_text(create_key(settings, operator="demo", scopes=("post", "read", "review")))
    return path.read_text()


def _is_ready(url: str) -> bool:
    return _waited_for(lambda: httpx.get(f"{url}/readyz", timeout=5.0).status_code == 200)


def _waited_for(condition: Callable[[], bool]) -> bool:
    deadline = time.monotonic() + PATIENCE
    while time.monotonic() < deadline:
        try:
            if condition():
                return True
        except httpx.HTTPError:
            pass  # not listening yet
        time.sleep(0.2)
    return False


def post_demo_landings(url: str, api_key: str, console: Console) -> None:
    """Post the demo landings, wait for their verdicts, print them."""
    table = Table(title="Demo landings", title_justify="left")
    for heading in ("landing", "verdict", "action", "used", "load factor", "hottest", "solved in"):
        table.add_column(heading)
    with httpx.Client(base_url=url, headers={"X-API-Key": api_key}, timeout=30.0) as client:
        addresses = {name: _post(client, name) for name in DEMO_ORDER}
        for name, address in addresses.items():
            answer = _finished(client, address)
            result = answer["result"]
            if result is None:
                table.add_row(name, answer["state"], "", "", "", answer["last_error"] or "", "")
                continue
            spots = client.get(f"{address}/hot-spots").raise_for_status().json()["items"]
            hottest = spots[0]
            table.add_row(
                name,
                result["verdict"],
                result["action"],
                f"{result['worst_utilisation']:.0%}",
                f"{result['peak_normal_load_factor']:.2f} g",
                hottest["zone"],
                f"{result['timing']['total'] * 1e3:.0f} ms",
            )
            reasons = (reason["text"] for reason in result["reasons"])
            console.print(f"{name}: {next(reasons)}", markup=False, soft_wrap=True)
    console.print(table)


def _post(client: httpx.Client, name: str) -> str:
    record = json.loads((DEMO_LANDINGS / f"{name}.json").read_text())
    response = client.post("/v1/landings", json=record)
    response.raise_for_status()
    return response.headers["Location"]


def _finished(client: httpx.Client, address: str) -> dict[str, Any]:
    answer: dict[str, Any] = {}

    def is_finished() -> bool:
        answer.update(client.get(address).raise_for_status().json())
        return answer["state"] not in ("queued", "running")

    if not _waited_for(is_finished):
        STANDARD_ERROR.print(f"no verdict from {address} within {PATIENCE:.0f} s")
    return answer
