"""Records in as a stream of lines: one outcome each, good ones never held up by bad ones."""

import http.client
import json
import socket
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import Any

import httpx2
import pytest
from sqlalchemy import func, select
from sqlalchemy.exc import DataError, IntegrityError, OperationalError

from app.assessments.models import AssessmentJob
from app.audit.models import AuditEntry
from app.cli.key import create_key
from app.db import reading
from app.landings import bulk
from app.landings import service as landings
from app.landings.models import Landing
from app.ndjson import LineCutter
from tests.conftest import Service, Stack
from tests.contract.test_bad_input import BAD_RECORDS
from tests.records import record
from tests.servers import free_port
from tests.worker.programs import programs

NDJSON = {"content-type": "application/x-ndjson"}


def lines(records: Iterable[Any]) -> bytes:
    return b"".join(json.dumps(one).encode() + b"\n" for one in records)


def numbered(count: int) -> list[dict[str, Any]]:
    return [record(1.0 + n % 20, record_id=f"r-{n}") for n in range(count)]


def post(service: Service, content: Any, **headers: str) -> httpx2.Response:
    return service.client.post(
        "/v1/landings/bulk",
        content=content,
        headers={**service.key("alpha", "post"), **NDJSON, **headers},
    )


def answers(response: httpx2.Response) -> tuple[list[dict[str, Any]], dict[str, Any]]:
    """Outcomes of the rows, and the end."""
    assert response.status_code == 200, response.text
    assert response.headers["content-type"] == "application/x-ndjson"
    *rows, end = [json.loads(line) for line in response.text.splitlines()]
    assert end["outcome"] == "end"
    return rows, end


def counts(service: Service) -> tuple[int, int, int]:
    with reading(service.engine) as session:
        found = [
            session.scalar(select(func.count()).select_from(table)) or 0
            for table in (Landing, AssessmentJob)
        ]
        received = select(func.count()).where(AuditEntry.action == "received")
        return found[0], found[1], session.scalar(received) or 0


