// SPDX-License-Identifier: MIT
// Neither the name of its folder nor its own name is that of a test.
