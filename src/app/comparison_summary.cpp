#include "app/comparison_summary.hpp"

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <ostream>
#include <utility>

namespace quadrille::app {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t rowsOfTable = 20;

/// The next of 1, 2, 5, 10, 20, 50 and so on.
std::uint64_t nextOfSeries(std::uint64_t number) {
    std::uint64_t power = 1;
    while (number >= 10 * power) power *= 10;
    const std::uint64_t digit = number / power;
    return power * (digit < 2 ? 2 : digit < 5 ? 5 : 10);
}

}  // namespace

Json comparisonJson(const std::array<std::string, 2>& labels, const ComparedFrame* frame,
                    Json beside) {
    if (frame == nullptr) return nullptr;
    const accuracy::Divergence& d = frame->divergence;
    Json json;
    json["runs"] = {labels[0], labels[1]};
    json["frame"] = frame->frame;
    json["time"] = d.time;
    json["bodies"] = d.bodies;
    json["apart"] = d.apart;
    json["wrong_bodies"] = d.wrongBodies;
    json["velocity_tolerance"] = d.velocityTolerance;
    json["length_px"] = d.length;
    json["position_error"] = {{"median", d.positionError.median},
                              {"p99", d.positionError.p99},
                              {"max", d.positionError.max}};
    json["matched"] = d.events.matched;
    json["missed"] = d.events.missed();
    json["invented"] = d.events.invented();
    json["overlap"] = {d.overlapMax[0], d.overlapMax[1]};
    json["same_state"] = frame->stateHash[0] == frame->stateHash[1];
    json["beside"] = std::move(beside);
    return json;
}

void printComparison(std::ostream& out, const Json& json) {
    if (json.is_null()) {
        out << "nothing compared: the two runs have not met at one time\n";
        return;
    }
    const auto row = [&](const char* label, const std::string& value) {
        std::array<char, 24> padded{};
        std::snprintf(padded.data(), padded.size(), "  %-18s", label);
        out << padded.data() << value << '\n';
    };
    const auto number = [](const Json& value, const char* after = "") {
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), "%.4g", value.get<double>());
        return text.data() + std::string(after);
    };
    const std::array<std::string, 2> labels = {json["runs"][0], json["runs"][1]};
    out << labels[0] << " held against " << labels[1] << " at " << number(json["time"], " s\n");
    row("bodies", json["apart"].dump() + " apart, " + json["wrong_bodies"].dump() + " wrong, of " +
                      json["bodies"].dump());
    row("collisions", json["matched"].dump() + " the same, " + json["missed"].dump() + " missed, " +
                          json["invented"].dump() + " invented");
    const Json& position = json["position_error"];
    row("places differ by",
        number(position["median"], " median, ") + number(position["p99"], " p99, ") +
            number(position["max"], " max, in sides of ") + number(json["length_px"], " px"));
    row("overlap", number(json["overlap"][0], " and ") + number(json["overlap"][1], ", in sides"));
    row("state", json["same_state"].get<bool>() ? "the same bits" : "not the same bits");
    if (json["beside"].is_null()) return;
    const Json& ms = json["beside"]["ms_per_frame"];
    row("steps beside", json["beside"]["frames"].dump() + ", ms each " +
                            number(ms["mean"], " mean, ") + number(ms["median"], " median, ") +
                            number(ms["p99"], " p99"));
}

ComparisonTable::ComparisonTable(std::ostream& out, std::array<std::string, 2> labels,
                                 std::optional<std::uint64_t> frames)
    : out_(out),
      labels_(std::move(labels)),
      every_(frames ? (*frames + rowsOfTable - 1) / rowsOfTable : 0) {
    if (every_ > 0) next_ = every_;
}

void ComparisonTable::add(const ComparedFrame& frame) {
    ++meetings_;
    for (std::size_t run = 0; run < 2; ++run) milliseconds_[run] += frame.milliseconds[run];
    last_ = frame;
    if (frame.frame < next_) return;
    while (next_ <= frame.frame) next_ = every_ > 0 ? next_ + every_ : nextOfSeries(next_);
    print();
}

void ComparisonTable::finish() {
    if (last_) print();
}

void ComparisonTable::print() {
    if (!headed_) {
        out_ << "1: " << labels_[0] << ", held against 2: " << labels_[1]
             << "; overlap in sides, ms a frame\n"
                "    time, s      apart      wrong     missed   invented  overlap 1  overlap 2"
                "       ms 1       ms 2\n";
        headed_ = true;
    }
    const accuracy::Divergence& d = last_->divergence;
    std::array<char, 200> line{};
    std::snprintf(
        line.data(), line.size(), "%11.6g %10zu %10zu %10llu %10llu %10.3g %10.3g %10.4g %10.4g",
        d.time, d.apart, d.wrongBodies, static_cast<unsigned long long>(d.events.missed()),
        static_cast<unsigned long long>(d.events.invented()), d.overlapMax[0], d.overlapMax[1],
        milliseconds_[0] / double(meetings_), milliseconds_[1] / double(meetings_));
    out_ << line.data() << std::endl;
    last_.reset();
    meetings_ = 0;
    milliseconds_ = {};
}

}  // namespace quadrille::app
