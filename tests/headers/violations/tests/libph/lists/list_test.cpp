// SPDX-License-Identifier: MIT
// Neither the name of the folder nor the name of the file is the name of a test.
