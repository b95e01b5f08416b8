#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <ostream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <quadrille/vec2.hpp>

#include "reference/oracle.hpp"

namespace quadrille::reference {

/// The rows of a CSV file of numbers, without its header.
inline std::vector<std::vector<double>> readCsv(const std::string& name) {
    std::ifstream file(std::string(QUADRILLE_TEST_DATA) + "/golden/" + name);
    if (!file) throw std::runtime_error("cannot read " + name);
    std::vector<std::vector<double>> rows;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::vector<double> row;
        std::istringstream fields(line);
        for (std::string field; std::getline(fields, field, ',');) row.push_back(std::stod(field));
        rows.push_back(row);
    }
    return rows;
}

/// A state of a golden run.
struct GoldenState {
    std::string label;  ///< in the name of its file
    double time;        ///< s, exact
};

/// A golden run and the world it lives in (NAME.toml says the same).
struct Golden {
    std::string name;
    Vec2 world;
    std::vector<GoldenState> states;
};
inline void PrintTo(const Golden& golden, std::ostream* out) { *out << golden.name; }

inline const Golden small64{
    "small64", {60.0, 49.999999940395355}, {{"0.5", 0.5}, {"1", 1}, {"5", 5}, {"20", 20}}};
inline const Golden a1700{"A1700",
                          {1919.9999995529652, 1279.9999997913837},
                          {{"1", 1}, {"10", 10}, {"60", 60}, {"300", 300}}};
// The state called t0.05 is that at 0.05 s rounded to a multiple of 2^-26 s: so say the 1,500
// components in it that no collision has changed yet.
inline const Golden dense1600{"dense1600",
                              {169.70562994480133, 169.70562994480133},
                              {{"0.05", 3355443.0 / 67108864.0}, {"0.25", 0.25}, {"1", 1}}};

/// Four static boxes around a world centred on the origin: left, right, bottom, top.
inline std::vector<Box> walls(const Vec2& world) {
    const double t = 100;
    const Vec2 half = world / 2;
    const Vec2 side(t, world.y() + 2 * t);
    const Vec2 flat(world.x() + 2 * t, t);
    return {{.position = {-half.x() - t / 2, 0}, .size = side, .isStatic = true},
            {.position = {half.x() + t / 2, 0}, .size = side, .isStatic = true},
            {.position = {0, -half.y() - t / 2}, .size = flat, .isStatic = true},
            {.position = {0, half.y() + t / 2}, .size = flat, .isStatic = true}};
}

/// Four walls, then the bodies of a golden run.
inline std::vector<Box> boxesOf(const Golden& golden) {
    std::vector<Box> boxes = walls(golden.world);
    for (const auto& row : readCsv(golden.name + ".csv")) {
        boxes.push_back(
            {.position = {row[0], row[1]}, .velocity = {row[2], row[3]}, .size = {3, 3}});
    }
    return boxes;
}

inline std::vector<Box> movingOf(const std::vector<Box>& boxes) {
    std::vector<Box> moving;
    for (const Box& box : boxes) {
        if (!box.isStatic) moving.push_back(box);
    }
    return moving;
}

inline std::vector<Box> reversed(std::vector<Box> boxes) {
    for (Box& box : boxes) box.velocity = -box.velocity;
    return boxes;
}

inline double energy(const std::vector<Box>& boxes) {
    double sum = 0;
    for (const Box& box : boxes) {
        if (!box.isStatic) sum += box.mass * box.velocity.squaredNorm() / 2;
    }
    return sum;
}

inline Vec2 momentum(const std::vector<Box>& boxes) {
    Vec2 sum(0, 0);
    for (const Box& box : boxes) {
        if (!box.isStatic) sum += box.mass * box.velocity;
    }
    return sum;
}

/// How deep two boxes overlap, px; negative if they are apart.
inline double overlap(const Box& a, const Box& b) {
    const Vec2 gap = (a.position - b.position).cwiseAbs() - (a.size + b.size) / 2;
    return -gap.maxCoeff();
}

inline double largestOverlap(const std::vector<Box>& boxes) {
    double largest = -1e300;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (boxes[i].isStatic && boxes[j].isStatic) continue;
            largest = std::max(largest, overlap(boxes[i], boxes[j]));
        }
    }
    return largest;
}

/// Boxes of many sizes and masses between four walls that do not overlap.
inline std::vector<Box> mixture(int count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * double(random() >> 11) * 0x1p-53;
    };
    std::vector<Box> boxes = walls({100, 80});
    while (int(boxes.size()) < count + 4) {
        const Box box{.position = {uniform(-48, 48), uniform(-38, 38)},
                      .velocity = {uniform(-20, 20), uniform(-20, 20)},
                      .size = {uniform(0.5, 4), uniform(0.5, 4)},
                      .mass = uniform(0.5, 8)};
        bool isFree = true;
        for (const Box& other : boxes) isFree = isFree && overlap(box, other) < 0;
        if (isFree) boxes.push_back(box);
    }
    return boxes;
}

}  // namespace quadrille::reference
