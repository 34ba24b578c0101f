// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "apps/common/manual/option_text.hpp"

// The outputs for other programs, made from the manual of a program.
namespace ph::app {

/// A page of section 1, in the macros of man(7).
std::string man_page(const Described& program);

/// A reference page in MyST, Markdown for Sphinx: each option is a separate object, with an anchor
/// (`#cmdoption-ph-barcode-engine`) and an entry in the index.
std::string markdown_page(const Described& program);

// Scripts that complete a command line. They contain all alternatives; completion does not run the
// program.
std::string bash_completion(const Described& program);
std::string zsh_completion(const Described& program);
std::string fish_completion(const Described& program);

}  // namespace ph::app
