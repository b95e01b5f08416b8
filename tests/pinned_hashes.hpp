#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include <quadrille/names.hpp>

namespace quadrille {

/// The state in which a run of a shipped scene must end.
struct PinnedHash {
    std::string scene;
    std::uint64_t frames;
    Law law;
    Precision precision;
    std::string hash;  ///< 16 hexadecimal digits
};

inline std::ostream& operator<<(std::ostream& out, const PinnedHash& p) {
    return out << p.scene << ", " << p.frames << " frames, " << name(p.law) << ", "
               << name(p.precision);
}

/// Those of tests/data/pinned_hashes.csv.
inline std::vector<PinnedHash> pinnedHashes(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::string line;
    std::getline(in, line);
    std::vector<PinnedHash> result;
    while (std::getline(in, line)) {
        std::istringstream fields(line);
        std::string scene, frames, law, precision, hash;
        for (std::string* field : {&scene, &frames, &law, &precision, &hash}) {
            std::getline(fields, *field, ',');
        }
        result.push_back({.scene = scene,
                          .frames = std::stoull(frames),
                          .law = find(laws(), law).value(),
                          .precision = find(precisions(), precision).value(),
                          .hash = hash});
    }
    return result;
}

}  // namespace quadrille
