"""Manual pages: `itin(1)`, and one for each verb."""

from __future__ import annotations

from verbs import Option, Program, Verb


def man_pages(program: Program) -> dict[str, str]:
    """The text of each page, by its file name."""
    pages = {f"itin-{verb.name}.1": verb_page(program, verb) for verb in program.verbs}
    return {"itin.1": program_page(program), **pages}


def program_page(program: Program) -> str:
    verbs = "".join(f".TP\n.BR itin\\-{verb.name} (1)\n{escaped(verb.summary)}.\n" for verb in program.verbs)
    return (
        header(program, "itin")
        + f".SH NAME\nitin \\- {escaped(lower_first(program.summary))}\n"
        + ".SH SYNOPSIS\n.B itin\n.I VERB\n[\\fIOPTION\\fR...]\n"
        + ".SH DESCRIPTION\nitin computes what can be seen from where over real terrain, with buildings and trees:\n"
        + "viewsheds, lines of sight, radio links, zones of visibility of wind farms, and the best sites for masts.\n"
        + "It keeps a landscape in one file, the store, which\n.BR itin\\-import (1)\nmakes.\n"
        + ".SH VERBS\n"
        + verbs
        + ".SH OPTIONS\n"
        + ".TP\n\\fB\\-\\-help\\fR\nPrint the verbs, or the options of a verb. With\n.B \\-\\-json\n"
        + "print all of it as one JSON document.\n"
        + ".TP\n\\fB\\-\\-version\\fR\nPrint the version.\n"
        + EXIT_STATUS
    )


def verb_page(program: Program, verb: Verb) -> str:
    groups = "".join(
        f".SS {escaped(group.name)}\n" + "".join(entry(option) for option in group.options) for group in verb.groups
    )
    call = " ".join(verb.synopsis[2:])
    return (
        header(program, f"itin-{verb.name}")
        + f".SH NAME\nitin\\-{verb.name} \\- {escaped(lower_first(verb.summary))}\n"
        + f".SH SYNOPSIS\n.B itin {verb.name}\n{escaped(call)}\n"
        + ".SH OPTIONS\n"
        + groups
        + EXIT_STATUS
        + ".SH SEE ALSO\n.BR itin (1)\n"
    )


EXIT_STATUS = (
    ".SH EXIT STATUS\n"
    ".TP\n0\nDone.\n"
    ".TP\n1\nIt could not be done: a file cannot be read or written, or is damaged.\n"
    ".TP\n2\nThe call, or what it was given, is wrong. One line on standard error says what, and what to do.\n"
    ".TP\n130, 143\nEnded by Ctrl\\-C or SIGTERM. Nothing unfinished is left.\n"
)


def header(program: Program, name: str) -> str:
    return f'.TH {escaped(name.upper())} 1 "" "itin {program.version}" "User Commands"\n'


def entry(option: Option) -> str:
    names = ", ".join(f"\\fB{escaped(name)}\\fR" for name in option.names)
    value = f" \\fI{escaped(option.type)}\\fR" if option.kind == "value" else ""
    required = " (required)" if option.required and option.kind == "value" else ""
    return f".TP\n{names}{value}{required}\n" + "\n.br\n".join(map(text_line, option.help_lines())) + "\n"


def text_line(text: str) -> str:
    """A line that troff takes for text, whatever it begins with."""
    line = escaped(text)
    return "\\&" + line if line.startswith((".", "'")) else line


def escaped(text: str) -> str:
    return text.replace("\\", "\\e").replace("-", "\\-")


def lower_first(text: str) -> str:
    return text[:1].lower() + text[1:]
