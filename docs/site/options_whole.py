"""A hook of mkdocs: keeps an option in a call whole where the line is broken."""

from __future__ import annotations

import re
from typing import Any


def on_page_content(html: str, **_: Any) -> str:
    def kept_whole(call: re.Match[str]) -> str:
        return re.sub(r"(?<=[\s>])(--?[a-z][\w-]*)(?=[\s<])", r'<span class="whole">\1</span>', call[0])

    return re.sub(r'<div class="language-sh highlight">.*?</div>', kept_whole, html, flags=re.DOTALL)
