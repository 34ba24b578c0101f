# SPDX-License-Identifier: MIT
"""All entries of the corpus, in the order of their rows."""
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "entries"), os.path.join(HERE, os.pardir, "samples")]

import alpha_points
import barcode_files
import cells
import characters
import command_lines
import compressed
import headers
import matrices
import part_files
import scene_files
import shapes
import system
import truncated
import volumes

ENTRIES = sorted((*characters.ENTRIES, *cells.ENTRIES, *matrices.ENTRIES, *truncated.ENTRIES,
                  *headers.ENTRIES, *compressed.ENTRIES, *command_lines.ENTRIES, *system.ENTRIES,
                  *shapes.ENTRIES, *barcode_files.ENTRIES, *part_files.ENTRIES,
                  *scene_files.ENTRIES, *alpha_points.ENTRIES, *volumes.ENTRIES), key=lambda entry: entry.row)
