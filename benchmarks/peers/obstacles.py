"""Tells what stands in the way of many workers: where a run loses time beyond an equal share for each."""
import collections
import statistics

from schedule import Loop, longest_chain, makespan, work


def short(source):
    """Returns a source's name without the folder that all sources share."""
    return source.replace("/src/", "/")


def why(loops):
    """Describes the loops of one source in words."""
    longest = sum(max(map(longest_chain, loop.tasks), default=0) for loop in loops)
    if len(loops) == 1:
        return f"{len(loops[0].tasks)} tasks, the longest {longest:.3f} s"
    tasks = statistics.median_low(len(loop.tasks) for loop in loops)
    return f"{len(loops)} loops of {tasks} tasks in the median, their longest tasks together {longest:.2f} s"


def of_loops(root, workers):
    """Returns (seconds lost, source and reason) of the loops that give the workers too little to do, the greatest first."""
    lost, loops = collections.Counter(), collections.defaultdict(list)
    for item in root:
        if isinstance(item, Loop):
            lost[item.at] += makespan([item], workers) - sum(map(work, item.tasks)) / workers
            loops[item.at].append(item)
    return [(seconds, f"{short(at)} ({why(loops[at])})") for at, seconds in lost.most_common()]


def of_one_thread(serial):
    """Returns (seconds, source) of what one thread does alone, the greatest first."""
    return sorted(((seconds, short(at)) for at, seconds in serial.items()), reverse=True)


def line(name, found, most=4):
    """Returns the obstacles of one kind as a line: all together, and the greatest by name."""
    named = ", ".join(f"{seconds:.2f} {text}" for seconds, text in found[:most] if seconds >= 0.005)
    return f"{name} {sum(seconds for seconds, _ in found):.2f} s: {named}"
