"""The message broker: it carries nudges ("there is work"), never a job.

A message may be lost, doubled or late; the row in the database is the job, so each of these is
only a delay.  That is why a folder will do as a broker on one machine.
"""

import threading
from typing import Any

import structlog
from celery import Celery
from kombu.exceptions import KombuError

from app.config import Settings

DRAIN_TASK = "worker.drain"
QUEUE = "nudges"

#: A nudge older than this says nothing new: the sweeper has sent another one by then.
NUDGE_LIFETIME = 60.0  #: [s]

log = structlog.get_logger(__name__)


def celery_settings(settings: Settings) -> dict[str, Any]:
    """Settings that sender and worker share."""
    return {
        "broker_url": settings.celery_broker_url,
        "broker_transport_options": _transport_options(settings),
        "broker_connection_retry_on_startup": True,
        "broker_connection_max_retries": None,
        "result_backend": None,
        "task_ignore_result": True,
        "task_default_queue": QUEUE,
        "task_serializer": "json",
        "accept_content": ["json"],
        "task_acks_late": True,
        # The row's lease redelivers; a job that kills its process must not come back by the broker.
        "task_reject_on_worker_lost": False,
        "task_soft_time_limit": settings.soft_time_limit,
        "task_time_limit": settings.hard_time_limit,
        "worker_prefetch_multiplier": 1,
        "worker_concurrency": settings.worker_concurrency,
        "worker_max_tasks_per_child": 1000,
        "worker_hijack_root_logger": False,
        "worker_enable_remote_control": False,
        "worker_send_task_events": False,
    }


def _transport_options(settings: Settings) -> dict[str, Any]:
    if settings.celery_broker_url.startswith("filesystem:"):
        folders = {name: settings.broker_folder / name for name in ("messages", "control")}
        for folder in folders.values():
            folder.mkdir(parents=True, exist_ok=True)
        return {
            "data_folder_in": str(folders["messages"]),
            "data_folder_out": str(folders["messages"]),
            "control_folder": str(folders["control"]),
            # One message per poll: the default of a second would be felt on every landing.
            "polling_interval": 0.05,
        }
    return {
        "visibility_timeout": 2 * settings.hard_time_limit,
        "unacked_restore_interval": 5,
        "unacked_restore_throttle": 1,
        "socket_connect_timeout": 1,
        "socket_timeout": 5,
        "socket_keepalive": True,
        "health_check_interval": 10,
    }


class Nudger:
    """Tells the workers that there is work; failing to do so is logged and nothing more.

    One thread sends at a time, and whoever comes meanwhile leaves its nudge to that thread: a
    broker that is away costs its time-out once, not once for every landing that comes in.
    """

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self._celery = Celery("nudger", set_as_current=False)
        self._celery.conf.update(celery_settings(settings))
        self._guard = threading.Lock()
        self._wanted = 0
        self._is_sending = False

    def nudge(self, count: int = 1) -> bool:
        """Send nudges; false if the broker did not take them."""
        with self._guard:
            self._wanted = min(self._wanted + count, self._settings.nudge_window)
            if self._is_sending:
                return True
            self._is_sending = True
        while (wanted := self._next()) > 0:
            if not self._send(wanted):
                with self._guard:
                    self._wanted, self._is_sending = 0, False
                return False
        return True

    def _next(self) -> int:
        with self._guard:
            wanted, self._wanted = self._wanted, 0
            self._is_sending = wanted > 0
        return wanted

    def _send(self, count: int) -> bool:
        try:
            _transport_options(self._settings)  # somebody may have cleared the folder away
            for _ in range(count):
                self._celery.send_task(
                    DRAIN_TASK, queue=QUEUE, expires=NUDGE_LIFETIME, retry=False, ignore_result=True
                )
        except (KombuError, OSError, ConnectionError, TimeoutError) as error:
            log.warning("nudge.failed", error=str(error))
            return False
        return True

    def is_reachable(self) -> bool:
        """Whether the broker answers now."""
        try:
            with self._celery.connection_for_write(connect_timeout=1.0) as connection:
                connection.ensure_connection(max_retries=1, timeout=1.0, interval_start=0)
        except (KombuError, OSError, ConnectionError, TimeoutError):
            return False
        return True

    def close(self) -> None:
        self._celery.close()
