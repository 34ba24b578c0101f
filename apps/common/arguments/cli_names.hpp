// SPDX-License-Identifier: MIT
#pragma once
// The classes of CLI11 by name: its header takes seconds to compile, and few files call it.

namespace CLI {

class App;
class Option;

}  // namespace CLI
