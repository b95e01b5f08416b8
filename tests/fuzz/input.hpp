#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace quadrille::fuzz {

/// What was found: the program took what it should have refused, or did not keep to what it says.
class Finding : public std::logic_error {
  public:
    using std::logic_error::logic_error;
};

/// Gives one input of its kind to the program, which is to take it (true) or to refuse it (false).
/// Each fuzz program is linked with one of these. Throws Finding, lets other exceptions out, or
/// does not return where it is wrong.
bool tryInput(std::string_view input);

}  // namespace quadrille::fuzz
