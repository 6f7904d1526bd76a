"""The connection to a Dask scheduler that is there already, and whether all of it has what this process has."""

from __future__ import annotations

import asyncio
import logging
import pickle
import re
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from sched_sim.errors import InputError, option
from studies.sweep.cluster import lost, workers_of
from studies.sweep.dispatch import Compute
from studies.sweep.versions import REMEDY, refusal, versions

if TYPE_CHECKING:
    import distributed

    from studies.sweep.run import Sweep

ANSWER_S = 4.0
"""How long a scheduler may take to answer, and then its first worker to be there."""

ADDRESS = re.compile(r"(?P<protocol>(?:tcp|tls)://)?(?:[A-Za-z0-9._-]+|\[[0-9a-fA-F:.%]+\]):(?P<port>[0-9]{1,5})")


@contextmanager
def cluster(address: str, sweep: Sweep) -> Iterator[Compute]:
    """The workers of the scheduler at `address`, tcp://HOST:PORT or tls://HOST:PORT, which have what this process has.

    No process is started, and nothing listens here. TLS is set up by Dask's own configuration.
    Raises InputError where the package distributed is missing, for an address that is none, where no scheduler or no
    worker answers, and where one has other versions.
    """
    address = _checked(address)
    if find_spec("distributed") is None:
        raise InputError(f'{option("dask")} needs the package distributed: pip install "sched-sim[cluster]"')
    where = f"{option('dask')} {address}"
    try:
        from distributed.utils import silence_logging_cmgr
    except ValueError as error:  # Dask reads its configuration
        raise InputError(f"{where}: {str(error).partition(chr(10))[0]}") from None
    with silence_logging_cmgr(logging.CRITICAL + 1):
        client = _connected(address, where)
        try:
            _compare(client, sweep, where)
            yield workers_of(client, where)
        finally:
            client.close()


def _checked(address: str) -> str:
    """With its protocol."""
    found = ADDRESS.fullmatch(address)
    if not found or not 0 < int(found["port"]) < 65536:
        raise InputError(
            f"{option('dask')} {address!r} is no address of a scheduler: give tcp://HOST:PORT or tls://HOST:PORT, as "
            f"`dask scheduler` prints it"
        )
    return address if found["protocol"] else f"tcp://{address}"


def _connected(address: str, where: str) -> distributed.Client:
    from distributed import Client

    try:
        kind = asyncio.run(asyncio.wait_for(_kind(address, where), ANSWER_S))
        if kind in ("Worker", "Nanny"):
            raise InputError(f"{where}: that is a {kind.lower()}: give the address of its scheduler")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of versions, which are compared here
            return Client(address, timeout=ANSWER_S, set_as_default=False)
    except OSError as error:
        raise InputError(
            f"{where}: no scheduler answers ({str(error) or f'nothing for {ANSWER_S:g} s'}): correct the address, or "
            f"start one with `dask scheduler`"
        ) from None


async def _kind(address: str, where: str) -> str:
    """What of Dask listens there. A client that finds nothing there, or not a scheduler, would be long in ending."""
    from distributed.comm import connect
    from distributed.security import Security

    try:
        security = Security().get_connection_args("client")
    except OSError as error:  # ssl.SSLError is one
        raise InputError(
            f"{where}: the keys for TLS cannot be read ({error}): correct distributed.comm.tls in Dask's configuration"
        ) from None
    if address.startswith("tls") and security["ssl_context"] is None:
        raise InputError(
            f"{where}: there are no keys for TLS: name their files in Dask's configuration, under distributed.comm.tls"
        )
    try:
        comm = await connect(address, ANSWER_S, **security)
        try:
            await comm.write({"op": "identity", "reply": True})
            return str((await comm.read())["type"])
        finally:
            await comm.close()
    except OSError:
        raise
    except Exception:  # Dask takes whatever it reads for lengths and messages of its own
        raise InputError(
            f"{where}: what listens there is not of Dask: give the address that `dask scheduler` prints"
        ) from None


def _compare(client: distributed.Client, sweep: Sweep, where: str) -> None:
    """Raises InputError where the scheduler or a worker is not as this process is."""
    try:
        client.wait_for_workers(1, ANSWER_S)
        answers = _answers(client, pickle.dumps(sweep), versions())
    except TimeoutError:
        raise InputError(f"{where}: the scheduler has no worker: start some with `dask worker`") from None
    except OSError:
        raise lost(where) from None
    for name, answer in answers.items():
        if isinstance(answer, OSError):  # it has just gone
            continue
        theirs, digest = (answer, "") if isinstance(answer, Exception) else answer
        if found := refusal(theirs, versions()):
            raise InputError(f"{where}: {name} {found}")
        if digest != sweep.digest:
            raise InputError(f"{where}: {name} makes another grid of the same sweep: {REMEDY}")


def _answers(client: distributed.Client, *asked: object) -> dict[str, Any]:
    """What the scheduler and each worker answer to `_greeting`, or the exception that it raised."""
    try:
        answers = {"its scheduler": client.run_on_scheduler(_greeting, *asked)}
    except (ImportError, AttributeError) as error:
        answers = {"its scheduler": error}
    workers = client.run(_greeting, *asked, on_error="return")
    return answers | {f"worker {name}": answer for name, answer in workers.items()}


def _greeting(sweep: bytes, expected: Mapping[str, str]) -> tuple[Mapping[str, str], str]:
    """In a worker: its versions and, if they are the expected ones, the digest of the sweep as it understands it."""
    return versions(), pickle.loads(sweep).digest if versions() == expected else ""
