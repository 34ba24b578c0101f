# SPDX-License-Identifier: MIT
"""Finds the constants of C++ sources: the names that are declared as constexpr with a value that
contains a number."""

import re
from typing import NamedTuple

ELSEWHERE = re.compile(
    r"""//[^\n]*|/\*.*?\*/|^[ \t]*\#[^\n]*|"(?:\\.|[^"\\\n])*"|(?<!\w)'(?:\\.|[^'\\\n])+'""",
    re.DOTALL | re.MULTILINE,
)
NUMBER = re.compile(
    r"(?<![\w.])(?:0x[\da-f']+|(?:\d[\d']*\.?\d*|\.\d+)(?:e[-+]?\d+)?)[uzlf]*", re.IGNORECASE
)
DECLARATION = re.compile(r"\bconstexpr\b(?!\s*\()([^;{}()=]*?)(\w+)\s*(=|\{)")
CLOSING = {"(": ")", "{": "}", "[": "]"}


class Constant(NamedTuple):
    type: str
    name: str
    value: str  # as in the source, with single spaces
    begin: int  # where the value is in the source
    end: int


def value_of(number):
    return float(number.replace("'", "").rstrip("uUzZlLfF"))


def code_of(text):
    """The text with blanks instead of comments, directives, strings and characters."""
    return ELSEWHERE.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)


def end_of(code, begin, stops):
    """The first place from `begin` on, outside brackets, of one of the characters `stops`."""
    open_brackets = []
    for at in range(begin, len(code)):
        if not open_brackets and code[at] in stops:
            return at
        if code[at] in CLOSING:
            open_brackets.append(CLOSING[code[at]])
        elif open_brackets and code[at] == open_brackets[-1]:
            open_brackets.pop()
    return len(code)


def constants_in(text):
    """The constants of a source, in their order."""
    code, found = code_of(text), []
    for declaration in DECLARATION.finditer(code):
        kind, name, is_braced = declaration[1].strip(), declaration[2], declaration[3] == "{"
        begin = declaration.end()
        while True:
            end = end_of(code, begin, "}" if is_braced else ",;")
            value = text[begin:end]
            begin += len(value) - len(value.lstrip())
            if NUMBER.search(code, begin, end):
                bounds = begin, begin + len(value.strip())
                found.append(Constant(kind, name, " ".join(value.split()), *bounds))
            after = end + is_braced
            more = re.compile(r"\s*,\s*(\w+)\s*(=|\{)").match(code, after)
            if not more:
                break
            name, is_braced, begin = more[1], more[2] == "{", more.end()
    return found
