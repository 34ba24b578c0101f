// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "common/manual/option_text.hpp"

// What other programs read of the manual of a program.
namespace ph::app {

/// A page of section 1, in the macros of man(7).
std::string man_page(const Described& program);

/// A reference page in MyST, Markdown for Sphinx: each option is an object of its own, with an
/// anchor
/// (`#cmdoption-ph-barcode-engine`) and a place in the index.
std::string markdown_page(const Described& program);

// Scripts that complete a command line. They hold all that they offer; the program is not run.
std::string bash_completion(const Described& program);
std::string zsh_completion(const Described& program);
std::string fish_completion(const Described& program);

}  // namespace ph::app
