#pragma once

#include <iosfwd>

namespace CLI {
class App;
}

namespace quadrille::app {

/// The options of the program as a page for man(1).
void writeManual(std::ostream& out, const CLI::App& app);

/// A script that completes them in bash.
void writeBashCompletion(std::ostream& out, const CLI::App& app);

}  // namespace quadrille::app
