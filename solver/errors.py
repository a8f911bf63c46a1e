"""What can go wrong inside the solver.  Every message carries the numbers that explain it."""


class SolverError(Exception):
    """Base of all errors the solver raises on purpose."""


class ModelError(SolverError):
    """The aircraft definition or the structural model cannot be used; says where and why."""


class RecordError(SolverError):
    """A touchdown record asks for something outside the model; names field, value and range."""


class SimulationDivergedError(SolverError):
    """The landing simulation left the finite numbers or its energy account does not close."""


class EquilibriumError(SolverError):
    """The loads put on the airframe do not balance the prescribed rigid-body motion."""


class StrutBottomedError(SolverError):
    """A drop test uses up the strut's gas volume, where its equations end."""


class FlightDataError(SolverError):
    """A recorder window cannot be read; says where, what was found and what is allowed."""

    def __init__(self, where: str, found: str, allowed: str) -> None:
        super().__init__(f"{where}: {found} (allowed: {allowed})")
        self.where = where
        self.found = found
        self.allowed = allowed
