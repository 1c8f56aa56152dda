"""Errors and warnings: what is wrong, then what to do about it."""


class AsperityError(Exception):
    """Something went wrong; says what and what to do about it.

    Parameters
    ----------
    message : str
        What is wrong: the file or argument, the field, the value and the rule.
    remedy : str
        What to do about it, in one sentence.

    Attributes
    ----------
    message : str
        As given.
    remedy : str
        As given.
    """

    message: str
    remedy: str

    def __init__(self, message: str, remedy: str) -> None:
        super().__init__(message, remedy)
        self.message = message
        self.remedy = remedy

    def __str__(self) -> str:
        return f"{self.message}\n  help: {self.remedy}"


class UsageError(AsperityError, ValueError):
    """An argument that makes no sense."""


class NoSuchTextureError(AsperityError, LookupError):
    """A library has no texture of this name or index."""


class AsperityWarning(UserWarning):
    """A texture was made, but something about it should be known."""
