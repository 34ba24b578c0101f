# SPDX-License-Identifier: MIT
"""All entries, in the order of their rows."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "samples"))

import cells
import characters
import command_lines
import compressed
import headers
import matrices
import shapes
import system
import truncated

ENTRIES = sorted((*characters.ENTRIES, *cells.ENTRIES, *matrices.ENTRIES, *truncated.ENTRIES,
                  *headers.ENTRIES, *compressed.ENTRIES, *command_lines.ENTRIES, *system.ENTRIES,
                  *shapes.ENTRIES), key=lambda entry: entry.row)
