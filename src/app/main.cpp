#include <exception>
#include <iostream>
#include <new>

#include <quadrille/error.hpp>

#include "app/exit_code.hpp"
#include "app/explain.hpp"
#include "app/headless.hpp"
#include "app/interrupt.hpp"
#include "app/options.hpp"
#include "app/run_setup.hpp"
#include "app/standard_streams.hpp"
#include "app/window/run_window.hpp"

namespace quadrille::app {

namespace {

int run(int argc, char** argv) {
    const ParsedOptions parsed = parseOptions(argc, argv);
    if (!parsed.options) {
        if (parsed.exitCode == done) requireStdout();
        return parsed.exitCode;
    }
    const Options& options = *parsed.options;
    if (options.list || options.explain) requireStdout();
    if (options.list) {
        list(std::cout);
        return done;
    }
    if (options.explain) {
        Run run = setUp(options);
        // As the comparison does.
        if (options.error) run.simulation.onContact([](const Contact&) {});
        explain(std::cout, run, !options.headless);
        if (run.beside) explain(std::cout, *run.beside, !options.headless);
        return done;
    }
    return options.headless ? runHeadless(setUp(options), options) : runWindow(options);
}

int fail(const char* message, int code) {
    std::cerr << "collisionStress: " << message << '\n';
    return code;
}

}  // namespace

}  // namespace quadrille::app

int main(int argc, char** argv) {
    using namespace quadrille;
    app::openStandardStreams();
    app::cleanUpOnSignals();
    try {
        const int exitCode = app::run(argc, argv);
        app::finishStdout();
        return exitCode;
    } catch (const app::UsageError& error) {
        return app::fail(error.what(), app::usageError);
    } catch (const NotAvailable& error) {
        return app::fail(error.what(), app::usageError);
    } catch (const DeviceError& error) {
        return app::fail(error.what(), app::noDevice);
    } catch (const SceneError& error) {
        return app::fail(error.what(), app::badInput);
    } catch (const SnapshotError& error) {
        return app::fail(error.what(), app::badInput);
    } catch (const std::bad_alloc&) {
        return app::fail("out of memory", app::runtimeFailure);
    } catch (const std::exception& error) {
        return app::fail(error.what(), app::runtimeFailure);
    }
}
