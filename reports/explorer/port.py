"""The port at which the explorer listens, on this machine alone."""

from __future__ import annotations

import errno
import socket

from sched_sim.errors import InputError

HOST = "127.0.0.1"
USUAL = 8400
TRIED = 100
"""Ports from the usual one on, where that is in use and no other was asked for."""


def listening(port: int | None) -> socket.socket:
    """A socket that listens at `port`; None: the usual one or the next that is free, 0: any. Raises InputError where
    that cannot be."""
    if port is not None:
        return _bound(port)
    for near in range(USUAL, USUAL + TRIED):
        try:
            return _bound(near)
        except InputError:
            continue
    return _bound(0)


def _bound(port: int) -> socket.socket:
    there = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    try:
        there.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        there.bind((HOST, port))
        there.listen()
    except OSError as error:
        there.close()
        raise InputError(f"--port {port}: {_why(error)}") from None
    return there


def _why(error: OSError) -> str:
    match error.errno:
        case errno.EADDRINUSE:
            return "something else listens there, perhaps another `sched-sim explore`: end that, or leave --port out"
        case errno.EACCES:
            return "it is kept for the system: give one from 1024 on, or leave --port out"
    return f"{error.strerror}: give another, or leave --port out"
