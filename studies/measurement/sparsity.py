"""Which zeros and ones of a system are left out: those that it states, or that probing finds and the user confirms."""

from __future__ import annotations

from filters.arrays import FloatArray
from filters.problem import checked_structure
from filters.registry import SPARSE_METHODS
from filters.sparse.found import PROBES, contradiction, linear_structure, probed
from filters.sparse.structure import Structure, left_out, shown
from filters.system import System
from filters.systems.scratch import restored
from sched_sim.errors import InputError, option


def with_structure(system: System, x0: FloatArray, said: str, *, confirmed: bool) -> System:
    """The system with its structure: as it states it, as the matrices of a linear one are, or else as probing finds it.

    x0 (n,): a typical state. said: the option that names the system, and its value, for messages. confirmed: the user
    says that what probing finds is so at all states.

    Raises InputError where nothing is stated and nothing confirmed, with what probing has found as lines for the model;
    and where what is stated is not so.
    """
    try:
        stated = checked_structure(system)
        if stated is None and (known := linear_structure(system)) is not None:
            return system._replace(structure=known)
        with restored(system):
            found = probed(system, x0)
    except ValueError as error:
        raise InputError(f"{said}: {error}") from error
    if stated is not None:
        if (wrong := contradiction(stated, found)) is not None:
            raise InputError(
                f"{said}: its structure is not that of the model: {wrong}, as one of {PROBES} states around the "
                f"typical one shows; write * there"
            )
        return system._replace(structure=stated)
    if confirmed:
        return system._replace(structure=found)
    raise InputError(
        f"{said} does not state which entries are always zero or one. At {PROBES} states around the typical one "
        f"{in_words(found)}. If that is so at all states, give {option('confirm_probed')}; or add to the System, and "
        f"to its file `from filters import Structure`:\n\nstructure={shown(found)},"
    )


def refuse_dense(*methods: str) -> None:
    """Raises InputError for methods whose jobs multiply zeros."""
    for method in methods:
        if method not in SPARSE_METHODS:
            raise InputError(
                f"{option('method')} {method} has no sparse jobs: with {option('sparse')} choose from "
                f"{', '.join(SPARSE_METHODS)}"
            )


def in_words(structure: Structure) -> str:
    """What of each matrix is zero, and what one."""
    counts = {name: left_out(pattern) for name, pattern in structure._asdict().items()}
    return ", ".join(
        f"{name} has {zeros} zeros" + (f" and {ones} ones" if ones else "") for name, (zeros, ones) in counts.items()
    )
