"""What a task asks for, without QGIS: each parameter knows which words of the command line its value becomes.

A value is None where none is given. The values of the other parameters come with it, for some words are made of two.
"""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fnmatch import fnmatch
from typing import Any, NamedTuple, Optional


class Place(NamedTuple):
    """A point, in the CRS that the call names."""

    x: float
    y: float


class Box(NamedTuple):
    """An extent, in the CRS that the call names."""

    xmin: float
    ymin: float
    xmax: float
    ymax: float


class LayerFile(NamedTuple):
    """A file that holds a layer."""

    path: str
    layer: str = ""
    """Its name in the file, where the file may have several."""


Values = Mapping[str, Any]


def number_text(value: float) -> str:
    """Returns the shortest text of exactly this number."""
    return repr(float(value)).removesuffix(".0")


def _list_text(*values: float) -> str:
    return ",".join(number_text(value) for value in values)


@dataclass(frozen=True)
class Parameter:
    """A parameter of a task.

    Attributes:
        name: Its name in models and scripts.
        label: Its name in the dialog.
        option: The option of the command line; empty for an argument, or for what becomes part of other words.
        help: What a planner may want to know besides.
        required: Whether the task needs it.
        advanced: Whether the dialog shows it only when asked.
    """

    name: str
    label: str
    option: str = ""
    help: str = ""
    required: bool = False
    advanced: bool = False

    def words(self, value: Any, values: Values) -> list[str]:
        """Returns the words for a value, which is not None."""
        return self._words(str(value))

    def _words(self, text: str) -> list[str]:
        # One word, lest a text that begins with a hyphen be taken for an option.
        return [f"{self.option}={text}" if self.option else text]


@dataclass(frozen=True)
class Store(Parameter):
    """A store that is there."""


@dataclass(frozen=True)
class NewStore(Parameter):
    """A store that is made, or added to."""


@dataclass(frozen=True)
class Files(Parameter):
    """Files on this computer, as many as are wanted."""

    filter: str = ""

    def words(self, value: Any, values: Values) -> list[str]:
        return [str(path) for path in value]


@dataclass(frozen=True)
class Rasters(Files):
    """Raster layers, as many as are wanted."""


@dataclass(frozen=True)
class File(Parameter):
    """A file that is read."""

    filter: str = ""


@dataclass(frozen=True)
class Raster(Parameter):
    """A raster layer."""


@dataclass(frozen=True)
class Layer(Parameter):
    """A layer of points, lines or polygons.

    Attributes:
        geometry: "point", "line", "polygon", or "any", which may be a table, too.
        layer_option: The option that names a layer in the file; without one, the file has to have but one.
    """

    geometry: str = "any"
    layer_option: str = ""

    def words(self, value: Any, values: Values) -> list[str]:
        named = [f"{self.layer_option}={value.layer}"] if self.layer_option and value.layer else []
        return self._words(value.path) + named


@dataclass(frozen=True)
class Field(Parameter):
    """A field of the layer that is the parameter `of`."""

    of: str = ""


@dataclass(frozen=True)
class Number(Parameter):
    """A number. What is the program's default is left out: some options count only where they are given.

    Attributes:
        default: As the program has it; None where it depends on something.
        unit: "m", "deg", "GHz", "km", or none.
    """

    default: Optional[float] = None
    unit: str = ""
    minimum: Optional[float] = None
    maximum: Optional[float] = None
    whole: bool = False

    def words(self, value: Any, values: Values) -> list[str]:
        return [] if value == self.default or not self.option else self._words(number_text(value))


@dataclass(frozen=True)
class Choice(Parameter):
    """One of several words; left out where it is the default."""

    choices: tuple[str, ...] = ()
    default: Optional[str] = None

    def words(self, value: Any, values: Values) -> list[str]:
        return [] if value == self.default else self._words(value)


@dataclass(frozen=True)
class Flag(Parameter):
    """Yes or no. `means` is the option's value where it is one that takes a value."""

    default: bool = False
    means: str = ""

    def words(self, value: Any, values: Values) -> list[str]:
        if not value or not self.option:
            return []
        return self._words(self.means) if self.means else [self.option]


@dataclass(frozen=True)
class Text(Parameter):
    """A text, as the option takes it; left out where it is blank or the default."""

    default: str = ""

    def words(self, value: Any, values: Values) -> list[str]:
        text = value.strip()
        return [] if text in ("", self.default) else self._words(text)


@dataclass(frozen=True)
class Texts(Text):
    """Texts with blanks between them, each of which gets the option."""

    def words(self, value: Any, values: Values) -> list[str]:
        return [] if value.strip() == self.default else [word for text in value.split() for word in self._words(text)]


@dataclass(frozen=True)
class Point(Parameter):
    """A place on the map. `height` and `radius` name numbers that follow behind it."""

    height: str = ""
    radius: str = ""

    def words(self, value: Any, values: Values) -> list[str]:
        behind = [values[name] for name in (self.height, self.radius) if name and values.get(name) is not None]
        return self._words(_list_text(value.x, value.y, *behind))


@dataclass(frozen=True)
class Extent(Parameter):
    """A box on the map."""

    def words(self, value: Any, values: Values) -> list[str]:
        return self._words(_list_text(*value))


@dataclass(frozen=True)
class Crs(Parameter):
    """A coordinate reference system: a code, or well-known text."""


@dataclass(frozen=True)
class Further(Parameter):
    """Further options, as one writes them on the command line."""

    def words(self, value: Any, values: Values) -> list[str]:
        return shlex.split(value)


@dataclass(frozen=True)
class Output(Parameter):
    """A file that is written.

    Attributes:
        default: Whether it is written unless the planner says otherwise.
        suffix: Put behind its path.
    """

    default: bool = False
    suffix: str = ""

    def words(self, value: Any, values: Values) -> list[str]:
        return self._words(f"{value}{self.suffix}")


@dataclass(frozen=True)
class RasterOutput(Output):
    """A GeoTIFF, which becomes a layer."""


@dataclass(frozen=True)
class VectorOutput(Output):
    """A GeoPackage, which becomes a layer."""


@dataclass(frozen=True)
class FileOutput(Output):
    """Any other file. `shown` says that QGIS shows it as a layer, or as a group of them."""

    filter: str = ""
    shown: bool = False


@dataclass(frozen=True)
class FolderOutput(Output):
    """A folder of results.

    Attributes:
        layers: Files of layers, the topmost first, as patterns of names; what else there is goes below them.
        seen: What is switched on at first: patterns of layers in GeoPackages, and of files of rasters.
        page: A page in it that the results viewer shows.
    """

    layers: tuple[str, ...] = ()
    seen: tuple[str, ...] = ()
    page: str = ""

    def layers_of(self, names: Iterable[str]) -> list[str]:
        """Returns those of the files in the folder that are layers, the topmost first."""

        def place(name: str) -> tuple[int, bool, str]:
            wanted = [at for at, pattern in enumerate(self.layers) if fnmatch(name, pattern)]
            return (wanted or [len(self.layers)])[0], name.endswith(".tif"), name

        return sorted((name for name in names if name.endswith((".gpkg", ".tif"))), key=place)

    def is_seen(self, name: str) -> bool:
        """Says whether the layer in a GeoPackage, or the file of a raster, is switched on at first."""
        return any(fnmatch(name, pattern) for pattern in self.seen)
