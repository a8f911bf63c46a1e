"""The Celery application of the workers."""

from celery import Celery

from app.broker import celery_settings
from app.config import get_settings
from app.observe import configure_logging

settings = get_settings()
configure_logging(settings.log_format)

app = Celery("hardlanding", include=["worker.tasks"])
app.conf.update(celery_settings(settings))

from worker import signals  # noqa: E402, F401 - connects the signals to the application above
