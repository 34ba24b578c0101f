# SPDX-License-Identifier: MIT
def test_found():
    pass
