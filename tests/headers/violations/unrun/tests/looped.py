# SPDX-License-Identifier: MIT
"""Imports helper.py, but only mentions forgotten.py."""
import helper  # noqa: F401
