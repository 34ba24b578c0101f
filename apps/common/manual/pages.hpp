// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "apps/common/manual/option_text.hpp"

// These functions make the outputs for other programs from the manual of a program.
namespace ph::app {

/// A page of section 1 of the manual, in the macros of man(7).
std::string man_page(const Described& program);

/// A reference page in MyST, which is Markdown for Sphinx. Each option is a separate object, with
/// an anchor (`#cmdoption-ph-barcode-engine`) and an entry in the index.
std::string markdown_page(const Described& program);

// Each of these functions returns a script that completes a command line. The script contains all
// alternatives, so completion does not run the program.
std::string bash_completion(const Described& program);
std::string zsh_completion(const Described& program);
std::string fish_completion(const Described& program);

}  // namespace ph::app
