// SPDX-License-Identifier: MIT
// No page of the reference has it.
