# SPDX-License-Identifier: MIT
"""The faults that plant_program_mutants.py plants."""

# name, file, text that occurs exactly once, what replaces it, targets to build, tests that must notice (for ctest -R)
MUTANTS = [
    ("perseus: what is not listed is infinite, not absent", "libph/src/io/perseus.cpp",
     "std::vector<double> values(*count, kAbsent);", "std::vector<double> values(*count, kInfinity);",
     ["ph-barcode"], "ph_barcode_masks"),
]
