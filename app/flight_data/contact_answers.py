"""A contact of a window as it is answered: its state, and what the response to it says."""

from pydantic import BaseModel, Field

from solver.assimilation.assimilate import ContactUpdate
from solver.flight_data.reconstruction import FoundContact


class ComparedPeak(BaseModel):
    """Largest normal acceleration after the contact."""

    recorded_g: float
    simulated_prior_g: float = Field(
        description="Simulated from the state before the update, filtered and sampled as recorded."
    )
    simulated_posterior_g: float = Field(description="From the state after it.")
    rate_hz: float


class ChannelMisfit(BaseModel):
    """Root mean square of a channel's residuals over their standard deviation."""

    parameter: str
    samples: int
    prior: float
    posterior: float


class EstimatedParameter(BaseModel):
    """One parameter before and after the response was looked at."""

    name: str
    unit: str = Field(description="ln: natural logarithm of a factor on the aircraft's own value.")
    prior: float
    prior_sd: float
    posterior: float
    posterior_sd: float
    pull: float = Field(
        description="How far it moved over the scatter that such a move has by chance."
    )


class ResponseCompared(BaseModel):
    """The check of simulated against recorded response."""

    is_explained: bool = Field(
        description="Whether the stated uncertainties can explain what was recorded; if not, the "
        "verdict is UNDETERMINED and the state is that from before the update."
    )
    summary: str
    peak: ComparedPeak
    chi_square: float
    samples: int
    effective_parameters: float = Field(description="How many samples the update took up.")
    probability: float = Field(description="Of a misfit as large, if the uncertainties hold.")
    channels: list[ChannelMisfit]
    parameters: list[EstimatedParameter]


class ContactFound(BaseModel):
    """One ground contact of the window."""

    kind: str
    gear: str
    time_s: float = Field(description="On the window's clock.")
    time_sd_s: float
    chance: float = Field(description="That there was such a contact.", ge=0, le=1)
    nose_wheel_down: bool = Field(
        description="Whether the nose wheel was on the ground as the main wheels came back."
    )
    sink_rate_m_s: float = Field(description="Of the centre of gravity, downward; as assessed.")
    sink_rate_sd_m_s: float
    gear_sink_rates_m_s: dict[str, float] = Field(description="From before the contact alone.")
    response: ResponseCompared | None = Field(
        default=None, description="None where nothing could be compared."
    )
    response_unused_because: str | None = Field(
        default=None, description="Why the response did not correct the state."
    )


def contact_found(found: FoundContact, update: ContactUpdate | None) -> ContactFound:
    """Answer a contact; the wheels that follow another contact have no update of their own."""
    state = found.state
    answer = ContactFound(
        kind=found.kind,
        gear=found.gear,
        time_s=found.time,
        time_sd_s=found.time_sd,
        chance=found.chance,
        nose_wheel_down=found.nose_wheel_down,
        sink_rate_m_s=state.sink_rate.value,
        sink_rate_sd_m_s=state.sink_rate.sd,
        gear_sink_rates_m_s={gear: each.value for gear, each in state.gear_sink_rates.items()},
    )
    if update is None:
        answer.response_unused_because = "it belongs to the contact before"
        return answer
    answer.sink_rate_m_s = update.contact.sink_rate
    answer.sink_rate_sd_m_s = float(update.uncertainty.matrix[0, 0] ** 0.5)
    answer.response_unused_because = update.unchanged_because or None
    answer.response = response_compared(update)
    return answer


def response_compared(update: ContactUpdate) -> ResponseCompared | None:
    """Answer the check of a response, None where nothing could be compared."""
    if update.corrected is None:
        return None
    misfit, parameters = update.corrected.misfit, update.corrected.parameters
    peak = misfit.peak
    return ResponseCompared(
        is_explained=misfit.is_explained,
        summary=misfit.text,
        peak=ComparedPeak(
            recorded_g=peak.recorded,
            simulated_prior_g=peak.prior,
            simulated_posterior_g=peak.posterior,
            rate_hz=peak.rate,
        ),
        chi_square=misfit.chi_square,
        samples=misfit.measurements,
        effective_parameters=misfit.effective_parameters,
        probability=misfit.probability,
        channels=[
            ChannelMisfit(
                parameter=channel.parameter,
                samples=channel.samples,
                prior=channel.prior,
                posterior=channel.posterior,
            )
            for channel in misfit.channels
        ],
        parameters=[
            EstimatedParameter(
                name=each.name,
                unit=each.unit,
                prior=each.prior,
                prior_sd=each.prior_sd,
                posterior=each.posterior,
                posterior_sd=each.posterior_sd,
                pull=each.pull,
            )
            for each in parameters
        ],
    )
