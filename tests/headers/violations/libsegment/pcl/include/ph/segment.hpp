// SPDX-License-Identifier: MIT
// One of two public headers, where only one is allowed.
