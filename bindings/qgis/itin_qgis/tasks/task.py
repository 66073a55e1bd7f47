"""What all tasks have in common."""

from __future__ import annotations

from .parameters import FileOutput, NewStore, Output, Parameter, RasterOutput, Store, Values, VectorOutput

IN_CRS = "IN_CRS"
"""The name under which values have the CRS of places and extents."""

LOAD = "LOAD_RESULTS"
"""The name of the flag that says whether layers of a folder are to be shown."""


class Task:
    """One thing that a planner does: an algorithm in QGIS, and a call of the program.

    Attributes:
        name: In models and scripts, as in `itin:viewshed`.
        title: In the toolbox.
        group: The group of the toolbox that it is in.
        verb: The verb of the command line.
        guide: The page that explains it, in `docs`.
        summary: What it does, for the dialog.
        words: Words that every call has.
        prints: Whether what the program prints is a result of its own.
        parameters: In the order of the dialog.
    """

    name: str
    title: str
    group: str
    verb: str
    guide: str
    summary: str
    words: tuple[str, ...] = ()
    prints: bool = False
    parameters: tuple[Parameter, ...]

    def arguments(self, values: Values) -> list[str]:
        """Returns the arguments of the program for these values. The store goes before what is imported into it."""
        call = [self.verb]
        for parameter in sorted(self.parameters, key=lambda p: not isinstance(p, (Store, NewStore))):
            if (value := values.get(parameter.name)) is not None:
                call += parameter.words(value, values)
        call += self.words
        if crs := values.get(IN_CRS):
            call.append(f"--in-crs={crs}")
        if self._replaces(values):
            call.append("--overwrite")
        return [*call, *self._implied(call), "--progress=lines"]

    def _implied(self, call: list[str]) -> list[str]:
        """Returns what a call means that does not say otherwise."""
        return []

    def _replaces(self, values: Values) -> bool:
        """Says whether files are written. QGIS has asked whether they may take the place of others."""
        kinds = (RasterOutput, VectorOutput, FileOutput)
        return any(isinstance(p, kinds) and values.get(p.name) is not None for p in self.outputs())

    def outputs(self) -> tuple[Output, ...]:
        """Returns the parameters that are results."""
        return tuple(p for p in self.parameters if isinstance(p, Output))
