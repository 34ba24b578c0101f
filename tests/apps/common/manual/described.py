# SPDX-License-Identifier: MIT
"""Parses the options in a program's help, for tests of other texts that are generated from the same
description."""
import os
import re
import subprocess


class Option:
    """An option: its names, such as "-o" and "--output", and the placeholder of its value, which is
    empty for a flag."""

    def __init__(self, names, value):
        self.names, self.value = names, value

    @property
    def name(self):
        return next(name for name in self.names if name.startswith("--"))


def printed(program, *arguments):
    """Standard output of a run that succeeds."""
    return subprocess.run([program, *arguments], capture_output=True, text=True, timeout=60,
                          check=True).stdout


def options_in(text):
    """The options in a help text, in the same order."""
    joined = re.sub(r"\|\n +", "|", text)  # a list of alternatives may extend over several lines
    # The value of an option ends before the description, which begins after two or more blanks.
    heads = re.findall(r"(?m)^  (-\S+)((?: \S+)*)(?:$|  )", joined)
    return [Option(names.split(","), value.strip()) for names, value in heads]


def options_of(program):
    """All options of a program, by name."""
    return {option.name: option for option in options_in(printed(program, "--help", "all"))}


def topics_of(program):
    """The topics that --help lists, without `all`."""
    lines = printed(program, "--help").split("Topics: ")[1].splitlines()
    names = [match[1] for line in lines if (match := re.match(r"  ([a-z]+) {2,}\S", line))]
    return names[:names.index("all")]


def name_of(program):
    return os.path.basename(program)
