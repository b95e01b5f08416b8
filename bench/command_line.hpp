#pragma once

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

namespace quadrille::bench {

/// Parses the command line and runs the benchmark. Returns what the program tells the shell: 0, 1
/// for a failure, 2 for a mistake on the command line.
template <class Benchmark>
int runCommandLine(CLI::App& app, int argc, char** argv, Benchmark&& benchmark) {
    try {
        app.parse(argc, argv);
        benchmark();
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
    return 0;
}

}  // namespace quadrille::bench
