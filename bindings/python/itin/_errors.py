"""The errors that itin raises. Every message is one line: what, where, what to do."""


class Error(Exception):
    """The root of the errors that itin raises on purpose."""


class InputError(Error, ValueError):
    """The call or its input is wrong: a value, a geometry.

    Attributes:
        field: The argument that is wrong or missing, as ``"cell_size"``; empty where it is none of them, but a file or
            a place.
    """

    field: str

    def __init__(self, message: str, field: str = "") -> None:
        super().__init__(message)
        self.field = field


class FileError(Error):
    """A file could not be read, written or understood.

    Attributes:
        path: The file.
    """

    path: str

    def __init__(self, message: str, path: str) -> None:
        super().__init__(message)
        self.path = path


class CorruptStore(FileError):
    """The bytes of a store are not those that were written.

    Attributes:
        place: The table and row, as ``itin check`` names them.
    """

    place: str

    def __init__(self, message: str, path: str, place: str) -> None:
        super().__init__(message, path)
        self.place = place
