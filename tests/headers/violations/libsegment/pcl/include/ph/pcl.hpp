// SPDX-License-Identifier: MIT
// One of two public headers where one is allowed.
