"""Keywords of compiled functions: an unknown one is told by its name, as Python itself does."""

import functools
import re
from typing import Any, Callable


def named(function: Callable[..., Any], name: str = "") -> Callable[..., Any]:
    """The same function, or the __init__ of a class of that name. pybind11 would answer an unknown keyword with all that it was given, a whole scene say."""
    known = set(re.findall(r"(\w+):", function.__doc__.split("\n", 1)[0]))

    @functools.wraps(function)
    def call(*given, **keywords):
        for keyword in keywords:
            if keyword not in known:
                raise TypeError(f"{name or function.__name__}() got an unexpected keyword argument {keyword!r}")
        return function(*given, **keywords)

    return call
