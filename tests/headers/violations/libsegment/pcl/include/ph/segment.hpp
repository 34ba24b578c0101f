// SPDX-License-Identifier: MIT
// One of two public headers in a folder that may have only one.
