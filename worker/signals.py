"""What happens around the pool: warm models before the fork, clean connections after it."""

import os
import signal
import threading
import time
from typing import Any

import structlog
from billiard.pool import RUN
from billiard.pool import Pool as BlockingPool
from celery.signals import setup_logging, worker_init, worker_process_init, worker_ready

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


@worker_ready.connect
def watch_pool(sender: Any, **_: Any) -> None:
    """On a broker without an event loop the children take tasks from one queue under one lock.

    Whoever is killed while it holds that lock takes it to the grave, and no other child would ever
    get a task again.  Nobody can tell from outside, so the worker ends and is started anew, as soon
    as the other children have finished what they are at.  (With an event loop each child has a pipe
    of its own, and the pool replaces it.)
    """
    pool = sender.pool._pool
    if type(pool) is not BlockingPool:  # the pool with an event loop is a subclass
        return

    def end_if_killed(child: Any) -> None:
        if pool._state == RUN and child.exitcode is not None and child.exitcode < 0:
            log.error("worker.child_killed", pid=child.pid, signal=-child.exitcode)
            os.kill(os.getpid(), signal.SIGTERM)  # takes no further nudges
            threading.Thread(target=_end_when_idle, args=(pool,), daemon=True).start()

    pool.on_process_down = end_if_killed


def _end_when_idle(pool: BlockingPool) -> None:
    """End the worker once no living child has a task, or the tasks have had their time."""
    settings = get_settings()
    deadline = time.monotonic() + settings.drain_budget + settings.soft_time_limit
    while time.monotonic() < deadline:
        living = {child.pid for child in list(pool._pool) if child.exitcode is None}
        jobs = [job for job in list(pool._cache.values()) if not job.ready()]
        if not any(living & set(job.worker_pids()) for job in jobs):
            break
        time.sleep(0.1)
    os._exit(1)


def _end_with_parent(parent: int) -> None:
    """A child whose parent was killed would wait for work for ever."""
    while os.getppid() == parent:
        time.sleep(1.0)
    os._exit(1)
