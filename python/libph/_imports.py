# SPDX-License-Identifier: MIT
"""Imports that happen on first use."""
from __future__ import annotations

import importlib
import logging  # noqa: F401  (registers functions for forks, not allowed under the lock)
import os
import threading
from types import ModuleType

# If a process forks while another of its threads imports a module, the child can never import this
# module, because it waits for a thread that it does not have. A fork therefore waits for the lock.
_LOCK = threading.RLock()
if hasattr(os, "register_at_fork"):
    os.register_at_fork(before=_LOCK.acquire, after_in_parent=_LOCK.release,
                        after_in_child=_LOCK.release)


def load(name: str) -> ModuleType:
    """The module of this name. A process may fork during this import."""
    with _LOCK:
        return importlib.import_module(name)