class TestStream:
    def test_every_record_has_its_outcome_in_order(self, service: Service) -> None:
        rows, end = answers(post(service, lines(numbered(1234))))
        assert [row["line"] for row in rows] == list(range(1, 1235))
        assert {row["outcome"] for row in rows} == {"accepted"}
        assert [row["record_id"] for row in rows] == [f"r-{n}" for n in range(1234)]
        assert end == {
            "outcome": "end", "lines": 1234, "accepted": 1234, "repeated": 0, "refused": 0,
            "failed": 0, "problem": None,
        }  # fmt: skip
        assert counts(service) == (1234, 1234, 1234)

    def test_a_record_is_kept_as_if_it_had_come_alone(self, service: Service) -> None:
        (row,), _ = answers(post(service, lines([record(record_id="r-1")])))
        many, _ = answers(post(service, lines(record(2.0 + n / 100) for n in range(200))))
        alone = service.post(record(2.5)).json()
        assert alone["is_repeated"]
        assert alone["landing_id"] == many[50]["landing_id"]
        landing = service.get(f"/v1/landings/{row['landing_id']}").json()
        other = service.get(f"/v1/landings/{many[50]['landing_id']}").json()
        assert landing["record"] == record(record_id="r-1")
        assert other["record"] == record(2.5)
        assert other["sd_defaulted"] == alone["sd_defaulted"]
        with reading(service.engine) as session:
            entries = session.scalars(
                select(AuditEntry).where(AuditEntry.subject_id == many[50]["landing_id"])
            ).all()
        assert [(entry.action, entry.detail["lane"]) for entry in entries] == [("received", "bulk")]
        assert entries[0].detail["assessment"] == many[50]["assessment_id"]

    def test_it_waits_in_the_bulk_lane_and_is_assessed(self, service: Service) -> None:
        (row,), _ = answers(post(service, lines([record()])))
        place = f"/v1/assessments/{row['assessment_id']}"
        assert service.get(place).json()["lane"] == "bulk"
        service.work()
        assert service.get(place).json()["state"] == "assessed"

    def test_bad_lines_do_not_touch_good_ones(self, service: Service) -> None:
        good = numbered(3)
        content = (
            lines(good[:1]) + b"{not json\n" + lines(good[1:2]) + b"\xff\xfe\n" + b"[1]\n"
            + b"[" * 100_000 + b"\n" + lines(good[2:])
        )  # fmt: skip
        rows, end = answers(post(service, content))
        assert [row["outcome"] for row in rows] == [
            "accepted", "refused", "accepted", "refused", "refused", "refused", "accepted",
        ]  # fmt: skip
        assert (end["accepted"], end["refused"]) == (3, 4)
        for row in rows:
            if row["outcome"] == "refused":
                assert row["problem"]["type"] == "urn:hardlanding:problem:invalid-record"
        assert counts(service) == (3, 3, 3)

    def test_refusals_are_those_of_a_single_record(self, service: Service) -> None:
        bad = [case[1] for case in BAD_RECORDS]
        rows, _ = answers(post(service, lines(bad)))
        headers = {"content-type": "application/json", **service.key("alpha", "post")}
        for row, body in zip(rows, bad, strict=True):
            alone = service.client.post("/v1/landings", content=json.dumps(body), headers=headers)
            assert row["problem"] == alone.json()

    def test_blank_lines_line_ends_and_a_missing_one_do_not_matter(self, service: Service) -> None:
        first, second = (json.dumps(one).encode() for one in numbered(2))
        content = b"\xef\xbb\xbf" + first + b"\r\n\r\n  \n" + second
        rows, end = answers(post(service, content))
        assert [(row["line"], row["outcome"]) for row in rows] == [(1, "accepted"), (4, "accepted")]
        assert end["lines"] == 2

    def test_an_empty_stream_has_an_end(self, service: Service) -> None:
        rows, end = answers(post(service, b""))
        assert (rows, end["lines"]) == ([], 0)

    def test_a_line_as_long_as_no_record_is_refused_alone(self, service: Service) -> None:
        longest = service.settings.max_body_bytes
        content = lines(numbered(1)) + b"x" * (longest + 1) + b"\n" + lines(numbered(2)[1:])
        rows, _ = answers(post(service, content))
        assert [row["outcome"] for row in rows] == ["accepted", "refused", "accepted"]
        assert rows[1]["problem"]["status"] == 413
        assert rows[1]["problem"]["errors"][0]["value"] == longest + 1

    def test_another_type_of_body_is_refused(self, service: Service) -> None:
        for wrong in ("application/xml", "multipart/form-data"):
            response = post(service, b"", **{"content-type": wrong})
            assert response.status_code == 415
            assert "application/x-ndjson" in response.json()["errors"][0]["allowed"]


class TestLimit:
    """A stream has a limit of its own, far above that of a record."""

    @pytest.fixture
    def limited(self, service: Service, monkeypatch: pytest.MonkeyPatch) -> Service:
        settings = service.settings.model_copy(update={"max_bulk_bytes": 20_000})
        context = service.client.app.state.context
        monkeypatch.setattr(
            service.client.app.state, "context", replace(context, settings=settings)
        )
        return service

    def test_what_came_before_it_is_stored(self, limited: Service) -> None:
        body = lines(numbered(100))
        pieces = [body[start : start + 4096] for start in range(0, len(body), 4096)]
        response = post(limited, iter(pieces), **{"transfer-encoding": "chunked"})
        rows, end = answers(response)
        assert end["problem"]["status"] == 413
        assert "20000" in end["problem"]["errors"][0]["allowed"]
        assert counts(limited)[0] == len(rows)

    def test_an_announced_size_beyond_it_is_refused_at_once(self, service: Service) -> None:
        size = str(service.settings.max_bulk_bytes + 1)
        response = post(service, b"", **{"content-length": size})
        assert response.status_code == 413


