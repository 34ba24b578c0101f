// SPDX-License-Identifier: MIT
// Neither its folder nor its name is that of a test.
