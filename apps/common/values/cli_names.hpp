// SPDX-License-Identifier: MIT
#pragma once
// Declares the classes of CLI11: its header takes seconds to compile, and few files call it.

namespace CLI {

class App;
class Option;

}  // namespace CLI
