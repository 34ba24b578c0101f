// SPDX-License-Identifier: MIT
// No page of the reference lists this header.
