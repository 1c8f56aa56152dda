"""The examples of the docstrings, of docs/python.md and of the folder `examples` run."""

from __future__ import annotations

import doctest
import inspect
import re

import pytest

import asperity
from conftest import ROOT

NAMES = [name for name in asperity.__all__ if not name.startswith("_")]


@pytest.mark.parametrize("name", ["asperity", *NAMES])
def test_examples_of_docstrings_give_what_they_say(name):
    item = asperity if name == "asperity" else getattr(asperity, name)
    test = doctest.DocTestParser().get_doctest(inspect.getdoc(item), {}, name, None, 0)
    assert doctest.DocTestRunner().run(test).failed == 0


@pytest.mark.parametrize("name", NAMES)
def test_every_public_item_is_documented(name):
    item = getattr(asperity, name)
    assert item.__doc__
    for attribute, value in vars(item).items() if inspect.isclass(item) else ():
        if not attribute.startswith("_") and (callable(value) or hasattr(value, "__get__")):
            # Fields of records stand in the docstring of the record.
            assert value.__doc__ or attribute in item.__doc__, attribute


def test_the_programs_of_the_document_run(tmp_path, monkeypatch):
    document = ROOT / "docs/python.md"
    programs = re.findall(r"^```python\n(.*?)^```", document.read_text("utf-8"), re.M | re.S)
    assert programs
    monkeypatch.chdir(tmp_path)
    names = {}
    for program in programs:
        exec(compile(program, str(document), "exec"), names)
    assert (tmp_path / "sandpaper.asp").exists()


EXAMPLES = sorted((ROOT / "bindings/python/examples").glob("*.py"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.name)
def test_the_examples_run(example, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    exec(compile(example.read_text("utf-8"), str(example), "exec"), {})
