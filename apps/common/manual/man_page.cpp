// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "apps/common/manual/lines.hpp"
#include "apps/common/manual/pages.hpp"
#include "apps/common/terminal/build_information.hpp"
#include "apps/common/terminal/exit_code.hpp"

namespace ph::app {
namespace {

constexpr std::size_t kSourceWidth = 76;  // the number of columns of the lines in the page's source

/// The roff name of the character outside ASCII at the beginning of a text. @param rest the text,
/// from which the character is removed.
std::string special_character(std::string_view& rest) {
  if (constexpr std::string_view kDots = "…"; rest.starts_with(kDots)) {
    rest.remove_prefix(kDots.size());
    return "...";
  }
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(rest[i]); };
  const std::size_t length = byte(0) >= 0xF0 ? 4 : byte(0) >= 0xE0 ? 3 : 2;
  unsigned code = byte(0) & (0xFFu >> (length + 1));
  for (std::size_t i = 1; i < length && i < rest.size(); ++i) code = code << 6 | (byte(i) & 0x3Fu);
  rest.remove_prefix(std::min(length, rest.size()));
  return fmt::format("\\[u{:04X}]", code);
}

/// A text in roff. @param is_typed true for text that the user types, whose dashes are not hyphens.
std::string roff(std::string_view text, bool is_typed) {
  std::string escaped;
  while (!text.empty()) {
    const char c = text.front();
    if (static_cast<unsigned char>(c) >= 0x80) {
      escaped += special_character(text);
      continue;
    }
    text.remove_prefix(1);
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-' && is_typed)  // mutant: help-dash
      escaped += "\\-";
    else if (c == '^' || c == '~' || c == '`')  // roff would print accents instead
      escaped += fmt::format("\\({}", c == '^' ? "ha" : c == '~' ? "ti" : "ga");
    else
      escaped += c;
  }
  return escaped;
}

/// The text in lines. No line looks like a roff request.
std::string roff_lines(std::string_view text) {
  std::string escaped;
  for (const std::string_view word : words_of(text)) {
    if (!escaped.empty()) escaped += ' ';
    escaped += roff(word, word.starts_with('-') || word.starts_with("(-"));
  }
  std::string lines;
  for (const std::string& line : wrapped(escaped, kSourceWidth))
    lines +=
        fmt::format("{}{}\n", line.starts_with('.') || line.starts_with('\'') ? "\\&" : "", line);
  return lines;
}

/// The names of an option in bold and its value in italics. A list of alternatives may be broken
/// after `|`.
std::string roff_head(const OptionText& option) {
  std::string head;
  for (const std::string& name : option.names)
    head += fmt::format("{}\\fB{}\\fR", head.empty() ? "" : ", ", roff(name, true));
  if (option.is_input) head += "...";
  if (option.placeholder.empty()) return head;
  head += " \\fI";
  for (const char c : roff(option.placeholder, true)) {
    head += c;
    if (c == '|') head += "\\:";
  }
  return head + "\\fR";
}

std::string item(std::string_view head, std::string_view text) {
  return fmt::format(".TP\n{}\n{}", head, roff_lines(text));
}

std::string preformatted(std::string_view text) {
  return fmt::format(".PP\n.RS 4\n.EX\n{}\n.EE\n.RE\n", roff(text, true));
}

std::string capitals(std::string_view text) {
  std::string upper(text);
  for (char& c : upper)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return upper;
}

std::string format_section(const Manual& manual) {
  std::string text = ".SH FORMATS\n";
  for (const FormatList& list : manual.formats()) {
    text += fmt::format(".SS {}\n", roff(list.title, false));
    for (const FormatText& format : list.formats) {
      text += item(fmt::format("\\fB{}\\fR", roff(format.name, true)), format.what);
      if (!format.example.empty()) text += fmt::format(".br\n\\&{}\n", roff(format.example, true));
    }
  }
  return text;
}

}  // namespace

std::string man_page(const Described& program) {
  const Manual& manual = program.manual;
  const std::string name = roff(manual.program, true);
  std::string page = fmt::format(
      ".\\\" SPDX-License-Identifier: MIT\n"
      ".\\\" This is what {0} --help man prints.\n"
      ".TH {1} 1 {2} \"{3}\" \"User Commands\"\n"
      ".ad l\n"
      ".SH NAME\n{4} \\- {5}\n.SH SYNOPSIS\n",
      manual.program, roff(capitals(manual.program), true), PH_VERSION_DATE,
      program_and_version("libph"), name, roff(manual.phrase, false));
  for (const std::string_view usage : manual.usages)
    page += fmt::format("{}\\fB{}\\fR {}\n", usage == manual.usages.front() ? "" : ".br\n", name,
                        roff(usage, true));
  page += ".SH DESCRIPTION\n" + roff_lines(manual.paragraph) + ".SH OPTIONS\n";
  for (const Topic& topic : manual.topics) {
    page += fmt::format(".SS {}\n", roff(topic.title, false));
    for (const OptionText* option : program.of(topic))
      page += item(roff_head(*option), option->text() + ".");
  }
  page += format_section(manual);
  page += ".SH EXIT STATUS\n";
  for (const ExitStatus& status : exit_statuses())
    page += item(fmt::format("\\fB{}\\fR", static_cast<int>(status.code)),
                 fmt::format("{}.", status.what));
  page +=
      ".SH ENVIRONMENT\n" + item("\\fBTMPDIR\\fR",
                                 "The folder of temporary files (default: /tmp). They hold what a "
                                 "memory limit leaves no room for; nobody else sees them.");
  page += ".SH EXAMPLES\nThe files lie in the folder of the source.\n";
  for (const Example& example : manual.examples)
    page += fmt::format(".PP\n{}", roff_lines(fmt::format("{}:", example.what))) +
            preformatted(example.command);
  return page + fmt::format(".SH SEE ALSO\n\\fB{}\\fR(1)\n", roff(manual.see_also, true));
}

}  // namespace ph::app
