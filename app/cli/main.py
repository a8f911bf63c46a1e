"""The command line: one name, `hardlanding`, for the service, the solver and the aircraft files."""

import typer

from app.cli.aircraft import aircraft
from app.cli.assess import assess
from app.cli.demo import demo, run
from app.cli.drop_test import drop_test
from app.cli.envelope import envelope
from app.cli.flight_data import flight_data
from app.cli.key import key
from app.cli.migrate import migrate
from app.cli.serve import serve
from app.cli.simulate import simulate
from app.cli.worker import worker

app = typer.Typer(
    name="hardlanding",
    help="Hard-landing monitor: simulate a touchdown, stress the airframe, give a verdict.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)
app.command()(run)
app.command()(serve)
app.command()(worker)
app.command()(migrate)
app.add_typer(key, name="key", help="API keys.")
app.command()(assess)
app.command()(simulate)
app.command()(envelope)
app.command(name="drop-test")(drop_test)
app.command(name="flight-data")(flight_data)
app.add_typer(aircraft, name="aircraft", help="Aircraft folders: build the example, check any.")
app.command()(demo)


def main() -> None:
    """Entry point of the console script."""
    app()


if __name__ == "__main__":
    main()
