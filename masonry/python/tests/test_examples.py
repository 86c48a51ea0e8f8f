"""The programs of the documentation run, and give what they say."""

import doctest
import importlib
import pathlib
import pkgutil

import pytest

import lcp
import masonry

PAGE = pathlib.Path(__file__).parents[1] / "README.md"
MODULES = [
    name
    for package in (lcp, masonry)
    for name in (
        package.__name__,
        *(f"{package.__name__}.{it.name}" for it in pkgutil.iter_modules(package.__path__)),
    )
]


@pytest.mark.parametrize("name", MODULES)
def test_examples_of_the_docstrings(name):
    assert doctest.testmod(importlib.import_module(name)).failed == 0


def test_every_function_has_an_example():
    for name in lcp.__all__:
        it = getattr(lcp, name)
        is_answer = isinstance(it, type) and issubclass(it, (lcp.Answer, Exception))
        assert is_answer or ">>> " in it.__doc__, name


def test_examples_of_the_page():
    found = doctest.testfile(str(PAGE), module_relative=False)
    assert found.failed == 0 and found.attempted >= 3