class TestUpload:
    def test_a_file_is_read_like_a_stream(self, service: Service) -> None:
        files = {"file": ("back-fill.jsonl", lines(numbered(700)), "application/x-ndjson")}
        headers = service.key("alpha", "post")
        response = service.client.post("/v1/landings/bulk", files=files, headers=headers)
        rows, end = answers(response)
        assert [row["line"] for row in rows] == list(range(1, 701))
        assert end["accepted"] == 700
        assert counts(service) == (700, 700, 700)

    def test_several_files_are_read_one_after_the_other(self, service: Service) -> None:
        first, second = numbered(2)
        files = [
            ("file", ("a.jsonl", json.dumps(first).encode())),  # its last line is not ended
            ("file", ("b.jsonl", lines([second]))),
        ]
        headers = service.key("alpha", "post")
        response = service.client.post("/v1/landings/bulk", files=files, headers=headers)
        assert [row["record_id"] for row in answers(response)[0]] == ["r-0", "r-1"]


class TestIdentity:
    def test_the_same_file_again_changes_nothing(self, service: Service) -> None:
        content = lines([*numbered(150), record(3.3)])
        first, _ = answers(post(service, content))
        second, end = answers(post(service, content))
        assert end["repeated"] == 151
        assert [row["landing_id"] for row in first] == [row["landing_id"] for row in second]
        assert counts(service) == (151, 151, 151)

    def test_a_record_twice_in_one_stream_is_one_landing(self, service: Service) -> None:
        rows, _ = answers(post(service, lines([record(record_id="r-1")] * 3)))
        assert [row["outcome"] for row in rows] == ["accepted", "repeated", "repeated"]
        assert len({row["landing_id"] for row in rows}) == 1

    def test_another_content_under_a_known_identity_is_a_conflict(self, service: Service) -> None:
        service.post(record(3.0, record_id="r-1"))
        changed = [record(4.0, record_id="r-1"), record(4.0, record_id="r-2"),
                   record(5.0, record_id="r-2")]  # fmt: skip
        rows, _ = answers(post(service, lines(changed)))
        assert [row["outcome"] for row in rows] == ["refused", "accepted", "refused"]
        assert rows[0]["problem"]["status"] == rows[2]["problem"]["status"] == 409
        assert "r-1" in rows[0]["problem"]["detail"]
        assert "landing_id" not in rows[0]

    def test_the_same_file_from_many_sides_is_stored_once(self, service: Service) -> None:
        content = lines(numbered(300))
        service.key("alpha", "post")
        with ThreadPoolExecutor(4) as pool:
            found = [answers(r) for r in pool.map(lambda _: post(service, content), range(4))]
        assert counts(service) == (300, 300, 300)
        assert sum(end["accepted"] for _, end in found) == 300
        assert sum(end["repeated"] for _, end in found) == 900

    def test_operators_do_not_meet(self, service: Service) -> None:
        post(service, lines(numbered(3)))
        rows, _ = answers(post(service, lines(numbered(3)), **service.key("beta", "post")))
        assert {row["outcome"] for row in rows} == {"accepted"}


