"""What a program needs to be started with on Windows."""

from __future__ import annotations

import subprocess

WITHOUT_WINDOW: int = getattr(subprocess, "CREATE_NO_WINDOW", 0)
"""Flags of a process that opens no console."""
