// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ph::app {

/// Names for the outputs of several inputs. The name of an input is its file name without the
/// extension. If several inputs have this name, it is the file name with its extension and, if
/// several inputs have that name as well, also with its folders. Two inputs may still have the same
/// name, for example a file that is named twice, or a/b/c and a-b/c.
std::vector<std::string> output_names(const std::vector<std::string>& inputs);

/// True if a path has a place for the name of each input, because it is FOLDER/ or the file name
/// contains a `*`.
bool names_each(const std::string& path);

/// The output file for one of several inputs. If the pattern is a folder, the output is a file in
/// this folder with the name of the input. Otherwise the name of the input replaces the last `*`.
/// @param extension the extension of a file in a folder, with its dot.
std::string filled(const std::string& pattern, const std::string& name, std::string_view extension);

/// Creates the folder that a pattern of `filled` names.
/// @throws Error (usage) if it is neither a folder nor has a `*`; Error (cannot_create).
void prepare_outputs(std::string_view option, const std::string& pattern);

/// The files of a folder whose names end in one of these extensions, in upper or lower case, sorted
/// by name.
/// @param what the word for these files in the message. @throws Error (no_input) if there are no
/// such files.
std::vector<std::string> files_in(const std::string& folder,
                                  std::span<const std::string_view> extensions,
                                  std::string_view what);

bool is_folder(const std::string& path);

/// Creates a folder. An existing folder is not an error. @throws Error (cannot_create).
void create_folder(const std::string& path);

}  // namespace ph::app
