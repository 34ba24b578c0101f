# SPDX-License-Identifier: MIT
def test_that_is_not_found():
    pass
