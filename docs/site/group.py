# SPDX-License-Identifier: MIT
"""group.py HEADER: prints a header for Doxygen, with what it declares in a group of its own, named
after it: Breathe shows a group without the namespace around it, which many headers open."""
import re
import sys
from pathlib import Path


def group_of(header):
    """`ph/io/read.hpp` is the group `ph_io_read`."""
    return re.sub(r"\W", "_", header.rsplit(".", 1)[0])


def head_of(text):
    """What is said before all that a header declares, and holds for it. Doxygen passes over it."""
    head = re.match(r"// SPDX.*\n((?:///.*\n)+)#pragma once\n", text)
    return re.sub(r"^/// ?", "", head[1], flags=re.MULTILINE) if head else ""


def grouped(text, group):
    begin = f"/** @addtogroup {group} */ /** @{{ */"
    # Hashes of cells and friends say nothing to a reader; definitions of what a class declares say it again.
    text = re.sub(r"^ +friend .*;$", "", text, flags=re.MULTILINE)
    text = re.sub(r"^template <>\nstruct std::hash.*?^\};$", "", text, flags=re.MULTILINE | re.DOTALL)
    text = re.sub(r"^inline constexpr (\w+) \1::.*$", "", text, flags=re.MULTILINE)
    text = re.sub(r"^(namespace ph(?:::\w+)? \{|extern \"C\" \{\n#endif)$", lambda line: f"{line[1]} {begin}", text,
                  count=1, flags=re.MULTILINE)
    return re.sub(r"^(\}  // namespace ph(?:::\w+)?|#ifdef __cplusplus\n\})$", r"/** @} */ \1", text,
                  count=1, flags=re.MULTILINE)


if __name__ == "__main__":
    path = Path(sys.argv[1])
    name = path.as_posix().partition("/include/")[2]
    print(grouped(path.read_text(), group_of(name)))
