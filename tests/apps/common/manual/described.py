# SPDX-License-Identifier: MIT
"""Parses the options in a program's help, for tests of other output made from the same
description."""
import os
import re
import subprocess


class Option:
    """names: "-o", "--output". value: its placeholder, empty for a flag."""

    def __init__(self, names, value):
        self.names, self.value = names, value

    @property
    def name(self):
        return next(name for name in self.names if name.startswith("--"))


def printed(program, *arguments):
    """Standard output of a run that ends well."""
    return subprocess.run([program, *arguments], capture_output=True, text=True, timeout=60,
                          check=True).stdout


def options_in(text):
    """The options of a help text, in its order."""
    joined = re.sub(r"\|\n +", "|", text)  # a list of alternatives may have several lines
    # A value ends where the text beside it begins, two blanks or more later.
    heads = re.findall(r"(?m)^  (-\S+)((?: \S+)*)(?:$|  )", joined)
    return [Option(names.split(","), value.strip()) for names, value in heads]


def options_of(program):
    """All options of a program by name."""
    return {option.name: option for option in options_in(printed(program, "--help", "all"))}


def topics_of(program):
    """The topics of options that --help lists, without `all`."""
    lines = printed(program, "--help").split("Topics: ")[1].splitlines()
    names = [match[1] for line in lines if (match := re.match(r"  ([a-z]+) {2,}\S", line))]
    return names[:names.index("all")]


def name_of(program):
    return os.path.basename(program)
