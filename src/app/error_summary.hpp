#pragma once

#include <iosfwd>
#include <nlohmann/json_fwd.hpp>

#include "accuracy/metrics.hpp"

namespace quadrille::app {

/// The key `error` of a run's summary, as docs/accuracy.md explains it.
nlohmann::ordered_json errorJson(const accuracy::ErrorMetrics& metrics);

/// The same for a person.
void printError(std::ostream& out, const nlohmann::ordered_json& error);

}  // namespace quadrille::app
