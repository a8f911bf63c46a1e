"""What happens around the pool: warm models before the fork, clean connections after it."""

import os
import threading
import time
from typing import Any

import structlog
from celery.signals import setup_logging, worker_init, worker_process_init

from app.config import get_settings
from app.db import get_engine
from app.observe import configure_logging
from worker.warm import models

log = structlog.get_logger(__name__)


@setup_logging.connect
def keep_our_logging(**_: Any) -> None:
    """Connected, so that Celery leaves logging alone."""
    configure_logging(get_settings().log_format)


@worker_init.connect
def warm_up(**_: Any) -> None:
    """In the parent, before the children are forked."""
    start = time.perf_counter()
    models(get_settings()).warm_up()
    log.info("worker.warm", seconds=round(time.perf_counter() - start, 2))


@worker_process_init.connect
def begin_child(**_: Any) -> None:
    """In each child: no connection of the parent's may be used here."""
    if get_engine.cache_info().currsize:
        get_engine().dispose(close=False)
    threading.Thread(target=_end_with_parent, args=(os.getppid(),), daemon=True).start()


def _end_with_parent(parent: int) -> None:
    """A child whose parent was killed would wait for work for ever."""
    while os.getppid() == parent:
        time.sleep(1.0)
    os._exit(1)
