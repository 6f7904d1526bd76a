"""Measurements that are taken and not there yet, each with what is carried of it from step to step.

The covariance does not wait for them: P counts a measurement from the step k on in which it is taken. With zeta its
innovation, of covariance S, and B = K_k zeta's share of the state, the estimate that P is of is x + sum of B zeta over
what is in flight. The zeta are independent of each other and of that estimate's error, so that the error of x itself
has the covariance P + sum of B S B^T.

    taken at k     B = K_k; of each g in flight T_kg = H_k B_g: y_k - h(x_k) is zeta_k + sum of T_kg zeta_g
    each step      B <- F B
    corrected at once by another sensor      B <- (I - K H) B
    f lands        zeta = y_f - h(x_f) - what has become known of T_fg zeta_g;  x <- x + B_f zeta
                   u in flight, taken before f: B_u <- B_u - B_f T_fu
                   g in flight, taken after f: T_gf zeta is known, and T_gu <- T_gu - T_gf T_fu

The tables hold what is in flight only: what has landed is eliminated from them at once.

Instead of B (n, p) a product M (n, n) of transitions can be carried, with B = M K_k: Larsen's. Below A is what is
carried, B or M, and what multiplies it is v = zeta, or K_k zeta.

Lost. What is lost of a measurement is known when the rest of it lands. zeta is then what is expected of it, given the
rest, and has an error, of covariance E. Of B this error has become part of that of x, and in the tables of what was
taken later: these are made independent of it and of each other again, in the order in which they were taken, by what
they say about it. Of products only P <- P + B E B^T is done, exact where nothing that was taken later is in flight.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import Flags, FloatArray
from filters.kernels.dense import copy, copy_vector, matmul_blocked, matvec, mirror, transpose
from filters.kernels.place import IntArray, clear
from filters.kernels.solve import cholesky, solve_cholesky
from filters.modular.space import Space, minus, plus
from filters.modular.workspace import Workspace
from filters.records import Estimate


class Scratch(NamedTuple):
    """n: length of the state's error; p: of the longest measurement's; w: p, or n where products are carried.

    H, gain, S, expected: of the last corrector, as in `workspace`, filled up like those in flight.
    """

    H: FloatArray  # (p, n)
    gain: FloatArray
    S: FloatArray  # (p, p)
    expected: FloatArray  # (numbers,)
    zeta: FloatArray  # (p,)
    v: FloatArray  # (w,)
    error: FloatArray  # (n,)
    pw: FloatArray  # (p, w)
    pp1: FloatArray
    pp2: FloatArray
    pp3: FloatArray
    E: FloatArray  # (p, p), of a loss
    ww: FloatArray  # (w, w)
    nw: FloatArray  # (n, w)
    np1: FloatArray  # (n, p)
    np2: FloatArray
    pn: FloatArray  # (p, n)


class InFlight(NamedTuple):
    """A place for each measurement that may be in flight; what belongs to shorter ones is filled up with zeros.

    line (places,): the places in use, in the order in which their measurements were taken; waiting (1,): how many.
    A (places, n, w): what is carried. K (places or 0, n, p): the gains, where products are carried.
    S (places, p, p): of the innovations, filled up with ones on the diagonal.
    expected (places, numbers): h(x_k). known (places, p): what is known to be in y - h(x_k) besides zeta.
    T (places, places, p, w): T[g, f] v of f is in y - h(x_k) of g besides, f taken before.
    rest (places, p, p): of a loss.
    """

    line: IntArray
    waiting: IntArray
    A: FloatArray
    K: FloatArray
    S: FloatArray
    expected: FloatArray
    known: FloatArray
    T: FloatArray
    rest: FloatArray
    scratch: Scratch


def new_in_flight(places: int, of: Space, observed: list[Space], *, products: bool) -> InFlight:
    """Memory for so many measurements of these spaces, none in flight. products: what is carried is M."""
    n = of.errors
    p = max((each.errors for each in observed), default=1)
    numbers = max((each.numbers for each in observed), default=1)
    w = n if products else p
    scratch = Scratch(
        H=np.zeros((p, n)),
        gain=np.zeros((p, n)),
        S=np.zeros((p, p)),
        expected=np.zeros(numbers),
        zeta=np.zeros(p),
        v=np.zeros(w),
        error=np.zeros(n),
        pw=np.zeros((p, w)),
        pp1=np.zeros((p, p)),
        pp2=np.zeros((p, p)),
        pp3=np.zeros((p, p)),
        E=np.zeros((p, p)),
        ww=np.zeros((w, w)),
        nw=np.zeros((n, w)),
        np1=np.zeros((n, p)),
        np2=np.zeros((n, p)),
        pn=np.zeros((p, n)),
    )
    return InFlight(
        line=np.zeros(places, np.int64),
        waiting=np.zeros(1, np.int64),
        A=np.zeros((places, n, w)),
        K=np.zeros((places if products else 0, n, p)),
        S=np.zeros((places, p, p)),
        expected=np.zeros((places, numbers)),
        known=np.zeros((places, p)),
        T=np.zeros((places, places, p, w)),
        rest=np.zeros((places, p, p)),
        scratch=scratch,
    )


def carry(A: FloatArray, work: Workspace, scratch: FloatArray) -> None:
    """A <- F A, once a prediction has left F in work; scratch is like A."""
    matmul_blocked(work.F, A, scratch)
    copy(scratch, A)


def carry_all(flights: InFlight, work: Workspace) -> None:
    """What is carried, a step on."""
    for i in range(flights.waiting[0]):
        carry(flights.A[flights.line[i]], work, flights.scratch.nw)


def note(work: Workspace, scratch: Scratch) -> None:
    """What a corrector has left in work."""
    clear(scratch.H)
    clear(scratch.gain)
    clear(scratch.S)
    for r in range(scratch.S.shape[0]):
        scratch.S[r, r] = 1.0
    copy(work.H, scratch.H)
    copy(work.gain, scratch.gain)
    copy(work.S, scratch.S)
    copy_vector(work.expected, scratch.expected)


def innovate(observed: Space, y: FloatArray, expected: FloatArray, work: Workspace, zeta: FloatArray) -> None:
    """zeta = y - what was expected, filled up with zeros."""
    minus(observed, y, expected, work.z)
    for r in range(zeta.shape[0]):
        zeta[r] = work.z[r] if r < work.z.shape[0] else 0.0


def take_in(place: int, flights: InFlight) -> None:
    """A measurement is in flight from now on, once what its corrector has left is noted."""
    scratch, A = flights.scratch, flights.A[place]
    for i in range(flights.waiting[0]):
        g = flights.line[i]
        product(scratch.H, flights.A[g], flights.T[place, g])
    copy(scratch.S, flights.S[place])
    copy_vector(scratch.expected, flights.expected[place])
    for r in range(flights.known.shape[1]):
        flights.known[place, r] = 0.0
    if len(flights.K):
        transpose(scratch.gain, flights.K[place])
        clear(A)
        for e in range(A.shape[0]):
            A[e, e] = 1.0
    else:
        transpose(scratch.gain, A)
    flights.line[flights.waiting[0]] = place
    flights.waiting[0] += 1


def correct_carried(A: FloatArray, H: FloatArray, gain: FloatArray, scratch: FloatArray) -> None:
    """A <- A - K (H A), for gain = K^T and H (p, n); scratch (p, w)."""
    product(H, A, scratch)
    for r in range(gain.shape[0]):
        for i in range(A.shape[0]):
            factor = gain[r, i]
            for j in range(A.shape[1]):
                A[i, j] -= factor * scratch[r, j]


def correct_all(flights: InFlight) -> None:
    """What is carried, corrected by a measurement that did not wait, once what its corrector has left is noted."""
    scratch = flights.scratch
    for i in range(flights.waiting[0]):
        correct_carried(flights.A[flights.line[i]], scratch.H, scratch.gain, scratch.pw)


def land(place: int, flights: InFlight, lost: Flags, of: Space, before: Estimate, after: Estimate) -> None:
    """`after` is `before`, corrected by the measurement of this place, which is free then.

    scratch.zeta holds the measurement less what was expected. lost (p,): what it has no number of.
    """
    zeta = flights.scratch.zeta
    at = 0
    while flights.line[at] != place:
        at += 1
    gone = False
    for r in range(zeta.shape[0]):
        zeta[r] -= flights.known[place, r]
        gone = gone or lost[r]
    if gone:
        give_up(place, at, lost, flights)
    move(flights.A[place], flights, place, of, before.x, after.x)
    compensate(place, at, flights)
    copy(before.P, after.P)
    if gone:
        lose(place, at, flights, after.P)
    for i in range(at, flights.waiting[0] - 1):
        flights.line[i] = flights.line[i + 1]
    flights.waiting[0] -= 1


def move(A: FloatArray, flights: InFlight, place: int, of: Space, x: FloatArray, out: FloatArray) -> None:
    """out = x + A v."""
    scratch = flights.scratch
    if len(flights.K):
        matvec(flights.K[place], scratch.zeta, scratch.v)
    else:
        copy_vector(scratch.zeta, scratch.v)
    matvec(A, scratch.v, scratch.error)
    plus(of, x, scratch.error, out)


def compensate(place: int, at: int, flights: InFlight) -> None:
    """The measurement of this place, the at-th in line, has landed with v: it goes from the tables of the others."""
    scratch, T = flights.scratch, flights.T
    for j in range(at + 1, flights.waiting[0]):
        g = flights.line[j]
        for r in range(T.shape[2]):
            for c in range(T.shape[3]):
                flights.known[g, r] += T[g, place, r, c] * scratch.v[c]
    for i in range(at):
        u = flights.line[i]
        if len(flights.K):
            product(flights.K[place], T[place, u], scratch.ww)
        else:
            copy(T[place, u], scratch.ww)
        subtract_product(flights.A[place], scratch.ww, flights.A[u])
        for j in range(at + 1, flights.waiting[0]):
            g = flights.line[j]
            subtract_product(T[g, place], scratch.ww, T[g, u])


def give_up(place: int, at: int, lost: Flags, flights: InFlight) -> None:
    """zeta and the table become what is expected, given the rows that are not lost; scratch.E: of its error."""
    scratch, S = flights.scratch, flights.S[place]
    p = S.shape[0]
    copy(S, scratch.pp1)
    copy(S, scratch.pp2)
    for r in range(p):
        if lost[r]:
            scratch.zeta[r] = 0.0
            for column in range(p):
                scratch.pp1[r, column] = scratch.pp1[column, r] = scratch.pp2[r, column] = 0.0
            scratch.pp1[r, r] = 1.0
    cholesky(scratch.pp1, scratch.pp3)
    solve_cholesky(scratch.pp3, scratch.pp2, scratch.pp2)
    transpose(scratch.pp2, scratch.pp1)  # the share of each row in what is expected of each; none of those lost
    copy(S, scratch.E)
    subtract_product(scratch.pp1, S, scratch.E)
    for r in range(p):
        if not lost[r]:
            for column in range(p):
                scratch.E[r, column] = scratch.E[column, r] = 0.0
    mirror(scratch.E)
    for r in range(p):
        total = 0.0
        for column in range(p):
            total += scratch.pp1[r, column] * scratch.zeta[column]
        scratch.pp2[0, r] = total
    copy_vector(scratch.pp2[0], scratch.zeta)
    for i in range(at):
        T = flights.T[place, flights.line[i]]
        product(scratch.pp1, T, scratch.pw)
        copy(scratch.pw, T)


def lose(place: int, at: int, flights: InFlight, P: FloatArray) -> None:
    """P and what was taken later and is in flight, once an error of covariance scratch.E in zeta cannot be known."""
    scratch = flights.scratch
    gain_of(place, flights, scratch.np1)
    if not len(flights.K):
        for j in range(at + 1, flights.waiting[0]):
            copy(flights.T[flights.line[j], place], flights.rest[flights.line[j]])
        for j in range(at + 1, flights.waiting[0]):
            _tell_of_loss(j, flights)
    add_spread(scratch.np1, scratch.E, P, scratch)


def _tell_of_loss(j: int, flights: InFlight) -> None:
    """The j-th in line tells of the error: it is made independent of it.

    What has it is scratch.np1, of the state, and `rest`, of those that follow: less what this one has of it.
    """
    scratch, E = flights.scratch, flights.scratch.E
    h = flights.line[j]
    c, B, S = flights.rest[h], flights.A[h], flights.S[h]
    subtract_product(B, c, scratch.np1)
    for i in range(j + 1, flights.waiting[0]):
        g = flights.line[i]
        subtract_product(flights.T[g, h], c, flights.rest[g])
    product(c, E, scratch.pp1)
    transpose(c, scratch.pp2)
    add_product(scratch.pp1, scratch.pp2, S)
    mirror(S)
    cholesky(S, scratch.pp3)
    solve_cholesky(scratch.pp3, scratch.pp1, scratch.pp2)
    transpose(scratch.pp2, scratch.pp3)  # E c^T S^-1
    subtract_product(scratch.pp3, scratch.pp1, E)
    mirror(E)
    add_product(scratch.np1, scratch.pp3, B)
    for i in range(j + 1, flights.waiting[0]):
        g = flights.line[i]
        add_product(flights.rest[g], scratch.pp3, flights.T[g, h])


def gain_of(place: int, flights: InFlight, out: FloatArray) -> None:
    """out (n, p) = B."""
    if len(flights.K):
        product(flights.A[place], flights.K[place], out)
    else:
        copy(flights.A[place], out)


def add_spread(B: FloatArray, S: FloatArray, P: FloatArray, scratch: Scratch) -> None:
    """P += B S B^T."""
    product(B, S, scratch.np2)
    transpose(B, scratch.pn)
    add_product(scratch.np2, scratch.pn, P)
    mirror(P)


def add_what_is_in_flight(flights: InFlight, P: FloatArray) -> None:
    """P + sum of B S B^T, the covariance of the error of the estimate, in place of P."""
    for i in range(flights.waiting[0]):
        place = flights.line[i]
        gain_of(place, flights, flights.scratch.np1)
        add_spread(flights.scratch.np1, flights.S[place], P, flights.scratch)


def product(A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    """out = A B. A few rows or columns: a short loop, which is soon compiled."""
    clear(out)
    add_product(A, B, out)


def add_product(A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    """out += A B."""
    for i in range(A.shape[0]):
        for k in range(A.shape[1]):
            for j in range(B.shape[1]):
                out[i, j] += A[i, k] * B[k, j]


def subtract_product(A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    """out -= A B."""
    for i in range(A.shape[0]):
        for k in range(A.shape[1]):
            for j in range(B.shape[1]):
                out[i, j] -= A[i, k] * B[k, j]