class TestDatabase:
    """What the database refuses."""

    @pytest.fixture
    def refusing(self, monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
        """Let storing fail, as long as a record is among what is stored."""
        genuine = landings.find_or_store
        tried: list[int] = []

        def arrange(error: type[Exception], times: int = 10**6) -> list[int]:
            def refuse(session: Any, principal: Any, arrived: Any, lane: str) -> Any:
                is_hit = any(arrival.record_id == "r-3" for arrival in arrived)
                if is_hit and len(tried) < times:
                    tried.append(len(arrived))
                    raise error("INSERT", {}, Exception("no"))
                return genuine(session, principal, arrived, lane)

            monkeypatch.setattr(bulk.service, "find_or_store", refuse)
            return tried

        return arrange

    def test_what_cannot_be_stored_stands_alone(self, service: Service, refusing: Any) -> None:
        refusing(DataError)
        rows, end = answers(post(service, lines(numbered(8))))
        assert [row["outcome"] for row in rows] == ["accepted"] * 3 + ["failed"] + ["accepted"] * 4
        assert rows[3]["problem"]["type"] == "urn:hardlanding:problem:not-stored"
        assert (end["accepted"], end["failed"]) == (7, 1)
        assert counts(service) == (7, 7, 7)

    def test_who_was_overtaken_looks_again(self, service: Service, refusing: Any) -> None:
        tried = refusing(IntegrityError, times=1)
        _, end = answers(post(service, lines(numbered(8))))
        assert tried == [8]
        assert end["accepted"] == 8

    def test_its_statistics_follow_what_came_in(
        self, service: Service, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setattr(bulk, "STATISTICS_FROM", 100)
        monkeypatch.setattr(bulk, "CHUNK_ROWS", 50)
        post(service, lines(numbered(250)))
        if service.settings.database_url is not None:
            with service.engine.connect() as connection:
                counted = "SELECT reltuples FROM pg_class WHERE relname = 'landing'"
                assert connection.exec_driver_sql(counted).scalar_one() >= 100

    def test_an_absent_database_fails_rows_that_may_be_sent_again(
        self, service: Service, refusing: Any
    ) -> None:
        refusing(OperationalError, times=1)
        _, end = answers(post(service, lines(numbered(8))))
        assert end["failed"] == 8
        _, end = answers(post(service, lines(numbered(8))))
        assert end["accepted"] == 8


class TestOverTheWire:
    """A real server and senders with habits."""

    @pytest.fixture
    def served(self, stack: Stack, tmp_path: Path) -> Iterator[tuple[int, str]]:
        settings = stack.settings.model_copy(update={"port": free_port(), "auto_migrate": False})
        key = create_key(settings, operator="alpha", scopes=("post",))
        with programs(settings, tmp_path) as running:
            running.start_api()
            yield settings.port, key

    def test_a_sender_may_read_nothing_before_it_has_sent_everything(
        self, served: tuple[int, str]
    ) -> None:
        port, key = served
        # More than the buffers of both ends hold, in either direction.
        content = lines({"colour": "x" * 1000} for _ in range(15_000))
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
        connection.request("POST", "/v1/landings/bulk", content, {"X-API-Key": key, **NDJSON})
        answer = connection.getresponse().read()
        connection.close()
        assert len(content) > 10_000_000
        assert len(answer) > 10_000_000
        assert json.loads(answer.splitlines()[-1])["refused"] == 15_000

    def test_outcomes_come_while_the_sender_still_sends(self, served: tuple[int, str]) -> None:
        port, key = served
        records = numbered(bulk.CHUNK_ROWS + 100)
        first, second = lines(records[:-50]), lines(records[-50:])
        with socket.create_connection(("127.0.0.1", port), timeout=60) as sender:
            head = (
                f"POST /v1/landings/bulk HTTP/1.1\r\nHost: here\r\nX-API-Key: {key}\r\n"
                f"Content-Type: application/x-ndjson\r\nContent-Length: {len(first + second)}\r\n"
                "Expect: 100-continue\r\n\r\n"
            )
            sender.sendall(head.encode())
            stream = sender.makefile("rb")
            assert stream.readline().startswith(b"HTTP/1.1 100")
            sender.sendall(first)
            found = b""
            while f'"r-{bulk.CHUNK_ROWS - 1}"'.encode() not in found:
                found = stream.readline()
            sender.sendall(second)
            while b'"end"' not in found:
                found = stream.readline()
        assert json.loads(found)["accepted"] == bulk.CHUNK_ROWS + 100


class TestLineCutter:
    @pytest.mark.parametrize("size", [1, 2, 3, 7, 100])
    def test_pieces_do_not_matter(self, size: int) -> None:
        text = b"one\n\nthree\r\nfour"
        cutter = LineCutter(longest=10)
        found = []
        for start in range(0, len(text), size):
            found += cutter.feed(text[start : start + size])
        found += cutter.end()
        assert [(line.number, line.text) for line in found] == [
            (1, b"one"), (2, b""), (3, b"three\r"), (4, b"four"),
        ]  # fmt: skip

    def test_no_more_than_a_line_is_held(self) -> None:
        cutter = LineCutter(longest=10)
        for _ in range(1000):
            assert list(cutter.feed(b"x" * 7)) == []
            assert sum(map(len, cutter._parts)) <= 10
        (line,) = cutter.feed(b"\n")
        assert (line.text, line.size) == (None, 7000)
