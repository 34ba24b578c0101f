// SPDX-License-Identifier: MIT
#include "ph/error.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <type_traits>

#include "ph/run_context.hpp"

namespace ph {
namespace {

/// An interface that lacks the setting `nan`.
const Words kShouting{[](Setting setting, std::string_view value) {
  if (setting == Setting::nan) return std::string();
  return "SET " + std::string(name_of(setting)) + (value.empty() ? "" : " TO ") +
         (value.empty() ? "" : alternatives(value, "'"));
}};

TEST(Message, IsRenderedInEachWords) {
  const Message plain = "no marks; at all";
  EXPECT_EQ(plain.str(), "no marks; at all");
  EXPECT_EQ(plain.in_words(kShouting), "no marks; at all");
  const Message matrix =
      "asymmetric; " + mark(Setting::symmetrise, "max|min|lower") + " accepts it";
  EXPECT_EQ(matrix.str(), "asymmetric; symmetrise max, min or lower accepts it");
  EXPECT_EQ(matrix.in_words(kShouting),
            "asymmetric; SET symmetrise TO 'max', 'min' or 'lower' accepts it");
  EXPECT_EQ(Message(mark(Setting::camera) + ": odd").in_words(kShouting), "SET camera: odd");
}

TEST(Message, LeavesClausesOfUnknownSettingsOut) {
  const std::string nan = mark(Setting::nan, "drop") + " leaves it out";
  const std::string columns = mark(Setting::columns) + " takes some";
  EXPECT_EQ(Message("found NaN; " + nan).in_words(kShouting), "found NaN");
  EXPECT_EQ(Message("found NaN; " + nan + "; " + columns).in_words(kShouting),
            "found NaN; SET columns takes some");
  EXPECT_EQ(Message("found NaN; " + columns + ", " + nan + "; else").in_words(kShouting),
            "found NaN; else");
  // If the interface lacks a setting, a text about this setting keeps the terms of C++.
  EXPECT_EQ(Message(mark(Setting::nan, "drop") + ": nothing to do").in_words(kShouting),
            "nan drop: nothing to do");
  EXPECT_EQ(Message("a; " + nan + "; " + columns).without(Setting::columns).str(),
            "a; nan drop leaves it out");
}

TEST(Message, KnowsPlaceAndRemedies) {
  const Message message = mark_place("a.csv:3:7") + ": not a number, found " + mark_found("nan") +
                          "; " + mark(Setting::nan, "drop") + " leaves it out, or " +
                          mark(Setting::diagonal, "zero|births") + "; see " +
                          mark(Setting::max_range);
  EXPECT_EQ(message.str(),
            "a.csv:3:7: not a number, found nan; nan drop leaves it out, or diagonal zero or "
            "births; see max_range");
  EXPECT_EQ(message.place(), "a.csv:3:7");
  EXPECT_EQ(message.found(), "nan");
  EXPECT_EQ(message.remedies(), (std::vector<Remedy>{{Setting::nan, "drop"},
                                                     {Setting::diagonal, "zero"},
                                                     {Setting::diagonal, "births"},
                                                     {Setting::max_range, ""}}));
  EXPECT_TRUE(message.is_about("a.csv"));
  EXPECT_TRUE(message.is_about("a.csv:3:7"));
  EXPECT_FALSE(message.is_about("a"));
  EXPECT_FALSE(message.is_about(""));
  EXPECT_TRUE(message.without_place().str().starts_with("not a number"));
  EXPECT_EQ(Message("b: " + message.marked()).without_place().place(), "a.csv:3:7");
  EXPECT_TRUE(Message("nothing").remedies().empty());
  EXPECT_TRUE(Message("nothing").place().empty());
}

TEST(Message, TakesAnyText) {
  const Message odd = mark_place("a; b.csv:1:2") + ": x; " + mark(Setting::nan, "drop");
  EXPECT_EQ(odd.in_words(kShouting), "a; b.csv:1:2: x");
  EXPECT_EQ(odd.without(Setting::nan).str(), "a; b.csv:1:2: x");
  EXPECT_EQ(odd.place(), "a; b.csv:1:2");
  for (const std::string text :
       {"", "; ", "\x1e", "\x1f", "\x1e\x1f", "a\x1ename\x1f", "\x1d; \x1e"})
    EXPECT_EQ(Message(text).str(), text);
}

TEST(Setting, HasANameOfItsOwn) {
  std::set<std::string_view> names;
  for (const auto& [setting, name] : names_of<Setting>) {
    EXPECT_NE(setting, Setting::none);
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_EQ(Message(mark(setting)).str(), name);
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(names_of<Setting>.back().value));
  EXPECT_EQ(name_of(Setting::none), "");
}

TEST(Error, KeepsItsMarks) {
  const Error error(ErrorKind::bad_data, mark_place("p") + ": x; " + mark(Setting::nan, "drop"));
  EXPECT_STREQ(error.what(), "p: x; nan drop");
  EXPECT_EQ(error.in_words(kShouting), "p: x");
  EXPECT_EQ(error.remedies(), (std::vector<Remedy>{{Setting::nan, "drop"}}));
  const Error wrapped(error.kind(), "input 1: " + error.marked());
  EXPECT_EQ(wrapped.place(), "p");
  EXPECT_EQ(wrapped.in_words(kShouting), "input 1: p: x");
  const InputError of_many(3, error);
  EXPECT_STREQ(of_many.what(), "input 3: p: x; nan drop");
  EXPECT_EQ(of_many.in_words(kShouting), "input 3: p: x");
  EXPECT_EQ(of_many.cause().in_words(kShouting), "p: x");
  EXPECT_TRUE(std::is_nothrow_copy_constructible_v<Error>);
}

}  // namespace
}  // namespace ph
