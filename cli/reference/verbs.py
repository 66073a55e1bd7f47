"""The verbs and options of itin, as `itin --help --json` tells them."""

from __future__ import annotations

import json
import re
import subprocess
from dataclasses import dataclass, field
from pathlib import Path


@dataclass(frozen=True)
class Option:
    names: list[str]
    help: str
    kind: str  # flag, value or argument
    required: bool
    repeats: bool
    type: str = ""
    unit: str = ""
    default: str = ""
    files: str = ""  # reads, writes or replaces, of options that name files
    choices: list[str] = field(default_factory=list)

    @property
    def name(self) -> str:
        """The longest name, without dashes: what the option is called in prose and in anchors."""
        return max(self.names, key=len).lstrip("-")

    @property
    def names_files(self) -> bool:
        return self.files != ""

    def help_lines(self) -> list[str]:
        return self.help.split("\n")

    def choice_help(self) -> dict[str, str]:
        """What the help says of each choice, where it has a line for each."""
        return {found[1]: found[2] for line in self.help_lines() if (found := re.fullmatch(r"([a-z-]+) - (.*)", line))}


@dataclass(frozen=True)
class Group:
    name: str
    options: list[Option]


@dataclass(frozen=True)
class Verb:
    name: str
    summary: str
    groups: list[Group]

    @property
    def options(self) -> list[Option]:
        return [option for group in self.groups for option in group.options]

    @property
    def arguments(self) -> list[Option]:
        return [option for option in self.options if option.kind == "argument"]

    @property
    def synopsis(self) -> list[str]:
        """The call, word by word: required options by name, the others together."""
        words = ["itin", self.name]
        words += [f"{option.names[0]} {option.type}" for option in self.options if option.required and option.type != "TEXT"]
        for argument in self.arguments:
            word = argument.names[0] + ("..." if argument.repeats else "")
            words.append(word if argument.required else f"[{word}]")
        return [*words, "[OPTION...]"]


@dataclass(frozen=True)
class Program:
    version: str
    summary: str
    verbs: list[Verb]


def read_program(path: Path) -> Program:
    """Asks the program at this path."""

    def output(*arguments: str) -> str:
        return subprocess.run([path, *arguments], check=True, capture_output=True, text=True).stdout

    document = json.loads(output("--help", "--json"))
    verbs = [
        Verb(
            verb["name"],
            verb["summary"],
            [Group(group["name"], [Option(**option) for option in group["options"]]) for group in verb["groups"]],
        )
        for verb in document["verbs"]
    ]
    return Program(document["itin"], output("--help").strip().split("\n")[0], verbs)
