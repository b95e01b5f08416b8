#include "app/window/phase_history.hpp"

#include <quadrille/names.hpp>

namespace quadrille::app {

namespace {

struct Words {
    const char* name;
    const char* meaning;
};

constexpr std::array<Words, PhaseHistory::rows> words = {{
    {"move", "Bodies are moved to the end of the step."},
    {"partition", "Bodies are sorted into cells."},
    {"gather", "What the device needs is gathered."},
    {"to the device", "And copied there."},
    {"contacts", "Pairs are found in the cells, and contacts resolved."},
    {"from the device", "Results are copied back."},
    {"listeners", "Contacts are handed to whoever asked for them."},
    {"panels", "Panels, and what is drawn over the world."},
    {"buffers", "Positions and colours are sent to the graphics driver."},
    {"drawing", "Bodies and cells are drawn."},
    {"to the screen", "The picture is handed over; with the wait for the screen."},
    {"error metrics", "The reference of --error is followed and compared with."},
    {"unaccounted", "All else: events, outputs, checkpoints."},
    {"waiting", "For the time of the next picture."},
}};

}  // namespace

const char* phaseWords(std::size_t row) { return words.at(row).name; }
const char* phaseMeaning(std::size_t row) { return words.at(row).meaning; }

bool canOccur(std::size_t row, ResolverKind resolver, bool measuresError) {
    if (row == PhaseHistory::Error) return measuresError;
    if (row >= phaseCount) return true;
    switch (static_cast<Phase>(row)) {
        case Phase::Flatten:
        case Phase::CopyToDevice:
        case Phase::CopyToHost:
            return needsDevice(resolver);
        default:
            return true;
    }
}

}  // namespace quadrille::app
