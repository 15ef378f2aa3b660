"""Everything that the package offers is documented: the page of the site is made of it."""

import dataclasses
import inspect

import gnomon


def described(name, thing):
    """Whether there is more than the signature that pybind11 writes."""
    lines = (inspect.getdoc(thing) or "").splitlines()
    return any(line.strip() and not line.startswith(f"{name}(") for line in lines)


def undocumented():
    for name in set(gnomon.__all__) - {"__version__"}:
        thing = getattr(gnomon, name)
        if not described(name, thing):
            yield name
        if not inspect.isclass(thing) or issubclass(thing, Exception):
            continue
        ours = [base for base in thing.__mro__ if base.__module__.startswith("gnomon")]
        for member in {member for base in ours for member in vars(base) if not member.startswith("_")}:
            if not described(member, inspect.getattr_static(thing, member)):
                yield f"{name}.{member}"


def test_every_public_member_is_documented():
    assert sorted(undocumented()) == []


def test_every_field_of_an_outcome_is_documented():
    source = inspect.getsource(gnomon.Outcome)
    for field in dataclasses.fields(gnomon.Outcome):
        line = next(line for line in source.splitlines() if line.strip().startswith(f"{field.name}:"))
        assert "#:" in line, field.name
