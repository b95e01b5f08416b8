#include "app/error_summary.hpp"

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <string>

#include "accuracy/error_meter.hpp"

namespace quadrille::app {

namespace {

using Json = nlohmann::ordered_json;

Json orNull(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

}  // namespace

Json errorJson(const accuracy::ErrorMetrics& m) {
    Json json;
    json["reference"] = accuracy::ErrorMeter::reference;
    json["horizon_s"] = m.horizon;
    json["exact_collisions"] = m.events.exact;
    json["collisions"] = m.events.measured;
    json["matched_collisions"] = m.events.matched;
    json["recall"] = m.events.recall();
    json["precision"] = m.events.precision();
    json["f1"] = m.events.f1();
    json["rate_bias"] = orNull(m.events.rateBias());
    json["by_rule"] = {{"pushed", m.pushedCollisions}, {"jammed", m.jammedCollisions}};
    json["wrong_bodies"] = m.wrongBodies;
    json["wrong_body_fraction"] = m.wrongBodyFraction();
    json["velocity_tolerance"] = m.velocityTolerance;
    json["length_px"] = m.length;
    json["position_error"] = {{"median", m.positionError.median},
                              {"p99", m.positionError.p99},
                              {"max", m.positionError.max}};
    json["overlap"] = {{"max", m.overlapMax}, {"mean", m.overlapMean}};
    json["escaped"] = m.escaped;
    json["energy_drift"] = m.energyDrift;
    json["speed_drift"] = orNull(m.speedDrift);
    json["wall_identity"] =
        m.wallIdentity ? Json{{"x", m.wallIdentity->x()}, {"y", m.wallIdentity->y()}} : Json();
    json["broad_phase_recall"] = orNull(m.broadPhaseRecall());
    json["overlapping_pairs"] = m.overlappingPairs;
    return json;
}

void printError(std::ostream& out, const Json& json) {
    const auto row = [&](const char* label, const std::string& value) {
        std::array<char, 24> padded{};
        std::snprintf(padded.data(), padded.size(), "  %-18s", label);
        out << padded.data() << value << '\n';
    };
    const auto number = [](const Json& value, const char* after = "") {
        if (value.is_null()) return std::string("-") + after;
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), "%.4g", value.get<double>());
        return text.data() + std::string(after);
    };
    out << "error over " << number(json["horizon_s"], " s against: ")
        << json["reference"].get<std::string>() << '\n';
    row("collisions", json["collisions"].dump() + ", exact " + json["exact_collisions"].dump() +
                          ", bias " + number(json["rate_bias"]));
    const Json& byRule = json["by_rule"];
    if (byRule["pushed"] > 0 || byRule["jammed"] > 0) {
        row("by rule", byRule["pushed"].dump() + " pushed, " + byRule["jammed"].dump() +
                           " jammed of the exact ones: what follows depends on a choice");
    }
    row("recall", number(json["recall"], ", precision ") + number(json["precision"], ", F1 ") +
                      number(json["f1"]));
    row("wrong bodies",
        json["wrong_bodies"].dump() + ", fraction " + number(json["wrong_body_fraction"]));
    const Json& position = json["position_error"];
    row("position error",
        number(position["median"], " median, ") + number(position["p99"], " p99, ") +
            number(position["max"], " max, in sides of ") + number(json["length_px"], " px"));
    row("overlap", number(json["overlap"]["max"], " max, ") +
                       number(json["overlap"]["mean"], " mean, in sides"));
    row("drift",
        number(json["energy_drift"], " energy, ") + number(json["speed_drift"], " speeds"));
    const Json& wall = json["wall_identity"];
    if (!wall.is_null()) row("wall identity", number(wall["x"], " x, ") + number(wall["y"], " y"));
    row("broad phase", number(json["broad_phase_recall"], " recall of ") +
                           json["overlapping_pairs"].dump() + " overlapping pairs");
}

}  // namespace quadrille::app
