"""What a store holds, and whether it is sound."""

from __future__ import annotations

from . import shared
from .imports import STORES
from .parameters import Flag
from .task import Task


class Info(Task):
    """What a store holds."""

    name = "info"
    title = "What a store holds"
    group = STORES
    verb = "info"
    prints = True
    guide = "importing.md"
    summary = "Tells the CRS, extent, levels, themes and sources of a store, and its certified error by level."
    parameters = (
        shared.STORE,
        Flag("DIGEST", "Tell the digest of the content", "--digest", help="Every byte is read for it"),
        shared.THREADS,
        shared.FURTHER,
    )


class Check(Task):
    """Whether a store is sound."""

    name = "check"
    title = "Check a store"
    group = STORES
    verb = "check"
    prints = True
    guide = "importing.md"
    summary = (
        "Reads every byte of a store and compares its surfaces with what the store certifies. Fails where it is damaged."
    )
    parameters = (
        shared.STORE,
        Flag("QUICK", "Compare surfaces in a sample only", "--quick", help="Every byte is read in any case"),
        shared.THREADS,
        shared.FURTHER,
    )
