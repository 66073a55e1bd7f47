"""The reference of the documentation site: a page for each verb, in which every option has an anchor."""

from __future__ import annotations

from html import escape

from verbs import Option, Program, Verb


def reference_pages(program: Program) -> dict[str, str]:
    """The Markdown of each page, by its file name."""
    pages = {f"{verb.name}.md": verb_page(verb) for verb in program.verbs}
    return {"index.md": index_page(program), **pages}


def index_page(program: Program) -> str:
    rows = "".join(f"| [`itin {verb.name}`]({verb.name}.md) | {verb.summary} |\n" for verb in program.verbs)
    return (
        "# Reference\n\n"
        f"All verbs and options of itin {program.version}, as `itin --help --json` tells them. "
        "`itin VERB --help` prints the same in a terminal.\n\n"
        "| verb | what it does |\n|---|---|\n" + rows + "\nAll verbs end with status 0 when they have done what was asked; "
        "with 1 when it cannot be done (a file cannot be read or written, or is damaged); with 2 when the call or its "
        "input is wrong; with 130 or 143 when Ctrl-C or SIGTERM ended them.\n"
    )


def verb_page(verb: Verb) -> str:
    groups = "".join(f"\n## {group.name}\n\n{option_list(group.options)}\n" for group in verb.groups)
    return f"# itin {verb.name}\n\n{verb.summary}.\n\n```\n{' '.join(verb.synopsis)}\n```\n{groups}"


def option_list(options: list[Option]) -> str:
    entries = "".join(f"{term(option)}\n{description(option)}\n" for option in options)
    return f'<dl class="options">\n{entries}</dl>\n'


def term(option: Option) -> str:
    names = ", ".join(f"<code>{escape(name)}</code>" for name in option.names)
    value = f" <var>{escape(option.type)}</var>" if option.kind == "value" else ""
    notes = [note for note, holds in (("required", option.required), ("repeats", option.repeats)) if holds]
    if option.unit:
        notes.append(escape(option.unit))
    said = f" <small>{', '.join(notes)}</small>" if notes else ""
    return f'<dt id="{escape(option.name)}">{names}{value}{said}</dt>'


def description(option: Option) -> str:
    return "<dd>" + "<br>".join(map(escape, option.help_lines())) + "</dd>"
