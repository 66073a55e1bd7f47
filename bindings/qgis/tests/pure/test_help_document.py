"""Each parameter is an option of its verb, with the unit, choices and default that the program states; and each option of
a verb is a parameter."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Iterator
from typing import Any

import pytest
from conftest import PROGRAM

from itin_qgis.tasks import TASKS, Task
from itin_qgis.tasks.parameters import Choice, Field, Flag, Number, Output, Parameter, Text, Texts

DOCUMENT = json.loads(subprocess.run([PROGRAM, "--help", "--json"], capture_output=True, check=True).stdout)
OPTIONS: dict[str, dict[str, dict[str, Any]]] = {
    verb["name"]: {name: option for group in verb["groups"] for option in group["options"] for name in option["names"]}
    for verb in DOCUMENT["verbs"]
}

GIVEN_BY_THE_PLUGIN = {"--help", "--progress", "--overwrite", "--in-crs", "--all"}
DONE_BY_QGIS = {"--layer", "--where"}  # layers have these already
LEFT_TO_FURTHER_OPTIONS = {
    ("*", "--json"),
    ("*", "--quiet"),
    ("*", "--allow-network"),
    ("import", "--remove"),  # names no layer
    ("viewshed", "--precise"),  # the default
    ("viewshed", "--observer-name"),  # a layer has names
    ("los", "--profile-csv"),  # work without a store
    ("los", "--heights"),
    ("profile", "--via"),  # a layer has bends
    ("profile", "--image"),  # a mesh has pictures
    ("profile", "--edges"),
    ("profile", "--eye"),
    ("profile", "--look"),
    ("profile", "--field"),
}


def parameters() -> Iterator[tuple[Task, Parameter, dict[str, Any]]]:
    """All parameters that are options, with what the program says of them."""
    for kind in TASKS:
        for parameter in kind.parameters:
            if parameter.option:
                yield kind(), parameter, OPTIONS[kind.verb].get(parameter.option, {})


ALL = [pytest.param(*each, id=f"{each[0].name}-{each[1].name}") for each in parameters()]


@pytest.mark.parametrize("task, parameter, option", ALL)
def test_parameter_is_an_option(task: Task, parameter: Parameter, option: dict[str, Any]) -> None:
    assert option, f"itin {task.verb} has no option {parameter.option}"
    takes_none = isinstance(parameter, Flag) and not parameter.means
    assert (option["kind"] == "flag") == takes_none
    if isinstance(parameter, Texts):
        assert option["repeats"]


@pytest.mark.parametrize("task, parameter, option", ALL)
def test_unit_is_that_of_the_option(task: Task, parameter: Parameter, option: dict[str, Any]) -> None:
    unit = parameter.unit if isinstance(parameter, Number) else ""
    if isinstance(parameter, Number):
        assert unit == option.get("unit", "")
    if unit not in ("", "m"):  # the dialog shows metres by itself
        assert f"[{'degrees' if unit == 'deg' else unit}]" in parameter.label


@pytest.mark.parametrize("task, parameter, option", ALL)
def test_choices_are_those_of_the_option(task: Task, parameter: Parameter, option: dict[str, Any]) -> None:
    if not isinstance(parameter, Choice):
        return
    if "choices" in option:
        assert list(parameter.choices) == option["choices"]
    else:
        for choice in parameter.choices:
            assert choice in option["help"]


@pytest.mark.parametrize("task, parameter, option", ALL)
def test_default_is_that_of_the_option(task: Task, parameter: Parameter, option: dict[str, Any]) -> None:
    stated = option.get("default")
    if (task.name, parameter.name) == ("siteturbines", "RADIUS"):
        assert "turbines are looked for (default: by their tips" in option["help"]
    elif isinstance(parameter, Number):
        assert parameter.default == number_of(stated)
    elif isinstance(parameter, Choice) and not parameter.required and "choices" in option:
        assert parameter.default == stated
    elif isinstance(parameter, Text):
        assert parameter.default in ("", stated)
        assert parameter.default == stated or stated is None or " " in stated
    else:
        assert isinstance(parameter, (Field, Flag, Output, Choice)) or stated is None or " " in stated


def number_of(stated: str | None) -> float | None:
    """Returns the default where it is a number."""
    try:
        return float(stated or "")
    except ValueError:
        return None


@pytest.mark.parametrize("verb", sorted({task.verb for task in TASKS}))
def test_every_option_is_a_parameter(verb: str) -> None:
    """An option that is new wants a parameter in the tasks of its verb, or a place in the lists above."""
    tasks = [task for task in TASKS if task.verb == verb]
    known = {parameter.option for task in tasks for parameter in task.parameters}
    known |= {word for task in tasks for word in task.words}
    known |= GIVEN_BY_THE_PLUGIN | DONE_BY_QGIS
    known |= {option for of, option in LEFT_TO_FURTHER_OPTIONS if of in ("*", verb)}
    assert {name for name in OPTIONS[verb] if name.startswith("--")} - known == set()


@pytest.mark.parametrize("verb", sorted({task.verb for task in TASKS}))
def test_layers_are_named_where_the_verb_can(verb: str) -> None:
    for task in TASKS:
        for parameter in task.parameters:
            option = getattr(parameter, "layer_option", "")
            assert not option or option in OPTIONS[task.verb]


@pytest.mark.parametrize("task", TASKS, ids=lambda task: task.name)
def test_what_the_verb_needs_is_required(task: type[Task]) -> None:
    required = {parameter.option for parameter in task.parameters if parameter.required}
    for name, option in OPTIONS[task.verb].items():
        if option["required"] and name.startswith("--"):
            assert name in required
