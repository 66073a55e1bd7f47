"""How long a command of itin is in each of the stages that its progress names, as they are shown, ten times a second."""
import os
import pty
import re
import subprocess
import time

from measure import Failed

STAGE = re.compile(r"(.*\D) +\d+ %")


def stage_in(line):
    """Returns the stage that a line of progress names, without the file that it is about; None for other lines."""
    found = STAGE.fullmatch(re.sub(r"\x1b\[K|, .* left$", "", line).strip())
    return found and re.sub(r" \S*[/.]\S*$", "", found[1].strip())


def timed(command):
    """Returns the seconds by the clock of the whole command, under "", and of its stages, under their names."""
    terminal, side = pty.openpty()
    began = stage_began = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=side)
    os.close(side)
    seconds, stage, text, said = {}, None, "", ""
    while True:
        try:
            text += os.read(terminal, 65536).decode(errors="replace")
        except OSError:  # the program has closed its end
            break
        *lines, text = re.split(r"[\r\n]", text)
        said = next(filter(str.strip, reversed([*lines, text])), said)
        for named in filter(None, map(stage_in, lines + [text])):
            now = time.monotonic()
            if named != stage:
                if stage:
                    seconds[stage] = seconds.get(stage, 0) + now - stage_began
                stage, stage_began = named, now
    os.close(terminal)
    if process.wait() != 0:
        raise Failed(f"{' '.join(map(str, command))} failed: {said.strip()}")
    now = time.monotonic()
    if stage:
        seconds[stage] = seconds.get(stage, 0) + now - stage_began
    seconds[""] = now - began
    return seconds
