# SPDX-License-Identifier: MIT
"""group.py HEADER: prints a header for Doxygen with its declarations in a group named after it,
because Breathe shows a group without its namespace, which many headers share."""
import re
import sys
from pathlib import Path


def group_of(header):
    """The name of a header's group: `ph/io/read.hpp` has the group `ph_io_read`."""
    return re.sub(r"\W", "_", header.rsplit(".", 1)[0])


def head_of(text):
    """The comment before all declarations of a header, which describes the header as a whole.
    Doxygen ignores such comments."""
    head = re.match(r"// SPDX.*\n((?:///.*\n)+)#pragma once\n", text)
    return re.sub(r"^/// ?", "", head[1], flags=re.MULTILINE) if head else ""


def grouped(text, group):
    begin = f"/** @addtogroup {group} */ /** @{{ */"
    # Removes what is of no interest to readers: friends, hashes of cells and tables of names.
    # Also removes definitions of class members, which would repeat their declarations.
    text = re.sub(r"^ +friend .*;$", "", text, flags=re.MULTILINE)
    text = re.sub(r"^template <>\nstruct std::hash.*?^\};$", "", text, flags=re.MULTILINE | re.DOTALL)
    text = re.sub(r"^template <>\ninline constexpr std::array names_of<.*?^\};$", "", text,
                  flags=re.MULTILINE | re.DOTALL)
    text = re.sub(r"^inline constexpr (\w+) \1::.*$", "", text, flags=re.MULTILINE)
    text = re.sub(r"^(namespace ph(?:::\w+)? \{|extern \"C\" \{\n#endif)$", lambda line: f"{line[1]} {begin}", text,
                  count=1, flags=re.MULTILINE)
    return re.sub(r"^(\}  // namespace ph(?:::\w+)?|#ifdef __cplusplus\n\})$", r"/** @} */ \1", text,
                  count=1, flags=re.MULTILINE)


if __name__ == "__main__":
    path = Path(sys.argv[1])
    name = path.as_posix().partition("/include/")[2]
    print(grouped(path.read_text(), group_of(name)))
