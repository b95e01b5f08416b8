#include <quadrille/error.hpp>

#include "app/window/run_window.hpp"

namespace quadrille::app {

int runWindow(const Options&) { throw Error("this build has no window; use --headless"); }

}  // namespace quadrille::app
